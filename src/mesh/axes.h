/* Axes of cylinders, cones and holes: of circles among the sharp edges of a mesh. */
#ifndef BURNISH_MESH_AXES_H
#define BURNISH_MESH_AXES_H

#include "core/vec3.h"
#include "mesh/edges.h"

typedef struct burnish_axis_line {
    burnish_vec3 origin, direction; /* unit length */
    double from, to;                /* along the direction: the first and the last circle */
    double radii[2];                /* of these circles */
    double radius;                  /* of the largest; 0: there is only one, and so no axis */
} burnish_axis_line;

typedef struct burnish_circle {
    burnish_vec3 center;
    double radius;
    size_t axis;
} burnish_circle;

/* Part of a circle: a fillet's edge, a slot's end, a circle that other edges interrupt. */
typedef struct burnish_arc {
    burnish_vec3 center, normal, middle; /* middle: one of its points */
    double radius, angle;                /* radians */
} burnish_arc;

typedef struct burnish_axes {
    burnish_axis_line *items;
    size_t count, capacity;
    burnish_circle *circles;
    size_t circle_count, circle_capacity;
    burnish_arc *arcs;
    size_t arc_count, arc_capacity;
    int are_too_many; /* 1: so there are none */
} burnish_axes;

/* Finds axes that two circles or more have in common. A circle is a closed loop of at least 12
 * sharp edges that meets no other sharp edge, with its vertices in a plane and on a circle to 0.4 %
 * of its radius, none of them further apart than 3/5 of it. An arc is at least four sharp edges in
 * a row and 30 degrees, as close to a circle. Meshes with more than 4,096 axes, 16,384 circles or
 * 16,384 arcs have none. Errors: memory->status. Release the three arrays with burnish_release. */
void burnish_axes_find(const burnish_mesh_view *mesh, const burnish_edges *edges,
                       burnish_memory *memory, burnish_axes *axes);

/* The circle through three points. Returns 0 if they are in line. */
int burnish_circle_through(const burnish_vec3 p[3], burnish_vec3 *center, double *radius);

#endif
