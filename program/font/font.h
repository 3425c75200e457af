/* Fonts of the system: what sets labels that burnish's stroke font has no letters for. */
#ifndef TOOL_FONT_FONT_H
#define TOOL_FONT_FONT_H

#include "burnish/image.h"
#include "cli/options.h"

typedef struct font font;

/* 1: this program was built with what fonts need. */
extern const int font_is_available;

/* Opens a font file, or, with file NULL, the system's sans-serif and for characters that it lacks
 * whatever fonts have them. Errors: ARGUMENT, READ, MEMORY. */
burnish_status font_open(const char *file, font **opened, burnish_error *error);

/* Sets lines; NULL for NULL. */
const burnish_font *font_setter(const font *opened);

/* The first character met that no font has: a box stands for it; 0: none. */
uint32_t font_missing(const font *opened);

/* NULL is allowed. */
void font_close(font *opened);

#endif
