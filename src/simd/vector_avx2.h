/* The vector type for AVX2: 8 floats. See vector.h for what the operations mean. */
#ifndef BURNISH_SIMD_VECTOR_AVX2_H
#define BURNISH_SIMD_VECTOR_AVX2_H

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

#define VECTOR_WORD avx2
#define VECTOR_HAS_PERMUTE /* vi_permute, vi_compress, vi_gather_near */
enum { LANES = 8, VECTOR_ISA = BURNISH_ISA_AVX2 };
typedef __m256 vf;
typedef __m256i vi;
typedef __m256 vm;

#define MM(operation) _mm256_##operation
#define SI(operation) _mm256_##operation##_si256
#define SI_TO_PS _mm256_castsi256_ps
#include "simd/vector_x86.h"

VECTOR_BINARY(vm, vf_greater, vf, _mm256_cmp_ps(a, b, _CMP_GT_OQ))
BURNISH_INLINE vi gather_all(const void *table, int size, vi index) {
    const __m128i low = gather_four(table, size, _mm256_castsi256_si128(index));
    const __m128i high = gather_four(table, size, _mm256_extracti128_si256(index, 1));
    return _mm256_inserti128_si256(_mm256_castsi128_si256(low), high, 1);
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    const __m256i *halves = (const __m256i *)(const void *)table;
    const __m256i low = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(halves), index);
    const __m256i high = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(halves + 1), index);
    return _mm256_blendv_epi8(low, high, _mm256_cmpgt_epi32(index, _mm256_set1_epi32(7)));
}
static inline vi vi_gather_near(const int32_t *table, vi index) {
    const int32_t first = _mm256_cvtsi256_si32(index) - (int)LANES;
    const vi at = _mm256_sub_epi32(index, _mm256_set1_epi32(first));
    if (__builtin_expect(!_mm256_testz_si256(at, _mm256_set1_epi32(~(2 * (int)LANES - 1))), 0)) {
        return vi_gather(table, index);
    }
    return vi_gather16(table + first, at);
}
static inline vi vi_permute(vi x, vi index) {
    return _mm256_permutevar8x32_epi32(x, index);
}
/* Half after half: the lanes of a half that 4 bits select come first. */
static inline int vi_compress(unsigned bits, int32_t *to, vi x) {
    static const int32_t first[16][4] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0},
                                         {2, 0, 0, 0}, {0, 2, 0, 0}, {1, 2, 0, 0}, {0, 1, 2, 0},
                                         {3, 0, 0, 0}, {0, 3, 0, 0}, {1, 3, 0, 0}, {0, 1, 3, 0},
                                         {2, 3, 0, 0}, {0, 2, 3, 0}, {1, 2, 3, 0}, {0, 1, 2, 3}};
    const __m128 low = _mm_castsi128_ps(_mm256_castsi256_si128(x));
    const __m128 high = _mm_castsi128_ps(_mm256_extracti128_si256(x, 1));
    const __m128i *table = (const __m128i *)(const void *)first;
    const int count = __builtin_popcount(bits & 15);
    _mm_storeu_ps((float *)(void *)to,
                  _mm_permutevar_ps(low, _mm_loadu_si128(table + (bits & 15))));
    _mm_storeu_ps((float *)(void *)(to + count),
                  _mm_permutevar_ps(high, _mm_loadu_si128(table + (bits >> 4))));
    return count + __builtin_popcount(bits >> 4);
}
static inline vi vi_ramp(int32_t step) {
    return _mm256_mullo_epi32(_mm256_set1_epi32(step), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
}
#if defined(BURNISH_MSAN) /* it takes the lanes that blendv leaves out for used ones */
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm256_or_ps(_mm256_and_ps(mask, a), _mm256_andnot_ps(mask, b));
}
#else
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm256_blendv_ps(b, a, mask);
}
#endif
static inline vi vi_blend(vm mask, vi a, vi b) {
    return _mm256_castps_si256(vf_blend(mask, _mm256_castsi256_ps(a), _mm256_castsi256_ps(b)));
}
static inline void vf_store_where(vm mask, float *to, vf x) {
    _mm256_storeu_ps(to, vf_blend(mask, x, _mm256_loadu_ps(to)));
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    vf_store_where(mask, (float *)(void *)to, _mm256_castsi256_ps(x));
}
static inline void vf_load_aos4(const void *const from[8], vf x[4]) {
    for (int i = 0; i < 4; ++i) {
        __m256 row = _mm256_castps128_ps256(_mm_loadu_ps(from[i]));
        x[i] = _mm256_insertf128_ps(row, _mm_loadu_ps(from[4 + i]), 1);
    }
    vector_transpose(x);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    vf x[4] = {a, b, c, d};
    float *out = to;
    vector_transpose(x);
    for (int i = 0; i < 4; ++i) {
        _mm_storeu_ps(out + 4 * i, _mm256_castps256_ps128(x[i]));
        _mm_storeu_ps(out + 16 + 4 * i, _mm256_extractf128_ps(x[i], 1));
    }
}

#endif
