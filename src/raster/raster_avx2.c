/* Rasterisation for avx2. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_AVX2
#define RASTER_TIER burnish_raster_avx2
#include "raster/tier_simd.h"
