/* How an image is divided into tiles and a tile into blocks and HiZ cells, and the order of pixels
 * in a tile's memory. */
#ifndef BURNISH_RASTER_TILE_LAYOUT_H
#define BURNISH_RASTER_TILE_LAYOUT_H

#include "raster/raster_view.h"

enum {
    BURNISH_TILE_SIZE = 64, /* pixels along a tile's edge */
    BURNISH_TILE_PIXELS = BURNISH_TILE_SIZE * BURNISH_TILE_SIZE,
    BURNISH_MAX_TILES = 256, /* along an image's edge */

    BURNISH_HIZ_BITS = 3,
    BURNISH_HIZ_PIXELS = 1 << BURNISH_HIZ_BITS,                /* along a HiZ cell's edge */
    BURNISH_HIZ_SIZE = BURNISH_TILE_SIZE / BURNISH_HIZ_PIXELS, /* cells along a tile's edge */

    BURNISH_BLOCK_BITS = 2,
    BURNISH_BLOCK_SIZE = 1 << BURNISH_BLOCK_BITS, /* pixels along a block's edge */
    BURNISH_BLOCK_PIXELS = BURNISH_BLOCK_SIZE * BURNISH_BLOCK_SIZE,
    BURNISH_TILE_BLOCKS = BURNISH_TILE_SIZE / BURNISH_BLOCK_SIZE, /* along a tile's edge */
    BURNISH_BLOCK_ROW_PIXELS = BURNISH_TILE_SIZE * BURNISH_BLOCK_SIZE
};

/* The tile part of a HiZ cell's packed coordinates. */
#define BURNISH_HIZ_TILE_MASK (~((BURNISH_HIZ_SIZE - 1) * BURNISH_PACK(1, 1)))

/* A tile's pixels are stored block by block and block row by block row, so 4, 8 or 16 neighbours in
 * a block form a vector. */
static inline int burnish_pixel_index(int x, int y) {
    const unsigned u = (unsigned)x, v = (unsigned)y;
    const unsigned block = v / BURNISH_BLOCK_SIZE * BURNISH_TILE_BLOCKS + u / BURNISH_BLOCK_SIZE;
    return (int)(block * BURNISH_BLOCK_PIXELS + v % BURNISH_BLOCK_SIZE * BURNISH_BLOCK_SIZE +
                 u % BURNISH_BLOCK_SIZE);
}
static inline int burnish_pixel_x(int pixel) {
    const unsigned i = (unsigned)pixel;
    return (int)(i / BURNISH_BLOCK_PIXELS % BURNISH_TILE_BLOCKS * BURNISH_BLOCK_SIZE +
                 i % BURNISH_BLOCK_SIZE);
}
static inline int burnish_pixel_y(int pixel) {
    const unsigned i = (unsigned)pixel;
    return (int)(i / BURNISH_BLOCK_ROW_PIXELS * BURNISH_BLOCK_SIZE +
                 i / BURNISH_BLOCK_SIZE % BURNISH_BLOCK_SIZE);
}

/* Index of sample s of a pixel in depths and ids: within a block's samples, sample s is s blocks
 * after sample 0. */
static inline int burnish_sample_index(int samples, int pixel, int s) {
    return (pixel & ~(BURNISH_BLOCK_PIXELS - 1)) * samples + s * BURNISH_BLOCK_PIXELS +
           (pixel & (BURNISH_BLOCK_PIXELS - 1));
}

#endif
