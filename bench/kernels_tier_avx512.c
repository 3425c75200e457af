/* The contenders for avx512. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_AVX512
#define TIER burnish_bench_tier_avx512
#define ISA BURNISH_ISA_AVX512
#define LIBMVEC "_ZGVeN16vv_powf"
#define SLEEF "Sleef_powf16_u10avx512f"
#include "bench/kernels_tier_simd.h"
