/* Visibility for avx2. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_AVX2
#define DRAW burnish_visibility_avx2
#include "raster/visibility_body.h"
