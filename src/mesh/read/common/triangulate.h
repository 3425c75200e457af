/* Polygons to triangles. */
#ifndef BURNISH_MESH_READ_COMMON_TRIANGULATE_H
#define BURNISH_MESH_READ_COMMON_TRIANGULATE_H

#include "mesh/read/io/reader.h"

/* Cuts a polygon into count - 2 triangles of the same winding, written as corner numbers.
 *
 * A strictly convex polygon becomes a fan around corner 0. Any other is projected along the
 * dominant axis of its normal and cut by ear clipping in O(count^2): a simple polygon keeps its
 * area. A polygon without a normal, or one that crosses itself, still gives count - 2 triangles,
 * from a fan.
 *
 * positions: 3 floats a position, finite
 * corners:   count indices into positions
 * count:     [3, BURNISH_POLYGON_CORNERS]
 * triangles: room for 3 * (count - 2)
 * Returns 0 if the triangles are a fan around corner 0. */
int burnish_polygon_cut(const float *positions, const uint32_t *corners, size_t count,
                        uint16_t *triangles);

/* Cuts all faces that are not triangles. Readers call it at the end, when all positions are known.
 */
burnish_status burnish_cut_polygons(burnish_reader *reader);

#endif
