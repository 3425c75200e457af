/* A tile from its lists of triangles to depth, ids and attributes of every pixel. For every
 * instruction set, the result has the same bits as test/support/reference_tile.h, which computes it
 * in the plainest way.
 *
 * A sample shows the triangle that is nearest there; of two at the same depth the front-facing one,
 * then the first. Attributes of simple pixels (fragments.h) are interpolated at their centre while
 * the triangle is drawn.
 *
 * Transparent triangles are kept apart: they become layers in front of
 * the opaque ones (layers.h).
 *
 * A tile has three parts: the buffer (depth, ids, planes per pixel), HiZ (coarse depth, against
 * which triangles are tested before they are set up) and, with several samples, the primitives that
 * its samples show. */
#ifndef BURNISH_RASTER_TILE_H
#define BURNISH_RASTER_TILE_H

#include "raster/bins.h"
#include "raster/raster_view.h"

/* Four floats that are added and multiplied together: x, y, z or r, g, b, and a fourth. */
typedef float burnish_float4 __attribute__((vector_size(16)));

/* Interpolated numbers of a pixel. */
enum {
    BURNISH_PLANE_X, /* the first attribute, negated for back-facing triangles */
    BURNISH_PLANE_Y,
    BURNISH_PLANE_Z,
    BURNISH_PLANE_W, /* its fourth number */
    BURNISH_PLANE_R, /* the second attribute */
    BURNISH_PLANE_G,
    BURNISH_PLANE_B,
    BURNISH_PLANE_COUNT
};

/* What is requested of a tile. */
typedef struct burnish_tile_options {
    int samples;
    int planes; /* interpolated: 3, 4 or BURNISH_PLANE_COUNT; with one sample also 0: depth alone */
    int keep_ids;       /* 1: ids are requested, also with one sample */
    int needs_position; /* 1: fragments get x, y and depth, simple pixels the depth at their centre
                         */
    int has_layers;     /* 1: transparent triangles are kept as layers; 0: they are left out; 2: as
                           1, but they are only collected by draw_deeper_layers, and some
                           can be chosen of them */
    int has_codes; /* 1: find_code is asked for large triangles; one sample, three planes, no ids */
    int primitives; /* burnish_tile_primitives_of(geometry); 0: any number */
} burnish_tile_options;

/* No triangle is that far away, or that near. */
#define BURNISH_FARTHEST -1e30f
#define BURNISH_NEAREST 1e30f

/* Numbers per pixel, or per sample, in the order of burnish_pixel_index and
 * burnish_sample_index. */
typedef struct burnish_tile_buffer {
    float *depths;                      /* per sample */
    float *planes[BURNISH_PLANE_COUNT]; /* of simple pixels at their centre */
    float *center_depths;               /* of simple pixels; with one sample these are depths */
    /* per sample; with one, where requested, burnish_primitive.id_and_facing, else an index into
     * the tile's primitives, -1 for none */
    int32_t *ids;
    uint16_t dirty_blocks[BURNISH_TILE_BLOCKS]; /* bit x of y: block (x, y) has been written */
} burnish_tile_buffer;

/* The least depth of the samples of each HiZ cell, and of each 2 x 2 cells from that one on. */
typedef struct burnish_hiz {
    float cells[BURNISH_HIZ_SIZE * BURNISH_HIZ_SIZE];
    float quads[BURNISH_HIZ_SIZE * BURNISH_HIZ_SIZE];
} burnish_hiz;

/* Of points: edges has the centre of the disc in constant and its radius in dx[0], depths the depth
 * of the sphere's centre, and of its nearest point minus that.
 *
 * Data for fragments of the primitives that samples of the tile show, or have shown: arrays of four
 * words per primitive, stored and loaded as vectors. Coordinates are 1/256 pixel from the tile's
 * corner. The edge function of edge i = 1, 2, opposite vertex i, is E(x, y) = dx[i - 1] y - dy[i -
 * 1] x + constant[i - 1], and E / area the barycentric weight of vertex i. */
typedef struct burnish_primitive_edges {
    int32_t constant[2], dx[2];
} burnish_primitive_edges;

typedef struct burnish_primitive_weights {
    int32_t dy[2];
    float inverse_area;
    int32_t is_64_bit; /* 1: its constants do not fit 32 bits */
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
    int64_t (*constants)[2]; /* of primitives that need 64 bits */
    int32_t *moved;          /* scratch of eviction: their new indices */
    size_t count, capacity;
} burnish_tile_primitives;

/* How often large triangles must cover a picture before searching for occluders pays. */
#define BURNISH_TILE_OVERDRAWN 16.0

enum {
    /* Primitives per sample that a tile holds before it evicts primitives that no sample shows. At
     * most half of them are shown. */
    BURNISH_TILE_PRIMITIVES = 2 * BURNISH_TILE_PIXELS,
    BURNISH_TILE_PRIMITIVES_EXTRA = 16, /* that a vector may write past the last one */
    BURNISH_TILE_LIST_PART = 128,       /* batches that are listed and drawn at once */
    BURNISH_TILE_PRIMITIVES_AT_ONCE =
        BURNISH_TILE_LIST_PART * BURNISH_BATCH_SIZE + BURNISH_TILE_PRIMITIVES_EXTRA
};

/* Layers of a sample that are kept at once: the nearest ones; and how often those behind are
 * collected (render.h: BURNISH_TRANSPARENT_LAYERS_MAX). */
enum { BURNISH_LAYERS_MAX = 32, BURNISH_LAYER_PASSES = 8 };

typedef struct burnish_tile_layers {
    /* BURNISH_LAYERS_MAX per sample: burnish_layer_index */
    float *depths;
    uint32_t *indices;     /* the primitive's * 2, + 1 when it is back-facing */
    uint8_t *counts;       /* per sample; valid if the tile has some */
    int block_samples;     /* of a block */
    int has_some;          /* 1: the current tile lists a transparent triangle */
    int pass;              /* 0: the nearest layers are collected; else the layers after fronts */
    float *fronts;         /* per sample: the last layer of the pass before */
    size_t dropped;        /* since the tile was created, or since it was set to 0 */
    size_t dropped_before; /* the current tile */
    uint32_t *chosen;      /* per sample, as indices: what draw_chosen draws; NULL: nothing */
    uint32_t current;      /* draw_chosen's triangle, as in indices */
} burnish_tile_layers;

/* Where the nearest layer of a sample lies, in the order of burnish_sample_index. The next one is
 * block_samples later, so a layer of all samples of a block is contiguous, and layers that few
 * samples have stay out of the cache. */
static inline size_t burnish_layer_index(const burnish_tile_layers *layers, int sample) {
    const int within = sample & (layers->block_samples - 1);
    return (size_t)(sample - within) * BURNISH_LAYERS_MAX + (size_t)within;
}

typedef struct burnish_tile {
    int x, y, width, height; /* pixels; narrower at the image's right and lower edge */
    burnish_tile_options options;
    const burnish_context *context;
    const burnish_float4 *attributes[2]; /* one item per screen vertex each; the second or NULL */
    /* What a large triangle puts into the first plane instead of three attributes, if these have the
     * direction of that vector all over it, within 2^-18.4 of its largest number; 0: nothing. The
     * caller's to set. */
    int32_t (*find_code)(void *coder, const float vector[3]);
    void *coder;
    burnish_tile_buffer buffer;
    burnish_hiz hiz;
    int are_points;       /* 1: primitives are points */
    int32_t largest_disc; /* its radius, of the points drawn */
    int is_overdrawn;     /* 1: large triangles cover the picture so often that HiZ looks ahead */
    burnish_tile_primitives primitives; /* with several samples */
    /* per batch, the caller's to set; bit i: triangle i is transparent. NULL: none is */
    const uint16_t *transparent;
    burnish_tile_layers *layers;    /* NULL where the options do not ask for them */
    burnish_sample_mean means[256]; /* by the bits of up to eight samples */
} burnish_tile;

/* Attributes are the caller's to set. Errors: MEMORY; destroy it all the same. */
/* Room for primitives that is enough for a tile of a frame, a power of two: another frame of the
 * mesh takes the same tiles, though other triangles are clipped. */
int burnish_tile_primitives_of(const burnish_geometry *geometry);

burnish_status burnish_tile_create(burnish_tile *tile, const burnish_tile_options *options,
                                   const burnish_context *context, burnish_error *error);
void burnish_tile_destroy(burnish_tile *tile);

/* Makes the tile (column, row) current and draws its triangles. Returns 0 when no triangle's bounds
 * touch it: then nothing but its rectangle is set. */
int burnish_tile_draw(burnish_tile *tile, const burnish_raster_ops *ops,
                      const burnish_raster_view *view, const burnish_geometry *geometry,
                      const burnish_bins *bins, int column, int row);

#endif
