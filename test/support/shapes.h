/* For tests of facts: triangles by hand, and what is counted of them. */
#ifndef BURNISH_TEST_SHAPES_H
#define BURNISH_TEST_SHAPES_H

#include <math.h>

#include "mesh_arrays.h"
#include "support.h"

#define TEST_PI 3.14159265358979323846

enum { POINTS_MAX = 64, TRIANGLES_MAX = 160 };

/* Triangles on their way to a mesh. */
typedef struct shape {
    float points[3 * POINTS_MAX];
    uint32_t corners[3 * TRIANGLES_MAX];
    size_t point_count, triangle_count;
} shape;

static inline void add_point(shape *s, double x, double y, double z) {
    float *to = s->points + 3 * s->point_count++;
    to[0] = (float)x;
    to[1] = (float)y;
    to[2] = (float)z;
}

static inline void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c) {
    memcpy(s->corners + 3 * s->triangle_count++, (uint32_t[]){a, b, c}, 12);
}

/* Counter-clockwise seen from outside: a, b, c, d. */
static inline void add_quad(shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    add_triangle(s, a, b, c);
    add_triangle(s, a, c, d);
}

/* Triangles in the order -x, +x, -y, +y, -z, +z, two each. */
static inline void add_box(shape *s, const double low[3], const double high[3]) {
    const uint32_t p = (uint32_t)s->point_count;
    for (int i = 0; i < 8; ++i) {
        add_point(s, i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
    }
    add_quad(s, p + 0, p + 4, p + 6, p + 2);
    add_quad(s, p + 1, p + 3, p + 7, p + 5);
    add_quad(s, p + 0, p + 1, p + 5, p + 4);
    add_quad(s, p + 2, p + 6, p + 7, p + 3);
    add_quad(s, p + 0, p + 2, p + 3, p + 1);
    add_quad(s, p + 4, p + 5, p + 7, p + 6);
}

static inline shape box_at(double x, double y, double z, double a, double b, double c) {
    shape s = {.point_count = 0};
    add_box(&s, (double[]){x, y, z}, (double[]){x + a, y + b, z + c});
    return s;
}

static inline void turn(shape *s, size_t triangle) {
    uint32_t *corners = s->corners + 3 * triangle, second = corners[1];
    corners[1] = corners[2];
    corners[2] = second;
}

/* With facts. */
static inline burnish_mesh *create_shape(const shape *s) {
    burnish_load_options load = burnish_load_options_default();
    const burnish_mesh_description arrays =
        describe_arrays(s->points, NULL, NULL, s->point_count, s->corners, s->triangle_count);
    load.measure = 1;
    return create_mesh(&arrays, &load);
}

static inline burnish_mesh_facts measure_arrays(const burnish_mesh_description *arrays,
                                                int threads) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_facts facts = {0};
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    options.measure = 1;
    options.threads = threads;
    if (CHECK_OK(burnish_mesh_create(arrays, &options, &mesh, &error), error) &&
        CHECK1(burnish_mesh_get_facts(mesh))) {
        facts = *burnish_mesh_get_facts(mesh);
    }
    burnish_mesh_destroy(mesh);
    return facts;
}

static inline burnish_mesh_facts measure(const shape *s) {
    const burnish_mesh_description arrays =
        describe_arrays(s->points, NULL, NULL, s->point_count, s->corners, s->triangle_count);
    return measure_arrays(&arrays, 1);
}

/* What is counted, in the order of the struct. */
typedef struct counted {
    size_t triangles, degenerate, duplicate, vertices;
    size_t edges, open, non_manifold, inconsistent, shells, flipped, unorientable;
    int closed, consistent;
} counted;

static inline counted count_facts(const burnish_mesh_facts *f) {
    return (counted){f->triangle_count,
                     f->degenerate_count,
                     f->duplicate_count,
                     f->vertex_count,
                     f->edge_count,
                     f->open_edge_count,
                     f->non_manifold_edge_count,
                     f->inconsistent_edge_count,
                     f->shell_count,
                     f->flipped_count,
                     f->unorientable_count,
                     f->is_closed,
                     f->is_consistent};
}

static inline void check_counts(const char *what, counted a, counted b) {
    CHECK(a.triangles == b.triangles && a.degenerate == b.degenerate &&
              a.duplicate == b.duplicate && a.vertices == b.vertices,
          "%s: %zu triangles, %zu degenerate, %zu duplicate, %zu vertices", what, a.triangles,
          a.degenerate, a.duplicate, a.vertices);
    CHECK(a.edges == b.edges && a.open == b.open && a.non_manifold == b.non_manifold &&
              a.inconsistent == b.inconsistent,
          "%s: %zu edges, %zu open, %zu non-manifold, %zu inconsistent", what, a.edges, a.open,
          a.non_manifold, a.inconsistent);
    CHECK(a.shells == b.shells && a.flipped == b.flipped && a.unorientable == b.unorientable &&
              a.closed == b.closed && a.consistent == b.consistent,
          "%s: %zu shells, %zu flipped, %zu unorientable, closed %d, consistent %d", what, a.shells,
          a.flipped, a.unorientable, a.closed, a.consistent);
}

static inline burnish_mesh_facts measure_as(const char *what, const shape *s, counted expected) {
    const burnish_mesh_facts facts = measure(s);
    check_counts(what, count_facts(&facts), expected);
    return facts;
}

static inline void check_near(const char *what, double value, double expected, double tolerance) {
    CHECK(fabs(value - expected) <= tolerance, "%s: %.17g, not %.17g", what, value, expected);
}

static inline void check_center(const char *what, const burnish_mesh_facts *facts, double x,
                                double y, double z, double tolerance) {
    check_near(what, facts->center_of_mass[0], x, tolerance);
    check_near(what, facts->center_of_mass[1], y, tolerance);
    check_near(what, facts->center_of_mass[2], z, tolerance);
}

/* Of a box. */
static const counted whole_box = {
    .triangles = 12, .vertices = 8, .edges = 18, .shells = 1, .closed = 1, .consistent = 1};

#endif
