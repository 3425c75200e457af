/* The kernels: every instruction set against scalar, bit for bit; the hash of scalar's results;
 * refused arguments; the choice of an instruction set.
 *
 * Needs nothing but src/simd, src/shading and a little of src/core, so that it also runs on other
 * processors. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "kernels_input.h"
#include "shading/shading_ops.h"
#include "simd/isa.h"

/* ---- Instruction sets ---- */

static void check_lobe_of_isa(const burnish_kernels *kernels, const lobe_case *lobe,
                              uint64_t *state) {
    static float cosines[BLOCK + MOST_LANES], expected[BLOCK], values[BLOCK];
    const char *name = burnish_isa_name(burnish_kernels_get_isa(kernels));
    for (int lambda = 0; lambda < 2; ++lambda) {
        for (size_t count = 0; count <= BLOCK; count = count < 50 ? count + 1 : count + 1349) {
            size_t shift = test_random32(state) % MOST_LANES;
            float *in = cosines + test_random32(state) % MOST_LANES;
            for (size_t i = 0; i < count; ++i) {
                in[i] = awkward(state);
            }
            int ok = run_lobe(scalar(), lobe, lambda, in, count, 0, expected) &&
                     run_lobe(kernels, lobe, lambda, in, count, shift, values);
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

static void check_lobes_of_isa(const burnish_kernels *kernels, uint64_t *state) {
    for (int k = 0; k < KIND_COUNT; ++k) {
        for (int e = 0; e < EXPONENT_COUNT; ++e) {
            int highest = KINDS[k] == BURNISH_LOBE_FAMILY ? 32 : 2;
            for (int order = 2; order <= highest; order *= 2) {
                lobe_case lobe = make(KINDS[k], order, EXPONENTS[e]);
                check_lobe_of_isa(kernels, &lobe, state);
            }
        }
    }
}

/* Arrays that are written past the caches: the same values, also in place. */
static void check_streaming(const burnish_kernels *kernels) {
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
    burnish_kernels_lobe_of_cosines(kernels, &lobe.spec, lobe.exponent, count, in + 1, in + 1,
                                    NULL);
    for (size_t i = 0; i < count + 3; ++i) {
        float x = test_uniform_float(&state, 0, 1);
        float want = i >= 1 && i < count + 1 ? burnish_lobe_at_cosine(lobe.family, x) : x;
        wrong += bits_of(in[i]) != bits_of(want);
    }
    CHECK(wrong == 0, "%s: %zu of %zu streamed values differ",
          burnish_isa_name(burnish_kernels_get_isa(kernels)), wrong, count);
    free(in);
}

static void check_shade_of_isa(const burnish_kernels *kernels, uint64_t *state) {
    static point_arrays arrays;
    static uint8_t pixels[2][4 * (BLOCK + 1)];
    static float colors[2][3][BLOCK + 1];
    const char *name = burnish_isa_name(burnish_kernels_get_isa(kernels));
    for (int trial = 0; trial < 1200; ++trial) {
        burnish_lobe_kind kind = KINDS[trial % KIND_COUNT];
        burnish_kernels_lighting lighting = random_lighting(kind, state);
        burnish_kernels_shader *shader;
        burnish_error error;
        size_t count = trial % 50 == 49 ? BLOCK - MOST_LANES : test_random32(state) % 70;
        int wrong = 0;
        random_beams(state, &lighting);
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
            const burnish_kernels *one = which ? kernels : scalar();
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

static void check_normalize_of_isa(const burnish_kernels *kernels, uint64_t *state) {
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
            burnish_kernels_normalize(which ? kernels : scalar(), count, from, to);
        }
        different += memcmp(out[0], out[1], sizeof out[0]) != 0;
    }
    CHECK(different == 0, "%s: %d arrays are normalised differently",
          burnish_isa_name(burnish_kernels_get_isa(kernels)), different);
}

/* Points of several materials at once have the bits of their own material's kernel. */
static void check_mixed_of_isa(const burnish_kernels *kernels, uint64_t *state) {
    enum { COUNT = 64, MATERIALS = 5, LIGHTS = 2 };
    const int order = test_random32(state) & 1 ? 2 : 8, is_alike = test_random32(state) & 1;
    const int is_composite = test_random32(state) & 1;
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_light_constants lights[MATERIALS][LIGHTS];
    burnish_kernels_shader shaders[MATERIALS];
    float normal[3][COUNT], own[3][COUNT], mixed[3][COUNT];
    float *const rgb[3] = {mixed[0], mixed[1], mixed[2]};
    int32_t materials[COUNT];
    burnish_kernels_points points = {{normal[0], normal[1], normal[2]}, {NULL}, {NULL}, NULL, NULL};
    int different = 0;
    lighting.light_count = LIGHTS;
    lighting.lights[1] = lighting.lights[0];
    lighting.lights[1].vector[0] = -lighting.lights[0].vector[0];
    lighting.lobe.order = is_composite ? 5 : order;
    lighting.lobe.kind = is_composite ? BURNISH_LOBE_COMPOSITE : BURNISH_LOBE_FAMILY;
    for (int m = 0; m < MATERIALS; ++m) {
        burnish_material material = lighting.material;
        material.exponent = is_alike       ? 31
                            : is_composite ? (float)(31 * m + 31)
                                           : (float)(1 << (m + 4));
        for (int k = 0; k < 3; ++k) {
            material.diffuse[k] = test_uniform_float(state, 0, 1);
            material.specular[k] = m == 0 ? 0 : test_uniform_float(state, 0, 1);
            material.specular[k] = is_alike ? 0.25f * (float)k : material.specular[k];
        }
        CHECK1(burnish_shader_fold(&lighting, &material, &lighting.lobe, lights[m], &shaders[m],
                                   NULL) == BURNISH_STATUS_OK);
    }
    for (int i = 0; i < COUNT; ++i) {
        materials[i] = i < COUNT / 4 ? 1 : (int32_t)(test_random32(state) % MATERIALS);
        for (int k = 0; k < 3; ++k) {
            normal[k][i] = test_uniform_float(state, -1, 1);
        }
    }
    const int body = is_composite ? BURNISH_LOBE_BODY_COMPOSITE
                     : order > 2  ? BURNISH_LOBE_BODY_SQUARES
                                  : BURNISH_LOBE_BODY_SQUARE;
    kernels->shade_mixed[body][is_alike](shaders, materials, &points, COUNT, rgb);
    for (int m = 0; m < MATERIALS; ++m) {
        kernels->shade[shaders[m].lobe.body][BURNISH_SHADE_DISTANT][BURNISH_SHADE_FLOAT](
            &shaders[m], &points, COUNT, NULL, (float *const[3]){own[0], own[1], own[2]});
        for (int i = 0; i < COUNT; ++i) {
            for (int k = 0; k < 3 && materials[i] == m; ++k) {
                different += memcmp(&own[k][i], &mixed[k][i], sizeof own[k][i]) != 0;
            }
        }
    }
    CHECK(different == 0, "%s, mixed materials: %d colours differ",
          burnish_isa_name(burnish_kernels_get_isa(kernels)), different);
}

static void check_instruction_sets(void) {
    uint32_t mask = burnish_isa_available();
    uint64_t state = test_seed(0x2545f491);
    printf("instruction sets:");
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_kernels *kernels = burnish_kernels_for((burnish_isa)isa);
        CHECK(!kernels == !(mask >> isa & 1), "%s: a table where the instruction set is",
              burnish_isa_name((burnish_isa)isa));
        if (!kernels) {
            continue;
        }
        printf(" %s", burnish_isa_name((burnish_isa)isa));
        CHECK((int)burnish_kernels_get_isa(kernels) == isa, "the table of %d", isa);
        check_lobes_of_isa(kernels, &state);
        check_streaming(kernels);
        check_shade_of_isa(kernels, &state);
        check_mixed_of_isa(kernels, &state);
        check_normalize_of_isa(kernels, &state);
    }
    printf("\n");
}

/* ---- Processors ---- */

/* FNV-1a over what the scalar kernels give for fixed input: the same on every processor, with every
 * compiler. Only a change of the kernels' arithmetic changes it, and then pixels change too. */
#define SCALAR_HASH 0x7c39e9d686512d2u
#define COMPOSITE_HASH 0x5e0c2d4aae82802fu

/* Every NaN counts as one: which operand's payload comes through is the compiler's choice. */
static uint64_t add_floats(uint64_t hash, const float *values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t bits = isnan(values[i]) ? 0x7fc00000 : bits_of(values[i]);
        uint8_t bytes[4] = {(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16),
                            (uint8_t)(bits >> 24)};
        hash = test_add_hash(hash, bytes, sizeof bytes);
    }
    return hash;
}

static void check_processors(int first, int end, uint64_t expected) {
    static float in[BLOCK], out[BLOCK], colors[3][BLOCK];
    static uint8_t pixels[4 * BLOCK];
    static point_arrays arrays;
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    uint64_t hash = 0xcbf29ce484222325u;
    uint64_t state = 1234567;
    for (int k = first; k < end; ++k) {
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
        burnish_kernels_lighting lighting =
            random_lighting(KINDS[first + trial % (end - first)], &state);
        burnish_kernels_shader *shader;
        make_points(&arrays, BLOCK, trial & 1, &state);
        burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
        burnish_kernels_points points = points_at(&arrays, 0, trial & 2, trial & 4);
        burnish_kernels_shade_float(scalar(), shader, &points, BLOCK, rgb, NULL);
        burnish_kernels_shade_rgba8(scalar(), shader, &points, BLOCK, pixels, NULL);
        for (int k = 0; k < 3; ++k) {
            hash = add_floats(hash, colors[k], BLOCK);
        }
        hash = test_add_hash(hash, pixels, sizeof pixels);
        burnish_kernels_shader_destroy(shader);
    }
    CHECK(hash == expected, "hash %#llx", (unsigned long long)hash);
}

/* ---- Arguments and instruction sets ---- */

static void check_errors(void) {
    burnish_kernels_lighting good = burnish_kernels_lighting_default(), bad;
    burnish_kernels_shader *shader;
    burnish_error error;
    float value = 0.5f;
    uint8_t pixel[4];
    lobe_case lobe = make(BURNISH_LOBE_INTEGER_POWER, 2, 3);
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
    REFUSED((bad.lobe.kind = BURNISH_LOBE_INTEGER_POWER, bad.material.exponent = 2.5f));
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
    CHECK_OK(burnish_kernels_shader_create(&good, NULL, &shader, &error), error);
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

/* NULL kernels, which burnish_kernels_for returns for a set that is missing, give the best one's
 * results. */
static void check_null_kernels(void) {
    static const float x[2] = {3, 0}, y[2] = {0, 0.5f}, z[2] = {4, 0.5f}, cosines[2] = {0.9f, 1};
    const burnish_kernels *choices[2] = {burnish_kernels_best(), NULL};
    const float *const vectors[3] = {x, y, z};
    struct {
        float cosine[2], lambda[2], unit[3][2], rgb[3][2];
        uint8_t rgba[8];
    } results[2];
    const burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    const burnish_kernels_points points = {.normal = {x, y, z}};
    burnish_kernels_shader *shader;
    burnish_status status = burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
    memset(results, 0, sizeof results);
    for (int i = 0; i < 2; ++i) {
        float *const unit[3] = {results[i].unit[0], results[i].unit[1], results[i].unit[2]};
        float *const rgb[3] = {results[i].rgb[0], results[i].rgb[1], results[i].rgb[2]};
        const burnish_kernels *k = choices[i];
        status |= burnish_kernels_lobe_of_cosines(k, &lighting.lobe, 30, 2, cosines,
                                                  results[i].cosine, NULL);
        status |= burnish_kernels_lobe_of_lambdas(k, &lighting.lobe, 30, 2, cosines,
                                                  results[i].lambda, NULL);
        burnish_kernels_normalize(k, 2, vectors, unit);
        status |= burnish_kernels_shade_rgba8(k, shader, &points, 2, results[i].rgba, NULL);
        status |= burnish_kernels_shade_float(k, shader, &points, 2, rgb, NULL);
    }
    CHECK(status == BURNISH_STATUS_OK && memcmp(&results[0], &results[1], sizeof *results) == 0,
          "NULL kernels: status %d, or other values", (int)status);
    CHECK(results[0].cosine[1] == 1 && results[0].unit[0][0] > 0.59f, "nothing was computed");
    CHECK(burnish_kernels_get_isa(NULL) == burnish_kernels_get_isa(choices[0]),
          "the set of NULL kernels");
    burnish_kernels_shader_destroy(shader);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_choice());
    RUN(check_errors());
    RUN(check_null_kernels());
    RUN(check_instruction_sets());
    RUN(check_processors(0, COMPOSITE_AT, SCALAR_HASH));
    RUN(check_processors(COMPOSITE_AT, KIND_COUNT, COMPOSITE_HASH));
    return test_end("kernels");
}
