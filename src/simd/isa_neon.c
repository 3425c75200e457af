/* The functions for AArch64's Advanced SIMD. */
#include "simd/isa_ops.h"

#if defined(__aarch64__)
#define BURNISH_VECTOR_NEON
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_neon(void) {
    return &OPS;
}
#else
const burnish_isa_ops *burnish_isa_ops_neon(void) {
    return NULL;
}
#endif
