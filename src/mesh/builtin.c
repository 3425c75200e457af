/* The built-in objects: y up, centred on the origin (the base of the teapot is at y = 0). Closed
 * but for the teapot, whose body, lid, handle and spout pass into each other. */
#include <string.h>

#include "base/numbers.h"
#include "core/vec3.h"
#include "mesh/builtin.h"
#include "mesh/data/mesh.h"

/* Reserves room in empty data for a surface with one normal per vertex. Errors: LIMIT (more
 * triangles than options->max_triangles), MEMORY. */
static burnish_status reserve_surface(burnish_mesh_data *data, const char *name,
                                      size_t vertex_count, size_t triangle_count,
                                      const burnish_load_options *options, burnish_error *error) {
    burnish_status status = burnish_check_triangle_count(options, name, triangle_count, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_mesh_data_reserve(data, BURNISH_POSITION, vertex_count);
    burnish_mesh_data_reserve(data, BURNISH_NORMAL, vertex_count);
    return burnish_mesh_data_reserve_corners(data, BURNISH_POSITION, triangle_count);
}

/* Appends a vertex within the room reserved. */
static void add_vertex(burnish_mesh_data *data, burnish_vec3 position, burnish_vec3 normal) {
    float *p = burnish_positions(data) + 3 * data->streams[BURNISH_POSITION].count++;
    float *n = burnish_normals(data) + 3 * data->streams[BURNISH_NORMAL].count++;
    p[0] = (float)position.x;
    p[1] = (float)position.y;
    p[2] = (float)position.z;
    normal = burnish_vec3_normalize(normal);
    n[0] = (float)normal.x;
    n[1] = (float)normal.y;
    n[2] = (float)normal.z;
}

/* Appends a triangle, counter-clockwise seen from outside, within the room reserved. */
static void add_triangle(burnish_mesh_data *data, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t corners[3] = {a, b, c};
    memcpy(data->streams[BURNISH_POSITION].corners + 3 * data->triangle_count, corners,
           sizeof corners);
    ++data->triangle_count;
}

/* Sine and cosine of i / n of a turn. */
static void sincos_of_turn(uint32_t i, uint32_t n, double *sine, double *cosine) {
    burnish_sincos(2 * BURNISH_PI * i / n, sine, cosine);
}

/* Two triangles for each cell of a grid that is closed in both directions. Vertex (i, j) is number
 * i * nj + j. (i, j), (i + 1, j), (i, j + 1) are counter-clockwise seen from outside, or clockwise
 * if mirrored is 1. */
static void close_grid(burnish_mesh_data *data, uint32_t ni, uint32_t nj, int mirrored) {
    for (uint32_t i = 0; i < ni; ++i) {
        for (uint32_t j = 0; j < nj; ++j) {
            uint32_t next_i = (i + 1) % ni, next_j = (j + 1) % nj;
            uint32_t a = i * nj + j, b = next_i * nj + j, c = next_i * nj + next_j,
                     d = i * nj + next_j;
            add_triangle(data, a, mirrored ? c : b, mirrored ? b : c);
            add_triangle(data, a, mirrored ? d : c, mirrored ? c : d);
        }
    }
}

/* A lattice point of the cube [-n, n]^3's surface, blown up to the unit sphere. The tangent spreads
 * the lattice lines evenly in angle. It is odd and the same for equal coordinates, bit for bit. */
static burnish_vec3 sphere_point(const int lattice[3], int n) {
    double warped[3];
    for (int k = 0; k < 3; ++k) {
        double sine, cosine;
        int size = lattice[k] < 0 ? -lattice[k] : lattice[k];
        burnish_sincos(BURNISH_PI / 4 * size / n, &sine, &cosine);
        double tangent = size == n ? 1 : sine / cosine;
        warped[k] = lattice[k] < 0 ? -tangent : tangent;
    }
    return burnish_vec3_normalize(burnish_vec3_load(warped));
}

/* One face of the sphere: outside is the given axis, in the direction of sign. */
static void make_sphere_face(burnish_mesh_data *data, int axis, int sign, int n) {
    uint32_t base = (uint32_t)data->streams[BURNISH_POSITION].count, side = 2 * (uint32_t)n + 1;
    for (int j = -n; j <= n; ++j) {
        for (int i = -n; i <= n; ++i) {
            /* (i, j, outside) stays right-handed: i turns round with the sign. */
            int lattice[3];
            lattice[axis] = sign * n;
            lattice[(axis + 1) % 3] = sign * i;
            lattice[(axis + 2) % 3] = j;
            burnish_vec3 unit = sphere_point(lattice, n);
            add_vertex(data, unit, unit);
        }
    }
    for (int j = -n; j < n; ++j) {
        for (int i = -n; i < n; ++i) {
            uint32_t a = base + (uint32_t)(j + n) * side + (uint32_t)(i + n);
            uint32_t b = a + 1, c = a + side + 1, d = c - 1;
            if ((i < 0) == (j < 0)) { /* diagonals run toward the middle: mirror symmetric */
                add_triangle(data, a, b, c);
                add_triangle(data, a, c, d);
            } else {
                add_triangle(data, a, b, d);
                add_triangle(data, b, c, d);
            }
        }
    }
}

/* Radius 1: a blown-up cube, 2n segments a quarter (n the tessellation), 48 n^2 triangles. A point
 *        depends on its lattice coordinates only: the six faces meet exactly. */
static burnish_status make_sphere(const burnish_load_options *options, burnish_mesh_data *data,
                                  burnish_error *error) {
    size_t side = 2 * (size_t)options->tessellation + 1;
    burnish_status status = reserve_surface(data, ":sphere", 6 * side * side,
                                            12 * (side - 1) * (side - 1), options, error);
    for (int face = 0; status == BURNISH_STATUS_OK && face < 6; ++face) {
        make_sphere_face(data, face % 3, face < 3 ? 1 : -1, options->tessellation);
    }
    return status;
}

/* Radii 1 and 0.4, in the plane y = 0; 8n segments around the axis, 4n around the tube. */
static burnish_status make_torus(const burnish_load_options *options, burnish_mesh_data *data,
                                 burnish_error *error) {
    const double major = 1, minor = 0.4;
    uint32_t ni = 8 * (uint32_t)options->tessellation, nj = 4 * (uint32_t)options->tessellation;
    burnish_status status =
        reserve_surface(data, ":torus", (size_t)ni * nj, 2 * (size_t)ni * nj, options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < ni; ++i) {
        double sine_i, cosine_i;
        sincos_of_turn(i, ni, &sine_i, &cosine_i);
        for (uint32_t j = 0; j < nj; ++j) {
            double sine_j, cosine_j;
            sincos_of_turn(j, nj, &sine_j, &cosine_j);
            /* From +z toward +x, that is counter-clockwise seen from above, and up from outside. */
            burnish_vec3 normal = {cosine_j * sine_i, sine_j, cosine_j * cosine_i};
            burnish_vec3 center = {major * sine_i, 0, major * cosine_i};
            add_vertex(data, burnish_vec3_add(center, burnish_vec3_scale(normal, minor)), normal);
        }
    }
    close_grid(data, ni, nj, 0);
    return BURNISH_STATUS_OK;
}

/* A tube of radius 0.6 around the (2, 3) torus knot
 *   p(a) = ((2 + cos 3a) cos 2a, (2 + cos 3a) sin 2a, sin 3a),
 * facing +z; 16n segments along, 4n around. The frame comes from the torus that contains the knot:
 * the normal of the torus is perpendicular to the knot everywhere and closes on itself. A circular
 * tube's normal is the spoke of the circle, whichever frame it is measured from. */
static burnish_status make_knot(const burnish_load_options *options, burnish_mesh_data *data,
                                burnish_error *error) {
    const double radius = 0.6;
    uint32_t ni = 16 * (uint32_t)options->tessellation, nj = 4 * (uint32_t)options->tessellation;
    burnish_status status =
        reserve_surface(data, ":knot", (size_t)ni * nj, 2 * (size_t)ni * nj, options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < ni; ++i) {
        double s2, c2, s3, c3;
        sincos_of_turn(2 * i % ni, ni, &s2, &c2);
        sincos_of_turn(3 * i % ni, ni, &s3, &c3);
        double distance = 2 + c3;
        burnish_vec3 center = {distance * c2, distance * s2, s3};
        burnish_vec3 tangent = {-3 * s3 * c2 - 2 * distance * s2, -3 * s3 * s2 + 2 * distance * c2,
                                3 * c3};
        burnish_vec3 normal = {c3 * c2, c3 * s2, s3};
        burnish_vec3 binormal = burnish_vec3_normalize(burnish_vec3_cross(tangent, normal));
        for (uint32_t j = 0; j < nj; ++j) {
            double sine, cosine;
            sincos_of_turn(j, nj, &sine, &cosine);
            burnish_vec3 spoke = burnish_vec3_add(burnish_vec3_scale(normal, cosine),
                                                  burnish_vec3_scale(binormal, sine));
            add_vertex(data, burnish_vec3_add(center, burnish_vec3_scale(spoke, radius)), spoke);
        }
    }
    close_grid(data, ni, nj, 1);
    return BURNISH_STATUS_OK;
}

/* ---- Newell's teapot: 32 bicubic Bezier patches, evaluated in double in a fixed order ---- */

/* Cubic Bernstein polynomials at i / n, and their derivatives. The numerators are exact integers,
 * so the values at i and at n - i mirror each other bit for bit. */
typedef struct bernstein {
    double value[4], slope[4];
} bernstein;

static bernstein bernstein_at(int i, int n) {
    double t = i, s = n - i, cube = (double)n * n * n, square = (double)n * n;
    return (bernstein){
        {s * s * s / cube, 3 * t * s * s / cube, 3 * t * t * s / cube, t * t * t / cube},
        {-3 * s * s / square, 3 * s * (s - 2 * t) / square, 3 * t * (2 * s - t) / square,
         3 * t * t / square},
    };
}

/* The sum of four weighted points, in an order that is the same read backwards: patches that share
 * a border curve get the same positions, whichever way each runs along it. */
static burnish_vec3 combine_points(const burnish_vec3 p[4], const double weight[4]) {
    burnish_vec3 outer =
        burnish_vec3_add(burnish_vec3_scale(p[0], weight[0]), burnish_vec3_scale(p[3], weight[3]));
    burnish_vec3 inner =
        burnish_vec3_add(burnish_vec3_scale(p[1], weight[1]), burnish_vec3_scale(p[2], weight[2]));
    return burnish_vec3_add(outer, inner);
}

/* Data set to world: y up instead of z, a rotation about x. */
static burnish_vec3 turn_up(burnish_vec3 p) {
    return (burnish_vec3){p.x, p.z, -p.y};
}

/* pole: v = 0 of a patch whose first row is one point (the lid's top, the bottom's middle). There
 * du vanishes; near it du grows as v times its own v derivative, which has the limit's direction.
 */
static void evaluate_patch(burnish_mesh_data *data, burnish_vec3 points[4][4], const bernstein *u,
                           const bernstein *v, int pole) {
    burnish_vec3 row[4], row_slope[4];
    for (int i = 0; i < 4; ++i) {
        row[i] = combine_points(points[i], u->value);
        row_slope[i] = combine_points(points[i], u->slope);
    }
    burnish_vec3 along_v = combine_points(row, v->slope);
    burnish_vec3 along_u = combine_points(row_slope, pole ? v->slope : v->value);
    burnish_vec3 normal = burnish_vec3_cross(along_u, along_v);
    add_vertex(data, turn_up(combine_points(row, v->value)), turn_up(normal));
}

/* Control points, z up, the spout along +x: Martin Newell's of 1975 as published by Frank Crow, "The
 * Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987, with the bottom that
 * was added to it later. */

/* A quarter of a turned part; the others are the same turned about z. Points of a row: (radius, 0),
 * (radius, -shoulder), (shoulder, -radius), (0, -radius). */
typedef struct turned_row {
    double radius, shoulder, z;
} turned_row;

typedef turned_row turned_part[4];

static const turned_part
    rim = {{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}},
    shoulders = {{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}},
    belly = {{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}},
    knob = {{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}},
    lid = {{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}},
    bottom = {{0, 0, 0}, {1.425, 0.798, 0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}};

/* The half of a handle or spout with y < 0; the other half mirrors it. Points of a row: (x, 0, z),
 * (x, -width, z), (other_x, -width, other_z), (other_x, 0, other_z). */
typedef struct tube_row {
    double x, z, other_x, other_z, width;
} tube_row;

static const tube_row handle[2][4] = {{{-1.6, 2.025, -1.5, 2.25, 0.3},
                                       {-2.3, 2.025, -2.5, 2.25, 0.3},
                                       {-2.7, 2.025, -3, 2.25, 0.3},
                                       {-2.7, 1.8, -3, 1.8, 0.3}},
                                      {{-2.7, 1.8, -3, 1.8, 0.3},
                                       {-2.7, 1.575, -3, 1.35, 0.3},
                                       {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                       {-2, 0.9, -1.9, 0.6, 0.3}}},
                      spout[2][4] = {{{1.7, 1.425, 1.7, 0.6, 0.66},
                                      {2.6, 1.425, 3.1, 0.825, 0.66},
                                      {2.3, 2.1, 2.4, 2.025, 0.25},
                                      {2.7, 2.4, 3.3, 2.4, 0.25}},
                                     {{2.7, 2.4, 3.3, 2.4, 0.25},
                                      {2.8, 2.475, 3.525, 2.49375, 0.25},
                                      {2.9, 2.475, 3.45, 2.5125, 0.15},
                                      {2.8, 2.4, 3.2, 2.4, 0.15}}};

static void add_patch(burnish_mesh_data *data, burnish_vec3 points[4][4], int point, int n) {
    uint32_t base = (uint32_t)data->streams[BURNISH_POSITION].count, stride = (uint32_t)n + 1;
    for (int j = 0; j <= n; ++j) {
        bernstein v = bernstein_at(j, n);
        for (int i = 0; i <= n; ++i) {
            bernstein u = bernstein_at(i, n);
            evaluate_patch(data, points, &u, &v, point && j == 0);
        }
    }
    for (uint32_t j = 0; j < (uint32_t)n; ++j) {
        for (uint32_t i = 0; i < (uint32_t)n; ++i) {
            uint32_t a = base + j * stride + i, b = a + 1, c = a + stride, d = c + 1;
            if (j > 0 || !point) {
                add_triangle(data, a, b, d);
            }
            add_triangle(data, a, d, c);
        }
    }
}

/* Four patches; `below` turns them to the other side of y = 0, so that they face down. */
static void add_turned(burnish_mesh_data *data, const turned_part part, int below, int n) {
    for (int turn = 0; turn < 4; ++turn) {
        burnish_vec3 points[4][4];
        for (int i = 0; i < 16; ++i) {
            const turned_row *row = &part[i / 4];
            const double along[4] = {row->radius, row->radius, row->shoulder, 0};
            double x = along[i % 4], y = 0 - along[3 - i % 4];
            for (int k = 0; k < turn; ++k) {
                const double old_x = x;
                x = y;
                y = 0 - old_x;
            }
            points[i / 4][i % 4] = (burnish_vec3){x, below ? 0 - y : y, row->z};
        }
        add_patch(data, points, part[0].radius == 0, n);
    }
}

/* Four patches. */
static void add_tube(burnish_mesh_data *data, const tube_row tube[2][4], int n) {
    for (int patch = 0; patch < 4; ++patch) {
        burnish_vec3 points[4][4];
        for (int i = 0; i < 16; ++i) {
            const tube_row *row = &tube[patch / 2][i / 4];
            const int mirrored = patch % 2, column = i % 4, other = (column >= 2) != mirrored;
            const double y = column == 1 || column == 2 ? row->width : 0;
            points[i / 4][column] = (burnish_vec3){
                other ? row->other_x : row->x, mirrored ? y : 0 - y, other ? row->other_z : row->z};
        }
        add_patch(data, points, 0, n);
    }
}

/* Of the 32 patches 8 begin in a point: the knob's and the bottom's. */
static burnish_status make_teapot(const burnish_load_options *options, burnish_mesh_data *data,
                                  burnish_error *error) {
    const int tessellation = options->tessellation;
    const size_t n = (size_t)tessellation;
    burnish_status status = reserve_surface(data, ":teapot", 32 * (n + 1) * (n + 1),
                                            32 * 2 * n * n - 8 * n, options, error);
    if (status == BURNISH_STATUS_OK) {
        add_turned(data, rim, 0, tessellation);
        add_turned(data, shoulders, 0, tessellation);
        add_turned(data, belly, 0, tessellation);
        add_tube(data, handle, tessellation);
        add_tube(data, spout, tessellation);
        add_turned(data, knob, 0, tessellation);
        add_turned(data, lid, 0, tessellation);
        add_turned(data, bottom, 1, tessellation);
    }
    return status;
}

/* ---- By name ---- */

burnish_status burnish_make_builtin(const char *name, const burnish_load_options *options,
                                    burnish_mesh_data *data, burnish_error *error) {
    static const struct {
        const char *name;
        burnish_status (*make)(const burnish_load_options *, burnish_mesh_data *, burnish_error *);
    } objects[] = {{"teapot", make_teapot},
                   {"sphere", make_sphere},
                   {"torus", make_torus},
                   {"knot", make_knot}};
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; ++i) {
        if (strcmp(name, objects[i].name) == 0) {
            return objects[i].make(options, data, error);
        }
    }
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                        ":%s: unknown built-in object; there are :teapot, :sphere, :torus, :knot",
                        name);
}
