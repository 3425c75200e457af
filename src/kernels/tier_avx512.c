/* The kernels for avx512. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX512
#define BATCH burnish_batch_avx512
#define ISA BURNISH_ISA_AVX512
#include "kernels/tier_body.h"
