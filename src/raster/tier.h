/* The functions of src/raster that are compiled for each instruction set. */
#ifndef BURNISH_RASTER_TIER_H
#define BURNISH_RASTER_TIER_H

#include "raster/tile.h"

/* Places the vertices [first, end) on the screen. */
typedef void burnish_transform_function(burnish_screen_vertices *vertices,
                                        const burnish_raster_view *view, const float *positions,
                                        size_t first, size_t end);

/* Sets up the mesh's triangles [first, first + count), count <= BURNISH_BATCH_SIZE; returns how
 * many of them may be seen. Where bit i of *others is set, triangle first + i must be clipped or is
 * too large for 32-bit edge functions, and is up to the caller. */
typedef int burnish_set_up_function(const burnish_screen_vertices *vertices,
                                    const burnish_raster_view *view, const uint32_t *indices,
                                    size_t first, size_t count, burnish_triangle_batch *block,
                                    burnish_batch_header *head, unsigned *others);

/* Adds the triangles of the blocks [first, end) to a slice's lists. Stops early where that is more
 * pieces than the limit, or with the slice's status set. */
typedef void burnish_list_function(const burnish_bins *bins, burnish_bin_slice *slice,
                                   const burnish_geometry *geometry, size_t first, size_t end,
                                   size_t limit);

/* Draws the triangles of some slots into a tile, in their order; all are seen from one side. */
typedef void burnish_draw_function(burnish_tile *tile, const burnish_geometry *geometry,
                                   const uint32_t *slots, size_t count, unsigned back);

/* Leaves out of a list those triangles that are behind the coarse depth wherever they touch the
 * tile; returns how many entries are left. */
typedef size_t burnish_find_seen_function(const burnish_tile *tile,
                                          const burnish_geometry *geometry,
                                          burnish_bin_entry *entries, size_t count);

/* The least depth of each coarse block of a tile. */
typedef void burnish_find_least_function(burnish_tile *tile);

/* Finds what the pixels of a strip show. */
typedef void burnish_find_pixels_function(const burnish_tile *tile, int strip,
                                          burnish_block_row *pixels);

/* The points of a block's shared pixels: pixel after pixel of its samples. */
typedef struct burnish_shared_points {
    int count;
    uint8_t pixel[BURNISH_FRAGMENT_BATCH];
    uint16_t samples[BURNISH_FRAGMENT_BATCH]; /* bits of those that show the triangle */
    int32_t id[BURNISH_FRAGMENT_BATCH];
} burnish_shared_points;
typedef void burnish_find_shared_function(const burnish_tile *tile, int block,
                                          burnish_shared_points *points);

/* Points of shared pixels before they are placed. */
typedef struct burnish_sample_points {
    int count;
    int32_t id[BURNISH_FRAGMENT_BATCH];
    int32_t x[BURNISH_FRAGMENT_BATCH], y[BURNISH_FRAGMENT_BATCH]; /* 1/256 pixel from the tile's
                                                                     corner */
} burnish_sample_points;

/* Finds weights, and places where they are wanted, of points. Items behind the last one may be
 * written. */
typedef void burnish_place_function(const burnish_tile *tile, const burnish_raster_view *view,
                                    const burnish_sample_points *points,
                                    burnish_fragments *fragments);

/* Sets drawn[t] to 1 for each of the mesh's triangles t that own a sample; needs ids. Threads
 * may do so at the same time. */
typedef void burnish_mark_function(const burnish_tile *tile, uint8_t *drawn);

struct burnish_raster_tier {
    burnish_transform_function *transform;
    burnish_set_up_function *set_up;
    burnish_list_function *list;
    burnish_draw_function *draw;
    burnish_find_seen_function *find_seen;
    burnish_find_least_function *find_least;
    burnish_find_pixels_function *find_pixels;
    burnish_find_shared_function *find_shared;
    burnish_place_function *place;
    burnish_mark_function *mark;
};

extern const burnish_raster_tier burnish_raster_scalar;
#if defined(__SSE2__)
extern const burnish_raster_tier burnish_raster_sse2;
extern const burnish_raster_tier burnish_raster_avx2;
extern const burnish_raster_tier burnish_raster_avx512;
#endif
#if defined(__aarch64__)
extern const burnish_raster_tier burnish_raster_neon;
#endif

/* Longest edge, in 1/256 pixel along an axis, whose functions fit 32 bits all over a tile that the
 * triangle touches: 2 * 24576 * (24576 + 64 * 256) < 2^31. */
enum { BURNISH_SMALL_EDGE = 96 * BURNISH_SUBPIXELS };

/* No triangle is that far away. */
#define BURNISH_FARTHEST -1e30f

/* The bits of a coarse block's place, x and in the upper half y, that tell its tile. */
#define BURNISH_TILE_BITS (~((BURNISH_HIZ_SIZE - 1) * 0x10001u))

/* Tiles from one to the other, both inclusive. */
typedef struct burnish_tile_box {
    int column0, row0, column1, row1;
} burnish_tile_box;

/* The tiles that a triangle's bounds touch. */
static inline burnish_tile_box burnish_tile_box_of(const burnish_triangle_batch *block,
                                                   unsigned lane) {
    const uint32_t first = block->first[lane], last = block->last[lane];
    return (burnish_tile_box){
        (int)((first & 0xffff) / BURNISH_HIZ_SIZE), (int)((first >> 16) / BURNISH_HIZ_SIZE),
        (int)((last & 0xffff) / BURNISH_HIZ_SIZE), (int)((last >> 16) / BURNISH_HIZ_SIZE)};
}

/* Starts another piece of a chain, whose last one is full. */
burnish_status burnish_list_start_piece(burnish_bin_slice *slice, burnish_tile_list *chain);

/* Forgets the triangles that own no sample. */
void burnish_tile_evict_hidden(burnish_tile *tile);

#endif
