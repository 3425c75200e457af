/* What the scalar kernels compute: lobes against burnish/lobe.h and libm, the lighting against the
 * same equation in double precision. Runs where test_kernels runs. */
#include <math.h>
#include <stdint.h>

#include "core/vec3.h"
#include "kernels_input.h"

/* What simd/vector_math.h states. */
#define POWER_ERROR 1e-7
#define GAUSSIAN_ERROR 1e-7
#define INVERSE_SQRT_ERROR 1.04e-7

static double accurate_lobe(const lobe_case *lobe, double c) {
    double n = (double)lobe->exponent, u;
    switch (lobe->spec.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
        u = 1 - (double)lobe->family.zeta * (1 - (c < 1 ? c : 1));
        return u > 0 ? pow(u, lobe->family.order) : 0;
    case BURNISH_LOBE_COMPOSITE:
        u = (double)lobe->composite.top - (double)lobe->composite.slope * (1 - (c < 1 ? c : 1));
        u = u > 0 ? u * u : 0;
        for (int i = 0; i < lobe->composite.multiplications - 2; ++i) {
            u *= u + (double)lobe->composite.offset[i];
        }
        return u;
    case BURNISH_LOBE_POWER:
    case BURNISH_LOBE_INTEGER_POWER:
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
                worst =
                    fmax(worst, fabs((double)values[i] - accurate_lobe(&lobe, (double)cosines[i])));
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
    case BURNISH_LOBE_COMPOSITE:
        return lambda ? burnish_composite_at_lambda(lobe->composite, x)
                      : burnish_composite_at_cosine(lobe->composite, x);
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
                    in[count] = test_float_of_bits((uint32_t)bits);
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
        check_all_floats(BURNISH_LOBE_COMPOSITE, order, 1);
    }
    check_all_floats(BURNISH_LOBE_SCHLICK, 2, 1);
    check_all_floats(BURNISH_LOBE_GX, 2, 1);
    check_all_floats(BURNISH_LOBE_POWER, 2, 0);
    check_all_floats(BURNISH_LOBE_INTEGER_POWER, 2, 0);
    check_all_floats(BURNISH_LOBE_GAUSSIAN, 2, 0);
    lobe_case whole = make(BURNISH_LOBE_INTEGER_POWER, 2, 37);
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
            in[0][i] = test_float_of_bits(bits);
        }
        burnish_kernels_normalize(scalar(), BLOCK, from, to);
        for (int i = 0; i < BLOCK; ++i) {
            worst = fmax(worst, fabs((double)out[0][i] - 1));
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

typedef burnish_vec3 vec;

/* What arrives of a light at a vector l to it: KHR_lights_punctual's formulas. */
static double arriving(const burnish_light *light, vec l, int *stable) {
    const double d = sqrt(burnish_vec3_dot(l, l)), *a = light->axis;
    double share = light->distance > 0 ? light->distance * light->distance / (d * d) : 1;
    share *= light->range > 0 ? fmax(0, 1 - pow(d / light->range, 4)) : 1;
    if (a[0] != 0 || a[1] != 0 || a[2] != 0) {
        const double width = fmax(0.001, light->cone[0] - light->cone[1]);
        const double t =
            (-burnish_vec3_dot((vec){a[0], a[1], a[2]}, l) / d - light->cone[1]) / width;
        share *= t > 1 ? 1 : t > 0 ? t * t : 0;
        *stable &= width > 0.1 || t < 0 || t > 1; /* elsewhere t is off by 1e-7 / 0.001 */
    }
    return share;
}

/* The equation of burnish/kernels.h. Returns 0 where a float's rounding shows
 * in the colour: where the light is on the horizon, which switches the highlight off, and where the
 * half vector or a direction is a difference of nearly equal vectors. */
static int accurate_color(const burnish_kernels_lighting *lighting, const lobe_case *lobe,
                          vec normal, vec position, const double diffuse[3], double color[3]) {
    vec n = burnish_vec3_normalize(normal), v = burnish_vec3_loadf(lighting->viewer);
    double specular[3] = {0, 0, 0};
    v = lighting->local_viewer ? burnish_vec3_add(v, burnish_vec3_scale(position, -1)) : v;
    int stable = burnish_vec3_dot(v, v) > 0.25;
    v = burnish_vec3_normalize(v);
    for (int k = 0; k < 3; ++k) {
        color[k] = (double)lighting->ambient_light[k] * (double)lighting->material.ambient[k];
    }
    for (int i = 0; i < lighting->light_count; ++i) {
        const burnish_light *light = &lighting->lights[i];
        vec l = {light->vector[0], light->vector[1], light->vector[2]};
        l = light->kind == BURNISH_LIGHT_POINT
                ? burnish_vec3_add(l, burnish_vec3_scale(position, -1))
                : l;
        stable &= burnish_vec3_dot(l, l) > 0.25;
        const double share = arriving(light, l, &stable);
        l = burnish_vec3_normalize(l);
        vec half = burnish_vec3_add(l, v);
        double lit = burnish_vec3_dot(n, l), c = burnish_vec3_dot(n, burnish_vec3_normalize(half));
        stable &= fabs(lit) > 1e-6 && burnish_vec3_dot(half, half) > 0.25;
        if (lighting->specular_model == BURNISH_SPECULAR_PHONG) {
            c = 2 * lit * burnish_vec3_dot(n, v) - burnish_vec3_dot(l, v);
        }
        double value = lit > 0 ? accurate_lobe(lobe, c) : 0;
        for (int k = 0; k < 3; ++k) {
            double brightness = share * (double)light->color[k];
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
        const int kind = trial % COMPOSITE_AT;
        burnish_kernels_lighting lighting =
            random_lighting(KINDS[kind == LYON_AT ? COMPOSITE_AT : kind], &state);
        burnish_kernels_shader *shader;
        if (trial & 1) {
            random_beams(&state, &lighting);
        }
        make_points(&arrays, BLOCK, 1, &state);
        burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
        burnish_kernels_points points = points_at(&arrays, 0, 1, 1);
        burnish_kernels_shade_float(scalar(), shader, &points, BLOCK, rgb, NULL);
        burnish_kernels_shade_rgba8(scalar(), shader, &points, BLOCK, pixels, NULL);
        burnish_kernels_shader_destroy(shader);
        /* a cosine is off by 1e-7 at three lights, and the lobe by that times its slope */
        const int order = lighting.lobe.kind == BURNISH_LOBE_COMPOSITE
                              ? 1 << (lighting.lobe.order - 1)
                              : lighting.lobe.order;
        lobe_case lobe = make(lighting.lobe.kind, order, lighting.material.exponent);
        double slope = lighting.lobe.kind == BURNISH_LOBE_FAMILY
                           ? (double)lobe.family.zeta * lobe.family.order
                           : (double)lobe.exponent + 1;
        for (int i = 0; i < BLOCK; ++i) {
            double w = (double)arrays.w[i], color[3], d[3];
            vec normal = {(double)arrays.normal[0][i], (double)arrays.normal[1][i],
                          (double)arrays.normal[2][i]};
            vec position = {(double)arrays.position[0][i] / w, (double)arrays.position[1][i] / w,
                            (double)arrays.position[2][i] / w};
            for (int k = 0; k < 3; ++k) {
                d[k] = (double)arrays.diffuse[k][i];
            }
            if (burnish_vec3_dot(normal, normal) < 0.25 ||
                !accurate_color(&lighting, &lobe, normal, position, d, color)) {
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
    vec h = burnish_vec3_normalize(
        burnish_vec3_add((vec){light[0], light[1], light[2]}, burnish_vec3_loadf(lighting.viewer)));
    for (int i = 0; i < 2000; ++i) {
        vec n = burnish_vec3_normalize((vec){h.x + (double)test_uniform_float(&state, -0.3f, 0.3f),
                                             h.y + (double)test_uniform_float(&state, -0.3f, 0.3f),
                                             h.z});
        n = burnish_vec3_scale(n, (double)test_uniform_float(&state, 0.9f, 1.1f));
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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_values());
    RUN(check_normalize());
    RUN(check_equation());
    RUN(check_lyon());
    return test_end("kernel_values");
}
