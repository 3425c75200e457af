/* The interface from a tile to shading: block rows, whose simple pixels are already in the tile's
 * planes, and fragments of complex pixels.
 *
 * A pixel is simple when all its samples show one triangle, which then is shaded at the pixel's
 * centre. In a complex pixel all samples that show one triangle are one fragment, shaded at the
 * mean of the samples' positions, which lies inside the triangle. */
#ifndef BURNISH_RASTER_FRAGMENTS_H
#define BURNISH_RASTER_FRAGMENTS_H

#include "raster/tile.h"

enum { BURNISH_FRAGMENT_BATCH = 256 }; /* handed over at once: their arrays stay in L1 */
_Static_assert(BURNISH_BLOCK_PIXELS *BURNISH_MAX_SAMPLES <= BURNISH_FRAGMENT_BATCH,
               "a block's fragments fit");

typedef struct burnish_fragments {
    int count;
    uint16_t pixels[BURNISH_FRAGMENT_BATCH];  /* index in the tile */
    uint8_t weight[BURNISH_FRAGMENT_BATCH];   /* samples */
    uint16_t samples[BURNISH_FRAGMENT_BATCH]; /* bit s: sample s is one of them */
    burnish_primitive primitives[BURNISH_FRAGMENT_BATCH];
    float x[BURNISH_FRAGMENT_BATCH]; /* pixels from the image's centre, right */
    float y[BURNISH_FRAGMENT_BATCH]; /* up */
    float depth[BURNISH_FRAGMENT_BATCH];
    /* screen-space barycentric weights of vertices 1 and 2; of points: where in the disc, right and
       up from its centre in units of its radius */
    float weight1[BURNISH_FRAGMENT_BATCH], weight2[BURNISH_FRAGMENT_BATCH];
} burnish_fragments;

/* What the pixels of a block row show. */
typedef struct burnish_block_row {
    /* >= 0 where the pixel is simple, -1 elsewhere; with several samples the index of its
     * primitive */
    int32_t simple[BURNISH_BLOCK_ROW_PIXELS];
    /* bit i of x: a sample of pixel i of block x shows a triangle */
    uint16_t covered[BURNISH_TILE_BLOCKS];
} burnish_block_row;

/* burnish_primitive.id_and_facing of a simple pixel; needs ids.
 *   row, pixel  block row, and index of the pixel in it
 *   simple      the pixel's item of burnish_block_row.simple */
static inline uint32_t burnish_tile_id_and_facing(const burnish_tile *tile, int row, int pixel,
                                                  int32_t simple) {
    return tile->options.samples == 1
               ? (uint32_t)tile->buffer.ids[row * BURNISH_BLOCK_ROW_PIXELS + pixel]
               : tile->primitives.primitives[simple].id_and_facing;
}

#endif
