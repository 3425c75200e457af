/* What vectors of SSE2, AVX2 and AVX-512 have in common. The file that includes this defines vf, vi
 * and vm, and the names of intrinsics: MM of an operation, SI of an operation on whole vectors of
 * integers, SI_TO_PS of the cast. */
#ifndef BURNISH_SIMD_VECTOR_X86_H
#define BURNISH_SIMD_VECTOR_X86_H

VECTOR_UNARY(vf, vf_set, float, MM(set1_ps)(x))
VECTOR_UNARY(vf, vf_load, const float *, MM(loadu_ps)(x))
static inline void vf_store(float *to, vf x) {
    MM(storeu_ps)(to, x);
}
static inline void vf_stream(float *to, vf x) {
    MM(stream_ps)(to, x);
}
VECTOR_BINARY(vf, vf_add, vf, MM(add_ps)(a, b))
VECTOR_BINARY(vf, vf_sub, vf, MM(sub_ps)(a, b))
VECTOR_BINARY(vf, vf_mul, vf, MM(mul_ps)(a, b))
VECTOR_BINARY(vf, vf_div, vf, MM(div_ps)(a, b))
VECTOR_BINARY(vf, vf_max, vf, MM(max_ps)(a, b))
VECTOR_BINARY(vf, vf_min, vf, MM(min_ps)(a, b))
VECTOR_UNARY(vi, vi_set, int32_t, MM(set1_epi32)(x))
VECTOR_UNARY(vi, vf_bits, vf, SI(castps)(x))
VECTOR_UNARY(vf, vf_from_bits, vi, SI_TO_PS(x))
VECTOR_BINARY(vi, vi_add, vi, MM(add_epi32)(a, b))
VECTOR_BINARY(vi, vi_sub, vi, MM(sub_epi32)(a, b))
VECTOR_BINARY(vi, vi_and, vi, SI (and)(a, b))
VECTOR_BINARY(vi, vi_xor, vi, SI (xor)(a, b))
VECTOR_BINARY(vi, vi_or, vi, SI(or)(a, b))
#define vi_shl(x, bits) MM(slli_epi32)(x, bits)
#define vi_shr(x, bits) MM(srli_epi32)(x, bits)
#define vi_sar(x, bits) MM(srai_epi32)(x, bits)
VECTOR_BINARY(vi, vi_dot16, vi, MM(madd_epi16)(a, b))
VECTOR_UNARY(vf, vf_from_int, vi, MM(cvtepi32_ps)(x))
VECTOR_UNARY(vi, vi_truncate, vf, MM(cvttps_epi32)(x))

#if defined(VECTOR_HAS_PERMUTE)
VECTOR_BINARY(vi, vi_mul, vi, MM(mullo_epi32)(a, b))
VECTOR_BINARY(vi, vi_max, vi, MM(max_epi32)(a, b))
VECTOR_BINARY(vi, vi_min, vi, MM(min_epi32)(a, b))
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
/* 4 bytes from table + index * size on, four times. Loads and insertions take a third
 * of the time of gather instructions on AMD's processors of family 26, and Intel's microcode against
 * CVE-2022-40982 makes these slow, too. */
BURNISH_INLINE __m128i gather_four(const void *table, int size, __m128i index) {
    const int64_t low = ((__v2di)index)[0], high = ((__v2di)index)[1];
    const int64_t at[4] = {(int32_t)low, low >> 32, (int32_t)high, high >> 32};
    int32_t found[4];
    for (int i = 0; i < 4; ++i) {
        memcpy(&found[i], (const char *)table + at[i] * size, sizeof found[i]);
    }
    __m128i four = _mm_cvtsi32_si128(found[0]);
    four = _mm_insert_epi32(four, found[1], 1);
    four = _mm_insert_epi32(four, found[2], 2);
    return _mm_insert_epi32(four, found[3], 3);
}
BURNISH_INLINE vi gather_all(const void *table, int size, vi index);
BURNISH_INLINE vi vi_gather(const int32_t *table, vi index) {
    return gather_all(table, 4, index);
}
BURNISH_INLINE vi vi_gather_pair(const uint16_t *table, vi index) {
    return gather_all(table, 2, index);
}
BURNISH_INLINE vf vf_gather(const float *table, vi index) {
    return vf_from_bits(gather_all(table, 4, index));
}
static inline void vector_fence(void) {
    _mm_sfence();
}
#endif

#if !defined(VECTOR_HAS_MASKS)
static inline vf vf_and_mask(vm mask, vf x) {
    return MM(and_ps)(mask, x);
}
VECTOR_BINARY(vm, vm_and, vm, MM(and_ps)(a, b))
VECTOR_BINARY(vm, vm_or, vm, MM(or_ps)(a, b))
VECTOR_BINARY(vm, vm_and_not, vm, MM(andnot_ps)(b, a))
VECTOR_UNARY(vm, vm_not, vm, MM(xor_ps)(x, vf_from_bits(MM(set1_epi32)(-1))))
VECTOR_UNARY(int, vm_any, vm, MM(movemask_ps)(x) != 0)
VECTOR_UNARY(vi, vi_load, const int32_t *, SI(loadu)((const vi *)(const void *)x))
static inline void vi_store(int32_t *to, vi x) {
    SI(storeu)((vi *)(void *)to, x);
}
VECTOR_UNARY(vm, vi_not_negative, vi, vf_from_bits(MM(cmpgt_epi32)(x, MM(set1_epi32)(-1))))
VECTOR_BINARY(vm, vi_equal, vi, vf_from_bits(MM(cmpeq_epi32)(a, b)))
VECTOR_BINARY(vm, vi_greater, vi, vf_from_bits(MM(cmpgt_epi32)(a, b)))
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    SI(storeu)((vi *)(void *)to, x);
}
VECTOR_UNARY(unsigned, vm_bits, vm, (unsigned)MM(movemask_ps)(x))
#endif

#endif
