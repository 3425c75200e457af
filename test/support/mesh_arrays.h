/* For tests: meshes from packed arrays. */
#ifndef BURNISH_TEST_MESH_ARRAYS_H
#define BURNISH_TEST_MESH_ARRAYS_H

#include "burnish/mesh.h"

/* normals and colors may be NULL. */
static inline burnish_mesh_description describe_arrays(const float *positions, const float *normals,
                                                       const uint8_t *colors, size_t vertex_count,
                                                       const uint32_t *indices,
                                                       size_t triangle_count) {
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){positions, vertex_count, 0};
    arrays.normals = (burnish_array){normals, normals ? vertex_count : 0, 0};
    arrays.colors = (burnish_array){colors, colors ? vertex_count : 0, 0};
    arrays.indices = (burnish_array){indices, 3 * triangle_count, 0};
    return arrays;
}

#endif
