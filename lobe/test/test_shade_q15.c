/* The lighting equation in integers against double precision: normalisation, cosines, colours, the
 * whole equation. shade_q15.h states the bounds. */
#include <math.h>
#include <stdint.h>

#include "support.h"

#include "burnish/shade_q15.h"

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A direction, uniform enough, in double and rounded to Q15 with a given length. */
static void direction(uint64_t *state, double length, double exact[3], int16_t rounded[3]) {
    double size;
    do {
        for (int k = 0; k < 3; ++k) {
            exact[k] = test_uniform(state, -1, 1);
        }
        size = length_of(exact);
    } while (size > 1 || size < .01);
    for (int k = 0; k < 3; ++k) {
        exact[k] /= size;
        const double scaled = exact[k] * length * 32768;
        rounded[k] = (int16_t)lrint(scaled > 32767 ? 32767 : scaled < -32767 ? -32767 : scaled);
    }
}

/* Errors of a unit vector: its length and its worst component, in units of 2^-15. */
static void measure(const double v[3], const int16_t unit[3], double *length, double *component) {
    const double size = length_of(v);
    const double got[3] = {unit[0], unit[1], unit[2]};
    *length = fmax(*length, fabs(length_of(got) - 32768));
    for (int k = 0; k < 3; ++k) {
        const double wanted = fmin(32767, fmax(-32767, 32768 * v[k] / size));
        *component = fmax(*component, fabs(wanted - got[k]));
    }
}

static void test_normalize_near(void) {
    static const double spreads[] = {.02, .05, .1}, bounds[] = {2, 12, 95};
    uint64_t state = test_seed(1);
    for (int i = 0; i < 3; ++i) {
        double length = 0, component = 0;
        for (int j = 0; j < 1000000; ++j) {
            double exact[3];
            int16_t v[3], unit[3];
            direction(&state, 1 + spreads[i] * test_uniform(&state, -1, 1), exact, v);
            const double given[3] = {v[0], v[1], v[2]};
            if (fabs(length_of(given) / 32768 - 1) > spreads[i]) {
                continue; /* limited on the way */
            }
            burnish_q15_normalize_near(v, unit);
            measure(given, unit, &length, &component);
        }
        CHECK(length <= bounds[i] && component <= bounds[i],
              "lengths within %g: length off by %.2f, component by %.2f", spreads[i], length,
              component);
        printf("normalize_near, length 1 +- %g: length %.2f, component %.2f (2^-15)\n", spreads[i],
               length, component);
    }
}

/* Every number of bits from 1 to 31, every small vector. */
static void test_normalize(void) {
    uint64_t state = test_seed(2);
    double length = 0, component = 0;
    for (int bits = 1; bits <= 31; ++bits) {
        for (int j = 0; j < 60000; ++j) {
            int32_t v[3];
            int16_t unit[3];
            for (int k = 0; k < 3; ++k) {
                v[k] = (int32_t)lrint(test_uniform(&state, -1, 1) * (pow(2, bits) - 1));
            }
            const double given[3] = {v[0], v[1], v[2]};
            if (burnish_q15_normalize(v, unit)) {
                measure(given, unit, &length, &component);
            } else {
                CHECK(length_of(given) == 0, "a vector of length %g was taken for 0",
                      length_of(given));
            }
        }
    }
    for (int32_t code = 1; code < 41 * 41 * 41; ++code) {
        const int32_t v[3] = {code % 41 - 20, code / 41 % 41 - 20, code / 1681 - 20};
        const double given[3] = {v[0], v[1], v[2]};
        int16_t unit[3];
        if (burnish_q15_normalize(v, unit)) {
            measure(given, unit, &length, &component);
        }
    }
    CHECK(length <= 1.5 && component <= 1.6, "length off by %.2f, component by %.2f", length,
          component);
    printf("normalize, any vector: length %.2f, component %.2f (2^-15)\n", length, component);
    const int32_t extremes[3] = {INT32_MIN, INT32_MAX, INT32_MIN}, zero[3] = {0, 0, 0};
    int16_t unit[3];
    CHECK(burnish_q15_normalize(extremes, unit) && abs(unit[0] + 18919) <= 1 &&
              abs(unit[1] - 18919) <= 1,
          "extremes: %d %d %d", unit[0], unit[1], unit[2]);
    CHECK(!burnish_q15_normalize(zero, unit) && unit[0] == 0 && unit[2] == 0, "zero");
}

static void test_inverse_root(void) {
    double worst = 0;
    for (uint64_t x = 0x40000000; x <= 0xFFFFFFFF; x += 211) {
        const double exact = fmin(65535, 32768 / sqrt((double)x / 4294967296.0));
        worst = fmax(worst, fabs(exact - burnish_q15_inverse_root((uint32_t)x)));
    }
    CHECK(worst < 1, "off by %.3f units", worst);
}

/* Cosines: N.L, the half vector's, the mirrored ray's, the chord. */
static void test_cosines(void) {
    uint64_t state = test_seed(3);
    double dot_off = 0, mirror_off = 0, chord_off = 0, half_off = 0;
    for (int j = 0; j < 1000000; ++j) {
        double n[3], l[3], v[3], sum[3];
        int16_t a[3], b[3], c[3], half[3];
        direction(&state, 1, n, a);
        direction(&state, 1, l, b);
        direction(&state, 1, v, c);
        double nl = 0, nv = 0, lv = 0, chord = 0;
        for (int k = 0; k < 3; ++k) {
            nl += a[k] / 32768.0 * b[k] / 32768;
            nv += a[k] / 32768.0 * c[k] / 32768;
            lv += b[k] / 32768.0 * c[k] / 32768;
            chord += (a[k] - b[k]) / 32768.0 * (a[k] - b[k]) / 65536;
            sum[k] = b[k] + c[k];
        }
        const uint16_t nlq = burnish_q15_cosine(burnish_q15_dot(a, b)),
                       nvq = burnish_q15_cosine(burnish_q15_dot(a, c));
        dot_off = fmax(dot_off, fabs(fmin(1, fmax(0, nl)) * 32768 - nlq));
        if (nlq > 0 && nvq > 0) {
            const double mirror = fmin(1, fmax(0, 2 * nl * nv - lv));
            mirror_off =
                fmax(mirror_off, fabs(mirror * 32768 -
                                      burnish_q15_reflect_cosine(nlq, nvq, burnish_q15_dot(b, c))));
        }
        chord_off =
            fmax(chord_off, fabs(fmin(16777215, chord * 16777216) - burnish_q15_chord(a, b)));
        if (burnish_q15_half(b, c, half)) {
            double length = 0;
            measure(sum, half, &length, &half_off);
        }
    }
    CHECK(dot_off <= .5 && mirror_off <= 2.5 && chord_off <= .6 && half_off <= 1.6,
          "cosine %.3f, mirrored %.3f (2^-15), chord %.3f (2^-24), half %.3f (2^-15)", dot_off,
          mirror_off, chord_off, half_off);
    const int16_t up[3] = {0, 32767, 0}, down[3] = {0, -32768, 0};
    int16_t half[3];
    CHECK(burnish_q15_cosine(burnish_q15_dot(up, down)) == 0, "opposite");
    CHECK(burnish_q15_chord(up, down) == 0xFFFFFF, "opposite chord");
    CHECK(burnish_q15_cosine(burnish_q15_dot(down, down)) == 0x8000, "1 exactly");
    CHECK(!burnish_q15_half((const int16_t[3]){0, 9, 0}, (const int16_t[3]){0, -9, 0}, half),
          "no half");
}

static void test_colors(void) {
    for (int byte = 0; byte < 256; ++byte) {
        const uint16_t wide = burnish_q15_from_byte((uint8_t)byte);
        CHECK(fabs(wide - byte / 255.0 * 32768) <= .5 && burnish_q15_code(wide, 255) == byte,
              "byte %d became %d", byte, wide);
    }
    for (uint32_t x = 0; x <= 0xFFFF; ++x) {
        const uint16_t color[3] = {(uint16_t)x, (uint16_t)x, (uint16_t)x};
        const double unit = fmin(1, x / 32768.0);
        uint8_t rgb[3];
        burnish_q15_rgb888(color, rgb);
        const uint16_t packed = burnish_q15_rgb565(color);
        const int good = fabs(unit * 255 - rgb[0]) <= .5 && rgb[0] == rgb[2] &&
                         fabs(unit * 31 - (packed >> 11)) <= .5 &&
                         fabs(unit * 63 - (packed >> 5 & 63)) <= .5 &&
                         packed >> 11 == (packed & 31);
        CHECK(good, "%u became %d and %04x", x, rgb[0], packed);
    }
    CHECK(burnish_q15_accumulate(0xFFF0, 0xFFFF, 0xFFFF) == 0xFFFF, "no limit");
    CHECK(burnish_q15_accumulate(5, 0x8000, 0x8000) == 5 + 0x4000, "half of 1");
    CHECK(burnish_q15_scale(0x8000, 0x1234) == 0x1234 &&
              burnish_q15_scale(0xFFFF, 0xFFFF) == 0xFFFF,
          "products");
}

/* The same equation in double, from the prepared light and shader. */
static double shade_real(const burnish_q15_shader *shader, const burnish_q15_light *lights,
                         int count, const int16_t n[3], int channel) {
    double sum = shader->ambient[channel] / 32768.0;
    for (int i = 0; i < count; ++i) {
        double nl = 0, nh = 0, chord = 0;
        for (int k = 0; k < 3; ++k) {
            const double h = lights[i].half[k] / 32768.0;
            nl += n[k] / 32768.0 * lights[i].direction[k] / 32768;
            nh += n[k] / 32768.0 * h;
            chord += (n[k] / 32768.0 - h) * (n[k] / 32768.0 - h) / 2;
        }
        if (nl <= 0) {
            continue;
        }
        const double zeta = shader->lobe.slope / (double)(2u << shader->lobe.shift);
        const double t = 1 - zeta * (shader->narrow ? chord : 1 - fmax(0, nh));
        const double lobe = t > 0 ? pow(fmin(1, t), 1 << shader->lobe.squarings) : 0;
        sum += fmin(1, nl) * lights[i].diffuse[channel] / 32768.0 +
               lobe * lights[i].specular[channel] / 32768.0;
    }
    return fmin(1, sum) * 255;
}

/* Random lamps, surfaces and normals: codes within their own rounding and what 16-bit sums and a
 * cosine of 15 bits cost. The edge of the lit side is excluded: the lobe is discontinuous there. */
static void test_equation(void) {
    uint64_t state = test_seed(4);
    static const uint16_t exponents[] = {4, 16, 32, 64, 100, 128, 400, 1023};
    for (size_t e = 0; e < sizeof exponents / sizeof *exponents; ++e) {
        const uint16_t n = exponents[e];
        const double bound = .5 + .05 + (n < BURNISH_Q15_NARROW ? 2 * n / 512.0 : .05);
        double worst = 0;
        for (int j = 0; j < 60000; ++j) {
            burnish_q15_material material;
            burnish_q15_light lights[2];
            burnish_q15_shader shader;
            uint16_t ambient[3], color[3];
            double exact[3];
            int16_t normal[3], viewer[3];
            uint8_t rgb[3];
            direction(&state, 1, exact, viewer);
            for (int k = 0; k < 3; ++k) {
                material.ambient[k] = (uint16_t)(16384 + 16384 * test_uniform(&state, -1, 1));
                material.diffuse[k] = (uint16_t)(16384 + 16384 * test_uniform(&state, -1, 1));
                material.specular[k] = (uint16_t)(16384 + 16384 * test_uniform(&state, -1, 1));
                ambient[k] = (uint16_t)(4096 + 4096 * test_uniform(&state, -1, 1));
                color[k] = (uint16_t)(16384 + 16384 * test_uniform(&state, -1, 1));
            }
            CHECK(burnish_q15_shader_create(&shader, BURNISH_Q15_ENERGY, 2, n, &material,
                                            ambient) == BURNISH_Q15_OK,
                  "n = %d", n);
            for (int i = 0; i < 2; ++i) {
                int16_t to_light[3];
                direction(&state, .3, exact, to_light);
                burnish_q15_light_create(&lights[i], to_light, viewer, color, &material);
            }
            direction(&state, 1, exact, normal);
            if (j & 1) { /* near the first highlight */
                double near[3], bent[3];
                for (int k = 0; k < 3; ++k) {
                    near[k] = lights[0].half[k] / 32768.0 + exact[k] / sqrt(2.0 * n);
                }
                const double size = length_of(near);
                for (int k = 0; k < 3; ++k) {
                    bent[k] = near[k] / size * 32768;
                    normal[k] = (int16_t)lrint(fmin(32767, fmax(-32767, bent[k])));
                }
            }
            const int32_t nl[2] = {burnish_q15_dot(normal, lights[0].direction),
                                   burnish_q15_dot(normal, lights[1].direction)};
            if ((nl[0] > 0 && nl[0] < 40000) || (nl[1] > 0 && nl[1] < 40000)) {
                continue;
            }
            burnish_q15_shade(&shader, lights, 2, normal, color);
            burnish_q15_rgb888(color, rgb);
            for (int k = 0; k < 3; ++k) {
                worst = fmax(worst, fabs(rgb[k] - shade_real(&shader, lights, 2, normal, k)));
            }
        }
        CHECK(worst <= bound, "n = %d: %.3f steps of 255, at most %.3f expected", n, worst, bound);
        printf("equation, n = %d: within %.3f steps of 255\n", n, worst);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_normalize_near());
    RUN(test_normalize());
    RUN(test_inverse_root());
    RUN(test_cosines());
    RUN(test_colors());
    RUN(test_equation());
    return test_end("shade_q15");
}
