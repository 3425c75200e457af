/* burnish/shade_q15.h: the lighting of Phong and Blinn in integers, from vectors to a pixel.
 *
 * What it is. Per colour channel, for lights i,
 *
 *     I = ambient + sum over lights of  diffuse_i (N.L_i) + specular_i S(N.H_i),   N.L_i > 0,
 *
 * with S a lobe of lobe_q15.h, vectors in Q15 and colours in UQ1.15. With it a processor without
 * floating point, division or 64 bits shades a pixel in a few hundred cycles; see docs/firmware.md.
 *
 * How to use it.
 *   1. Copy this file and lobe_q15.h.
 *   2. Once:
 *          burnish_q15_material material = {{...}, {...}, {...}};
 *          burnish_q15_light light;
 *          burnish_q15_shader shader;
 *          burnish_q15_light_create(&light, to_light, to_viewer, light_color, &material);
 *          burnish_q15_shader_create(&shader, BURNISH_Q15_SHIFT7, 2, 40, &material, ambient_light);
 *   3. Per pixel, with an interpolated normal:
 *          burnish_q15_normalize_near(normal, normal);
 *          burnish_q15_shade(&shader, &light, 1, normal, color);
 *          framebuffer[i] = burnish_q15_rgb565(color);
 *
 * Formats.
 *     vector   Q15: three int16_t; 1 is limited to 0x7FFF
 *     color    UQ1.15: 0x8000 is full intensity, up to 0xFFFF (almost 2) while lights are summed
 *     cosine, lambda, lobes: as in lobe_q15.h
 *
 * What it does not do. It does not apply gamma: pixel values are linear in intensity, as most small
 * displays expect. Light and viewer are distant; if they are near, set the light's direction and
 * half vector per pixel.
 *
 * What it promises. Results are defined bit by bit. The code relies on two properties of every
 * compiler for these processors: >> of a negative number is the floor of a division by a power of
 * two, and a conversion to int32_t keeps the low 32 bits. Each function states its error bounds;
 * test_shade_q15 proves them.
 *
 * Sources. Phong, CACM 1975; Blinn, SIGGRAPH 1977; Lyon, Apple TR 43, 1993 (three terms of 1/sqrt,
 * chord form).
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_SHADE_Q15_H
#define BURNISH_SHADE_Q15_H

#include "lobe_q15.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Vectors -------------------------------------------------------------------------------- */

/* The product of two Q15 numbers in Q30. */
BURNISH_Q15_INLINE int32_t burnish_q15_multiply_signed(int16_t a, int16_t b) {
#ifdef BURNISH_Q15_AVR
    int32_t product;
    uint8_t zero;
    __asm__("muls %B2, %B3\n\t"
            "movw %C0, r0\n\t"
            "mul %A2, %A3\n\t"
            "movw %A0, r0\n\t"
            "clr %1\n\t"
            "mulsu %B2, %A3\n\t"
            "sbc %D0, %1\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "mulsu %B3, %A2\n\t"
            "sbc %D0, %1\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "clr r1"
            : "=&r"(product), "=&r"(zero)
            : "a"(a), "a"(b));
    return product;
#else
    return (int32_t)a * b;
#endif
}

/* The dot product of two Q15 vectors in Q30, modulo 2^32: correct while it is below 2 in magnitude,
 * which holds for vectors of length up to 1.4. */
static inline int32_t burnish_q15_dot(const int16_t a[3], const int16_t b[3]) {
    return (int32_t)((uint32_t)burnish_q15_multiply_signed(a[0], b[0]) +
                     (uint32_t)burnish_q15_multiply_signed(a[1], b[1]) +
                     (uint32_t)burnish_q15_multiply_signed(a[2], b[2]));
}

/* floor(x / 2^15) of x below 2^31. By whole bytes on AVR, which shifts one bit at a time. */
BURNISH_Q15_INLINE uint16_t burnish_q15_shift15(uint32_t x) {
#ifdef __AVR__
    return (uint16_t)((x + x) >> 16);
#else
    return (uint16_t)(x >> 15);
#endif
}

/* A dot product as a cosine: max(0, dot) in UQ1.15, rounded, halves up, 1 at most.  dot  Q30 */
static inline uint16_t burnish_q15_cosine(int32_t dot) {
    if (dot <= 0) {
        return 0;
    }
    return dot >= 0x3FFFC000l ? (uint16_t)BURNISH_Q15_ONE
                              : burnish_q15_shift15((uint32_t)dot + 0x4000u);
}

/* 1 - a.b of two unit vectors as |a - b|^2 / 2. Use it for narrow lobes: unlike a dot product it
 * hardly depends on the rounding of the vectors' lengths.
 * Returns UQ0.24, at most 0xFFFFFF; the squares are truncated to 2^-28, their sum is rounded to
 * 2^-24. Source: Lyon 1993. */
static inline uint32_t burnish_q15_chord(const int16_t a[3], const int16_t b[3]) {
    uint32_t sum = 16;
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        const uint16_t d = (uint16_t)(a[i] < b[i] ? (uint16_t)b[i] - (uint16_t)a[i]
                                                  : (uint16_t)a[i] - (uint16_t)b[i]);
        sum += burnish_q15_multiply(d, d) >> 2;
    }
    return burnish_q15_limit_lambda(sum >> 5);
}

/* The cosine of Phong's lobe from three dot products:
 * R.V = 2 (N.L)(N.V) - L.V with R = 2 (N.L) N - L.
 *   n_dot_l, n_dot_v  UQ1.15, at most 0x8000; if one is 0, the surface is dark
 *   l_dot_v           Q30: in [-1, 1]
 * Returns UQ1.15, rounded; 0 if negative. */
static inline uint16_t burnish_q15_reflect_cosine(uint16_t n_dot_l, uint16_t n_dot_v,
                                                  int32_t l_dot_v) {
    const uint32_t both = burnish_q15_multiply(n_dot_l, n_dot_v); /* UQ2.30, at most 2^30 */
    const int32_t half = (int32_t)both - (l_dot_v >> 1);          /* of R.V, in Q30 */
    if (half <= 0) {
        return 0;
    }
    return half >= 0x1FFFE000l ? (uint16_t)BURNISH_Q15_ONE
                               : (uint16_t)(((uint32_t)half + 0x2000u) >> 14);
}

/* Scales a nearly unit vector to unit length by v (1 + e/2 + 3 e^2/8), e = 1 - v.v: three terms of
 * the series of 1/sqrt, without a root or a division. Use it for normals interpolated between
 * vertices.
 *   v     Q15, |v|^2 in [1/2, 3/2]; outside, the length is wrong but does not overflow
 *   unit  receives Q15; may be v
 * Length of the result: 1 within 2 units of 2^-15 for |v| in [0.98, 1.02], 12 for [0.95, 1.05] and
 * 95 for [0.9, 1.1]. The errors of the components are not larger.
 * Source: Lyon 1993. */
static inline void burnish_q15_normalize_near(const int16_t v[3], int16_t unit[3]) {
    const int32_t wide = (int32_t)(0x40002000ul - (uint32_t)burnish_q15_dot(v, v)); /* e, Q30 */
    const int16_t limited = (int16_t)(wide >= 0x20000000l   ? 0x7FFF
                                      : wide < -0x1FFFC000l ? -0x7FFF
                                                            : (wide * 4) >> 16); /* Q16 */
    const uint16_t squared = (uint16_t)(burnish_q15_multiply_signed(limited, limited) >> 16);
    const int16_t gain =
        (int16_t)((limited + (int32_t)((uint16_t)(3u * squared) >> 2) + 1) >> 1); /* Q16 */
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        const int32_t x =
            v[i] + ((burnish_q15_multiply_signed(v[i], gain) + (int32_t)0x8000l) >> 16);
        unit[i] = (int16_t)(x > 0x7FFF ? 0x7FFF : x < -0x7FFF ? -0x7FFF : x);
    }
}

/* 1/sqrt(x) of x in UQ0.32, [1/4, 1): UQ1.15, within 1 unit, 2 limited to 0xFFFF. A parabola of the
 * top 8 bits is accurate to 0.029; four terms of the series of 1/sqrt refine it to 16 bits. */
static inline uint16_t burnish_q15_inverse_root(uint32_t x) {
    const uint8_t top = (uint8_t)(x >> 24);
    const uint16_t bend = (uint16_t)(414u - ((uint16_t)(top * 206u) >> 8));
    const uint8_t guess =
        (uint8_t)(339u - (uint16_t)(burnish_q15_multiply(top, bend) >> 8)); /* UQ1.7 */
    const uint16_t square = (uint16_t)((uint16_t)guess * guess);            /* UQ2.14 */
    const uint32_t product = burnish_q15_multiply((uint16_t)(x >> 16), square) +
                             (burnish_q15_multiply((uint16_t)x, square) >> 16); /* UQ2.30 */
    const int16_t e =
        (int16_t)(((int32_t)0x40000000l - (int32_t)product) >> 11); /* Q19, |e| < 0.06 */
    const int16_t third = (int16_t)(12288 + (burnish_q15_multiply_signed(e, 5) >> 8)); /* Q15 */
    const int16_t second = (int16_t)(16384 + (burnish_q15_multiply_signed(e, third) >> 19));
    const int16_t gain = (int16_t)(burnish_q15_multiply_signed(e, second) >> 15); /* Q19 */
    const int32_t root = ((int32_t)guess << 8) + (((int32_t)guess * gain + 0x400) >> 11);
    return (uint16_t)(root > 0xFFFFl ? 0xFFFFl : root);
}

/* Scales any vector to unit length.
 *   v     three numbers in any common unit
 *   unit  receives Q15
 * Each component is within 1.6 units of 2^-15, the length within 1.5.
 * Returns 1, or 0 for the zero vector, whose result is the zero vector. */
static inline uint8_t burnish_q15_normalize(const int32_t v[3], int16_t unit[3]) {
    uint32_t magnitude[3], all = 0, sum = 0;
    uint8_t i, shift = 17;
    for (i = 0; i < 3; ++i) {
        magnitude[i] = v[i] < 0 ? (uint32_t)0 - (uint32_t)v[i] : (uint32_t)v[i];
        all |= magnitude[i];
        unit[i] = 0;
    }
    if (all == 0) {
        return 0;
    }
    for (; all > 0xFFFFu; all >>= 1) { /* the longest to 16 bits exactly */
        for (i = 0; i < 3; ++i) {
            magnitude[i] >>= 1;
        }
    }
    for (; all < 0x8000u; all <<= 1) {
        for (i = 0; i < 3; ++i) {
            magnitude[i] <<= 1;
        }
    }
    for (i = 0; i < 3; ++i) {
        sum += burnish_q15_multiply((uint16_t)magnitude[i], (uint16_t)magnitude[i]) >> 2;
    }
    if (sum < 0x40000000ul) { /* a quarter of the squared length, to [1/4, 1) */
        sum <<= 2;
        shift = 16;
    }
    {
        const uint16_t root = burnish_q15_inverse_root(sum);
        for (i = 0; i < 3; ++i) {
            const uint32_t x = burnish_q15_multiply((uint16_t)magnitude[i], root) >> (shift - 1);
            const uint16_t rounded = (uint16_t)((x + 1) >> 1);
            const int16_t limited = (int16_t)(rounded > 0x7FFFu ? 0x7FFFu : rounded);
            unit[i] = (int16_t)(v[i] < 0 ? -limited : limited);
        }
    }
    return 1;
}

/* Blinn's half vector, (l + v) / |l + v|.
 *   l, v  unit vectors in Q15
 *   half  receives Q15; may be l or v
 * Returns 1, or 0 for opposite vectors, whose half is the zero vector: its lobe is 0. */
static inline uint8_t burnish_q15_half(const int16_t l[3], const int16_t v[3], int16_t half[3]) {
    int32_t sum[3];
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        sum[i] = (int32_t)l[i] + v[i];
    }
    return burnish_q15_normalize(sum, half);
}

/* ---- Colours -------------------------------------------------------------------------------- */

/* A byte as UQ1.15: 255 becomes 0x8000. */
static inline uint16_t burnish_q15_from_byte(uint8_t byte) {
    return (uint16_t)(((uint32_t)byte * 0x8080u + 0x80u) >> 8);
}

/* The product of two numbers in UQ1.15, rounded, halves up, limited to 0xFFFF. */
BURNISH_Q15_INLINE uint16_t burnish_q15_scale(uint16_t a, uint16_t b) {
    const uint32_t product = burnish_q15_multiply(a, b);
    return product >= 0x7FFFC000ul ? (uint16_t)0xFFFFu : burnish_q15_shift15(product + 0x4000u);
}

/* One term of the sum: sum + floor(weight factor / 2^16), limited to 0xFFFF. The hardware's channel
 * does the same.
 *   sum     UQ1.15
 *   factor  UQ1.15: the light's intensity times the surface's
 *   weight  UQ0.16: a lobe, or a cosine by burnish_q15_weight */
BURNISH_Q15_INLINE uint16_t burnish_q15_accumulate(uint16_t sum, uint16_t factor, uint16_t weight) {
    const uint16_t term = (uint16_t)(burnish_q15_multiply(factor, weight) >> 16);
    const uint16_t total = (uint16_t)(sum + term);
    return total < term ? (uint16_t)0xFFFFu : total;
}

/* A cosine as a weight: UQ1.15, at most 0x8000, to UQ0.16, 1 limited to 0xFFFF. */
BURNISH_Q15_INLINE uint16_t burnish_q15_weight(uint16_t cosine) {
    return cosine >= BURNISH_Q15_ONE ? (uint16_t)0xFFFFu : (uint16_t)(2u * cosine);
}

/* Converts an intensity in UQ1.15 to 0 .. largest, rounded, halves up, limited.
 *   largest  255, 63, 31 ... */
static inline uint8_t burnish_q15_code(uint16_t intensity, uint8_t largest) {
    if (intensity >= BURNISH_Q15_ONE) {
        return largest;
    }
    return (uint8_t)burnish_q15_shift15(burnish_q15_multiply(intensity, largest) + 0x4000u);
}

/* A colour as 5 bits of red, 6 of green, 5 of blue, red on top. */
static inline uint16_t burnish_q15_rgb565(const uint16_t color[3]) {
    return (uint16_t)((uint16_t)((uint16_t)burnish_q15_code(color[0], 31) << 11) |
                      (uint16_t)((uint16_t)burnish_q15_code(color[1], 63) << 5) |
                      burnish_q15_code(color[2], 31));
}

/* A colour as three bytes: red, green, blue. */
static inline void burnish_q15_rgb888(const uint16_t color[3], uint8_t rgb[3]) {
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        rgb[i] = burnish_q15_code(color[i], 255);
    }
}

/* ---- Lighting ------------------------------------------------------------------------------- */

/* What a surface reflects per channel, UQ1.15. */
typedef struct burnish_q15_material {
    uint16_t ambient[3], diffuse[3], specular[3];
} burnish_q15_material;

/* A distant light for a distant viewer, combined with the surface that it lights. */
typedef struct burnish_q15_light {
    int16_t direction[3]; /* Q15, unit: to the light */
    int16_t half[3];      /* Q15, unit: halfway to the viewer */
    uint16_t diffuse[3];  /* UQ1.15: the light's colour times the surface's */
    uint16_t specular[3];
} burnish_q15_light;

/* From this exponent on, a highlight is computed from the chord. Rounding normal and half vector to
 * 15 bits costs n/74 steps of an 8-bit result with their dot product, but 0.05 with the chord. */
#define BURNISH_Q15_NARROW 32

/* Common to all lights. */
typedef struct burnish_q15_shader {
    burnish_lobe_q15 lobe;
    uint16_t ambient[3]; /* UQ1.15: the ambient light's colour times the surface's */
    uint8_t narrow;      /* 1: lobes from the chord: exponents from BURNISH_Q15_NARROW on */
} burnish_q15_shader;

/* Makes a light.
 *   light      becomes the light; not NULL
 *   to_light   Q15, any length but 0
 *   to_viewer  Q15, unit
 *   color      UQ1.15
 *   material   the surface that it lights
 * Returns 1, or 0 when to_light is the zero vector; the light is then black. */
static inline uint8_t burnish_q15_light_create(burnish_q15_light *light, const int16_t to_light[3],
                                               const int16_t to_viewer[3], const uint16_t color[3],
                                               const burnish_q15_material *material) {
    int32_t wide[3];
    uint8_t i, made;
    for (i = 0; i < 3; ++i) {
        wide[i] = to_light[i];
        light->diffuse[i] = burnish_q15_scale(color[i], material->diffuse[i]);
        light->specular[i] = burnish_q15_scale(color[i], material->specular[i]);
    }
    made = burnish_q15_normalize(wide, light->direction);
    (void)burnish_q15_half(light->direction, to_viewer, light->half);
    return made; /* direction 0 makes N.L 0, so nothing is lit */
}

/* Makes a shader.
 *   shader                becomes the shader; on error its lobe is dark; not NULL
 *   fit, order, exponent  as for burnish_lobe_q15_create
 *   ambient_light         UQ1.15
 * Errors: as for burnish_lobe_q15_create. */
static inline burnish_q15_status burnish_q15_shader_create(burnish_q15_shader *shader,
                                                           burnish_q15_fit fit, uint16_t order,
                                                           uint16_t exponent,
                                                           const burnish_q15_material *material,
                                                           const uint16_t ambient_light[3]) {
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        shader->ambient[i] = burnish_q15_scale(ambient_light[i], material->ambient[i]);
    }
    shader->narrow = exponent >= BURNISH_Q15_NARROW;
    return burnish_lobe_q15_create(&shader->lobe, fit, order, exponent);
}

/* The highlight's lobe at N.H, form fast, by cosine or chord.  normal, half  Q15, unit.  UQ0.16 */
static inline uint16_t burnish_q15_highlight(const burnish_q15_shader *shader,
                                             const int16_t normal[3], const int16_t half[3]) {
    if (shader->narrow) {
        return burnish_lobe_q15_fast_lambda(&shader->lobe, burnish_q15_chord(normal, half));
    }
    return burnish_lobe_q15_fast(&shader->lobe, burnish_q15_cosine(burnish_q15_dot(normal, half)));
}

/* The whole equation at one point.
 *   shader         from burnish_q15_shader_create
 *   lights, count  from burnish_q15_light_create; may be NULL when count is 0
 *   normal         Q15, unit
 *   color          receives UQ1.15, limited to 0xFFFF at every term */
static inline void burnish_q15_shade(const burnish_q15_shader *shader,
                                     const burnish_q15_light *lights, uint8_t count,
                                     const int16_t normal[3], uint16_t color[3]) {
    uint8_t i;
    for (i = 0; i < 3; ++i) {
        color[i] = shader->ambient[i];
    }
    for (; count > 0; --count, ++lights) {
        const uint16_t n_dot_l = burnish_q15_cosine(burnish_q15_dot(normal, lights->direction));
        const uint16_t weight = burnish_q15_weight(n_dot_l);
        uint16_t lobe;
        if (n_dot_l == 0) {
            continue;
        }
        for (i = 0; i < 3; ++i) {
            color[i] = burnish_q15_accumulate(color[i], lights->diffuse[i], weight);
        }
        lobe = burnish_q15_highlight(shader, normal, lights->half);
        if (lobe == 0) {
            continue;
        }
        for (i = 0; i < 3; ++i) {
            color[i] = burnish_q15_accumulate(color[i], lights->specular[i], lobe);
        }
    }
}

#ifdef __cplusplus
}
#endif

#endif
