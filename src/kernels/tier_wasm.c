/* The kernels for wasm. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_WASM
#define BATCH burnish_batch_wasm
#define ISA BURNISH_ISA_WASM
#include "kernels/tier_body.h"
