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

#endif
