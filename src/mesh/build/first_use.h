/* Positions in the order in which triangles use them. */
#ifndef BURNISH_MESH_BUILD_FIRST_USE_H
#define BURNISH_MESH_BUILD_FIRST_USE_H

#include "mesh/build/builder.h"

/* How positions were numbered before. */
typedef struct burnish_renumbering {
    size_t count;      /* of the positions before; 0: they were not renumbered */
    uint32_t *before;  /* of each position: its number before */
    uint32_t *numbers; /* of each one before: its number, or BURNISH_NONE if no triangle has it */
} burnish_renumbering;

/* Renumbers the positions in the order in which triangles first use them, so what is near in the
 * mesh is near in memory, and drops the others; not if an attribute is numbered as the positions
 * are. The order does not depend on the threads. Release the arrays, also after errors: MEMORY,
 * CANCELLED. */
burnish_status burnish_build_number_positions(burnish_builder *b, burnish_renumbering *renumbering);

#endif
