/* A tile from its lists of triangles to depth and attributes of every pixel. What comes out is, bit
 * for bit, what test/reference_tile.h computes in the plainest way, for every instruction set.
 *
 * A sample belongs to the triangle that is nearest there; of two at the same depth to the one seen
 * from its front, then to the first. A pixel whose samples all are one triangle's is whole: its
 * attributes are interpolated at its centre while the triangle is drawn. The others are shared:
 * all samples of such a pixel that show one triangle become one point
 * (burnish_tile_next_fragments). */
#ifndef BURNISH_RASTER_TILE_H
#define BURNISH_RASTER_TILE_H

#include "raster/raster.h"
#include "raster/samples.h"

/* What the points of shared pixels need of the triangles that own, or may have owned, a sample of
 * the tile: arrays of four words a triangle, stored and loaded by vectors. Coordinates are 1/256
 * pixel from the tile's corner; edge function i at (x, y) is dx[i - 1] y - dy[i - 1] x + constant[i
 * - 1], i = 1, 2. */
typedef struct burnish_primitive_edges {
    int32_t constant[2], dx[2];
} burnish_primitive_edges;

typedef struct burnish_primitive_weights {
    int32_t dy[2];
    float inverse_area;
    int32_t is_large; /* 1: its constants do not fit 32 bits */
} burnish_primitive_weights;

typedef struct burnish_primitive_depths {
    float depth[3]; /* of vertex 0; of 1 and 2 minus that */
    float unused;
} burnish_primitive_depths;

typedef struct burnish_tile_primitives {
    burnish_primitive_edges *edges;
    burnish_primitive_weights *weights;
    burnish_primitive_depths *depths;
    burnish_primitive *primitives;
    int64_t (*constants)[2]; /* of large ones */
    size_t count, capacity;
} burnish_tile_primitives;

enum {
    /* Triangles that a tile remembers before it forgets those that own nothing any more. */
    BURNISH_TILE_PRIMITIVES = 2 * BURNISH_TILE_PIXELS,
    BURNISH_TILE_PRIMITIVES_EXTRA = 16, /* that a vector may write past the last one */
};

/* Interpolated numbers of a pixel. */
enum {
    BURNISH_PLANE_X, /* the first attribute, turned round for triangles seen from their back */
    BURNISH_PLANE_Y,
    BURNISH_PLANE_Z,
    BURNISH_PLANE_W, /* its fourth number */
    BURNISH_PLANE_R, /* the second attribute */
    BURNISH_PLANE_G,
    BURNISH_PLANE_B,
    BURNISH_PLANE_COUNT
};

/* What is wanted of a tile. */
typedef struct burnish_tile_options {
    int samples;
    int planes;         /* interpolated: 3, 4 or BURNISH_PLANE_COUNT */
    int keep_ids;       /* 1: ids are wanted, also with one sample */
    int needs_position; /* 1: points get places: x, y and depth */
} burnish_tile_options;

/* Some samples of a pixel. */
typedef struct burnish_sample_mean {
    int16_t x, y; /* mean of their offsets, 1/256 pixel */
    int32_t count;
} burnish_sample_mean;

/* A tile while it is drawn. Pixels lie as burnish_pixel_index says; of the samples of a block of
 * pixels, sample s comes s blocks after sample 0 (burnish_sample_index). */
typedef struct burnish_tile {
    int x, y, width, height; /* pixels; narrower at the image's right and lower edge */
    burnish_tile_options options;
    const burnish_float4 *attributes[2]; /* one item a screen vertex each; the second or NULL */
    float *depths;                       /* a sample each */
    float *planes[BURNISH_PLANE_COUNT];  /* of whole pixels at their centre */
    float *center_depths;                /* of whole pixels; with one sample these are depths */
    /* with one sample, where wanted, burnish_primitive.id_and_facing; else a sample each an index
     * into triangles, -1 for none */
    int32_t *ids;
    uint16_t dirty_blocks[BURNISH_TILE_BLOCKS]; /* bit x of y: block (x, y) shows a triangle */
    burnish_tile_primitives primitives;         /* with more than one sample */
    int32_t *places; /* one a triangle: scratch while triangles are forgotten */
    /* least depth of each coarse block, and of it, the next one, and the two below */
    float coarse[2][BURNISH_HIZ_SIZE][BURNISH_HIZ_SIZE];
    int next_block;             /* where burnish_tile_next_fragments goes on */
    const burnish_isa_ops *ops; /* that drew the tile */
    /* by the bits of up to eight samples: how many, and their offsets' mean in 1/256 pixel */
    burnish_sample_mean means[256];
} burnish_tile;

/* No triangle is that far away. */
#define BURNISH_FARTHEST -1e30f

/* The samples of a block's complex pixels, grouped by triangle. */
typedef struct burnish_complex_pixels {
    int count;
    uint8_t pixel[BURNISH_FRAGMENT_BATCH];
    uint16_t samples[BURNISH_FRAGMENT_BATCH]; /* bits of those that show the triangle */
    int32_t id[BURNISH_FRAGMENT_BATCH];
} burnish_complex_pixels;

/* Fragments before their weights are computed. */
typedef struct burnish_sample_points {
    int count;
    int32_t id[BURNISH_FRAGMENT_BATCH];
    /* 1/256 pixel from the tile's corner */
    int32_t x[BURNISH_FRAGMENT_BATCH], y[BURNISH_FRAGMENT_BATCH];
} burnish_sample_points;

/* Where sample s of the pixel at `place` lies in depths and ids. */
static inline int burnish_sample_index(int samples, int place, int s) {
    return (place & ~(BURNISH_BLOCK_PIXELS - 1)) * samples + s * BURNISH_BLOCK_PIXELS +
           (place & (BURNISH_BLOCK_PIXELS - 1));
}

/* Attributes are the caller's to set. Errors: MEMORY; destroy it all the same. */
burnish_status burnish_tile_create(burnish_tile *tile, const burnish_tile_options *options,
                                   burnish_error *error);
void burnish_tile_destroy(burnish_tile *tile);

/* Makes the tile (column, row) current and draws its triangles. Returns 0 when no triangle's bounds
 * touch it. */
int burnish_tile_draw(burnish_tile *tile, const burnish_isa_ops *ops,
                      const burnish_raster_view *view, const burnish_geometry *geometry,
                      const burnish_bins *bins, int column, int row);

/* The next block of the visible points of shared pixels: all samples of a pixel that show the same
 * triangle are one point, at the mean of the samples, which lies inside the triangle. Returns 0
 * when there is none left; with one sample a pixel there are none. */
int burnish_tile_next_fragments(burnish_tile *tile, const burnish_raster_view *view,
                                burnish_fragments *fragments);

/* Which pixels of a strip, four rows of a tile, show what. */
typedef struct burnish_block_row {
    /* >= 0 where the pixel is whole, -1 elsewhere; with more than one sample the index of its
     * triangle */
    int32_t simple[BURNISH_BLOCK_ROW_PIXELS];
    /* bit i of x: a sample of pixel i of block x shows a triangle */
    uint16_t covered[BURNISH_TILE_BLOCKS];
} burnish_block_row;

/* burnish_primitive.id_and_facing of a whole pixel's triangle; needs ids. */
static inline uint32_t burnish_tile_id_and_facing(const burnish_tile *tile, int strip, int pixel,
                                                  int32_t whole) {
    return tile->options.samples == 1
               ? (uint32_t)tile->ids[strip * BURNISH_BLOCK_ROW_PIXELS + pixel]
               : tile->primitives.primitives[whole].id_and_facing;
}

#endif
