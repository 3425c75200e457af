/* What the tests of kernels share: lobes, points and lightings, drawn at random or awkward. */
#ifndef BURNISH_TEST_KERNELS_INPUT_H
#define BURNISH_TEST_KERNELS_INPUT_H

#include <math.h>
#include <stdint.h>

#include "burnish/kernels.h"
#include "support.h"

enum { BLOCK = 4096, GUARD = 32, MOST_LANES = 16 };

static const float EXPONENTS[] = {1, 2, 3.5f, 8, 18, 32, 100, 256, 1000, 4096, 65536};
enum { EXPONENT_COUNT = sizeof EXPONENTS / sizeof EXPONENTS[0] };

static inline const burnish_kernels *scalar(void) {
    return burnish_kernels_for(BURNISH_ISA_SCALAR);
}

static inline uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Numbers that find differences: any bits, special ones, and cosines. */
static inline float awkward(uint64_t *state) {
    static const uint32_t special[] = {0,          0x80000000, 1,          0x80000001, 0x007fffff,
                                       0x00800000, 0x3f800000, 0x3f7fffff, 0x3f800001, 0xbf800000,
                                       0x7f800000, 0xff800000, 0x7fc00000, 0xffc12345, 0x7f7fffff};
    uint32_t choice = test_random32(state) % 8;
    if (choice == 0) {
        return test_float_of_bits(
            special[test_random32(state) % (sizeof special / sizeof special[0])]);
    }
    return choice == 1 ? test_float_of_bits(test_random32(state))
                       : test_uniform_float(state, -0.25f, 1.0f);
}

/* The kinds that have kernels. */
static const burnish_lobe_kind KINDS[] = {
    BURNISH_LOBE_FAMILY,   BURNISH_LOBE_POWER, BURNISH_LOBE_INTEGER_POWER, BURNISH_LOBE_SCHLICK,
    BURNISH_LOBE_GAUSSIAN, BURNISH_LOBE_GX,    BURNISH_LOBE_LYON,          BURNISH_LOBE_COMPOSITE,
};
enum {
    KIND_COUNT = sizeof KINDS / sizeof KINDS[0],
    COMPOSITE_AT = KIND_COUNT - 1,
    LYON_AT = COMPOSITE_AT - 1
};

/* A lobe, its exponent and, for the family, Lyon's and composites, what burnish/lobe.h makes of
 * them. A composite has the multiplications of the order. */
typedef struct lobe_case {
    burnish_lobe_spec spec;
    float exponent;
    burnish_lobe family;
    burnish_composite composite;
} lobe_case;

static inline lobe_case make(burnish_lobe_kind kind, int order, float exponent) {
    lobe_case lobe = {.spec = {.kind = kind, .fit = BURNISH_FIT_ENERGY}, .exponent = exponent};
    if (kind == BURNISH_LOBE_COMPOSITE) {
        lobe.spec.order = 1;
        for (int power = 1; power < order; power *= 2) {
            ++lobe.spec.order;
        }
        burnish_composite_create(&lobe.composite, BURNISH_COMPOSITE_MINIMAX, lobe.spec.order,
                                 exponent);
        return lobe;
    }
    lobe.spec.order = order = burnish_lobe_highest_order(order, exponent);
    if (kind == BURNISH_LOBE_INTEGER_POWER) {
        lobe.exponent = (float)(uint32_t)exponent;
    }
    burnish_lobe_create(&lobe.family,
                        kind == BURNISH_LOBE_LYON ? BURNISH_FIT_TAYLOR : BURNISH_FIT_ENERGY, order,
                        exponent);
    return lobe;
}

/* One call on a misaligned array between guard bytes; `values` receives what was written. */
static inline int run_lobe(const burnish_kernels *kernels, const lobe_case *lobe, int lambda,
                           const float *cosines, size_t count, size_t shift, float *values) {
    static float buffer[BLOCK + 2 * GUARD + MOST_LANES];
    int damaged = 0;
    memset(buffer, 0xa5, sizeof buffer);
    float *out = buffer + GUARD + shift;
    burnish_status status =
        lambda ? burnish_kernels_lobe_of_lambdas(kernels, &lobe->spec, lobe->exponent, count,
                                                 cosines, out, NULL)
               : burnish_kernels_lobe_of_cosines(kernels, &lobe->spec, lobe->exponent, count,
                                                 cosines, out, NULL);
    memcpy(values, out, count * sizeof *values);
    memset(out, 0xa5, count * sizeof *out);
    for (size_t i = 0; i < sizeof buffer / sizeof buffer[0]; ++i) {
        damaged |= bits_of(buffer[i]) != 0xa5a5a5a5u;
    }
    return status == BURNISH_STATUS_OK && !damaged;
}

/* ---- Lighting ---- */

typedef struct point_arrays {
    float normal[3][BLOCK], position[3][BLOCK], diffuse[3][BLOCK], w[BLOCK];
} point_arrays;

/* Points near the unit sphere, normals of lengths near 1 and, unless tame, some that are awkward.
 */
static inline void make_points(point_arrays *arrays, size_t count, int tame, uint64_t *state) {
    for (size_t i = 0; i < count; ++i) {
        arrays->w[i] = test_uniform_float(state, 0.5f, 2.0f);
        float length =
            tame ? test_uniform_float(state, 0.5f, 2.0f) : test_uniform_float(state, 0.0f, 1e3f);
        for (int k = 0; k < 3; ++k) {
            arrays->normal[k][i] = length * test_uniform_float(state, -1, 1);
            arrays->position[k][i] = test_uniform_float(state, -1, 1);
            arrays->diffuse[k][i] = test_uniform_float(state, 0, 1);
        }
        if (!tame && test_random32(state) % 16 == 0) {
            int k = (int)(test_random32(state) % 3);
            switch (test_random32(state) % 3) {
            case 0:
                arrays->normal[k][i] = awkward(state);
                break;
            case 1:
                arrays->position[k][i] = awkward(state);
                break;
            default:
                arrays->diffuse[k][i] = awkward(state);
                break;
            }
        }
    }
}

static inline burnish_kernels_points points_at(const point_arrays *arrays, size_t first,
                                               int with_diffuse, int with_w) {
    burnish_kernels_points points = {.w = with_w ? arrays->w + first : NULL};
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = arrays->normal[k] + first;
        points.position[k] = arrays->position[k] + first;
        points.diffuse[k] = with_diffuse ? arrays->diffuse[k] + first : NULL;
    }
    return points;
}

static inline void random_unit(uint64_t *state, float v[3]) {
    double x = (double)test_uniform_float(state, -1, 1),
           y = (double)test_uniform_float(state, -1, 1), z = 0.3;
    double length = sqrt(x * x + y * y + z * z);
    v[0] = (float)(x / length);
    v[1] = (float)(y / length);
    v[2] = (float)(z / length);
}

static inline void random_direction(uint64_t *state, burnish_light *light) {
    float v[3];
    random_unit(state, v);
    for (int k = 0; k < 3; ++k) {
        volatile float rounded = v[k]; /* GCC 12 leaves out pairs of double to float to double */
        light->vector[k] = (double)rounded;
    }
}

/* A lighting with whatever there is. */
static inline burnish_kernels_lighting random_lighting(burnish_lobe_kind kind, uint64_t *state) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    int order =
        2 << test_random32(state) % 5; /* one draw per statement: compilers order arguments */
    const lobe_case lobe = make(kind, order, EXPONENTS[test_random32(state) % EXPONENT_COUNT]);
    lighting.lobe = lobe.spec;
    lighting.material.exponent = lobe.exponent;
    lighting.light_count = (int)(test_random32(state) % 4);
    lighting.local_viewer = (int)(test_random32(state) & 1);
    lighting.specular_model =
        test_random32(state) % 4 ? BURNISH_SPECULAR_BLINN : BURNISH_SPECULAR_PHONG;
    random_unit(state, lighting.viewer);
    for (int k = 0; lighting.local_viewer && k < 3; ++k) {
        lighting.viewer[k] *= 4;
    }
    for (int i = 0; i < lighting.light_count; ++i) {
        burnish_light *light = &lighting.lights[i];
        random_direction(state, light);
        light->kind = test_random32(state) % 3 ? BURNISH_LIGHT_DIRECTIONAL : BURNISH_LIGHT_POINT;
        for (int k = 0; k < 3; ++k) {
            light->color[k] = test_uniform_float(state, 0, 1);
            light->vector[k] *= light->kind == BURNISH_LIGHT_POINT ? 3 : 1;
        }
    }
    if (test_random32(state) % 3 == 0) { /* all far: the kernel with constant half vectors */
        lighting.local_viewer = 0;
        lighting.specular_model = BURNISH_SPECULAR_BLINN;
        random_unit(state, lighting.viewer);
        for (int i = 0; i < lighting.light_count; ++i) {
            lighting.lights[i].kind = BURNISH_LIGHT_DIRECTIONAL;
            random_direction(state, &lighting.lights[i]);
        }
    }
    return lighting;
}

/* What lessens point lights, with cones toward the middle of the points. */
static inline void random_beams(uint64_t *state, burnish_kernels_lighting *lighting) {
    for (int i = 0; i < lighting->light_count; ++i) {
        burnish_light *light = &lighting->lights[i];
        const double *v = light->vector, length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const unsigned members = light->kind == BURNISH_LIGHT_POINT ? test_random32(state) % 8 : 0;
        light->distance = members & 1 ? 0.75 : 0;
        light->range = members & 2 ? 4 : 0;
        light->cone[0] = 0.9;
        light->cone[1] = test_random32(state) & 1 ? 0.9 : 0.6;
        for (int k = 0; k < 3; ++k) {
            light->axis[k] = members & 4 ? -v[k] / length : 0;
        }
    }
}

#endif
