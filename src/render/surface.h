/* From attributes of vertices to the light of visible points. There are two ways from a tile to the
 * fragments that are shaded: a row of blocks whose simple pixels lie in the tile's planes already,
 * and fragments of complex pixels, which are gathered. */
#ifndef BURNISH_RENDER_SURFACE_H
#define BURNISH_RENDER_SURFACE_H

#include <stdint.h>

#include "burnish/mesh.h"
#include "core/memory.h"
#include "raster/fragments.h"
#include "shading/shade.h"

/* What a vertex carries to its points: normals and colours times 1/w, which are linear on the
 * screen. One item per screen vertex, those that clipping made included. Owned; all zero before the
 * first frame, a later frame uses the arrays again. */
typedef struct burnish_attributes {
    burnish_float4 *normals; /* (x, y, z, 1) / w */
    burnish_float4 *colors;  /* linear (r, g, b, 0) / w */
    int has_colors;
    size_t normal_capacity, color_capacity;
} burnish_attributes;

/* The mesh's normals and, unless they are to be ignored, colours. Errors: MEMORY; destroy them all
 * the same. */
burnish_status burnish_attributes_update(burnish_attributes *attributes,
                                         const burnish_geometry *geometry,
                                         const burnish_mesh_view *mesh, int ignore_colors,
                                         burnish_tasks *tasks, burnish_memory *memory);
void burnish_attributes_destroy(burnish_attributes *attributes, const burnish_context *context);

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

/* Gathers what the fragments of complex pixels are shaded from, in scratch, and shades them: rgb
 * receives their light; NULL: they are only gathered. */
burnish_fragment_batch burnish_shade_fragments(const burnish_surface *surface,
                                               const burnish_fragments *fragments,
                                               burnish_fragment_scratch *scratch,
                                               float *const *rgb);

#endif
