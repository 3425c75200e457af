/* Rasterisation: triangles in, visible points out. Knows nothing of light, materials or files.
 *
 * Data flow:
 *   positions -> burnish_geometry_update -> screen vertices (fixed point, 1/w, depth);
 *                                           oriented, clipped, culled triangles
 *             -> burnish_bin_tiles       -> triangle lists per tile, one band of tiles at a time
 *             -> burnish_tile_draw -> depth and attributes of a tile's pixels (tile.h)
 *
 * Transform, set-up and drawing run by vectors: src/raster's bodies, compiled for each instruction
 * set into a burnish_raster_tier.
 *
 * Screen space: x right, y down, 1/256 pixel, the origin at the image's top left corner; depth
 * grows toward the viewer. Coverage is integer and exact: a sample on a shared edge belongs to one
 * triangle.
 */
#ifndef BURNISH_RASTER_RASTER_H
#define BURNISH_RASTER_RASTER_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "core/error.h"
#include "core/tasks.h"

enum {
    BURNISH_SUBPIXELS = 256, /* fixed-point steps a pixel */
    BURNISH_TILE_SIZE = 64,  /* pixels along a tile's edge */
    BURNISH_TILE_PIXELS = BURNISH_TILE_SIZE * BURNISH_TILE_SIZE,
    BURNISH_MAX_SAMPLES = 16, /* coverage samples a pixel */
    BURNISH_MAX_TILES = 256,  /* along an image's edge */
    BURNISH_HIZ_PIXELS = 8,   /* pixels along the edge of a block of the coarse depth */
    BURNISH_HIZ_SIZE = BURNISH_TILE_SIZE / BURNISH_HIZ_PIXELS, /* cells along a tile's edge */
    BURNISH_FRAGMENT_BATCH = 256 /* visible points handed over at once: their arrays stay in L1 */
};

/* A sample or pixel that no triangle covers. */
#define BURNISH_NO_TRIANGLE UINT32_MAX

/* From model space to the screen. clip = rows * (p - origin, 1); x and y come out in pixels from
 * the image's centre (y up) times w; a point is in front of the near plane when z <= w. */
typedef struct burnish_raster_view {
    int width, height;   /* pixels */
    int samples;         /* 1, 4, 8 or 16 */
    int cull_back_faces; /* 1: triangles seen from their back are left out */
    float origin[3];
    float rows[4][4]; /* x, y, z, w */
} burnish_raster_view;

/* Four floats that are added and multiplied together: x, y, z or r, g, b, and a fourth. */
typedef float burnish_float4 __attribute__((vector_size(16)));

/* Where a vertex fell: 16 bytes, loaded as one vector. */
typedef struct burnish_screen_vertex {
    int32_t x, y;     /* 1/256 pixel */
    float depth;      /* z / w, nearer is larger */
    uint32_t outcode; /* which planes it lies beyond: BURNISH_OUT_... */
} burnish_screen_vertex;

enum {
    BURNISH_OUT_LEFT = 1,
    BURNISH_OUT_RIGHT = 2,
    BURNISH_OUT_BOTTOM = 4,
    BURNISH_OUT_TOP = 8,
    BURNISH_OUT_NEAR = 16,
    BURNISH_OUT_GUARD = 32,
    /* a triangle is out of sight when all its vertices share one of these, cut when one has one of
       those */
    BURNISH_OUT_REJECT = 31,
    BURNISH_OUT_CLIP = BURNISH_OUT_NEAR | BURNISH_OUT_GUARD
};

/* One item a vertex of the mesh, then the vertices that clipping made. */
typedef struct burnish_screen_vertices {
    burnish_screen_vertex *items;
    float *inverse_w;  /* 1 / w; 0 for a vertex of the mesh that only clipped triangles use */
    size_t mesh_count; /* vertices of the mesh */
    size_t count;      /* with the clipped ones */
    size_t item_capacity, inverse_capacity;
} burnish_screen_vertices;

/* A vertex that clipping made: its weights in the mesh's triangle. */
typedef struct burnish_clip_vertex {
    uint32_t triangle;
    float weights[3];
} burnish_clip_vertex;

/* The corners of a triangle, its area on the screen positive. */
typedef struct burnish_primitive {
    uint32_t vertices[3];   /* into burnish_screen_vertices */
    uint32_t id_and_facing; /* the mesh's triangle * 2, + 1 when it is back-facing */
} burnish_primitive;

enum {
    BURNISH_TASK_GRAIN = 4096, /* triangles or vertices of the mesh that one task handles */
    BURNISH_BATCH_SIZE = 16    /* triangles that are set up, and listed, at once */
};

/* What is known of a triangle before it is drawn. */
#define BURNISH_PACK(x, y) ((uint32_t)(x) | (uint32_t)(y) << 16)
#define BURNISH_PACKED_X(packed) ((packed)&0xffff)
#define BURNISH_PACKED_Y(packed) ((packed) >> 16)

/* The tile part of a HiZ cell's packed coordinates. */
#define BURNISH_HIZ_TILE_MASK (~((BURNISH_HIZ_SIZE - 1) * BURNISH_PACK(1, 1)))

typedef struct burnish_triangle_bounds {
    float nearest; /* depth of its nearest vertex */
    /* the coarse blocks that its bounds touch, from one to the other: x, and y in the upper half */
    uint32_t first, last;
} burnish_triangle_bounds;

/* Neighbouring triangles, an item each. Only those that may be seen have been set up. */
typedef struct burnish_triangle_batch {
    float nearest[BURNISH_BATCH_SIZE];
    uint32_t first[BURNISH_BATCH_SIZE], last[BURNISH_BATCH_SIZE];
} burnish_triangle_batch;

/* Which triangles of a block may be seen. */
typedef struct burnish_batch_header {
    uint16_t visible[2]; /* bits: front-facing triangles, back-facing ones */
    uint32_t tile; /* that holds all of them: x, and y in the upper half; or BURNISH_NO_TILE */
} burnish_batch_header;
#define BURNISH_NO_TILE UINT32_MAX

/* A frame's geometry; every array but the indices is owned. All zero before the first frame; a
 * later frame uses the arrays again. A triangle's slot is its number in the mesh; pieces of clipped
 * triangles have the slots behind those of the mesh's last block. */
typedef struct burnish_geometry {
    burnish_screen_vertices vertices;
    burnish_clip_vertex *clip_vertices; /* vertices.count - vertices.mesh_count of them */
    burnish_triangle_batch *batches;    /* the mesh's, then those of the pieces */
    burnish_batch_header *headers;      /* one a block */
    burnish_primitive *pieces;          /* piece_count */
    const uint32_t *indices;            /* the mesh's */
    size_t mesh_batches, piece_count;
    size_t batch_count;    /* with those of the pieces */
    size_t triangle_count; /* that may be seen */
    size_t batch_capacity, header_capacity, piece_capacity, clip_capacity;
} burnish_geometry;

/* The corners of the triangle in a slot, which is seen from its back or not. A front face's winding
 * turns round on the screen, where y points down. */
static inline burnish_primitive burnish_geometry_primitive(const burnish_geometry *geometry,
                                                           size_t slot, unsigned back) {
    const size_t mesh_slots = geometry->mesh_batches * BURNISH_BATCH_SIZE;
    if (slot >= mesh_slots) {
        return geometry->pieces[slot - mesh_slots];
    }
    const uint32_t *v = geometry->indices + 3 * slot;
    return (burnish_primitive){{v[0], v[2 - back], v[1 + back]}, (uint32_t)slot * 2 + back};
}

typedef struct burnish_isa_ops burnish_isa_ops; /* simd/isa_ops.h */

/* Transforms, clips, cull_back_faces. positions: 3 floats a vertex; indices: 3 a triangle, which
 * must outlive the geometry's use. The result does not depend on the pool or the tier. Errors:
 * MEMORY, LIMIT; destroy it all the same. */
burnish_status burnish_geometry_update(burnish_geometry *geometry, const burnish_isa_ops *ops,
                                       const burnish_raster_view *view, const float *positions,
                                       size_t vertex_count, const uint32_t *indices,
                                       size_t triangle_count, burnish_tasks *pool,
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

/* Longest edge, in 1/256 pixel along an axis, whose functions fit 32 bits all over a tile that the
 * triangle touches: 2 * 24576 * (24576 + 64 * 256) < 2^31. */
enum { BURNISH_SMALL_EDGE = 96 * BURNISH_SUBPIXELS };

/* Tiles from one to the other, both inclusive. */
typedef struct burnish_tile_box {
    int column0, row0, column1, row1;
} burnish_tile_box;

/* The tiles that the bounds of triangle `lane` of a batch touch. */
static inline burnish_tile_box burnish_tile_box_of(const burnish_triangle_batch *batch,
                                                   unsigned lane) {
    const uint32_t first = batch->first[lane], last = batch->last[lane];
    return (burnish_tile_box){(int)(BURNISH_PACKED_X(first) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_Y(first) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_X(last) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_Y(last) / BURNISH_HIZ_SIZE)};
}

/* Tile lists of a band of tile rows: two per tile, of the front-facing triangles, then of the
 * back-facing ones. Where two triangles have the same depth, the first one drawn stays. A list is
 * made of chunks, so that a single pass over the triangles fills all lists. Each slice of the
 * triangles has lists of its own; a tile's follow one another. */
enum {
    BURNISH_CHUNK_ENTRIES = 16,
    BURNISH_LISTS_MAX = 1 << 21 /* of all slices: 16 MiB */
};

/* Triangles of a batch. */
typedef struct burnish_bin_entry {
    uint32_t batch;
    uint32_t mask; /* bit i: triangle i of it */
} burnish_bin_entry;

/* The first chunk (0: the list is empty), and where in the entries the next one goes. */
typedef struct burnish_tile_list {
    uint32_t first, next;
} burnish_tile_list;

typedef struct burnish_bin_slice {
    burnish_tile_list *lists;
    burnish_bin_entry *entries; /* chunk after chunk; batches ascend along a list */
    uint32_t *next_chunks;      /* of a list, after each of its chunks */
    size_t chunk_count;         /* with chunk 0, which is not used */
    size_t chunk_capacity;      /* that may be used */
    size_t list_capacity, entry_capacity, next_capacity; /* entry_capacity in chunks */
    int fits;                                            /* 0: the limit was reached */
    burnish_status status;
    burnish_error error;
} burnish_bin_slice;

typedef struct burnish_bins {
    const burnish_context *context;
    int columns, rows; /* tiles of the whole image */
    int first_row, end_row;
    burnish_bin_slice *slices;
    size_t slice_count, slice_capacity;
    size_t entry_budget; /* entries that a band of several rows may hold */
} burnish_bins;

/* Bins before a frame's first band; all zero before the first frame. The context, which may be
 * NULL, is the same in every frame. */
void burnish_bins_begin(burnish_bins *bins, const burnish_context *context);

/* Fills bins with the next band, from bins->end_row on: as many tile rows as keep the entries
 * within the budget, at least one. The lists do not depend on threads or the instruction set.
 * Errors: MEMORY, LIMIT. */
burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_isa_ops *ops,
                                 const burnish_geometry *geometry, const burnish_raster_view *view,
                                 burnish_tasks *tasks, burnish_error *error);

/* Reads a list in order. */
typedef struct burnish_list_reader {
    const burnish_bins *bins;
    size_t list, slice;
    uint32_t chunk;
} burnish_list_reader;
burnish_list_reader burnish_list_begin(const burnish_bins *bins, int column, int row, int back);

int burnish_list_is_empty(burnish_list_reader reader);

/* Copies as many of the next entries as fit capacity >= BURNISH_CHUNK_ENTRIES; 0 at the end. */
size_t burnish_list_read(burnish_list_reader *reader, burnish_bin_entry *entries, size_t capacity);
void burnish_bins_destroy(burnish_bins *bins);

/* Pixels of a tile lie in memory as blocks of 4 x 4, row of blocks after row of blocks, so that 4,
 * 8 or 16 neighbours of a block are one vector. */
enum {
    BURNISH_BLOCK_SIZE = 4,
    BURNISH_BLOCK_PIXELS = BURNISH_BLOCK_SIZE * BURNISH_BLOCK_SIZE,
    BURNISH_BLOCK_ROW_PIXELS = BURNISH_TILE_SIZE * BURNISH_BLOCK_SIZE, /* in a row of blocks */
    BURNISH_TILE_BLOCKS = BURNISH_TILE_SIZE / BURNISH_BLOCK_SIZE
};
static inline int burnish_pixel_index(int x, int y) {
    return (y >> 2) << 8 | (x >> 2) << 4 | (y & 3) << 2 | (x & 3);
}
static inline int burnish_pixel_x(int pixel) {
    return (pixel >> 4 & 15) << 2 | (pixel & 3);
}
static inline int burnish_pixel_y(int pixel) {
    return (pixel >> 8) << 2 | (pixel >> 2 & 3);
}

/* Visible points: all samples of a pixel that show the same triangle are one point, at the pixel's
 * centre when that is the whole pixel and else at the mean of the samples, which lies inside the
 * triangle. */
typedef struct burnish_fragments {
    int count;
    uint16_t pixels[BURNISH_FRAGMENT_BATCH]; /* index in the tile */
    uint8_t weight[BURNISH_FRAGMENT_BATCH];  /* samples */
    burnish_primitive primitives[BURNISH_FRAGMENT_BATCH];
    float x[BURNISH_FRAGMENT_BATCH]; /* pixels from the image's centre, right */
    float y[BURNISH_FRAGMENT_BATCH]; /* up */
    float depth[BURNISH_FRAGMENT_BATCH];
    float
        weight1[BURNISH_FRAGMENT_BATCH]; /* screen-space barycentric weights of vertices 1 and 2 */
    float weight2[BURNISH_FRAGMENT_BATCH];
} burnish_fragments;

#endif
