/* The contenders for sse2. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_SSE2
#define TIER burnish_bench_tier_sse2
#define ISA BURNISH_ISA_SSE2
#define LIBMVEC "_ZGVbN4vv_powf"
#define SLEEF "Sleef_powf4_u10sse2"
#include "bench/kernels_tier_simd.h"
