/* Visibility of a tile by vectors over a row, compiled for each instruction set like src/kernels.
 * What comes out is, bit for bit, what test/reference_tile.h computes in the plainest way.
 *
 * A sample belongs to the triangle that is nearest there; of two at the same depth to the one seen
 * from its front, then to the first. */
#ifndef BURNISH_RASTER_VISIBILITY_H
#define BURNISH_RASTER_VISIBILITY_H

#include "raster/raster.h"

/* A triangle that owns, or owned, a sample of the tile. Coordinates are 1/256 pixel from the tile's
 * corner; edge function i at (x, y) is dx[i - 1] y - dy[i - 1] x + constant[i - 1], i = 1, 2. */
typedef struct burnish_tile_triangle {
    int64_t constant[2];
    int32_t dx[2], dy[2];
    float inverse_area;
    float depth[3]; /* of vertex 0; of 1 and 2 minus that */
    burnish_corners corners;
} burnish_tile_triangle;

enum {
    /* Triangles that a tile remembers before it forgets those that own nothing any more. */
    BURNISH_TILE_TRIANGLES = 2 * BURNISH_TILE_PIXELS,
    BURNISH_TILE_BLOCK = 8, /* pixels along the edge of a block of the coarse depth */
    BURNISH_TILE_BLOCKS = BURNISH_TILE_SIZE / BURNISH_TILE_BLOCK
};

/* A tile while it is drawn. Plane s of `owners` and `depths` holds sample s of every pixel. */
typedef struct burnish_visibility {
    int x, y, width, height; /* pixels; narrower at the image's right and lower edge */
    int samples;
    int needs_place; /* 1: points get places: x, y and depth */
    int32_t *owners; /* index into triangles, -1 for none */
    float *depths;
    float *weights[2]; /* of vertices 1 and 2 at each pixel; NULL with more than one sample */
    burnish_tile_triangle *triangles;
    int32_t *places; /* one a triangle: scratch while drawing, then 1 where it has a point */
    size_t triangle_count, triangle_capacity;
    float coarse[BURNISH_TILE_BLOCKS][BURNISH_TILE_BLOCKS]; /* least depth of each block */
    int next_pixel; /* where burnish_visibility_next goes on */
} burnish_visibility;

burnish_status burnish_visibility_create(burnish_visibility *visibility, int samples,
                                         burnish_error *error);
void burnish_visibility_destroy(burnish_visibility *visibility);

/* Draws the triangles of a list, in its order. covered: 1 when the list is drawn over others whose
 * coarse depth is known. */
typedef void burnish_visibility_function(burnish_visibility *visibility,
                                         const burnish_geometry *geometry, const uint32_t *entries,
                                         size_t count, int covered);

extern burnish_visibility_function burnish_visibility_scalar;
#if defined(__SSE2__)
extern burnish_visibility_function burnish_visibility_sse2;
extern burnish_visibility_function burnish_visibility_avx2;
extern burnish_visibility_function burnish_visibility_avx512;
#endif
#if defined(__aarch64__)
extern burnish_visibility_function burnish_visibility_neon;
#endif

/* Makes the tile (column, row) current and draws its triangles. Returns 0 when no triangle's bounds
 * touch it. */
int burnish_visibility_draw(burnish_visibility *visibility, burnish_visibility_function *draw,
                            const burnish_raster_view *view, const burnish_geometry *geometry,
                            const burnish_bins *bins, int column, int row);

/* The next block of the visible points of pixels that are not one triangle's alone: all samples of
 * a pixel that show the same triangle are one point, at the mean of the samples, which lies inside
 * the triangle. Returns 0 when there is none left; with one sample a pixel there are none. */
int burnish_visibility_next(burnish_visibility *visibility, const burnish_raster_view *view,
                            burnish_fragments *fragments);

/* The pixels of a row that are one triangle's alone. */
typedef struct burnish_whole_row {
    const int32_t *owners; /* BURNISH_TILE_SIZE: index into triangles, -1 for none */
    const float
        *weights[2];     /* of vertices 1 and 2 at the pixel's centre, where there is an owner */
    const float *depths; /* there, where there is an owner and points get places */
    int32_t own_owners[BURNISH_TILE_SIZE]; /* what the above point to, unless to the tile's */
    float own_weights[2][BURNISH_TILE_SIZE], own_depths[BURNISH_TILE_SIZE];
} burnish_whole_row;

/* Finds them in row y of the tile. */
void burnish_visibility_row(const burnish_visibility *visibility, int y, burnish_whole_row *row);

/* Sets drawn[t] to 1 for each of the mesh's triangles t that had a point so far. Threads may do so
 * at the same time. */
void burnish_visibility_mark(const burnish_visibility *visibility, uint8_t *drawn);

/* Forgets the triangles that own no sample. For visibility_body.h. */
void burnish_visibility_compact(burnish_visibility *visibility);

#endif
