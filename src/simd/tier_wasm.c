/* The kernels for wasm. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_WASM
#define BATCH burnish_kernels_wasm
#define ISA BURNISH_ISA_WASM
#include "shading/tier_simd.h"
