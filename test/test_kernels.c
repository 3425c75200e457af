/* The kernels: every instruction set against scalar, bit for bit; lobes against burnish/lobe.h and
 * libm; the lighting against the same equation in double precision; the choice of one.
 *
 * Needs nothing but src/kernels and src/base, so that it also runs on other processors. With
 * --bench it then prints the time of every variant; `bench_kernels` compares with others. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "burnish/kernels.h"
#include "simd/isa_ops.h"
#include "support.h"

/* What kernels/vector_math.h states. */
#define POWER_ERROR 1e-7
#define GAUSSIAN_ERROR 1e-7
#define INVERSE_SQRT_ERROR 1.04e-7

enum { BLOCK = 4096, GUARD = 32, MOST_LANES = 16 };

static const float EXPONENTS[] = {1, 2, 3.5f, 8, 18, 32, 100, 256, 1000, 4096, 65536};
enum { EXPONENT_COUNT = sizeof EXPONENTS / sizeof EXPONENTS[0] };

static const burnish_kernels *scalar(void) {
    return burnish_kernels_for(BURNISH_ISA_SCALAR);
}

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static float from_bits(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Numbers that find differences: any bits, special ones, and cosines. */
static float awkward(uint64_t *state) {
    static const uint32_t special[] = {0,          0x80000000, 1,          0x80000001, 0x007fffff,
                                       0x00800000, 0x3f800000, 0x3f7fffff, 0x3f800001, 0xbf800000,
                                       0x7f800000, 0xff800000, 0x7fc00000, 0xffc12345, 0x7f7fffff};
    uint32_t choice = test_random32(state) % 8;
    if (choice == 0) {
        return from_bits(special[test_random32(state) % (sizeof special / sizeof special[0])]);
    }
    return choice == 1 ? from_bits(test_random32(state)) : test_uniform_float(state, -0.25f, 1.0f);
}

/* The kinds that have kernels. */
static const burnish_lobe_kind KINDS[] = {
    BURNISH_LOBE_FAMILY,   BURNISH_LOBE_POWER, BURNISH_LOBE_WHOLE_POWER, BURNISH_LOBE_SCHLICK,
    BURNISH_LOBE_GAUSSIAN, BURNISH_LOBE_GX,    BURNISH_LOBE_LYON,
};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0], LYON_AT = KIND_COUNT - 1 };

/* A lobe, its exponent and, for the family and Lyon's, what burnish/lobe.h makes of them. */
typedef struct lobe_case {
    burnish_lobe_spec spec;
    float exponent;
    burnish_lobe family;
} lobe_case;

static lobe_case make(burnish_lobe_kind kind, int order, float exponent) {
    order = burnish_lobe_highest_order(order, exponent);
    lobe_case lobe = {{.kind = kind, .fit = BURNISH_FIT_ENERGY, .order = order}, exponent, {0, 0}};
    if (kind == BURNISH_LOBE_WHOLE_POWER) {
        lobe.exponent = (float)(uint32_t)exponent;
    }
    burnish_lobe_create(&lobe.family,
                        kind == BURNISH_LOBE_LYON ? BURNISH_FIT_TAYLOR : BURNISH_FIT_ENERGY, order,
                        exponent);
    return lobe;
}

/* ---- Instruction sets ---- */

/* One call on a misaligned array between guard bytes; `values` receives what was written. */
static int run_lobe(const burnish_kernels *batch, const lobe_case *lobe, int lambda,
                    const float *cosines, size_t count, size_t shift, float *values) {
    static float buffer[BLOCK + 2 * GUARD + MOST_LANES];
    int damaged = 0;
    memset(buffer, 0xa5, sizeof buffer);
    float *out = buffer + GUARD + shift;
    burnish_status status =
        lambda ? burnish_kernels_lobe_of_lambdas(batch, &lobe->spec, lobe->exponent, count, cosines,
                                                 out, NULL)
               : burnish_kernels_lobe_of_cosines(batch, &lobe->spec, lobe->exponent, count, cosines,
                                                 out, NULL);
    memcpy(values, out, count * sizeof *values);
    memset(out, 0xa5, count * sizeof *out);
    for (size_t i = 0; i < sizeof buffer / sizeof buffer[0]; ++i) {
        damaged |= bits_of(buffer[i]) != 0xa5a5a5a5u;
    }
    return status == BURNISH_STATUS_OK && !damaged;
}

static void check_lobe_of_isa(const burnish_kernels *batch, const lobe_case *lobe,
                              uint64_t *state) {
    static float cosines[BLOCK + MOST_LANES], expected[BLOCK], values[BLOCK];
    const char *name = burnish_isa_name(burnish_kernels_isa(batch));
    for (int lambda = 0; lambda < 2; ++lambda) {
        for (size_t count = 0; count <= BLOCK; count = count < 50 ? count + 1 : count + 1349) {
            size_t shift = test_random32(state) % MOST_LANES;
            float *in = cosines + test_random32(state) % MOST_LANES;
            for (size_t i = 0; i < count; ++i) {
                in[i] = awkward(state);
            }
            int ok = run_lobe(scalar(), lobe, lambda, in, count, 0, expected) &&
                     run_lobe(batch, lobe, lambda, in, count, shift, values);
            size_t i = 0;
            while (i < count && bits_of(values[i]) == bits_of(expected[i])) {
                ++i;
            }
            CHECK(ok, "%s, kind %d, %zu cosines: wrote beside the array or failed", name,
                  lobe->spec.kind, count);
            CHECK(i == count, "%s, kind %d, order %d, exponent %g: %.9g gives %.9g, not %.9g", name,
                  lobe->spec.kind, lobe->family.order, (double)lobe->exponent,
                  i < count ? (double)in[i] : 0, i < count ? (double)values[i] : 0,
                  i < count ? (double)expected[i] : 0);
        }
    }
}

static void check_lobes_of_isa(const burnish_kernels *batch, uint64_t *state) {
    for (int k = 0; k < KIND_COUNT; ++k) {
        for (int e = 0; e < EXPONENT_COUNT; ++e) {
            int highest = KINDS[k] == BURNISH_LOBE_FAMILY ? 32 : 2;
            for (int order = 2; order <= highest; order *= 2) {
                lobe_case lobe = make(KINDS[k], order, EXPONENTS[e]);
                check_lobe_of_isa(batch, &lobe, state);
            }
        }
    }
}

/* Arrays that are written past the caches: the same values, also in place. */
static void check_streaming(const burnish_kernels *batch) {
    const size_t count = (8u << 20) / sizeof(float) + 37;
    float *in = malloc((count + 3) * sizeof *in);
    lobe_case lobe = make(BURNISH_LOBE_FAMILY, 2, 32);
    uint64_t state = test_seed(99);
    size_t wrong = 0;
    if (!CHECK(in, "memory for %zu floats", count)) {
        return;
    }
    for (size_t i = 0; i < count + 3; ++i) {
        in[i] = test_uniform_float(&state, 0, 1);
    }
    state = test_seed(99);
    burnish_kernels_lobe_of_cosines(batch, &lobe.spec, lobe.exponent, count, in + 1, in + 1, NULL);
    for (size_t i = 0; i < count + 3; ++i) {
        float x = test_uniform_float(&state, 0, 1);
        float want = i >= 1 && i < count + 1 ? burnish_lobe_at_cosine(lobe.family, x) : x;
        wrong += bits_of(in[i]) != bits_of(want);
    }
    CHECK(wrong == 0, "%s: %zu of %zu streamed values differ",
          burnish_isa_name(burnish_kernels_isa(batch)), wrong, count);
    free(in);
}

/* ---- Lighting ---- */

typedef struct point_arrays {
    float normal[3][BLOCK], position[3][BLOCK], diffuse[3][BLOCK], w[BLOCK];
} point_arrays;

/* Points near the unit sphere, normals of lengths near 1 and, unless tame, some that are awkward.
 */
static void make_points(point_arrays *arrays, size_t count, int tame, uint64_t *state) {
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

static burnish_kernels_points points_at(const point_arrays *arrays, size_t first, int with_diffuse,
                                        int with_w) {
    burnish_kernels_points points = {.w = with_w ? arrays->w + first : NULL};
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = arrays->normal[k] + first;
        points.position[k] = arrays->position[k] + first;
        points.diffuse[k] = with_diffuse ? arrays->diffuse[k] + first : NULL;
    }
    return points;
}

static void random_unit(uint64_t *state, float v[3]) {
    double x = (double)test_uniform_float(state, -1, 1),
           y = (double)test_uniform_float(state, -1, 1), z = 0.3;
    double length = sqrt(x * x + y * y + z * z);
    v[0] = (float)(x / length);
    v[1] = (float)(y / length);
    v[2] = (float)(z / length);
}

static void random_direction(uint64_t *state, burnish_light *light) {
    float v[3];
    random_unit(state, v);
    for (int k = 0; k < 3; ++k) {
        volatile float rounded = v[k]; /* GCC 12 leaves out pairs of double to float to double */
        light->vector[k] = (double)rounded;
    }
}

/* A lighting with whatever there is. */
static burnish_kernels_lighting random_lighting(burnish_lobe_kind kind, uint64_t *state) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    int order = 2 << test_random32(state) % 5; /* one draw a statement: compilers order arguments */
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

static void check_shade_of_isa(const burnish_kernels *batch, uint64_t *state) {
    static point_arrays arrays;
    static uint8_t pixels[2][4 * (BLOCK + 1)];
    static float colors[2][3][BLOCK + 1];
    const char *name = burnish_isa_name(burnish_kernels_isa(batch));
    for (int trial = 0; trial < 1200; ++trial) {
        burnish_lobe_kind kind = KINDS[trial % KIND_COUNT];
        burnish_kernels_lighting lighting = random_lighting(kind, state);
        burnish_kernels_shader *shader;
        burnish_error error;
        size_t count = trial % 50 == 49 ? BLOCK - MOST_LANES : test_random32(state) % 70;
        int wrong = 0;
        make_points(&arrays, BLOCK, trial & 1, state);
        if (!CHECK(burnish_kernels_shader_create(&lighting, NULL, &shader, &error) ==
                       BURNISH_STATUS_OK,
                   "shader: %s", error.text)) {
            continue;
        }
        burnish_kernels_points points =
            points_at(&arrays, test_random32(state) % MOST_LANES, (int)(test_random32(state) & 1),
                      (int)(test_random32(state) & 1));
        memset(pixels, 0x5a, sizeof pixels);
        memset(colors, 0x5a, sizeof colors);
        for (int which = 0; which < 2; ++which) {
            const burnish_kernels *one = which ? batch : scalar();
            float *const rgb[3] = {colors[which][0], colors[which][1], colors[which][2]};
            wrong |= burnish_kernels_shade_rgba8(one, shader, &points, count, pixels[which],
                                                 NULL) != BURNISH_STATUS_OK;
            wrong |= burnish_kernels_shade_float(one, shader, &points, count, rgb, NULL) !=
                     BURNISH_STATUS_OK;
        }
        CHECK(!wrong, "%s: shading failed", name);
        CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0, "%s: trial %d, kind %d: pixels",
              name, trial, kind);
        CHECK(memcmp(colors[0], colors[1], sizeof colors[0]) == 0, "%s: trial %d, kind %d: colours",
              name, trial, kind);
        CHECK(pixels[1][4 * count] == 0x5a, "%s: wrote past the pixels", name);
        burnish_kernels_shader_destroy(shader);
    }
}

static void check_normalize_of_isa(const burnish_kernels *batch, uint64_t *state) {
    static float in[3][100], out[2][3][100];
    int different = 0;
    for (size_t count = 0; count < 100; ++count) {
        for (int k = 0; k < 3; ++k) {
            for (size_t i = 0; i < count; ++i) {
                in[k][i] = test_uniform_float(state, -1e3f, 1e3f);
            }
        }
        const float *const from[3] = {in[0], in[1], in[2]};
        memset(out, 0, sizeof out);
        for (int which = 0; which < 2; ++which) {
            float *const to[3] = {out[which][0], out[which][1], out[which][2]};
            burnish_kernels_normalize(which ? batch : scalar(), count, from, to);
        }
        different += memcmp(out[0], out[1], sizeof out[0]) != 0;
    }
    CHECK(different == 0, "%s: %d arrays are normalised differently",
          burnish_isa_name(burnish_kernels_isa(batch)), different);
}

static void check_instruction_sets(void) {
    uint32_t mask = burnish_isa_available();
    uint64_t state = test_seed(0x2545f491);
    printf("instruction sets:");
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_kernels *batch = burnish_kernels_for((burnish_isa)isa);
        CHECK(!batch == !(mask >> isa & 1), "%s: a table where the instruction set is",
              burnish_isa_name((burnish_isa)isa));
        if (!batch) {
            continue;
        }
        printf(" %s", burnish_isa_name((burnish_isa)isa));
        CHECK((int)burnish_kernels_isa(batch) == isa, "the table of %d", isa);
        check_lobes_of_isa(batch, &state);
        check_streaming(batch);
        check_shade_of_isa(batch, &state);
        check_normalize_of_isa(batch, &state);
    }
    printf("\n");
}

/* ---- Processors ---- */

/* FNV-1a over what the scalar kernels give for fixed input: the same on every processor, with every
 * compiler. It changes with the kernels' arithmetic only; then pixels change too. */
#define SCALAR_HASH 0x7c39e9d686512d2u

static uint64_t add_bytes(uint64_t hash, const void *data, size_t size) {
    const uint8_t *bytes = data;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ bytes[i]) * 0x100000001b3u;
    }
    return hash;
}

/* Every NaN counts as one: which operand's payload comes through is the compiler's choice. */
static uint64_t add_floats(uint64_t hash, const float *values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t bits = isnan(values[i]) ? 0x7fc00000 : bits_of(values[i]);
        uint8_t bytes[4] = {(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16),
                            (uint8_t)(bits >> 24)};
        hash = add_bytes(hash, bytes, sizeof bytes);
    }
    return hash;
}

static void check_processors(void) {
    static float in[BLOCK], out[BLOCK], colors[3][BLOCK];
    static uint8_t pixels[4 * BLOCK];
    static point_arrays arrays;
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    uint64_t hash = 0xcbf29ce484222325u;
    uint64_t state = 1234567;
    for (int k = 0; k < KIND_COUNT; ++k) {
        for (int e = 0; e < EXPONENT_COUNT; ++e) {
            lobe_case lobe = make(KINDS[k], 2 << e % 5, EXPONENTS[e]);
            for (int i = 0; i < BLOCK; ++i) {
                in[i] = awkward(&state);
            }
            burnish_kernels_lobe_of_cosines(scalar(), &lobe.spec, lobe.exponent, BLOCK, in, out,
                                            NULL);
            hash = add_floats(hash, out, BLOCK);
            burnish_kernels_lobe_of_lambdas(scalar(), &lobe.spec, lobe.exponent, BLOCK, in, out,
                                            NULL);
            hash = add_floats(hash, out, BLOCK);
        }
    }
    for (int trial = 0; trial < 80; ++trial) {
        burnish_kernels_lighting lighting = random_lighting(KINDS[trial % KIND_COUNT], &state);
        burnish_kernels_shader *shader;
        make_points(&arrays, BLOCK, trial & 1, &state);
        burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
        burnish_kernels_points points = points_at(&arrays, 0, trial & 2, trial & 4);
        burnish_kernels_shade_float(scalar(), shader, &points, BLOCK, rgb, NULL);
        burnish_kernels_shade_rgba8(scalar(), shader, &points, BLOCK, pixels, NULL);
        for (int k = 0; k < 3; ++k) {
            hash = add_floats(hash, colors[k], BLOCK);
        }
        hash = add_bytes(hash, pixels, sizeof pixels);
        burnish_kernels_shader_destroy(shader);
    }
    CHECK(hash == SCALAR_HASH, "hash %#llx", (unsigned long long)hash);
}

/* ---- Values ---- */

static double accurate_lobe(const lobe_case *lobe, double c) {
    double n = (double)lobe->exponent, u;
    switch (lobe->spec.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
        u = 1 - (double)lobe->family.zeta * (1 - (c < 1 ? c : 1));
        return u > 0 ? pow(u, lobe->family.order) : 0;
    case BURNISH_LOBE_POWER:
    case BURNISH_LOBE_WHOLE_POWER:
        return c > 0 ? pow(c < 1 ? c : 1, n) : 0;
    case BURNISH_LOBE_GAUSSIAN:
        return exp(-(n + 0.775) * (1 - (c < 1 ? c : 1)));
    case BURNISH_LOBE_SCHLICK:
        return c > 0 ? c / (c + n * (1 - c)) : 0;
    case BURNISH_LOBE_GX:
        return c > 0 ? c * c / (c * c + n / 2 * (1 - c * c)) : 0;
    default:
        return 0;
    }
}

static void check_power_accuracy(burnish_lobe_kind kind, double bound) {
    static float cosines[BLOCK], values[BLOCK];
    double worst = 0;
    for (int e = 0; e < EXPONENT_COUNT; ++e) {
        lobe_case lobe = make(kind, 2, EXPONENTS[e]);
        /* dense near 1, where the lobe lives: lambda from 0 to 40 / n, at most 1 */
        double reach = 40 / (double)EXPONENTS[e] < 1 ? 40 / (double)EXPONENTS[e] : 1;
        for (int block = 0; block < 256; ++block) {
            for (int i = 0; i < BLOCK; ++i) {
                cosines[i] = (float)(1 - reach * (block * BLOCK + i) / (256 * BLOCK));
            }
            burnish_kernels_lobe_of_cosines(scalar(), &lobe.spec, lobe.exponent, BLOCK, cosines,
                                            values, NULL);
            for (int i = 0; i < BLOCK; ++i) {
                double error = fabs((double)values[i] - accurate_lobe(&lobe, (double)cosines[i]));
                worst = error > worst ? error : worst;
            }
        }
    }
    printf("kind %d: largest absolute error %.3g\n", kind, worst);
    CHECK(worst <= bound, "kind %d: %.3g", kind, worst);
}

/* The array forms of burnish/lobe.h are those, bit for bit, for a stride over all floats. */
static float single(const lobe_case *lobe, int lambda, float x) {
    switch (lobe->spec.kind) {
    case BURNISH_LOBE_SCHLICK:
        return burnish_schlick_at_cosine(lambda ? 1.0f - x : x, lobe->exponent);
    case BURNISH_LOBE_GX:
        return burnish_gx_at_cosine(lambda ? 1.0f - x : x, lobe->exponent);
    default:
        return lambda ? burnish_lobe_at_lambda(lobe->family, x)
                      : burnish_lobe_at_cosine(lobe->family, x);
    }
}

static void check_all_floats(burnish_lobe_kind kind, int order, int has_single) {
    static float in[BLOCK], values[BLOCK];
    for (int e = 0; e < EXPONENT_COUNT; ++e) {
        lobe_case lobe = make(kind, order, EXPONENTS[e]);
        for (int lambda = 0; lambda < 2; ++lambda) {
            int bad = 0, different = 0;
            for (uint64_t bits = 0; bits <= UINT32_MAX;) {
                size_t count = 0;
                for (; count < BLOCK && bits <= UINT32_MAX; ++count, bits += 65521) {
                    in[count] = from_bits((uint32_t)bits);
                }
                run_lobe(scalar(), &lobe, lambda, in, count, 0, values);
                for (size_t i = 0; i < count; ++i) {
                    bad += !(values[i] >= 0 && values[i] <= 1);
                    bad += in[i] != in[i] && values[i] != 0;
                    different +=
                        has_single && bits_of(single(&lobe, lambda, in[i])) != bits_of(values[i]);
                }
            }
            CHECK(bad == 0, "kind %d, exponent %g: %d values outside [0, 1]", kind,
                  (double)EXPONENTS[e], bad);
            CHECK(different == 0, "kind %d, exponent %g: %d values differ from burnish/lobe.h",
                  kind, (double)EXPONENTS[e], different);
        }
    }
}

static void check_values(void) {
    check_power_accuracy(BURNISH_LOBE_POWER, POWER_ERROR);
    check_power_accuracy(BURNISH_LOBE_GAUSSIAN, GAUSSIAN_ERROR);
    for (int order = 2; order <= 32; order *= 2) {
        check_all_floats(BURNISH_LOBE_FAMILY, order, 1);
    }
    check_all_floats(BURNISH_LOBE_SCHLICK, 2, 1);
    check_all_floats(BURNISH_LOBE_GX, 2, 1);
    check_all_floats(BURNISH_LOBE_POWER, 2, 0);
    check_all_floats(BURNISH_LOBE_WHOLE_POWER, 2, 0);
    check_all_floats(BURNISH_LOBE_GAUSSIAN, 2, 0);
    lobe_case whole = make(BURNISH_LOBE_WHOLE_POWER, 2, 37);
    float c[3] = {0.9f, 1, 0.5f}, values[3];
    burnish_kernels_lobe_of_cosines(scalar(), &whole.spec, whole.exponent, 3, c, values, NULL);
    CHECK(fabs((double)values[0] - pow((double)0.9f, 37)) < 1e-8, "0.9^37: %g", (double)values[0]);
    CHECK(values[1] == 1 && values[2] == 0x1p-37f, "1 and 2^-37: %g %g", (double)values[1],
          (double)values[2]);
}

/* The inverse root shows in normalised vectors along an axis: x / |x|, over two octaves. */
static void check_normalize(void) {
    static float in[3][BLOCK], out[3][BLOCK];
    const float *const from[3] = {in[0], in[1], in[2]};
    float *const to[3] = {out[0], out[1], out[2]};
    double worst = 0;
    for (uint32_t bits = 0x3f800000; bits < 0x40800000;) {
        for (int i = 0; i < BLOCK; ++i, bits += 3) {
            in[0][i] = from_bits(bits);
        }
        burnish_kernels_normalize(scalar(), BLOCK, from, to);
        for (int i = 0; i < BLOCK; ++i) {
            double error = fabs((double)out[0][i] - 1);
            worst = error > worst ? error : worst;
        }
    }
    /* the square and the product are rounded too: half a unit each */
    CHECK(worst <= INVERSE_SQRT_ERROR + 0x1p-24, "x / |x| is off by %.3g", worst);
    in[0][0] = 3;
    in[1][0] = 4;
    in[0][1] = 0x1p-60f;
    in[1][1] = -0x1p60f;
    in[0][2] = in[1][2] = 0;
    in[1][2] = 0;
    burnish_kernels_normalize(scalar(), 3, from, to);
    CHECK(fabsf(out[0][0] - 0.6f) < 1.5e-7f && fabsf(out[1][0] - 0.8f) < 1.5e-7f,
          "3-4-5: %.9g %.9g", (double)out[0][0], (double)out[1][0]);
    CHECK(out[1][1] < -0.9999998f && out[1][1] > -1.0000002f, "a long one: %.9g",
          (double)out[1][1]);
    CHECK(out[0][2] == 0 && out[1][2] == 0 && out[2][2] == 0, "no direction stays zero");
}

typedef struct vec {
    double x, y, z;
} vec;

static vec scaled(vec a, double s) {
    return (vec){a.x * s, a.y * s, a.z * s};
}
static double dot(vec a, vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static vec sum(vec a, vec b) {
    return (vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static vec unit(vec a) {
    return scaled(a, 1 / sqrt(dot(a, a)));
}
static vec load(const float v[3]) {
    return (vec){(double)v[0], (double)v[1], (double)v[2]};
}

/* The equation of burnish/kernels.h, as it stands there. Returns 0 where a float's rounding shows
 * in the colour: where the light is on the horizon, which switches the highlight off, and where the
 * half vector or a direction is a difference of nearly equal vectors. */
static int accurate_color(const burnish_kernels_lighting *lighting, const lobe_case *lobe,
                          vec normal, vec place, const double diffuse[3], double color[3]) {
    vec n = unit(normal), v = load(lighting->viewer);
    double specular[3] = {0, 0, 0};
    v = lighting->local_viewer ? sum(v, scaled(place, -1)) : v;
    int stable = dot(v, v) > 0.25;
    v = unit(v);
    for (int k = 0; k < 3; ++k) {
        color[k] = (double)lighting->ambient_light[k] * (double)lighting->material.ambient[k];
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        const burnish_light *light = &lighting->lights[i];
        vec l = {light->vector[0], light->vector[1], light->vector[2]};
        l = light->kind == BURNISH_LIGHT_POINT ? sum(l, scaled(place, -1)) : l;
        stable &= dot(l, l) > 0.25;
        l = unit(l);
        vec half = sum(l, v);
        double lit = dot(n, l), c = dot(n, unit(half));
        stable &= fabs(lit) > 1e-6 && dot(half, half) > 0.25;
        if (lighting->specular_model == BURNISH_SPECULAR_PHONG) {
            c = 2 * lit * dot(n, v) - dot(l, v);
        }
        double value = lit > 0 ? accurate_lobe(lobe, c) : 0;
        for (int k = 0; k < 3; ++k) {
            double brightness = (double)light->color[k];
            color[k] += brightness * (double)lighting->material.diffuse[k] * (lit > 0 ? lit : 0);
            specular[k] += brightness * (double)lighting->material.specular[k] * value;
        }
    }
    for (int k = 0; k < 3; ++k) {
        color[k] = color[k] * diffuse[k] + specular[k];
    }
    return stable;
}

static void check_equation(void) {
    static point_arrays arrays;
    static float colors[3][BLOCK];
    static uint8_t pixels[4 * BLOCK];
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    uint64_t state = test_seed(77);
    double worst = 0, slope_worst = 0;
    int bright = 0, pixel_errors = 0;
    for (int trial = 0; trial < 60; ++trial) {
        burnish_kernels_lighting lighting = random_lighting(KINDS[trial % LYON_AT], &state);
        burnish_kernels_shader *shader;
        make_points(&arrays, BLOCK, 1, &state);
        burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
        burnish_kernels_points points = points_at(&arrays, 0, 1, 1);
        burnish_kernels_shade_float(scalar(), shader, &points, BLOCK, rgb, NULL);
        burnish_kernels_shade_rgba8(scalar(), shader, &points, BLOCK, pixels, NULL);
        burnish_kernels_shader_destroy(shader);
        /* a cosine is off by 1e-7 at three lights, and the lobe by that times its slope */
        lobe_case lobe = make(lighting.lobe.kind, lighting.lobe.order, lighting.material.exponent);
        double slope = lighting.lobe.kind == BURNISH_LOBE_FAMILY
                           ? (double)lobe.family.zeta * lobe.family.order
                           : (double)lobe.exponent + 1;
        for (int i = 0; i < BLOCK; ++i) {
            double w = (double)arrays.w[i], color[3], d[3];
            vec normal = {(double)arrays.normal[0][i], (double)arrays.normal[1][i],
                          (double)arrays.normal[2][i]};
            vec place = {(double)arrays.position[0][i] / w, (double)arrays.position[1][i] / w,
                         (double)arrays.position[2][i] / w};
            for (int k = 0; k < 3; ++k) {
                d[k] = (double)arrays.diffuse[k][i];
            }
            if (dot(normal, normal) < 0.25 ||
                !accurate_color(&lighting, &lobe, normal, place, d, color)) {
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                double error = fabs((double)colors[k][i] - color[k]) / (4e-7 + 3e-7 * slope);
                double level = color[k] < 1 ? color[k] * 255 : 255;
                worst = error > worst ? error : worst;
                slope_worst = slope > slope_worst ? slope : slope_worst;
                bright += color[k] > 0.5;
                pixel_errors += fabs(pixels[4 * i + k] - level) > 0.5 + 255 * (4e-7 + 3e-7 * slope);
            }
            pixel_errors += pixels[4 * i + 3] != 255;
        }
    }
    printf("the equation: at most %.2f of the bound\n", worst);
    CHECK(worst < 1, "the equation is off by %.3g of its bound", worst);
    CHECK(bright > 10000, "only %d bright values: the test sees nothing", bright);
    CHECK(pixel_errors == 0, "%d pixels are not the rounded colours", pixel_errors);
}

/* Lyon's lobe is burnish_lyon_at_vectors of the same vectors. */
static void check_lyon(void) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_kernels_shader *shader;
    uint64_t state = test_seed(5);
    double worst = 0;
    lighting.lobe = (burnish_lobe_spec){.kind = BURNISH_LOBE_LYON, .order = 4};
    lighting.material.exponent = 40;
    for (int k = 0; k < 3; ++k) {
        lighting.material.ambient[k] = lighting.material.diffuse[k] = 0;
        lighting.material.specular[k] = 1;
    }
    burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
    const double *light = lighting.lights[0].vector;
    vec h = unit(sum((vec){light[0], light[1], light[2]}, load(lighting.viewer)));
    for (int i = 0; i < 2000; ++i) {
        vec n = unit((vec){h.x + (double)test_uniform_float(&state, -0.3f, 0.3f),
                           h.y + (double)test_uniform_float(&state, -0.3f, 0.3f), h.z});
        n = scaled(n, (double)test_uniform_float(&state, 0.9f, 1.1f));
        float normal[3] = {(float)n.x, (float)n.y, (float)n.z}, color[3];
        float half[3] = {(float)h.x, (float)h.y, (float)h.z};
        float *const rgb[3] = {&color[0], &color[1], &color[2]};
        burnish_kernels_points points = {.normal = {&normal[0], &normal[1], &normal[2]}};
        burnish_kernels_shade_float(scalar(), shader, &points, 1, rgb, NULL);
        double error =
            fabs((double)color[0] - (double)burnish_lyon_at_vectors(normal, half, 40, 4));
        worst = error > worst ? error : worst;
    }
    burnish_kernels_shader_destroy(shader);
    CHECK(worst < 1e-4, "Lyon's lobe is off by %.3g", worst);
}

/* ---- Arguments and instruction sets ---- */

static void check_errors(void) {
    burnish_kernels_lighting good = burnish_kernels_lighting_default(), bad;
    burnish_kernels_shader *shader;
    burnish_error error;
    float value = 0.5f;
    uint8_t pixel[4];
    lobe_case lobe = make(BURNISH_LOBE_WHOLE_POWER, 2, 3);
    burnish_kernels_points points = {.normal = {&value, &value, &value}};
#define REFUSED(change)                                                                            \
    do {                                                                                           \
        bad = good;                                                                                \
        change;                                                                                    \
        error.text[0] = 0;                                                                         \
        CHECK(burnish_kernels_shader_create(&bad, NULL, &shader, &error) ==                        \
                      BURNISH_STATUS_ARGUMENT &&                                                   \
                  error.text[0],                                                                   \
              "refused: " #change);                                                                \
        CHECK(burnish_kernels_shade_rgba8(scalar(), shader, &points, 1, pixel, NULL) ==            \
                  BURNISH_STATUS_ARGUMENT,                                                         \
              "no shader: " #change);                                                              \
    } while (0)
    REFUSED(bad.cookie = 0);
    REFUSED(bad.material.ambient[1] = NAN);
    REFUSED(bad.material.diffuse[2] = -1);
    REFUSED(bad.material.specular[0] = 2e6f);
    REFUSED(bad.light_count = BURNISH_LIGHT_MAX + 1);
    REFUSED(bad.light_count = -1);
    REFUSED(bad.lights[0].vector[0] = 3);
    REFUSED(bad.lights[0].color[0] = -1);
    REFUSED(bad.viewer[2] = 0);
    REFUSED((bad.local_viewer = 1, bad.viewer[0] = INFINITY));
    REFUSED((bad.lobe.kind = BURNISH_LOBE_POWER, bad.material.exponent = 0.5f));
    REFUSED((bad.lobe.kind = BURNISH_LOBE_WHOLE_POWER, bad.material.exponent = 2.5f));
    REFUSED(bad.lobe.kind = BURNISH_LOBE_NV2X);
    REFUSED(bad.lobe.kind = BURNISH_LOBE_KIND_COUNT);
    REFUSED(bad.lobe.order = 3);
    REFUSED(bad.lobe = (burnish_lobe_spec){0});
    REFUSED((bad.lobe.order = 8, bad.material.exponent = 5));
    REFUSED(bad.lights[0].follows_camera = 1);
    REFUSED(bad.ambient_light[0] = -1);
    REFUSED(bad.specular_model = (burnish_specular_model)2);
#undef REFUSED
    bad = good;
    bad.lights[0].color[0] = -1;
    CHECK(burnish_kernels_shader_create(&bad, NULL, &shader, &error) == BURNISH_STATUS_ARGUMENT &&
              strstr(error.text, "light 1"),
          "lights count from 1: \"%s\"", error.text);
    good.local_viewer = 1;
    CHECK(burnish_kernels_shader_create(&good, NULL, &shader, &error) == BURNISH_STATUS_OK, "%s",
          error.text);
    CHECK(burnish_kernels_shade_rgba8(scalar(), shader, &points, 1, pixel, &error) ==
              BURNISH_STATUS_ARGUMENT,
          "a local viewer needs positions");
    burnish_kernels_shader_destroy(shader);
    lobe.exponent = 70000;
    CHECK(burnish_kernels_lobe_of_cosines(scalar(), &lobe.spec, lobe.exponent, 1, &value, &value,
                                          &error) == BURNISH_STATUS_ARGUMENT &&
              value == 0.5f,
          "exponent 70000: %s", error.text);
}

static void check_choice(void) {
    const uint32_t sse2 = 1u << 26, osxsave = 1u << 27, avx = 1u << 28, avx2 = 1u << 5;
    const uint32_t avx512 = 1u << 16 | 1u << 17 | 1u << 30 | 1u << 31;
    const struct {
        burnish_cpuid cpuid;
        burnish_isa best;
    } cases[] = {
        {{0, 0, 0, 0}, BURNISH_ISA_SCALAR},
        {{0, sse2, avx2, 0xe7}, BURNISH_ISA_SSE2},
        {{avx, sse2, avx2, 0xe7}, BURNISH_ISA_SSE2},        /* no OSXSAVE */
        {{avx | osxsave, sse2, avx2, 1}, BURNISH_ISA_SSE2}, /* ymm not saved */
        {{avx | osxsave, sse2, avx2, 2}, BURNISH_ISA_SSE2}, /* nor here */
        {{avx | osxsave, sse2, 0, 0xe7}, BURNISH_ISA_SSE2}, /* AVX without AVX2 */
        {{avx | osxsave, sse2, avx2, 7}, BURNISH_ISA_AVX2},
        {{avx | osxsave, sse2, avx2 | avx512, 7}, BURNISH_ISA_AVX2}, /* zmm not saved */
        {{avx | osxsave, sse2, avx2 | (avx512 & ~(1u << 31)), 0xe7}, BURNISH_ISA_AVX2},
        {{avx | osxsave, sse2, avx2 | avx512, 0xe7}, BURNISH_ISA_AVX512},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        burnish_isa best = burnish_isa_best(burnish_isa_from_cpuid(&cases[i].cpuid));
        CHECK(best == cases[i].best, "case %zu: %s", i, burnish_isa_name(best));
    }
    burnish_isa isa;
    burnish_error error;
    CHECK(burnish_isa_choose("scalar", &isa, &error) == BURNISH_STATUS_OK &&
              isa == BURNISH_ISA_SCALAR,
          "scalar is always there");
    CHECK(burnish_isa_choose("mmx", &isa, &error) == BURNISH_STATUS_ARGUMENT &&
              strstr(error.text, "\"mmx\" is not one of auto scalar"),
          "mmx: %s", error.text);
    CHECK(burnish_isa_name(BURNISH_ISA_COUNT)[0] == 'u' && burnish_isa_lanes((burnish_isa)-1) == 0,
          "outside the list");
    CHECK(burnish_isa_best(0) == BURNISH_ISA_SCALAR, "an empty mask");
}

#include "kernel_times.h"

int main(int count, char **arguments) {
    test_begin(count, arguments, "--bench");
    RUN(check_choice());
    RUN(check_values());
    RUN(check_normalize());
    RUN(check_equation());
    RUN(check_lyon());
    RUN(check_errors());
    RUN(check_instruction_sets());
    RUN(check_processors());
    if (test_option()) {
        print_times();
    }
    return test_end("kernels");
}
