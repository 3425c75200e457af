/* Where a pixel's coverage samples lie. */
#ifndef BURNISH_RASTER_SAMPLES_H
#define BURNISH_RASTER_SAMPLES_H

#include <stdint.h>

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

#endif
