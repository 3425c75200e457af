/* burnish/image.h: keep a picture: 8-bit pixels, PNG, hash, labels, contact sheets.
 *
 * What it does not do: read pictures, resample them, or hold more than 8 bits a channel.
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

/* Pixels as they go into a PNG: sRGB, 8 bits a channel, rows from the top, no padding between rows.
 * With four channels the fourth is straight (not premultiplied) alpha. */
typedef struct burnish_image {
    int width, height; /* pixels, [1, BURNISH_IMAGE_MAX_SIZE]; 0 in an empty image */
    int channels;      /* 3 (RGB) or 4 (RGBA) */
    uint8_t *pixels;   /* width * height * channels bytes, owned by the image */
} burnish_image;

/* Allocates an image of zero bytes. Errors: ARGUMENT (a size or channel count out of range; the
 * image becomes empty), MEMORY. Release it with burnish_image_destroy. */
BURNISH_API burnish_status burnish_image_create(burnish_image *image, int width, int height,
                                                int channels, burnish_error *error);

/* Releases the pixels and makes the image empty. An empty image and NULL are allowed. */
BURNISH_API void burnish_image_destroy(burnish_image *image);

/* XXH64 (seed 0) of the pixel bytes: what `xxhsum -H64` prints for them as a raw file. */
BURNISH_API uint64_t burnish_image_hash(const burnish_image *image);

/* Encodes as PNG (8-bit RGB or RGBA, sRGB chunk). *bytes is allocated, release it with free().
 * The bytes depend on the pixels and on no thread or option; on x86-64 processors without SSE4.2
 * and on other families the compressor may find other matches, so compare pixels or their hash
 * across machines, not files. */
BURNISH_API burnish_status burnish_image_encode_png(const burnish_image *image, uint8_t **bytes,
                                                    size_t *size, burnish_error *error);

/* The same with a bound on the threads: 0 for one a processor. The bytes do not depend on it. */
BURNISH_API burnish_status burnish_image_encode_png_threads(const burnish_image *image, int threads,
                                                            uint8_t **bytes, size_t *size,
                                                            burnish_error *error);

/* Writes a PNG file; "-" is standard output. A file appears whole or not at all: the bytes go to
 * a temporary in the same folder, which is renamed over path. Errors: ARGUMENT, MEMORY, WRITE. */
BURNISH_API burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                                   burnish_error *error);

/* Draws one line of text (ASCII 32..126, others as '?') with a stroke font of round pens,
 * antialiased in linear light. x, y: left end of the baseline in pixels from the top left; height:
 * of a capital letter, in pixels, at least 5; color: sRGB 0..255. Parts outside the image are left
 * out. Returns the advance in pixels; with image NULL it only measures. */
BURNISH_API float burnish_image_draw_text(burnish_image *image, float x, float y, float height,
                                          const uint8_t color[3], const char *text);

/* Linear light of an sRGB value in [0, 1] (clamped), by the exact table between its 8-bit codes. */
BURNISH_API float burnish_srgb_decode(float value);

/* Copies source into target with its top left corner at (x, y); both have the same channels.
 * Parts outside the target are left out. */
BURNISH_API void burnish_image_copy(burnish_image *target, int x, int y,
                                    const burnish_image *source);

/* One cell of a contact sheet. */
typedef struct burnish_sheet_cell {
    const burnish_image *image; /* all cells have the same size and channels */
    const char *label;          /* one line under the picture; NULL or "" for none */
} burnish_sheet_cell;

/* Lays out cells row by row under each other, labels below each cell, in a new image.
 * columns: [1, count]; background and ink: sRGB 0..255 of the margin and the labels.
 * Errors: ARGUMENT (cells that differ, a sheet over BURNISH_IMAGE_MAX_SIZE), MEMORY. */
BURNISH_API burnish_status burnish_image_sheet(burnish_image *sheet,
                                               const burnish_sheet_cell *cells, size_t count,
                                               int columns, const uint8_t background[3],
                                               const uint8_t ink[3], burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
