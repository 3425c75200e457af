/* UTF-8, as Unicode defines it. */
#ifndef TOOL_FONT_UTF8_H
#define TOOL_FONT_UTF8_H

#include <stddef.h>
#include <stdint.h>

/* The number of bytes of the first character, and its code point; 0 if it is not well-formed: a
 * stray or missing continuation, an overlong form, a surrogate, a code point above U+10FFFF, or an
 * empty text. */
size_t utf8_decode(const char *text, size_t length, uint32_t *code);

/* The number of bytes before the first one that is not well-formed; length if all are. */
size_t utf8_valid_length(const char *text, size_t length);

/* The longest prefix of at most `most` bytes that does not cut a character. */
size_t utf8_cut(const char *text, size_t most);

#endif
