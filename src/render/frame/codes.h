/* Codes straight from a tile's normals, without colours in between: one sample per pixel, and
 * lights that need no more than a normal. */
#ifndef BURNISH_RENDER_FRAME_CODES_H
#define BURNISH_RENDER_FRAME_CODES_H

#include "render/frame/target.h"

/* Whether the rows of tiles can be encoded so. */
int burnish_codes_are_direct(const burnish_surface *surface, const burnish_output *output);

/* The codes of row `number` of a tile's blocks. row: scratch; row->pixels must hold what the row's
 * pixels show if there are several materials. */
void burnish_codes_shade_row(const burnish_surface *surface, const burnish_output *output,
                             const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row,
                             uint32_t *codes);

#endif
