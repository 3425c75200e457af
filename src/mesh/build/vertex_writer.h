/* Vertices that were found position by position, brought into their order. */
#ifndef BURNISH_MESH_BUILD_VERTEX_WRITER_H
#define BURNISH_MESH_BUILD_VERTEX_WRITER_H

#include "mesh/build/builder.h"

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
