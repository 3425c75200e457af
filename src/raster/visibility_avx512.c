/* Visibility for avx512. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_AVX512
#define DRAW burnish_visibility_avx512
#include "raster/visibility_body.h"
