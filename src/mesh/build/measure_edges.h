/* Edges, shells and duplicates of a mesh. */
#ifndef BURNISH_MESH_BUILD_MEASURE_EDGES_H
#define BURNISH_MESH_BUILD_MEASURE_EDGES_H

#include "mesh/build/measure.h"

/* Fills the facts about vertices, edges, shells and duplicates: O(n log n) for any input, 36 bytes
 * per triangle and 4 per position. Sets the marks. Errors: MEMORY, CANCELLED. */
burnish_status burnish_measure_edges(const burnish_measured *m, burnish_mesh_facts *facts);

/* 1 for a triangle that has two corners at one position: it has no edges. */
static inline int burnish_repeats_corner(const uint32_t corners[3]) {
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
}

#endif
