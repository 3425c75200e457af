/* Rasterisation: triangles in, visible points out. Knows nothing of light, materials or files.
 *
 * Data flow:
 *   positions -> burnish_transform_vertices -> screen vertices (fixed point, 1/w, depth)
 *             -> burnish_setup_triangles    -> oriented, clipped, culled triangles
 *             -> burnish_bin_tiles          -> triangle lists per tile, one band of tiles at a time
 *             -> burnish_visibility_draw    -> nearest triangle of every sample of a tile
 *             -> burnish_visibility_row     -> pixels that are one triangle's alone, in place
 *             -> burnish_visibility_next    -> points of the others, ready to be shaded
 *
 * Screen space: x right, y down, 1/256 pixel, the origin at the image's top left corner; depth
 * grows toward the viewer. Coverage is integer and exact: a sample on a shared edge belongs to one
 * triangle.
 */
#ifndef BURNISH_RASTER_RASTER_H
#define BURNISH_RASTER_RASTER_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

enum {
    BURNISH_SUBPIXELS = 256, /* fixed-point steps a pixel */
    BURNISH_TILE_SIZE = 64,  /* pixels along a tile's edge */
    BURNISH_TILE_PIXELS = BURNISH_TILE_SIZE * BURNISH_TILE_SIZE,
    BURNISH_MAX_SAMPLES = 16,    /* coverage samples a pixel */
    BURNISH_MAX_TILES = 256,     /* along an image's edge: a tile's index fits 8 bits */
    BURNISH_FRAGMENT_BLOCK = 256 /* visible points handed over at once: their arrays stay in L1 */
};

/* A sample or pixel that no triangle covers. */
#define BURNISH_NO_TRIANGLE UINT32_MAX

/* From model space to the screen. clip = rows * (p - origin, 1); x and y come out in pixels from
 * the image's centre (y up) times w; a point is in front of the near plane when z <= w. */
typedef struct burnish_raster_view {
    int width, height; /* pixels */
    int samples;       /* 1, 4, 8 or 16 */
    float origin[3];
    float rows[4][4]; /* x, y, z, w */
} burnish_raster_view;

/* Where a vertex fell. */
typedef struct burnish_screen_vertex {
    int32_t x, y;    /* 1/256 pixel */
    float depth;     /* z / w, nearer is larger */
    float inverse_w; /* 1 / w; 0 for a vertex of the mesh that only clipped triangles use */
} burnish_screen_vertex;

/* One item a vertex of the mesh, then the vertices that clipping made. */
typedef struct burnish_screen_vertices {
    burnish_screen_vertex *items;
    uint8_t *outcodes; /* which planes each vertex of the mesh lies beyond */
    size_t mesh_count; /* vertices of the mesh */
    size_t count;      /* with the clipped ones */
} burnish_screen_vertices;

/* A vertex that clipping made: its weights in the mesh's triangle. */
typedef struct burnish_clip_vertex {
    uint32_t triangle;
    float weights[3];
} burnish_clip_vertex;

/* One triangle that may be visible; its area on the screen is positive. */
typedef struct burnish_setup_triangle {
    uint32_t vertices[3]; /* into burnish_screen_vertices */
    uint32_t source;      /* the mesh's triangle * 2, + 1 when seen from its back */
    uint8_t tiles[4];     /* x0, y0, x1, y1 (inclusive) of the tiles its bounds touch */
} burnish_setup_triangle;

/* A frame's geometry; every array is owned. */
typedef struct burnish_geometry {
    burnish_screen_vertices vertices;
    burnish_clip_vertex *clip_vertices; /* vertices.count - vertices.mesh_count of them */
    burnish_setup_triangle *triangles;  /* whole ones, then the pieces of clipped ones */
    size_t triangle_count;
} burnish_geometry;

/* Transforms, clips, culls. positions: 3 floats a vertex; indices: 3 a triangle. threads: >= 1.
 * Errors: MEMORY, LIMIT. */
burnish_status burnish_geometry_create(burnish_geometry *geometry, const burnish_raster_view *view,
                                       const float *positions, size_t vertex_count,
                                       const uint32_t *indices, size_t triangle_count, int threads,
                                       burnish_error *error);
void burnish_geometry_destroy(burnish_geometry *geometry);

/* Rounds to 1/256 pixel, halves to even, so that mirrored scenes stay mirrored; abs(pixels) <
 * 16384. */
int32_t burnish_to_fixed(float pixels);

/* One corner of a triangle while it is clipped. */
typedef struct burnish_clip_corner {
    float position[4]; /* x, y, z, w as burnish_raster_view defines them */
    float weights[3];
} burnish_clip_corner;

enum { BURNISH_CLIP_MAX = 8 }; /* corners of a triangle cut by five planes */

/* Pixels from the image's centre beyond which triangles are cut, so that fixed point can't
 * overflow. */
#define BURNISH_GUARD_BAND 16000.0f

/* Cuts a triangle by the near plane and the guard band. corners holds 3 and has room for
 * BURNISH_CLIP_MAX; returns the number left, 0 or 3 .. BURNISH_CLIP_MAX. A point on an edge that
 * two triangles share comes out with the same bits for both. */
int burnish_clip_triangle(burnish_clip_corner *corners);

/* Triangle lists of a band of tile rows: two a tile, of the triangles seen from their front, then
 * of those seen from their back. Where two triangles have the same depth, the first one drawn
 * stays. */
typedef struct burnish_bins {
    int columns, rows; /* tiles of the whole image */
    int first_row, end_row;
    size_t *offsets;   /* 2 * columns * (end_row - first_row) + 1 */
    uint32_t *entries; /* ascending triangle indices, list after list */
    size_t offset_capacity, entry_capacity, count_capacity;
    size_t *counts;      /* scratch */
    size_t entry_budget; /* entries that a band of several rows may hold */
} burnish_bins;

/* Bins before the first band. */
void burnish_bins_begin(burnish_bins *bins);

/* Fills bins with the next band, from bins->end_row on: as many tile rows as keep the entries under
 * the budget, at least one. The lists do not depend on threads. */
burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_geometry *geometry,
                                 const burnish_raster_view *view, int threads,
                                 burnish_error *error);
void burnish_bins_destroy(burnish_bins *bins);

/* The corners of the triangle that a point lies on. */
typedef struct burnish_corners {
    uint32_t vertices[3]; /* into burnish_screen_vertices */
    uint32_t source;      /* the mesh's triangle * 2, + 1 when seen from its back */
} burnish_corners;

/* Visible points: all samples of a pixel that show the same triangle are one point, at the pixel's
 * centre when that is the whole pixel and else at the mean of the samples, which lies inside the
 * triangle. */
typedef struct burnish_fragments {
    int count;
    uint16_t pixel[BURNISH_FRAGMENT_BLOCK]; /* x + y * BURNISH_TILE_SIZE, in the tile */
    uint8_t weight[BURNISH_FRAGMENT_BLOCK]; /* samples */
    burnish_corners corners[BURNISH_FRAGMENT_BLOCK];
    float x[BURNISH_FRAGMENT_BLOCK]; /* pixels from the image's centre, right */
    float y[BURNISH_FRAGMENT_BLOCK]; /* up */
    float depth[BURNISH_FRAGMENT_BLOCK];
    float
        weight1[BURNISH_FRAGMENT_BLOCK]; /* screen-space barycentric weights of vertices 1 and 2 */
    float weight2[BURNISH_FRAGMENT_BLOCK];
} burnish_fragments;

/* Sample positions in 1/16 pixel from the pixel's centre: (x, y) pairs. */
const int8_t (*burnish_sample_offsets(int samples))[2];

#endif
