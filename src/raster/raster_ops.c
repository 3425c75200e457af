#include "raster/raster_ops.h"

#define OPS burnish_raster_ops
#include "simd/isa_table.h"
