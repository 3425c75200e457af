/* The two ways from a tile to the fragments that are shaded: a row of blocks whose simple pixels
 * lie in the tile's planes already, and fragments of complex pixels, which are gathered. */
#ifndef BURNISH_RENDER_FRAGMENTS_H
#define BURNISH_RENDER_FRAGMENTS_H

#include "raster/fragments.h"
#include "render/attributes.h"
#include "shading/shade.h"

/* What visible points are shaded from. */
typedef struct burnish_surface {
    const burnish_raster_view *view;
    const burnish_shading *shading;
    const burnish_attributes *attributes;
    const uint16_t *triangle_materials; /* NULL: all have material 0 */
} burnish_surface;

/* A thread's arrays. All zero before the first use. */
typedef struct burnish_fragment_scratch {
    float normal[3][BURNISH_SHADE_BATCH], color[3][BURNISH_SHADE_BATCH],
        inverse_w[BURNISH_SHADE_BATCH];
    uint16_t material[BURNISH_SHADE_BATCH];
    burnish_shade_scratch shade;
} burnish_fragment_scratch;

/* A row of blocks: what its pixels show, and the colours of the simple ones. Those of others are
 * some numbers. All zero before the first use. */
typedef struct burnish_row_light {
    burnish_block_row pixels;
    float rgb[3][BURNISH_BLOCK_ROW_PIXELS]; /* linear light, >= 0 */
} burnish_row_light;

/* The planes that shading needs of a tile. */
int burnish_surface_planes(const burnish_surface *surface);

/* Shades the simple pixels of row `number`, whose attributes are read where they lie. row->pixels
 * must hold what the row's pixels show. */
void burnish_shade_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row);

/* The fragments of complex pixels as a batch, whose arrays lie in scratch. */
burnish_fragment_batch burnish_gather_fragments(const burnish_surface *surface,
                                                const burnish_fragments *fragments,
                                                burnish_fragment_scratch *scratch);

#endif
