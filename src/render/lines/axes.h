/* Axes of cylinders, cones and holes: of circles among the sharp edges of a mesh. */
#ifndef BURNISH_RENDER_LINES_AXES_H
#define BURNISH_RENDER_LINES_AXES_H

#include "base/memory.h"
#include "core/vec3.h"
#include "mesh/edges.h"

typedef struct burnish_line_axis {
    burnish_vec3 origin, direction; /* unit length */
    double from, to;                /* along the direction: the first and the last circle */
    double radii[2];                /* of these circles */
    double radius;                  /* of the largest */
} burnish_line_axis;

typedef struct burnish_line_axes {
    burnish_line_axis *items;
    size_t count, capacity;
} burnish_line_axes;

/* Finds axes that two circles or more have in common. A circle is a closed loop of at least 12
 * sharp edges that meets no other sharp edge, with its vertices in a plane and on a circle to 0.4 %
 * of its radius, none of them further apart than 3/5 of it. Meshes with more than 4,096 axes or
 * 16,384 circles have none. Errors: memory->status. Release items with burnish_release. */
void burnish_line_axes_find(const burnish_mesh_view *mesh, const burnish_edges *edges,
                            burnish_memory *memory, burnish_line_axes *axes);

#endif
