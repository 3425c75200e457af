/* Layers of transparent triangles: what a tile's samples show in front of its opaque triangles.
 *
 * A tile is drawn from its opaque triangles first. Then each sample collects the transparent
 * triangles that are nearer, in the order of their depths, of equals in the order in which they are
 * drawn: front-facing ones first. A layer has the depth that its triangle would have if it were
 * opaque, so triangles can intersect. */
#ifndef BURNISH_RASTER_LAYERS_H
#define BURNISH_RASTER_LAYERS_H

#include "raster/fragments.h"

/* The nearest layer that has not been handed over. Start from all zero. */
typedef struct burnish_layer_cursor {
    int layer, pixel;
    int is_begun;
    uint8_t deepest[BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS]; /* most layers of a block's samples
                                                                 */
} burnish_layer_cursor;

/* Hands over fragments of a drawn tile's layers: the nearest layer of every sample, then the next
 * one; all samples of a pixel that show one triangle in the same layer are one fragment. Returns 0
 * at the end. Needs positions where the tile's options do. */
int burnish_layers_next(const burnish_tile *tile, const burnish_raster_view *view,
                        const burnish_geometry *geometry, burnish_layer_cursor *cursor,
                        burnish_fragments *fragments);

/* Call it after the last layer. Prepares the tile for the layers that did not fit. Returns 0 if all
 * did, or if no pass is left. Then draw_deeper_layers collects them, to be handed over from the
 * start.
 *   through  per sample: the share of light that passes through its layers so far
 *   channel  floats from the shares of a channel to those of the next one; 0: all are the same
 *   least    samples that let no more through have had all that matters
 *   passes   [1, BURNISH_LAYER_PASSES], the first one included */
int burnish_layers_deeper(burnish_tile *tile, const float *through, size_t channel, float least,
                          int passes);

#endif
