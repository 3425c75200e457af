/* Rasterisation for scalar. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_SCALAR
#define RASTER_TIER burnish_raster_scalar
#include "raster/tier_simd.h"
