/* Vertices by the numbers of the file. */
#ifndef BURNISH_MESH_BUILD_INDEXED_H
#define BURNISH_MESH_BUILD_INDEXED_H

#include "mesh/build/builder.h"

/* Indices and vertices of a mesh with the file's normals and at most one attribute besides, by
 * their numbers. For other meshes, and if a position has many vertices, *done becomes 0 and no
 * vertex is made. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_indexed(burnish_builder *b, int *done);

#endif
