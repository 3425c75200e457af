/* Views of pixels within the library. */
#ifndef BURNISH_IMAGE_PIXELS_H
#define BURNISH_IMAGE_PIXELS_H

#include "base/error.h"
#include "burnish/image.h"

/* Bytes of a pixel in a format that is kept as PNG. */
static inline size_t burnish_pixel_size(burnish_pixel_format format) {
    return format == BURNISH_PIXELS_RGB8     ? 3
           : format == BURNISH_PIXELS_GRAY16 ? 2
           : format == BURNISH_PIXELS_RGB16  ? 6
                                             : 4;
}

/* Bytes of a row's pixels. */
static inline size_t burnish_pixels_row(const burnish_pixels *pixels) {
    return (size_t)pixels->width * burnish_pixel_size(pixels->format);
}

/* Checks a view. Errors: ARGUMENT, with a message that begins with `what`. */
burnish_status burnish_pixels_check(const burnish_pixels *pixels, const char *what,
                                    burnish_error *error);

/* BGRA to RGBA or back; from and to may be the same. */
void burnish_pixels_swap(const uint8_t *from, uint8_t *to, size_t count);

#endif
