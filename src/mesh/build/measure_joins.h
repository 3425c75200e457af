/* Closing surfaces whose vertices differ by rounding. */
#ifndef BURNISH_MESH_BUILD_MEASURE_JOINS_H
#define BURNISH_MESH_BUILD_MEASURE_JOINS_H

#include "mesh/build/measure.h"

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
