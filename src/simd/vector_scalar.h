/* The vector type for processors without one: 1 float. See vector.h for what the operations mean.
 */
#ifndef BURNISH_SIMD_VECTOR_SCALAR_H
#define BURNISH_SIMD_VECTOR_SCALAR_H

#include <stdint.h>
#include <string.h>

#define VECTOR_WORD scalar
enum { LANES = 1, VECTOR_ISA = BURNISH_ISA_SCALAR };
typedef float vf;
typedef uint32_t vi;
typedef uint32_t vm; /* 0 or all ones */

VECTOR_UNARY(vf, vf_set, float, x)
VECTOR_UNARY(vf, vf_load, const float *, *x)
static inline void vf_store(float *to, vf x) {
    *to = x;
}
static inline void vf_stream(float *to, vf x) {
    *to = x;
}
VECTOR_BINARY(vf, vf_add, vf, a + b)
VECTOR_BINARY(vf, vf_sub, vf, a - b)
VECTOR_BINARY(vf, vf_mul, vf, a *b)
VECTOR_BINARY(vf, vf_div, vf, a / b)
VECTOR_BINARY(vf, vf_max, vf, a > b ? a : b)
VECTOR_BINARY(vf, vf_min, vf, a < b ? a : b)
VECTOR_UNARY(vi, vi_set, int32_t, (uint32_t)x)
static inline vi vf_bits(vf x) {
    vi bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
static inline vf vf_from_bits(vi x) {
    vf value;
    memcpy(&value, &x, sizeof value);
    return value;
}
VECTOR_BINARY(vm, vf_greater, vf, a > b ? ~0u : 0u)
static inline vf vf_and_mask(vm mask, vf x) {
    return vf_from_bits(mask & vf_bits(x));
}
VECTOR_BINARY(vm, vm_and, vm, a &b)
VECTOR_BINARY(vm, vm_or, vm, a | b)
VECTOR_BINARY(vm, vm_and_not, vm, a & ~b)
VECTOR_UNARY(vm, vm_not, vm, ~x)
VECTOR_UNARY(int, vm_any, vm, x != 0)
VECTOR_BINARY(vi, vi_add, vi, a + b)
VECTOR_BINARY(vi, vi_sub, vi, a - b)
VECTOR_BINARY(vi, vi_and, vi, a &b)
VECTOR_BINARY(vi, vi_xor, vi, a ^ b)
VECTOR_BINARY(vi, vi_or, vi, a | b)
static inline vi vi_shl(vi x, unsigned bits) {
    return x << bits;
}
static inline vi vi_shr(vi x, unsigned bits) {
    return x >> bits;
}
static inline vi vi_sar(vi x, unsigned bits) {
    return (uint32_t)((int32_t)x >> bits);
}
VECTOR_BINARY(vi, vi_mul, vi, a *b)
static inline vi vi_dot16(vi a, vi b) {
    const int32_t low = (int16_t)(uint16_t)a * (int16_t)(uint16_t)b;
    const int32_t high = (int16_t)(uint16_t)(a >> 16) * (int16_t)(uint16_t)(b >> 16);
    return (uint32_t)low + (uint32_t)high;
}
VECTOR_BINARY(vi, vi_max, vi, (int32_t)a > (int32_t)b ? a : b)
VECTOR_BINARY(vi, vi_min, vi, (int32_t)a < (int32_t)b ? a : b)
static inline vi vi_gather(const int32_t *table, vi index) {
    return (uint32_t)table[index];
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    return vi_gather(table, index);
}
static inline vi vi_gather_pair(const uint16_t *table, vi index) {
    return (uint32_t)table[index] | (uint32_t)table[index + 1] << 16;
}
static inline vf vf_gather(const float *table, vi index) {
    return table[index];
}
VECTOR_UNARY(vf, vf_from_int, vi, (float)(int32_t)x)
VECTOR_UNARY(vi, vi_truncate, vf, (uint32_t)(int32_t)x)
static inline vi vi_ramp(int32_t step) {
    return 0 * (uint32_t)step;
}
VECTOR_UNARY(vi, vi_load, const int32_t *, (uint32_t)*x)
static inline void vi_store(int32_t *to, vi x) {
    *to = (int32_t)x;
}
VECTOR_UNARY(vm, vi_not_negative, vi, (int32_t)x >= 0 ? ~0u : 0u)
VECTOR_BINARY(vm, vi_equal, vi, a == b ? ~0u : 0u)
VECTOR_BINARY(vm, vi_greater, vi, (int32_t)a > (int32_t)b ? ~0u : 0u)
static inline vf vf_blend(vm mask, vf a, vf b) {
    return mask ? a : b;
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return mask ? a : b;
}
static inline void vi_store_le_bytes(uint8_t *to,
                                     vi x) { /* the same bytes on a big-endian machine */
    to[0] = (uint8_t)x;
    to[1] = (uint8_t)(x >> 8);
    to[2] = (uint8_t)(x >> 16);
    to[3] = (uint8_t)(x >> 24);
}
VECTOR_UNARY(unsigned, vm_bits, vm, x & 1)
static inline void vf_store_where(vm mask, float *to, vf x) {
    *to = mask ? x : *to;
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    *to = mask ? (int32_t)x : *to;
}
static inline void vf_load_aos4(const void *const from[1], vf x[4]) {
    memcpy(x, from[0], 4 * sizeof *x);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    const vf x[4] = {a, b, c, d};
    memcpy(to, x, sizeof x);
}
static inline void pack_pixels(uint8_t *to, const uint32_t *from) { /* on big-endian machines too */
    for (int i = 0; i < 4; ++i) {
        to[3 * i] = (uint8_t)from[i];
        to[3 * i + 1] = (uint8_t)(from[i] >> 8);
        to[3 * i + 2] = (uint8_t)(from[i] >> 16);
    }
}
static inline void vector_fence(void) {}

#endif
