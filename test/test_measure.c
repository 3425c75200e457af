/* burnish_mesh_get_facts: closed forms, shapes whose edges are counted by hand, random triangles
 * against a plain count, the same bits for any number of threads. */
#include <math.h>

#include "mesh_arrays.h"
#include "support.h"

enum { POINTS_MAX = 64, TRIANGLES_MAX = 160 };

static const double pi = 3.14159265358979323846;

/* Triangles on their way to a mesh. */
typedef struct shape {
    float points[3 * POINTS_MAX];
    uint32_t corners[3 * TRIANGLES_MAX];
    size_t point_count, triangle_count;
} shape;

static void add_point(shape *s, double x, double y, double z) {
    float *to = s->points + 3 * s->point_count++;
    to[0] = (float)x;
    to[1] = (float)y;
    to[2] = (float)z;
}

static void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c) {
    memcpy(s->corners + 3 * s->triangle_count++, (uint32_t[]){a, b, c}, 12);
}

/* Counter-clockwise seen from outside: a, b, c, d. */
static void add_quad(shape *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    add_triangle(s, a, b, c);
    add_triangle(s, a, c, d);
}

/* Triangles in the order -x, +x, -y, +y, -z, +z, two each. */
static void add_box(shape *s, const double low[3], const double high[3]) {
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

static shape box_at(double x, double y, double z, double a, double b, double c) {
    shape s = {.point_count = 0};
    add_box(&s, (double[]){x, y, z}, (double[]){x + a, y + b, z + c});
    return s;
}

static void turn(shape *s, size_t triangle) {
    uint32_t *corners = s->corners + 3 * triangle, second = corners[1];
    corners[1] = corners[2];
    corners[2] = second;
}

static burnish_mesh_facts measure_arrays(const burnish_mesh_description *arrays, int threads) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_facts facts = {0};
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    options.measure = 1;
    options.threads = threads;
    if (CHECK(burnish_mesh_create(arrays, &options, &mesh, &error) == BURNISH_STATUS_OK, "%s",
              error.text) &&
        CHECK1(burnish_mesh_get_facts(mesh))) {
        facts = *burnish_mesh_get_facts(mesh);
    }
    burnish_mesh_destroy(mesh);
    return facts;
}

static burnish_mesh_facts measure(const shape *s) {
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

static counted count_facts(const burnish_mesh_facts *f) {
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

static void check_counts(const char *what, counted a, counted b) {
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

static void check_near(const char *what, double value, double expected, double tolerance) {
    CHECK(fabs(value - expected) <= tolerance, "%s: %.17g, not %.17g", what, value, expected);
}

static void check_center(const char *what, const burnish_mesh_facts *facts, double x, double y,
                         double z, double tolerance) {
    check_near(what, facts->center_of_mass[0], x, tolerance);
    check_near(what, facts->center_of_mass[1], y, tolerance);
    check_near(what, facts->center_of_mass[2], z, tolerance);
}

/* ---- Boxes ---- */

static const counted whole_box = {
    .triangles = 12, .vertices = 8, .edges = 18, .shells = 1, .closed = 1, .consistent = 1};

static void test_box(void) {
    shape s = box_at(1, 2, 3, 1, 2, 4);
    burnish_mesh_facts f = measure(&s);
    check_counts("a box", count_facts(&f), whole_box);
    CHECK1(f.is_solid && f.volume == 8 && f.area == 28);
    check_center("a box", &f, 1.5, 3, 5, 0);
    for (size_t i = 0; i < 12; ++i) {
        turn(&s, i);
    }
    f = measure(&s);
    check_counts("inside out", count_facts(&f), whole_box);
    CHECK1(f.is_solid && f.volume == -8 && f.area == 28);
    check_center("inside out", &f, 1.5, 3, 5, 0);
}

/* Digits that sums from the origin would lose: the volume of a tetrahedron from there is 1e20. */
static void test_far_box(void) {
    const shape s = box_at(1 << 23, -(1 << 23), 1 << 22, 1, 2, 3);
    const burnish_mesh_facts f = measure(&s);
    CHECK(f.volume == 6 && f.area == 22, "volume %.17g, area %.17g", f.volume, f.area);
    check_center("far away", &f, (1 << 23) + 0.5, 1 - (1 << 23), (1 << 22) + 1.5, 0);
}

/* The largest and the smallest floats. */
static void test_extreme_boxes(void) {
    const double large = 0x1p127, small = 0x1p-149;
    shape s = box_at(-large, -large, -large, 2 * large - 0x1p104, 2 * large - 0x1p104,
                     2 * large - 0x1p104);
    burnish_mesh_facts f = measure(&s);
    check_near("large", f.volume / 0x1p384, 1, 1e-6);
    check_center("large", &f, 0, 0, 0, 0x1p104);
    s = box_at(0, 0, 0, 2 * small, 2 * small, 2 * small);
    f = measure(&s);
    CHECK(f.is_solid && f.volume == 8 * small * small * small, "small: %g", f.volume);
    check_center("small", &f, small, small, small, 0);
}

static void test_open_box(void) {
    shape s = box_at(0, 0, 0, 1, 1, 1);
    s.triangle_count -= 2; /* without its lid, +z */
    const burnish_mesh_facts f = measure(&s);
    counted expected = whole_box;
    expected.triangles = 10;
    expected.edges = 17;
    expected.open = 4;
    expected.closed = 0;
    check_counts("an open box", count_facts(&f), expected);
    CHECK(!f.is_solid && f.area == 5, "area %g", f.area);
    check_center("an open box", &f, 0.5, 0.5, 0.4, 1e-15); /* four sides at 0.5, the floor at 0 */
}

static void test_flipped(void) {
    counted expected = whole_box;
    shape s = box_at(0, 0, 0, 1, 1, 1);
    turn(&s, 4);
    burnish_mesh_facts f = measure(&s);
    expected.inconsistent = 3;
    expected.flipped = 1;
    expected.consistent = 0;
    check_counts("a flipped triangle", count_facts(&f), expected);
    CHECK1(!f.is_solid && f.area == 6);
    for (size_t i = 0; i < 12; ++i) {
        turn(&s, i);
    }
    f = measure(&s);
    check_counts("all but one flipped", count_facts(&f), expected);
    turn(&s, 5);
    f = measure(&s);
    expected.inconsistent = 4;
    expected.flipped = 2;
    check_counts("all but a face flipped", count_facts(&f), expected);
}

/* Loading turns triangles to their normals; the facts are of those that were given. */
static void test_normals(void) {
    shape s = box_at(-1, -1, -1, 2, 2, 2);
    turn(&s, 0);
    burnish_mesh_description arrays =
        describe_arrays(s.points, s.points, NULL, s.point_count, s.corners, s.triangle_count);
    burnish_mesh_facts f = measure_arrays(&arrays, 1);
    CHECK(f.flipped_count == 1 && f.inconsistent_edge_count == 3, "%zu flipped", f.flipped_count);
    float inward[24];
    for (int i = 0; i < 24; ++i) {
        inward[i] = -s.points[i];
    }
    turn(&s, 0);
    arrays.normals.items = inward;
    f = measure_arrays(&arrays, 1);
    CHECK(f.volume == 8 && f.is_consistent, "volume %g", f.volume);
}

/* ---- Shapes that meet ---- */

static void test_touching(void) {
    shape s = box_at(0, 0, 0, 1, 1, 1);
    counted expected = {.triangles = 24,
                        .vertices = 14,
                        .edges = 35,
                        .non_manifold = 1,
                        .shells = 1,
                        .closed = 1,
                        .consistent = 1};
    add_box(&s, (double[]){1, 1, 0}, (double[]){2, 2, 1});
    burnish_mesh_facts f = measure(&s);
    check_counts("two boxes at an edge", count_facts(&f), expected);
    CHECK1(f.is_solid && f.volume == 2);
    check_center("two boxes at an edge", &f, 1, 1, 0.5, 1e-15);
    s = box_at(0, 0, 0, 1, 1, 1);
    add_box(&s, (double[]){1, 1, 1}, (double[]){2, 2, 2});
    f = measure(&s);
    expected.vertices = 15;
    expected.edges = 36;
    expected.non_manifold = 0;
    expected.shells = 2;
    check_counts("two boxes at a vertex", count_facts(&f), expected);
    s = box_at(0, 0, 0, 4, 4, 4);
    add_box(&s, (double[]){1, 1, 1}, (double[]){2, 2, 2});
    f = measure(&s);
    expected.vertices = 16;
    check_counts("a box inside a box", count_facts(&f), expected);
    CHECK1(f.volume == 65);
    for (size_t i = 12; i < 24; ++i) {
        turn(&s, i);
    }
    f = measure(&s);
    check_counts("a cavity", count_facts(&f), expected);
    CHECK(f.volume == 63, "volume %g", f.volume);
    check_center("a cavity", &f, 126.5 / 63, 126.5 / 63, 126.5 / 63, 1e-15);
}

/* Three sheets at one edge, and a wall that divides a box in two. */
static void test_junctions(void) {
    shape s = {.point_count = 0};
    for (int i = 0; i < 4; ++i) { /* the common edge is 0, 1 */
        static const double ends[4][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}};
        add_point(&s, ends[i][0], ends[i][1], 0);
        add_point(&s, ends[i][0], ends[i][1], 1);
    }
    for (uint32_t i = 1; i < 4; ++i) {
        add_quad(&s, 0, 2 * i, 2 * i + 1, 1);
    }
    burnish_mesh_facts f = measure(&s);
    check_counts("a T", count_facts(&f),
                 (counted){.triangles = 6,
                           .vertices = 8,
                           .edges = 13,
                           .open = 9,
                           .non_manifold = 1,
                           .shells = 1,
                           .consistent = 1});
    s = box_at(0, 0, 0, 1, 1, 1);
    add_quad(&s, 0, 1, 7, 6); /* from the edge at the lower front to that at the upper back */
    f = measure(&s);
    CHECK(f.non_manifold_edge_count == 4 && f.open_edge_count == 0 && !f.is_closed && !f.is_solid,
          "a wall: %zu non-manifold, %zu open, closed %d", f.non_manifold_edge_count,
          f.open_edge_count, f.is_closed);
}

static void test_moebius(void) {
    enum { STEPS = 12 };
    shape s = {.point_count = 0};
    for (int i = 0; i < STEPS; ++i) {
        const double turn_angle = 2 * pi * i / STEPS, tilt = turn_angle / 2;
        for (int side = -1; side <= 1; side += 2) {
            const double r = 3 + side * cos(tilt);
            add_point(&s, r * cos(turn_angle), r * sin(turn_angle), side * sin(tilt));
        }
    }
    for (uint32_t i = 0; i < STEPS; ++i) {
        const uint32_t a = 2 * i, b = (2 * i + 2) % (2 * STEPS), swap = i + 1 == STEPS;
        add_quad(&s, a, b + swap, b + 1 - swap, a + 1);
    }
    const burnish_mesh_facts f = measure(&s);
    check_counts("a Moebius strip", count_facts(&f),
                 (counted){.triangles = 24,
                           .vertices = 24,
                           .edges = 48,
                           .open = 24,
                           .inconsistent = 1,
                           .shells = 1,
                           .unorientable = 1});
}

/* ---- Triangles that are no use ---- */

static void test_degenerate(void) {
    /* A box whose edge from 0 to 1 has a middle that only the front knows: the slit is closed by a
     * triangle without area. */
    shape s = box_at(0, 0, 0, 1, 1, 1);
    counted expected = whole_box;
    add_point(&s, 0.5, 0, 0);
    memcpy(s.corners + 12, (uint32_t[]){0, 8, 5}, 12); /* the front's 0 1 5 */
    add_triangle(&s, 8, 1, 5);
    burnish_mesh_facts f = measure(&s);
    CHECK(f.open_edge_count == 3 && !f.is_closed, "%zu open", f.open_edge_count);
    add_triangle(&s, 8, 0, 1);
    f = measure(&s);
    expected.triangles = 14;
    expected.degenerate = 1;
    expected.vertices = 9;
    expected.edges = 21;
    check_counts("a slit that is filled", count_facts(&f), expected);
    CHECK1(f.is_solid && f.volume == 1 && f.area == 6);
    add_triangle(&s, 3, 3, 2);
    add_triangle(&s, 2, 2, 2);
    expected.triangles = 16;
    expected.degenerate = 3;
    f = measure(&s);
    check_counts("corners that repeat", count_facts(&f), expected);
}

static void test_duplicates(void) {
    shape s = box_at(0, 0, 0, 1, 1, 1);
    counted expected = whole_box;
    add_triangle(&s, s.corners[1], s.corners[2], s.corners[0]);
    burnish_mesh_facts f = measure(&s);
    expected.triangles = 13;
    expected.duplicate = 1;
    expected.non_manifold = 3;
    expected.closed = 0;
    check_counts("a triangle again", count_facts(&f), expected);
    add_triangle(&s, s.corners[0], s.corners[2], s.corners[1]);
    f = measure(&s);
    expected.triangles = 14;
    expected.duplicate = 2;
    expected.closed = 1;
    check_counts("and turned", count_facts(&f), expected);
    CHECK1(f.volume == 1);
    /* There and back: a closed surface without an inside. */
    s = (shape){.point_count = 0};
    add_point(&s, 0, 0, 0);
    add_point(&s, 3, 0, 0);
    add_point(&s, 0, 3, 0);
    add_triangle(&s, 0, 1, 2);
    add_triangle(&s, 0, 2, 1);
    f = measure(&s);
    CHECK1(f.duplicate_count == 1 && f.is_closed && f.is_consistent && !f.is_solid);
    CHECK1(f.volume == 0 && f.area == 9);
    check_center("a sheet", &f, 1, 1, 0, 1e-15);
}

/* ---- Random triangles against a plain count ---- */

/* Whether a triangle goes from a to b: 1, from b to a: -1, or has no such edge: 0. */
static int runs(const uint32_t t[3], uint32_t a, uint32_t b) {
    for (int k = 0; k < 3; ++k) {
        if (t[k] == a && t[(k + 1) % 3] == b) {
            return 1;
        }
        if (t[k] == b && t[(k + 1) % 3] == a) {
            return -1;
        }
    }
    return 0;
}

/* Walks from one triangle across edges, of any number of triangles or of two; sides: which way each
 * is to be turned, 0: not reached. Returns 1 where ways disagree. */
static int walk(const shape *s, int only_two, size_t from, int *sides) {
    int disagree = 0, grown = 1;
    sides[from] = 1;
    while (grown) {
        grown = 0;
        for (uint32_t a = 0; a < s->point_count; ++a) {
            for (uint32_t b = a + 1; b < s->point_count; ++b) {
                size_t with[TRIANGLES_MAX], count = 0;
                for (size_t i = 0; i < s->triangle_count; ++i) {
                    const uint32_t *t = s->corners + 3 * i;
                    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0] && runs(t, a, b)) {
                        with[count++] = i;
                    }
                }
                for (size_t i = 0; i < count && (count == 2 || !only_two); ++i) {
                    for (size_t j = 0; j < count; ++j) {
                        const int same = runs(s->corners + 3 * with[i], a, b) ==
                                         runs(s->corners + 3 * with[j], a, b);
                        const int side = same ? -sides[with[i]] : sides[with[i]];
                        if (i != j && side != 0) {
                            disagree |= sides[with[j]] == -side;
                            grown |= sides[with[j]] == 0;
                            sides[with[j]] = sides[with[j]] ? sides[with[j]] : side;
                        }
                    }
                }
            }
        }
    }
    return disagree;
}

static void count_sets(const shape *s, counted *c) {
    int shells[TRIANGLES_MAX] = {0}, sets[TRIANGLES_MAX] = {0};
    for (size_t i = 0; i < s->triangle_count; ++i) {
        const uint32_t *t = s->corners + 3 * i;
        int sides[TRIANGLES_MAX] = {0};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            continue;
        }
        if (!shells[i]) {
            walk(s, 0, i, shells);
            ++c->shells;
        }
        if (!sets[i]) {
            size_t turned = 0, size = 0;
            const int disagree = walk(s, 1, i, sides);
            for (size_t k = 0; k < s->triangle_count; ++k) {
                sets[k] |= sides[k];
                size += sides[k] != 0;
                turned += sides[k] < 0;
            }
            c->unorientable += (size_t)disagree;
            c->flipped += disagree ? 0 : turned < size - turned ? turned : size - turned;
        }
    }
}

static counted count_plainly(const shape *s) {
    counted c = {.triangles = s->triangle_count, .closed = 1, .consistent = 1};
    int used[POINTS_MAX] = {0};
    for (size_t i = 0; i < s->triangle_count; ++i) {
        const uint32_t *t = s->corners + 3 * i;
        const int repeats = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        int again = 0;
        for (size_t k = 0; k < i && !repeats; ++k) {
            const uint32_t *u = s->corners + 3 * k;
            again |= runs(u, t[0], t[1]) && runs(u, t[1], t[2]) && runs(u, t[2], t[0]);
        }
        used[t[0]] = used[t[1]] = used[t[2]] = 1;
        c.degenerate += (size_t)repeats;
        c.duplicate += (size_t)again;
    }
    for (uint32_t a = 0; a < s->point_count; ++a) {
        c.vertices += (size_t)used[a];
        for (uint32_t b = a + 1; b < s->point_count; ++b) {
            size_t count = 0, forward = 0;
            for (size_t i = 0; i < s->triangle_count; ++i) {
                const uint32_t *t = s->corners + 3 * i;
                const int way = t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ? 0 : runs(t, a, b);
                count += way != 0;
                forward += way > 0;
            }
            c.edges += count > 0;
            c.open += count == 1;
            c.non_manifold += count > 2;
            c.closed &= count % 2 == 0;
            c.inconsistent += count % 2 == 0 && 2 * forward != count;
        }
    }
    c.consistent = c.inconsistent == 0;
    count_sets(s, &c);
    return c;
}

/* Few points for many triangles: every kind of edge. No three points are in a line. */
static void test_random(void) {
    uint64_t state = test_seed(71);
    for (int round = 0; round < 400; ++round) {
        shape s = {.point_count = 0};
        char what[32];
        const size_t points = 3 + test_random32(&state) % 12;
        const size_t triangles = 1 + test_random32(&state) % 24;
        for (size_t i = 0; i < points; ++i) {
            add_point(&s, (double)i, (double)(i * i), (double)(i * i * i));
        }
        add_triangle(&s, 0, 1, 2); /* one has area */
        while (s.triangle_count < triangles) {
            add_triangle(&s, test_random32(&state) % (uint32_t)points,
                         test_random32(&state) % (uint32_t)points,
                         test_random32(&state) % (uint32_t)points);
        }
        const burnish_mesh_facts f = measure(&s);
        snprintf(what, sizeof what, "round %d", round);
        check_counts(what, count_facts(&f), count_plainly(&s));
    }
}

/* 50,000 triangles around one edge, in no order, each of them twice. */
static void test_one_edge(void) {
    enum { HALF = 50000, COUNT = 2 * HALF };
    static float points[3 * (HALF + 2)];
    static uint32_t corners[3 * COUNT];
    points[2] = 1; /* 0 and 1 are the edge */
    for (uint32_t i = 0; i < HALF; ++i) {
        float *p = points + 3 * (i + 2);
        p[0] = (float)cos(2 * pi * i / HALF);
        p[1] = (float)sin(2 * pi * i / HALF);
        p[2] = (float)i;
        const uint32_t at = (uint32_t)((uint64_t)i * 31337 % HALF), end = i + 2;
        memcpy(corners + 3 * at, (uint32_t[]){0, 1, end}, 12);
        memcpy(corners + 3 * (HALF + i), (uint32_t[]){end, 1, 0}, 12);
    }
    const burnish_mesh_description arrays =
        describe_arrays(points, NULL, NULL, HALF + 2, corners, COUNT);
    const burnish_mesh_facts f = measure_arrays(&arrays, 2);
    check_counts("one edge", count_facts(&f),
                 (counted){.triangles = COUNT,
                           .duplicate = HALF,
                           .vertices = HALF + 2,
                           .edges = 2 * HALF + 1,
                           .non_manifold = 1,
                           .shells = 1,
                           .closed = 1,
                           .consistent = 1});
}

/* ---- Built-in objects ---- */

static burnish_mesh *load(const char *name, int tessellation, int threads) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    options.measure = 1;
    options.tessellation = tessellation;
    options.threads = threads;
    CHECK(burnish_mesh_load(name, &options, &mesh, &error) == BURNISH_STATUS_OK, "%s", error.text);
    return mesh;
}

static burnish_mesh_facts facts_of(const char *name, int tessellation) {
    burnish_mesh *mesh = load(name, tessellation, 1);
    const burnish_mesh_facts facts = *burnish_mesh_get_facts(mesh);
    burnish_mesh_destroy(mesh);
    return facts;
}

/* The limit of a value whose error falls with the square of the tessellation. */
static double limit(double coarse, double fine) {
    return (4 * fine - coarse) / 3;
}

/* Against the smooth shape; what is left is the floats' rounding and the fourth power. */
static void check_smooth(const char *name, double area, double volume) {
    const burnish_mesh_facts a = facts_of(name, 32), b = facts_of(name, 64);
    check_near(name, limit(a.area, b.area) / area, 1, 2e-6);
    check_near(name, limit(a.volume, b.volume) / volume, 1, 2e-6);
    CHECK(b.is_solid && b.shell_count == 1 && b.open_edge_count == 0 && b.degenerate_count == 0,
          "%s: solid %d, %zu shells", name, b.is_solid, b.shell_count);
    check_center(name, &b, 0, 0, 0, 1e-7);
}

/* Of the knot's middle line, |p'(a)|^2 = 9 + 4 (2 + cos 3a)^2 over a turn: the trapezoid rule
 * converges faster than any power. */
static double knot_length(void) {
    enum { STEPS = 3000 };
    double length = 0;
    for (int i = 0; i < STEPS; ++i) {
        const double distance = 2 + cos(2 * pi * 3 * i / STEPS);
        length += sqrt(9 + 4 * distance * distance);
    }
    return length * 2 * pi / STEPS;
}

static void test_builtin(void) {
    check_smooth(":sphere", 4 * pi, 4 * pi / 3);
    check_smooth(":torus", 4 * pi * pi * 0.4, 2 * pi * pi * 0.16);
    /* A tube of constant radius: circumference and cross-section times length (Pappus). */
    check_smooth(":knot", 2 * pi * 0.6 * knot_length(), pi * 0.36 * knot_length());
    const burnish_mesh_facts f = facts_of(":teapot", 16);
    /* body, lid, handle and spout; two borders of body and lid, and the ends of the others */
    CHECK(f.shell_count == 4 && f.open_edge_count == 256 && !f.is_closed && f.is_consistent,
          "%zu shells, %zu open", f.shell_count, f.open_edge_count);
}

/* The polyhedron that the torus is: flat trapezoids between circles of 8 n, and polygons of 4 n. */
static void test_torus(void) {
    enum { N = 8, NI = 8 * N, NJ = 4 * N };
    const burnish_mesh_facts f = facts_of(":torus", N);
    const double half = pi / NI;
    double area = 0;
    for (int j = 0; j < NJ; ++j) {
        const double a = 2 * pi * j / NJ, b = 2 * pi * (j + 1) / NJ;
        const double inner = 1 + 0.4 * cos(a), outer = 1 + 0.4 * cos(b);
        area += NI * (inner + outer) * sin(half) *
                hypot((outer - inner) * cos(half), 0.4 * (sin(b) - sin(a)));
    }
    const double section = NJ * 0.16 / 2 * sin(2 * pi / NJ);
    check_near("the torus' area", f.area / area, 1, 1e-7);
    check_near("the torus' volume", f.volume / (NI * sin(2 * half) * section), 1, 1e-7);
    CHECK1(f.vertex_count == NI * NJ && f.edge_count == 3 * NI * NJ);
}

/* All digits: sums of the same triangles in long double, from the origin. */
static void check_sums(const char *name) {
    burnish_mesh *mesh = load(name, 16, 1);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_facts *f = burnish_mesh_get_facts(mesh);
    long double area = 0, volume = 0, center[3] = {0};
    for (size_t i = 0; i < view->triangle_count; ++i) {
        const float *p[3];
        long double u[3], v[3], n[3], six = 0;
        for (int k = 0; k < 3; ++k) {
            p[k] = view->positions + 3 * (size_t)view->indices[3 * i + (size_t)k];
        }
        for (int k = 0; k < 3; ++k) {
            u[k] = (long double)p[1][k] - p[0][k];
            v[k] = (long double)p[2][k] - p[0][k];
        }
        for (int k = 0; k < 3; ++k) {
            n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
            six += n[k] * p[0][k];
        }
        area += sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
        volume += six / 6;
        for (int k = 0; k < 3; ++k) {
            center[k] += six / 24 * ((long double)p[0][k] + p[1][k] + p[2][k]);
        }
    }
    check_near(name, f->area / (double)area, 1, 4e-16);
    check_near(name, f->volume / (double)volume, 1, 4e-16);
    for (int k = 0; k < 3; ++k) {
        check_near(name, f->center_of_mass[k], (double)(center[k] / volume), 1e-15);
    }
    burnish_mesh_destroy(mesh);
}

static void test_threads(void) {
    static const int threads[] = {2, 7};
    burnish_mesh *one = load(":knot", 48, 1);
    for (int i = 0; i < 2; ++i) {
        burnish_mesh *other = load(":knot", 48, threads[i]);
        CHECK(memcmp(burnish_mesh_get_facts(one), burnish_mesh_get_facts(other),
                     sizeof(burnish_mesh_facts)) == 0,
              "%d threads", threads[i]);
        burnish_mesh_destroy(other);
    }
    burnish_mesh_destroy(one);
}

static void test_unasked(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    CHECK1(!options.measure);
    CHECK1(burnish_mesh_load(":sphere", &options, &mesh, NULL) == BURNISH_STATUS_OK);
    CHECK1(!burnish_mesh_get_facts(mesh) && !burnish_mesh_get_facts(NULL));
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_box());
    RUN(test_far_box());
    RUN(test_extreme_boxes());
    RUN(test_open_box());
    RUN(test_flipped());
    RUN(test_normals());
    RUN(test_touching());
    RUN(test_junctions());
    RUN(test_moebius());
    RUN(test_degenerate());
    RUN(test_duplicates());
    RUN(test_random());
    RUN(test_one_edge());
    RUN(test_builtin());
    RUN(test_torus());
    RUN(check_sums(":sphere"));
    RUN(check_sums(":torus"));
    RUN(check_sums(":knot"));
    RUN(test_threads());
    RUN(test_unasked());
    return test_end("measure");
}
