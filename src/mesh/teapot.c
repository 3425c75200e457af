/* Newell's teapot: 32 bicubic Bezier patches, evaluated in double in a fixed order. */
#include "mesh/builtin.h"
#include "mesh/teapot_data.h"

/* Cubic Bernstein polynomials at i / n, and their derivatives. The numerators are exact integers,
 * so that the values at i and at n - i mirror each other bit for bit. */
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
static burnish_vec3 combine(const burnish_vec3 p[4], const double weight[4]) {
    burnish_vec3 outer =
        burnish_vec3_add(burnish_vec3_scale(p[0], weight[0]), burnish_vec3_scale(p[3], weight[3]));
    burnish_vec3 inner =
        burnish_vec3_add(burnish_vec3_scale(p[1], weight[1]), burnish_vec3_scale(p[2], weight[2]));
    return burnish_vec3_add(outer, inner);
}

/* Data set to world: y up instead of z, a turn about x. */
static burnish_vec3 turn_up(burnish_vec3 p) {
    return (burnish_vec3){p.x, p.z, -p.y};
}

/* pole: v = 0 of a patch whose first row is one point (the lid's top, the bottom's middle). There
 * du vanishes; near it du grows as v times its own v derivative, which has the limit's direction.
 */
static void evaluate(burnish_mesh_data *data, burnish_vec3 points[4][4], const bernstein *u,
                     const bernstein *v, int pole) {
    burnish_vec3 row[4], row_slope[4];
    for (int i = 0; i < 4; ++i) {
        row[i] = combine(points[i], u->value);
        row_slope[i] = combine(points[i], u->slope);
    }
    burnish_vec3 along_v = combine(row, v->slope);
    burnish_vec3 along_u = combine(row_slope, pole ? v->slope : v->value);
    burnish_vec3 normal = burnish_vec3_cross(along_u, along_v);
    burnish_surface_vertex(data, turn_up(combine(row, v->value)), turn_up(normal));
}

static int first_row_is_point(const uint16_t patch[16]) {
    return patch[0] == patch[1] && patch[0] == patch[2] && patch[0] == patch[3];
}

static void add_patch(burnish_mesh_data *data, const uint16_t patch[16], int n) {
    burnish_vec3 points[4][4];
    uint32_t base = (uint32_t)data->streams[BURNISH_POSITION].count, stride = (uint32_t)n + 1;
    int point = first_row_is_point(patch);
    for (int i = 0; i < 16; ++i) {
        points[i / 4][i % 4] = burnish_vec3_load(teapot_points[patch[i]]);
    }
    for (int j = 0; j <= n; ++j) {
        bernstein v = bernstein_at(j, n);
        for (int i = 0; i <= n; ++i) {
            bernstein u = bernstein_at(i, n);
            evaluate(data, points, &u, &v, point && j == 0);
        }
    }
    for (uint32_t j = 0; j < (uint32_t)n; ++j) {
        for (uint32_t i = 0; i < (uint32_t)n; ++i) {
            uint32_t a = base + j * stride + i, b = a + 1, c = a + stride, d = c + 1;
            if (j > 0 || !point) {
                burnish_surface_triangle(data, a, b, d);
            }
            burnish_surface_triangle(data, a, d, c);
        }
    }
}

burnish_status burnish_make_teapot(const burnish_load_options *options, burnish_mesh_data *data,
                                   burnish_error *error) {
    size_t n = (size_t)options->tessellation, triangles = 0;
    for (int i = 0; i < TEAPOT_PATCHES; ++i) {
        triangles += 2 * n * n - (first_row_is_point(teapot_patches[i]) ? n : 0);
    }
    burnish_status status = burnish_surface_reserve(
        data, ":teapot", TEAPOT_PATCHES * (n + 1) * (n + 1), triangles, options, error);
    for (int i = 0; status == BURNISH_STATUS_OK && i < TEAPOT_PATCHES; ++i) {
        add_patch(data, teapot_patches[i], options->tessellation);
    }
    return status;
}
