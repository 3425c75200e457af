/* Triangles appended to a list: the solids that the scenes are made of. Outsides wind
 * counter-clockwise. */
#ifndef BURNISH_BENCH_PEERS_SHAPES_H
#define BURNISH_BENCH_PEERS_SHAPES_H

#include <stddef.h>
#include <stdint.h>

#include "core/vector.h"

/* Start from zeros; release with burnish_shape_free. */
typedef struct burnish_shape {
    float *positions;    /* 9 per triangle */
    uint16_t *materials; /* 1 per triangle */
    uint16_t material;   /* of the triangles appended from now on */
    size_t triangles, capacity;
    int out_of_memory; /* 1: what was appended since is missing */
} burnish_shape;

void burnish_shape_free(burnish_shape *shape);

void burnish_shape_triangle(burnish_shape *shape, burnish_vec3 a, burnish_vec3 b, burnish_vec3 c);

/* a b c d in order around it; cut from a to c. */
void burnish_shape_quad(burnish_shape *shape, burnish_vec3 a, burnish_vec3 b, burnish_vec3 c,
                        burnish_vec3 d);

/* Axis-parallel, from its lowest to its highest corner. */
void burnish_shape_box(burnish_shape *shape, burnish_vec3 low, burnish_vec3 high);

/* A closed cylinder of 4 sides - 4 triangles; sides in [3, 256], caps are fans. */
void burnish_shape_cylinder(burnish_shape *shape, burnish_vec3 from, burnish_vec3 to, double radius,
                            int sides);

/* 2 sides (sides / 2 - 1) triangles between its poles on the y axis. */
void burnish_shape_sphere(burnish_shape *shape, burnish_vec3 center, double radius, int sides);

/* A slab with through holes, one in the middle of each of columns x rows cells, triangulated like
 * CAD exports: long thin triangles from a cell's corners to its hole.
 *   origin   a corner; u, v  its edges; u x v points outward, the slab extends the other way
 *   sides    of a hole, a multiple of 4 */
typedef struct burnish_plate {
    burnish_vec3 origin, u, v;
    double thickness;
    int columns, rows;
    double radius;
    int sides;
} burnish_plate;

void burnish_shape_plate(burnish_shape *shape, const burnish_plate *plate);

/* A ring between two outlines of count points each, counter-clockwise seen along -height. */
void burnish_shape_ring(burnish_shape *shape, const burnish_vec3 *outer, const burnish_vec3 *inner,
                        int count, burnish_vec3 height);

#endif
