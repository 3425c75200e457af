/* The functions for any processor, one number at a time. */
#define BURNISH_VECTOR_SCALAR
#include "simd/isa_ops.h"
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_scalar(void) {
    return &OPS;
}
