/* UTF-8, as Unicode defines it. */
#ifndef TOOL_FONT_UTF8_H
#define TOOL_FONT_UTF8_H

#include <stddef.h>
#include <stdint.h>

/* Bytes of the well-formed character that text begins with, and its code point; 0 where there is
 * none: a stray or missing continuation, a form longer than needed, a surrogate, a code point above
 * U+10FFFF, or no byte at all. */
size_t utf8_decode(const char *text, size_t length, uint32_t *code);

/* Bytes before the first that begins no well-formed character; length where all are well. */
size_t utf8_valid_length(const char *text, size_t length);

/* The longest beginning of at most `most` bytes that cuts no character. */
size_t utf8_cut(const char *text, size_t most);

#endif
