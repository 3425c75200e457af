/* The small vector type that every kernel body is written over. A tier's source defines one
 * BURNISH_VECTOR_... and includes the bodies; each tier's header gives the same operations:
 *
 *   LANES       floats in a vector
 *   vf, vi, vm  floats, 32-bit integers, a mask a lane
 *   vf_max      a > b ? a : b, and vf_min a < b ? a : b: b where one of them is NaN or both are
 *               zeros, on every tier (x86's own rule; the others' maximum differs)
 *   vf_keep     x where the mask holds, +0 elsewhere
 *   vf_bits, vi_float  the same 32 bits under the other type
 *   vi_left, vi_right, vi_right_signed  shifts by a constant
 *   vi_mul      the low 32 bits; vi_max, vi_min of signed numbers
 *   vi_dot16    the product of the lower 16-bit halves plus that of the upper ones, signed
 *   vi_convert  integers to floats, to nearest even
 *   vi_store    four bytes a lane, the lowest first; vi_load, vi_save whole integers
 *   vi_gather   table[index] a lane
 *   vi_ramp     0, step, 2 step ... a lane
 *   vf_blend, vi_blend  a where the mask holds, b elsewhere
 *   vf_store_where, vi_save_where  stores where the mask holds and leaves the rest of a vector's
 *               memory as it is
 *   vm_bits     the mask as a number: bit i is lane i
 *   vf_load_records   item i of the record at from[lane], four floats each, in lane `lane` of x[i]
 *   vf_store_records  the other way round, LANES records of four one after another
 *   pack_pixels three bytes of each of 4 pixels, the lowest first; may write 16 bytes
 *   vf_stream, vi_stream  stores past the caches to aligned places, for what vector_fence then
 *               orders; plain stores where there are none
 *
 * There is no fused multiply-add, no approximate reciprocal and no horizontal sum, so a lane's
 * result has the same bits in every tier. */
#ifndef BURNISH_SIMD_VECTOR_H
#define BURNISH_SIMD_VECTOR_H

#if defined(BURNISH_VECTOR_AVX512)
#include "simd/vector_avx512.h"
#elif defined(BURNISH_VECTOR_AVX2)
#include "simd/vector_avx2.h"
#elif defined(BURNISH_VECTOR_SSE2)
#include "simd/vector_sse2.h"
#elif defined(BURNISH_VECTOR_NEON)
#include "simd/vector_neon.h"
#elif defined(BURNISH_VECTOR_WASM)
#include "simd/vector_wasm.h"
#else
#include "simd/vector_scalar.h"
#endif

#define BURNISH_INLINE static inline __attribute__((always_inline))

#endif
