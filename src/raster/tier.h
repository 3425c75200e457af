/* The functions of src/raster that are compiled for each instruction set. */
#ifndef BURNISH_RASTER_TIER_H
#define BURNISH_RASTER_TIER_H

#include "raster/visibility.h"

/* Places the vertices [first, end) on the screen. */
typedef void burnish_transform_function(burnish_screen_vertices *vertices,
                                        const burnish_raster_view *view, const float *positions,
                                        size_t first, size_t end);

enum { BURNISH_SETUP_BLOCK = 16 }; /* triangles set up at once */

/* Sets up the mesh's triangles [first, first + count), count <= BURNISH_SETUP_BLOCK: item i of
 * triangles is triangle first + i where bit i of the result is set; where bit i of *others is set
 * the triangle must be clipped or is too large for 32-bit edge functions, and is up to the caller.
 */
typedef unsigned burnish_set_up_function(const burnish_screen_vertices *vertices,
                                         const burnish_raster_view *view, const uint32_t *indices,
                                         size_t first, size_t count,
                                         burnish_setup_triangle triangles[BURNISH_SETUP_BLOCK],
                                         unsigned *others);

/* Draws the triangles of a list into a tile, in the list's order. */
typedef void burnish_draw_function(burnish_visibility *visibility, const burnish_geometry *geometry,
                                   const uint32_t *entries, size_t count);

/* Leaves out of a list those triangles that are behind the coarse depth wherever they touch the
 * tile; returns how many are left. */
typedef size_t burnish_find_seen_function(const burnish_visibility *visibility,
                                          const burnish_geometry *geometry, uint32_t *entries,
                                          size_t count);

/* The least depth of each coarse block of a tile. */
typedef void burnish_find_least_function(burnish_visibility *visibility);

/* Finds what the pixels of a strip show. */
typedef void burnish_find_pixels_function(const burnish_visibility *visibility, int strip,
                                          burnish_strip_pixels *pixels);

/* The points of a block's shared pixels: pixel after pixel of its samples. */
typedef struct burnish_shared_points {
    int count;
    uint8_t pixel[BURNISH_FRAGMENT_BLOCK];
    uint16_t samples[BURNISH_FRAGMENT_BLOCK]; /* bits of those that show the triangle */
    int32_t owner[BURNISH_FRAGMENT_BLOCK];
} burnish_shared_points;
typedef void burnish_find_shared_function(const burnish_visibility *visibility, int block,
                                          burnish_shared_points *points);

/* Sets drawn[t] to 1 for each of the mesh's triangles t that own a sample; needs owners. Threads
 * may do so at the same time. */
typedef void burnish_mark_function(const burnish_visibility *visibility, uint8_t *drawn);

struct burnish_raster_tier {
    burnish_transform_function *transform;
    burnish_set_up_function *set_up;
    burnish_draw_function *draw;
    burnish_find_seen_function *find_seen;
    burnish_find_least_function *find_least;
    burnish_find_pixels_function *find_pixels;
    burnish_find_shared_function *find_shared;
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

/* Forgets the triangles that own no sample. */
void burnish_visibility_compact(burnish_visibility *visibility);

#endif
