/* The sizes of a mesh. */
#ifndef BURNISH_MESH_BUILD_MEASURE_H
#define BURNISH_MESH_BUILD_MEASURE_H

#include "mesh/build/builder.h"

/* Triangles after welding, before any is turned or dropped. */
typedef struct burnish_measured {
    const float *positions;  /* welded */
    const uint32_t *corners; /* 3 per triangle */
    size_t position_count, triangle_count;
    uint8_t *marks; /* of each position, 0 at first */
    burnish_tasks *tasks;
    burnish_memory *memory;
} burnish_measured;

/* Marks: a triangle has this position; it is on an edge of an odd number of triangles. */
enum { BURNISH_MARK_USED = 1, BURNISH_MARK_ODD = 2 };

/* Fills the mesh's facts. Call it after corner_positions are set, before triangles are turned or
 * dropped. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_measure(burnish_builder *b);

/* ---- measure_edges.c ---- */

/* Fills the facts about vertices, edges, shells and duplicates: O(n log n) for any input, 36 bytes
 * per triangle and 4 per position. Sets the marks. Errors: MEMORY, CANCELLED. */
burnish_status burnish_measure_edges(const burnish_measured *m, burnish_mesh_facts *facts);

/* 1 for a triangle that has two corners at one position: it has no edges. */
static inline int burnish_repeats_corner(const uint32_t corners[3]) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

/* ---- measure_joins.c ---- */

/* Vertices are joined within this share of the longest side of the bounding box: a single precision
 * coordinate of that size has a rounding error of 6e-8. */
#define BURNISH_JOIN_TOLERANCE 1e-6

/* For a surface that is not closed, after burnish_measure_edges: joins vertices on its open edges
 * within the tolerance, and updates the facts about edges and shells if the surface is then closed.
 * If a whole triangle would become a point, the surface has details of that size, and nothing
 * changes. O(n log n) for any input; 12 bytes more per triangle and 20 per position. Errors:
 * MEMORY, CANCELLED. */
burnish_status burnish_measure_joined_edges(const burnish_measured *m, burnish_mesh_facts *facts);

#endif
