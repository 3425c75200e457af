/* Rasterisation for avx2. Compiled with that instruction set's flags (cmake/tiers.cmake). */
#define BURNISH_VECTOR_AVX2
#define RASTER_TIER burnish_raster_avx2
#include "raster/geometry_body.h"
/* needs the vector type */
#include "raster/visibility_body.h"

const burnish_raster_tier RASTER_TIER = {.transform = transform_vertices,
                                         .set_up = set_up_triangles,
                                         .draw = draw_list,
                                         .find_seen = find_seen,
                                         .find_least = find_least,
                                         .find_pixels = find_shown,
                                         .find_shared = find_shared,
                                         .mark = mark_drawn};
