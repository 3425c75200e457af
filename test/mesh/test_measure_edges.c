/* burnish_mesh_get_facts: shapes whose edges are counted by hand, random triangles against a plain
 * count. */
#include "shapes.h"

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
    burnish_mesh_facts f = measure_as("two boxes at an edge", &s, expected);
    CHECK1(f.is_solid && f.volume == 2);
    check_center("two boxes at an edge", &f, 1, 1, 0.5, 1e-15);
    s = box_at(0, 0, 0, 1, 1, 1);
    add_box(&s, (double[]){1, 1, 1}, (double[]){2, 2, 2});
    expected.vertices = 15;
    expected.edges = 36;
    expected.non_manifold = 0;
    expected.shells = 2;
    measure_as("two boxes at a vertex", &s, expected);
    s = box_at(0, 0, 0, 4, 4, 4);
    add_box(&s, (double[]){1, 1, 1}, (double[]){2, 2, 2});
    expected.vertices = 16;
    f = measure_as("a box inside a box", &s, expected);
    CHECK1(f.volume == 65);
    for (size_t i = 12; i < 24; ++i) {
        turn(&s, i);
    }
    f = measure_as("a cavity", &s, expected);
    CHECK(f.volume == 63, "volume %g", f.volume);
    check_center("a cavity", &f, 126.5 / 63, 126.5 / 63, 126.5 / 63, 1e-15);
}

static void test_moebius(void) {
    enum { STEPS = 12 };
    shape s = {.point_count = 0};
    for (int i = 0; i < STEPS; ++i) {
        const double turn_angle = 2 * TEST_PI * i / STEPS, tilt = turn_angle / 2;
        for (int side = -1; side <= 1; side += 2) {
            const double r = 3 + side * cos(tilt);
            add_point(&s, r * cos(turn_angle), r * sin(turn_angle), side * sin(tilt));
        }
    }
    for (uint32_t i = 0; i < STEPS; ++i) {
        const uint32_t a = 2 * i, b = (2 * i + 2) % (2 * STEPS), swap = i + 1 == STEPS;
        add_quad(&s, a, b + swap, b + 1 - swap, a + 1);
    }
    measure_as("a Moebius strip", &s,
               (counted){.triangles = 24,
                         .vertices = 24,
                         .edges = 48,
                         .open = 24,
                         .inconsistent = 1,
                         .shells = 1,
                         .unorientable = 1});
}

/* ---- Degenerate triangles ---- */

static void test_degenerate(void) {
    /* A box whose edge from 0 to 1 has a middle vertex only in the front: a triangle without area
     * closes the slit. */
    shape s = box_at(0, 0, 0, 1, 1, 1);
    counted expected = whole_box;
    add_point(&s, 0.5, 0, 0);
    memcpy(s.corners + 12, (uint32_t[]){0, 8, 5}, 12); /* the front's 0 1 5 */
    add_triangle(&s, 8, 1, 5);
    burnish_mesh_facts f = measure(&s);
    CHECK(f.open_edge_count == 3 && !f.is_closed, "%zu open", f.open_edge_count);
    add_triangle(&s, 8, 0, 1);
    expected.triangles = 14;
    expected.degenerate = 1;
    expected.vertices = 9;
    expected.edges = 21;
    f = measure_as("a slit that is filled", &s, expected);
    CHECK1(f.is_solid && f.volume == 1 && f.area == 6);
    add_triangle(&s, 3, 3, 2);
    add_triangle(&s, 2, 2, 2);
    expected.triangles = 16;
    expected.degenerate = 3;
    measure_as("corners that repeat", &s, expected);
}

static void test_duplicates(void) {
    shape s = box_at(0, 0, 0, 1, 1, 1);
    counted expected = whole_box;
    add_triangle(&s, s.corners[1], s.corners[2], s.corners[0]);
    expected.triangles = 13;
    expected.duplicate = 1;
    expected.non_manifold = 3;
    expected.closed = 0;
    measure_as("a triangle again", &s, expected);
    add_triangle(&s, s.corners[0], s.corners[2], s.corners[1]);
    expected.triangles = 14;
    expected.duplicate = 2;
    expected.closed = 1;
    burnish_mesh_facts f = measure_as("and turned", &s, expected);
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

/* Walks from one triangle across edges, of any number of triangles or of two; sides: the direction
 * of each, 0: not reached. Returns 1 if directions disagree. */
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
        p[0] = (float)cos(2 * TEST_PI * i / HALF);
        p[1] = (float)sin(2 * TEST_PI * i / HALF);
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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_touching());
    RUN(test_moebius());
    RUN(test_degenerate());
    RUN(test_duplicates());
    RUN(test_random());
    RUN(test_one_edge());
    return test_end("measure_edges");
}
