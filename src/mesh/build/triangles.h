/* Triangles with area, over welded positions. */
#ifndef BURNISH_MESH_BUILD_TRIANGLES_H
#define BURNISH_MESH_BUILD_TRIANGLES_H

#include "mesh/build/builder.h"

/* Moves the different positions to the head of their array, keeps the triangles with area and fills
 * corner_positions; triangles whose winding contradicts the file's normals are turned. Makes the
 * file's normals unit vectors. Errors: FORMAT (nothing is left), MEMORY, CANCELLED. */
burnish_status burnish_build_triangles(burnish_builder *b);

/* Releases per-corner data, which is most of the memory, except for `extras`, whose corners are
 * needed until they are written. */
void burnish_build_release_corners(burnish_builder *b, int extras);

/* Releases all numbers that corners have; the values, and the order, stay. */
void burnish_build_release_numbers(burnish_builder *b);

#endif
