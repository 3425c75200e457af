/* arrays_q15.h against lobe_q15.h and shade_q15.h, bit for bit: every cosine through lobes of every
 * kind; normals of every kind through pixels; every length and alignment, and no byte outside the
 * arrays. Compiled once for each kind of vectors. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "support.h"

#include "burnish/arrays_q15.h"

enum { ALL = 0x10000 };

static uint16_t cosines[ALL], values[ALL];
static uint8_t bytes[ALL];

/* Results that differ from the core's in the three forms, over all cosines. */
static int count_wrong(const burnish_lobe_q15 *lobe, const burnish_lobe_q15 *core) {
    int wrong = 0;
    burnish_lobe_q15_fast_array(lobe, ALL, cosines, values);
    for (uint32_t c = 0; c < ALL; ++c) {
        wrong += values[c] != burnish_lobe_q15_fast(core, (uint16_t)c);
    }
    burnish_lobe_q15_near_array(lobe, ALL, cosines, values);
    for (uint32_t c = 0; c < ALL; ++c) {
        wrong += values[c] != burnish_lobe_q15_near(core, (uint16_t)c);
    }
    burnish_lobe_q15_fast8_array(lobe, ALL, cosines, bytes);
    for (uint32_t c = 0; c < ALL; ++c) {
        wrong += bytes[c] != burnish_lobe_q15_fast8(core, (uint16_t)c);
    }
    return wrong;
}

static void check_lobe(const burnish_lobe_q15 *lobe) {
    const int wrong = count_wrong(lobe, lobe);
    CHECK(wrong == 0, "slope %u, shift %u, squarings %u, reach %u: %d of 3 x 65,536 differ",
          lobe->slope, lobe->shift, lobe->squarings, lobe->reach, wrong);
}

/* Every fit and order, some exponents; then any slope, shift and boundary. */
static void test_lobes(void) {
    uint64_t state = test_seed(1);
    burnish_lobe_q15 lobe;
    for (uint32_t n = 1; n <= 1023; n += n < 20 ? 1 : 59) {
        for (int fit = BURNISH_Q15_TAYLOR; fit <= BURNISH_Q15_SHIFT3; ++fit) {
            for (uint16_t order = 2; order <= 16; order = (uint16_t)(2 * order)) {
                if (burnish_lobe_q15_create(&lobe, (burnish_q15_fit)fit, order, (uint16_t)n) ==
                    BURNISH_Q15_OK) {
                    check_lobe(&lobe);
                }
            }
        }
    }
    for (int i = 0; i < 128; ++i) {
        const uint32_t bits = test_random32(&state);
        const uint16_t slope = (uint16_t)((bits & 0xFFFF) >> (i % 16) | 1);
        CHECK(burnish_lobe_q15_from_slope(&lobe, slope, (uint8_t)(i / 4 % 16),
                                          (uint16_t)(2u << i % 4)) == BURNISH_Q15_OK,
              "slope %u", slope);
        check_lobe(&lobe);
        burnish_lobe_q15_set_boundary(&lobe, (uint16_t)(bits >> 16));
        check_lobe(&lobe);
    }
    burnish_lobe_q15_darken(&lobe);
    check_lobe(&lobe);
}

/* The comparison detects one step of the slope. */
static void test_can_fail(void) {
    burnish_lobe_q15 lobe, other;
    burnish_lobe_q15_create(&lobe, BURNISH_Q15_ENERGY, 4, 40);
    burnish_lobe_q15_from_slope(&other, (uint16_t)(lobe.slope + 1), lobe.shift, 4);
    CHECK(count_wrong(&lobe, &other) > 100, "a wrong slope went unseen");
}

/* ---- Normals, lights and shaders -------------------------------------------------------------
 */

enum { POINTS = 20000 };

static int16_t normals[3][POINTS];

static int16_t extreme(uint32_t i) {
    static const int16_t numbers[] = {-32768, -32767, -32766, -23171, -16384, -1,   0,
                                      1,      16384,  18919,  23170,  32766,  32767};
    return numbers[i % 13];
}

/* Every combination of extremes, any numbers, then directions of lengths around 1. */
static void fill_normals(uint64_t *state) {
    const double golden = 2.399963229728653;
    for (uint32_t i = 0; i < POINTS; ++i) {
        if (i < 13 * 13 * 13) {
            normals[0][i] = extreme(i);
            normals[1][i] = extreme(i / 13);
            normals[2][i] = extreme(i / 169);
        } else if (i < 6000) {
            for (int k = 0; k < 3; ++k) {
                normals[k][i] = (int16_t)test_random32(state);
            }
        } else { /* a whole sphere, evenly */
            const double z = 1 - 2 * (i - 5999.5) / (POINTS - 6000), r = sqrt(1 - z * z);
            const double length = (i & 3) == 0 ? 32767 : test_uniform(state, 29000, 32767);
            normals[0][i] = (int16_t)lrint(length * r * cos(golden * i));
            normals[1][i] = (int16_t)lrint(length * r * sin(golden * i));
            normals[2][i] = (int16_t)lrint(length * z);
        }
    }
}

static void random_color(uint64_t *state, uint16_t color[3]) {
    for (int k = 0; k < 3; ++k) {
        color[k] = (uint16_t)(test_random32(state) % 0x8001);
    }
}

/* A shader and lights: as programs make them, or (wild) with any numbers in them. */
static void fill_shader(uint64_t *state, int wild, burnish_q15_shader *shader,
                        burnish_q15_light lights[8]) {
    static const uint16_t exponents[] = {1, 2, 5, 16, 31, 32, 33, 50, 64, 100, 128, 333, 400, 1023};
    burnish_q15_material material;
    uint16_t color[3];
    random_color(state, material.ambient);
    random_color(state, material.diffuse);
    random_color(state, material.specular);
    random_color(state, color);
    const uint16_t n = exponents[test_random32(state) % 14];
    const uint16_t order = (uint16_t)(2u << test_random32(state) % 4);
    const burnish_q15_fit fit = test_random32(state) % 2 ? BURNISH_Q15_ENERGY : BURNISH_Q15_TAYLOR;
    (void)burnish_q15_shader_create(shader, fit, order, n, &material, color); /* dark if it fails */
    const int at = (int)(test_random32(state) % (POINTS - 6000)) + 6000;
    const int16_t viewer[3] = {normals[0][at], normals[1][at], normals[2][at]};
    for (int i = 0; i < 8; ++i) {
        const int16_t to_light[3] = {(int16_t)test_random32(state), (int16_t)test_random32(state),
                                     (int16_t)test_random32(state)};
        random_color(state, color);
        burnish_q15_light_create(&lights[i], to_light, viewer, color, &material);
        for (int k = 0; wild && k < 3; ++k) {
            lights[i].diffuse[k] = (uint16_t)test_random32(state);
            lights[i].specular[k] = (uint16_t)test_random32(state);
            lights[i].direction[k] = i % 2 ? extreme(test_random32(state)) : to_light[k];
            lights[i].half[k] = (int16_t)(test_random32(state) >> (test_random32(state) % 17));
        }
    }
    if (wild) {
        shader->narrow = (uint8_t)(test_random32(state) % 2);
        burnish_lobe_q15_from_slope(&shader->lobe,
                                    (uint16_t)(1 | (test_random32(state) & 0xFFFF) >> n % 16),
                                    (uint8_t)(test_random32(state) % 16), order);
    }
}

static uint16_t planes[3][POINTS], packed[POINTS];
static uint8_t rgba[4 * POINTS];

static const int16_t *const normal_planes[3] = {normals[0], normals[1], normals[2]};

/* Pixels of the three functions that differ from the core's. */
static int count_wrong_pixels(const burnish_q15_shader *shader, const burnish_q15_light *lights,
                              uint8_t count) {
    uint16_t *const to[3] = {planes[0], planes[1], planes[2]};
    int wrong = 0;
    burnish_q15_shade_array(shader, lights, count, POINTS, normal_planes, to);
    burnish_q15_pixels_rgba8(shader, lights, count, POINTS, normal_planes, rgba);
    burnish_q15_pixels_rgb565(shader, lights, count, POINTS, normal_planes, packed);
    for (int i = 0; i < POINTS; ++i) {
        int16_t n[3] = {normals[0][i], normals[1][i], normals[2][i]};
        uint16_t color[3];
        uint8_t rgb[3];
        burnish_q15_shade(shader, lights, count, n, color);
        wrong += color[0] != planes[0][i] || color[1] != planes[1][i] || color[2] != planes[2][i];
        burnish_q15_normalize_near(n, n);
        burnish_q15_shade(shader, lights, count, n, color);
        burnish_q15_rgb888(color, rgb);
        wrong += memcmp(rgb, rgba + 4 * i, 3) != 0 || rgba[4 * i + 3] != 255;
        wrong += packed[i] != burnish_q15_rgb565(color);
    }
    return wrong;
}

/* Chords are exact up to BURNISH_Q15V_FAR, and lobes of narrow shaders are 0 from there on: none of
 * them is computed one at a time. */
static void test_far(void) {
#if BURNISH_Q15_LANES > 1
    int reach = 0, count = 0;
    for (uint16_t n = BURNISH_Q15_NARROW; n <= 1023; ++n) {
        for (int fit = BURNISH_Q15_TAYLOR; fit <= BURNISH_Q15_SHIFT3; ++fit) {
            for (uint16_t order = 2; order <= 16; order = (uint16_t)(2 * order)) {
                burnish_lobe_q15 lobe;
                if (burnish_lobe_q15_create(&lobe, (burnish_q15_fit)fit, order, n) ==
                    BURNISH_Q15_OK) {
                    reach += burnish_lobe_q15_fast_lambda(&lobe, BURNISH_Q15V_FAR) != 0;
                    ++count;
                }
            }
        }
    }
    CHECK(reach == 0 && count > 9000, "%d of %d lobes reach that far", reach, count);
#endif
}

/* Lights of every number, those beyond the kept ones included. */
static void test_pixels(void) {
    uint64_t state = test_seed(2);
    fill_normals(&state);
    long bright = 0, dark = 0;
    for (int i = 0; i < 160; ++i) {
        burnish_q15_shader shader;
        burnish_q15_light lights[8];
        const uint8_t count = (uint8_t)(i % 9 ? i % 9 : 1);
        fill_shader(&state, i & 1, &shader, lights);
        const int wrong = count_wrong_pixels(&shader, lights, i == 0 ? 0 : count);
        CHECK(wrong == 0, "scene %d, %u lights, narrow %u, slope %u, shift %u, order %d: %d pixels",
              i, count, shader.narrow, shader.lobe.slope, shader.lobe.shift,
              1 << shader.lobe.squarings, wrong);
        for (int j = 0; j < POINTS; ++j) {
            bright += planes[0][j] != shader.ambient[0];
            dark += planes[0][j] == shader.ambient[0];
        }
    }
    CHECK(bright > 100000 && dark > 100000, "%ld lit, %ld dark", bright, dark);
}

static void test_normalize(void) {
    static int16_t units[3][POINTS];
    int16_t *const to[3] = {units[0], units[1], units[2]};
    uint64_t state = test_seed(3);
    fill_normals(&state);
    burnish_q15_normalize_near_array(POINTS, normal_planes, to);
    int wrong = 0;
    for (int i = 0; i < POINTS; ++i) {
        const int16_t v[3] = {normals[0][i], normals[1][i], normals[2][i]};
        int16_t unit[3];
        burnish_q15_normalize_near(v, unit);
        wrong += unit[0] != units[0][i] || unit[1] != units[1][i] || unit[2] != units[2][i];
    }
    CHECK(wrong == 0, "%d vectors differ", wrong);
    for (int k = 0; k < 3; ++k) {
        memcpy(normals[k], units[k], sizeof units[k]);
    }
    int16_t *const in_place[3] = {units[0], units[1], units[2]};
    const int16_t *const from[3] = {units[0], units[1], units[2]};
    burnish_q15_normalize_near_array(POINTS, from, in_place);
    for (int i = 0; i < POINTS; ++i) {
        int16_t unit[3] = {normals[0][i], normals[1][i], normals[2][i]};
        burnish_q15_normalize_near(unit, unit);
        wrong += unit[0] != units[0][i] || unit[1] != units[1][i] || unit[2] != units[2][i];
    }
    CHECK(wrong == 0, "%d vectors in place differ", wrong);
}

/* ---- Lengths ---------------------------------------------------------------------------------
 */

enum { GUARD = 0xA5, ROOM = 4 * 130 + 64 };

/* Whether the bytes of `room` outside [from, to) still are what they were filled with. */
static int is_untouched(const uint8_t *room, size_t from, size_t to) {
    for (size_t i = 0; i < ROOM; ++i) {
        if ((i < from || i >= to) && room[i] != GUARD) {
            return 0;
        }
    }
    return 1;
}

/* Arrays of 0 .. 130 elements that begin anywhere; inputs end where memory could. */
static void test_lengths(void) {
    uint64_t state = test_seed(4);
    burnish_q15_shader shader;
    burnish_q15_light lights[8];
    fill_normals(&state);
    fill_shader(&state, 0, &shader, lights);
    burnish_lobe_q15 lobe;
    burnish_lobe_q15_create(&lobe, BURNISH_Q15_ENERGY, 4, 20);
    for (size_t count = 0; count <= 130; ++count) {
        uint16_t memory[ROOM / 2];
        uint8_t *const room = (uint8_t *)memory;
        const size_t at = count % 7, start = POINTS - count;
        uint16_t *const given = malloc(2 * count + 2);
        int wrong = 0;
        for (size_t i = 0; i < count; ++i) {
            given[i] = (uint16_t)(0x8000 - i * 97 % 0x1800);
        }
        memset(room, GUARD, ROOM);
        burnish_lobe_q15_fast_array(&lobe, count, given, memory + at);
        for (size_t i = 0; i < count; ++i) {
            wrong += memory[at + i] != burnish_lobe_q15_fast(&lobe, given[i]);
        }
        wrong += !is_untouched(room, 2 * at, 2 * (at + count));
        memset(room, GUARD, ROOM);
        burnish_lobe_q15_fast8_array(&lobe, count, given, room + at);
        for (size_t i = 0; i < count; ++i) {
            wrong += room[at + i] != burnish_lobe_q15_fast8(&lobe, given[i]);
        }
        wrong += !is_untouched(room, at, at + count);
        memset(room, GUARD, ROOM);
        memcpy(memory + at, given, 2 * count);
        burnish_lobe_q15_near_array(&lobe, count, memory + at, memory + at); /* in place */
        for (size_t i = 0; i < count; ++i) {
            wrong += memory[at + i] != burnish_lobe_q15_near(&lobe, given[i]);
        }
        wrong += !is_untouched(room, 2 * at, 2 * (at + count));
        free(given);
        CHECK(wrong == 0, "%zu cosines: %d wrong", count, wrong);

        const int16_t *const from[3] = {normals[0] + start, normals[1] + start, normals[2] + start};
        memset(room, GUARD, ROOM);
        burnish_q15_pixels_rgba8(&shader, lights, 2, count, from, room + at);
        CHECK(is_untouched(room, at, at + 4 * count), "%zu pixels as RGBA8", count);
        uint8_t kept[ROOM];
        memcpy(kept, room, ROOM);
        memset(room, GUARD, ROOM);
        burnish_q15_pixels_rgb565(&shader, lights, 2, count, from, memory + at);
        CHECK(is_untouched(room, 2 * at, 2 * (at + count)), "%zu pixels as RGB565", count);
        for (size_t i = 0; i < count; ++i) {
            int16_t n[3] = {from[0][i], from[1][i], from[2][i]};
            uint16_t color[3];
            uint8_t rgb[3];
            burnish_q15_normalize_near(n, n);
            burnish_q15_shade(&shader, lights, 2, n, color);
            burnish_q15_rgb888(color, rgb);
            wrong += memcmp(kept + at + 4 * i, rgb, 3) != 0 || kept[at + 4 * i + 3] != 255;
            wrong += memory[at + i] != burnish_q15_rgb565(color);
        }
        CHECK(wrong == 0, "%zu pixels: %d wrong", count, wrong);
    }
}

/* Planes of colours at the ends of one array, which the other functions do not write. */
static void test_plane_lengths(void) {
    uint64_t state = test_seed(5);
    burnish_q15_shader shader;
    burnish_q15_light lights[8];
    fill_normals(&state);
    fill_shader(&state, 0, &shader, lights);
    for (size_t count = 0; count <= 70; ++count) {
        uint16_t rows[3][80];
        int16_t units[3][80];
        memset(rows, GUARD, sizeof rows);
        memset(units, GUARD, sizeof units);
        uint16_t *const to[3] = {rows[0] + 1, rows[1] + 2, rows[2] + 3};
        int16_t *const out[3] = {units[0] + 3, units[1] + 1, units[2]};
        burnish_q15_shade_array(&shader, lights, 8, count, normal_planes, to);
        burnish_q15_normalize_near_array(count, normal_planes, out);
        int wrong = 0;
        for (size_t i = 0; i < 77; ++i) {
            const int16_t n[3] = {normals[0][i], normals[1][i], normals[2][i]};
            uint16_t color[3] = {0xA5A5, 0xA5A5, 0xA5A5};
            int16_t unit[3] = {(int16_t)0xA5A5, (int16_t)0xA5A5, (int16_t)0xA5A5};
            if (i < count) {
                burnish_q15_shade(&shader, lights, 8, n, color);
                burnish_q15_normalize_near(n, unit);
            }
            for (int k = 0; k < 3; ++k) {
                wrong += color[k] != to[k][i] || unit[k] != out[k][i];
            }
        }
        CHECK(wrong == 0 && rows[0][0] == 0xA5A5 && rows[2][2] == 0xA5A5, "%zu points: %d wrong",
              count, wrong);
    }
}

#ifndef TEST_MAIN
#define TEST_MAIN main /* arrays_q15_main.c, which checks the processor first, replaces it */
#endif

int TEST_MAIN(int count, char **arguments);

int TEST_MAIN(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    printf("lanes: %d\n", BURNISH_Q15_LANES);
    for (uint32_t c = 0; c < ALL; ++c) {
        cosines[c] = (uint16_t)c;
    }
    RUN(test_lobes());
    RUN(test_can_fail());
    RUN(test_normalize());
    RUN(test_far());
    RUN(test_pixels());
    RUN(test_lengths());
    RUN(test_plane_lengths());
    return test_end("arrays_q15");
}
