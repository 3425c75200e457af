/* Rasterisation for sse2. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_SSE2
#define RASTER_TIER burnish_raster_sse2
#include "raster/tier_simd.h"
