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

static inline vf vf_set(float x) {
    return _mm_set1_ps(x);
}
static inline vf vf_load(const float *from) {
    return _mm_loadu_ps(from);
}
static inline void vf_store(float *to, vf x) {
    _mm_storeu_ps(to, x);
}
static inline void vf_stream(float *to, vf x) {
    _mm_stream_ps(to, x);
}
static inline vf vf_add(vf a, vf b) {
    return _mm_add_ps(a, b);
}
static inline vf vf_sub(vf a, vf b) {
    return _mm_sub_ps(a, b);
}
static inline vf vf_mul(vf a, vf b) {
    return _mm_mul_ps(a, b);
}
static inline vf vf_div(vf a, vf b) {
    return _mm_div_ps(a, b);
}
static inline vf vf_max(vf a, vf b) {
    return _mm_max_ps(a, b);
}
static inline vf vf_min(vf a, vf b) {
    return _mm_min_ps(a, b);
}
static inline vm vf_greater(vf a, vf b) {
    return _mm_cmpgt_ps(a, b);
}
static inline vf vf_and_mask(vm mask, vf x) {
    return _mm_and_ps(mask, x);
}
static inline vm vm_and(vm a, vm b) {
    return _mm_and_ps(a, b);
}
static inline vm vm_or(vm a, vm b) {
    return _mm_or_ps(a, b);
}
static inline vm vm_and_not(vm a, vm b) {
    return _mm_andnot_ps(b, a);
}
static inline vm vm_not(vm a) {
    return _mm_xor_ps(a, _mm_castsi128_ps(_mm_set1_epi32(-1)));
}
static inline int vm_any(vm mask) {
    return _mm_movemask_ps(mask) != 0;
}
static inline vi vi_set(int32_t x) {
    return _mm_set1_epi32(x);
}
static inline vi vf_bits(vf x) {
    return _mm_castps_si128(x);
}
static inline vf vf_from_bits(vi x) {
    return _mm_castsi128_ps(x);
}
static inline vi vi_add(vi a, vi b) {
    return _mm_add_epi32(a, b);
}
static inline vi vi_sub(vi a, vi b) {
    return _mm_sub_epi32(a, b);
}
static inline vi vi_and(vi a, vi b) {
    return _mm_and_si128(a, b);
}
static inline vi vi_xor(vi a, vi b) {
    return _mm_xor_si128(a, b);
}
static inline vi vi_or(vi a, vi b) {
    return _mm_or_si128(a, b);
}
#define vi_shl(x, bits) _mm_slli_epi32(x, bits)
#define vi_shr(x, bits) _mm_srli_epi32(x, bits)
#define vi_sar(x, bits) _mm_srai_epi32(x, bits)
static inline vi vi_mul(vi a, vi b) {
    vi even = _mm_mul_epu32(a, b);
    vi odd = _mm_mul_epu32(_mm_srli_si128(a, 4), _mm_srli_si128(b, 4));
    return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(0, 0, 2, 0)),
                              _mm_shuffle_epi32(odd, _MM_SHUFFLE(0, 0, 2, 0)));
}
static inline vi vi_dot16(vi a, vi b) {
    return _mm_madd_epi16(a, b);
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
static inline vf vf_from_int(vi x) {
    return _mm_cvtepi32_ps(x);
}
static inline vi vi_truncate(vf x) {
    return _mm_cvttps_epi32(x);
}
static inline vi vi_ramp(int32_t step) {
    return _mm_set_epi32(3 * step, 2 * step, step, 0);
}
static inline vi vi_load(const int32_t *from) {
    return _mm_loadu_si128((const __m128i *)(const void *)from);
}
static inline void vi_store(int32_t *to, vi x) {
    _mm_storeu_si128((__m128i *)(void *)to, x);
}
static inline vm vi_not_negative(vi x) {
    return _mm_castsi128_ps(_mm_cmpgt_epi32(x, _mm_set1_epi32(-1)));
}
static inline vm vi_equal(vi a, vi b) {
    return _mm_castsi128_ps(_mm_cmpeq_epi32(a, b));
}
static inline vm vi_greater(vi a, vi b) {
    return _mm_castsi128_ps(_mm_cmpgt_epi32(a, b));
}
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm_or_ps(_mm_and_ps(mask, a), _mm_andnot_ps(mask, b));
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return _mm_castps_si128(vf_blend(mask, _mm_castsi128_ps(a), _mm_castsi128_ps(b)));
}
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    _mm_storeu_si128((__m128i *)(void *)to, x);
}
static inline unsigned vm_bits(vm mask) {
    return (unsigned)_mm_movemask_ps(mask);
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
