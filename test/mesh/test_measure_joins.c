/* Facts of surfaces whose vertices differ by rounding: joined within a millionth of the longest
 * side. */
#include "shapes.h"

enum { CORNERS = 36 };

/* A box without shared vertices: each corner of each triangle moves by its own offset, at most
 * `jitter` along each axis. `count` boxes, one after another. */
typedef struct soup {
    float points[3 * 2 * CORNERS];
    size_t corner_count;
} soup;

static soup jittered_box(const double low[3], const double high[3], double jitter,
                         uint64_t *random) {
    shape s = {.point_count = 0};
    soup out = {.corner_count = CORNERS};
    add_box(&s, low, high);
    for (size_t i = 0; i < 3 * (size_t)CORNERS; ++i) {
        const double at = (double)s.points[3 * s.corners[i / 3] + i % 3];
        out.points[i] = (float)(at + test_uniform(random, -jitter, jitter));
    }
    return out;
}

static burnish_mesh_facts measure_soup(const soup *s, int threads) {
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){s->points, s->corner_count, 0};
    return measure_arrays(&arrays, threads);
}

static const double low[3] = {0, 0, 0}, high[3] = {1, 0.75, 0.5};

/* In any cells of the grid: the surface is closed if the copies of a vertex are within the
 * tolerance of each other, and open if one is not. */
static void test_random(void) {
    uint64_t random = test_seed(1);
    for (int i = 0; i < 400; ++i) {
        double from[3], to[3];
        for (int k = 0; k < 3; ++k) {
            from[k] = test_uniform(&random, -1, 0);
            to[k] = from[k] + (k == 0 ? 1 : test_uniform(&random, 0.2, 0.9));
        }
        soup s = jittered_box(from, to, 4e-7, &random);
        burnish_mesh_facts f = measure_soup(&s, 1);
        CHECK(f.is_closed && f.is_consistent && f.is_solid && f.open_edge_count == 0 &&
                  f.shell_count == 1 && f.edge_count == 18,
              "box %d: closed %d, %zu open edges", i, f.is_closed, f.open_edge_count);
        CHECK(fabs(f.join_tolerance - 1e-6) < 2e-12 && f.exact_open_edge_count > 18,
              "box %d: within %g, %zu before", i, f.join_tolerance, f.exact_open_edge_count);
        CHECK(f.vertex_count > 30, "%zu vertices", f.vertex_count);
        s.points[3 * (i % CORNERS) + i % 3] += i % 2 ? 2.2e-6f : -2.2e-6f;
        f = measure_soup(&s, 1);
        CHECK(!f.is_closed && f.join_tolerance == 0 && f.exact_open_edge_count == 0 &&
                  f.open_edge_count > 18,
              "box %d: closed %d, within %g", i, f.is_closed, f.join_tolerance);
    }
}

/* The tolerance itself: one copy of a vertex moves along an axis. */
static void test_tolerance(void) {
    uint64_t random = test_seed(1);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 2; ++i) {
            soup s = jittered_box(low, high, 0, &random);
            s.points[k] -= i ? 1.01e-6f : 0.99e-6f; /* of the vertex at 0 */
            const burnish_mesh_facts f = measure_soup(&s, 1);
            CHECK(f.is_closed == !i && (f.join_tolerance > 0) == !i, "axis %d, %d: closed %d", k, i,
                  f.is_closed);
        }
    }
}

/* Equal positions: no tolerance is reported, and a hole stays open. */
static void test_exact(void) {
    uint64_t random = test_seed(1);
    soup s = jittered_box(low, high, 0, &random);
    burnish_mesh_facts f = measure_soup(&s, 1);
    CHECK1(f.is_closed && f.join_tolerance == 0 && f.exact_open_edge_count == 0);
    s = jittered_box(low, high, 1e-7, &random);
    s.corner_count -= 3; /* and rounding: the exact count is reported */
    f = measure_soup(&s, 1);
    CHECK(!f.is_closed && f.join_tolerance == 0 && f.open_edge_count > 3, "%zu open",
          f.open_edge_count);
}

/* Two sheets closer than the tolerance enclose nothing. */
static void test_flat(void) {
    uint64_t random = test_seed(1);
    const soup s = jittered_box(low, (double[]){1, 0.75, 0}, 2e-7, &random);
    const burnish_mesh_facts f = measure_soup(&s, 1);
    CHECK(!f.is_solid, "volume %g", f.volume);
}

/* Details as small as the tolerance are kept: a far triangle does not close a small box. */
static void test_details(void) {
    uint64_t random = test_seed(1);
    soup s = jittered_box(low, high, 1e-7, &random);
    for (int i = 0; i < 9; ++i) {
        s.points[3 * (CORNERS - 3) + i] = (float)(4e6 + 1e6 * (i / 3 == i % 3));
    }
    const burnish_mesh_facts f = measure_soup(&s, 1);
    CHECK(!f.is_closed && f.join_tolerance == 0, "closed %d within %g", f.is_closed,
          f.join_tolerance);
}

/* Unused vertices may be anywhere. The undefined behaviour sanitizer detects errors. */
static void test_unused(void) {
    uint64_t random = test_seed(1);
    const soup s = jittered_box(low, high, 3e-7, &random);
    float points[3 * (CORNERS + 1)];
    uint32_t corners[CORNERS];
    burnish_mesh_description arrays = burnish_mesh_description_default();
    memcpy(points, s.points, sizeof points - 3 * sizeof *points);
    for (int i = 0; i < CORNERS; ++i) {
        corners[i] = (uint32_t)i;
    }
    points[3 * CORNERS] = points[3 * CORNERS + 1] = points[3 * CORNERS + 2] = 1e30f;
    arrays.positions = (burnish_array){points, CORNERS + 1, 0};
    arrays.indices = (burnish_array){corners, CORNERS, 0};
    CHECK1(measure_arrays(&arrays, 1).is_closed);
}

static void test_threads(void) {
    uint64_t random = test_seed(1);
    const soup s = jittered_box(low, high, 3e-7, &random);
    const burnish_mesh_facts one = measure_soup(&s, 1), other = measure_soup(&s, 7);
    CHECK1(one.join_tolerance > 0 && memcmp(&one, &other, sizeof one) == 0);
}

/* A cut of such a box is filled. */
static void test_cut(void) {
    uint64_t random = test_seed(1);
    const soup s = jittered_box(low, high, 3e-7, &random);
    const burnish_clip_plane plane = {{0, 0, 1}, 0.25};
    burnish_mesh_description arrays = burnish_mesh_description_default();
    burnish_load_options options = burnish_load_options_default();
    options.measure = 1;
    arrays.positions = (burnish_array){s.points, s.corner_count, 0};
    OWNED_MESH *mesh = create_mesh(&arrays, &options);
    CHECK1(burnish_mesh_clip(mesh, &plane, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_mesh_get_view(mesh)->inside == BURNISH_INSIDE_BACK);
}

/* 600,000 vertices in few cells: comparing all pairs would take minutes. */
static void test_crowd(double side) {
    enum { TRIANGLES = 200000 };
    float *points = malloc(9 * TRIANGLES * sizeof *points);
    uint64_t random = test_seed(1);
    if (!points) {
        abort();
    }
    for (size_t i = 0; i < 9 * TRIANGLES; ++i) {
        points[i] = (float)test_uniform(&random, 0, side);
    }
    points[0] = 1e6f; /* the tolerance is 1 */
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){points, 3 * TRIANGLES, 0};
    const burnish_mesh_facts f = measure_arrays(&arrays, 1);
    CHECK(!f.is_closed && f.join_tolerance == 0 && f.open_edge_count > 2 * TRIANGLES, "%zu open",
          f.open_edge_count);
    free(points);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_random());
    RUN(test_tolerance());
    RUN(test_exact());
    RUN(test_flat());
    RUN(test_details());
    RUN(test_unused());
    RUN(test_threads());
    RUN(test_cut());
    RUN(test_crowd(0.5));
    RUN(test_crowd(3));
    return test_end("measure_joins");
}
