/* Spheres and tubes: values against the theory's closed forms in double precision, which
 * test_theory_lights compares with quadrature, flat polygons and points of a cylinder; bits on all instruction sets; refused arguments.
 *
 * --trials 3000 tries more lights and prints the largest errors. */
#include <math.h>

#include "burnish/kernels.h"
#include "burnish/theory.h"
#include "light_at.h"
#include "vec.h"

typedef double vec[3];

/* diffuse, and specular of lobe 0: shares of the hemisphere's and of the whole lobe's light. */
static void reference(const burnish_kernels_polygon *light, const place *at, double out[2]) {
    const burnish_kernels_lobe *lobe = &light->lobes[0];
    const burnish_theory_powers cosine = burnish_theory_powers_of_order(1, 1),
                                powers =
                                    burnish_theory_powers_of_order(lobe->order, (double)lobe->zeta);
    vec middle, normal, axis;
    for (int k = 0; k < 3; ++k) {
        const double p = light->is_distant ? 0 : (double)at->position[k] / (double)at->w;
        middle[k] = (double)light->vertices[0][k] - p;
        normal[k] = (double)at->normal[k];
        axis[k] = (double)at->axis[k];
    }
    const double angle = asin((double)light->radius / sqrt(dot(middle, middle)));
    out[0] = burnish_theory_cap(&cosine, normal, NULL, middle, angle) / M_PI;
    out[1] = burnish_theory_cap(&powers, axis, normal, middle, angle) * powers.zeta *
             (powers.degree + 1) / (2 * M_PI);
}

/* ---- Random lights and points ---- */

static void draw_unit(uint64_t *state, vec a) {
    do {
        for (int k = 0; k < 3; ++k) {
            a[k] = (double)test_uniform_float(state, -1, 1);
        }
    } while (dot(a, a) > 1 || dot(a, a) < 0.01);
    normalize(a);
}

static burnish_kernels_polygon draw_light(int is_tube, int order, float zeta, uint64_t *state) {
    burnish_kernels_polygon light = burnish_kernels_polygon_default();
    const float root = test_uniform_float(state, 0.06f, 0.81f);
    const double length = (double)test_uniform_float(state, 0.1f, 4);
    vec center, along;
    draw_unit(state, center);
    draw_unit(state, along);
    for (int k = 0; k < 3; ++k) {
        light.vertices[0][k] = (float)(1.5 * center[k] - is_tube * length * along[k]);
        light.vertices[1][k] = (float)(1.5 * center[k] + length * along[k]);
    }
    light.vertex_count = 1 + is_tube;
    light.radius = root * root * (is_tube ? 0.2f : 1.0f);
    light.is_distant = test_random32(state) % 4 == 0;
    light.lobes[0] = (burnish_kernels_lobe){.order = order, .zeta = zeta, .weight = 1};
    return light;
}

/* Outside the light; half of the axes point near its edge: narrow lobes would miss it otherwise. */
static place draw_place(const burnish_kernels_polygon *light, uint64_t *state) {
    place at = {.w = test_uniform_float(state, 0.5f, 2)};
    vec position, normal, axis, aside;
    draw_unit(state, position);
    draw_unit(state, normal);
    draw_unit(state, axis);
    draw_unit(state, aside);
    const int is_near = (int)(test_random32(state) % 2);
    for (int k = 0; k < 3; ++k) {
        const double p = 0.7 * position[k];
        at.position[k] = (float)p * at.w;
        axis[k] = is_near ? (double)light->vertices[0][k] - (light->is_distant ? 0 : p) +
                                (double)light->radius * aside[k]
                          : axis[k];
    }
    normalize(axis);
    const double side = is_near && dot(normal, axis) < 0 ? -1 : 1;
    for (int k = 0; k < 3; ++k) {
        at.axis[k] = (float)axis[k];
        at.normal[k] = (float)(side * normal[k]);
    }
    return at;
}

/* ---- Values ---- */

/* Composites that are members of the family have its light. */
static void test_composites(int trials) {
    uint64_t state = test_seed(11);
    double worst = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const int order = 2 << trial % 5;
        burnish_kernels_polygon light = draw_light(trial % 2, order, 1, &state);
        const place at = draw_place(&light, &state);
        float expected[2], out[2];
        CHECK1(light_at(scalar(), &light, &at, NULL, expected, NULL) == BURNISH_STATUS_OK);
        light.lobes[0].order = 0;
        CHECK1(!burnish_composite_create(&light.lobes[0].composite, BURNISH_COMPOSITE_MINIMAX, 6,
                                         (float)order));
        CHECK1(light_at(scalar(), &light, &at, NULL, out, NULL) == BURNISH_STATUS_OK);
        worst = fmax(worst, fabs((double)out[1] - (double)expected[1]));
    }
    CHECK(worst < 2e-6, "off by %.3g", worst);
}

static void test_spheres(int trials) {
    static const float zetas[] = {1, 2, 8, 32, 200, 2000, 20000};
    for (size_t z = 0; z < sizeof zetas / sizeof *zetas; ++z) {
        for (int k = 0; k < 6; ++k) {
            uint64_t state = test_seed(7);
            double worst[2] = {0, 0};
            for (int trial = 0; trial < trials; ++trial) {
                const burnish_kernels_polygon light = draw_light(0, 1 << k, zetas[z], &state);
                const place at = draw_place(&light, &state);
                float got[2];
                double want[2];
                CHECK1(light_at(scalar(), &light, &at, NULL, got, NULL) == BURNISH_STATUS_OK);
                reference(&light, &at, want);
                for (int i = 0; i < 2; ++i) {
                    worst[i] = fmax(worst[i], fabs((double)got[i] - want[i]));
                }
            }
            CHECK(worst[0] < 3e-7, "diffuse: off by %.3g", worst[0]);
            CHECK(worst[1] < 5e-5, "order %d, zeta %g: off by %.3g", 1 << k, (double)zetas[z],
                  worst[1]);
            if (test_option()) {
                printf("order %d, zeta %7g: diffuse %.2g, specular %.2g\n", 1 << k,
                       (double)zetas[z], worst[0], worst[1]);
            }
        }
    }
}

/* A small sphere is a directional light of its solid angle: the error is relative. */
static void test_small(void) {
    const place at = {{0, 0, 1}, {0, 0, 0}, 1, {0.28f, 0, 0.96f}};
    burnish_kernels_polygon light = burnish_kernels_polygon_default();
    light.vertex_count = 1;
    light.vertices[0][0] = light.vertices[0][1] = 0;
    light.lobes[0] = (burnish_kernels_lobe){.order = 4, .zeta = 5, .weight = 1};
    for (double radius = 0.01; radius > 1e-4; radius /= 4) {
        const double squared = radius * radius, want = squared * pow(0.8, 4) * 5 * 5 / 2;
        float got[2];
        light.radius = (float)radius;
        CHECK1(light_at(NULL, &light, &at, NULL, got, NULL) == BURNISH_STATUS_OK);
        CHECK(fabs((double)got[0] / squared - 1) < 1e-6 &&
                  fabs((double)got[1] / want - 1) < 20 * squared + 2e-7 / radius,
              "radius %g: %g, %g of %g, %g", radius, (double)got[0], (double)got[1], squared, want);
    }
}

/* The strip between the planes that touch a tube, as a polygon. */
static int strip_of(const burnish_kernels_polygon *light, const place *at,
                    burnish_kernels_polygon *strip) {
    vec p, axis, foot, side;
    double along = 0;
    for (int k = 0; k < 3; ++k) {
        p[k] = light->is_distant ? 0 : (double)at->position[k] / (double)at->w;
        axis[k] = (double)light->vertices[1][k] - (double)light->vertices[0][k];
        foot[k] = (double)light->vertices[0][k] - p[k];
    }
    normalize(axis);
    along = dot(foot, axis);
    for (int k = 0; k < 3; ++k) {
        foot[k] -= along * axis[k];
    }
    const double distance = sqrt(dot(foot, foot));
    const double half = asin(fmin(1, (double)light->radius / distance));
    *strip = *light;
    strip->vertex_count = 4;
    strip->is_two_sided = 1;
    cross(foot, axis, side);
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 3; ++k) {
            const double to = (v > 1 ? -1 : 1) * tan(half) * side[k];
            strip->vertices[v][k] = (float)((double)light->vertices[v % 3 > 0][k] + to);
        }
    }
    return half < 1;
}

static void test_tubes(int trials) {
    for (int i = 0; i < 8; ++i) {
        uint64_t state = test_seed(17);
        const float zeta = i % 2 ? 150 : 2;
        double worst[2] = {0, 0};
        for (int trial = 0; trial < trials; ++trial) {
            const burnish_kernels_polygon light = draw_light(1, 1 << i / 2, zeta, &state);
            const place at = draw_place(&light, &state);
            burnish_kernels_polygon strip;
            float got[2], want[2];
            const float stretch[3] = {0.4f, -1, 0.7f};
            const float *e = trial % 3 == 0 ? stretch : NULL;
            if (strip_of(&light, &at, &strip)) {
                CHECK1(light_at(NULL, &light, &at, e, got, NULL) == BURNISH_STATUS_OK);
                if (light_at(NULL, &strip, &at, e, want, NULL) == BURNISH_STATUS_OK) {
                    worst[0] = fmax(worst[0], fabs((double)got[0] - (double)want[0]));
                    worst[1] = fmax(worst[1], fabs((double)got[1] - (double)want[1]));
                }
            }
        }
        CHECK(worst[0] < 1e-6 && worst[1] < 5e-5, "order %d, zeta %g: off by %.3g and %.3g",
              1 << i / 2, (double)zeta, worst[0], worst[1]);
        if (test_option()) {
            printf("tube, order %d, zeta %g: diffuse %.2g, specular %.2g\n", 1 << i / 2,
                   (double)zeta, worst[0], worst[1]);
        }
    }
}

/* Against points of a cylinder, whose ends are too small to matter. */
static void test_cylinder(void) {
    enum { STEPS = 400 };
    burnish_kernels_polygon light = burnish_kernels_polygon_default();
    const place at = {{0.6f, 0, 0.8f}, {0, 0, 0}, 1, {0, 0, 1}};
    const double radius = 0.3, z = 1;
    double sum = 0;
    light.vertex_count = 2;
    light.radius = (float)radius;
    for (int k = 0; k < 3; ++k) {
        light.vertices[0][k] = k == 0 ? -9 : k == 2;
        light.vertices[1][k] = k == 0 ? 6 : k == 2;
    }
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double turn = 2 * M_PI * (i / STEPS + 0.5) / STEPS;
        const vec n = {0, sin(turn), cos(turn)};
        const vec p = {-9 + 15.0 * (i % STEPS + 0.5) / STEPS, radius * n[1], z + radius * n[2]};
        const double cosine = 0.6 * p[0] + 0.8 * p[2], squared = dot(p, p), back = -dot(n, p);
        sum += fmax(0, cosine) * fmax(0, back) / (squared * squared);
    }
    sum *= 15 * 2 * M_PI * radius / (STEPS * STEPS) / M_PI;
    float got[2];
    CHECK1(light_at(NULL, &light, &at, NULL, got, NULL) == BURNISH_STATUS_OK);
    CHECK(fabs((double)got[0] - sum) < 1e-3, "%g, not %g", (double)got[0], sum);
}

/* ---- Instruction sets ---- */

/* Every length, and each point alone on the scalar kernel, whose bits are those of every processor.
 * */
#define SCALAR_HASH 0x679fc864b9afcc48u

static void run(const burnish_kernels *kernels, const burnish_kernels_polygon *light,
                const point_arrays *from, const float axes[6][BLOCK], int first, int count,
                float *const out[2]) {
    burnish_kernels_points points = points_at(from, (size_t)first, 0, 1);
    burnish_kernels_axes to;
    for (int k = 0; k < 3; ++k) {
        to.axis[k] = axes[k] + first;
        to.stretch[k] = light->lobe_count == 2 ? axes[3 + k] + first : NULL;
    }
    CHECK1(burnish_kernels_polygon_light(kernels, light, &points, &to, (size_t)count, out, NULL) ==
           BURNISH_STATUS_OK);
}

static void test_bits(void) {
    static point_arrays from;
    static float axes[6][BLOCK], light[2][80], expected[2][80];
    static const float zetas[] = {1, 3, 40, 900};
    uint64_t state = 12345, hash = 0xcbf29ce484222325u;
    for (int trial = 0; trial < 300; ++trial) {
        burnish_kernels_polygon drawn =
            draw_light(trial % 3 == 0, 1 << trial % 6, zetas[trial % 4], &state);
        const int count = trial % 70, first = (int)(test_random32(&state) % 1000);
        if (trial % 20 == 0) {
            make_points(&from, BLOCK, trial % 40 == 0, &state);
            for (int i = 0; i < BLOCK; ++i) {
                vec axis;
                draw_unit(&state, axis);
                for (int k = 0; k < 3; ++k) {
                    axes[k][i] = (float)axis[k];
                    axes[3 + k][i] = test_uniform_float(&state, -1, 1);
                }
            }
        }
        drawn.lobe_count = 1 + trial % 2;
        drawn.lobes[1] = (burnish_kernels_lobe){.order = 1, .zeta = 1.5f, .weight = 0.5f};
        memset(expected, 0x5a, sizeof expected);
        for (int i = 0; i < count; ++i) {
            run(scalar(), &drawn, &from, (const float(*)[BLOCK])axes, first + i, 1,
                (float *const[2]){&expected[0][i], &expected[1][i]});
        }
        for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
            const burnish_kernels *kernels = burnish_kernels_for((burnish_isa)isa);
            memset(light, 0x5a, sizeof light);
            if (kernels) {
                run(kernels, &drawn, &from, (const float(*)[BLOCK])axes, first, count,
                    (float *const[2]){light[0], light[1]});
                CHECK(memcmp(light, expected, sizeof light) == 0, "%s, trial %d: other bits",
                      burnish_isa_name((burnish_isa)isa), trial);
            }
        }
        for (int i = 0; i < 2 * count && trial % 40 < 20; ++i) {
            hash = (hash ^ bits_of(expected[i / count][i % count])) * 0x100000001b3u;
        }
    }
    CHECK(hash == SCALAR_HASH, "hash %#llx", (unsigned long long)hash);
}

static void test_arguments(void) {
    const place at = {{0, 0, 1}, {0, 0, 0}, 1, {0, 0, 1}};
    burnish_kernels_polygon good = burnish_kernels_polygon_default();
    float out[2];
    good.vertex_count = 1;
    good.radius = 0.5f;
    CHECK1(light_at(NULL, &good, &at, NULL, out, NULL) == BURNISH_STATUS_OK);
#define REFUSED(change)                                                                            \
    do {                                                                                           \
        burnish_kernels_polygon bad = good;                                                        \
        change;                                                                                    \
        CHECK(light_at(NULL, &bad, &at, NULL, out, NULL) == BURNISH_STATUS_ARGUMENT, "%s",         \
              #change);                                                                            \
    } while (0)
    REFUSED(bad.radius = 0);
    REFUSED(bad.radius = NAN);
    REFUSED(bad.radius = INFINITY);
    REFUSED(bad.lobes[0].zeta = 0.9f);
    REFUSED(bad.is_distant = 1; bad.radius = 2);
    REFUSED(bad.vertex_count = 2; memcpy(bad.vertices[1], bad.vertices[0], sizeof bad.vertices[0]));
#undef REFUSED
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--trials");
    const char *trials = test_option();
    const int tried = trials ? atoi(trials) : 150;
    RUN(test_composites(200));
    RUN(test_spheres(tried));
    RUN(test_small());
    RUN(test_tubes(2 * tried));
    RUN(test_cylinder());
    RUN(test_bits());
    RUN(test_arguments());
    return test_end("round");
}
