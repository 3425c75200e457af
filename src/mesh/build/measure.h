/* The sizes of a mesh. */
#ifndef BURNISH_MESH_BUILD_MEASURE_H
#define BURNISH_MESH_BUILD_MEASURE_H

#include "mesh/build/builder.h"

/* Triangles after welding, before any is turned or dropped. */
typedef struct burnish_measured {
    const float *positions;  /* welded */
    const uint32_t *corners; /* 3 per triangle */
    size_t position_count, triangle_count;
    uint8_t *marks; /* of each position, 0 at first */
    burnish_tasks *tasks;
    burnish_memory *memory;
} burnish_measured;

/* Marks: a triangle has this position; it is on an edge of an odd number of triangles. */
enum { BURNISH_MARK_USED = 1, BURNISH_MARK_ODD = 2 };

/* Fills the mesh's facts. Call it after corner_positions are set, before triangles are turned or
 * dropped. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_measure(burnish_builder *b);

#endif
