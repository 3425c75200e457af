/* From the layers of a tile to their light.
 *
 * A layer of opacity a and colour C in front of light L gives a C + (1 - a) L. This is computed per
 * sample, in linear light, from the nearest layer to the farthest. A layer's opacity is its
 * material's times its vertices', interpolated as a colour is, times its textures'. A masked
 * material is wholly opaque or not there, sample by sample; where its texels are smaller than
 * pixels, samples are as opaque as the area is that the mask leaves. */
#ifndef BURNISH_RENDER_FRAME_LAYER_LIGHT_H
#define BURNISH_RENDER_FRAME_LAYER_LIGHT_H

#include "raster/layers.h"
#include "render/frame/surface.h"

/* What a tile's layers come to. Pixels that no layer covers have no light and let all through. */
typedef struct burnish_layer_light {
    float light[3][BURNISH_TILE_PIXELS];                         /* sum over a pixel's samples */
    float alpha[BURNISH_TILE_PIXELS];                            /* of stored pixels */
    uint16_t covered[BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS]; /* bit i: pixel i of the block */
    float through[]; /* per sample: the share of light that passes through its layers */
} burnish_layer_light;

/* NULL if memory runs out. */
burnish_layer_light *burnish_layer_light_create(int samples, burnish_memory *memory);

void burnish_layer_light_clear(burnish_layer_light *layers, int samples);

/* Light and opacity of fragments. */
typedef struct burnish_layer_values {
    const float *const *rgb;               /* NULL: nothing is shaded */
    const float *alpha;                    /* what textures leave of the opacity; NULL: all */
    float (*cover)[BURNISH_TEXTURE_BATCH]; /* what masks leave of it, per sample; NULL: all */
    int samples;                           /* per pixel */
    float limit;                           /* light is clamped to it */
} burnish_layer_values;

/* Adds fragments after, that is farther than, those before. */
void burnish_layer_light_add(burnish_layer_light *layers, const burnish_surface *surface,
                             const burnish_fragments *fragments,
                             const burnish_layer_values *values);

/* Sum of what passes to the samples `bits` of a pixel. */
static inline float burnish_layers_through(const burnish_layer_light *layers, int samples,
                                           int pixel, unsigned bits) {
    float sum = 0;
    for (; bits; bits &= bits - 1) {
        sum += layers->through[burnish_sample_index(samples, pixel, __builtin_ctz(bits))];
    }
    return sum;
}

#endif
