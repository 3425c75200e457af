/* Planes of a target: depth, triangles, normals and coverage. */
#ifndef BURNISH_RENDER_FRAME_PLANES_H
#define BURNISH_RENDER_FRAME_PLANES_H

#include "render/frame/target.h"

/* Whether a target has planes. */
static inline int burnish_planes_are_wanted(const burnish_target *target) {
    return target->depth || target->triangles || target->normals || target->coverage;
}

/* Writes what planes hold where nothing is to all of the tile; weights become 0. */
void burnish_planes_clear(const burnish_output *output, const burnish_tile *tile,
                          burnish_tile_sums *sums);

/* What fragments show: of a pixel's the one with most samples, of equals the first.
 *   weights  per pixel of the tile, samples of the fragment that planes show so far */
void burnish_planes_store_fragments(const burnish_output *output, const burnish_tile *tile,
                                    const burnish_fragments *fragments,
                                    const burnish_fragment_batch *batch, uint8_t *weights);

/* What the simple pixels of row `number` show, and the coverage of all. */
void burnish_planes_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels);

#endif
