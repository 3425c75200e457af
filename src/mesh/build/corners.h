/* The corners of every position. */
#ifndef BURNISH_MESH_BUILD_CORNERS_H
#define BURNISH_MESH_BUILD_CORNERS_H

#include "mesh/build/builder.h"

/* Lists the corners of every position, in the order of the triangles: first_corner, corners and
 * max_faces. Errors: MEMORY, LIMIT (crowded_max), CANCELLED. */
burnish_status burnish_build_list_corners(burnish_builder *b);

#endif
