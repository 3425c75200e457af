/* The pixels of a tile's row that are one triangle's alone: from owners to colours in place,
 * without a list of points. */
#ifndef BURNISH_SHADE_ROW_H
#define BURNISH_SHADE_ROW_H

#include "raster/visibility.h"
#include "shade/shade.h"

/* What a row needs on its way; entries of other pixels hold anything. */
typedef struct burnish_row {
    float normal[3][BURNISH_TILE_SIZE], diffuse[3][BURNISH_TILE_SIZE];
    float position[3][BURNISH_TILE_SIZE], w[BURNISH_TILE_SIZE];
    float rgb[3][BURNISH_TILE_SIZE]; /* the result: >= 0, not yet clamped */
    uint16_t material[BURNISH_TILE_SIZE];
} burnish_row;

/* Shades row y of a tile. The row's arrays must have been set once, to anything that is a number.
 * Returns 0 when it has no such pixel. */
int burnish_shade_row(const burnish_shader *shader, burnish_shade_cache *cache,
                      const burnish_visibility *visibility, const burnish_whole_row *whole,
                      const burnish_raster_view *view, int y, burnish_row *row);

#endif
