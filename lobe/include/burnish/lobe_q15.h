/* burnish/lobe_q15.h: the family of specular lobes in integers, for processors without floating
 * point.
 *
 * What it is. In place of cos(angle)^n, the highlight of Phong and Blinn, this header computes
 *
 *     S(c) = t^m,   t = max(0, 1 - zeta (1 - c)),   m = 2, 4, 8 or 16,
 *
 * from a 16-bit cosine c (or a 24-bit 1 - c) with two multiplications of 16 bits by 16, a shift and
 * a complement. Each doubling of the order takes one more multiplication. It needs neither tables
 * nor 64-bit arithmetic; making a lobe takes one or two divisions.
 *
 * How to use it.
 *   1. Copy this file; it includes <stdint.h> and nothing else.
 *   2. One lobe, nothing to set up:
 *          specular = burnish_taylor_q15(n, cosine);
 *   3. Any lobe, made once per material; a status other than BURNISH_Q15_OK leaves a dark lobe:
 *          burnish_lobe_q15 lobe;
 *          status = burnish_lobe_q15_create(&lobe, BURNISH_Q15_ENERGY, 2, 32);
 *          specular = burnish_lobe_q15_fast(&lobe, cosine);
 *   4. cos^n itself to a third of an 8-bit step, with at most five multiplications:
 *          burnish_composite_q15 phong;
 *          status = burnish_composite_q15_create(&phong, 32);
 *          specular = burnish_composite_q15_at_cosine(&phong, cosine);
 *
 * Formats.
 *     cosine   UQ1.15  0x8000 is 1; larger values count as 1. A negative cosine is 0.
 *     lambda   UQ0.24  1 - cosine, for narrow lobes; at most 0xFFFFFF
 *     result   UQ0.16  v means v / 65536; 1 is limited to 0xFFFF
 *     result8  UQ0.8   v means v / 256; 1 is limited to 0xFF
 *     slope    2 zeta = slope / 2^shift
 *
 * What is computed, in integers; >> is the floor of a division by a power of two:
 *
 *     u = 0x8000 - min(cosine, 0x8000)                                   UQ1.15, exact
 *     w = slope u                     of a cosine,                       below 2^31
 *     w = floor(slope lambda / 2^9)   of a lambda,                       below 2^32
 *     a = w >> shift                  zeta (1 - c) in 2^-16; the result is 0 if a > 0xFFFF
 *     t = 0xFFFF - a                  the complement of a's 16 bits
 *
 *     fast    x = (t t) >> 16, then again x = (x x) >> 16 for each further order
 *     near    x = (t t + t + 0x8000) >> 16, then x = (x x + 0x8000) >> 16
 *     fast8   fast up to order m/2 (order 2: t itself), then of its top 9 bits y = x >> 7:
 *             (y (y + 1) + 511) >> 10
 *     exact   T = 1 - zeta (1 - c) in UQ0.32, exact for a cosine, and for a lambda if
 *             shift <= 7, else rounded up; x = floor(T T / 2^32) for each squaring;
 *             finally rounded to 16 bits, halves up
 *     exact8  the same, rounded to 8 bits
 *
 * Slopes. taylor n / 2^(log2 m - 1), shift7 7n / 2^3, shift3 3n / 2^2 are exact. energy and your
 * own zeta are rounded to 16 significant bits.
 *
 * What it promises. Every result is defined bit by bit for every input; a result never decreases as
 * the cosine grows. The table has bounds of the error against the exact real lobe, in units of the
 * result's last place, for all cosines, all lambdas and n = 1 .. 1023. Saturation at 1 is not
 * counted. `make prove-q15` proves the bounds.
 *
 *                        fast            near              exact        fast8         exact8
 *     order              2  4  8  16    2   4   8    16    all          2 .. 8  16    all
 *     exact slopes       3  7  15 29    1.5 3.4 6.9  13.3  0.5003       1       1.04  0.50001
 *     energy             3  7  15 29    1.6 3.5 6.9  13.3  0.86         1       1.04  0.502
 *
 * A composite differs from cos^n by at most 32 steps of 2^-16 (an eighth of an 8-bit step), at
 * n = 15 by at most 70.
 *
 * What it does not do. It does not shade: see shade_q15.h. Only composites are near cos^n;
 * docs/theory.md has the difference of the others. Rounding a cosine to 15 bits costs a narrow lobe
 * n/256 steps of an 8-bit result, so from n = 128 on prefer the functions that take lambda.
 *
 * Sources. See lobe.h; the shift by 7/16 and the boundary memory come from the paper that burnish
 * implements (docs/theory.md).
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_LOBE_Q15_H
#define BURNISH_LOBE_Q15_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* For steps that are hardly larger than a call. At -Os, which Arduino uses, GCC would not inline
 * them. On AVR this makes lobes up to 2.9 times as slow, and most of them larger. */
#ifdef __GNUC__
#define BURNISH_Q15_INLINE static inline __attribute__((always_inline))
#else
#define BURNISH_Q15_INLINE static inline
#endif

/* The cosine 1, and the largest 1 - cosine. */
#define BURNISH_Q15_ONE 0x8000u
#define BURNISH_Q15_LAMBDA_MAX 0xFFFFFFul

/* The exponents for which lobes exist, and the largest zeta in UQ16.16. */
#define BURNISH_Q15_EXPONENT_MAX 1023u
#define BURNISH_Q15_ZETA_MAX 0x7FFF0000ul

typedef enum burnish_q15_status {
    BURNISH_Q15_OK,
    BURNISH_Q15_ERROR_EXPONENT,           /* the exponent must be from 1 to 1023 */
    BURNISH_Q15_ERROR_ORDER,              /* the order must be 2, 4, 8, 16; shift7, shift3: 2 */
    BURNISH_Q15_ERROR_ORDER_FOR_EXPONENT, /* an order above 2 must not be above the exponent */
    BURNISH_Q15_ERROR_FIT,                /* the fit is not one of burnish_q15_fit */
    BURNISH_Q15_ERROR_ZETA                /* zeta must be from 1/65536 to 32767 */
} burnish_q15_status;

/* How zeta follows from the exponent n and the order m. */
typedef enum burnish_q15_fit {
    BURNISH_Q15_TAYLOR, /* n/m */
    BURNISH_Q15_ENERGY, /* (n+1)/(m+1) */
    BURNISH_Q15_SHIFT7, /* 7n/16, m = 2 */
    BURNISH_Q15_SHIFT3  /* 3n/8, m = 2 */
} burnish_q15_fit;

/* One lobe; make it with a function below, such as burnish_lobe_q15_create. reach is the word of
 * the boundary memory: beyond it nothing is computed. If all members are 0, it is the dark lobe,
 * which is 0. */
typedef struct burnish_lobe_q15 {
    uint16_t slope;    /* 2 zeta 2^shift */
    uint16_t reach;    /* UQ1.15: the largest 1 - cosine at which the lobe is above 0 */
    uint8_t shift;     /* 0 .. 15 */
    uint8_t squarings; /* log2 m: 1 .. 4; 0 in the dark lobe */
} burnish_lobe_q15;

/* ---- Steps -------------------------------------------------------------------------------------
 *
 * The steps of the functions below; rtl has a module for each. */

/* 1 - cosine in UQ1.15.  cosine  any; above 0x8000 counts as 1 */
BURNISH_Q15_INLINE uint16_t burnish_q15_lambda(uint16_t cosine) {
#ifdef __AVR__ /* two cycles; the comparison takes six */
    uint16_t lambda = (uint16_t)(BURNISH_Q15_ONE - cosine);
    if (lambda & 0x8000u) {
        lambda = cosine == 0 ? lambda : 0;
    }
    return lambda;
#else
    return cosine > BURNISH_Q15_ONE ? (uint16_t)0 : (uint16_t)(BURNISH_Q15_ONE - cosine);
#endif
}

/* AVR with a multiplier: products in assembly, which make a lobe 1.4 to 7 times as fast as the C
 * below. The firmware's tests compare both; define BURNISH_Q15_PLAIN_C to use the C. */
#if defined(__AVR_HAVE_MUL__) && defined(__GNUC__) && !defined(BURNISH_Q15_PLAIN_C)
#define BURNISH_Q15_AVR 1
#endif

/* The product of two 16-bit numbers in 32 bits. */
BURNISH_Q15_INLINE uint32_t burnish_q15_multiply(uint16_t a, uint16_t b) {
#ifdef BURNISH_Q15_AVR
    uint32_t product;
    uint8_t zero;
    __asm__("mul %A2, %A3\n\t"
            "movw %A0, r0\n\t"
            "mul %B2, %B3\n\t"
            "movw %C0, r0\n\t"
            "clr %1\n\t"
            "mul %B2, %A3\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "mul %A2, %B3\n\t"
            "add %B0, r0\n\t"
            "adc %C0, r1\n\t"
            "adc %D0, %1\n\t"
            "clr r1"
            : "=&r"(product), "=&r"(zero)
            : "r"(a), "r"(b));
    return product;
#else
    return (uint32_t)a * b;
#endif
}

/* w of a cosine: zeta (1 - c) in 2^-(16 + shift), exact.  lambda  UQ1.15, at most 0x8000 */
BURNISH_Q15_INLINE uint32_t burnish_q15_product(uint16_t slope, uint_fast16_t lambda) {
#ifdef BURNISH_Q15_AVR
    return burnish_q15_multiply(slope, lambda);
#else
    return (uint32_t)slope * (uint32_t)lambda;
#endif
}

/* w of a 1 - cosine: zeta lambda in 2^-(16 + shift), floor.  lambda  UQ0.24, at most 0xFFFFFF */
BURNISH_Q15_INLINE uint32_t burnish_q15_product_lambda(uint16_t slope, uint32_t lambda) {
    return ((burnish_q15_multiply(slope, (uint16_t)(lambda >> 16)) << 8) +
            (burnish_q15_multiply(slope, (uint16_t)lambda) >> 8)) >>
           1;
}

/* floor(w / 2^shift): by a whole byte first on AVR, which shifts one bit at a time. */
BURNISH_Q15_INLINE uint32_t burnish_q15_shift(uint32_t w, uint8_t shift) {
#ifdef __AVR__
    if (shift >= 8) {
        w >>= 8;
        shift = (uint8_t)(shift - 8);
    }
#endif
    return w >> shift;
}

/* floor(x^2 / 2^16) of x in UQ0.16. */
BURNISH_Q15_INLINE uint16_t burnish_q15_square(uint_fast16_t x) {
#ifdef BURNISH_Q15_AVR
    uint16_t square;
    uint8_t low, zero;
    __asm__("mul %A3, %A3\n\t"
            "mov %1, r1\n\t"
            "mul %B3, %B3\n\t"
            "movw %A0, r0\n\t"
            "clr %2\n\t"
            "mul %A3, %B3\n\t"
            "add %1, r0\n\t"
            "adc %A0, r1\n\t"
            "adc %B0, %2\n\t"
            "add %1, r0\n\t"
            "adc %A0, r1\n\t"
            "adc %B0, %2\n\t"
            "clr r1"
            : "=&r"(square), "=&r"(low), "=&r"(zero)
            : "r"(x));
    return square;
#else
    return (uint16_t)(((uint32_t)x * (uint32_t)x) >> 16);
#endif
}

/* x^2 of x in UQ0.16, rounded, halves up; 0xFFFF^2 + 0x8000 still fits. */
BURNISH_Q15_INLINE uint16_t burnish_q15_square_rounded(uint16_t x) {
    return (uint16_t)((burnish_q15_multiply(x, x) + 0x8000u) >> 16);
}

/* (x + 1/2)^2 of x in UQ0.16, rounded: x means the middle of the interval truncated to it. */
BURNISH_Q15_INLINE uint16_t burnish_q15_square_middle(uint16_t x) {
    return (uint16_t)((burnish_q15_multiply(x, x) + x + 0x8000u) >> 16);
}

/* (y + 1/2)^2 of y = x >> 7, the top 9 bits of x in UQ0.16, rounded to 8 bits:
 * (y (y + 1) + 511) >> 10. With y = 2 h + b that is (h h + b h + ((h + b + 255) >> 1)) >> 8, which
 * needs one product of 8 bits and fits in 16. */
BURNISH_Q15_INLINE uint8_t burnish_q15_square8(uint_fast16_t x) {
#ifdef BURNISH_Q15_AVR
    uint8_t result = 255, zero, some;
    __asm__("mul %B3, %B3\n\t"
            "clr %1\n\t"
            "lsl %A3\n\t" /* carry: b */
            "sbc %2, %2\n\t"
            "and %2, %B3\n\t" /* b h */
            "adc %0, %B3\n\t"
            "ror %0\n\t" /* (h + b + 255) >> 1 */
            "add r0, %2\n\t"
            "adc r1, %1\n\t"
            "add r0, %0\n\t"
            "adc r1, %1\n\t"
            "mov %0, r1\n\t"
            "clr r1"
            : "+&r"(result), "=&r"(zero), "=&r"(some), "+r"(x));
    return result;
#else
    const uint32_t y = (uint32_t)x >> 7;
    return (uint8_t)((y * y + y + 511u) >> 10);
#endif
}

/* floor(x^2 / 2^32) of x in UQ0.32, from products of 16 bits. */
static inline uint32_t burnish_q15_square_wide(uint32_t x) {
    const uint16_t high = (uint16_t)(x >> 16), low = (uint16_t)x;
    const uint32_t cross = burnish_q15_multiply(high, low); /* twice, at 2^16 */
    const uint32_t carry = burnish_q15_multiply(low, low) >> 17;
    return burnish_q15_multiply(high, high) + ((cross + carry) >> 15);
}

/* UQ0.32 rounded to UQ0.16, halves up, 1 limited to 0xFFFF. */
BURNISH_Q15_INLINE uint16_t burnish_q15_round(uint32_t x) {
    return x >= 0xFFFF8000ul ? (uint16_t)0xFFFFu : (uint16_t)((x + 0x8000u) >> 16);
}

/* UQ0.32 rounded to UQ0.8, halves up, 1 limited to 0xFF. */
BURNISH_Q15_INLINE uint8_t burnish_q15_round8(uint32_t x) {
    return x >= 0xFF800000ul ? (uint8_t)0xFFu : (uint8_t)((x + 0x800000ul) >> 24);
}

/* The lobe from a, zeta (1 - c) in 2^-16 and below 1, truncated to 16 bits at every step: at
 * most 2m - 1 steps below the lobe.
 *   a          0 .. 0xFFFF
 *   squarings  1 .. 4; 0 (the dark lobe) gives 0 */
BURNISH_Q15_INLINE uint16_t burnish_q15_fast_at(uint_fast16_t a, uint8_t squarings) {
    uint16_t x = burnish_q15_square(0xFFFFu - a);
    while (--squarings) {
        x = burnish_q15_square(x);
    }
    return x;
}

/* The same with rounding at every step and the half bit that the complement loses put back. */
static inline uint16_t burnish_q15_near_at(uint_fast16_t a, uint8_t squarings) {
    uint16_t x = burnish_q15_square_middle((uint16_t)(0xFFFFu - a));
    while (--squarings) {
        x = burnish_q15_square_rounded(x);
    }
    return x;
}

/* The same to 8 bits: the last square from 9 bits. */
static inline uint8_t burnish_q15_fast8_at(uint_fast16_t a, uint8_t squarings) {
    uint_fast16_t x = 0xFFFFu - a;
    while (--squarings) {
        x = burnish_q15_square(x);
    }
    return burnish_q15_square8(x);
}

/* zeta lambda below 1 as a fraction in UQ0.32: exact if shift <= 7, otherwise its floor. The result
 * is modulo 1, so test w first.
 *   lambda  UQ0.24 */
static inline uint32_t burnish_q15_fraction(uint16_t slope, uint8_t shift, uint32_t lambda) {
    const uint32_t high = burnish_q15_multiply(slope, (uint16_t)(lambda >> 16));
    const uint32_t low = burnish_q15_multiply(slope, (uint16_t)lambda);
    return (high << (23 - shift)) + (shift <= 7 ? low << (7 - shift) : low >> (shift - 7));
}

/* (1 - fraction)^m in UQ0.32, 1 limited to 0xFFFFFFFF; error below 2m - 2 units of 2^-32.
 *   fraction  UQ0.32 */
static inline uint32_t burnish_q15_wide_of(uint32_t fraction, uint8_t squarings) {
    uint32_t x = (uint32_t)(0u - fraction);
    if (fraction == 0) {
        return squarings ? 0xFFFFFFFFul : 0;
    }
    do {
        x = burnish_q15_square_wide(x);
    } while (--squarings);
    return x;
}

/* ---- Lobes with nothing to set up --------------------------------------------------------------
 *
 * Order 2, form fast. The top bits of the product show where the lobe is 0.
 *   exponent  n: 0 .. 1023 (8191 where 7n and 3n must fit); 0 gives 0xFFFE everywhere
 *   cosine    UQ1.15
 * Returns UQ0.16, at most 0xFFFE. */

/* Form fast, order 2, of any slope. For a cosine above 1 the difference wraps, w exceeds 2^31, and
 * the test for the cutoff also detects that. */
BURNISH_Q15_INLINE uint16_t burnish_slope_q15(uint16_t slope, uint8_t shift, uint16_t cosine) {
#ifdef __AVR__ /* 16 bits are cheaper there, but do not show the wrap */
    const uint32_t a = burnish_q15_product(slope, burnish_q15_lambda(cosine)) >> shift;
    return a > 0xFFFFu ? (uint16_t)0 : burnish_q15_square((uint16_t)~a);
#else
    const uint32_t a = (slope * (BURNISH_Q15_ONE - (uint32_t)cosine)) >> shift;
    if (a > 0xFFFFu) {
        return cosine > BURNISH_Q15_ONE ? (uint16_t)0xFFFEu : (uint16_t)0;
    }
    return burnish_q15_square((uint_fast16_t)(0xFFFFu - a));
#endif
}

/* zeta = n/2, the paper's W: p = n u is zeta (1 - c) in 2^-16. */
static inline uint16_t burnish_taylor_q15(uint16_t exponent, uint16_t cosine) {
    return burnish_slope_q15(exponent, 0, cosine);
}

/* zeta = 7n/16, the paper's W_0.5: 7n = 8n - n. */
static inline uint16_t burnish_shift7_q15(uint16_t exponent, uint16_t cosine) {
    return burnish_slope_q15((uint16_t)((uint16_t)(exponent << 3) - exponent), 3, cosine);
}

/* zeta = 3n/8: 3n = 2n + n. */
static inline uint16_t burnish_shift3_q15(uint16_t exponent, uint16_t cosine) {
    return burnish_slope_q15((uint16_t)((uint16_t)(exponent << 1) + exponent), 2, cosine);
}

/* zeta = n/2 to 8 bits.  exponent  n: 0 .. 255.  Returns UQ0.8. Form fast8. */
static inline uint8_t burnish_taylor8_q15(uint8_t exponent, uint16_t cosine) {
#ifdef BURNISH_Q15_AVR /* two products of 8 bits */
    const uint16_t u = burnish_q15_lambda(cosine);
    uint16_t a;
    uint8_t above;
    __asm__("mul %2, %A3\n\t"
            "movw %A0, r0\n\t"
            "mul %2, %B3\n\t"
            "clr %1\n\t"
            "add %B0, r0\n\t"
            "adc %1, r1\n\t"
            "clr r1"
            : "=&r"(a), "=&r"(above)
            : "r"(exponent), "r"(u));
    return above ? (uint8_t)0 : burnish_q15_square8((uint16_t)~a);
#else
    const uint32_t a = exponent * (BURNISH_Q15_ONE - (uint32_t)cosine);
    if (a > 0xFFFFu) {
        return cosine > BURNISH_Q15_ONE ? (uint8_t)0xFFu : (uint8_t)0;
    }
    return burnish_q15_square8((uint_fast16_t)(0xFFFFu - a));
#endif
}

/* ---- Lobes made once ------------------------------------------------------------------------ */

/* The dark lobe, which is 0 everywhere, c = 1 included. */
static inline void burnish_lobe_q15_darken(burnish_lobe_q15 *lobe) {
    lobe->slope = 0;
    lobe->reach = 0;
    lobe->shift = 0;
    lobe->squarings = 0;
}

/* log2 of an order: 1 .. 4; 0 for any other number. */
static inline uint8_t burnish_q15_squarings(uint16_t order) {
    switch (order) {
    case 2:
        return 1;
    case 4:
        return 2;
    case 8:
        return 3;
    case 16:
        return 4;
    default:
        return 0;
    }
}

/* The largest 1 - cosine at which a is below 1, that is slope u < 2^(16 + shift); at most 1.
 *   slope  not 0 */
static inline uint16_t burnish_q15_reach(uint16_t slope, uint8_t shift) {
    const uint32_t largest = (((uint32_t)0x10000ul << shift) - 1u) / slope;
    return largest >= BURNISH_Q15_ONE ? (uint16_t)BURNISH_Q15_ONE : (uint16_t)largest;
}

/* Sets the boundary from a word that `burnish-lobe boundary --format-word=UQ0.15` prints: cosines
 * up to the word give 0. A word for --bits=0 of the same lobe changes no result. With a threshold,
 * values below it become 0 and less is computed. A word below the lobe's own cutoff changes
 * nothing.
 *   lobe  not NULL
 *   word  UQ0.15; 0 means no boundary */
static inline void burnish_lobe_q15_set_boundary(burnish_lobe_q15 *lobe, uint16_t word) {
    const uint16_t reach =
        word < BURNISH_Q15_ONE ? (uint16_t)(BURNISH_Q15_ONE - 1u - word) : (uint16_t)0;
    if (word != 0 && reach < lobe->reach) {
        lobe->reach = reach;
    }
}

/* Makes the lobe of a slope, 2 zeta = slope / 2^shift, for precomputed slopes. One division, for
 * the boundary.
 *   lobe   becomes the lobe, on error the dark one; not NULL
 *   slope  1 .. 65535
 *   shift  0 .. 15; 8 means a slope in UQ8.8, which an 8-bit processor need not shift
 *   order  2, 4, 8 or 16
 * Errors: ERROR_ORDER; ERROR_ZETA for a slope of 0 or a shift above 15. */
static inline burnish_q15_status burnish_lobe_q15_from_slope(burnish_lobe_q15 *lobe, uint16_t slope,
                                                             uint8_t shift, uint16_t order) {
    const uint8_t squarings = burnish_q15_squarings(order);
    burnish_lobe_q15_darken(lobe);
    if (squarings == 0) {
        return BURNISH_Q15_ERROR_ORDER;
    }
    if (slope == 0 || shift > 15) {
        return BURNISH_Q15_ERROR_ZETA;
    }
    lobe->slope = slope;
    lobe->shift = shift;
    lobe->squarings = squarings;
    lobe->reach = burnish_q15_reach(slope, shift);
    return BURNISH_Q15_OK;
}

/* Makes the lobe of a zeta, rounded to 16 significant bits (halves up); below 1 to 2^-16.
 *   lobe      becomes the lobe, on error the dark one; not NULL
 *   zeta_q16  UQ16.16: 1 .. 0x7FFF0000
 *   order     2, 4, 8 or 16
 * Errors: ERROR_ORDER, ERROR_ZETA. */
static inline burnish_q15_status burnish_lobe_q15_from_zeta(burnish_lobe_q15 *lobe,
                                                            uint32_t zeta_q16, uint16_t order) {
    uint8_t shift = 15; /* 2 zeta 2^15 is zeta_q16 itself */
    uint32_t slope = zeta_q16;
    burnish_lobe_q15_darken(lobe);
    if (zeta_q16 == 0 || zeta_q16 > BURNISH_Q15_ZETA_MAX) {
        return burnish_q15_squarings(order) ? BURNISH_Q15_ERROR_ZETA : BURNISH_Q15_ERROR_ORDER;
    }
    while (slope > 0xFFFFu) {
        --shift;
        slope = (zeta_q16 + ((uint32_t)0x4000ul >> shift)) >> (15 - shift);
    }
    return burnish_lobe_q15_from_slope(lobe, (uint16_t)slope, shift, order);
}

/* 2 zeta 2^shift of the energy fit with 16 significant bits, rounded, halves up.
 *   exponent  1 .. 1023
 *   order     2 .. 16
 *   shift     receives 0 .. 15 */
static inline uint16_t burnish_q15_energy_slope(uint16_t exponent, uint16_t order, uint8_t *shift) {
    const uint16_t whole = (uint16_t)(order + 1u);
    uint32_t scaled = (uint32_t)(exponent + 1u) << 1; /* 2 (n+1) 2^shift */
    *shift = 0;
    while (*shift < 15 && scaled < (uint32_t)0x8000ul * whole) { /* until the slope has 16 bits */
        scaled <<= 1;
        ++*shift;
    }
    return (uint16_t)((scaled + whole / 2u) / whole);
}

/* Makes the lobe that approximates cos^exponent.
 *   lobe      becomes the lobe, on error the dark one; not NULL
 *   fit       see burnish_q15_fit
 *   order     2, 4, 8 or 16, above 2 at most the exponent; SHIFT7 and SHIFT3: 2
 *   exponent  n: 1 .. 1023
 * Errors: ERROR_FIT, ERROR_ORDER, ERROR_EXPONENT, ERROR_ORDER_FOR_EXPONENT. */
static inline burnish_q15_status burnish_lobe_q15_create(burnish_lobe_q15 *lobe,
                                                         burnish_q15_fit fit, uint16_t order,
                                                         uint16_t exponent) {
    const uint8_t squarings = burnish_q15_squarings(order);
    uint16_t slope;
    uint8_t shift;
    burnish_lobe_q15_darken(lobe);
    if (squarings == 0 ||
        ((fit == BURNISH_Q15_SHIFT7 || fit == BURNISH_Q15_SHIFT3) && order != 2)) {
        return BURNISH_Q15_ERROR_ORDER;
    }
    if (exponent == 0 || exponent > BURNISH_Q15_EXPONENT_MAX) {
        return BURNISH_Q15_ERROR_EXPONENT;
    }
    if (order > 2 && exponent < order) {
        return BURNISH_Q15_ERROR_ORDER_FOR_EXPONENT;
    }
    switch (fit) {
    case BURNISH_Q15_TAYLOR:
        slope = exponent;
        shift = (uint8_t)(squarings - 1);
        break;
    case BURNISH_Q15_ENERGY:
        slope = burnish_q15_energy_slope(exponent, order, &shift);
        break;
    case BURNISH_Q15_SHIFT7:
        slope = (uint16_t)(7u * exponent);
        shift = 3;
        break;
    case BURNISH_Q15_SHIFT3:
        slope = (uint16_t)(3u * exponent);
        shift = 2;
        break;
    default:
        return BURNISH_Q15_ERROR_FIT;
    }
    return burnish_lobe_q15_from_slope(lobe, slope, shift, order);
}

/* Rounds a lobe's slope to UQ8.8. The shift is then a whole byte, which is fast on 8-bit
 * processors. zeta changes by at most 2^-10.
 *   lobe  not NULL, zeta below 127.99; its boundary is reset to its own cutoff
 * Errors: ERROR_ZETA for a larger zeta or one that rounds to 0; the lobe is then unchanged. */
static inline burnish_q15_status burnish_lobe_q15_align(burnish_lobe_q15 *lobe) {
    uint32_t slope = lobe->slope;
    if (lobe->shift > 8) {
        slope = (slope + ((uint32_t)1 << (lobe->shift - 9))) >> (lobe->shift - 8);
    } else {
        slope <<= 8 - lobe->shift;
    }
    if (slope == 0 || slope > 0xFFFFu) {
        return BURNISH_Q15_ERROR_ZETA;
    }
    lobe->slope = (uint16_t)slope;
    lobe->shift = 8;
    lobe->reach = burnish_q15_reach(lobe->slope, 8);
    return BURNISH_Q15_OK;
}

/* ---- Lobes at a cosine -------------------------------------------------------------------------
 *
 *   lobe    not NULL
 *   cosine  UQ1.15; if 1 - cosine is above lobe->reach, the result is 0 at once
 * Forms and errors: see the top of this file. */

/* Whether the lobe is above 0. For a cosine above 1, 1 - cosine wraps and is beyond every reach.
 *   lambda  receives 1 - cosine in UQ1.15 */
BURNISH_Q15_INLINE uint8_t burnish_lobe_q15_is_lit(const burnish_lobe_q15 *lobe, uint16_t cosine,
                                                   uint_fast16_t *lambda) {
    *lambda = (uint_fast16_t)(BURNISH_Q15_ONE - cosine);
    if (*lambda <= lobe->reach) {
        return 1;
    }
    if (cosine <= BURNISH_Q15_ONE) {
        return 0;
    }
    *lambda = 0;
    return 1;
}

/* a at a 1 - cosine within reach: below 1, since reach is at most the lobe's cutoff. */
BURNISH_Q15_INLINE uint_fast16_t burnish_lobe_q15_a(const burnish_lobe_q15 *lobe,
                                                    uint_fast16_t lambda) {
    return (uint_fast16_t)burnish_q15_shift(burnish_q15_product(lobe->slope, lambda), lobe->shift);
}

static inline uint16_t burnish_lobe_q15_fast(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    uint_fast16_t lambda;
    if (!burnish_lobe_q15_is_lit(lobe, cosine, &lambda)) {
        return 0;
    }
    return burnish_q15_fast_at(burnish_lobe_q15_a(lobe, lambda), lobe->squarings);
}

static inline uint16_t burnish_lobe_q15_near(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    uint_fast16_t lambda;
    if (!burnish_lobe_q15_is_lit(lobe, cosine, &lambda)) {
        return 0;
    }
    return burnish_q15_near_at(burnish_lobe_q15_a(lobe, lambda), lobe->squarings);
}

static inline uint8_t burnish_lobe_q15_fast8(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    uint_fast16_t lambda;
    if (!burnish_lobe_q15_is_lit(lobe, cosine, &lambda)) {
        return 0;
    }
    return burnish_q15_fast8_at(burnish_lobe_q15_a(lobe, lambda), lobe->squarings);
}

/* The lobe in UQ0.32: what exact and exact8 round. Error below 2m - 2 units of 2^-32 for an exact
 * slope, 1 limited to 0xFFFFFFFF. */
static inline uint32_t burnish_lobe_q15_wide(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    uint_fast16_t lambda;
    if (!burnish_lobe_q15_is_lit(lobe, cosine, &lambda)) {
        return 0;
    }
    return burnish_q15_wide_of(burnish_q15_product(lobe->slope, lambda) << (16 - lobe->shift),
                               lobe->squarings);
}

static inline uint16_t burnish_lobe_q15_exact(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    return burnish_q15_round(burnish_lobe_q15_wide(lobe, cosine));
}

static inline uint8_t burnish_lobe_q15_exact8(const burnish_lobe_q15 *lobe, uint16_t cosine) {
    return burnish_q15_round8(burnish_lobe_q15_wide(lobe, cosine));
}

/* ---- Lobes at lambda = 1 - cosine --------------------------------------------------------------
 *
 * For exponents whose highlight is only a few steps of a 15-bit cosine wide. The boundary follows
 * from the product; reach is not used.
 *   lobe    not NULL
 *   lambda  1 - cosine in UQ0.24; larger values count as 0xFFFFFF */

/* lambda limited to 24 bits. */
static inline uint32_t burnish_q15_limit_lambda(uint32_t lambda) {
    return lambda > BURNISH_Q15_LAMBDA_MAX ? (uint32_t)BURNISH_Q15_LAMBDA_MAX : lambda;
}

/* a at a 1 - cosine, 0x10000 or more if the lobe is 0. */
static inline uint32_t burnish_lobe_q15_a_lambda(const burnish_lobe_q15 *lobe, uint32_t lambda) {
    return burnish_q15_shift(
        burnish_q15_product_lambda(lobe->slope, burnish_q15_limit_lambda(lambda)), lobe->shift);
}

static inline uint16_t burnish_lobe_q15_fast_lambda(const burnish_lobe_q15 *lobe, uint32_t lambda) {
    const uint32_t a = burnish_lobe_q15_a_lambda(lobe, lambda);
    return a > 0xFFFFu ? (uint16_t)0 : burnish_q15_fast_at((uint_fast16_t)a, lobe->squarings);
}

static inline uint16_t burnish_lobe_q15_near_lambda(const burnish_lobe_q15 *lobe, uint32_t lambda) {
    const uint32_t a = burnish_lobe_q15_a_lambda(lobe, lambda);
    return a > 0xFFFFu ? (uint16_t)0 : burnish_q15_near_at((uint_fast16_t)a, lobe->squarings);
}

static inline uint8_t burnish_lobe_q15_fast8_lambda(const burnish_lobe_q15 *lobe, uint32_t lambda) {
    const uint32_t a = burnish_lobe_q15_a_lambda(lobe, lambda);
    return a > 0xFFFFu ? (uint8_t)0 : burnish_q15_fast8_at((uint_fast16_t)a, lobe->squarings);
}

/* The lobe in UQ0.32; error as burnish_lobe_q15_wide, and 1 to m more if shift > 7. */
static inline uint32_t burnish_lobe_q15_wide_lambda(const burnish_lobe_q15 *lobe, uint32_t lambda) {
    if (burnish_lobe_q15_a_lambda(lobe, lambda) > 0xFFFFu) {
        return 0;
    }
    return burnish_q15_wide_of(
        burnish_q15_fraction(lobe->slope, lobe->shift, burnish_q15_limit_lambda(lambda)),
        lobe->squarings);
}

static inline uint16_t burnish_lobe_q15_exact_lambda(const burnish_lobe_q15 *lobe,
                                                     uint32_t lambda) {
    return burnish_q15_round(burnish_lobe_q15_wide_lambda(lobe, lambda));
}

static inline uint8_t burnish_lobe_q15_exact8_lambda(const burnish_lobe_q15 *lobe,
                                                     uint32_t lambda) {
    return burnish_q15_round8(burnish_lobe_q15_wide_lambda(lobe, lambda));
}

/* ---- Composites: cos^n to a fraction of an 8-bit step ------------------------------------------
 *
 * A line is squared, then three times multiplied by itself plus a constant: five multiplications
 * for exponents from 15 on. Below 15 cos^n is a plain product of cosines, by at most five.
 *
 *     v = top - (slope u >> 8)                         0 if that is negative
 *     v = (v v) >> 16,  v = (v (v + offset[i])) >> 16  i = 0, 1
 *     result = (v (v + offset[2])) >> 14               1 is limited to 0xFFFF
 *
 * The result at the peak is 0xFFFF; beyond the cutoff it is 0. */

/* A composite; make it with burnish_composite_q15_create. If all members are 0, it is dark. */
typedef struct burnish_composite_q15 {
    uint16_t slope;     /* UQ8.8: 2 zeta top */
    uint16_t top;       /* UQ0.16: v at the peak */
    uint16_t offset[3]; /* UQ0.16: top, and every v + offset, is below 1 */
    uint16_t reach;     /* UQ1.15: the largest 1 - cosine at which v is defined */
    uint16_t power;     /* 1 .. 14: cos^power instead, and the others are 0 */
} burnish_composite_q15;

/* floor(a b / 2^16). */
BURNISH_Q15_INLINE uint16_t burnish_q15_multiply_high(uint16_t a, uint16_t b) {
#ifdef BURNISH_Q15_AVR
    uint16_t high;
    uint8_t low, zero;
    __asm__("mul %A3, %A4\n\t"
            "mov %1, r1\n\t"
            "mul %B3, %B4\n\t"
            "movw %A0, r0\n\t"
            "clr %2\n\t"
            "mul %A3, %B4\n\t"
            "add %1, r0\n\t"
            "adc %A0, r1\n\t"
            "adc %B0, %2\n\t"
            "mul %B3, %A4\n\t"
            "add %1, r0\n\t"
            "adc %A0, r1\n\t"
            "adc %B0, %2\n\t"
            "clr r1"
            : "=&r"(high), "=&r"(low), "=&r"(zero)
            : "r"(a), "r"(b));
    return high;
#else
    return (uint16_t)((uint32_t)a * b >> 16);
#endif
}

/* cos^n by floor(log2 n) squarings and a product for every further bit of n that is set, each
 * truncated to UQ1.15: at most 2n steps of 2^-16 below cos^n, and 0xFFFF at 1. Shifts by 16 are
 * free on AVR, by 15 they are a loop.
 *   exponent  n: 1 .. 15
 *   cosine    UQ1.15 */
static inline uint16_t burnish_cosine_power_q15(uint16_t exponent, uint16_t cosine) {
    const uint16_t c = cosine > BURNISH_Q15_ONE ? (uint16_t)BURNISH_Q15_ONE : cosine;
    uint16_t x = c;
    uint8_t bit = 4; /* the one below the highest of the exponent */
    while (2 * bit > exponent) {
        bit = (uint8_t)(bit >> 1);
    }
    for (; bit != 0; bit = (uint8_t)(bit >> 1)) {
        x = (uint16_t)(burnish_q15_multiply(x, x) << 1 >> 16);
        if (exponent & bit) {
            x = (uint16_t)(burnish_q15_multiply(x, c) << 1 >> 16);
        }
    }
    return (uint16_t)((uint16_t)(x << 1) - (x >> 15));
}

/* The composite of a v, 0 .. top. */
BURNISH_Q15_INLINE uint16_t burnish_composite_q15_of(const burnish_composite_q15 *lobe,
                                                     uint16_t v) {
    uint32_t last;
    v = burnish_q15_square(v);
    v = burnish_q15_multiply_high(v, (uint16_t)(v + lobe->offset[0]));
    v = burnish_q15_multiply_high(v, (uint16_t)(v + lobe->offset[1]));
    last = burnish_q15_multiply(v, (uint16_t)(v + lobe->offset[2]));
    return last & 0x40000000ul ? (uint16_t)0xFFFFu : (uint16_t)(last << 2 >> 16);
}

static inline void burnish_composite_q15_darken(burnish_composite_q15 *lobe) {
    lobe->slope = lobe->top = lobe->reach = lobe->power = 0;
    lobe->offset[0] = lobe->offset[1] = lobe->offset[2] = 0;
}

/* Between two words of a table.  part  UQ0.16 */
static inline uint16_t burnish_q15_between(uint16_t from, uint16_t to, uint16_t part) {
    return (uint16_t)((from * ((uint32_t)0x10000ul - part) + (uint32_t)to * part + 0x8000u) >> 16);
}

/* Makes the composite that approximates cos^exponent. Three divisions.
 *   lobe      becomes the lobe, on error the dark one; not NULL
 *   exponent  n: 1 .. 1023
 * Errors: ERROR_EXPONENT.
 *
 * The constants are those of n = 15, and between n = 16, 32 .. 1024 linear in 1/n; offset[2] brings
 * the peak to 1. The table was found by a search for the least largest error over all n. */
static inline burnish_q15_status burnish_composite_q15_create(burnish_composite_q15 *lobe,
                                                              uint16_t exponent) {
    static const uint16_t table[8][4] = {
        /* slope / n in UQ6.10, top, offset[0], offset[1] */
        {31061, 58341, 6542, 3},      {30128, 60072, 13, 61},       {34357, 54950, 12439, 10993},
        {37654, 53077, 9948, 26724},  {40129, 50064, 17279, 33036}, {40942, 48651, 22485, 33052},
        {41496, 47747, 25746, 33292}, {41796, 47279, 27505, 33290}};
    const uint16_t(*row)[4] = table;
    uint16_t knot = 16, part = 0, word[4], v;
    uint8_t i;
    burnish_composite_q15_darken(lobe);
    if (exponent == 0 || exponent > BURNISH_Q15_EXPONENT_MAX) {
        return BURNISH_Q15_ERROR_EXPONENT;
    }
    if (exponent < 15) {
        lobe->power = exponent;
        return BURNISH_Q15_OK;
    }
    if (exponent > 15) {
        for (++row; exponent >> 1 >= knot; ++row) {
            knot = (uint16_t)(knot << 1);
        }
        part = (uint16_t)(((uint32_t)(exponent - knot) << 17) / exponent);
    }
    for (i = 0; i < 4; ++i) {
        word[i] = burnish_q15_between(row[0][i], row[1][i], part);
    }
    lobe->slope = (uint16_t)(((uint32_t)word[0] * exponent + 512u) >> 10);
    lobe->top = word[1];
    lobe->offset[0] = word[2];
    lobe->offset[1] = word[3];
    v = burnish_q15_square(lobe->top);
    v = burnish_q15_multiply_high(v, (uint16_t)(v + word[2]));
    v = burnish_q15_multiply_high(v, (uint16_t)(v + word[3]));
    lobe->offset[2] = (uint16_t)((0x3FFFBFFFul + v) / v - v);
    lobe->reach = (uint16_t)(((((uint32_t)lobe->top + 1) << 8) - 1) / lobe->slope);
    return BURNISH_Q15_OK;
}

/* The composite at a cosine.  lobe  not NULL;  cosine  UQ1.15 */
static inline uint16_t burnish_composite_q15_at_cosine(const burnish_composite_q15 *lobe,
                                                       uint16_t cosine) {
    const uint16_t lambda = burnish_q15_lambda(cosine);
    if (lobe->power) {
        return burnish_cosine_power_q15(lobe->power, cosine);
    }
    if (lambda > lobe->reach) {
        return 0;
    }
    return burnish_composite_q15_of(
        lobe, (uint16_t)(lobe->top - (burnish_q15_product(lobe->slope, lambda) >> 8)));
}

/* The same at 1 - cosine.  lambda  UQ0.24; larger values count as 0xFFFFFF */
static inline uint16_t burnish_composite_q15_at_lambda(const burnish_composite_q15 *lobe,
                                                       uint32_t lambda) {
    uint32_t a;
    lambda = burnish_q15_limit_lambda(lambda);
    if (lobe->power) {
        return burnish_cosine_power_q15(lobe->power, (uint16_t)((0x1000100ul - lambda) >> 9));
    }
    a = burnish_q15_product_lambda(lobe->slope, lambda) >> 8;
    return a > lobe->top ? (uint16_t)0 : burnish_composite_q15_of(lobe, (uint16_t)(lobe->top - a));
}

#ifdef __cplusplus
}
#endif

#endif
