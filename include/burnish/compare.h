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

/* What takes longer than looking at every pixel once. */
typedef uint32_t burnish_metric_flags; /* a sum of: */
enum {
    BURNISH_METRIC_SSIM = 1,
    BURNISH_METRIC_FLIP = 2,
    BURNISH_METRICS_ALL = BURNISH_METRIC_SSIM | BURNISH_METRIC_FLIP
};

/* How two pictures are compared. Start from burnish_compare_options_default(). */
typedef struct burnish_compare_options {
    uint32_t cookie;                /* set by burnish_compare_options_default() */
    const burnish_context *context; /* NULL: the default */
    int threads; /* at most so many, [0, 1024]; 0: one per processor. No digit depends
                                 on it. */
    burnish_metric_flags metrics; /* the others' results are NaN */
    int tolerance;              /* 8-bit codes, [0, 255]: a pixel differs where a channel differs by
                                 more */
    uint8_t background[3];      /* sRGB, under transparent pixels */
    const uint8_t *coverage[2]; /* of each picture, for its silhouette: width * height bytes, how
                                   much of a pixel the object covers, 0 to 255. NULL: its alpha; of
                                   a picture without alpha, what differs by more than 4 codes from
                                   the colour of the corners: then of both pictures a pixel counts
                                   whole or not at all */
    float *flip_map; /* receives FLIP of each pixel: width * height floats; NULL: not wanted */
} burnish_compare_options;

/* All metrics, tolerance 0, a white background, no coverage, no map. */
BURNISH_API void burnish_compare_options_init(burnish_compare_options *options, uint64_t layout);
static inline burnish_compare_options burnish_compare_options_default(void) {
    burnish_compare_options options;
    burnish_compare_options_init(&options, BURNISH_LAYOUT(burnish_compare_options));
    return options;
}

/* How two pictures differ. Colours are sRGB codes; a transparent pixel's lie over the options'
 * background, c' = (a c + (255 - a) b) / 255, rounded. */
typedef struct burnish_comparison {
    uint64_t pixels, different_pixels; /* all; those that differ by more than the tolerance */
    int bounds[4];             /* x0, y0, x1, y1 (exclusive) of those; all 0 where there is none */
    int largest[4];            /* largest difference in R, G, B and alpha, codes */
    double mean[4];            /* mean difference, sum of abs(a - b) / pixels */
    double mean_squared_error; /* over R, G and B */
    double psnr; /* dB: 10 log10(255^2 / mean_squared_error); infinity where nothing differs */
    double ssim; /* mean structural similarity, at most 1: of Wang et al. 2004, of luma 0.299 R +
                    0.587 G + 0.114 B, in windows of 11 x 11 pixels that lie in the picture,
                    weighted by a Gaussian of deviation 1.5, with K1 = 0.01 and K2 = 0.03. NaN where
                    a side is below 11 */
    double flip; /* mean FLIP in [0, 1]: of Andersson et al. 2020, seen with 67 pixels per degree */
    double silhouette_iou; /* sum of min(a, b) / sum of max(a, b) of the pictures' coverage, [0, 1];
                              NaN where there is no object or no telling it from the ground */
} burnish_comparison;

/* Compares two pictures of one size.
 *   a, b        only read; RGB8, RGBA8 or BGRA8, which may differ
 *   options     NULL for the defaults
 *   comparison  receives the result; all 0 on error
 *   error       receives the one line of an error; may be NULL
 * The same digits on every machine, for any number of threads. Memory: 2.4 kB per pixel of a row
 * and thread, and no more threads than 128 MiB are enough for.
 * Errors: ARGUMENT (options, sizes that differ, a view that can't be read), MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_pixels_compare(const burnish_pixels *a, const burnish_pixels *b,
                                                  const burnish_compare_options *options,
                                                  burnish_comparison *comparison,
                                                  burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
