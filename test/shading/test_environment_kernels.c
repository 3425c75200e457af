/* Kernels for light from many directions: every instruction set against scalar, bit for bit, for
 * any number of points and whatever is in the arrays; the look-up against bilinear interpolation. */
#include <math.h>

#include "shading/shading_ops.h"
#include "simd/isa.h"
#include "support.h"

enum { POINTS = 96, PADDED = POINTS + 16, SIZE = 12, STRIDE = SIZE + 2, ARRAYS = 21 };

/* A map per level, of different sizes. */
static float texels[BURNISH_LIGHT_LEVELS][2 * (STRIDE + 8) * (STRIDE + 8) * 4];
static burnish_light_map maps[BURNISH_LIGHT_LEVELS];

static void fill_maps(uint64_t *state) {
    for (int i = 0; i < BURNISH_LIGHT_LEVELS; ++i) {
        maps[i] = (burnish_light_map){.size = SIZE + 8 - i, .texels = texels[i]};
        for (size_t k = 0; k < sizeof texels[i] / sizeof *texels[i]; ++k) {
            texels[i][k] = test_uniform_float(state, 0, 4);
        }
    }
}

static float awkward(uint64_t *state, float low, float high) {
    static const float numbers[] = {NAN, INFINITY, -INFINITY, 0, -0.0f, 0x1p-140f, 0x1p100f};
    const uint32_t which = test_random32(state) % 40;
    return which < 7 ? numbers[which] : test_uniform_float(state, low, high);
}

/* Arrays that all kernels read, and colours. */
typedef struct points {
    float in[ARRAYS][PADDED], rgb[3][PADDED], axis[6][PADDED];
} points;

static void add_light(const burnish_kernels *kernels,
                      const burnish_environment_constants *constants,
                      const burnish_reflecting_material *material, int has_arrays, size_t count,
                      points *p) {
    burnish_kernels_points at = {.w = p->in[6]};
    burnish_reflecting_points each = {.open = NULL};
    for (int k = 0; k < 3; ++k) {
        at.normal[k] = p->in[k];
        at.position[k] = p->in[3 + k];
        each.diffuse[k] = has_arrays ? p->in[7 + k] : NULL;
        each.reflectance[k] = has_arrays ? p->in[10 + k] : NULL;
        each.bent[k] = has_arrays ? p->in[k] : NULL;
        each.near_diffuse[k] = has_arrays ? p->in[15 + k] : NULL;
        each.near_specular[k] = has_arrays ? p->in[18 + k] : NULL;
    }
    each.roughness = has_arrays ? p->in[13] : NULL;
    each.open = each.edge_loss = has_arrays ? p->in[14] : NULL;
    kernels->add_environment(constants, material, &at, &each, count,
                             (float *const[3]){p->rgb[0], p->rgb[1], p->rgb[2]});
    kernels->reflect_points(constants, material, &at, each.roughness, count,
                            (float *const[3]){p->axis[0], p->axis[1], p->axis[2]},
                            has_arrays ? (float *const[3]){p->axis[3], p->axis[4], p->axis[5]}
                                       : NULL);
}

static void test_isa(const burnish_kernels *kernels) {
    static points start, a, b;
    uint64_t state = test_seed(11);
    fill_maps(&state);
    for (int trial = 0; trial < 600; ++trial) {
        const size_t count = trial < POINTS ? (size_t)trial : test_random32(&state) % POINTS;
        const uint32_t bits = test_random32(&state);
        const int is_awkward = bits & 1;
        burnish_environment_constants constants = {.local_viewer = bits >> 1 & 1,
                                                   .diffuse = bits >> 2 & 3 ? maps + 3 : NULL,
                                                   .nearness = bits >> 8 & 1 ? 0.6f : 0};
        burnish_reflecting_material material = {.roughness = test_uniform_float(&state, 0, 1),
                                                .reflects = bits >> 4 & 1,
                                                .is_metallic = bits >> 5 & 1,
                                                .has_levels = bits >> 6 & 1,
                                                .specular = maps};
        for (int k = 0; k < 9; ++k) {
            constants.axes[k / 3][k % 3] = test_uniform_float(&state, -1, 1);
            constants.viewer[k % 3] = test_uniform_float(&state, -1, 1);
            constants.offset[k % 3] = test_uniform_float(&state, -1, 1);
            material.diffuse[k % 3] = test_uniform_float(&state, 0, 1);
            material.reflectance[k % 3] = test_uniform_float(&state, 0, 1);
        }
        for (int i = 0; i < ARRAYS * PADDED; ++i) {
            const float low = i < 6 * PADDED ? -1 : 0;
            start.in[i / PADDED][i % PADDED] =
                is_awkward ? awkward(&state, low, 1) : test_uniform_float(&state, low, 1);
            start.rgb[i % 3][i % PADDED] = test_uniform_float(&state, 0, 1);
        }
        a = b = start;
        add_light(burnish_kernels_for(BURNISH_ISA_SCALAR), &constants, &material, bits >> 7 & 1,
                  count, &a);
        add_light(kernels, &constants, &material, bits >> 7 & 1, count, &b);
        for (int k = 0; k < 3; ++k) {
            CHECK(memcmp(a.rgb[k], b.rgb[k], count * sizeof(float)) == 0, "trial %d: colours",
                  trial);
            for (int j = k; j < 6; j += 3) {
                CHECK(is_awkward || memcmp(a.axis[j], b.axis[j], count * sizeof(float)) == 0,
                      "trial %d: axes", trial);
            }
            CHECK(memcmp(b.rgb[k] + (count + 15) / 16 * 16, start.rgb[k] + (count + 15) / 16 * 16,
                         (PADDED - (count + 15) / 16 * 16) * sizeof(float)) == 0,
                  "trial %d: wrote past the vectors", trial);
        }
    }
}

/* ---- The look-up ---- */

/* Of one channel, as light_map.h says. */
static double look_up(const burnish_light_map *map, int channel, const double w[3]) {
    const double d = map->size / (2 * (1 + fabs(w[2]))), middle = (map->size + 1) / 2.0;
    const double x = w[0] * d + middle, y = w[1] * d + middle;
    const int i = (int)x, j = (int)y, stride = map->size + 2;
    const float *t = map->texels + 4 * ((j + (w[2] < 0 ? stride : 0)) * stride + i) + channel;
    const double top = (1 - (x - i)) * (double)t[0] + (x - i) * (double)t[4];
    const double low = (1 - (x - i)) * (double)t[4 * stride] + (x - i) * (double)t[4 * stride + 4];
    return (1 - (y - j)) * top + (y - j) * low;
}

/* A matt surface has the colour of the map in the direction of its normal. */
static void test_look_up(void) {
    static points p;
    uint64_t state = test_seed(12);
    const burnish_environment_constants constants = {
        .viewer = {0, 0, 1}, .axes = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, .diffuse = maps};
    const burnish_reflecting_material material = {.diffuse = {1, 1, 1}};
    fill_maps(&state);
    for (int i = 0; i < POINTS; ++i) {
        double squared = 0;
        for (int k = 0; k < 3; ++k) {
            const float x = test_uniform_float(&state, -1, 1);
            p.in[k][i] = x;
            p.rgb[k][i] = 0;
            squared += (double)x * (double)x;
        }
        p.in[6][i] = (float)sqrt(squared);
    }
    add_light(burnish_kernels_best(), &constants, &material, 0, POINTS, &p);
    for (int i = 0; i < POINTS; ++i) {
        const double length = (double)p.in[6][i];
        const double w[3] = {(double)p.in[1][i] / length, (double)p.in[2][i] / length,
                             (double)p.in[0][i] / length};
        for (int k = 0; k < 3; ++k) {
            const double want = look_up(maps, k, w);
            CHECK(fabs((double)p.rgb[k][i] - want) < 1e-4, "point %d: %g, not %g", i,
                  (double)p.rgb[k][i], want);
        }
    }
}

/* A mirror has the colour of the map in the mirror direction plus nearness times where the point is from
 * the object's middle; positions count from the eye, 3 away. */
static void test_nearness(void) {
    static points p;
    uint64_t state = test_seed(13);
    const double nearness = 0.4, w = 0.5;
    const burnish_environment_constants constants = {.viewer = {0, 0, 1},
                                                     .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                     .nearness = (float)nearness,
                                                     .offset = {0, 0, (float)(3 * nearness)},
                                                     .diffuse = maps};
    const burnish_reflecting_material mirror = {
        .reflectance = {1, 1, 1}, .reflects = 1, .is_metallic = 1, .specular = maps};
    fill_maps(&state);
    memset(&p, 0, sizeof p);
    for (int i = 0; i < POINTS; ++i) {
        p.in[6][i] = (float)w;
        for (int k = 0; k < 3; ++k) {
            p.in[k][i] = test_uniform_float(&state, -1, 1);
            p.in[3 + k][i] = test_uniform_float(&state, -0.3f, 0.3f) - (k == 2 ? 3 * (float)w : 0);
        }
    }
    add_light(burnish_kernels_best(), &constants, &mirror, 0, POINTS, &p);
    for (int i = 0; i < POINTS; ++i) {
        const double n[3] = {(double)p.in[0][i], (double)p.in[1][i], (double)p.in[2][i]};
        const double squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        double toward[3], length = 0;
        for (int k = 0; k < 3; ++k) {
            const double place = (double)p.in[3 + k][i] / w + (k == 2 ? 3 : 0);
            toward[k] = 2 * n[2] * n[k] / squared - (k == 2) + nearness * place;
            length += toward[k] * toward[k];
        }
        for (int k = 0; k < 3; ++k) {
            toward[k] /= sqrt(length);
        }
        for (int k = 0; k < 3; ++k) {
            const double want = look_up(maps, k, toward);
            CHECK(fabs((double)p.rgb[k][i] - want) < 2e-4, "point %d: %g, not %g", i,
                  (double)p.rgb[k][i], want);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_kernels *kernels = burnish_kernels_for((burnish_isa)isa);
        if (kernels) {
            RUN(test_isa(kernels));
        }
    }
    RUN(test_look_up());
    RUN(test_nearness());
    return test_end("environment_kernels");
}
