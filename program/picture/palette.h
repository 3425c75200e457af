/* The 255 colours that an animation keeps, for all of its frames. */
#ifndef TOOL_PICTURE_PALETTE_H
#define TOOL_PICTURE_PALETTE_H

#include "base/cli/values.h"
#include "burnish/image.h"

enum { PICTURE_PALETTE_MAX = 255 }; /* the 256th means "as before" or "nothing" */

typedef struct picture_palette {
    int count;
    uint8_t colors[PICTURE_PALETTE_MAX][3]; /* in the order of their green */
    uint8_t first[256]; /* of a green: the first colour that has as much; count for none */
} picture_palette;

/* How many of `count` pixels, 1 or more, are like the first one, one after another. */
static inline size_t picture_run(const uint8_t *pixel, size_t count, size_t channels) {
    const uint8_t *at = pixel + channels;
    size_t run = 1;
    for (; run < count && at[0] == pixel[0] && at[1] == pixel[1] && at[2] == pixel[2] &&
           at[channels - 1] == pixel[channels - 1];
         ++run) {
        at += channels;
    }
    return run;
}

/* How often each colour occurs: 512 KiB, and 1 KiB for each pair of red and green that occurs. */
typedef struct picture_histogram picture_histogram;

/* NULL without memory. */
picture_histogram *picture_histogram_create(void);
void picture_histogram_destroy(picture_histogram *histogram); /* NULL is allowed */

/* Counts an image's pixels, but for those whose alpha is below 128. Returns 0 without memory. */
int picture_histogram_add(picture_histogram *histogram, const burnish_image *image);

/* The colours themselves where they are few enough; else the ones that are nearest to all, and
 * `ground` exactly, so that it stays one flat colour. Integers only: the same on every machine.
 * Errors: MEMORY. */
burnish_status picture_palette_choose(const picture_histogram *histogram, const uint8_t ground[3],
                                      picture_palette *palette, burnish_error *error);

/* Squared distance of two colours, weighted as the eye does. */
static inline int picture_distance(const uint8_t a[3], const uint8_t b[3]) {
    const int r = a[0] - b[0], g = a[1] - b[1], blue = a[2] - b[2];
    return 3 * r * r + 4 * g * g + 2 * blue * blue;
}

/* Index of the nearest colour. */
int picture_palette_nearest(const picture_palette *palette, const uint8_t color[3]);

#endif
