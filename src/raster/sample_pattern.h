/* Where a pixel's coverage samples lie. */
#ifndef BURNISH_RASTER_SAMPLE_PATTERN_H
#define BURNISH_RASTER_SAMPLE_PATTERN_H

#include "raster/raster_view.h"

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
