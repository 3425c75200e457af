/* The vector type for AArch64's Advanced SIMD: 4 floats. See vector.h for what the operations mean.
 */
#ifndef BURNISH_SIMD_VECTOR_NEON_H
#define BURNISH_SIMD_VECTOR_NEON_H

#include <arm_neon.h>
#include <stdint.h>

#define VECTOR_WORD neon
enum { LANES = 4, VECTOR_ISA = BURNISH_ISA_NEON };
typedef float32x4_t vf;
typedef int32x4_t vi;
typedef uint32x4_t vm;

VECTOR_UNARY(vf, vf_set, float, vdupq_n_f32(x))
VECTOR_UNARY(vf, vf_load, const float *, vld1q_f32(x))
static inline void vf_store(float *to, vf x) {
    vst1q_f32(to, x);
}
static inline void vf_stream(float *to, vf x) {
    vst1q_f32(to, x);
}
VECTOR_BINARY(vf, vf_add, vf, vaddq_f32(a, b))
VECTOR_BINARY(vf, vf_sub, vf, vsubq_f32(a, b))
VECTOR_BINARY(vf, vf_mul, vf, vmulq_f32(a, b))
VECTOR_BINARY(vf, vf_div, vf, vdivq_f32(a, b))
VECTOR_BINARY(vf, vf_max, vf, vbslq_f32(vcgtq_f32(a, b), a, b))
VECTOR_BINARY(vf, vf_min, vf, vbslq_f32(vcltq_f32(a, b), a, b))
VECTOR_BINARY(vm, vf_greater, vf, vcgtq_f32(a, b))
static inline vf vf_and_mask(vm mask, vf x) {
    return vreinterpretq_f32_u32(vandq_u32(mask, vreinterpretq_u32_f32(x)));
}
VECTOR_BINARY(vm, vm_and, vm, vandq_u32(a, b))
VECTOR_BINARY(vm, vm_or, vm, vorrq_u32(a, b))
VECTOR_BINARY(vm, vm_and_not, vm, vbicq_u32(a, b))
VECTOR_UNARY(vm, vm_not, vm, vmvnq_u32(x))
VECTOR_UNARY(int, vm_any, vm, vmaxvq_u32(x) != 0)
VECTOR_UNARY(vi, vi_set, int32_t, vdupq_n_s32(x))
VECTOR_UNARY(vi, vf_bits, vf, vreinterpretq_s32_f32(x))
VECTOR_UNARY(vf, vf_from_bits, vi, vreinterpretq_f32_s32(x))
VECTOR_BINARY(vi, vi_add, vi, vaddq_s32(a, b))
VECTOR_BINARY(vi, vi_sub, vi, vsubq_s32(a, b))
VECTOR_BINARY(vi, vi_and, vi, vandq_s32(a, b))
VECTOR_BINARY(vi, vi_xor, vi, veorq_s32(a, b))
VECTOR_BINARY(vi, vi_or, vi, vorrq_s32(a, b))
#define vi_shl(x, bits) vshlq_n_s32(x, bits)
#define vi_shr(x, bits) vreinterpretq_s32_u32(vshrq_n_u32(vreinterpretq_u32_s32(x), bits))
#define vi_sar(x, bits) vshrq_n_s32(x, bits)
VECTOR_BINARY(vi, vi_mul, vi, vmulq_s32(a, b))
static inline vi vi_dot16(vi a, vi b) {
    int16x8_t x = vreinterpretq_s16_s32(a), y = vreinterpretq_s16_s32(b);
    return vpaddq_s32(vmull_s16(vget_low_s16(x), vget_low_s16(y)), vmull_high_s16(x, y));
}
VECTOR_BINARY(vi, vi_max, vi, vmaxq_s32(a, b))
VECTOR_BINARY(vi, vi_min, vi, vminq_s32(a, b))
static inline vi vi_gather(const int32_t *table, vi index) {
    int32_t lanes[4];
    vst1q_s32(lanes, index);
    for (int i = 0; i < 4; ++i) {
        lanes[i] = table[lanes[i]];
    }
    return vld1q_s32(lanes);
}
static inline vi vi_gather16(const int32_t *table, vi index) {
    return vi_gather(table, index);
}
static inline vi vi_gather_pair(const uint16_t *table, vi index) {
    int32_t lanes[4];
    vst1q_s32(lanes, index);
    for (int i = 0; i < 4; ++i) {
        const uint16_t *pair = table + lanes[i];
        lanes[i] = (int32_t)((uint32_t)pair[0] | (uint32_t)pair[1] << 16);
    }
    return vld1q_s32(lanes);
}
static inline vf vf_gather(const float *table, vi index) {
    int32_t at[4];
    vst1q_s32(at, index);
    const float lanes[4] = {table[at[0]], table[at[1]], table[at[2]], table[at[3]]};
    return vld1q_f32(lanes);
}
VECTOR_UNARY(vf, vf_from_int, vi, vcvtq_f32_s32(x))
VECTOR_UNARY(vi, vi_truncate, vf, vcvtq_s32_f32(x))
static inline vi vi_ramp(int32_t step) {
    const int32_t lanes[4] = {0, 1, 2, 3};
    return vmulq_n_s32(vld1q_s32(lanes), step);
}
VECTOR_UNARY(vi, vi_load, const int32_t *, vld1q_s32(x))
static inline void vi_store(int32_t *to, vi x) {
    vst1q_s32(to, x);
}
VECTOR_UNARY(vm, vi_not_negative, vi, vcgeq_s32(x, vdupq_n_s32(0)))
VECTOR_BINARY(vm, vi_equal, vi, vceqq_s32(a, b))
VECTOR_BINARY(vm, vi_greater, vi, vcgtq_s32(a, b))
static inline vf vf_blend(vm mask, vf a, vf b) {
    return vbslq_f32(mask, a, b);
}
static inline vi vi_blend(vm mask, vi a, vi b) {
    return vbslq_s32(mask, a, b);
}
static inline void vi_store_le_bytes(uint8_t *to, vi x) {
    vst1q_u8(to, vreinterpretq_u8_s32(x));
}
static inline unsigned vm_bits(vm mask) {
    const uint32_t bits[4] = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(mask, vld1q_u32(bits)));
}
static inline void vf_store_where(vm mask, float *to, vf x) {
    vst1q_f32(to, vbslq_f32(mask, x, vld1q_f32(to)));
}
static inline void vi_store_where(vm mask, int32_t *to, vi x) {
    vst1q_s32(to, vbslq_s32(mask, x, vld1q_s32(to)));
}
static inline void vector_transpose(vf a[4]) {
    float32x4x2_t low = vtrnq_f32(a[0], a[1]), high = vtrnq_f32(a[2], a[3]);
    a[0] = vcombine_f32(vget_low_f32(low.val[0]), vget_low_f32(high.val[0]));
    a[1] = vcombine_f32(vget_low_f32(low.val[1]), vget_low_f32(high.val[1]));
    a[2] = vcombine_f32(vget_high_f32(low.val[0]), vget_high_f32(high.val[0]));
    a[3] = vcombine_f32(vget_high_f32(low.val[1]), vget_high_f32(high.val[1]));
}
static inline void vf_load_aos4(const void *const from[4], vf x[4]) {
    for (int i = 0; i < 4; ++i) {
        x[i] = vld1q_f32(from[i]);
    }
    vector_transpose(x);
}
static inline void vf_store_aos4(void *to, vf a, vf b, vf c, vf d) {
    const float32x4x4_t x = {{a, b, c, d}};
    vst4q_f32(to, x);
}
static inline void pack_pixels(uint8_t *to, const uint32_t *from) {
    const uint8_t order[16] = {0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 255, 255, 255, 255};
    vst1q_u8(to, vqtbl1q_u8(vreinterpretq_u8_u32(vld1q_u32(from)), vld1q_u8(order)));
}
static inline void vector_fence(void) {}

#endif
