/* What of a mesh is framed. */
#ifndef BURNISH_MESH_BUILD_STRAYS_H
#define BURNISH_MESH_BUILD_STRAYS_H

#include "mesh/data/mesh.h"

/* Counts triangles that are far from all others, few and small: along an axis, the others take at
 * most an eighth of the box. Needs vertices and triangles.
 *   low, high  receive the box of the others, if there are strays
 *   first      receives the number of the first stray */
size_t burnish_find_strays(const burnish_mesh *mesh, float low[3], float high[3], size_t *first);

#endif
