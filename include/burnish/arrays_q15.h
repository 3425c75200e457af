/* burnish/arrays_q15.h: the lobes of lobe_q15.h and the pixels of shade_q15.h over arrays, with
 * the processor's integer SIMD.
 *
 * What it is. For every index, bit for bit,
 *
 *     values[i] = burnish_lobe_q15_fast(lobe, cosines[i])                and near, fast8,
 *     pixels[i] = code(burnish_q15_shade(burnish_q15_normalize_near(normals[i])))
 *
 * with 16-bit lanes: no conversion to floating point, 32-bit lanes in dot products and chords only.
 *
 * How to use it.
 *   1. Copy this file, vector_q15.h, shade_q15.h and lobe_q15.h.
 *   2. Make lobes, lights and shaders with the last two.
 *   3. burnish_lobe_q15_fast_array(&lobe, count, cosines, values);
 *      burnish_q15_pixels_rgba8(&shader, lights, 2, count, normals, rgba);
 *   4. Compile for the processor that you have: the compiler's macros select the instructions.
 *
 *        lanes   processor                             compiler's option
 *          32    x86 with AVX-512BW                    -mavx512bw
 *          16    x86 with AVX2                         -mavx2
 *           8    x86 with SSE2                         none on x86-64
 *           8    Arm with Neon, little-endian          none on AArch64; -mfpu=neon on Armv7-A
 *           8    WebAssembly with SIMD                 -msimd128
 *           2    Arm with the DSP extension: Cortex-M4, M7, M33   -mcpu=cortex-m4
 *           1    any other, or if BURNISH_Q15_PLAIN_C is defined: the functions of the two
 *                headers, one at a time
 *
 *      The processor is not checked at run time.
 *
 * Arrays. Structures of arrays: one array each for x, y and z. They need only the alignment of
 * their elements. Any length is valid, 0 included. An output may be the input of the same type;
 * otherwise arrays must not overlap.
 *
 * What it promises. The results of the two headers, bit for bit, for every input and any lobe,
 * light and shader made by them; test_arrays_q15 compares all 65,536 cosines, and normals of every
 * kind. Nothing outside the arrays is read or written. Vector code takes the same time for every
 * pixel: it has no branch for dark ones.
 *
 * What it does not do. Forms exact and exact8, and lobes over 1 - cosine, need products of 32 bits:
 * call lobe_q15.h for those.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_ARRAYS_Q15_H
#define BURNISH_ARRAYS_Q15_H

#include <stddef.h>

#include "shade_q15.h"
#include "vector_q15.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Lobes and pixels of a vector ------------------------------------------------------------ */

/* Which form a lobe takes; known at compile time. */
enum { BURNISH_Q15_FORM_FAST, BURNISH_Q15_FORM_NEAR, BURNISH_Q15_FORM_FAST8 };

#if BURNISH_Q15_LANES > 1

/* A lobe's numbers in every lane. */
typedef struct burnish_q15v_lobe {
    burnish_q15v slope, reach;
    int shift;
    uint8_t squarings;
} burnish_q15v_lobe;

BURNISH_Q15_INLINE burnish_q15v_lobe burnish_q15v_lobe_of(const burnish_lobe_q15 *lobe) {
    burnish_q15v_lobe wide;
    wide.slope = burnish_q15v_set(lobe->slope);
    wide.reach = burnish_q15v_set(lobe->reach);
    wide.shift = lobe->shift;
    wide.squarings = lobe->squarings ? lobe->squarings : 32; /* the dark lobe: until it is 0 */
    return wide;
}

/* The lobe from a, as burnish_q15_fast_at and its siblings. */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_power(burnish_q15v a, uint8_t squarings, int form) {
    burnish_q15v x = burnish_q15v_xor(a, burnish_q15v_set(0xFFFFu));
    if (form == BURNISH_Q15_FORM_FAST8) {
        burnish_q15v h, g;
        while (--squarings) {
            x = burnish_q15v_high(x, x);
        }
        h = burnish_q15v_right(x, 8); /* y = x >> 7 = h + g, as in burnish_q15_square8 */
        g = burnish_q15v_right(burnish_q15v_add(burnish_q15v_right(x, 7), burnish_q15v_set(1)), 1);
        x = burnish_q15v_add(burnish_q15v_low(h, g),
                             burnish_q15v_right(burnish_q15v_add(g, burnish_q15v_set(255)), 1));
        return burnish_q15v_right(x, 8);
    }
    if (form == BURNISH_Q15_FORM_NEAR) {
        /* t t + t is even, so the mean of its lower half and t is exact */
        const burnish_q15v half = burnish_q15v_mean(burnish_q15v_low(x, x), x);
        x = burnish_q15v_add(
            burnish_q15v_high(x, x),
            burnish_q15v_right(
                burnish_q15v_add(burnish_q15v_right(half, 1), burnish_q15v_set(0x2000)), 14));
        while (--squarings) {
            x = burnish_q15v_add(burnish_q15v_high(x, x),
                                 burnish_q15v_right(burnish_q15v_low(x, x), 15));
        }
        return x;
    }
    do {
        x = burnish_q15v_high(x, x);
    } while (--squarings);
    return x;
}

/* The lobe at a cosine. Lanes beyond reach hold arbitrary values until the end. */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_at_cosine(const burnish_q15v_lobe *lobe,
                                                       burnish_q15v cosine, int form) {
    const burnish_q15v lambda = burnish_q15v_subs(burnish_q15v_set(BURNISH_Q15_ONE), cosine);
    const burnish_q15v low = burnish_q15v_low(lobe->slope, lambda);
    const burnish_q15v high = burnish_q15v_high(lobe->slope, lambda);
    const burnish_q15v a = burnish_q15v_or(burnish_q15v_left(high, 16 - lobe->shift),
                                           burnish_q15v_right(low, lobe->shift));
    return burnish_q15v_where_zero(burnish_q15v_subs(lambda, lobe->reach),
                                   burnish_q15v_power(a, lobe->squarings, form));
}

/* The lobe in form fast at the chord of two vectors. With lambda = 2^8 top + rest, w 2 is slope top
 * + floor(slope rest / 2^8); the lobe is 0 where that is 2^(17 + shift) or more. */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_at_chord(const burnish_q15v_lobe *lobe,
                                                      const burnish_q15v normal[3],
                                                      const burnish_q15v half[3]) {
    burnish_q15v top, rest, low, high, carry, a;
    burnish_q15v_chord(normal, half, &top, &rest);
    rest = burnish_q15v_and(rest, burnish_q15v_set(0xFF00u));
    rest = burnish_q15v_high(lobe->slope, rest);
    low = burnish_q15v_add(burnish_q15v_low(lobe->slope, top), rest);
    carry = burnish_q15v_where_not_zero(burnish_q15v_subs(rest, low), burnish_q15v_set(1));
    high = burnish_q15v_add(burnish_q15v_high(lobe->slope, top), carry);
    a = burnish_q15v_or(burnish_q15v_left(high, 15 - lobe->shift),
                        burnish_q15v_right(low, 1 + lobe->shift));
    return burnish_q15v_where_zero(
        burnish_q15v_subs(high, burnish_q15v_set((uint16_t)((2ul << lobe->shift) - 1u))),
        burnish_q15v_power(a, lobe->squarings, BURNISH_Q15_FORM_FAST));
}

/* burnish_q15_normalize_near */
BURNISH_Q15_INLINE void burnish_q15v_normalize_near(burnish_q15v v[3]) {
    const burnish_q15v least = burnish_q15v_set(0x8001u), sign = burnish_q15v_set(0x8000u);
    burnish_q15v limited, squared, gain;
    int i;
    limited = burnish_q15v_shortfall(burnish_q15v_square_length(v));
    limited = burnish_q15v_max_signed(limited, least);
    squared = burnish_q15v_high_signed(limited, limited);
    squared = burnish_q15v_add(burnish_q15v_add(squared, squared), squared);
    gain =
        burnish_q15v_xor(burnish_q15v_mean(burnish_q15v_xor(limited, sign),
                                           burnish_q15v_xor(burnish_q15v_right(squared, 2), sign)),
                         sign);
    for (i = 0; i < 3; ++i) {
        const burnish_q15v more =
            burnish_q15v_add(burnish_q15v_high_signed(v[i], gain),
                             burnish_q15v_right(burnish_q15v_low(v[i], gain), 15));
        v[i] = burnish_q15v_max_signed(burnish_q15v_adds_signed(v[i], more), least);
    }
}

/* burnish_q15_accumulate */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_accumulate(burnish_q15v sum, burnish_q15v factor,
                                                        burnish_q15v weight) {
    return burnish_q15v_adds(sum, burnish_q15v_high(factor, weight));
}

/* burnish_q15_code */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_code(burnish_q15v intensity, uint16_t largest) {
    const burnish_q15v one = burnish_q15v_set(BURNISH_Q15_ONE);
    const burnish_q15v twice = burnish_q15v_set((uint16_t)(2u * largest));
    const burnish_q15v x = burnish_q15v_sub(intensity, burnish_q15v_subs(intensity, one));
    return burnish_q15v_add(burnish_q15v_high(x, twice),
                            burnish_q15v_right(burnish_q15v_low(x, twice), 15));
}

/* A light's numbers in every lane. */
typedef struct burnish_q15v_light {
    burnish_q15v_axis direction, half_axis;
    burnish_q15v half[3], diffuse[3], specular[3];
} burnish_q15v_light;

BURNISH_Q15_INLINE void burnish_q15v_light_of(burnish_q15v_light *wide,
                                              const burnish_q15_light *light) {
    int i;
    wide->direction = burnish_q15v_axis_of(light->direction);
    wide->half_axis = burnish_q15v_axis_of(light->half);
    for (i = 0; i < 3; ++i) {
        wide->half[i] = burnish_q15v_set((uint16_t)light->half[i]);
        wide->diffuse[i] = burnish_q15v_set(light->diffuse[i]);
        wide->specular[i] = burnish_q15v_set(light->specular[i]);
    }
}

/* Lights that are kept in vectors; others are spread again for every vector of pixels. */
enum { BURNISH_Q15_LIGHTS_KEPT = 4 };

/* What does not depend on the pixel. */
typedef struct burnish_q15v_shader {
    burnish_q15v_lobe lobe;
    burnish_q15v ambient[3];
    uint8_t narrow, count;
    const burnish_q15_light *lights;
    burnish_q15v_light kept[BURNISH_Q15_LIGHTS_KEPT];
} burnish_q15v_shader;

BURNISH_Q15_INLINE void burnish_q15v_shader_of(burnish_q15v_shader *wide,
                                               const burnish_q15_shader *shader,
                                               const burnish_q15_light *lights, uint8_t count) {
    uint8_t i;
    wide->lobe = burnish_q15v_lobe_of(&shader->lobe);
    wide->narrow = shader->narrow;
    wide->count = count;
    wide->lights = lights;
    for (i = 0; i < 3; ++i) {
        wide->ambient[i] = burnish_q15v_set(shader->ambient[i]);
    }
    for (i = 0; i < count && i < BURNISH_Q15_LIGHTS_KEPT; ++i) {
        burnish_q15v_light_of(&wide->kept[i], &lights[i]);
    }
}

/* burnish_q15_shade */
BURNISH_Q15_INLINE void burnish_q15v_shade(const burnish_q15v_shader *shader,
                                           const burnish_q15v normal[3], burnish_q15v color[3]) {
    burnish_q15v_light spread;
    uint8_t i, k;
    for (k = 0; k < 3; ++k) {
        color[k] = shader->ambient[k];
    }
    for (i = 0; i < shader->count; ++i) {
        const burnish_q15v_light *light = &spread;
        burnish_q15v cosine, weight;
        if (i < BURNISH_Q15_LIGHTS_KEPT) {
            light = &shader->kept[i];
        } else {
            burnish_q15v_light_of(&spread, &shader->lights[i]);
        }
        cosine = burnish_q15v_cosine(burnish_q15v_dot(normal, &light->direction));
        weight = burnish_q15v_adds(cosine, cosine);
        for (k = 0; k < 3; ++k) {
            color[k] = burnish_q15v_accumulate(color[k], light->diffuse[k], weight);
        }
        weight = shader->narrow
                     ? burnish_q15v_at_chord(&shader->lobe, normal, light->half)
                     : burnish_q15v_at_cosine(
                           &shader->lobe,
                           burnish_q15v_cosine(burnish_q15v_dot(normal, &light->half_axis)),
                           BURNISH_Q15_FORM_FAST);
        weight = burnish_q15v_where_not_zero(cosine, weight);
        for (k = 0; k < 3; ++k) {
            color[k] = burnish_q15v_accumulate(color[k], light->specular[k], weight);
        }
    }
}

#endif

/* ---- Lobes over arrays -------------------------------------------------------------------------
 */

#if BURNISH_Q15_LANES > 1

BURNISH_Q15_INLINE void burnish_q15v_lobe_store(const burnish_q15v_lobe *lobe, int form,
                                                const uint16_t *cosines, void *values) {
    const burnish_q15v value = burnish_q15v_at_cosine(lobe, burnish_q15v_load(cosines), form);
    if (form == BURNISH_Q15_FORM_FAST8) {
        burnish_q15v_store_bytes((uint8_t *)values, value);
    } else {
        burnish_q15v_store(values, value);
    }
}

/* values: uint8_t for form fast8, else uint16_t */
BURNISH_Q15_INLINE void burnish_q15v_lobe_loop(burnish_q15v_lobe wide, int form, size_t count,
                                               const uint16_t *cosines, void *values) {
    const size_t size = form == BURNISH_Q15_FORM_FAST8 ? 1 : 2;
    const size_t whole = count - count % BURNISH_Q15_LANES;
    uint8_t *to = (uint8_t *)values;
    uint16_t rest[BURNISH_Q15_LANES] = {0}, results[BURNISH_Q15_LANES];
    size_t i;
    for (i = 0; i < whole; i += BURNISH_Q15_LANES) {
        burnish_q15v_lobe_store(&wide, form, cosines + i, to + i * size);
    }
    if (whole == count) {
        return;
    }
    for (i = whole; i < count; ++i) {
        rest[i - whole] = cosines[i];
    }
    burnish_q15v_lobe_store(&wide, form, rest, results);
    for (i = 0; i < (count - whole) * size; ++i) {
        to[whole * size + i] = ((const uint8_t *)results)[i];
    }
}

BURNISH_Q15_INLINE void burnish_q15v_lobe_array(const burnish_lobe_q15 *lobe, int form,
                                                size_t count, const uint16_t *cosines,
                                                void *values) {
    burnish_q15v_lobe wide = burnish_q15v_lobe_of(lobe);
    if (wide.squarings == 1) { /* the usual order: a loop without one inside */
        wide.squarings = 1;
        burnish_q15v_lobe_loop(wide, form, count, cosines, values);
    } else {
        burnish_q15v_lobe_loop(wide, form, count, cosines, values);
    }
}

#else

BURNISH_Q15_INLINE void burnish_q15v_lobe_array(const burnish_lobe_q15 *lobe, int form,
                                                size_t count, const uint16_t *cosines,
                                                void *values) {
    size_t i;
    for (i = 0; i < count; ++i) {
        if (form == BURNISH_Q15_FORM_FAST8) {
            ((uint8_t *)values)[i] = burnish_lobe_q15_fast8(lobe, cosines[i]);
        } else {
            ((uint16_t *)values)[i] = form == BURNISH_Q15_FORM_NEAR
                                          ? burnish_lobe_q15_near(lobe, cosines[i])
                                          : burnish_lobe_q15_fast(lobe, cosines[i]);
        }
    }
}

#endif

/* values[i] = burnish_lobe_q15_fast(lobe, cosines[i]).
 *   lobe     not NULL
 *   count    number of cosines
 *   cosines  UQ1.15; larger ones than 0x8000 count as 1
 *   values   receives UQ0.16; may be cosines itself, must not overlap it otherwise */
static inline void burnish_lobe_q15_fast_array(const burnish_lobe_q15 *lobe, size_t count,
                                               const uint16_t *cosines, uint16_t *values) {
    burnish_q15v_lobe_array(lobe, BURNISH_Q15_FORM_FAST, count, cosines, values);
}

/* values[i] = burnish_lobe_q15_near(lobe, cosines[i]). Otherwise the same. */
static inline void burnish_lobe_q15_near_array(const burnish_lobe_q15 *lobe, size_t count,
                                               const uint16_t *cosines, uint16_t *values) {
    burnish_q15v_lobe_array(lobe, BURNISH_Q15_FORM_NEAR, count, cosines, values);
}

/* values[i] = burnish_lobe_q15_fast8(lobe, cosines[i]).
 *   values  receives UQ0.8; must not overlap cosines */
static inline void burnish_lobe_q15_fast8_array(const burnish_lobe_q15 *lobe, size_t count,
                                                const uint16_t *cosines, uint8_t *values) {
    burnish_q15v_lobe_array(lobe, BURNISH_Q15_FORM_FAST8, count, cosines, values);
}

/* ---- Pixels over arrays ---------------------------------------------------------------------- */

/* What becomes of a colour; known at compile time. The last two normalise first. */
enum { BURNISH_Q15_TO_COLORS, BURNISH_Q15_TO_RGBA8, BURNISH_Q15_TO_RGB565 };

/* Where colours go: three planes, or pixels. */
typedef struct burnish_q15_destination {
    uint16_t *plane[3];
    uint8_t *rgba;
    uint16_t *rgb565;
} burnish_q15_destination;

/* One at a time. */
static inline void burnish_q15_pixel_array(const burnish_q15_shader *shader,
                                           const burnish_q15_light *lights, uint8_t lit, int format,
                                           size_t count, const int16_t *const normal[3],
                                           const burnish_q15_destination *to) {
    size_t i;
    int k;
    for (i = 0; i < count; ++i) {
        int16_t n[3];
        uint16_t color[3];
        for (k = 0; k < 3; ++k) {
            n[k] = normal[k][i];
        }
        if (format != BURNISH_Q15_TO_COLORS) {
            burnish_q15_normalize_near(n, n);
        }
        burnish_q15_shade(shader, lights, lit, n, color);
        if (format == BURNISH_Q15_TO_RGBA8) {
            burnish_q15_rgb888(color, to->rgba + 4 * i);
            to->rgba[4 * i + 3] = 255;
        } else if (format == BURNISH_Q15_TO_RGB565) {
            to->rgb565[i] = burnish_q15_rgb565(color);
        }
        for (k = 0; format == BURNISH_Q15_TO_COLORS && k < 3; ++k) {
            to->plane[k][i] = color[k];
        }
    }
}

#if BURNISH_Q15_LANES > 1

BURNISH_Q15_INLINE void burnish_q15v_pixel_store(const burnish_q15v_shader *shader, int format,
                                                 const int16_t *const normal[3], size_t at,
                                                 const burnish_q15_destination *to, size_t out) {
    burnish_q15v n[3], color[3];
    int k;
    for (k = 0; k < 3; ++k) {
        n[k] = burnish_q15v_load(normal[k] + at);
    }
    if (format != BURNISH_Q15_TO_COLORS) {
        burnish_q15v_normalize_near(n);
    }
    burnish_q15v_shade(shader, n, color);
    if (format == BURNISH_Q15_TO_COLORS) {
        for (k = 0; k < 3; ++k) {
            burnish_q15v_store(to->plane[k] + out, color[k]);
        }
    } else if (format == BURNISH_Q15_TO_RGBA8) {
        const burnish_q15v green = burnish_q15v_left(burnish_q15v_code(color[1], 255), 8);
        burnish_q15v_store_pairs(
            to->rgba + 4 * out, burnish_q15v_or(burnish_q15v_code(color[0], 255), green),
            burnish_q15v_or(burnish_q15v_code(color[2], 255), burnish_q15v_set(0xFF00u)));
    } else {
        const burnish_q15v red = burnish_q15v_left(burnish_q15v_code(color[0], 31), 11);
        const burnish_q15v green = burnish_q15v_left(burnish_q15v_code(color[1], 63), 5);
        burnish_q15v_store(to->rgb565 + out, burnish_q15v_or(burnish_q15v_or(red, green),
                                                             burnish_q15v_code(color[2], 31)));
    }
}

/* The pixels that fill no vector, by way of a whole one. */
BURNISH_Q15_INLINE void burnish_q15v_pixel_rest(const burnish_q15v_shader *shader, int format,
                                                const int16_t *const normal[3], size_t at,
                                                size_t count, const burnish_q15_destination *to) {
    int16_t rest[3][BURNISH_Q15_LANES] = {{0}};
    uint16_t result[3][BURNISH_Q15_LANES];
    uint8_t bytes[4 * BURNISH_Q15_LANES];
    const int16_t *const from[3] = {rest[0], rest[1], rest[2]};
    burnish_q15_destination own;
    size_t i;
    int k;
    for (k = 0; k < 3; ++k) {
        own.plane[k] = result[k];
        for (i = 0; i < count; ++i) {
            rest[k][i] = normal[k][at + i];
        }
    }
    own.rgba = bytes;
    own.rgb565 = result[0];
    burnish_q15v_pixel_store(shader, format, from, 0, &own, 0);
    for (i = 0; i < count; ++i) {
        if (format == BURNISH_Q15_TO_RGB565) {
            to->rgb565[at + i] = result[0][i];
        }
        for (k = 0; format == BURNISH_Q15_TO_COLORS && k < 3; ++k) {
            to->plane[k][at + i] = result[k][i];
        }
        for (k = 0; format == BURNISH_Q15_TO_RGBA8 && k < 4; ++k) {
            to->rgba[4 * (at + i) + (size_t)k] = bytes[4 * i + (size_t)k];
        }
    }
}

BURNISH_Q15_INLINE void burnish_q15v_pixel_array(const burnish_q15_shader *shader,
                                                 const burnish_q15_light *lights, uint8_t lit,
                                                 int format, size_t count,
                                                 const int16_t *const normal[3],
                                                 const burnish_q15_destination *to) {
    const size_t whole = count - count % BURNISH_Q15_LANES;
    burnish_q15v_shader wide;
    size_t i;
    /* no lobe that burnish_q15_shader_create makes narrow reaches that far */
    if (shader->narrow && burnish_lobe_q15_fast_lambda(&shader->lobe, BURNISH_Q15V_FAR) != 0) {
        burnish_q15_pixel_array(shader, lights, lit, format, count, normal, to);
        return;
    }
    burnish_q15v_shader_of(&wide, shader, lights, lit);
    for (i = 0; i < whole; i += BURNISH_Q15_LANES) {
        burnish_q15v_pixel_store(&wide, format, normal, i, to, i);
    }
    if (whole < count) {
        burnish_q15v_pixel_rest(&wide, format, normal, whole, count - whole, to);
    }
}

#endif

#if BURNISH_Q15_LANES > 1
#define BURNISH_Q15_PIXELS burnish_q15v_pixel_array
#else
#define BURNISH_Q15_PIXELS burnish_q15_pixel_array
#endif

/* out[i] = burnish_q15_normalize_near(in[i]).
 *   count  number of vectors
 *   in     x, y, z: Q15, of a length near 1
 *   out    receives x, y, z; may be in's arrays */
static inline void burnish_q15_normalize_near_array(size_t count, const int16_t *const in[3],
                                                    int16_t *const out[3]) {
    size_t i = 0;
    int k;
#if BURNISH_Q15_LANES > 1
    const size_t whole = count - count % BURNISH_Q15_LANES;
    for (; i < whole; i += BURNISH_Q15_LANES) {
        burnish_q15v v[3];
        for (k = 0; k < 3; ++k) {
            v[k] = burnish_q15v_load(in[k] + i);
        }
        burnish_q15v_normalize_near(v);
        for (k = 0; k < 3; ++k) {
            burnish_q15v_store(out[k] + i, v[k]);
        }
    }
#endif
    for (; i < count; ++i) {
        int16_t v[3];
        for (k = 0; k < 3; ++k) {
            v[k] = in[k][i];
        }
        burnish_q15_normalize_near(v, v);
        for (k = 0; k < 3; ++k) {
            out[k][i] = v[k];
        }
    }
}

/* color[i] = burnish_q15_shade(shader, lights, light_count, normal[i]).
 *   shader               from burnish_q15_shader_create; not NULL
 *   lights, light_count  from burnish_q15_light_create; may be NULL when light_count is 0. Up to
 *                        BURNISH_Q15_LIGHTS_KEPT are prepared once, others for each vector
 *   count                number of normals
 *   normal               x, y, z: Q15, unit
 *   color                receives red, green, blue: UQ1.15; must not overlap normal */
static inline void burnish_q15_shade_array(const burnish_q15_shader *shader,
                                           const burnish_q15_light *lights, uint8_t light_count,
                                           size_t count, const int16_t *const normal[3],
                                           uint16_t *const color[3]) {
    const burnish_q15_destination to = {{color[0], color[1], color[2]}, 0, 0};
    BURNISH_Q15_PIXELS(shader, lights, light_count, BURNISH_Q15_TO_COLORS, count, normal, &to);
}

/* The whole pixel: burnish_q15_normalize_near, burnish_q15_shade, burnish_q15_rgb888.
 *   normal  x, y, z: Q15, of a length near 1, as after interpolation
 *   rgba    receives 4 count bytes: red, green, blue, 255
 * Otherwise as burnish_q15_shade_array. */
static inline void burnish_q15_pixels_rgba8(const burnish_q15_shader *shader,
                                            const burnish_q15_light *lights, uint8_t light_count,
                                            size_t count, const int16_t *const normal[3],
                                            uint8_t *rgba) {
    const burnish_q15_destination to = {{0, 0, 0}, rgba, 0};
    BURNISH_Q15_PIXELS(shader, lights, light_count, BURNISH_Q15_TO_RGBA8, count, normal, &to);
}

/* The same to burnish_q15_rgb565.
 *   pixels  receives count pixels */
static inline void burnish_q15_pixels_rgb565(const burnish_q15_shader *shader,
                                             const burnish_q15_light *lights, uint8_t light_count,
                                             size_t count, const int16_t *const normal[3],
                                             uint16_t *pixels) {
    const burnish_q15_destination to = {{0, 0, 0}, 0, pixels};
    BURNISH_Q15_PIXELS(shader, lights, light_count, BURNISH_Q15_TO_RGB565, count, normal, &to);
}

#ifdef __cplusplus
}
#endif

#endif
