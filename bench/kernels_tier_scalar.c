/* The contenders for scalar. Compiled with that instruction set's flags (CMakeLists.txt). */
#define BURNISH_VECTOR_SCALAR
#define TIER burnish_bench_tier_scalar
#define ISA BURNISH_ISA_SCALAR
#define LIBMVEC NULL
#define SLEEF "Sleef_powf_u10"
#include "bench/kernels_tier_simd.h"
