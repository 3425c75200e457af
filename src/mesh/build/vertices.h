/* Vertices and indices. */
#ifndef BURNISH_MESH_BUILD_VERTICES_H
#define BURNISH_MESH_BUILD_VERTICES_H

#include "mesh/build/builder.h"

/* Makes the vertices and indices of the mesh. Generates missing normals. Errors: MEMORY, CANCELLED.
 */
burnish_status burnish_build_vertices(burnish_builder *b);

burnish_status burnish_build_allocate_indices(burnish_builder *b);

/* The arrays of vertex_count vertices that the mesh has not got yet. */
burnish_status burnish_build_allocate_vertices(burnish_builder *b);

/* Lists the attributes other than position and normal. */
void burnish_build_find_extras(burnish_builder *b);

/* Copies an item by its number; returns the bytes that it takes. */
static inline size_t burnish_copy_extra(const burnish_extra *extra, uint32_t number, uint8_t *to) {
    const size_t size = burnish_attribute_size(extra->attribute);
    if (number == BURNISH_NONE) {
        memset(to, extra->attribute == BURNISH_COLOR ? 255 : 0, size);
    } else if (size == 4) {
        memcpy(to, extra->items + 4 * (size_t)number, 4);
    } else {
        memcpy(to, extra->items + size * number, size);
    }
    return size;
}

#endif
