/* Loose ends of lines. */
#ifndef BURNISH_RENDER_LINES_LINES_LOOSE_H
#define BURNISH_RENDER_LINES_LINES_LOOSE_H

#include "render/lines/lines.h"

/* Leaves out sets of lines that meet, together shorter than that, with a loose end, unless the
 * background begins there. Errors: memory->status; the lines are then as before. */
void burnish_line_art_drop_loose(burnish_line_art *art, double shortest, burnish_memory *memory);

#endif
