/* From a tile's linear light to the caller's pixels. */
#ifndef BURNISH_RENDER_STORE_H
#define BURNISH_RENDER_STORE_H

#include "burnish/render.h"
#include "core/memory.h"
#include "core/srgb.h"
#include "render/fragments.h"

/* Where a frame's pixels go, and what background and alpha look like there. */
typedef struct burnish_output {
    burnish_target target;
    const burnish_isa_ops *ops;
    const burnish_srgb_encoder *encoder;
    int samples;
    int transparent;           /* 1: alpha is coverage, and there is no background */
    float limit;               /* a fragment's light is clamped to it before samples are mixed */
    uint32_t alpha;            /* the bits of an opaque pixel's alpha; 0 where there is none */
    uint32_t background_code;  /* red lowest */
    float background_light[4]; /* linear; alpha last */
    const uint8_t *background; /* a row of the target where nothing is */
    size_t pixel_size;         /* bytes */
} burnish_output;

/* What is kept from frame to frame: the row of background. All zero before the first. */
typedef struct burnish_output_row {
    uint8_t *bytes;
    size_t capacity;
} burnish_output_row;

/* encoder and ops are the caller's to set. Errors: MEMORY. */
burnish_status burnish_output_begin(burnish_output *output, const burnish_target *target,
                                    const burnish_render_options *options, burnish_output_row *row,
                                    burnish_memory *memory);

/* Bytes of a pixel. */
size_t burnish_pixel_size(burnish_pixel_format format);

/* The sums of complex pixels: light times samples, and samples. */
typedef struct burnish_tile_sums {
    float light[3][BURNISH_TILE_PIXELS];
    uint8_t covered[BURNISH_TILE_PIXELS];
} burnish_tile_sums;

/* Adds the light of fragments to their pixels' sums. */
void burnish_sums_add(burnish_tile_sums *sums, const burnish_fragments *fragments,
                      const float *const rgb[3], float limit);

/* With several samples, the light of row `number` in place: simple pixels as they are, of the
 * others' sums the mean with the background or, where the background is transparent, of the covered
 * samples alone. */
void burnish_resolve_block_row(const burnish_output *output, const burnish_tile_sums *sums,
                               int number, burnish_row_light *row);

/* Writes row `number` to the target. With one sample pixels that show nothing become background. */
void burnish_store_block_row(const burnish_output *output, const burnish_tile *tile,
                             const burnish_tile_sums *sums, int number,
                             const burnish_row_light *row);

/* Writes background to a tile's pixel rows [first, end), as far as the tile reaches. */
void burnish_store_background(const burnish_output *output, const burnish_tile *tile, int first,
                              int end);

#endif
