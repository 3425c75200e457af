/* System fonts, for labels with letters that burnish's stroke font lacks. */
#ifndef TOOL_FONT_FONT_H
#define TOOL_FONT_FONT_H

#include "base/cli/options.h"
#include "burnish/image.h"
#include "burnish/sheet.h"

typedef struct font font;

/* 1: this program was built with the libraries for fonts. */
extern const int font_is_available;

/* Opens a font file or, if file is NULL, the system's sans-serif font, with fallbacks for
 * characters that it lacks. Errors: ARGUMENT, READ, MEMORY. */
burnish_status font_open(const char *file, font **opened, burnish_error *error);

/* The font for the library; NULL for NULL. */
const burnish_font *font_setter(const font *opened);

/* The first character so far that no font has, which is drawn as a box; 0: none. */
uint32_t font_missing(const font *opened);

/* NULL is allowed. */
void font_close(font *opened);

/* ---- UTF-8, as Unicode defines it ---- */

/* The number of bytes of the first character, and its code point; 0 if it is not well-formed: a
 * stray or missing continuation, an overlong form, a surrogate, a code point above U+10FFFF, or an
 * empty text. */
size_t utf8_decode(const char *text, size_t length, uint32_t *code);

/* The number of bytes before the first one that is not well-formed; length if all are. */
size_t utf8_valid_length(const char *text, size_t length);

/* The longest prefix of at most `most` bytes that does not cut a character. */
size_t utf8_cut(const char *text, size_t most);

#endif
