/* Layers of transparent triangles: what a tile's samples show in front of its opaque triangles.
 *
 * A tile is drawn from its opaque triangles first. Then each sample collects the transparent
 * triangles that are nearer, in the order of their depths, of equals in the order in which they are
 * drawn: front-facing ones first. Depths are those that the triangles would have if they were
 * opaque, so that triangles may pierce each other. */
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
 * when there are no more. Needs positions where the tile's options do. */
int burnish_layers_next(const burnish_tile *tile, const burnish_raster_view *view,
                        const burnish_geometry *geometry, burnish_layer_cursor *cursor,
                        burnish_fragments *fragments);

/* After the last layer has been handed over: prepares the tile for those that were too many, and
 * returns 0 where there are none, or no pass is left. Then draw_deeper_layers collects them, to be
 * handed over from the start.
 *   through  per sample: what passes of the light behind its layers so far
 *   least    samples that let no more through have had all that matters
 *   passes   [1, BURNISH_LAYER_PASSES], the first one included */
int burnish_layers_deeper(burnish_tile *tile, const float *through, float least, int passes);

#endif
