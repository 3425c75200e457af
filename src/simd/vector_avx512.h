/* The vector type for AVX-512: 16 floats. See vector.h for what the operations mean. */
#ifndef BURNISH_SIMD_VECTOR_AVX512_H
#define BURNISH_SIMD_VECTOR_AVX512_H

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

#define VECTOR_WORD avx512
#define VECTOR_HAS_PERMUTE /* vi_permute, vi_compress, vi_gather_near */
#define VECTOR_HAS_MASKS   /* vm is not a vector */
enum { LANES = 16, VECTOR_ISA = BURNISH_ISA_AVX512 };
typedef __m512 vf;
typedef __m512i vi;
typedef __mmask16 vm;

#define MM(operation) _mm512_##operation
#define SI(operation) _mm512_##operation##_si512
#define SI_TO_PS _mm512_castsi512_ps
#include "simd/vector_x86.h"

VECTOR_BINARY(vm, vf_greater, vf, _mm512_cmp_ps_mask(a, b, _CMP_GT_OQ))
static inline vf vf_and_mask(vm mask, vf x) {
    return _mm512_maskz_mov_ps(mask, x);
}
VECTOR_BINARY(vm, vm_and, vm, (vm)(a &b))
VECTOR_BINARY(vm, vm_or, vm, (vm)(a | b))
VECTOR_BINARY(vm, vm_and_not, vm, (vm)(a & ~b))
VECTOR_UNARY(vm, vm_not, vm, (vm)~x)
VECTOR_UNARY(int, vm_any, vm, x != 0)
BURNISH_INLINE vi gather_all(const void *table, int size, vi index) {
    const __m128i four[4] = {gather_four(table, size, _mm512_castsi512_si128(index)),
                             gather_four(table, size, _mm512_extracti32x4_epi32(index, 1)),
                             gather_four(table, size, _mm512_extracti32x4_epi32(index, 2)),
                             gather_four(table, size, _mm512_extracti32x4_epi32(index, 3))};
    const __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(four[0]), four[1], 1);
    const __m256i high = _mm256_inserti128_si256(_mm256_castsi128_si256(four[2]), four[3], 1);
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}
static inline vi vi_gather_near(const int32_t *table, vi index) {
    const int32_t first = _mm512_cvtsi512_si32(index) - (int)LANES;
    const int32_t *window = table + first;
    const vi at = _mm512_sub_epi32(index, _mm512_set1_epi32(first));
    if (__builtin_expect(_mm512_cmpge_epu32_mask(at, _mm512_set1_epi32(2 * (int)LANES)) != 0, 0)) {
        return vi_gather(table, index);
    }
    return _mm512_permutex2var_epi32(_mm512_loadu_si512((const void *)window), at,
                                     _mm512_loadu_si512((const void *)(window + LANES)));
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    return _mm512_permutexvar_epi32(index, _mm512_loadu_si512((const void *)table));
}
static inline vi vi_permute(vi x, vi index) {
    return _mm512_permutexvar_epi32(index, x);
}
static inline int vi_compress(unsigned bits, int32_t *to, vi x) {
    _mm512_storeu_si512((void *)to, _mm512_maskz_compress_epi32((__mmask16)bits, x));
    return __builtin_popcount(bits);
}
static inline vi vi_ramp(int32_t step) {
    const vi lanes = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    return _mm512_mullo_epi32(_mm512_set1_epi32(step), lanes);
}
VECTOR_UNARY(vi, vi_load, const int32_t *, _mm512_loadu_si512((const void *)x))
static inline void vi_store(int32_t *to, vi x) {
    _mm512_storeu_si512((void *)to, x);
}
VECTOR_UNARY(vm, vi_not_negative, vi, _mm512_cmpge_epi32_mask(x, _mm512_setzero_si512()))
VECTOR_BINARY(vm, vi_equal, vi, _mm512_cmpeq_epi32_mask(a, b))
VECTOR_BINARY(vm, vi_greater, vi, _mm512_cmpgt_epi32_mask(a, b))
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm512_mask_blend_ps(mask, b, a);
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return _mm512_mask_blend_epi32(mask, b, a);
}
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    _mm512_storeu_si512((void *)to, x);
}
VECTOR_UNARY(unsigned, vm_bits, vm, x)
static inline void vf_store_where(vm mask, float *to, vf x) {
    _mm512_mask_storeu_ps(to, mask, x);
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    _mm512_mask_storeu_epi32(to, mask, x);
}
static inline void vf_load_aos4(const void *const from[16], vf x[4]) {
    for (int i = 0; i < 4; ++i) {
        __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(from[i]));
        row = _mm512_insertf32x4(row, _mm_loadu_ps(from[4 + i]), 1);
        row = _mm512_insertf32x4(row, _mm_loadu_ps(from[8 + i]), 2);
        x[i] = _mm512_insertf32x4(row, _mm_loadu_ps(from[12 + i]), 3);
    }
    vector_transpose(x);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    vf x[4] = {a, b, c, d};
    float *out = to;
    vector_transpose(x);
    for (int i = 0; i < 4; ++i) {
        _mm_storeu_ps(out + 4 * i, _mm512_castps512_ps128(x[i]));
        _mm_storeu_ps(out + 16 + 4 * i, _mm512_extractf32x4_ps(x[i], 1));
        _mm_storeu_ps(out + 32 + 4 * i, _mm512_extractf32x4_ps(x[i], 2));
        _mm_storeu_ps(out + 48 + 4 * i, _mm512_extractf32x4_ps(x[i], 3));
    }
}

#endif
