/* The whole pixels of four rows of a tile: from interpolated attributes to colours, in place. */
#ifndef BURNISH_SHADING_STRIP_H
#define BURNISH_SHADING_STRIP_H

#include "raster/tile.h"
#include "shading/shade.h"

/* What a strip needs on its way, pixels in the tile's order; entries of pixels that are not whole
 * hold anything. */
typedef struct burnish_strip {
    int32_t whole[BURNISH_BLOCK_ROW_PIXELS]; /* as by burnish_visibility_whole */
    burnish_block_row pixels;
    float rgb[3][BURNISH_BLOCK_ROW_PIXELS]; /* the result: >= 0, not yet clamped */
    float normal[3][BURNISH_BLOCK_ROW_PIXELS], diffuse[3][BURNISH_BLOCK_ROW_PIXELS];
    float position[3][BURNISH_BLOCK_ROW_PIXELS], w[BURNISH_BLOCK_ROW_PIXELS];
    uint16_t material[BURNISH_BLOCK_ROW_PIXELS];
} burnish_strip;

/* The planes that the shader needs of a tile. */
int burnish_shade_planes(const burnish_shader *shader);

/* Shades the blocks of the strip that show a triangle. The strip's arrays must have been set once,
 * to anything that is a number. */
void burnish_shade_strip(const burnish_shader *shader, burnish_shade_cache *cache,
                         const burnish_isa_ops *ops, const burnish_tile *tile,
                         const burnish_raster_view *view, int number, burnish_strip *strip);

#endif
