/* An order of the triangles in space. */
#ifndef BURNISH_MESH_BUILD_ORDER_H
#define BURNISH_MESH_BUILD_ORDER_H

#include "mesh/build/builder.h"

/* Orders the triangles so neighbours in space are neighbours in memory. The order depends on
 * positions and corners only. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_order(burnish_builder *b);

/* Moves per-triangle data into the order, and releases the order. corners 0: what only corners have
 * stays where it is, since it was used in that order
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_move(burnish_builder *b, int corners);

#endif
