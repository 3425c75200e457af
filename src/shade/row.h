/* A row of a tile with one sample a pixel: from owners to colours without a list of points. */
#ifndef BURNISH_SHADE_ROW_H
#define BURNISH_SHADE_ROW_H

#include "raster/visibility.h"
#include "shade/shade.h"

/* What a row of a tile needs on its way; entries of pixels that nothing covers hold anything. */
typedef struct burnish_row {
    float normal[3][BURNISH_TILE_SIZE], diffuse[3][BURNISH_TILE_SIZE];
    float position[3][BURNISH_TILE_SIZE], w[BURNISH_TILE_SIZE];
    float rgb[3][BURNISH_TILE_SIZE]; /* the result: >= 0, not yet clamped */
    uint16_t material[BURNISH_TILE_SIZE];
} burnish_row;

/* Shades row y of a tile. The row's arrays must have been set once, to anything that is a number.
 * Returns 0 when nothing covers it. */
int burnish_shade_row(const burnish_shader *shader, burnish_shade_cache *cache,
                      const burnish_visibility *visibility, const burnish_raster_view *view, int y,
                      burnish_row *row);

#endif
