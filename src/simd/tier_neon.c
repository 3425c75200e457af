/* The kernels for neon. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_NEON
#define BATCH burnish_kernels_neon
#define ISA BURNISH_ISA_NEON
#include "shading/tier_simd.h"
