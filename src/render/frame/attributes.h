/* Attributes of a frame's vertices. */
#ifndef BURNISH_RENDER_FRAME_ATTRIBUTES_H
#define BURNISH_RENDER_FRAME_ATTRIBUTES_H

#include "base/memory.h"
#include "burnish/mesh.h"
#include "raster/tile.h"

/* What a vertex carries to its points: normals and colours times 1/w, which are linear on the
 * screen. One item per screen vertex, including vertices made by clipping. Owned; all zero before
 * the first frame, a later frame uses the arrays again. */
typedef struct burnish_attributes {
    burnish_float4 *normals; /* (x, y, z, 1) / w */
    burnish_float4 *colors;  /* linear (r, g, b, alpha) / w */
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

#endif
