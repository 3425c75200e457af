/* The vector type for WebAssembly's SIMD128: 4 floats. See vector.h for what the operations mean.
 */
#ifndef BURNISH_SIMD_VECTOR_WASM_H
#define BURNISH_SIMD_VECTOR_WASM_H

#include <stdint.h>
#include <string.h>
#include <wasm_simd128.h>

#define VECTOR_WORD wasm
enum { LANES = 4, VECTOR_ISA = BURNISH_ISA_WASM };
typedef v128_t vf;
typedef v128_t vi;
typedef v128_t vm;

VECTOR_UNARY(vf, vf_set, float, wasm_f32x4_splat(x))
VECTOR_UNARY(vf, vf_load, const float *, wasm_v128_load(x))
static inline void vf_store(float *to, vf x) {
    wasm_v128_store(to, x);
}
static inline void vf_stream(float *to, vf x) {
    wasm_v128_store(to, x);
}
VECTOR_BINARY(vf, vf_add, vf, wasm_f32x4_add(a, b))
VECTOR_BINARY(vf, vf_sub, vf, wasm_f32x4_sub(a, b))
VECTOR_BINARY(vf, vf_mul, vf, wasm_f32x4_mul(a, b))
VECTOR_BINARY(vf, vf_div, vf, wasm_f32x4_div(a, b))
VECTOR_BINARY(vf, vf_max, vf, wasm_f32x4_pmax(b, a))
VECTOR_BINARY(vf, vf_min, vf, wasm_f32x4_pmin(b, a))
VECTOR_BINARY(vm, vf_greater, vf, wasm_f32x4_gt(a, b))
static inline vf vf_and_mask(vm mask, vf x) {
    return wasm_v128_and(mask, x);
}
VECTOR_BINARY(vm, vm_and, vm, wasm_v128_and(a, b))
VECTOR_BINARY(vm, vm_or, vm, wasm_v128_or(a, b))
VECTOR_BINARY(vm, vm_and_not, vm, wasm_v128_andnot(a, b))
VECTOR_UNARY(vm, vm_not, vm, wasm_v128_not(x))
VECTOR_UNARY(int, vm_any, vm, wasm_v128_any_true(x))
VECTOR_UNARY(vi, vi_set, int32_t, wasm_i32x4_splat(x))
VECTOR_UNARY(vi, vf_bits, vf, x)
VECTOR_UNARY(vf, vf_from_bits, vi, x)
VECTOR_BINARY(vi, vi_add, vi, wasm_i32x4_add(a, b))
VECTOR_BINARY(vi, vi_sub, vi, wasm_i32x4_sub(a, b))
VECTOR_BINARY(vi, vi_and, vi, wasm_v128_and(a, b))
VECTOR_BINARY(vi, vi_xor, vi, wasm_v128_xor(a, b))
VECTOR_BINARY(vi, vi_or, vi, wasm_v128_or(a, b))
static inline vi vi_shl(vi x, unsigned bits) {
    return wasm_i32x4_shl(x, bits);
}
static inline vi vi_shr(vi x, unsigned bits) {
    return wasm_u32x4_shr(x, bits);
}
static inline vi vi_sar(vi x, unsigned bits) {
    return wasm_i32x4_shr(x, bits);
}
VECTOR_BINARY(vi, vi_mul, vi, wasm_i32x4_mul(a, b))
VECTOR_BINARY(vi, vi_dot16, vi, wasm_i32x4_dot_i16x8(a, b))
VECTOR_BINARY(vi, vi_max, vi, wasm_i32x4_max(a, b))
VECTOR_BINARY(vi, vi_min, vi, wasm_i32x4_min(a, b))
static inline vi vi_gather(const int32_t *table, vi index) {
    int32_t lanes[4];
    wasm_v128_store(lanes, index);
    for (int i = 0; i < 4; ++i) {
        lanes[i] = table[lanes[i]];
    }
    return wasm_v128_load(lanes);
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    return vi_gather(table, index);
}
static inline vi vi_gather_pair(const uint16_t *table, vi index) {
    int32_t lanes[4];
    wasm_v128_store(lanes, index);
    for (int i = 0; i < 4; ++i) {
        const uint16_t *pair = table + lanes[i];
        lanes[i] = (int32_t)((uint32_t)pair[0] | (uint32_t)pair[1] << 16);
    }
    return wasm_v128_load(lanes);
}
static inline vf vf_gather(const float *table, vi index) {
    int32_t at[4];
    wasm_v128_store(at, index);
    return wasm_f32x4_make(table[at[0]], table[at[1]], table[at[2]], table[at[3]]);
}
VECTOR_UNARY(vf, vf_from_int, vi, wasm_f32x4_convert_i32x4(x))
VECTOR_UNARY(vi, vi_truncate, vf, wasm_i32x4_trunc_sat_f32x4(x))
static inline vi vi_ramp(int32_t step) {
    return wasm_i32x4_mul(wasm_i32x4_splat(step), wasm_i32x4_make(0, 1, 2, 3));
}
VECTOR_UNARY(vi, vi_load, const int32_t *, wasm_v128_load(x))
static inline void vi_store(int32_t *to, vi x) {
    wasm_v128_store(to, x);
}
VECTOR_UNARY(vm, vi_not_negative, vi, wasm_i32x4_ge(x, wasm_i32x4_splat(0)))
VECTOR_BINARY(vm, vi_equal, vi, wasm_i32x4_eq(a, b))
VECTOR_BINARY(vm, vi_greater, vi, wasm_i32x4_gt(a, b))
static inline vf vf_blend(vm mask, vf a, vf b) {
    return wasm_v128_bitselect(a, b, mask);
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return wasm_v128_bitselect(a, b, mask);
}
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    wasm_v128_store(to, x);
}
VECTOR_UNARY(unsigned, vm_bits, vm, wasm_i32x4_bitmask(x))
static inline void vf_store_where(vm mask, float *to, vf x) {
    wasm_v128_store(to, wasm_v128_bitselect(x, wasm_v128_load(to), mask));
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    wasm_v128_store(to, wasm_v128_bitselect(x, wasm_v128_load(to), mask));
}
static inline void vector_transpose(vf a[4]) {
    vf t0 = wasm_i32x4_shuffle(a[0], a[1], 0, 4, 1, 5),
       t1 = wasm_i32x4_shuffle(a[0], a[1], 2, 6, 3, 7);
    vf t2 = wasm_i32x4_shuffle(a[2], a[3], 0, 4, 1, 5),
       t3 = wasm_i32x4_shuffle(a[2], a[3], 2, 6, 3, 7);
    a[0] = wasm_i64x2_shuffle(t0, t2, 0, 2);
    a[1] = wasm_i64x2_shuffle(t0, t2, 1, 3);
    a[2] = wasm_i64x2_shuffle(t1, t3, 0, 2);
    a[3] = wasm_i64x2_shuffle(t1, t3, 1, 3);
}
static inline void vf_load_aos4(const void *const from[4], vf x[4]) {
    for (int i = 0; i < 4; ++i) {
        x[i] = wasm_v128_load(from[i]);
    }
    vector_transpose(x);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    vf x[4] = {a, b, c, d};
    vector_transpose(x);
    for (int i = 0; i < 4; ++i) {
        wasm_v128_store((float *)to + 4 * i, x[i]);
    }
}
static inline void pack_pixels(uint8_t *to, const uint32_t *from) {
    const uint32_t words[3] = {from[0] | from[1] << 24, from[1] >> 8 | from[2] << 16,
                               from[2] >> 16 | from[3] << 8};
    memcpy(to, words, sizeof words);
}
static inline void vector_fence(void) {}

#endif
