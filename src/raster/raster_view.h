/* From model space to the screen: the view, and the units that the rasteriser counts in.
 *
 * Screen space: x right, y down, 1/256 pixel, the origin at the image's top left corner; depth
 * grows toward the viewer. */
#ifndef BURNISH_RASTER_RASTER_VIEW_H
#define BURNISH_RASTER_RASTER_VIEW_H

#include <stdint.h>

enum {
    BURNISH_SUBPIXEL_BITS = 8,
    BURNISH_SUBPIXELS = 1 << BURNISH_SUBPIXEL_BITS, /* fixed-point steps per pixel */
    BURNISH_MAX_SAMPLES = 16                        /* coverage samples per pixel */
};

/* Pixels from the image's centre beyond which triangles are clipped, which keeps fixed point from
 * overflowing. */
#define BURNISH_GUARD_BAND 16000.0f

/* clip = rows * (p - origin, 1); x and y come out in pixels from the image's centre (y up) times w;
 * a point is in front of the near plane when z <= w. */
typedef struct burnish_raster_view {
    int width, height;   /* pixels */
    int samples;         /* 1, 4, 8 or 16 */
    int cull_back_faces; /* 1: they are left out */
    float origin[3];
    float rows[4][4]; /* x, y, z, w */
} burnish_raster_view;

/* Adding it to a float of magnitude below 2^22 leaves a whole number, halves rounded to even, in
 * the sum's lowest bits: 1.5 * 2^23. */
#define BURNISH_ROUNDER 12582912.0f

/* Rounds to 1/256 pixel, halves to even, which keeps mirrored scenes mirrored; abs(pixels) <
 * 16384. */
static inline int32_t burnish_to_fixed(float pixels) {
    const float sum = pixels * (float)BURNISH_SUBPIXELS + BURNISH_ROUNDER;
    return (int32_t)(sum - BURNISH_ROUNDER);
}

/* Two coordinates in one word, x in the low half. */
#define BURNISH_PACK(x, y) ((uint32_t)(x) | (uint32_t)(y) << 16)
#define BURNISH_PACKED_X(packed) ((packed)&0xffff)
#define BURNISH_PACKED_Y(packed) ((packed) >> 16)

typedef struct burnish_raster_ops burnish_raster_ops; /* raster_ops.h */

/* Sample positions count in 1/16 pixel, so many steps of 1/256. */
enum { BURNISH_SAMPLE_STEP_BITS = 4, BURNISH_SAMPLE_STEP = 1 << BURNISH_SAMPLE_STEP_BITS };

/* The standard multisample patterns of Direct3D 11: (x, y) pairs in 1/16 pixel from the pixel's
 * centre. samples: 1, 4, 8 or 16. */
static inline const int8_t (*burnish_sample_offsets(int samples))[2] {
    static const int8_t one[1][2] = {{0, 0}};
    static const int8_t four[4][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    static const int8_t eight[8][2] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                       {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    static const int8_t sixteen[16][2] = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                          {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                          {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};
    return samples == 4 ? four : samples == 8 ? eight : samples == 16 ? sixteen : one;
}

/* Some samples of a pixel. */
typedef struct burnish_sample_mean {
    int16_t x, y; /* mean of their offsets, 1/256 pixel, rounded toward 0 */
    int32_t count;
} burnish_sample_mean;

/* bits: bit s is set for each sample s that takes part. */
static inline burnish_sample_mean burnish_mean_of_samples(int samples, unsigned bits) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    int x = 0, y = 0, count = 0;
    for (int s = 0; s < samples; ++s) {
        const int is_in = bits >> s & 1;
        x += is_in * offsets[s][0];
        y += is_in * offsets[s][1];
        count += is_in;
    }
    const int divisor = count > 0 ? count : 1;
    return (burnish_sample_mean){(int16_t)(x * BURNISH_SAMPLE_STEP / divisor),
                                 (int16_t)(y * BURNISH_SAMPLE_STEP / divisor), count};
}

#endif
