/* The kernels for sse2. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_SSE2
#define BATCH burnish_kernels_sse2
#define ISA BURNISH_ISA_SSE2
#include "shading/tier_simd.h"
