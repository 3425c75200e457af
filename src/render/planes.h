/* The optional planes of a target: depth, triangle, normal and coverage of each pixel. */
#ifndef BURNISH_RENDER_PLANES_H
#define BURNISH_RENDER_PLANES_H

#include "render/store.h"

/* From a depth of the raster to the distance along the view axis, in the mesh's units:
 * (constant + (1 - depth) slope) / q, q as burnish_rays has it. */
typedef struct burnish_view_distance {
    float constant, slope;
} burnish_view_distance;

/* What planes are written from. */
typedef struct burnish_plane_writer {
    const burnish_output *output;
    const burnish_surface *surface;
    burnish_view_distance distance;
} burnish_plane_writer;

/* Whether the target has any. */
int burnish_target_has_planes(const burnish_target *target);

/* Writes what planes hold where nothing is to all of the tile. weights: of each pixel, see below;
 * becomes 0. */
void burnish_planes_clear(const burnish_plane_writer *writer, const burnish_tile *tile,
                          uint8_t weights[BURNISH_TILE_PIXELS]);

/* Writes what complex pixels show: of a pixel's fragments the one with most samples, of equals the
 * first. weights: samples of the fragment that each pixel shows so far. batch: of the fragments. */
void burnish_planes_add_fragments(const burnish_plane_writer *writer, const burnish_tile *tile,
                                  const burnish_fragments *fragments,
                                  const burnish_fragment_batch *batch,
                                  uint8_t weights[BURNISH_TILE_PIXELS]);

/* Writes what the simple pixels of row `number` show, and the coverage of all. */
void burnish_planes_store_row(const burnish_plane_writer *writer, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels);

#endif
