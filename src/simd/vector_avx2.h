/* The vector type for AVX2: 8 floats. See vector.h for what the operations mean. */
#ifndef BURNISH_SIMD_VECTOR_AVX2_H
#define BURNISH_SIMD_VECTOR_AVX2_H

#include <immintrin.h>
#include <stdint.h>

#define VECTOR_WORD avx2
#define VECTOR_HAS_PERMUTE /* vi_permute, vi_compress */
enum { LANES = 8, VECTOR_ISA = BURNISH_ISA_AVX2 };
typedef __m256 vf;
typedef __m256i vi;
typedef __m256 vm;

static inline vf vf_set(float x) {
    return _mm256_set1_ps(x);
}
static inline vf vf_load(const float *from) {
    return _mm256_loadu_ps(from);
}
static inline void vf_store(float *to, vf x) {
    _mm256_storeu_ps(to, x);
}
static inline void vf_stream(float *to, vf x) {
    _mm256_stream_ps(to, x);
}
static inline vf vf_add(vf a, vf b) {
    return _mm256_add_ps(a, b);
}
static inline vf vf_sub(vf a, vf b) {
    return _mm256_sub_ps(a, b);
}
static inline vf vf_mul(vf a, vf b) {
    return _mm256_mul_ps(a, b);
}
static inline vf vf_div(vf a, vf b) {
    return _mm256_div_ps(a, b);
}
static inline vf vf_max(vf a, vf b) {
    return _mm256_max_ps(a, b);
}
static inline vf vf_min(vf a, vf b) {
    return _mm256_min_ps(a, b);
}
static inline vm vf_greater(vf a, vf b) {
    return _mm256_cmp_ps(a, b, _CMP_GT_OQ);
}
static inline vf vf_and_mask(vm mask, vf x) {
    return _mm256_and_ps(mask, x);
}
static inline vm vm_and(vm a, vm b) {
    return _mm256_and_ps(a, b);
}
static inline vm vm_or(vm a, vm b) {
    return _mm256_or_ps(a, b);
}
static inline vm vm_and_not(vm a, vm b) {
    return _mm256_andnot_ps(b, a);
}
static inline vm vm_not(vm a) {
    return _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)));
}
static inline int vm_any(vm mask) {
    return _mm256_movemask_ps(mask) != 0;
}
static inline vi vi_set(int32_t x) {
    return _mm256_set1_epi32(x);
}
static inline vi vf_bits(vf x) {
    return _mm256_castps_si256(x);
}
static inline vf vf_from_bits(vi x) {
    return _mm256_castsi256_ps(x);
}
static inline vi vi_add(vi a, vi b) {
    return _mm256_add_epi32(a, b);
}
static inline vi vi_sub(vi a, vi b) {
    return _mm256_sub_epi32(a, b);
}
static inline vi vi_and(vi a, vi b) {
    return _mm256_and_si256(a, b);
}
static inline vi vi_xor(vi a, vi b) {
    return _mm256_xor_si256(a, b);
}
static inline vi vi_or(vi a, vi b) {
    return _mm256_or_si256(a, b);
}
#define vi_shl(x, bits) _mm256_slli_epi32(x, bits)
#define vi_shr(x, bits) _mm256_srli_epi32(x, bits)
#define vi_sar(x, bits) _mm256_srai_epi32(x, bits)
static inline vi vi_mul(vi a, vi b) {
    return _mm256_mullo_epi32(a, b);
}
static inline vi vi_dot16(vi a, vi b) {
    return _mm256_madd_epi16(a, b);
}
static inline vi vi_max(vi a, vi b) {
    return _mm256_max_epi32(a, b);
}
static inline vi vi_min(vi a, vi b) {
    return _mm256_min_epi32(a, b);
}
static inline vi vi_gather(const int32_t *table, vi index) {
    return _mm256_i32gather_epi32((const int *)table, index, 4);
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    const __m256i *halves = (const __m256i *)(const void *)table;
    const __m256i low = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(halves), index);
    const __m256i high = _mm256_permutevar8x32_epi32(_mm256_loadu_si256(halves + 1), index);
    return _mm256_blendv_epi8(low, high, _mm256_cmpgt_epi32(index, _mm256_set1_epi32(7)));
}
static inline vi vi_gather_pair(const uint16_t *table, vi index) {
    return _mm256_i32gather_epi32((const int *)(const void *)table, index, 2);
}
static inline vf vf_gather(const float *table, vi index) {
    return _mm256_i32gather_ps(table, index, 4);
}
static inline vf vf_from_int(vi x) {
    return _mm256_cvtepi32_ps(x);
}
static inline vi vi_truncate(vf x) {
    return _mm256_cvttps_epi32(x);
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
static inline vi vi_load(const int32_t *from) {
    return _mm256_loadu_si256((const __m256i *)(const void *)from);
}
static inline void vi_store(int32_t *to, vi x) {
    _mm256_storeu_si256((__m256i *)(void *)to, x);
}
static inline vm vi_not_negative(vi x) {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(x, _mm256_set1_epi32(-1)));
}
static inline vm vi_equal(vi a, vi b) {
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(a, b));
}
static inline vm vi_greater(vi a, vi b) {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(a, b));
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
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    _mm256_storeu_si256((__m256i *)(void *)to, x);
}
static inline unsigned vm_bits(vm mask) {
    return (unsigned)_mm256_movemask_ps(mask);
}
static inline void vf_store_where(vm mask, float *to, vf x) {
    _mm256_storeu_ps(to, vf_blend(mask, x, _mm256_loadu_ps(to)));
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    vf_store_where(mask, (float *)(void *)to, _mm256_castsi256_ps(x));
}
static inline void vector_transpose(vf a[4]) {
    __m256 t0 = _mm256_unpacklo_ps(a[0], a[1]), t1 = _mm256_unpackhi_ps(a[0], a[1]);
    __m256 t2 = _mm256_unpacklo_ps(a[2], a[3]), t3 = _mm256_unpackhi_ps(a[2], a[3]);
    a[0] = _mm256_shuffle_ps(t0, t2, _MM_SHUFFLE(1, 0, 1, 0));
    a[1] = _mm256_shuffle_ps(t0, t2, _MM_SHUFFLE(3, 2, 3, 2));
    a[2] = _mm256_shuffle_ps(t1, t3, _MM_SHUFFLE(1, 0, 1, 0));
    a[3] = _mm256_shuffle_ps(t1, t3, _MM_SHUFFLE(3, 2, 3, 2));
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
static inline void pack_pixels(uint8_t *to, const uint32_t *from) {
    const __m128i order = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1);
    __m128i pixels = _mm_loadu_si128((const __m128i *)(const void *)from);
    _mm_storeu_si128((__m128i *)(void *)to, _mm_shuffle_epi8(pixels, order));
}
static inline void vector_fence(void) {
    _mm_sfence();
}

#endif
