/* The functions for WebAssembly's SIMD128. */
#include "simd/isa_ops.h"

#if defined(__wasm_simd128__)
#define BURNISH_VECTOR_WASM
#include "simd/isa_simd.h"

const burnish_isa_ops *burnish_isa_ops_wasm(void) {
    return &OPS;
}
#else
const burnish_isa_ops *burnish_isa_ops_wasm(void) {
    return NULL;
}
#endif
