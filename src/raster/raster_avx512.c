/* Rasterisation for avx512. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_AVX512
#define RASTER_TIER burnish_raster_avx512
#include "raster/tier_simd.h"
