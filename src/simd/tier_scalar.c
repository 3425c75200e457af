/* The kernels for scalar. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_SCALAR
#define BATCH burnish_kernels_scalar
#define ISA BURNISH_ISA_SCALAR
#include "shading/tier_simd.h"
