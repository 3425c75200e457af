/* From a tile's linear light to the caller's pixels and planes. */
#ifndef BURNISH_RENDER_FRAME_TARGET_H
#define BURNISH_RENDER_FRAME_TARGET_H

#include "core/srgb.h"
#include "raster/layers.h"
#include "render/frame/frame_view.h"
#include "render/frame/render_options.h"
#include "render/frame/surface.h"
#include "render/light/backdrop.h"
#include "render/lines/outline.h"

/* layer_light.c: from the layers of a tile to their light.
 *
 * A layer of opacity a and colour C in front of light L gives a C + (1 - a) L, and a (C + T L) +
 * (1 - a) L if a share T of each colour passes. This is computed per sample, in linear light, from
 * the nearest layer to the farthest. A layer's opacity is its material's times its vertices',
 * interpolated as a colour is, times its textures'. A masked material is wholly opaque or not there,
 * sample by sample; where its texels are smaller than pixels, samples are as opaque as the area is
 * that the mask leaves. */

/* What a tile's layers come to. Pixels that no layer covers have no light and let all through. */
typedef struct burnish_layer_light {
    float light[3][BURNISH_TILE_PIXELS];  /* sum over a pixel's samples */
    float alpha[BURNISH_TILE_PIXELS];     /* of stored pixels */
    float behind[3][BURNISH_TILE_PIXELS]; /* the background's shares, if channels differ */
    uint16_t covered[BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS]; /* bit i: pixel i of the block */
    size_t channel;  /* floats from a channel's shares to the next one's; 0: all are the same */
    float through[]; /* per sample: the share of light that passes through its layers */
} burnish_layer_light;

/* NULL if memory runs out. */
burnish_layer_light *burnish_layer_light_create(int samples, burnish_memory *memory);

/* has_channels: 1: each channel has shares of its own. */
void burnish_layer_light_clear(burnish_layer_light *layers, int samples, int has_channels);

/* Light and opacity of fragments. */
typedef struct burnish_layer_values {
    const float *const *rgb;                /* NULL: nothing is shaded */
    const float *alpha;                     /* what textures leave of the opacity; NULL: all */
    float (*cover)[BURNISH_TEXTURE_BATCH];  /* what masks leave of it, per sample; NULL: all */
    float (*passed)[BURNISH_TEXTURE_BATCH]; /* what passes of each channel; NULL: nothing */
    int samples;                            /* per pixel */
    float limit;                            /* light is clamped to it */
} burnish_layer_values;

/* Adds fragments after, that is farther than, those before. */
void burnish_layer_light_add(burnish_layer_light *layers, const burnish_surface *surface,
                             const burnish_fragments *fragments,
                             const burnish_layer_values *values);

/* Sum of what passes of channel k to the samples `bits` of a pixel. */
static inline float burnish_layers_through(const burnish_layer_light *layers, int samples, int k,
                                           int pixel, unsigned bits) {
    const float *through = layers->through + (size_t)k * layers->channel;
    float sum = 0;
    for (; bits; bits &= bits - 1) {
        sum += through[burnish_sample_index(samples, pixel, __builtin_ctz(bits))];
    }
    return sum;
}

/* ---- target.c ---- */

/* Where a frame's pixels go, and what background and alpha look like there. */
typedef struct burnish_output {
    burnish_target target;
    burnish_row_range rows; /* of the picture, that the target holds */
    const burnish_render_ops *ops;
    const burnish_srgb_encoder *encoder;
    const burnish_view *view;
    int has_planes;         /* 1: the target has planes */
    burnish_target surface; /* receives depth and coverage of opaque triangles, or has NULL */
    int samples;
    int transparent;           /* 1: alpha is coverage, and the background is empty */
    float limit;               /* a fragment's light is clamped to it before samples are mixed */
    uint32_t alpha;            /* the bits of an opaque pixel's alpha; 0 where there is none */
    uint32_t background_code;  /* red lowest */
    float background_light[4]; /* linear; alpha last */
    const burnish_ground_view *ground; /* NULL: none is seen */
    const burnish_backdrop *backdrop;  /* NULL: the background has one colour */
    const burnish_outline *outline;    /* receives the samples of its rows, or NULL */
    size_t own_triangles;              /* of the mesh; planes show others as */
    const uint32_t *hosts;     /* triangles of the mesh, one for each; NULL: there are none */
    const uint8_t *background; /* a row of the target where nothing is */
    size_t pixel_size;         /* bytes */
} burnish_output;

/* What is kept from frame to frame: the row of background. All zero before the first. */
typedef struct burnish_output_row {
    uint8_t *bytes;
    size_t capacity;
} burnish_output_row;

/* Whether a target fits checked options. Errors: ARGUMENT. */
burnish_status burnish_target_check(const burnish_target *target,
                                    const burnish_render_options *options, burnish_error *error);

/* The pixel rows of row `number` of a tile's blocks, from its own first one on, that are drawn. */
static inline burnish_row_range burnish_output_rows(const burnish_output *output,
                                                    const burnish_tile *tile, int number) {
    const int top = tile->y + number * BURNISH_BLOCK_SIZE;
    const int first = output->rows.first - top, end = output->rows.end - top;
    return (burnish_row_range){first > 0 ? first : 0,
                               end < BURNISH_BLOCK_SIZE ? end : BURNISH_BLOCK_SIZE};
}

/* ops, encoder, view, ground, backdrop and outline are the caller's to set. Errors: MEMORY. */
burnish_status burnish_output_begin(burnish_output *output, const burnish_target *target,
                                    const burnish_render_options *options, burnish_output_row *row,
                                    burnish_memory *memory);

/* What fragments leave at a tile's complex pixels. */
typedef struct burnish_tile_sums {
    float light[3][BURNISH_TILE_PIXELS];  /* times samples */
    uint8_t covered[BURNISH_TILE_PIXELS]; /* samples */
    uint8_t weights[BURNISH_TILE_PIXELS]; /* samples of the fragment that planes show so far */
    burnish_layer_light *layers;          /* in front of all that; NULL: none in this tile */
} burnish_tile_sums;

/* Adds the light of fragments to their pixels' sums, and writes what planes show of them: of a
 * pixel's fragments the one with most samples, of equals the first. batch: of the fragments. */
void burnish_output_add_fragments(const burnish_output *output, const burnish_tile *tile,
                                  const burnish_fragments *fragments,
                                  const burnish_fragment_batch *batch, const float *const rgb[3],
                                  burnish_tile_sums *sums);

/* Writes row `number` of a tile to the target: pixels that show nothing become background; complex
 * ones the mean of their sums with it or, where it is transparent, of the covered samples alone.
 * The row's light may change. */
void burnish_output_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number, burnish_row_light *row);

/* Writes the codes of row `number` to a target of bytes. */
void burnish_output_store_codes(const burnish_output *output, const burnish_tile *tile, int number,
                                const uint32_t *codes);

/* ---- background.c ---- */

/* The bits of a row's block whose pixels show layers. */
static inline unsigned burnish_layered_pixels(const burnish_tile_sums *sums, int number,
                                              int block) {
    return sums->layers ? sums->layers->covered[number * BURNISH_TILE_BLOCKS + block] : 0;
}

/* Whether the background of a row of blocks differs from pixel to pixel, and how dark the ground's
 * shadow is there. sums: NULL where nothing else is: what changes no code is no shadow there. */
int burnish_find_shadow(const burnish_output *output, const burnish_tile *tile,
                        const burnish_tile_sums *sums, int number, float *shadow);

/* Adds the environment, darkened by a shadow, where a resolved row shows background, which is black
 * so far. */
void burnish_add_backdrop(const burnish_output *output, const burnish_tile *tile,
                          const burnish_tile_sums *sums, int number, const float *shadow,
                          burnish_row_light *row);

/* Darkens the background that a resolved row shows or, where there is none, puts black below what
 * it shows; alpha receives the row's. */
void burnish_darken_background(const burnish_output *output, const burnish_tile_sums *sums,
                               int number, const float *shadow, burnish_row_light *row,
                               float *alpha);

/* ---- target.c, again ---- */

/* Fetches the lines of the target that a row of a tile's blocks, whose first pixel is (x, y), will
 * be written to. */
void burnish_output_prefetch(const burnish_output *output, int x, int y);

/* Writes background to row `number`, which shows nothing. */
void burnish_output_store_background(const burnish_output *output, const burnish_tile *tile,
                                     int number);

/* ---- codes.c ---- */

/* Whether the rows of tiles can be encoded so. */
int burnish_codes_are_direct(const burnish_surface *surface, const burnish_output *output);

/* Shades faces of one direction while a tile is rasterized: burnish_tile.find_code. */
typedef struct burnish_face_coder {
    const burnish_kernels_shader *shader;
    const burnish_srgb_encoder *encoder;
    const burnish_render_ops *ops;
    burnish_code_direction known; /* all zero at first */
} burnish_face_coder;

int32_t burnish_codes_of_face(void *coder, const float normal[3]);

/* The codes of row `number` of a tile's blocks. row: scratch; row->pixels must hold what the row's
 * pixels show if there are several materials. */
void burnish_codes_shade_row(const burnish_surface *surface, const burnish_output *output,
                             const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row,
                             uint32_t *codes);

/* ---- target_planes.c ---- */

/* Whether a target has planes. */
static inline int burnish_planes_are_wanted(const burnish_target *target) {
    return target->depth || target->triangles || target->normals || target->coverage;
}

/* Writes what planes hold where nothing is to all of the tile; weights become 0. */
void burnish_planes_clear(const burnish_output *output, const burnish_tile *tile,
                          burnish_tile_sums *sums);

/* What fragments show: of a pixel's the one with most samples, of equals the first.
 *   weights  per pixel of the tile, samples of the fragment that planes show so far */
void burnish_planes_store_fragments(const burnish_output *output, const burnish_tile *tile,
                                    const burnish_fragments *fragments,
                                    const burnish_fragment_batch *batch, uint8_t *weights);

/* What the simple pixels of row `number` show, and the coverage of all. */
void burnish_planes_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels);

#endif
