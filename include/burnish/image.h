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
    int width, height; /* pixels, [1, BURNISH_IMAGE_MAX_SIZE]; 0 in an empty image */
    int channels;      /* 3 (RGB) or 4 (RGBA) */
    uint8_t *pixels;   /* width * height * channels bytes, owned by the image */
} burnish_image;

/* Allocates an image of zero bytes. Errors: ARGUMENT (a size or channel count out of range; the
 * image becomes empty), MEMORY. Release it with burnish_image_destroy. */
BURNISH_API burnish_status burnish_image_create(burnish_image *image, int width, int height,
                                                int channels, burnish_error *error);

/* Decodes a PNG, JPEG, WebP, BMP or TGA, told by its first bytes: codes of 8 bits, taken as sRGB
 * whatever gamma or profile the file states; 16 bits become the nearest 8. RGBA where the file has
 * any transparency, else RGB. Safe for untrusted input: sides are checked before memory is asked
 * for.
 *   bytes  size of them: the whole file
 *   name   stands in messages; NULL: "picture"
 *   image  receives the picture, to be destroyed; empty on error
 * Errors: FORMAT, LIMIT (sides over BURNISH_IMAGE_MAX_SIZE), MEMORY; ARGUMENT (NULL, or this build
 * has no library for the format). */
BURNISH_API burnish_status burnish_image_decode(const void *bytes, size_t size, const char *name,
                                                burnish_image *image, burnish_error *error);

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
BURNISH_API burnish_png_options burnish_png_options_default(void);

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

/* ---- Comparing ---- */

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
BURNISH_API burnish_compare_options burnish_compare_options_default(void);

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

/* Steps of an outline: the points that follow the current one. */
typedef enum burnish_outline_verb {
    BURNISH_OUTLINE_MOVE,  /* 1: begins a contour; the one before is closed */
    BURNISH_OUTLINE_LINE,  /* 1 */
    BURNISH_OUTLINE_CONIC, /* 2: control, end */
    BURNISH_OUTLINE_CUBIC  /* 3: control, control, end */
} burnish_outline_verb;

/* Takes a step: x, y of each point in 1/256 pixels, y upward. */
typedef void burnish_outline_sink(void *user_data, burnish_outline_verb verb,
                                  const int32_t *points);

/* Who sets text that burnish's stroke font has no letters for. Outlines are filled with exact area
 * coverage in integers, so that only the font decides what comes out.
 *   set_line   sets one line of UTF-8 from its left end: hands the outlines to take, unless that is
 *              NULL, and returns the advance in 1/256 pixels
 *     text     length bytes
 *     height   of a capital letter, in pixels
 *     take_data  user_data of take
 *   user_data  of set_line */
typedef struct burnish_font {
    int32_t (*set_line)(void *user_data, const char *text, size_t length, int height,
                        burnish_outline_sink *take, void *take_data);
    void *user_data;
} burnish_font;

/* One cell of a contact sheet. */
typedef struct burnish_sheet_cell {
    const burnish_image *image; /* all cells have the same size and channels */
    const char *label;          /* one line under the picture; NULL or "" for none */
    const burnish_font *font;   /* of the label; NULL: burnish's stroke font */
} burnish_sheet_cell;

/* The size of the sheet that burnish_image_sheet makes, before any picture is drawn: of the cells'
 * images width, height and channels count, pixels may be NULL.
 *   columns        [1, count]
 *   width, height  of the sheet in pixels; 0 after an error
 * Errors: ARGUMENT (cells that differ, a sheet over BURNISH_IMAGE_MAX_SIZE). */
BURNISH_API burnish_status burnish_image_sheet_size(const burnish_sheet_cell *cells, size_t count,
                                                    int columns, int *width, int *height,
                                                    burnish_error *error);

/* Lays out cells row by row under each other, labels below each cell, in a new image.
 * columns: [1, count]; background and ink: sRGB 0..255 of the margin and the labels.
 * Errors: ARGUMENT (cells that differ, a sheet over BURNISH_IMAGE_MAX_SIZE), MEMORY. */
BURNISH_API burnish_status burnish_image_sheet(burnish_image *sheet,
                                               const burnish_sheet_cell *cells, size_t count,
                                               int columns, const uint8_t background[3],
                                               const uint8_t ink[3], burnish_error *error);

/* ---- Drawings ---- */

/* Lines and areas in the order in which they cover each other. burnish_renderer_trace of render.h
 * and burnish_annotate_drawing of annotate.h put them there. One thread may use a drawing at a
 * time. After an error of such a call it can only be destroyed. */
typedef struct burnish_drawing burnish_drawing;

/* Makes an empty one.
 *   context        whose memory it uses; NULL: the default. Must outlive the drawing
 *   width, height  in pixels, [1, BURNISH_IMAGE_MAX_SIZE]
 *   drawing        receives it; release it with burnish_drawing_destroy
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_drawing_create(const burnish_context *context, int width,
                                                  int height, burnish_drawing **drawing,
                                                  burnish_error *error);

/* Lays out drawings as burnish_image_sheet does pictures, to the pixel.
 *   cells     sizes and labels; pixels may be NULL
 *   drawings  one per cell, of the cells' size; they are copied
 *   columns   [1, count]
 *   ink       sRGB of the labels
 *   sheet     receives it, NULL on error; it has the first drawing's context
 * Errors: as burnish_image_sheet; ARGUMENT also for a drawing of another size. */
BURNISH_API burnish_status burnish_drawing_sheet(const burnish_sheet_cell *cells,
                                                 burnish_drawing *const *drawings, size_t count,
                                                 int columns, const uint8_t ink[3],
                                                 burnish_drawing **sheet, burnish_error *error);

/* Writes a drawing as SVG, the same bytes everywhere: paths alone, whose coordinates are pixels
 * with two decimals. Letters are paths too, with their text in aria-label, so no font is needed.
 *   title          UTF-8; NULL: none
 *   background     sRGB; NULL: none
 *   dots_per_inch  [1, 1e6]: width and height are millimetres, 25.4 pixels / dots_per_inch; 0: they
 *                  are pixels
 *   text           receives the file, with a 0 at its end; give it to burnish_release() with the
 *                  drawing's context
 *   size           receives its bytes, without that 0
 * Errors: ARGUMENT, MEMORY; *text is then NULL. */
BURNISH_API burnish_status burnish_drawing_encode_svg(const burnish_drawing *drawing,
                                                      const char *title,
                                                      const uint8_t background[3],
                                                      double dots_per_inch, char **text,
                                                      size_t *size, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_drawing_destroy(burnish_drawing *drawing);

#ifdef __cplusplus
}
#endif

#endif
