/* The kernels for avx2. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX2
#define BATCH burnish_kernels_avx2
#define ISA BURNISH_ISA_AVX2
#include "shading/tier_simd.h"
