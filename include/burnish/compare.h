/* burnish/compare.h: how much two images differ: PSNR, SSIM, FLIP and silhouettes.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_COMPARE_H
#define BURNISH_COMPARE_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Metrics that take longer than one pass over the pixels: a sum of BURNISH_METRIC_... values. */
typedef uint32_t burnish_metric_flags;
enum {
    BURNISH_METRIC_SSIM = 1,
    BURNISH_METRIC_FLIP = 2,
    BURNISH_METRICS_ALL = BURNISH_METRIC_SSIM | BURNISH_METRIC_FLIP
};

/* Options for comparing. Start from burnish_compare_options_default(). */
typedef struct burnish_compare_options {
    uint32_t cookie;                /* set by burnish_compare_options_default() */
    const burnish_context *context; /* NULL: the default */
    int threads; /* the most threads, [0, 1024]; 0: one per processor. The results do
                                 not depend on it */
    burnish_metric_flags metrics; /* the results of the others are NaN */
    int tolerance;                /* [0, 255]: a pixel differs if a channel differs by more */
    uint8_t background[3];        /* sRGB, under transparent pixels */
    const uint8_t *coverage[2];   /* the silhouettes: width * height bytes, the coverage of each
                                   pixel by the object in [0, 255]. NULL: alpha, or, without
                                   alpha, the pixels that differ by more than 4 from the colour
                                   of the corners; then pixels of both images count completely or
                                   not at all */
    float *flip_map; /* receives the FLIP of each pixel, width * height floats; or NULL */
} burnish_compare_options;

/* All metrics, tolerance 0, a white background, no coverage, no map. */
BURNISH_API void burnish_compare_options_init(burnish_compare_options *options, uint64_t layout);
static inline burnish_compare_options burnish_compare_options_default(void) {
    burnish_compare_options options;
    burnish_compare_options_init(&options, BURNISH_LAYOUT(burnish_compare_options));
    return options;
}

/* How two images differ. Colours are 8-bit sRGB values, blended with the background b of the
 * options: c' = (a c + (255 - a) b) / 255, rounded. */
typedef struct burnish_comparison {
    uint64_t pixels, different_pixels; /* all; different by more than the tolerance */
    int bounds[4];             /* x0, y0, x1, y1 (exclusive) of the different pixels; 0 if none */
    int largest[4];            /* largest difference in R, G, B and alpha */
    double mean[4];            /* mean difference, sum of abs(a - b) / pixels */
    double mean_squared_error; /* over R, G and B */
    double psnr; /* dB: 10 log10(255^2 / mean_squared_error); infinity for equal images */
    double ssim; /* mean structural similarity, at most 1 (Wang et al. 2004): luma 0.299 R +
                    0.587 G + 0.114 B, windows of 11 x 11 pixels inside the image, Gaussian
                    weights of deviation 1.5, K1 = 0.01, K2 = 0.03. NaN if a side is below 11 */
    double flip; /* mean FLIP in [0, 1] (Andersson et al. 2020) at 67 pixels per degree */
    double silhouette_iou; /* sum of min(a, b) / sum of max(a, b) of the coverages, [0, 1]; NaN if
                              no object can be distinguished from the background */
} burnish_comparison;

/* Compares two images of the same size.
 *   a, b        only read; RGB8, RGBA8 or BGRA8; their formats can differ
 *   options     NULL: the defaults
 *   comparison  receives the result, all 0 on error
 *   error       receives the message; may be NULL
 * The result is the same on every machine and for any number of threads. It takes 2.4 kB per pixel
 * of a row and thread; the number of threads is reduced to keep that below 128 MiB.
 * Errors: ARGUMENT (options, different sizes, an invalid view), MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_pixels_compare(const burnish_pixels *a, const burnish_pixels *b,
                                                  const burnish_compare_options *options,
                                                  burnish_comparison *comparison,
                                                  burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
