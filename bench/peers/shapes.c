/* Solids as triangles. */
#include "shapes.h"

#include <math.h>
#include <stdlib.h>

static const double TURN = 6.28318530717958647692;

static burnish_vec3 along(burnish_vec3 from, burnish_vec3 axis, double length) {
    return burnish_vec3_add(from, burnish_vec3_scale(axis, length));
}

void burnish_shape_free(burnish_shape *shape) {
    free(shape->positions);
    free(shape->materials);
    *shape = (burnish_shape){0};
}

void burnish_shape_triangle(burnish_shape *shape, burnish_vec3 a, burnish_vec3 b, burnish_vec3 c) {
    if (shape->triangles == shape->capacity) {
        const size_t capacity = 2 * shape->capacity + 1024;
        float *positions = realloc(shape->positions, capacity * 9 * sizeof *positions);
        shape->positions = positions ? positions : shape->positions;
        uint16_t *materials = realloc(shape->materials, capacity * sizeof *materials);
        shape->materials = materials ? materials : shape->materials;
        if (!positions || !materials) {
            shape->out_of_memory = 1;
            return;
        }
        shape->capacity = capacity;
    }
    shape->materials[shape->triangles] = shape->material;
    const burnish_vec3 corners[3] = {a, b, c};
    float *to = shape->positions + 9 * shape->triangles++;
    for (int i = 0; i < 3; ++i) {
        *to++ = (float)corners[i].x;
        *to++ = (float)corners[i].y;
        *to++ = (float)corners[i].z;
    }
}

void burnish_shape_quad(burnish_shape *shape, burnish_vec3 a, burnish_vec3 b, burnish_vec3 c,
                        burnish_vec3 d) {
    burnish_shape_triangle(shape, a, b, c);
    burnish_shape_triangle(shape, a, c, d);
}

void burnish_shape_box(burnish_shape *shape, burnish_vec3 low, burnish_vec3 high) {
    burnish_vec3 corners[8]; /* bits of the number: x, y, z */
    static const int FACES[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int i = 0; i < 8; ++i) {
        corners[i] =
            (burnish_vec3){i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    }
    for (int i = 0; i < 6; ++i) {
        burnish_shape_quad(shape, corners[FACES[i][0]], corners[FACES[i][1]], corners[FACES[i][2]],
                           corners[FACES[i][3]]);
    }
}

/* Unit vectors u, v with u x v = axis, of unit length. */
static void make_basis(burnish_vec3 axis, burnish_vec3 *u, burnish_vec3 *v) {
    const burnish_vec3 other =
        fabs(axis.y) < 0.9 ? (burnish_vec3){0, 1, 0} : (burnish_vec3){1, 0, 0};
    *u = burnish_vec3_normalize(burnish_vec3_cross(other, axis));
    *v = burnish_vec3_cross(axis, *u);
}

static burnish_vec3 on_circle(burnish_vec3 center, burnish_vec3 u, burnish_vec3 v, double radius,
                              double turns) {
    return along(along(center, u, radius * cos(TURN * turns)), v, radius * sin(TURN * turns));
}

void burnish_shape_cylinder(burnish_shape *shape, burnish_vec3 from, burnish_vec3 to, double radius,
                            int sides) {
    burnish_vec3 u, v, low[256], high[256];
    make_basis(burnish_vec3_normalize(burnish_vec3_sub(to, from)), &u, &v);
    for (int i = 0; i < sides; ++i) {
        low[i] = on_circle(from, u, v, radius, (double)i / sides);
        high[i] = on_circle(to, u, v, radius, (double)i / sides);
    }
    for (int i = 0; i < sides; ++i) {
        const int next = (i + 1) % sides;
        burnish_shape_quad(shape, low[i], low[next], high[next], high[i]);
    }
    for (int i = 2; i < sides; ++i) {
        burnish_shape_triangle(shape, low[0], low[i], low[i - 1]);
        burnish_shape_triangle(shape, high[0], high[i - 1], high[i]);
    }
}

static burnish_vec3 on_sphere(burnish_vec3 center, double radius, double east, double south) {
    const double ring = radius * sin(TURN / 2 * south);
    const burnish_vec3 height = {center.x, center.y + radius * cos(TURN / 2 * south), center.z};
    return on_circle(height, (burnish_vec3){1, 0, 0}, (burnish_vec3){0, 0, -1}, ring, east);
}

void burnish_shape_sphere(burnish_shape *shape, burnish_vec3 center, double radius, int sides) {
    const int rings = sides / 2;
    for (int row = 0; row < rings; ++row) {
        for (int i = 0; i < sides; ++i) {
            const double east[2] = {(double)i / sides, (double)((i + 1) % sides) / sides};
            const double south[2] = {(double)row / rings, (double)(row + 1) / rings};
            const burnish_vec3 a = on_sphere(center, radius, east[0], south[1]);
            const burnish_vec3 b = on_sphere(center, radius, east[1], south[1]);
            const burnish_vec3 c = on_sphere(center, radius, east[1], south[0]);
            const burnish_vec3 d = on_sphere(center, radius, east[0], south[0]);
            if (row < rings - 1) {
                burnish_shape_triangle(shape, a, b, d);
            }
            if (row > 0) {
                burnish_shape_triangle(shape, row < rings - 1 ? b : a, c, d);
            }
        }
    }
}

/* A cell's face with its hole: its corner between two quarters of the circle fans to a quarter. */
static void add_holed_face(burnish_shape *shape, const burnish_plate *plate,
                           const burnish_vec3 corners[4], const burnish_vec3 *circle, int front) {
    const int quarter = plate->sides / 4;
    for (int q = 0; q < 4; ++q) {
        const burnish_vec3 corner = corners[q], next = corners[(q + 1) % 4];
        const burnish_vec3 end = circle[(q + 1) * quarter % plate->sides];
        for (int i = q * quarter; i < (q + 1) * quarter; ++i) {
            const burnish_vec3 a = circle[i], b = circle[(i + 1) % plate->sides];
            burnish_shape_triangle(shape, corner, front ? b : a, front ? a : b);
        }
        burnish_shape_triangle(shape, corner, front ? next : end, front ? end : next);
    }
}

static void add_cell(burnish_shape *shape, const burnish_plate *plate, int column, int row) {
    const burnish_vec3 u = burnish_vec3_scale(plate->u, 1.0 / plate->columns);
    const burnish_vec3 v = burnish_vec3_scale(plate->v, 1.0 / plate->rows);
    const burnish_vec3 corner = along(along(plate->origin, u, column), v, row);
    const burnish_vec3 axis = burnish_vec3_normalize(burnish_vec3_cross(u, v));
    const burnish_vec3 u_unit = burnish_vec3_normalize(u), v_unit = burnish_vec3_normalize(v);
    burnish_vec3 corners[2][4], circle[2][256];
    for (int side = 0; side < 2; ++side) { /* 0: the front */
        const burnish_vec3 at = along(corner, axis, side ? -plate->thickness : 0);
        const burnish_vec3 four[4] = {burnish_vec3_add(burnish_vec3_add(at, u), v),
                                      burnish_vec3_add(at, v), at, burnish_vec3_add(at, u)};
        for (int q = 0; q < 4; ++q) {
            corners[side][q] = four[q];
        }
        for (int i = 0; i < plate->sides; ++i) {
            circle[side][i] = on_circle(along(along(at, u, 0.5), v, 0.5), u_unit, v_unit,
                                        plate->radius, (double)i / plate->sides);
        }
        add_holed_face(shape, plate, corners[side], circle[side], !side);
    }
    for (int i = 0; i < plate->sides; ++i) {
        const int next = (i + 1) % plate->sides;
        burnish_shape_quad(shape, circle[0][i], circle[0][next], circle[1][next], circle[1][i]);
    }
    /* the slab's rim, if the cell is at it: from corner q to the next */
    const int at_rim[4] = {row == plate->rows - 1, column == 0, row == 0,
                           column == plate->columns - 1};
    for (int q = 0; q < 4; ++q) {
        const int next = (q + 1) % 4;
        if (at_rim[q]) {
            burnish_shape_quad(shape, corners[0][q], corners[1][q], corners[1][next],
                               corners[0][next]);
        }
    }
}

void burnish_shape_plate(burnish_shape *shape, const burnish_plate *plate) {
    for (int row = 0; row < plate->rows; ++row) {
        for (int column = 0; column < plate->columns; ++column) {
            add_cell(shape, plate, column, row);
        }
    }
}

void burnish_shape_ring(burnish_shape *shape, const burnish_vec3 *outer, const burnish_vec3 *inner,
                        int count, burnish_vec3 height) {
    for (int i = 0; i < count; ++i) {
        const int next = (i + 1) % count;
        const burnish_vec3 low[4] = {outer[i], outer[next], inner[next], inner[i]};
        burnish_vec3 high[4];
        for (int k = 0; k < 4; ++k) {
            high[k] = burnish_vec3_add(low[k], height);
        }
        burnish_shape_quad(shape, high[0], high[1], high[2], high[3]);
        burnish_shape_quad(shape, low[0], low[3], low[2], low[1]);
        burnish_shape_quad(shape, low[0], low[1], high[1], high[0]);
        burnish_shape_quad(shape, low[2], low[3], high[3], high[2]);
    }
}
