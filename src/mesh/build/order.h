/* Triangles in an order in which neighbours in space are neighbours in memory. */
#ifndef BURNISH_MESH_BUILD_ORDER_H
#define BURNISH_MESH_BUILD_ORDER_H

#include <stddef.h>
#include <stdint.h>

#include "core/memory.h"
#include "core/tasks.h"

/* Fewer triangles than this keep the order of the file. */
enum { BURNISH_ORDER_MIN = 4096 };

/* Sorts triangles by cells of space, which follow one another along a Z-order curve (G. M. Morton,
 * "A computer oriented geodetic data base", IBM, 1966); within a cell they keep their order. O(n);
 * the result depends on the positions and corners only.
 *
 * positions: 3 finite floats per position
 * corners:   3 positions per triangle; the least of them is where the triangle is, so that the same
 *            triangles are in the same cell
 * count:     [1, BURNISH_TRIANGLES_MAX]
 * order:     count numbers of triangles, written
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_order_triangles(const float *positions, size_t position_count,
                                       const uint32_t *corners, size_t count, burnish_tasks *tasks,
                                       burnish_memory *memory, uint32_t *order);

#endif
