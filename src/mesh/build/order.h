/* An order of the triangles in space. */
#ifndef BURNISH_MESH_BUILD_ORDER_H
#define BURNISH_MESH_BUILD_ORDER_H

#include "mesh/build/builder.h"

/* Finds an order of the triangles in space, so that neighbours there are neighbours in memory; it
 * depends on positions and corners only. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_order(burnish_builder *b);

/* Moves what there is per triangle into the order, which is released.
 *   corners  0: what only corners have stays where it is, since it was used in that order
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_move(burnish_builder *b, int corners);

#endif
