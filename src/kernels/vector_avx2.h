/* The vector type for AVX2: 8 floats. See vector.h for what the operations mean. */
#ifndef BURNISH_KERNELS_VECTOR_AVX2_H
#define BURNISH_KERNELS_VECTOR_AVX2_H

#include <immintrin.h>
#include <stdint.h>

enum { LANES = 8 };
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
static inline vf vf_keep(vm mask, vf x) {
    return _mm256_and_ps(mask, x);
}
static inline vm vm_and(vm a, vm b) {
    return _mm256_and_ps(a, b);
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
static inline vf vi_float(vi x) {
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
static inline vi vi_or(vi a, vi b) {
    return _mm256_or_si256(a, b);
}
#define vi_left(x, bits) _mm256_slli_epi32(x, bits)
#define vi_right(x, bits) _mm256_srli_epi32(x, bits)
#define vi_right_signed(x, bits) _mm256_srai_epi32(x, bits)
static inline vi vi_mul(vi a, vi b) {
    return _mm256_mullo_epi32(a, b);
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
static inline vf vi_convert(vi x) {
    return _mm256_cvtepi32_ps(x);
}
static inline vi vi_ramp(int32_t step) {
    return _mm256_mullo_epi32(_mm256_set1_epi32(step), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
}
static inline vi vi_load(const int32_t *from) {
    return _mm256_loadu_si256((const __m256i *)(const void *)from);
}
static inline void vi_save(int32_t *to, vi x) {
    _mm256_storeu_si256((__m256i *)(void *)to, x);
}
static inline vm vi_not_negative(vi x) {
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(x, _mm256_set1_epi32(-1)));
}
static inline vf vf_blend(vm mask, vf a, vf b) {
    return _mm256_blendv_ps(b, a, mask);
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return _mm256_castps_si256(
        _mm256_blendv_ps(_mm256_castsi256_ps(b), _mm256_castsi256_ps(a), mask));
}
static inline void vi_store(uint8_t *to, vi x) {
    _mm256_storeu_si256((__m256i *)(void *)to, x);
}
static inline void vi_stream(uint8_t *to, vi x) {
    _mm256_stream_si256((__m256i *)(void *)to, x);
}
static inline void vector_fence(void) {
    _mm_sfence();
}

#endif
