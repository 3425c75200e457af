/* Which edges are smooth if no crease angle is given. */
#ifndef BURNISH_MESH_BUILD_CREASES_H
#define BURNISH_MESH_BUILD_CREASES_H

#include "mesh/build/builder.h"

/* 20 degrees: smooth below, whatever is around. */
#define BURNISH_SMOOTH_COSINE 0.93969262078590838
/* 60: never smooth from there on. */
#define BURNISH_SHARP_COSINE 0.5
/* 1: parts of one flat face. */
#define BURNISH_COPLANAR_COSINE 0.99984769515639124

/* Whether an edge between 20 and 60 degrees is smooth.
 *
 * It is smooth if both faces bend at all their edges and no edge is sharp, as in scans, spheres and
 * decimated shapes. If a face belongs to a larger flat face, or has an edge that is sharp or open,
 * the edge is smooth only up to 40 degrees and only as a step of a curve: the flat faces on both
 * sides are about equally wide, and beyond them the surface keeps bending in the same direction. A
 * cylinder of 12 sides is therefore round, while a chamfer or a pocket of flat facets keeps its
 * edges.
 *
 * triangles: the two at the edge; their order does not matter
 * edge:      numbers of its positions, in any order */
int burnish_surface_is_smooth(const burnish_surface *surface, const uint32_t triangles[2],
                              const uint32_t edge[2]);

#endif
