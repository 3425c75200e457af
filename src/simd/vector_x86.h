/* What vectors of SSE2, AVX2 and AVX-512 have in common. The file that includes this defines vf, vi
 * and vm, and the names of intrinsics: MM of an operation, SI of an operation on whole vectors of
 * integers, SI_TO_PS of the cast. */
#ifndef BURNISH_SIMD_VECTOR_X86_H
#define BURNISH_SIMD_VECTOR_X86_H

static inline vf vf_set(float x) {
    return MM(set1_ps)(x);
}
static inline vf vf_load(const float *from) {
    return MM(loadu_ps)(from);
}
static inline void vf_store(float *to, vf x) {
    MM(storeu_ps)(to, x);
}
static inline void vf_stream(float *to, vf x) {
    MM(stream_ps)(to, x);
}
static inline vf vf_add(vf a, vf b) {
    return MM(add_ps)(a, b);
}
static inline vf vf_sub(vf a, vf b) {
    return MM(sub_ps)(a, b);
}
static inline vf vf_mul(vf a, vf b) {
    return MM(mul_ps)(a, b);
}
static inline vf vf_div(vf a, vf b) {
    return MM(div_ps)(a, b);
}
static inline vf vf_max(vf a, vf b) {
    return MM(max_ps)(a, b);
}
static inline vf vf_min(vf a, vf b) {
    return MM(min_ps)(a, b);
}
static inline vi vi_set(int32_t x) {
    return MM(set1_epi32)(x);
}
static inline vi vf_bits(vf x) {
    return SI(castps)(x);
}
static inline vf vf_from_bits(vi x) {
    return SI_TO_PS(x);
}
static inline vi vi_add(vi a, vi b) {
    return MM(add_epi32)(a, b);
}
static inline vi vi_sub(vi a, vi b) {
    return MM(sub_epi32)(a, b);
}
static inline vi vi_and(vi a, vi b) {
    return SI(and)(a, b);
}
static inline vi vi_xor(vi a, vi b) {
    return SI(xor)(a, b);
}
static inline vi vi_or(vi a, vi b) {
    return SI(or)(a, b);
}
#define vi_shl(x, bits) MM(slli_epi32)(x, bits)
#define vi_shr(x, bits) MM(srli_epi32)(x, bits)
#define vi_sar(x, bits) MM(srai_epi32)(x, bits)
static inline vi vi_dot16(vi a, vi b) {
    return MM(madd_epi16)(a, b);
}
static inline vf vf_from_int(vi x) {
    return MM(cvtepi32_ps)(x);
}
static inline vi vi_truncate(vf x) {
    return MM(cvttps_epi32)(x);
}

#if defined(VECTOR_HAS_PERMUTE)
static inline vi vi_mul(vi a, vi b) {
    return MM(mullo_epi32)(a, b);
}
static inline vi vi_max(vi a, vi b) {
    return MM(max_epi32)(a, b);
}
static inline vi vi_min(vi a, vi b) {
    return MM(min_epi32)(a, b);
}
static inline vi vi_shuffle_bytes(vi x, vi order) {
    return MM(shuffle_epi8)(x, order);
}
static inline void vector_transpose(vf a[4]) {
    vf t0 = MM(unpacklo_ps)(a[0], a[1]), t1 = MM(unpackhi_ps)(a[0], a[1]);
    vf t2 = MM(unpacklo_ps)(a[2], a[3]), t3 = MM(unpackhi_ps)(a[2], a[3]);
    a[0] = MM(shuffle_ps)(t0, t2, _MM_SHUFFLE(1, 0, 1, 0));
    a[1] = MM(shuffle_ps)(t0, t2, _MM_SHUFFLE(3, 2, 3, 2));
    a[2] = MM(shuffle_ps)(t1, t3, _MM_SHUFFLE(1, 0, 1, 0));
    a[3] = MM(shuffle_ps)(t1, t3, _MM_SHUFFLE(3, 2, 3, 2));
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

#if !defined(VECTOR_HAS_MASKS)
static inline vf vf_and_mask(vm mask, vf x) {
    return MM(and_ps)(mask, x);
}
static inline vm vm_and(vm a, vm b) {
    return MM(and_ps)(a, b);
}
static inline vm vm_or(vm a, vm b) {
    return MM(or_ps)(a, b);
}
static inline vm vm_and_not(vm a, vm b) {
    return MM(andnot_ps)(b, a);
}
static inline vm vm_not(vm a) {
    return MM(xor_ps)(a, vf_from_bits(MM(set1_epi32)(-1)));
}
static inline int vm_any(vm mask) {
    return MM(movemask_ps)(mask) != 0;
}
static inline vi vi_load(const int32_t *from) {
    return SI(loadu)((const vi *)(const void *)from);
}
static inline void vi_store(int32_t *to, vi x) {
    SI(storeu)((vi *)(void *)to, x);
}
static inline vm vi_not_negative(vi x) {
    return vf_from_bits(MM(cmpgt_epi32)(x, MM(set1_epi32)(-1)));
}
static inline vm vi_equal(vi a, vi b) {
    return vf_from_bits(MM(cmpeq_epi32)(a, b));
}
static inline vm vi_greater(vi a, vi b) {
    return vf_from_bits(MM(cmpgt_epi32)(a, b));
}
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    SI(storeu)((vi *)(void *)to, x);
}
static inline unsigned vm_bits(vm mask) {
    return (unsigned)MM(movemask_ps)(mask);
}
#endif

#endif
