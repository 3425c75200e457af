/* What a vertex carries to its points: normals and colours times 1/w, which are linear on the
 * screen. */
#ifndef BURNISH_SHADE_ATTRIBUTES_H
#define BURNISH_SHADE_ATTRIBUTES_H

#include <stdint.h>

#include "raster/raster.h"

/* Four floats that are added and multiplied together: x, y, z or r, g, b, and a fourth. */
typedef float burnish_float4 __attribute__((vector_size(16)));

/* One item a screen vertex, those that clipping made included. Owned. */
typedef struct burnish_attributes {
    burnish_float4 *normals; /* (x, y, z, 1) / w */
    burnish_float4 *colors;  /* linear (r, g, b, 0) / w, or NULL */
} burnish_attributes;

/* normals: 3 a vertex of the mesh; colors: 4 sRGB codes a vertex, or NULL; indices: the mesh's.
 * Errors: MEMORY; *attributes is then empty. */
burnish_status burnish_attributes_create(burnish_attributes *attributes,
                                         const burnish_geometry *geometry, const float *normals,
                                         const uint8_t *colors, const uint32_t *indices,
                                         int threads, burnish_error *error);
void burnish_attributes_destroy(burnish_attributes *attributes);

#endif
