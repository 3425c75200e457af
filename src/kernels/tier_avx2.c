/* The kernels for avx2. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX2
#define BATCH burnish_batch_avx2
#define ISA BURNISH_ISA_AVX2
#include "kernels/tier_body.h"
