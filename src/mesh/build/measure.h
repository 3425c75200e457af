/* What the two halves of measuring share: sizes in measure.c, edges and shells in measure_edges.c.
 */
#ifndef BURNISH_MESH_BUILD_MEASURE_H
#define BURNISH_MESH_BUILD_MEASURE_H

#include "mesh/build/builder.h"

/* Triangles as they were read: welded, none turned, none left out. */
typedef struct burnish_measured {
    const float *positions;  /* welded */
    const uint32_t *corners; /* 3 per triangle */
    size_t position_count, triangle_count;
    burnish_tasks *tasks;
    burnish_memory *memory;
} burnish_measured;

/* Fills what facts say of vertices, edges, shells and duplicates: O(n log n) for any input, 36
 * bytes per triangle and 5 per position. Errors: MEMORY, CANCELLED. */
burnish_status burnish_measure_edges(const burnish_measured *m, burnish_mesh_facts *facts);

/* 1 for a triangle that has two corners at one position: it has no edges. */
static inline int burnish_repeats_corner(const uint32_t corners[3]) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

#endif
