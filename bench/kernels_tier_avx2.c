/* The contenders for avx2. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX2
#define TIER burnish_bench_tier_avx2
#define ISA BURNISH_ISA_AVX2
#define LIBMVEC "_ZGVdN8vv_powf"
#define SLEEF "Sleef_powf8_u10avx2"
#include "bench/kernels_tier_simd.h"
