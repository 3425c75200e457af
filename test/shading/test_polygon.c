/* Polygonal lights: values against the theory's closed forms in double precision, which
 * test_theory_polygon compares with quadrature, bits on all instruction sets and for all lengths, exact cases, refused arguments.
 *
 * --trials 3000 tries more lights and prints the largest errors. */
#include <math.h>
#include <stdint.h>

#include "burnish/kernels.h"
#include "burnish/theory.h"
#include "core/vec3.h"
#include "light_at.h"
#define BURNISH_VECTOR_SCALAR
#include "simd/vector_math.h"

/* ---- Reference ---- */

typedef burnish_vec3 vec;

static vec sum(vec a, double factor, vec b) {
    return burnish_vec3_add(a, burnish_vec3_scale(b, factor));
}

/* The polynomial in u of a lobe: a member of the family, or a composite where the order is 0. */
static burnish_theory_powers powers_of(const burnish_kernels_lobe *lobe) {
    const burnish_composite *composite = &lobe->composite;
    burnish_theory_powers square,
        made = burnish_theory_powers_of_order(lobe->order ? lobe->order : 1, (double)lobe->zeta);
    if (lobe->order) {
        return made;
    }
    made.zeta = (double)composite->slope / (double)composite->top;
    made.coefficients[1] = (double)composite->top; /* v, then v (v + offset) again and again */
    for (int i = 0; i < composite->multiplications - 1; ++i) {
        square = burnish_theory_powers_of_order(2 * made.degree, made.zeta);
        square.coefficients[square.degree] = 0;
        for (int a = 0; a <= made.degree; ++a) {
            for (int b = 0; b <= made.degree; ++b) {
                square.coefficients[a + b] += made.coefficients[a] * made.coefficients[b];
            }
            square.coefficients[a] +=
                i ? (double)composite->offset[i - 1] * made.coefficients[a] : 0;
        }
        made = square;
    }
    return made;
}

/* diffuse, and specular of lobe 0: shares of the hemisphere's and of the whole lobe's light. */
static void reference(const burnish_kernels_polygon *polygon, const place *at, double light[2]) {
    double corners[BURNISH_POLYGON_VERTEX_MAX][3], whole = 0;
    const int count = polygon->vertex_count;
    double normal[3], axis[3];
    const burnish_theory_powers lobe = powers_of(&polygon->lobes[0]);
    for (int v = 0; v < count; ++v) {
        vec corner = burnish_vec3_loadf(polygon->vertices[v]);
        if (!polygon->is_distant) {
            corner = sum(corner, -1 / (double)at->w, burnish_vec3_loadf(at->position));
        }
        burnish_vec3_store(corner, corners[v]);
    }
    burnish_vec3_store(burnish_vec3_loadf(at->normal), normal);
    burnish_vec3_store(burnish_vec3_loadf(at->axis), axis);
    const double(*const of)[3] = (const double(*)[3])corners;
    for (int i = 0; i <= lobe.degree; ++i) {
        whole += lobe.coefficients[i] * 2 * M_PI / (lobe.zeta * (i + 1));
    }
    /* negative if the light turns its back to the point */
    light[0] = burnish_theory_polygon(1, 1, normal, NULL, of, count) / M_PI;
    light[1] = burnish_theory_polygon_polynomial(&lobe, axis, normal, of, count) / whole;
    for (int i = 0; i < 2; ++i) {
        light[i] = polygon->is_two_sided ? fabs(light[i]) : fmax(0, light[i]);
    }
}

/* ---- Random lights and points ---- */

static vec random_unit_vec(uint64_t *state) {
    vec a;
    double squared;
    do {
        a.x = (double)test_uniform_float(state, -1, 1);
        a.y = (double)test_uniform_float(state, -1, 1);
        a.z = (double)test_uniform_float(state, -1, 1);
        squared = burnish_vec3_dot(a, a);
    } while (squared > 1 || squared < 0.01);
    return burnish_vec3_normalize(a);
}

static void to_floats(vec a, float *x) {
    x[0] = (float)a.x;
    x[1] = (float)a.y;
    x[2] = (float)a.z;
}

/* A polygon inscribed in an ellipse around a point at distance 1 or so. */
static burnish_kernels_polygon random_polygon(int order, float zeta, uint64_t *state) {
    burnish_kernels_polygon polygon = burnish_kernels_polygon_default();
    const vec center = random_unit_vec(state), u = random_unit_vec(state),
              v = burnish_vec3_normalize(burnish_vec3_cross(u, random_unit_vec(state)));
    const double size = pow(2, (double)test_uniform_float(state, -5, 2)),
                 ratio = (double)test_uniform_float(state, 0.1f, 1),
                 start = (double)test_uniform_float(state, 0, 6);
    polygon.lobes[0] = (burnish_kernels_lobe){.order = order, .zeta = zeta, .weight = 1};
    polygon.is_distant = test_random32(state) % 4 == 0;
    polygon.is_two_sided = (int)(test_random32(state) % 2);
    polygon.vertex_count = 3 + (int)(test_random32(state) % 6);
    for (int i = 0; i < polygon.vertex_count; ++i) {
        const double angle = start + 2 * M_PI * i / polygon.vertex_count;
        const vec corner = sum(sum(center, size * cos(angle), u), ratio * size * sin(angle), v);
        to_floats(corner, polygon.vertices[i]);
    }
    return polygon;
}

/* Half of the axes point near the light: narrow lobes would miss it otherwise. */
static place random_place(const burnish_kernels_polygon *polygon, uint64_t *state) {
    place at = {.w = test_uniform_float(state, 0.5f, 2)};
    vec position = sum((vec){0, 0, 0}, (double)(0.8f * at.w), random_unit_vec(state));
    to_floats(position, at.position);
    vec axis = random_unit_vec(state), normal = random_unit_vec(state);
    if (test_random32(state) % 2) {
        axis = (vec){0, 0, 0};
        for (int v = 0; v < polygon->vertex_count; ++v) {
            axis = sum(axis, pow((double)test_uniform_float(state, 0, 1), 2),
                       burnish_vec3_loadf(polygon->vertices[v]));
        }
    }
    to_floats(burnish_vec3_normalize(axis), at.axis);
    if (burnish_vec3_dot(normal, axis) < 0) {
        normal = sum((vec){0, 0, 0}, -1, normal);
    }
    to_floats(normal, at.normal);
    return at;
}

static void kernel(const burnish_kernels *kernels, const burnish_kernels_polygon *polygon,
                   const place *at, float light[2]) {
    burnish_error error;
    CHECK_OK(light_at(kernels, polygon, at, NULL, light, &error), error);
}

/* ---- Values ---- */

/* The largest error of a random light's share of a lobe, by zeta, for all orders. */
static const struct {
    float zeta;
    double most;
} ERRORS[] = {{0.5f, 1e-4}, {0.8f, 2e-4}, {1, 5e-5},   {2, 5e-5},    {8, 3e-5},
              {16, 3e-5},   {32, 3e-5},   {200, 3e-5}, {2000, 5e-5}, {20000, 5e-5}};
#define DIFFUSE_ERROR 3e-7

static void test_values(int trials) {
    for (size_t z = 0; z < sizeof ERRORS / sizeof ERRORS[0]; ++z) {
        for (int k = 0; k < 6; ++k) {
            uint64_t state = test_seed(77);
            double worst[2] = {0, 0};
            for (int trial = 0; trial < trials; ++trial) {
                const burnish_kernels_polygon polygon =
                    random_polygon(1 << k, ERRORS[z].zeta, &state);
                const place at = random_place(&polygon, &state);
                float light[2];
                double expected[2];
                kernel(scalar(), &polygon, &at, light);
                reference(&polygon, &at, expected);
                for (int i = 0; i < 2; ++i) {
                    worst[i] = fmax(worst[i], fabs((double)light[i] - expected[i]));
                }
            }
            CHECK(worst[0] <= DIFFUSE_ERROR, "diffuse: off by %.3g", worst[0]);
            CHECK(worst[1] <= ERRORS[z].most, "order %d, zeta %g: off by %.3g", 1 << k,
                  (double)ERRORS[z].zeta, worst[1]);
            if (test_option()) {
                printf("order %d, zeta %7g: diffuse %.2g, specular %.2g\n", 1 << k,
                       (double)ERRORS[z].zeta, worst[0], worst[1]);
            }
        }
    }
}

/* The same for composites of every number of multiplications. */
static void test_composites(int trials) {
    static const float exponents[] = {3, 10, 40, 300, 10000};
    for (int k = 0; k < 25; ++k) {
        const int multiplications = 2 + k % 5;
        uint64_t state = test_seed(78);
        double worst = 0;
        for (int trial = 0; trial < trials; ++trial) {
            burnish_kernels_polygon polygon = random_polygon(0, 0, &state);
            burnish_composite_create(&polygon.lobes[0].composite, BURNISH_COMPOSITE_MINIMAX,
                                     multiplications, exponents[k / 5]);
            polygon.lobes[0].zeta = polygon.lobes[0].composite.slope;
            const place at = random_place(&polygon, &state);
            float light[2];
            double expected[2];
            kernel(scalar(), &polygon, &at, light);
            reference(&polygon, &at, expected);
            worst = fmax(worst, fabs((double)light[1] - expected[1]));
        }
        CHECK(worst > 0 && worst <= 5e-5, "composite:%d, n = %g: off by %.3g", multiplications,
              (double)exponents[k / 5], worst);
    }
}

/* An axis at a corner of a light, and at one that the horizon cuts, within 1e-9 to 0.1. */
static void test_corners(void) {
    uint64_t state = test_seed(4);
    double worst[2] = {0, 0};
    for (int trial = 0; trial < 400; ++trial) {
        const burnish_kernels_polygon polygon =
            random_polygon(1 << trial % 4, trial & 4 ? 2.0f : 200.0f, &state);
        const int is_cut = trial & 1, next = 1 + trial % (polygon.vertex_count - 1);
        place at = random_place(&polygon, &state);
        vec corner = burnish_vec3_loadf(polygon.vertices[0]);
        if (is_cut) {
            corner = sum(corner, (double)test_uniform_float(&state, 0, 1),
                         sum(burnish_vec3_loadf(polygon.vertices[next]), -1, corner));
        }
        if (!polygon.is_distant) {
            corner = sum(corner, -1 / (double)at.w, burnish_vec3_loadf(at.position));
        }
        corner = burnish_vec3_normalize(corner);
        const vec normal =
            is_cut ? burnish_vec3_normalize(burnish_vec3_cross(corner, random_unit_vec(&state)))
                   : burnish_vec3_loadf(at.normal);
        const double distance = pow(10, (double)test_uniform_float(&state, -9, -1));
        to_floats(normal, at.normal);
        to_floats(burnish_vec3_normalize(sum(corner, distance, random_unit_vec(&state))), at.axis);
        float light[2];
        double expected[2];
        kernel(scalar(), &polygon, &at, light);
        reference(&polygon, &at, expected);
        worst[is_cut] = fmax(worst[is_cut], fabs((double)light[1] - expected[1]));
    }
    CHECK(worst[0] < 5e-5, "at corners off by %.3g", worst[0]);
    CHECK(worst[1] < 5e-5, "at corners of the horizon off by %.3g", worst[1]);
}

/* ---- Exact cases ---- */

static const place AT_ZERO = {{0, 0, 1}, {0, 0, 0}, 1, {0, 0, 1}};

static int near(float x, double expected, double error) {
    return fabs((double)x - expected) <= error;
}

/* A rectangle at z = 1 that shines down. */
static burnish_kernels_polygon rectangle(float x0, float x1, float y0, float y1) {
    burnish_kernels_polygon polygon = burnish_kernels_polygon_default();
    const float corners[4][2] = {{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}};
    for (int v = 0; v < 4; ++v) {
        polygon.vertices[v][0] = corners[v][0];
        polygon.vertices[v][1] = corners[v][1];
    }
    polygon.lobes[0] = (burnish_kernels_lobe){.order = 4, .zeta = 3, .weight = 1};
    return polygon;
}

/* An infinite sky, seen from above and below the horizon and from behind. */
static void test_sides(void) {
    static const struct {
        const char *what;
        float normal, height, axis[2]; /* z; x and z */
        int is_two_sided;
        double diffuse, specular;
    } cases[] = {{"a sky", 1, 0, {0, 1}, 0, 1, 1},
                 {"below the horizon", -1, 0, {0, 1}, 0, 0, 0},
                 {"behind", -1, 2, {0, 1}, 0, 0, 0},
                 {"behind, two-sided", -1, 2, {0, -1}, 1, 1, 1},
                 {"half of a lobe", 1, 0, {1, 0}, 0, 1, 0.5}}; /* the horizon cuts it */
    burnish_kernels_polygon sky = rectangle(-1e7f, 1e7f, -1e7f, 1e7f);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const place at = {{0, 0, cases[i].normal},
                          {0, 0, cases[i].height},
                          1,
                          {cases[i].axis[0], 0, cases[i].axis[1]}};
        const double error = cases[i].diffuse > 0 ? 1e-6 : 0;
        float light[2];
        sky.is_two_sided = cases[i].is_two_sided;
        kernel(NULL, &sky, &at, light);
        CHECK(near(light[0], cases[i].diffuse, error) && near(light[1], cases[i].specular, error),
              "%s: %g %g", cases[i].what, (double)light[0], (double)light[1]);
    }
}

/* In the plane of a light, on its edge, and in its corner; with an offset that rounds. */
static void test_plane(void) {
    static const float x[][2] = {{3, 0.3f}, {0.2f, 0.1f}, {1, 0.5f}, {1, 1}, {0, 1}};
    burnish_kernels_polygon light = rectangle(-1, 1, -1, 1);
    light.is_two_sided = 1;
    for (int tilt = 0; tilt < 2; ++tilt) {
        for (int v = 0; v < 4 && tilt; ++v) {
            light.vertices[v][2] = 1 + 0.3f * light.vertices[v][0] - 0.7f * light.vertices[v][1];
        }
        for (size_t i = 0; i < sizeof x / sizeof x[0]; ++i) {
            place at = AT_ZERO;
            float sums[2];
            at.position[0] = x[i][0];
            at.position[1] = x[i][1];
            at.position[2] = tilt ? 1 + 0.3f * x[i][0] - 0.7f * x[i][1] : 1;
            kernel(NULL, &light, &at, sums);
            CHECK(sums[0] == 0 && sums[1] == 0, "tilt %d, point %zu in the plane: %g %g", tilt, i,
                  (double)sums[0], (double)sums[1]);
        }
    }
}

/* Without normals the horizon is left out. */
static void test_no_normals(void) {
    const burnish_kernels_polygon sky = rectangle(-1e7f, 1e7f, -1e7f, 1e7f);
    const float zero = 0, up = 1;
    const burnish_kernels_axes axes = {.axis = {&zero, &zero, &up}};
    const burnish_kernels_points points = {.position = {&zero, &zero, &zero}};
    float specular = 0;
    float *const to[2] = {NULL, &specular};
    CHECK(burnish_kernels_polygon_light(NULL, &sky, &points, &axes, 1, to, NULL) ==
                  BURNISH_STATUS_OK &&
              near(specular, 1, 1e-6),
          "without normals: %g", (double)specular);
}

/* The specular part of a stretch is the light of the stretched polygon. */
static void test_stretch(void) {
    uint64_t state = test_seed(8);
    for (int trial = 0; trial < 100; ++trial) {
        burnish_kernels_polygon polygon = random_polygon(4, 3, &state);
        polygon.is_distant = 1;
        const place at = random_place(&polygon, &state);
        const vec normal = burnish_vec3_loadf(at.normal),
                  e = sum(
                      (vec){0, 0, 0}, 2,
                      burnish_vec3_normalize(burnish_vec3_cross(normal, random_unit_vec(&state))));
        burnish_kernels_polygon stretched = polygon;
        float stretch[3], light[2], plain[2], expected[2];
        to_floats(e, stretch);
        for (int v = 0; v < polygon.vertex_count; ++v) {
            const vec p = burnish_vec3_loadf(polygon.vertices[v]);
            to_floats(sum(p, burnish_vec3_dot(e, p), e), stretched.vertices[v]);
        }
        if (light_at(NULL, &stretched, &at, NULL, expected, NULL) != BURNISH_STATUS_OK) {
            continue; /* seen from its edge */
        }
        CHECK1(light_at(NULL, &polygon, &at, stretch, light, NULL) == BURNISH_STATUS_OK);
        kernel(NULL, &polygon, &at, plain);
        CHECK(near(light[0], (double)plain[0], 4e-7), "diffuse: %g, not %g", (double)light[0],
              (double)plain[0]);
        CHECK(near(light[1], (double)expected[1], 4e-6), "specular: %g, not %g", (double)light[1],
              (double)expected[1]);
    }
}

/* ---- Instruction sets ---- */

typedef struct input {
    point_arrays points;
    float axis[3][BLOCK], stretch[3][BLOCK];
} input;

static void make_input(input *made, int tame, uint64_t *state) {
    make_points(&made->points, BLOCK, tame, state);
    for (int i = 0; i < BLOCK; ++i) {
        float axis[3];
        to_floats(random_unit_vec(state), axis);
        for (int k = 0; k < 3; ++k) {
            made->axis[k][i] = axis[k];
            made->stretch[k][i] = test_uniform_float(state, -1, 1);
        }
        if (!tame && test_random32(state) % 16 == 0) {
            made->axis[test_random32(state) % 3][i] = awkward(state);
        }
    }
}

static void run(const burnish_kernels *kernels, const burnish_kernels_polygon *polygon,
                const input *from, int stretches, size_t first, size_t count,
                float *const light[2]) {
    burnish_kernels_points points = points_at(&from->points, first, 0, 1);
    burnish_kernels_axes axes = {
        .axis = {from->axis[0] + first, from->axis[1] + first, from->axis[2] + first}};
    for (int k = 0; k < 3 && stretches; ++k) {
        axes.stretch[k] = from->stretch[k] + first;
    }
    CHECK(burnish_kernels_polygon_light(kernels, polygon, &points, &axes, count, light, NULL) ==
              BURNISH_STATUS_OK,
          "a light");
}

/* Every length, and each point alone on the scalar kernel. */
static void test_bits(void) {
    static input from;
    static float light[2][80], expected[2][80];
    float *const out[2] = {light[0], light[1]};
    uint64_t state = test_seed(9);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_kernels *kernels = burnish_kernels_for((burnish_isa)isa);
        for (int trial = 0; kernels && trial < 600; ++trial) {
            static const float zetas[] = {0.6f, 3, 40, 900};
            burnish_kernels_polygon polygon =
                random_polygon(1 << trial % 6, zetas[trial % 4], &state);
            const size_t count = (size_t)trial % 70, first = test_random32(&state) % 1000;
            if (trial % 20 == 0) {
                make_input(&from, trial % 40 == 0, &state);
            }
            polygon.lobe_count = 1 + trial % 2;
            polygon.lobes[1] = (burnish_kernels_lobe){.order = 1, .zeta = 1.5f, .weight = 0.5f};
            memset(light, 0x5a, sizeof light);
            memset(expected, 0x5a, sizeof expected);
            run(kernels, &polygon, &from, trial % 5 == 0, first, count, out);
            for (size_t i = 0; i < count; ++i) {
                float *const to[2] = {&expected[0][i], &expected[1][i]};
                run(scalar(), &polygon, &from, trial % 5 == 0, first + i, 1, to);
            }
            CHECK(memcmp(light, expected, sizeof light) == 0, "%s, trial %d: other bits",
                  burnish_isa_name((burnish_isa)isa), trial);
        }
    }
}

/* FNV-1a over what the scalar kernel gives for fixed input: the same on every processor, with every
 * compiler. A change of the kernel's arithmetic changes it, and pixels too. */
#define SCALAR_HASH 0x579044f09220dc35u

static void test_hash(void) {
    static const float corners[5][3] = {
        {0, -0.5f, 2}, {-1.5f, 0, 2}, {-1, 1.5f, 2}, {1, 1.5f, 2}, {1.5f, 0, 2}};
    static input from;
    static float light[2][BLOCK];
    float *const out[2] = {light[0], light[1]};
    uint64_t hash = 0xcbf29ce484222325u, state = 1234567;
    burnish_kernels_polygon polygon = burnish_kernels_polygon_default();
    memcpy(polygon.vertices, corners, sizeof corners);
    polygon.vertex_count = 5;
    polygon.is_two_sided = 1;
    polygon.lobe_count = 2;
    make_input(&from, 1, &state);
    for (int order = 1; order <= 32; order *= 2) {
        polygon.lobes[0] = (burnish_kernels_lobe){
            .order = order, .zeta = 0.75f * (float)(order * order), .weight = 0.25f};
        polygon.lobes[1] =
            (burnish_kernels_lobe){.order = order, .zeta = 1.5f * (float)order, .weight = 0.75f};
        run(scalar(), &polygon, &from, order == 4, 0, BLOCK, out);
        for (int i = 0; i < 2 * BLOCK; ++i) {
            for (int byte = 0; byte < 4; ++byte) {
                hash ^= bits_of(light[i / BLOCK][i % BLOCK]) >> 8 * byte & 0xff;
                hash *= 0x100000001b3u;
            }
        }
    }
    CHECK(hash == SCALAR_HASH, "hash %#llx", (unsigned long long)hash);
}

/* ---- Arguments ---- */

static void test_arguments(void) {
    const float zero[3] = {0, 0, 0};
    const burnish_kernels_axes axes = {.axis = {zero, zero, zero}};
    const burnish_kernels_points points = {.normal = {zero, zero, zero},
                                           .position = {zero, zero, zero}};
    float light[2] = {7, 7};
    float *const out[2] = {&light[0], &light[1]};
    const burnish_kernels_polygon good = burnish_kernels_polygon_default();
#define REFUSED(words, ...)                                                                        \
    do {                                                                                           \
        burnish_kernels_polygon bad = good;                                                        \
        burnish_error error = {.text = ""};                                                        \
        __VA_ARGS__;                                                                               \
        CHECK(burnish_kernels_polygon_light(NULL, &bad, &points, &axes, 1, out, &error) ==         \
                      BURNISH_STATUS_ARGUMENT &&                                                   \
                  strstr(error.text, words) && light[0] == 7,                                      \
              "%s: \"%s\"", #__VA_ARGS__, error.text);                                             \
    } while (0)
    REFUSED("default", bad.cookie = 0);
    REFUSED("0 vertices", bad.vertex_count = 0);
    REFUSED("17 vertices", bad.vertex_count = 17);
    REFUSED("vertex 2", bad.vertices[1][0] = NAN);
    REFUSED("vertex 4", bad.vertices[3][2] = INFINITY);
    REFUSED("no area", memset(bad.vertices, 0, sizeof bad.vertices));
    REFUSED(
        "no area", for (int v = 0; v < 4; ++v) { bad.vertices[v][0] = bad.vertices[v][1]; });
    REFUSED("coincide", memcpy(bad.vertices[2], bad.vertices[3], sizeof bad.vertices[3]));
    REFUSED("plane", bad.vertices[2][2] = 1.01f);
    REFUSED("convex", bad.vertices[2][0] = bad.vertices[2][1] = -0.5f);
    REFUSED("(0, 0, 0)", {
        bad.is_distant = 1;
        for (int v = 0; v < 4; ++v) {
            bad.vertices[v][2] = 0;
        }
    });
    REFUSED("4 lobes", bad.lobe_count = 4);
    REFUSED("order 3", bad.lobes[0].order = 3);
    REFUSED("composite", bad.lobes[0].order = 0);
    REFUSED("zeta 0.4", bad.lobes[0].zeta = 0.4f);
    REFUSED("zeta nan", bad.lobes[0].zeta = NAN);
    REFUSED("weight -1", bad.lobes[0].weight = -1);
#undef REFUSED
    burnish_kernels_points few = points;
    few.position[1] = NULL;
    CHECK(burnish_kernels_polygon_light(NULL, &good, &few, &axes, 1, out, NULL) ==
              BURNISH_STATUS_ARGUMENT,
          "no positions");
    few = (burnish_kernels_points){.position = {zero, zero, zero}};
    CHECK(burnish_kernels_polygon_light(NULL, &good, &few, &axes, 1, out, NULL) ==
              BURNISH_STATUS_ARGUMENT,
          "no normals");
    CHECK(burnish_kernels_polygon_light(NULL, &good, &points, NULL, 1, out, NULL) ==
              BURNISH_STATUS_ARGUMENT,
          "no axes");
}

/* ---- The arctangent ---- */

/* All quotients in steps of about 1e-4, from 2^-40 to 2^40, in all quadrants. */
static void test_arctangent(void) {
    double worst = 0;
    for (uint32_t bits = 0x2b800000; bits < 0x53800000; bits += 997) {
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            const float y = quadrant & 1 ? -test_float_of_bits(bits) : test_float_of_bits(bits);
            const float x = quadrant & 2 ? -1.5f : 1.5f;
            const double exact = atan2((double)y, (double)x);
            worst = fmax(worst, fabs((double)vector_atan2(y, x) - exact));
        }
    }
    CHECK(worst < 2.6e-7, "off by %.3g", worst);
    CHECK1(vector_atan2(0, 0) == 0 && vector_atan2(0, 1) == 0);
    CHECK1(vector_atan2(0, -1) == 3.14159265358979323846f);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--trials");
    const char *trials = test_option();
    RUN(test_values(trials ? atoi(trials) : 150));
    RUN(test_composites(trials ? atoi(trials) : 60));
    RUN(test_corners());
    RUN(test_sides());
    RUN(test_plane());
    RUN(test_no_normals());
    RUN(test_stretch());
    RUN(test_bits());
    RUN(test_hash());
    RUN(test_arguments());
    RUN(test_arctangent());
    return test_end("polygon");
}
