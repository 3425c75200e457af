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

/* ---- vertex_writer.c ---- */

/* The vertices of the positions. The first one of a position has the first of its corners; it is
 * here, others are in lists. */
typedef struct burnish_first_vertices {
    float *normals;    /* 3 per position */
    uint8_t *is_split; /* of each position: 1 if it has several vertices; then ... */
    uint32_t *heads;   /* ... for each of its corners the first one of its vertex */
} burnish_first_vertices;

/* A vertex that is not the first one of its position. */
typedef struct burnish_later_vertex {
    uint32_t corner; /* the first one that uses it */
    uint32_t position;
    float normal[3];
} burnish_later_vertex;

typedef struct burnish_later_vertices {
    burnish_later_vertex *items;
    size_t count, capacity;
} burnish_later_vertices;

/* Makes the mesh's vertices and indices, numbered in the order in which triangles first use them,
 * whatever the lists and their order are. Takes what it needs from the builder, which keeps no
 * lists of corners, and from `first`. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_write_vertices(burnish_builder *b, burnish_first_vertices *first,
                                            const burnish_later_vertices *lists, size_t list_count);

#endif
