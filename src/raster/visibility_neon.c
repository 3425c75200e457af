/* Visibility for neon. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_NEON
#define DRAW burnish_visibility_neon
#include "raster/visibility_body.h"
