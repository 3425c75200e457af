/* burnish/vector_q15.h: the processor's 16-bit lanes, for arrays_q15.h.
 *
 * What it is. One vector type and the operations that the integer lobes and pixels need, in the
 * instructions of SSE2, AVX2, AVX-512BW, Neon, WebAssembly SIMD or Arm's DSP extension. The
 * compiler's macros select one of them. arrays_q15.h shows how to use and compile it; nothing here
 * is stable between versions.
 *
 *     BURNISH_Q15_LANES   16-bit lanes of a vector: 32, 16, 8, 2; 1 without SIMD
 *     burnish_q15v        a vector; the operation decides whether its lanes are signed
 *     burnish_q15w        32-bit results for each lane, in the order that suits the processor
 *     burnish_q15v_axis   three numbers that are the same for all lanes
 *
 *     load, store         any address that is a multiple of 2
 *     set                 the same number in every lane
 *     add, sub            modulo 2^16; adds, subs saturate, unsigned unless their name has signed
 *     mean                (a + b + 1) >> 1, unsigned
 *     low, high           lower and upper half of the product
 *     left, right         by 0 .. 16 bits, unsigned
 *     where_zero          b in lanes where a is 0, else 0; where_not_zero the reverse
 *     store_bytes         lanes of at most 255 as bytes
 *     store_pairs         a lane of a, the same lane of b, and so on: 4 bytes per lane
 *     dot, square_length  Q30, modulo 2^32, as burnish_q15_dot
 *     cosine              burnish_q15_cosine of a dot product
 *     shortfall           floor((1 + 2^-17 - dot) 2^16), limited to a signed lane
 *     chord               lambda of burnish_q15_chord: top, its upper 16 bits; low, with
 *                         lambda's lower 8 bits in its upper half and an arbitrary lower half. A
 *                         lambda of BURNISH_Q15V_FAR or more gives any such lambda
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_VECTOR_Q15_H
#define BURNISH_VECTOR_Q15_H

#include "lobe_q15.h"

#if defined(BURNISH_Q15_PLAIN_C)
#define BURNISH_Q15_LANES 1
#elif defined(__AVX512BW__)
#define BURNISH_Q15_LANES 32
#define BURNISH_Q15_X86 1
#elif defined(__AVX2__)
#define BURNISH_Q15_LANES 16
#define BURNISH_Q15_X86 1
#elif defined(__SSE2__) || defined(_M_X64) || (defined(_M_IX86_FP) && _M_IX86_FP >= 2)
#define BURNISH_Q15_LANES 8
#define BURNISH_Q15_X86 1
#elif defined(__ARM_NEON) && !defined(__ARM_BIG_ENDIAN)
#define BURNISH_Q15_LANES 8
#define BURNISH_Q15_NEON 1
#elif defined(__wasm_simd128__)
#define BURNISH_Q15_LANES 8
#define BURNISH_Q15_WASM 1
#elif defined(__ARM_FEATURE_SIMD32) && !defined(__ARM_BIG_ENDIAN)
#define BURNISH_Q15_LANES 2
#define BURNISH_Q15_DSP 1
#else
#define BURNISH_Q15_LANES 1
#endif

#if defined(BURNISH_Q15_X86)
#if BURNISH_Q15_LANES == 8
#include <emmintrin.h>
#else
#include <immintrin.h>
#endif
#elif defined(BURNISH_Q15_NEON)
#include <arm_neon.h>
#elif defined(BURNISH_Q15_WASM)
#include <wasm_simd128.h>
#elif defined(BURNISH_Q15_DSP)
#include <arm_acle.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The lambda from which on chords are not exact: their differences and their sum saturate. */
#define BURNISH_Q15V_FAR 0x7FFE00ul

/* Operations of two vectors in one line each. */
#define BURNISH_Q15V_PAIR(name, expression)                                                        \
    BURNISH_Q15_INLINE burnish_q15v burnish_q15v_##name(burnish_q15v a, burnish_q15v b) {          \
        return expression;                                                                         \
    }

#if defined(BURNISH_Q15_X86)

#if BURNISH_Q15_LANES == 32
typedef __m512i burnish_q15v;
#define BURNISH_Q15V_OP(name) _mm512_##name
#define BURNISH_Q15V_BITS(name) _mm512_##name##_si512
#elif BURNISH_Q15_LANES == 16
typedef __m256i burnish_q15v;
#define BURNISH_Q15V_OP(name) _mm256_##name
#define BURNISH_Q15V_BITS(name) _mm256_##name##_si256
#else
typedef __m128i burnish_q15v;
#define BURNISH_Q15V_OP(name) _mm_##name
#define BURNISH_Q15V_BITS(name) _mm_##name##_si128
#endif

/* of the lower and upper half of each 128 bits, as in unpack and pack */
typedef struct burnish_q15w {
    burnish_q15v low, high;
} burnish_q15w;

/* pairs for madd: x and y, z and 0 */
typedef struct burnish_q15v_axis {
    burnish_q15v xy, z;
} burnish_q15v_axis;

BURNISH_Q15_INLINE burnish_q15v burnish_q15v_load(const void *from) {
    return BURNISH_Q15V_BITS(loadu)((const burnish_q15v *)from);
}
BURNISH_Q15_INLINE void burnish_q15v_store(void *to, burnish_q15v a) {
    BURNISH_Q15V_BITS(storeu)((burnish_q15v *)to, a);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_set(uint16_t x) {
    return BURNISH_Q15V_OP(set1_epi16)((int16_t)x);
}
BURNISH_Q15V_PAIR(add, BURNISH_Q15V_OP(add_epi16)(a, b))
BURNISH_Q15V_PAIR(sub, BURNISH_Q15V_OP(sub_epi16)(a, b))
BURNISH_Q15V_PAIR(adds, BURNISH_Q15V_OP(adds_epu16)(a, b))
BURNISH_Q15V_PAIR(subs, BURNISH_Q15V_OP(subs_epu16)(a, b))
BURNISH_Q15V_PAIR(adds_signed, BURNISH_Q15V_OP(adds_epi16)(a, b))
BURNISH_Q15V_PAIR(subs_signed, BURNISH_Q15V_OP(subs_epi16)(a, b))
BURNISH_Q15V_PAIR(max_signed, BURNISH_Q15V_OP(max_epi16)(a, b))
BURNISH_Q15V_PAIR(and, BURNISH_Q15V_BITS (and)(a, b))
BURNISH_Q15V_PAIR(or, BURNISH_Q15V_BITS(or)(a, b))
BURNISH_Q15V_PAIR(xor, BURNISH_Q15V_BITS (xor)(a, b))
BURNISH_Q15V_PAIR(mean, BURNISH_Q15V_OP(avg_epu16)(a, b))
BURNISH_Q15V_PAIR(low, BURNISH_Q15V_OP(mullo_epi16)(a, b))
BURNISH_Q15V_PAIR(high, BURNISH_Q15V_OP(mulhi_epu16)(a, b))
BURNISH_Q15V_PAIR(high_signed, BURNISH_Q15V_OP(mulhi_epi16)(a, b))
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_left(burnish_q15v a, int bits) {
    return BURNISH_Q15V_OP(sll_epi16)(a, _mm_cvtsi32_si128(bits));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_right(burnish_q15v a, int bits) {
    return BURNISH_Q15V_OP(srl_epi16)(a, _mm_cvtsi32_si128(bits));
}
#if BURNISH_Q15_LANES == 32
BURNISH_Q15V_PAIR(where_zero, _mm512_maskz_mov_epi16(_mm512_testn_epi16_mask(a, a), b))
BURNISH_Q15V_PAIR(where_not_zero, _mm512_maskz_mov_epi16(_mm512_test_epi16_mask(a, a), b))
#else
BURNISH_Q15V_PAIR(is_zero, BURNISH_Q15V_OP(cmpeq_epi16)(BURNISH_Q15V_BITS (and)(a, b),
                                                        BURNISH_Q15V_BITS(setzero)()))
BURNISH_Q15V_PAIR(where_zero, BURNISH_Q15V_BITS (and)(burnish_q15v_is_zero(a, a), b))
BURNISH_Q15V_PAIR(where_not_zero, BURNISH_Q15V_BITS(andnot)(burnish_q15v_is_zero(a, a), b))
#endif
BURNISH_Q15_INLINE void burnish_q15v_store_bytes(uint8_t *to, burnish_q15v a) {
#if BURNISH_Q15_LANES == 32
    _mm256_storeu_si256((__m256i *)(void *)to, _mm512_cvtepi16_epi8(a));
#elif BURNISH_Q15_LANES == 16
    const __m256i bytes = _mm256_permute4x64_epi64(_mm256_packus_epi16(a, a), 8);
    _mm_storeu_si128((__m128i *)(void *)to, _mm256_castsi256_si128(bytes));
#else
    _mm_storel_epi64((__m128i *)(void *)to, _mm_packus_epi16(a, a));
#endif
}
BURNISH_Q15_INLINE void burnish_q15v_store_pairs(uint8_t *to, burnish_q15v a, burnish_q15v b) {
    const burnish_q15v low = BURNISH_Q15V_OP(unpacklo_epi16)(a, b);
    const burnish_q15v high = BURNISH_Q15V_OP(unpackhi_epi16)(a, b);
#if BURNISH_Q15_LANES == 32
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const __m512i second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    burnish_q15v_store(to, _mm512_permutex2var_epi64(low, first, high));
    burnish_q15v_store(to + 64, _mm512_permutex2var_epi64(low, second, high));
#elif BURNISH_Q15_LANES == 16
    burnish_q15v_store(to, _mm256_permute2x128_si256(low, high, 0x20));
    burnish_q15v_store(to + 32, _mm256_permute2x128_si256(low, high, 0x31));
#else
    burnish_q15v_store(to, low);
    burnish_q15v_store(to + 16, high);
#endif
}
BURNISH_Q15_INLINE burnish_q15v_axis burnish_q15v_axis_of(const int16_t v[3]) {
    burnish_q15v_axis axis;
    axis.xy =
        BURNISH_Q15V_OP(set1_epi32)((int32_t)((uint16_t)v[0] | (uint32_t)(uint16_t)v[1] << 16));
    axis.z = BURNISH_Q15V_OP(set1_epi32)((int32_t)(uint16_t)v[2]);
    return axis;
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_madd(burnish_q15v xy, burnish_q15v z,
                                                  burnish_q15v other_xy, burnish_q15v other_z) {
    return BURNISH_Q15V_OP(add_epi32)(BURNISH_Q15V_OP(madd_epi16)(xy, other_xy),
                                      BURNISH_Q15V_OP(madd_epi16)(z, other_z));
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_pairs_low(const burnish_q15v a[3]) {
    burnish_q15w pairs;
    pairs.low = BURNISH_Q15V_OP(unpacklo_epi16)(a[0], a[1]);
    pairs.high = BURNISH_Q15V_OP(unpacklo_epi16)(a[2], BURNISH_Q15V_BITS(setzero)());
    return pairs;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_pairs_high(const burnish_q15v a[3]) {
    burnish_q15w pairs;
    pairs.low = BURNISH_Q15V_OP(unpackhi_epi16)(a[0], a[1]);
    pairs.high = BURNISH_Q15V_OP(unpackhi_epi16)(a[2], BURNISH_Q15V_BITS(setzero)());
    return pairs;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_dot(const burnish_q15v a[3],
                                                 const burnish_q15v_axis *b) {
    const burnish_q15w low = burnish_q15v_pairs_low(a), high = burnish_q15v_pairs_high(a);
    burnish_q15w sum;
    sum.low = burnish_q15v_madd(low.low, low.high, b->xy, b->z);
    sum.high = burnish_q15v_madd(high.low, high.high, b->xy, b->z);
    return sum;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_products(const burnish_q15v a[3],
                                                      const burnish_q15v b[3]) {
    const burnish_q15w low = burnish_q15v_pairs_low(a), high = burnish_q15v_pairs_high(a);
    const burnish_q15w other_low = burnish_q15v_pairs_low(b),
                       other_high = burnish_q15v_pairs_high(b);
    burnish_q15w sum;
    sum.low = burnish_q15v_madd(low.low, low.high, other_low.low, other_low.high);
    sum.high = burnish_q15v_madd(high.low, high.high, other_high.low, other_high.high);
    return sum;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_square_length(const burnish_q15v a[3]) {
    return burnish_q15v_products(a, a);
}
/* cosine - 1, halved before adding, which could overflow; pack limits it to 16 bits */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_below_one(burnish_q15v dot) {
    const burnish_q15v offset = BURNISH_Q15V_OP(set1_epi32)(0x2000 - 0x20000000);
    return BURNISH_Q15V_OP(srai_epi32)(
        BURNISH_Q15V_OP(add_epi32)(BURNISH_Q15V_OP(srai_epi32)(dot, 1), offset), 14);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_cosine(burnish_q15w dot) {
    const burnish_q15v below = BURNISH_Q15V_OP(packs_epi32)(burnish_q15v_below_one(dot.low),
                                                            burnish_q15v_below_one(dot.high));
    return burnish_q15v_xor(BURNISH_Q15V_OP(min_epi16)(below, BURNISH_Q15V_BITS(setzero)()),
                            burnish_q15v_set(0x8000u));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_shortfall(burnish_q15w dot) {
    const burnish_q15v one = BURNISH_Q15V_OP(set1_epi32)(0x40002000);
    return BURNISH_Q15V_OP(packs_epi32)(
        BURNISH_Q15V_OP(srai_epi32)(BURNISH_Q15V_OP(sub_epi32)(one, dot.low), 14),
        BURNISH_Q15V_OP(srai_epi32)(BURNISH_Q15V_OP(sub_epi32)(one, dot.high), 14));
}
/* With d = h + g, h = floor(d / 2), floor(d^2 / 4) is h g. */
BURNISH_Q15_INLINE void burnish_q15v_chord(const burnish_q15v a[3], const burnish_q15v b[3],
                                           burnish_q15v *top, burnish_q15v *low) {
    const burnish_q15v half = BURNISH_Q15V_OP(set1_epi32)(16);
    burnish_q15v h[3], g[3];
    burnish_q15w sum;
    int i;
    for (i = 0; i < 3; ++i) {
        const burnish_q15v d = burnish_q15v_subs_signed(a[i], b[i]);
        h[i] = BURNISH_Q15V_OP(srai_epi16)(d, 1);
        g[i] = burnish_q15v_sub(d, h[i]);
    }
    sum = burnish_q15v_products(h, g);
    sum.low = BURNISH_Q15V_OP(add_epi32)(sum.low, half);
    sum.high = BURNISH_Q15V_OP(add_epi32)(sum.high, half);
    *top = BURNISH_Q15V_OP(packs_epi32)(BURNISH_Q15V_OP(srai_epi32)(sum.low, 13),
                                        BURNISH_Q15V_OP(srai_epi32)(sum.high, 13));
    *low = BURNISH_Q15V_OP(packs_epi32)(
        BURNISH_Q15V_OP(srai_epi32)(BURNISH_Q15V_OP(slli_epi32)(sum.low, 19), 16),
        BURNISH_Q15V_OP(srai_epi32)(BURNISH_Q15V_OP(slli_epi32)(sum.high, 19), 16));
}

#elif defined(BURNISH_Q15_NEON)

typedef uint16x8_t burnish_q15v;
typedef struct burnish_q15w {
    int32x4_t low, high;
} burnish_q15w;
typedef struct burnish_q15v_axis {
    int16_t v[3];
} burnish_q15v_axis;
#define BURNISH_Q15V_SIGNED(a) vreinterpretq_s16_u16(a)
#define BURNISH_Q15V_UNSIGNED(a) vreinterpretq_u16_s16(a)

BURNISH_Q15_INLINE burnish_q15v burnish_q15v_load(const void *from) {
    return vld1q_u16((const uint16_t *)from);
}
BURNISH_Q15_INLINE void burnish_q15v_store(void *to, burnish_q15v a) {
    vst1q_u16((uint16_t *)to, a);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_set(uint16_t x) {
    return vdupq_n_u16(x);
}
BURNISH_Q15V_PAIR(add, vaddq_u16(a, b))
BURNISH_Q15V_PAIR(sub, vsubq_u16(a, b))
BURNISH_Q15V_PAIR(adds, vqaddq_u16(a, b))
BURNISH_Q15V_PAIR(subs, vqsubq_u16(a, b))
BURNISH_Q15V_PAIR(adds_signed,
                  BURNISH_Q15V_UNSIGNED(vqaddq_s16(BURNISH_Q15V_SIGNED(a), BURNISH_Q15V_SIGNED(b))))
BURNISH_Q15V_PAIR(subs_signed,
                  BURNISH_Q15V_UNSIGNED(vqsubq_s16(BURNISH_Q15V_SIGNED(a), BURNISH_Q15V_SIGNED(b))))
BURNISH_Q15V_PAIR(max_signed,
                  BURNISH_Q15V_UNSIGNED(vmaxq_s16(BURNISH_Q15V_SIGNED(a), BURNISH_Q15V_SIGNED(b))))
BURNISH_Q15V_PAIR(and, vandq_u16(a, b))
BURNISH_Q15V_PAIR(or, vorrq_u16(a, b))
BURNISH_Q15V_PAIR(xor, veorq_u16(a, b))
BURNISH_Q15V_PAIR(mean, vrhaddq_u16(a, b))
BURNISH_Q15V_PAIR(low, vmulq_u16(a, b))
BURNISH_Q15V_PAIR(high,
                  vuzpq_u16(vreinterpretq_u16_u32(vmull_u16(vget_low_u16(a), vget_low_u16(b))),
                            vreinterpretq_u16_u32(vmull_u16(vget_high_u16(a), vget_high_u16(b))))
                      .val[1])
BURNISH_Q15V_PAIR(high_signed,
                  vuzpq_u16(vreinterpretq_u16_s32(vmull_s16(vget_low_s16(BURNISH_Q15V_SIGNED(a)),
                                                            vget_low_s16(BURNISH_Q15V_SIGNED(b)))),
                            vreinterpretq_u16_s32(vmull_s16(vget_high_s16(BURNISH_Q15V_SIGNED(a)),
                                                            vget_high_s16(BURNISH_Q15V_SIGNED(b)))))
                      .val[1])
BURNISH_Q15V_PAIR(where_zero, vandq_u16(vceqq_u16(a, vdupq_n_u16(0)), b))
BURNISH_Q15V_PAIR(where_not_zero, vandq_u16(vtstq_u16(a, a), b))
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_left(burnish_q15v a, int bits) {
    return vshlq_u16(a, vdupq_n_s16((int16_t)bits));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_right(burnish_q15v a, int bits) {
    return vshlq_u16(a, vdupq_n_s16((int16_t)-bits));
}
BURNISH_Q15_INLINE void burnish_q15v_store_bytes(uint8_t *to, burnish_q15v a) {
    vst1_u8(to, vmovn_u16(a));
}
BURNISH_Q15_INLINE void burnish_q15v_store_pairs(uint8_t *to, burnish_q15v a, burnish_q15v b) {
    const uint16x8x2_t pairs = vzipq_u16(a, b);
    vst1q_u8(to, vreinterpretq_u8_u16(pairs.val[0]));
    vst1q_u8(to + 16, vreinterpretq_u8_u16(pairs.val[1]));
}
BURNISH_Q15_INLINE burnish_q15v_axis burnish_q15v_axis_of(const int16_t v[3]) {
    burnish_q15v_axis axis;
    axis.v[0] = v[0];
    axis.v[1] = v[1];
    axis.v[2] = v[2];
    return axis;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_dot(const burnish_q15v a[3],
                                                 const burnish_q15v_axis *b) {
    burnish_q15w sum;
    int i;
    sum.low = vmull_n_s16(vget_low_s16(BURNISH_Q15V_SIGNED(a[0])), b->v[0]);
    sum.high = vmull_n_s16(vget_high_s16(BURNISH_Q15V_SIGNED(a[0])), b->v[0]);
    for (i = 1; i < 3; ++i) {
        sum.low = vmlal_n_s16(sum.low, vget_low_s16(BURNISH_Q15V_SIGNED(a[i])), b->v[i]);
        sum.high = vmlal_n_s16(sum.high, vget_high_s16(BURNISH_Q15V_SIGNED(a[i])), b->v[i]);
    }
    return sum;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_square_length(const burnish_q15v a[3]) {
    burnish_q15w sum = {vdupq_n_s32(0), vdupq_n_s32(0)};
    int i;
    for (i = 0; i < 3; ++i) {
        const int16x4_t low = vget_low_s16(BURNISH_Q15V_SIGNED(a[i]));
        const int16x4_t high = vget_high_s16(BURNISH_Q15V_SIGNED(a[i]));
        sum.low = vmlal_s16(sum.low, low, low);
        sum.high = vmlal_s16(sum.high, high, high);
    }
    return sum;
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_cosine(burnish_q15w dot) {
    return vminq_u16(vcombine_u16(vqrshrun_n_s32(dot.low, 15), vqrshrun_n_s32(dot.high, 15)),
                     vdupq_n_u16(0x8000u));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_shortfall(burnish_q15w dot) {
    const int32x4_t one = vdupq_n_s32(0x40002000);
    return BURNISH_Q15V_UNSIGNED(vcombine_s16(vqshrn_n_s32(vsubq_s32(one, dot.low), 14),
                                              vqshrn_n_s32(vsubq_s32(one, dot.high), 14)));
}
BURNISH_Q15_INLINE void burnish_q15v_chord(const burnish_q15v a[3], const burnish_q15v b[3],
                                           burnish_q15v *top, burnish_q15v *low) {
    int32x4_t lower = vdupq_n_s32(16), upper = vdupq_n_s32(16);
    int i;
    for (i = 0; i < 3; ++i) {
        const int16x8_t d = vqsubq_s16(BURNISH_Q15V_SIGNED(a[i]), BURNISH_Q15V_SIGNED(b[i]));
        lower = vsraq_n_s32(lower, vmull_s16(vget_low_s16(d), vget_low_s16(d)), 2);
        upper = vsraq_n_s32(upper, vmull_s16(vget_high_s16(d), vget_high_s16(d)), 2);
    }
    *top = BURNISH_Q15V_UNSIGNED(vcombine_s16(vqshrn_n_s32(lower, 13), vqshrn_n_s32(upper, 13)));
    *low = vshlq_n_u16(BURNISH_Q15V_UNSIGNED(vcombine_s16(vmovn_s32(lower), vmovn_s32(upper))), 3);
}

#elif defined(BURNISH_Q15_WASM)

typedef v128_t burnish_q15v;
typedef struct burnish_q15w {
    v128_t low, high;
} burnish_q15w;
typedef struct burnish_q15v_axis {
    v128_t xy, z;
} burnish_q15v_axis;
#define BURNISH_Q15V_INTERLEAVE_LOW(a, b) wasm_i16x8_shuffle(a, b, 0, 8, 1, 9, 2, 10, 3, 11)
#define BURNISH_Q15V_INTERLEAVE_HIGH(a, b) wasm_i16x8_shuffle(a, b, 4, 12, 5, 13, 6, 14, 7, 15)
#define BURNISH_Q15V_EVEN(a, b) wasm_i16x8_shuffle(a, b, 0, 2, 4, 6, 8, 10, 12, 14)
#define BURNISH_Q15V_ODD(a, b) wasm_i16x8_shuffle(a, b, 1, 3, 5, 7, 9, 11, 13, 15)

BURNISH_Q15_INLINE burnish_q15v burnish_q15v_load(const void *from) {
    return wasm_v128_load(from);
}
BURNISH_Q15_INLINE void burnish_q15v_store(void *to, burnish_q15v a) {
    wasm_v128_store(to, a);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_set(uint16_t x) {
    return wasm_i16x8_splat((int16_t)x);
}
BURNISH_Q15V_PAIR(add, wasm_i16x8_add(a, b))
BURNISH_Q15V_PAIR(sub, wasm_i16x8_sub(a, b))
BURNISH_Q15V_PAIR(adds, wasm_u16x8_add_sat(a, b))
BURNISH_Q15V_PAIR(subs, wasm_u16x8_sub_sat(a, b))
BURNISH_Q15V_PAIR(adds_signed, wasm_i16x8_add_sat(a, b))
BURNISH_Q15V_PAIR(subs_signed, wasm_i16x8_sub_sat(a, b))
BURNISH_Q15V_PAIR(max_signed, wasm_i16x8_max(a, b))
BURNISH_Q15V_PAIR(and, wasm_v128_and(a, b))
BURNISH_Q15V_PAIR(or, wasm_v128_or(a, b))
BURNISH_Q15V_PAIR(xor, wasm_v128_xor(a, b))
BURNISH_Q15V_PAIR(mean, wasm_u16x8_avgr(a, b))
BURNISH_Q15V_PAIR(low, wasm_i16x8_mul(a, b))
BURNISH_Q15V_PAIR(high, BURNISH_Q15V_ODD(wasm_u32x4_extmul_low_u16x8(a, b),
                                         wasm_u32x4_extmul_high_u16x8(a, b)))
BURNISH_Q15V_PAIR(high_signed, BURNISH_Q15V_ODD(wasm_i32x4_extmul_low_i16x8(a, b),
                                                wasm_i32x4_extmul_high_i16x8(a, b)))
BURNISH_Q15V_PAIR(where_zero, wasm_v128_and(wasm_i16x8_eq(a, wasm_i16x8_const_splat(0)), b))
BURNISH_Q15V_PAIR(where_not_zero, wasm_v128_and(wasm_i16x8_ne(a, wasm_i16x8_const_splat(0)), b))
/* By products, unless the number of bits is a constant: clang 14 makes eight scalar shifts of a
 * variable one, which are modulo 16 besides. */
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_left(burnish_q15v a, int bits) {
    if (__builtin_constant_p(bits) && bits < 16) {
        return wasm_i16x8_shl(a, (uint32_t)bits);
    }
    return burnish_q15v_low(a, burnish_q15v_set((uint16_t)(1u << bits)));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_right(burnish_q15v a, int bits) {
    if (__builtin_constant_p(bits) && bits < 16) {
        return wasm_u16x8_shr(a, (uint32_t)bits);
    }
    return bits == 0 ? a : burnish_q15v_high(a, burnish_q15v_set((uint16_t)(0x10000u >> bits)));
}
BURNISH_Q15_INLINE void burnish_q15v_store_bytes(uint8_t *to, burnish_q15v a) {
    wasm_v128_store64_lane(to, wasm_u8x16_narrow_i16x8(a, a), 0);
}
BURNISH_Q15_INLINE void burnish_q15v_store_pairs(uint8_t *to, burnish_q15v a, burnish_q15v b) {
    wasm_v128_store(to, BURNISH_Q15V_INTERLEAVE_LOW(a, b));
    wasm_v128_store(to + 16, BURNISH_Q15V_INTERLEAVE_HIGH(a, b));
}
BURNISH_Q15_INLINE burnish_q15v_axis burnish_q15v_axis_of(const int16_t v[3]) {
    burnish_q15v_axis axis;
    axis.xy = wasm_i32x4_splat((int32_t)((uint16_t)v[0] | (uint32_t)(uint16_t)v[1] << 16));
    axis.z = wasm_i32x4_splat((int32_t)(uint16_t)v[2]);
    return axis;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_dot(const burnish_q15v a[3],
                                                 const burnish_q15v_axis *b) {
    const v128_t zero = wasm_i16x8_const_splat(0);
    burnish_q15w sum;
    sum.low = wasm_i32x4_add(wasm_i32x4_dot_i16x8(BURNISH_Q15V_INTERLEAVE_LOW(a[0], a[1]), b->xy),
                             wasm_i32x4_dot_i16x8(BURNISH_Q15V_INTERLEAVE_LOW(a[2], zero), b->z));
    sum.high = wasm_i32x4_add(wasm_i32x4_dot_i16x8(BURNISH_Q15V_INTERLEAVE_HIGH(a[0], a[1]), b->xy),
                              wasm_i32x4_dot_i16x8(BURNISH_Q15V_INTERLEAVE_HIGH(a[2], zero), b->z));
    return sum;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_square_length(const burnish_q15v a[3]) {
    burnish_q15w sum = {wasm_i32x4_const_splat(0), wasm_i32x4_const_splat(0)};
    int i;
    for (i = 0; i < 3; ++i) {
        sum.low = wasm_i32x4_add(sum.low, wasm_i32x4_extmul_low_i16x8(a[i], a[i]));
        sum.high = wasm_i32x4_add(sum.high, wasm_i32x4_extmul_high_i16x8(a[i], a[i]));
    }
    return sum;
}
/* halved before adding, which could overflow */
BURNISH_Q15_INLINE v128_t burnish_q15v_round_dot(v128_t dot) {
    return wasm_i32x4_shr(wasm_i32x4_add(wasm_i32x4_shr(dot, 1), wasm_i32x4_const_splat(0x2000)),
                          14);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_cosine(burnish_q15w dot) {
    return wasm_u16x8_min(
        wasm_u16x8_narrow_i32x4(burnish_q15v_round_dot(dot.low), burnish_q15v_round_dot(dot.high)),
        burnish_q15v_set(0x8000u));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_shortfall(burnish_q15w dot) {
    const v128_t one = wasm_i32x4_const_splat(0x40002000);
    return wasm_i16x8_narrow_i32x4(wasm_i32x4_shr(wasm_i32x4_sub(one, dot.low), 14),
                                   wasm_i32x4_shr(wasm_i32x4_sub(one, dot.high), 14));
}
BURNISH_Q15_INLINE void burnish_q15v_chord(const burnish_q15v a[3], const burnish_q15v b[3],
                                           burnish_q15v *top, burnish_q15v *low) {
    v128_t lower = wasm_i32x4_const_splat(16), upper = wasm_i32x4_const_splat(16);
    int i;
    for (i = 0; i < 3; ++i) {
        const v128_t d = wasm_i16x8_sub_sat(a[i], b[i]);
        lower = wasm_i32x4_add(lower, wasm_u32x4_shr(wasm_i32x4_extmul_low_i16x8(d, d), 2));
        upper = wasm_i32x4_add(upper, wasm_u32x4_shr(wasm_i32x4_extmul_high_i16x8(d, d), 2));
    }
    *top = wasm_i16x8_narrow_i32x4(wasm_i32x4_shr(lower, 13), wasm_i32x4_shr(upper, 13));
    *low = wasm_i16x8_shl(BURNISH_Q15V_EVEN(lower, upper), 3);
}

#elif defined(BURNISH_Q15_DSP)

/* two lanes of a register; 32-bit results belong to the lower and the upper lane */
typedef uint32_t burnish_q15v;
typedef struct burnish_q15w {
    uint32_t low, high;
} burnish_q15w;
typedef struct burnish_q15v_axis {
    uint32_t xy, z;
} burnish_q15v_axis;
typedef uint32_t __attribute__((may_alias, aligned(2))) burnish_q15v_memory;
#define BURNISH_Q15V_LOWER(a, b) (((uint32_t)(a)&0xFFFFu) | (uint32_t)(b) << 16)
#define BURNISH_Q15V_UPPER(a, b) ((uint32_t)(a) >> 16 | ((uint32_t)(b)&0xFFFF0000u))
/* signed products of the lower and of the upper lanes: smulbb, smultt */
#define BURNISH_Q15V_BOTTOM(a, b) ((int32_t)(int16_t)(a) * (int16_t)(b))
#define BURNISH_Q15V_TOP(a, b) (((int32_t)(a) >> 16) * ((int32_t)(b) >> 16))

BURNISH_Q15_INLINE burnish_q15v burnish_q15v_load(const void *from) {
    return *(const burnish_q15v_memory *)from;
}
BURNISH_Q15_INLINE void burnish_q15v_store(void *to, burnish_q15v a) {
    *(burnish_q15v_memory *)to = a;
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_set(uint16_t x) {
    return x * 0x10001u;
}
BURNISH_Q15V_PAIR(add, __uadd16(a, b))
BURNISH_Q15V_PAIR(sub, __usub16(a, b))
BURNISH_Q15V_PAIR(adds, __uqadd16(a, b))
BURNISH_Q15V_PAIR(subs, __uqsub16(a, b))
BURNISH_Q15V_PAIR(adds_signed, (uint32_t)__qadd16((int16x2_t)a, (int16x2_t)b))
BURNISH_Q15V_PAIR(subs_signed, (uint32_t)__qsub16((int16x2_t)a, (int16x2_t)b))
/* of a negative b: a - (b + 2^15) stops at -2^15 */
BURNISH_Q15V_PAIR(max_signed,
                  (uint32_t)__qadd16(__qsub16((int16x2_t)a, (int16x2_t)(b ^ 0x80008000u)),
                                     (int16x2_t)(b ^ 0x80008000u)))
BURNISH_Q15V_PAIR(and, (a) & (b))
BURNISH_Q15V_PAIR(or, a | b)
BURNISH_Q15V_PAIR(xor, a ^ b)
BURNISH_Q15V_PAIR(mean, ~__uhadd16(~a, ~b)) /* uhadd rounds down */
BURNISH_Q15V_PAIR(low, BURNISH_Q15V_LOWER((a) * (b), (a >> 16) * (b >> 16)))
BURNISH_Q15V_PAIR(high, BURNISH_Q15V_UPPER((a & 0xFFFFu) * (b & 0xFFFFu), (a >> 16) * (b >> 16)))
BURNISH_Q15V_PAIR(high_signed,
                  BURNISH_Q15V_UPPER(BURNISH_Q15V_BOTTOM(a, b), BURNISH_Q15V_TOP(a, b)))
/* 1 in lanes that are 0, times 0xFFFF */
BURNISH_Q15V_PAIR(where_zero, __uqsub16(0x10001u, a) * 0xFFFFu & b)
BURNISH_Q15V_PAIR(where_not_zero, ~(__uqsub16(0x10001u, a) * 0xFFFFu) & b)
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_left(burnish_q15v a, int bits) {
    return a << bits & ((0xFFFFu << bits) & 0xFFFFu) * 0x10001u;
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_right(burnish_q15v a, int bits) {
    return a >> bits & (0xFFFFu >> bits) * 0x10001u;
}
BURNISH_Q15_INLINE void burnish_q15v_store_bytes(uint8_t *to, burnish_q15v a) {
    to[0] = (uint8_t)a;
    to[1] = (uint8_t)(a >> 16);
}
BURNISH_Q15_INLINE void burnish_q15v_store_pairs(uint8_t *to, burnish_q15v a, burnish_q15v b) {
    typedef uint32_t __attribute__((may_alias, aligned(1))) words;
    ((words *)to)[0] = BURNISH_Q15V_LOWER(a, b);
    ((words *)to)[1] = BURNISH_Q15V_UPPER(a, b);
}
BURNISH_Q15_INLINE burnish_q15v_axis burnish_q15v_axis_of(const int16_t v[3]) {
    burnish_q15v_axis axis;
    axis.xy = BURNISH_Q15V_LOWER(v[0], v[1]);
    axis.z = (uint16_t)v[2];
    return axis;
}
/* smlad: two products and a sum */
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_dot(const burnish_q15v a[3],
                                                 const burnish_q15v_axis *b) {
    burnish_q15w sum;
    sum.low = (uint32_t)__smlad((int16x2_t)BURNISH_Q15V_LOWER(a[0], a[1]), (int16x2_t)b->xy,
                                BURNISH_Q15V_BOTTOM(a[2], b->z));
    sum.high = (uint32_t)__smlad((int16x2_t)BURNISH_Q15V_UPPER(a[0], a[1]), (int16x2_t)b->xy,
                                 ((int32_t)a[2] >> 16) * (int16_t)b->z);
    return sum;
}
BURNISH_Q15_INLINE burnish_q15w burnish_q15v_square_length(const burnish_q15v a[3]) {
    const int16x2_t low = (int16x2_t)BURNISH_Q15V_LOWER(a[0], a[1]);
    const int16x2_t high = (int16x2_t)BURNISH_Q15V_UPPER(a[0], a[1]);
    burnish_q15w sum;
    sum.low = (uint32_t)__smlad(low, low, BURNISH_Q15V_BOTTOM(a[2], a[2]));
    sum.high = (uint32_t)__smlad(high, high, BURNISH_Q15V_TOP(a[2], a[2]));
    return sum;
}
/* x limited to 16 bits, signed. GCC's macro __ssat warns under -Wsign-conversion. */
BURNISH_Q15_INLINE uint32_t burnish_q15v_limit(int32_t x) {
#ifdef __GNUC__
    return (uint32_t)__builtin_arm_ssat(x, 16);
#else
    return (uint32_t)__ssat(x, 16);
#endif
}
/* floor((dot + 2^14) / 2^15) without overflow */
BURNISH_Q15_INLINE uint32_t burnish_q15v_round_dot(uint32_t dot) {
    return __usat((((int32_t)dot >> 14) + 1) >> 1, 16);
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_cosine(burnish_q15w dot) {
    const uint32_t cosine =
        BURNISH_Q15V_LOWER(burnish_q15v_round_dot(dot.low), burnish_q15v_round_dot(dot.high));
    return __usub16(cosine, __uqsub16(cosine, 0x80008000u));
}
BURNISH_Q15_INLINE burnish_q15v burnish_q15v_shortfall(burnish_q15w dot) {
    return BURNISH_Q15V_LOWER(burnish_q15v_limit((int32_t)(0x40002000u - dot.low) >> 14),
                              burnish_q15v_limit((int32_t)(0x40002000u - dot.high) >> 14));
}
BURNISH_Q15_INLINE void burnish_q15v_chord(const burnish_q15v a[3], const burnish_q15v b[3],
                                           burnish_q15v *top, burnish_q15v *low) {
    uint32_t lower = 16, upper = 16;
    int i;
    for (i = 0; i < 3; ++i) {
        const uint32_t d = burnish_q15v_subs_signed(a[i], b[i]);
        lower += (uint32_t)BURNISH_Q15V_BOTTOM(d, d) >> 2;
        upper += (uint32_t)BURNISH_Q15V_TOP(d, d) >> 2;
    }
    *top = BURNISH_Q15V_LOWER(burnish_q15v_limit((int32_t)(lower >> 13)),
                              burnish_q15v_limit((int32_t)(upper >> 13)));
    *low = BURNISH_Q15V_LOWER(lower << 3, upper << 3);
}

#endif

#ifdef __cplusplus
}
#endif

#endif
