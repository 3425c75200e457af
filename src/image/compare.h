/* Shared by the parts of a comparison: images as rows, bands of rows, sums. */
#ifndef BURNISH_IMAGE_COMPARE_H
#define BURNISH_IMAGE_COMPARE_H

#include "image/pixels.h"

/* Two images of equal size, the input of all metrics. */
typedef struct burnish_picture_pair {
    const burnish_pixels *pictures[2];
    int width, height;
    uint8_t background[3]; /* sRGB, under transparent pixels */
} burnish_picture_pair;

/* Rows [first, end) of the pictures: what one task does. Sums are taken per band and added in the
 * order of the bands, so no digit depends on threads. */
typedef struct burnish_band {
    int first, end;
} burnish_band;

/* Row y of one of the images as 8-bit sRGB, 3 bytes per pixel. Transparent pixels are blended over
 * the background. rgb: 3 * width bytes. */
void burnish_pair_row(const burnish_picture_pair *pair, int which, int y, uint8_t *rgb);

/* Alpha of a pixel, 255 for formats without alpha. */
static inline int burnish_pixels_alpha(const burnish_pixels *pixels, int x, int y) {
    return pixels->format == BURNISH_PIXELS_RGB8
               ? 255
               : pixels->pixels[pixels->stride * (size_t)y + 4 * (size_t)x + 3];
}

/* ---- SSIM ---- */

enum { BURNISH_SSIM_TAPS = 11 };

/* Weights of the window along one axis; their sum is 1. */
typedef struct burnish_ssim {
    double weights[BURNISH_SSIM_TAPS];
} burnish_ssim;

burnish_ssim burnish_ssim_make(void);

/* Bytes that a band needs. */
size_t burnish_ssim_scratch(int width);

/* The sum of SSIM over the windows inside the image whose centre is in the band. */
double burnish_ssim_band(const burnish_ssim *ssim, const burnish_picture_pair *pair,
                         burnish_band band, void *scratch);

/* ---- FLIP ---- */

enum { BURNISH_FLIP_REACH = 10, BURNISH_FLIP_TAPS = 2 * BURNISH_FLIP_REACH + 1 };

/* Filters along one axis, each BURNISH_FLIP_TAPS weights around the middle. */
typedef enum burnish_flip_filter {
    BURNISH_FLIP_ACHROMATIC, /* contrast sensitivity of Y, Cx and, two Gaussians, Cz */
    BURNISH_FLIP_RED_GREEN,
    BURNISH_FLIP_BLUE_WIDE,
    BURNISH_FLIP_BLUE_NARROW,
    BURNISH_FLIP_SMOOTH, /* feature detection: a Gaussian, its slope, its curvature */
    BURNISH_FLIP_EDGE,
    BURNISH_FLIP_POINT,
    BURNISH_FLIP_FILTERS
} burnish_flip_filter;

typedef struct burnish_flip {
    float filters[BURNISH_FLIP_FILTERS][BURNISH_FLIP_TAPS];
    double blue_shares[2]; /* of the two Gaussians of Cz; their sum is 1 */
    double largest_color;  /* the difference of green and blue, raised to 0.7 */
} burnish_flip;

burnish_flip burnish_flip_make(void);
size_t burnish_flip_scratch(int width);

/* The sum of the error over the band's pixels. map: width floats per row of the whole image, of
 * which the rows of the band are written; or NULL. */
double burnish_flip_band(const burnish_flip *flip, const burnish_picture_pair *pair,
                         burnish_band band, void *scratch, float *map);

#endif
