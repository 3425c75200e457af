/* The functions for AVX2. */
#include "simd/isa_ops.h"

#if defined(__AVX2__)
#define BURNISH_VECTOR_AVX2
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_avx2(void) {
    return &OPS;
}
#else
const burnish_isa_ops *burnish_isa_ops_avx2(void) {
    return NULL;
}
#endif
