/* Operations of the contenders beyond src/simd/vector.h, per instruction set:
 *
 *   bench_fma       a b + c, fused if the instruction set has FMA
 *   bench_sqrt      IEEE square root
 *   bench_round     floats to the nearest integers
 *   bench_gather    table[index] per lane
 *   bench_mantissa  the bits of x's significand in [1, 2)
 *
 * and the names of powf in other libraries, NULL if a library lacks it. */
#ifndef BURNISH_BENCH_KERNELS_ISA_OPS_H
#define BURNISH_BENCH_KERNELS_ISA_OPS_H

#include "simd/vector.h"

#if defined(BURNISH_VECTOR_AVX512)

#define BENCH_LIBMVEC "_ZGVeN16vv_powf"
#define BENCH_SLEEF "Sleef_powf16_u10avx512f"
BURNISH_INLINE vf bench_fma(vf a, vf b, vf c) {
    return _mm512_fmadd_ps(a, b, c);
}
BURNISH_INLINE vf bench_sqrt(vf x) {
    return _mm512_sqrt_ps(x);
}
BURNISH_INLINE vi bench_round(vf x) {
    return _mm512_cvtps_epi32(x);
}
BURNISH_INLINE vf bench_gather(const float *table, vi index) {
    return _mm512_i32gather_ps(index, table, 4);
}

#elif defined(BURNISH_VECTOR_AVX2)

#define BENCH_LIBMVEC "_ZGVdN8vv_powf"
#define BENCH_SLEEF "Sleef_powf8_u10avx2"
BURNISH_INLINE vf bench_fma(vf a, vf b, vf c) {
    return _mm256_fmadd_ps(a, b, c);
}
BURNISH_INLINE vf bench_sqrt(vf x) {
    return _mm256_sqrt_ps(x);
}
BURNISH_INLINE vi bench_round(vf x) {
    return _mm256_cvtps_epi32(x);
}
BURNISH_INLINE vf bench_gather(const float *table, vi index) {
    return _mm256_i32gather_ps(table, index, 4);
}

#elif defined(BURNISH_VECTOR_SSE2)

#define BENCH_LIBMVEC "_ZGVbN4vv_powf"
#define BENCH_SLEEF "Sleef_powf4_u10sse2"
BURNISH_INLINE vf bench_fma(vf a, vf b, vf c) {
    return vf_add(vf_mul(a, b), c);
}
BURNISH_INLINE vf bench_sqrt(vf x) {
    return _mm_sqrt_ps(x);
}
BURNISH_INLINE vi bench_round(vf x) {
    return _mm_cvtps_epi32(x);
}
BURNISH_INLINE vf bench_gather(const float *table, vi index) {
    const uint32_t a = (uint32_t)_mm_cvtsi128_si32(index);
    const uint32_t b = (uint32_t)_mm_cvtsi128_si32(_mm_shuffle_epi32(index, 0x55));
    const uint32_t c = (uint32_t)_mm_cvtsi128_si32(_mm_unpackhi_epi32(index, index));
    const uint32_t d = (uint32_t)_mm_cvtsi128_si32(_mm_shuffle_epi32(index, 0xff));
    __m128 low = _mm_unpacklo_ps(_mm_load_ss(table + a), _mm_load_ss(table + b));
    __m128 high = _mm_unpacklo_ps(_mm_load_ss(table + c), _mm_load_ss(table + d));
    return _mm_movelh_ps(low, high);
}

#elif defined(BURNISH_VECTOR_NEON)

#define BENCH_LIBMVEC "_ZGVnN4vv_powf"
#define BENCH_SLEEF "Sleef_powf4_u10advsimd"
BURNISH_INLINE vf bench_fma(vf a, vf b, vf c) {
    return vfmaq_f32(c, a, b);
}
BURNISH_INLINE vf bench_sqrt(vf x) {
    return vsqrtq_f32(x);
}
BURNISH_INLINE vi bench_round(vf x) {
    return vcvtnq_s32_f32(x);
}
BURNISH_INLINE vf bench_gather(const float *table, vi index) {
    vf value = vld1q_dup_f32(table + vgetq_lane_s32(index, 0));
    value = vld1q_lane_f32(table + vgetq_lane_s32(index, 1), value, 1);
    value = vld1q_lane_f32(table + vgetq_lane_s32(index, 2), value, 2);
    return vld1q_lane_f32(table + vgetq_lane_s32(index, 3), value, 3);
}

#else

#define BENCH_LIBMVEC NULL
#define BENCH_SLEEF "Sleef_powf_u10"
BURNISH_INLINE vf bench_fma(vf a, vf b, vf c) {
    return a * b + c;
}
BURNISH_INLINE vf bench_sqrt(vf x) {
    return __builtin_sqrtf(x);
}
BURNISH_INLINE vi bench_round(vf x) {
    return (vi)(x + 0.5f);
}
BURNISH_INLINE vf bench_gather(const float *table, vi index) {
    return table[index];
}

#endif

BURNISH_INLINE vf bench_mantissa(vf x) {
    return vf_from_bits(vi_or(vi_and(vf_bits(x), vi_set(0x007fffff)), vi_set(0x3f800000)));
}

#endif
