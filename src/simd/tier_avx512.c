/* The kernels for avx512. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX512
#define BATCH burnish_kernels_avx512
#define ISA BURNISH_ISA_AVX512
#include "shading/tier_simd.h"
