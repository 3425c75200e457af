/* The vector type that every template (*_simd.h) is written over. BURNISH_VECTOR_... chooses the
 * instruction set; without it, the compiler's flags do. Each has the same operations:
 *
 *   LANES                floats per vector
 *   VECTOR_ISA, VECTOR_WORD  the instruction set: as an enumerator, and its word for names
 *   vf, vi, vm           floats, 32-bit integers, one truth value per lane
 *
 *   vf_set, vi_set       one number in all lanes; vi_ramp: 0, step, 2 step ...
 *   vf_load, vi_load     from unaligned memory, as are the stores
 *   vf_store, vi_store   vf_store_where, vi_store_where: only where the mask holds; the rest of the
 *                        vector's memory keeps its contents, but may be written
 *   vi_store_le_bytes    four bytes per lane, the lowest first
 *   vf_stream            past the caches, to an aligned address; vector_fence orders what follows
 *   vf_gather, vi_gather table[index] per lane
 *   vi_gather_near       the same, faster for near indices; may read LANES items around them
 *   vi_gather16          table[index] for a table of 16 numbers, index in [0, 15]
 *   vi_gather_pair       table[index] in the low half, table[index + 1] in the high half
 *   vf_load_aos4         x[i] = number i of the four floats at from[lane]: an array of structures
 *   vf_store_aos4        the reverse, LANES structures one after another
 *
 *   vf_add, vf_sub, vf_mul, vf_div
 *   vf_max, vf_min       a > b ? a : b, a < b ? a : b: b where one is NaN or both are zeros (x86's
 *                        rule; other processors' own maximum differs)
 *   vf_greater           a > b, false for NaN
 *   vf_and_mask          x where the mask holds, +0 elsewhere
 *   vf_blend, vi_blend   a where the mask holds, b elsewhere
 *   vf_bits, vf_from_bits  the same 32 bits as the other type
 *   vf_from_int          rounded to nearest even; vi_truncate: toward 0, of what fits 32 bits
 *
 *   vi_permute           x[index] per lane, index below LANES
 *   vi_compress          stores the lanes that bits select one after another; returns how many; may
 *                        write a vector's memory
 *
 *   vi_shuffle_bytes     with AVX2 and AVX-512: byte order[i] of 16 bytes, 0 where that is negative
 *
 *   vi_add, vi_sub, vi_and, vi_or, vi_xor; vi_mul: the low 32 bits
 *   vi_shl, vi_shr, vi_sar  shifts by a constant: left, right, right with the sign
 *   vi_max, vi_min, vi_equal, vi_greater, vi_not_negative  of signed numbers
 *   vi_dot16             low half times low half plus high half times high half, signed 16 bits
 * each
 *
 *   vm_and, vm_or, vm_not, vm_and_not  a & b, a | b, ~a, a & ~b
 *   vm_any               whether it holds in any lane
 *   vm_bits              bit i is lane i; higher bits are 0
 *
 *   pack_pixels          the three low bytes of each of 4 pixels; may write 16 bytes
 *
 * There is no fused multiply-add, no approximate reciprocal and no horizontal sum, so a lane's
 * result has the same bits for every instruction set. */
#ifndef BURNISH_SIMD_VECTOR_H
#define BURNISH_SIMD_VECTOR_H

#include "base/arithmetic.h"
#include "burnish/core.h"

#define BURNISH_INLINE static inline __attribute__((always_inline))

/* An operation in a row: its result, name, type of x, or of a and b, and value. */
#define VECTOR_UNARY(result, name, of, ...)                                                        \
    static inline result name(of x) {                                                              \
        return __VA_ARGS__;                                                                        \
    }
#define VECTOR_BINARY(result, name, of, ...)                                                       \
    static inline result name(of a, of b) {                                                        \
        return __VA_ARGS__;                                                                        \
    }

#if defined(BURNISH_VECTOR_SCALAR)
#include "simd/vector_scalar.h"
#elif defined(BURNISH_VECTOR_AVX512)
#include "simd/vector_avx512.h"
#elif defined(BURNISH_VECTOR_AVX2) || (defined(__AVX2__) && !defined(BURNISH_VECTOR_SSE2))
#include "simd/vector_avx2.h"
#elif defined(BURNISH_VECTOR_SSE2) || defined(__SSE2__)
#include "simd/vector_sse2.h"
#elif defined(BURNISH_VECTOR_NEON) || defined(__aarch64__)
#include "simd/vector_neon.h"
#elif defined(BURNISH_VECTOR_WASM) || defined(__wasm_simd128__)
#include "simd/vector_wasm.h"
#else
#include "simd/vector_scalar.h"
#endif

#if !defined(VECTOR_HAS_PERMUTE)
/* The other instruction sets go through memory. */
#define vi_gather_near vi_gather
static inline vi vi_permute(vi x, vi index) {
    int32_t lanes[LANES];
    vi_store(lanes, x);
    return vi_gather(lanes, index);
}
static inline int vi_compress(unsigned bits, int32_t *to, vi x) {
    int32_t lanes[LANES];
    int count = 0;
    if (bits) { /* rarely */
        vi_store(lanes, x);
    }
    for (; bits; bits &= bits - 1) {
        to[count++] = lanes[__builtin_ctz(bits)];
    }
    return count;
}
#endif

/* For every instruction set. */
BURNISH_INLINE vi vi_magnitude(vi x) {
    return vi_max(x, vi_sub(vi_set(0), x));
}

BURNISH_INLINE vm vi_not_zero(vi x) {
    return vm_not(vi_equal(x, vi_set(0)));
}

#endif
