/* Polygons to triangles. */
#ifndef ORACLE_MESH_READ_POLYGON_H
#define ORACLE_MESH_READ_POLYGON_H

#include <stddef.h>
#include <stdint.h>

/* Corners up to which a concave polygon is cut properly; beyond, it becomes a fan. */
#define ORACLE_POLYGON_CORNERS 256

/* Cuts a polygon into count - 2 triangles of the same winding, written as corner numbers.
 *
 * A strictly convex polygon becomes a fan around corner 0. Any other is projected along the
 * dominant axis of its normal and cut by ear clipping in O(count^2): a simple polygon keeps its
 * area. One that has no normal or crosses itself still gives count - 2 triangles, from a fan.
 *
 * positions: 3 floats a position, finite
 * corners:   count indices into positions
 * count:     [3, ORACLE_POLYGON_CORNERS]
 * triangles: room for 3 * (count - 2) */
void oracle_polygon_cut(const float *positions, const uint32_t *corners, size_t count,
                        uint16_t *triangles);

#endif
