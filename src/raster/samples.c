/* Where a pixel's coverage samples lie. */
#include "raster/raster.h"

/* The standard multisample patterns of Direct3D 11, in 1/16 pixel from the centre. */
static const int8_t ONE[1][2] = {{0, 0}};
static const int8_t FOUR[4][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
static const int8_t EIGHT[8][2] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                   {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
static const int8_t SIXTEEN[16][2] = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                      {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                      {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};

const int8_t (*burnish_sample_offsets(int samples))[2] {
    switch (samples) {
    case 4:
        return FOUR;
    case 8:
        return EIGHT;
    case 16:
        return SIXTEEN;
    default:
        return ONE;
    }
}
