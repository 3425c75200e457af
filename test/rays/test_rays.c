/* Rays against triangles: hits as double precision finds them, closed surfaces that no ray leaves, one
 * tree whatever the threads, one result whatever the instruction set, and meshes made to be slow. */
#include <math.h>
#include <string.h>

#include "rays/rays.h"
#include "support.h"

enum { RAYS = 20000, TRIANGLES_MAX = 100000, SIDE = 96 };

static uint64_t state;
static float positions[9 * TRIANGLES_MAX];
static uint32_t indices[3 * TRIANGLES_MAX];
static float origins[3][RAYS], directions[3][RAYS], reaches[RAYS], hits[RAYS], others[RAYS];
static float distances[2][RAYS];
static int32_t places[2][RAYS];

static burnish_status build(burnish_ray_tree *tree, size_t vertices, size_t triangles, int threads,
                            double most_work) {
    static uint64_t serial;
    burnish_error error;
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_tasks tasks;
    const burnish_mesh_view view = {.positions = positions,
                                    .vertex_count = vertices,
                                    .indices = indices,
                                    .triangle_count = triangles,
                                    .serial = ++serial};
    const burnish_ray_mesh mesh = {&view, NULL, {0, 0, 0}, 1, most_work};
    burnish_tasks_begin(&tasks, NULL, threads);
    return burnish_ray_tree_update(tree, &mesh, &tasks, &memory);
}

static void build_soup(burnish_ray_tree *tree, size_t triangles) {
    for (size_t i = 0; i < 3 * triangles; ++i) {
        indices[i] = (uint32_t)i;
    }
    CHECK1(build(tree, 3 * triangles, triangles, 1, 1e9) == BURNISH_STATUS_OK);
}

static void aim(int i, const double from[3], const double toward[3]) {
    const double length =
        sqrt(toward[0] * toward[0] + toward[1] * toward[1] + toward[2] * toward[2]);
    for (int k = 0; k < 3; ++k) {
        origins[k][i] = (float)from[k];
        directions[k][i] = (float)(toward[k] / length);
    }
    reaches[i] = 4;
}

/* Hits by every instruction set, which must agree. */
static void cast(const burnish_ray_tree *tree, int count) {
    const burnish_ray_batch rays = {{origins[0], origins[1], origins[2]},
                                    {directions[0], directions[1], directions[2]},
                                    reaches,
                                    (size_t)count};
    const burnish_ray_ops *scalar = burnish_ray_ops_for(BURNISH_ISA_SCALAR);
    scalar->find_hits(tree, &rays, hits, distances[0], places[0]);
    scalar->find_hits(tree, &rays, others, NULL, NULL);
    CHECK(memcmp(hits, others, (size_t)count * sizeof *hits) == 0, "hits differ from nearest");
    for (int isa = BURNISH_ISA_SCALAR + 1; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_ray_ops *ops = burnish_ray_ops_for((burnish_isa)isa);
        if (ops && burnish_isa_available() >> isa & 1) {
            ops->find_hits(tree, &rays, others, NULL, NULL);
            ops->find_hits(tree, &rays, others, distances[1], places[1]);
            CHECK(memcmp(hits, others, (size_t)count * sizeof *hits) == 0 &&
                      memcmp(distances[0], distances[1], (size_t)count * sizeof **distances) == 0 &&
                      memcmp(places[0], places[1], (size_t)count * sizeof **places) == 0,
                  "%s differs", burnish_isa_name((burnish_isa)isa));
        }
    }
}

/* ---- Against double precision ---- */

/* How surely ray i hits a triangle: below 0 by how much it misses. */
static double certainty(int i, const float *c, double *at) {
    double p[3][3], least = INFINITY, most = -INFINITY, sides[3], depth = 0, sum = 0;
    const double d[3] = {(double)directions[0][i], (double)directions[1][i],
                         (double)directions[2][i]};
    for (int k = 0; k < 9; ++k) {
        p[k / 3][k % 3] = (double)c[k] - (double)origins[k % 3][i];
    }
    for (int k = 0; k < 3; ++k) {
        const double *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
        sides[k] = d[0] * (a[1] * b[2] - a[2] * b[1]) + d[1] * (a[2] * b[0] - a[0] * b[2]) +
                   d[2] * (a[0] * b[1] - a[1] * b[0]);
        least = fmin(least, sides[k]);
        most = fmax(most, sides[k]);
        depth += sides[k] * (p[k][0] * d[0] + p[k][1] * d[1] + p[k][2] * d[2]);
        sum += sides[k];
    }
    const double inside = fmax(least, -most), distance = depth / sum;
    *at = distance;
    return fmin(inside, fmin(distance, (double)reaches[i] - distance) * fabs(sum));
}

static void test_random(int triangles, double size) {
    burnish_ray_tree tree = {0};
    int unsure = 0, hit = 0;
    for (int i = 0; i < triangles; ++i) {
        double middle[3];
        for (int k = 0; k < 9; ++k) {
            middle[k % 3] = k < 3 ? test_uniform(&state, -0.6, 0.6) : middle[k % 3];
            /* every fourth is a sliver */
            const double side = i % 4 == 0 && k < 3 ? size * 1e-4 : size;
            positions[9 * i + k] = (float)(middle[k % 3] + test_uniform(&state, -side, side));
        }
    }
    build_soup(&tree, (size_t)triangles);
    for (int i = 0; i < RAYS / 4; ++i) {
        double from[3], toward[3];
        for (int k = 0; k < 3; ++k) {
            from[k] = test_uniform(&state, -1, 1);
            toward[k] = i % 3 == k ? test_uniform(&state, 0.1, 1) : test_uniform(&state, -1, 1);
            toward[k] = i % 5 == 0 && i % 3 != k ? 0 : toward[k]; /* along an axis */
        }
        aim(i, from, toward);
        reaches[i] = i % 2 ? 4 : (float)test_uniform(&state, 0, 1);
    }
    cast(&tree, RAYS / 4);
    for (int i = 0; i < RAYS / 4; ++i) {
        double best = -INFINITY, nearest = 4, at;
        for (int t = 0; t < triangles; ++t) {
            const double sure = certainty(i, positions + 9 * t, &at);
            nearest = sure > 1e-5 && at < nearest ? at : nearest;
            best = fmax(best, sure);
        }
        CHECK(!(hits[i] > 0) || (double)distances[0][i] < nearest + 1e-5, "ray %d: %g, not %g", i,
              (double)distances[0][i], nearest);
        unsure += fabs(best) < 1e-5;
        hit += best > 0;
        CHECK(fabs(best) < 1e-5 || hits[i] == (float)(best > 0), "ray %d: hit %g, surely %g", i,
              (double)hits[i], best);
    }
    CHECK(hit > RAYS / 80 && unsure < RAYS / 40, "%d hits, %d unsure", hit, unsure);
    printf("rays: %d triangles, %d of %d hit, %.1f tests expected\n", triangles, hit, RAYS / 4,
           tree.work);
    burnish_ray_tree_destroy(&tree, NULL);
}

/* ---- A closed surface ---- */

/* A ball with bumps, whose poles are slivers; from within, rays meet it at corners, edges and
 * anywhere. */
static void make_ball(void) {
    for (int y = 0; y <= SIDE; ++y) {
        for (int x = 0; x < SIDE; ++x) {
            const double up = 3.14159265358979 * y / SIDE, turn = 6.28318530717959 * x / SIDE;
            const double radius = 0.7 + 0.1 * sin(5 * up) * cos(7 * turn);
            const double sine = y % SIDE == 0 ? 0 : sin(up);
            float *to = positions + 3 * (y * SIDE + x);
            to[0] = (float)(radius * sine * cos(turn));
            to[1] = (float)(radius * sine * sin(turn));
            to[2] = y % SIDE == 0 ? (y ? -0.7f : 0.7f) : (float)(radius * cos(up));
        }
    }
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const int x = i % SIDE, next = (x + 1) % SIDE, row = i - x;
        const int corners[] = {row + x,    row + next,        row + SIDE + x,
                               row + next, row + SIDE + next, row + SIDE + x};
        for (int k = 0; k < 6; ++k) {
            indices[6 * i + k] = (uint32_t)corners[k];
        }
    }
}

static void test_closed(void) {
    burnish_ray_tree tree = {0};
    make_ball();
    CHECK1(build(&tree, (SIDE + 1) * SIDE, 2 * SIDE * SIDE, 1, 1e9) == BURNISH_STATUS_OK);
    for (int i = 0; i < RAYS; ++i) {
        double from[3], toward[3];
        const uint32_t *t = indices + 3 * (test_random32(&state) % (2 * SIDE * SIDE));
        const double share = i % 2 ? 0 : test_uniform(&state, 0, 1);
        for (int k = 0; k < 3; ++k) {
            from[k] = (double)(float)test_uniform(&state, -0.3, 0.3);
            toward[k] = (double)positions[3 * t[0] + (uint32_t)k] * (1 - share) +
                        (double)positions[3 * t[1] + (uint32_t)k] * share - from[k];
        }
        aim(i, from, toward);
    }
    cast(&tree, RAYS);
    int out = 0;
    for (int i = 0; i < RAYS; ++i) {
        out += hits[i] == 0;
    }
    CHECK(out == 0, "%d of %d rays leave a closed surface", out, (int)RAYS);
    burnish_ray_tree_destroy(&tree, NULL);
}

static void test_threads(void) {
    burnish_ray_tree one = {0}, many = {0};
    for (int k = 0; k < 9 * TRIANGLES_MAX; ++k) {
        positions[k] = k % 9 < 3 ? (float)test_uniform(&state, -0.5, 0.5)
                                 : positions[k - 3] + (float)test_uniform(&state, 0, 0.01);
    }
    build_soup(&one, TRIANGLES_MAX);
    CHECK1(build(&many, 3 * TRIANGLES_MAX, TRIANGLES_MAX, 3, 1e9) == BURNISH_STATUS_OK);
    CHECK1(one.node_count == many.node_count && one.triangle_count == many.triangle_count);
    CHECK1(memcmp(one.nodes, many.nodes, one.node_count * sizeof *one.nodes) == 0);
    CHECK1(memcmp(one.triangles, many.triangles, one.triangle_count * sizeof *one.triangles) == 0);
    printf("rays: %d triangles have %zu nodes\n", (int)TRIANGLES_MAX, one.node_count);
    burnish_ray_tree_destroy(&one, NULL);
    burnish_ray_tree_destroy(&many, NULL);
}

/* ---- Meshes made to be slow ---- */

static int depth_below(const burnish_ray_tree *tree, uint32_t node, int side) {
    const burnish_ray_node *at = &tree->nodes[node];
    if (at->count[side] > 0) {
        return 1;
    }
    const int first = depth_below(tree, at->child[side], 0);
    const int second = depth_below(tree, at->child[side], 1);
    return 1 + (first > second ? first : second);
}

/* Each triangle half as large as the one before, so that every split takes one off. */
static void test_depth(void) {
    enum { COUNT = 120 };
    burnish_ray_tree tree = {0};
    for (int i = 0; i < COUNT; ++i) {
        const float size = ldexpf(0.5f, -i);
        const float corners[] = {size, 0, 0, size, size, 0, size, 0, size};
        memcpy(positions + 9 * i, corners, sizeof corners);
    }
    build_soup(&tree, COUNT);
    const int depth = depth_below(&tree, 0, 0), second = depth_below(&tree, 0, 1);
    CHECK(depth <= BURNISH_RAY_DEPTH && second <= BURNISH_RAY_DEPTH, "depth %d, %d", depth, second);
    aim(0, (const double[]){1, 0.1, 0.1}, (const double[]){-1, 0, 0});
    aim(1, (const double[]){1, -0.1, 0.1}, (const double[]){-1, 0, 0});
    cast(&tree, 2);
    CHECK1(hits[0] == 1 && hits[1] == 0);
    burnish_ray_tree_destroy(&tree, NULL);
}

/* Triangles at one place are one, in any order of their corners. */
static void test_coincident(void) {
    static const float corner[3][3] = {{-0.5f, 0, 0.5f}, {0.5f, 0, 0.25f}, {0, 0, -0.5f}};
    burnish_ray_tree tree = {0};
    for (int i = 0; i < TRIANGLES_MAX; ++i) {
        for (int k = 0; k < 3; ++k) {
            memcpy(positions + 9 * i + 3 * k, corner[(k + i) % 3], sizeof corner[0]);
        }
    }
    build_soup(&tree, TRIANGLES_MAX);
    CHECK(tree.node_count <= 2 * BURNISH_RAY_SPLITS && tree.work < 100, "%zu nodes, work %g",
          tree.node_count, tree.work);
    aim(0, (const double[]){0, 0.5, 0}, (const double[]){0, -1, 0});
    aim(1, (const double[]){0.4, 0.5, -0.4}, (const double[]){0, -1, 0});
    aim(2, (const double[]){-0.25, 0.5, 0}, (const double[]){0, -1, 0}); /* at an edge */
    cast(&tree, 3);
    CHECK1(hits[0] == 1 && hits[1] == 0 && hits[2] == 1);
    /* all different, all through the middle: what rays would take long for is refused */
    for (int i = 0; i < 9 * TRIANGLES_MAX; ++i) {
        positions[i] = i % 9 < 6 ? (float)test_uniform(&state, -0.5, 0.5)
                                 : -(positions[i - 3] + positions[i - 6]);
    }
    CHECK1(build(&tree, 3 * TRIANGLES_MAX, TRIANGLES_MAX, 1, 100) == BURNISH_STATUS_LIMIT);
    burnish_ray_tree_destroy(&tree, NULL);
}

static void test_few(void) {
    burnish_ray_tree tree = {0};
    static const float corners[] = {-0.5f, 0, -0.5f, 0.5f, 0, -0.5f, 0, 0, 0.5f};
    aim(0, (const double[]){0, 0.5, 0}, (const double[]){0, -1, 0});
    memcpy(positions, corners, sizeof corners);
    for (size_t count = 0; count < 2; ++count) {
        build_soup(&tree, count);
        cast(&tree, 1);
        CHECK(hits[0] == (float)count, "%zu triangles: hit %g", count, (double)hits[0]);
    }
    memcpy(positions + 6, positions + 3, 3 * sizeof *positions); /* of no area */
    build_soup(&tree, 1);
    CHECK1(tree.node_count == 0);
    burnish_ray_tree_destroy(&tree, NULL);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    state = test_seed(31);
    RUN(test_few());
    RUN(test_random(300, 0.3));
    RUN(test_random(2000, 0.05));
    RUN(test_closed());
    RUN(test_threads());
    RUN(test_depth());
    RUN(test_coincident());
    return test_end("rays");
}
