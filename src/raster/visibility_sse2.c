/* Visibility for sse2. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_SSE2
#define DRAW burnish_visibility_sse2
#include "raster/visibility_body.h"
