/* The functions for any processor, one number at a time. */
#include "simd/isa_ops.h"

#if defined(BURNISH_NO_SCALAR) /* where vectors are certain: a third of a WebAssembly module */
const burnish_isa_ops *burnish_isa_ops_scalar(void) {
    return NULL;
}
#else
#define BURNISH_VECTOR_SCALAR
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_scalar(void) {
    return &OPS;
}
#endif
