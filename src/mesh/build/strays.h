/* What of a mesh is framed. */
#ifndef BURNISH_MESH_BUILD_STRAYS_H
#define BURNISH_MESH_BUILD_STRAYS_H

#include "mesh/data/mesh.h"

/* Counts triangles that are far from all others, few and small: along an axis, the others take at
 * most an eighth of the box. Needs vertices and triangles. Strays have mesh->has_strays, or are left
 * out if they are extremely far.
 *   low, high  receive the box of the others, if there are strays
 *   place      receives a corner of the first stray */
size_t burnish_find_strays(burnish_mesh *mesh, float low[3], float high[3], float place[3]);

#endif
