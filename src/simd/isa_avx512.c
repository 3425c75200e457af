/* The functions for AVX-512: F, DQ, BW and VL. */
#include "simd/isa_ops.h"

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
#define BURNISH_VECTOR_AVX512
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_avx512(void) {
    return &OPS;
}
#else
const burnish_isa_ops *burnish_isa_ops_avx512(void) {
    return NULL;
}
#endif
