/* The contenders for neon. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_NEON
#define TIER burnish_bench_tier_neon
#define ISA BURNISH_ISA_NEON
#define LIBMVEC "_ZGVnN4vv_powf"
#define SLEEF "Sleef_powf4_u10advsimd"
#include "bench/kernels_tier_simd.h"
