/* The table of raster kernels for the instruction set that BURNISH_VECTOR_... chooses. */
#include "raster/bins_simd.h"
#include "raster/fragments_simd.h"
#include "raster/geometry_simd.h"
#include "raster/maps_simd.h"
#include "raster/raster_ops.h"
#include "raster/tile_simd.h"
#include "simd/isa.h"

#define OP(name) .name = name

extern const burnish_raster_ops BURNISH_ISA_TABLE(burnish_raster_ops, VECTOR_WORD);
const burnish_raster_ops BURNISH_ISA_TABLE(burnish_raster_ops, VECTOR_WORD) = {
    OP(transform_vertices), OP(cull_and_bound), OP(bin_batches),        OP(project_to_maps),
    OP(draw_maps),          OP(draw_tile),      OP(draw_deeper_layers), OP(classify_block_row),
    OP(next_fragments),     OP(mark_drawn),     OP(draw_chosen),
};
