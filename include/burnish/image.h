/* burnish/image.h: images of 8-bit pixels: decoding, PNG (8 and 16 bits), hashes.
 *
 * It reads BMP and TGA, and PNG, JPEG and WebP if it was built with their libraries. It does not
 * scale images.
 *
 * Threads: one thread at a time may change an image or use a PNG stream.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_IMAGE_H
#define BURNISH_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The largest width and height of an image, in pixels. */
#define BURNISH_IMAGE_MAX_SIZE 16384

/* An image: sRGB, 8 bits per channel, rows from the top without padding. The fourth channel is
 * straight (not premultiplied) alpha. */
typedef struct burnish_image {
    int width, height;              /* pixels, [1, BURNISH_IMAGE_MAX_SIZE]; 0 in an empty image */
    int channels;                   /* 3 (RGB) or 4 (RGBA) */
    uint8_t *pixels;                /* width * height * channels bytes, owned by the image */
    const burnish_context *context; /* allocated the pixels; NULL: malloc */
} burnish_image;

/* Allocates an image of zero bytes. Release it with burnish_image_destroy.
 *   context        allocates the pixels; NULL: malloc. One with an allocator must outlive the image
 *   image          receives the image; empty on error
 *   width, height  in pixels, [1, BURNISH_IMAGE_MAX_SIZE]
 *   channels       3 or 4
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_image_create(const burnish_context *context,
                                                burnish_image *image, int width, int height,
                                                int channels, burnish_error *error);

/* Decodes a PNG, JPEG, WebP, BMP or TGA file; the first bytes tell the format. Values are taken as
 * sRGB, whatever gamma or profile the file states, and 16 bits are rounded to 8. The image is RGBA
 * if the file has transparency, else RGB. Safe for untrusted input: the size is checked before
 * memory is allocated.
 *   context  allocates the pixels; NULL: malloc. One with an allocator must outlive the image
 *   bytes    the whole file
 *   size     of the file in bytes
 *   name     used in messages; NULL: "picture"
 *   image    receives the picture; release it with burnish_image_destroy. Empty on error
 * Errors: FORMAT, LIMIT (a side above BURNISH_IMAGE_MAX_SIZE), MEMORY, ARGUMENT (NULL, or a format
 * without its library). */
BURNISH_API burnish_status burnish_image_decode(const burnish_context *context, const void *bytes,
                                                size_t size, const char *name, burnish_image *image,
                                                burnish_error *error);

/* Releases the pixels and makes the image empty. NULL and an empty image are allowed. */
BURNISH_API void burnish_image_destroy(burnish_image *image);

/* Pixel formats: 8-bit sRGB values, floats, or 16-bit numbers in the byte order of the machine. A
 * fourth channel is straight (not premultiplied) alpha. */
typedef enum burnish_pixel_format {
    BURNISH_PIXELS_RGB8,
    BURNISH_PIXELS_RGBA8,
    BURNISH_PIXELS_BGRA8,      /* the format of most window systems */
    BURNISH_PIXELS_RGBA_FLOAT, /* linear light, 4 floats; for render.h, not for PNG */
    BURNISH_PIXELS_GRAY16,     /* for PNG, not for render.h: depth, for example */
    BURNISH_PIXELS_RGB16,
    BURNISH_PIXELS_COUNT
} burnish_pixel_format;

/* A view of pixels that the caller owns. */
typedef struct burnish_pixels {
    int width, height; /* pixels, [1, BURNISH_IMAGE_MAX_SIZE] */
    burnish_pixel_format format;
    size_t stride;   /* bytes from one row to the next, at least the size of a row */
    uint8_t *pixels; /* the top left pixel */
} burnish_pixels;

/* The view of an image, valid until the image is destroyed or drawn again. */
BURNISH_API burnish_pixels burnish_image_get_pixels(const burnish_image *image);

/* XXH64 (seed 0) of the pixels in the order RGB or RGBA, without padding: what `xxhsum -H64` prints
 * for a raw file of them. RGBA8 and BGRA8 views of the same image have the same hash. Other formats
 * and invalid views have the hash of 0 bytes. */
BURNISH_API uint64_t burnish_pixels_hash(const burnish_pixels *pixels);
BURNISH_API uint64_t burnish_image_hash(const burnish_image *image);

/* Options for PNG. Start from burnish_png_options_default(). */
typedef struct burnish_png_options {
    uint32_t cookie;                /* set by burnish_png_options_default() */
    const burnish_context *context; /* NULL: the default */
    int threads;                    /* the most threads, [0, 1024]; 0: one per processor */
    double dots_per_inch; /* [1, 1e6], stored as whole dots per metre (pHYs); 0: not stored */
    int is_data; /* 1: the values are not colours, so the chunk sRGB is omitted; 16-bit images
                             never have it */
} burnish_png_options;
BURNISH_API void burnish_png_options_init(burnish_png_options *options, uint64_t layout);
static inline burnish_png_options burnish_png_options_default(void) {
    burnish_png_options options;
    burnish_png_options_init(&options, BURNISH_LAYOUT(burnish_png_options));
    return options;
}

/* Encodes pixels as PNG: 8-bit RGB or RGBA, 16-bit grey or RGB, with the chunks sRGB and tEXt
 * (Software: burnish).
 *   pixels   only read
 *   options  NULL: the defaults
 *   bytes    receives the file, NULL on error; release it with burnish_release() and the context of
 *            the options
 *   size     receives the size in bytes
 *   error    receives the message; may be NULL
 * The bytes do not depend on the number of threads. They depend on the compressor (ISA-L or zlib)
 * and, with ISA-L, on the processor, so compare pixels or hashes between machines, not files.
 * Errors: ARGUMENT (NULL, or a size, format or stride out of range), MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_png_encode(const burnish_pixels *pixels,
                                              const burnish_png_options *options, uint8_t **bytes,
                                              size_t *size, burnish_error *error);

/* Encodes pixels as PNG and writes the file with burnish_file_write(); "-" is standard output.
 * Errors: as for both functions. */
BURNISH_API burnish_status burnish_png_write(const burnish_pixels *pixels, const char *path,
                                             const burnish_png_options *options,
                                             burnish_error *error);

/* burnish_png_write() for an image, with the default options. */
BURNISH_API burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                                   burnish_error *error);

/* The linear light of an sRGB value in [0, 1] (clamped): exact for 8-bit values, interpolated
 * between them. */
BURNISH_API float burnish_srgb_decode(float value);

/* Copies source into target with its top left corner at (x, y). Both have the same channels. Pixels
 * outside the target are skipped. */
BURNISH_API void burnish_image_copy(burnish_image *target, int x, int y,
                                    const burnish_image *source);

#ifdef __cplusplus
}
#endif

#endif
