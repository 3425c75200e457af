/* Statistics of a finished picture's brightness and contrast, for programs. */
#ifndef TOOL_RENDER_TONES_H
#define TOOL_RENDER_TONES_H

#include "burnish/render.h"

/* Statistics of the pixels that show the object; shares are in [0, 1]. NaN if undefined. */
typedef struct render_tones {
    double near_white;  /* share: all channels at least 250 */
    double near_black;  /* share: all channels at most 5 */
    double like_ground; /* share: all channels within 5 of the background's */
    double contrast;    /* (L + 0.05) / (M + 0.05) of the mean luminances of object and background,
                           the larger one in the numerator: [1, 21], as defined by WCAG 2.2*/
} render_tones;

/* One pass over the image.
 *   covered  pixels that show the object
 *   options  for the background */
render_tones render_measure_tones(const burnish_image *image, uint64_t covered,
                                  const burnish_render_options *options);

/* 1: all pixels are equal. */
int render_has_one_color(const burnish_image *image);

#endif
