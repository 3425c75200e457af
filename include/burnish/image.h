/* burnish/image.h: keep a picture: 8-bit pixels, PNG (also of 16 bits), hash, labels, contact
 * sheets; compare two.
 *
 * A drawing is a picture of lines and areas instead of pixels, and is written as SVG.
 *
 * It reads BMP and TGA, and PNG, JPEG and WebP where it was built with their libraries. What it
 * does not do: resample pictures.
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

/* Pixels as they go into a PNG: sRGB, 8 bits per channel, rows from the top, no padding between
 * rows. With four channels the fourth is straight (not premultiplied) alpha. */
typedef struct burnish_image {
    int width, height;              /* pixels, [1, BURNISH_IMAGE_MAX_SIZE]; 0 in an empty image */
    int channels;                   /* 3 (RGB) or 4 (RGBA) */
    uint8_t *pixels;                /* width * height * channels bytes, owned by the image */
    const burnish_context *context; /* owns the memory of pixels; NULL: malloc and free */
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

/* Decodes a PNG, JPEG, WebP, BMP or TGA, told by its first bytes: codes of 8 bits, taken as sRGB
 * whatever gamma or profile the file states; 16 bits become the nearest 8. RGBA where the file has
 * any transparency, else RGB. Safe for untrusted input: sides are checked before memory is asked
 * for.
 *   context  allocates the pixels; NULL: malloc. One with an allocator must outlive the image
 *   bytes    the whole file
 *   size     of the file in bytes
 *   name     stands in messages; NULL: "picture"
 *   image    receives the picture; release it with burnish_image_destroy. Empty on error
 * Errors: FORMAT, LIMIT (sides over BURNISH_IMAGE_MAX_SIZE), MEMORY; ARGUMENT (NULL, or this build
 * has no library for the format). */
BURNISH_API burnish_status burnish_image_decode(const burnish_context *context, const void *bytes,
                                                size_t size, const char *name, burnish_image *image,
                                                burnish_error *error);

/* Releases the pixels and makes the image empty. An empty image and NULL are allowed. */
BURNISH_API void burnish_image_destroy(burnish_image *image);

/* How pixels lie in memory: sRGB codes of 8 bits, floats, or numbers of 16 bits in the byte order
 * of the machine. A fourth channel is straight (not premultiplied) alpha. */
typedef enum burnish_pixel_format {
    BURNISH_PIXELS_RGB8,
    BURNISH_PIXELS_RGBA8,
    BURNISH_PIXELS_BGRA8,      /* what most window systems show */
    BURNISH_PIXELS_RGBA_FLOAT, /* linear light, 4 floats: drawn by render.h, not kept as PNG */
    BURNISH_PIXELS_GRAY16,     /* kept as PNG, not drawn: for depth and the like */
    BURNISH_PIXELS_RGB16,
    BURNISH_PIXELS_COUNT
} burnish_pixel_format;

/* Pixels that belong to the caller: a view, copied nowhere. */
typedef struct burnish_pixels {
    int width, height; /* pixels, [1, BURNISH_IMAGE_MAX_SIZE] */
    burnish_pixel_format format;
    size_t stride;   /* bytes from one row to the next, at least those of its pixels */
    uint8_t *pixels; /* the top left one; height rows, stride bytes apart */
} burnish_pixels;

/* The view of an image. It lasts as long as the image's pixels. */
BURNISH_API burnish_pixels burnish_image_get_pixels(const burnish_image *image);

/* XXH64 (seed 0) of the pixel bytes in the order RGB or RGBA, without what lies between rows: what
 * `xxhsum -H64` prints for them as a raw file. The same picture has the same hash in RGBA8 and
 * BGRA8. Of nothing for other formats and for a view that can't be read (see burnish_png_encode).
 */
BURNISH_API uint64_t burnish_pixels_hash(const burnish_pixels *pixels);
BURNISH_API uint64_t burnish_image_hash(const burnish_image *image);

/* How a PNG is made. Start from burnish_png_options_default(). */
typedef struct burnish_png_options {
    uint32_t cookie;                /* set by burnish_png_options_default() */
    const burnish_context *context; /* NULL: the default */
    int threads;                    /* at most so many, [0, 1024]; 0: one per processor */
    double dots_per_inch; /* [1, 1e6], in the chunk pHYs, rounded to dots per metre; 0: none */
    int is_data;          /* 1: the values are no colours: no chunk sRGB; no 16-bit PNG has it */
} burnish_png_options;
BURNISH_API void burnish_png_options_init(burnish_png_options *options, uint64_t layout);
static inline burnish_png_options burnish_png_options_default(void) {
    burnish_png_options options;
    burnish_png_options_init(&options, BURNISH_LAYOUT(burnish_png_options));
    return options;
}

/* Encodes as PNG: RGB or RGBA of 8 bits, grey or RGB of 16, chunks sRGB and tEXt (Software:
 * burnish).
 *   pixels   what to encode; only read
 *   options  NULL for the defaults
 *   bytes    receives the file's bytes, NULL on error; give them to burnish_release() with the
 *            options' context
 *   size     receives how many there are
 *   error    receives the one line of an error; may be NULL
 * The bytes depend on the pixels and on no thread or option. Another compressor (ISA-L or zlib, as
 * the library was built) and ISA-L on other processors find other matches, so compare pixels or
 * their hash across machines, not files.
 * Errors: ARGUMENT (no pixels; a size, format or stride out of range), MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_png_encode(const burnish_pixels *pixels,
                                              const burnish_png_options *options, uint8_t **bytes,
                                              size_t *size, burnish_error *error);

/* The same into a file, as burnish_file_write writes it; "-" is standard output.
 * Errors: as both. */
BURNISH_API burnish_status burnish_png_write(const burnish_pixels *pixels, const char *path,
                                             const burnish_png_options *options,
                                             burnish_error *error);

/* burnish_png_write for an image, with the default options. */
BURNISH_API burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                                   burnish_error *error);

/* A PNG that is made of rows as they come, from the top, so that nobody has to hold the whole
 * picture: the bytes of burnish_png_encode. */
typedef struct burnish_png_stream burnish_png_stream;

/* Begins one.
 *   width, height  of the whole picture
 *   format         of all rows
 *   options        NULL for the defaults
 *   stream         receives it, NULL on error; release it with burnish_png_stream_destroy
 * Errors: as burnish_png_encode. */
BURNISH_API burnish_status burnish_png_stream_create(int width, int height,
                                                     burnish_pixel_format format,
                                                     const burnish_png_options *options,
                                                     burnish_png_stream **stream,
                                                     burnish_error *error);

/* Takes the next rows, any number of them; they are compressed by threads where they are more than
 * 128 KiB. With the last one the file is complete.
 *   rows   only read, and not needed afterwards
 *   bytes  receives the next bytes of the file, NULL where there are none yet and on error; give
 *          them to burnish_release() with the options' context
 *   size   receives how many there are
 * Errors: as burnish_png_encode, and ARGUMENT (another width or format, more rows than are
 * missing). After any but ARGUMENT the stream can only be destroyed. */
BURNISH_API burnish_status burnish_png_stream_add(burnish_png_stream *stream,
                                                  const burnish_pixels *rows, uint8_t **bytes,
                                                  size_t *size, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_png_stream_destroy(burnish_png_stream *stream);

/* Linear light of an sRGB value in [0, 1] (clamped), by the exact table between its 8-bit codes. */
BURNISH_API float burnish_srgb_decode(float value);

/* Copies source into target with its top left corner at (x, y); both have the same channels.
 * Parts outside the target are left out. */
BURNISH_API void burnish_image_copy(burnish_image *target, int x, int y,
                                    const burnish_image *source);

#ifdef __cplusplus
}
#endif

#endif
