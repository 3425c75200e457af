/* The vector type for SSE2: 4 floats. See vector.h for what the operations mean. */
#ifndef BURNISH_SIMD_VECTOR_SSE2_H
#define BURNISH_SIMD_VECTOR_SSE2_H

#include <emmintrin.h>
#include <stdint.h>
#include <string.h>

#define VECTOR_WORD sse2
enum { LANES = 4, VECTOR_ISA = BURNISH_ISA_SSE2 };
typedef __m128 vf;
typedef __m128i vi;
typedef __m128 vm;

#define MM(operation) _mm_##operation
#define SI(operation) _mm_##operation##_si128
#define SI_TO_PS _mm_castsi128_ps
#include "simd/vector_x86.h"

VECTOR_BINARY(vm, vf_greater, vf, _mm_cmpgt_ps(a, b))
static inline vi vi_mul(vi a, vi b) {
    vi even = _mm_mul_epu32(a, b);
    vi odd = _mm_mul_epu32(_mm_srli_si128(a, 4), _mm_srli_si128(b, 4));
    return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(0, 0, 2, 0)),
                              _mm_shuffle_epi32(odd, _MM_SHUFFLE(0, 0, 2, 0)));
}
static inline vi vi_max(vi a, vi b) {
    vi greater = _mm_cmpgt_epi32(a, b);
    return _mm_or_si128(_mm_and_si128(greater, a), _mm_andnot_si128(greater, b));
}
static inline vi vi_min(vi a, vi b) {
    vi greater = _mm_cmpgt_epi32(a, b);
    return _mm_or_si128(_mm_and_si128(greater, b), _mm_andnot_si128(greater, a));
}
static inline vi vi_gather(const int32_t *table, vi index) {
    int32_t lanes[4];
    _mm_storeu_si128((__m128i *)(void *)lanes, index);
    for (int i = 0; i < 4; ++i) {
        lanes[i] = table[lanes[i]];
    }
    return _mm_loadu_si128((const __m128i *)(const void *)lanes);
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    return vi_gather(table, index);
}
static inline vi vi_gather_pair(const uint16_t *table, vi index) {
    int32_t lanes[4];
    _mm_storeu_si128((__m128i *)(void *)lanes, index);
    for (int i = 0; i < 4; ++i) {
        const uint16_t *pair = table + lanes[i];
        lanes[i] = (int32_t)((uint32_t)pair[0] | (uint32_t)pair[1] << 16);
    }
    return _mm_loadu_si128((const __m128i *)(const void *)lanes);
}
static inline vf vf_gather(const float *table, vi index) {
    int32_t lanes[4];
    _mm_storeu_si128((__m128i *)(void *)lanes, index);
    return _mm_setr_ps(table[lanes[0]], table[lanes[1]], table[lanes[2]], table[lanes[3]]);
}
static inline vi vi_ramp(int32_t step) {
    return _mm_set_epi32(3 * step, 2 * step, step, 0);
}
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm_or_ps(_mm_and_ps(mask, a), _mm_andnot_ps(mask, b));
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return _mm_castps_si128(vf_blend(mask, _mm_castsi128_ps(a), _mm_castsi128_ps(b)));
}
static inline void vf_store_where(vm mask, float *to, vf x) {
    _mm_storeu_ps(to, vf_blend(mask, x, _mm_loadu_ps(to)));
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    vi_store(to, vi_blend(mask, x, vi_load(to)));
}
static inline void vf_load_aos4(const void *const from[4], vf x[4]) {
    for (int i = 0; i < 4; ++i) {
        x[i] = _mm_loadu_ps(from[i]);
    }
    _MM_TRANSPOSE4_PS(x[0], x[1], x[2], x[3]);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    float *out = to;
    _MM_TRANSPOSE4_PS(a, b, c, d);
    _mm_storeu_ps(out, a);
    _mm_storeu_ps(out + 4, b);
    _mm_storeu_ps(out + 8, c);
    _mm_storeu_ps(out + 12, d);
}
/* SSE2 has no shuffle of bytes */
static inline void pack_pixels(uint8_t *to, const uint32_t *from) {
    const uint32_t words[3] = {from[0] | from[1] << 24, from[1] >> 8 | from[2] << 16,
                               from[2] >> 16 | from[3] << 8};
    memcpy(to, words, sizeof words);
}
static inline void vector_fence(void) {
    _mm_sfence();
}

#endif
