/* The rasteriser's kernels, compiled once per instruction set (raster_isa.c): a table of functions,
 * each signature declared here and nowhere else. A field has the name of its template, which is in
 * a file ..._simd.h of this folder. */
#ifndef BURNISH_RASTER_RASTER_OPS_H
#define BURNISH_RASTER_RASTER_OPS_H

#include "raster/bins.h"
#include "raster/fragments.h"
#include "raster/maps.h"
#include "simd/isa.h"

struct burnish_raster_ops {
    /* ---- A frame ---- */

    /* Transforms the vertices [first, end) to the screen. */
    void (*transform_vertices)(struct burnish_screen_vertices *vertices,
                               const struct burnish_raster_view *view, const float *positions,
                               size_t first, size_t end);

    /* Culls `count` <= BURNISH_BATCH_SIZE triangles, 3 indices each, and computes depth and bounds
     * of the potentially visible ones. Returns how many there are. Bit i of *clipped is set where
     * triangle i must be clipped first. */
    int (*cull_and_bound)(const struct burnish_screen_vertices *vertices,
                          const struct burnish_raster_view *view, const uint32_t *indices,
                          size_t count, struct burnish_triangle_batch *batch,
                          struct burnish_batch_header *header, unsigned *clipped);

    /* Appends the triangles of the batches [first, end) to a slice's tile lists. Returns where it
     * stopped: end, or the batch for which the slice has too few chunks. To be called again from
     * there when it has more: what that batch has already added is not added twice. */
    size_t (*bin_batches)(const struct burnish_bins *bins, struct burnish_bin_slice *slice,
                          const struct burnish_geometry *geometry, size_t first, size_t end);

    /* ---- Depth maps ---- */

    /* Projects `count` positions by a view per pair of maps, which have one size and origin and are
     * parallel projections in which the mesh fits. */
    void (*project_to_maps)(const struct burnish_raster_view *views, const float *positions,
                            size_t count, const struct burnish_maps *maps);

    /* Draws the triangles over what is in the maps. */
    void (*draw_maps)(struct burnish_maps *maps);

    /* ---- A tile ---- */

    /* Draws the lists of the tile (column, row) into it. */
    void (*draw_tile)(struct burnish_tile *tile, const struct burnish_geometry *geometry,
                      const struct burnish_bins *bins, int column, int row);

    /* Collects the layers of the tile (column, row), which has been drawn, or those behind. */
    void (*draw_deeper_layers)(struct burnish_tile *tile, const struct burnish_geometry *geometry,
                               const struct burnish_bins *bins, int column, int row);

    /* Draws of the tile's transparent triangles what layers->chosen names, each where it is. */
    void (*draw_chosen)(struct burnish_tile *tile, const struct burnish_geometry *geometry,
                        const struct burnish_bins *bins, int column, int row);

    /* Finds which pixels of a block row are covered, and which of them are simple. */
    void (*classify_block_row)(const struct burnish_tile *tile, int row,
                               struct burnish_block_row *pixels);

    /* The next fragments of the tile's complex pixels, from block *next_block on, which becomes
     * where to go on: 0 at first. Returns 0 when there are none left; with one sample per pixel
     * there are none. May write up to LANES - 1 items past the last one. */
    int (*next_fragments)(const struct burnish_tile *tile, const struct burnish_raster_view *view,
                          int *next_block, struct burnish_fragments *fragments);

    /* Sets drawn[t] to 1 for each of the mesh's triangles t that a sample shows; needs ids. Several
     * threads may do so at the same time. */
    void (*mark_drawn)(const struct burnish_tile *tile, uint8_t *drawn);
};

/* The table of an instruction set; NULL if this build does not have it. */
const burnish_raster_ops *burnish_raster_ops_for(burnish_isa isa);

#endif
