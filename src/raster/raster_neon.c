/* Rasterisation for neon. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_NEON
#define RASTER_TIER burnish_raster_neon
#include "raster/tier_simd.h"
