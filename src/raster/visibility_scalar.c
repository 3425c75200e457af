/* Visibility for scalar. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_SCALAR
#define DRAW burnish_visibility_scalar
#include "raster/visibility_body.h"
