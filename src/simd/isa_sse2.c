/* The functions for SSE2, which every x86-64 processor has. */
#include "simd/isa_ops.h"

#if defined(__SSE2__)
#define BURNISH_VECTOR_SSE2
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_sse2(void) {
    return &OPS;
}
#else
const burnish_isa_ops *burnish_isa_ops_sse2(void) {
    return NULL;
}
#endif
