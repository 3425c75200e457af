/* One tier: a defined BURNISH_VECTOR_... chooses the vector type, RASTER_TIER names the table. */
#include "raster/geometry_simd.h"
/* needs the vector type and its helpers */
#include "raster/bins_simd.h"
#include "raster/tile_simd.h"

const burnish_raster_tier RASTER_TIER = {.transform = transform_vertices,
                                         .set_up = set_up_triangles,
                                         .list = list_blocks,
                                         .draw = draw_slots,
                                         .find_seen = find_seen,
                                         .find_least = find_least,
                                         .find_pixels = find_shown,
                                         .find_shared = find_shared,
                                         .place = place_points,
                                         .mark = mark_drawn};
