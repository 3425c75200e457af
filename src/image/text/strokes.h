/* Strokes: straight segments thickened by a round pen, antialiased and blended in linear light. */
#ifndef BURNISH_IMAGE_TEXT_STROKES_H
#define BURNISH_IMAGE_TEXT_STROKES_H

#include <stddef.h>
#include <stdint.h>

#include "base/arithmetic.h"
#include "base/memory.h"
#include "burnish/image.h"
#include "core/tasks.h"

/* A segment and the pen that draws it, in pixels from the top left corner of the picture: the
 * centre of the first pixel is (0.5, 0.5). Equal ends are a dot. */
typedef struct burnish_stroke {
    float x0, y0, x1, y1;
    float radius; /* half the line's width, (0, 1024] */
} burnish_stroke;

/* The colour of strokes. */
typedef struct burnish_ink {
    float linear[3]; /* light, [0, 1] */
    float opacity;   /* [0, 1] */
} burnish_ink;

burnish_ink burnish_ink_of(const uint8_t srgb[3], float opacity);

/* Draws any number of strokes as one figure. A pixel has the coverage of the stroke that covers
 * most of it. Joints and crossings are therefore not darker than lines:
 *   clamp(1/2 + radius - distance from the pixel's centre to the segment, 0, min(1, 2 radius)).
 * The integral across a line is its width, however thin it is. Strokes may reach beyond the image;
 * strokes with an end further than 1e9 pixels away, or not a number, are skipped. The bits are the
 * same on every machine.
 *   pixels   any format; with a fourth channel alpha grows where there is ink
 *   strokes  count of them
 *   tasks    NULL: the caller alone
 * Memory: 64 bytes per pixel of a row for each thread; 4 per stroke and band of 16 rows that it
 * reaches, at most 4 MiB or 4 per stroke.
 * Errors: ARGUMENT (invalid pixels, a radius out of range), MEMORY, LIMIT, CANCELLED. */
burnish_status burnish_strokes_draw(const burnish_pixels *pixels, const burnish_stroke *strokes,
                                    size_t count, const burnish_ink *ink, burnish_tasks *tasks,
                                    burnish_memory *memory);

/* Rows of an image. */
typedef struct burnish_pixel_rows {
    const burnish_pixels *pixels; /* that hold them */
    int first_row;                /* of the image that pixels hold */
    int height;                   /* of the image */
} burnish_pixel_rows;

/* The same for some rows of an image. The bits are the same as in the whole image. */
burnish_status burnish_strokes_draw_rows(const burnish_pixel_rows *rows,
                                         const burnish_stroke *strokes, size_t count,
                                         const burnish_ink *ink, burnish_tasks *tasks,
                                         burnish_memory *memory);

/* ---- The same in pieces, without memory of its own ---- */

typedef struct burnish_rectangle {
    int left, top, right, bottom; /* pixels; right and bottom exclusive */
} burnish_rectangle;

/* The pixels that a stroke can touch, within a picture. */
burnish_rectangle burnish_stroke_bounds(const burnish_stroke *stroke, int width, int height);

/* Cuts [*from, *to] of p + t d to where it is in [low, high]. Returns 0 if nothing is left. */
int burnish_cut_to_range(double p, double d, double low, double high, double *from, double *to);

/* Raises coverage[i] of pixels first + i of a row to the stroke's. */
void burnish_stroke_cover(const burnish_stroke *stroke, int row, int first, int count,
                          float *coverage);

/* Mixes ink over the pixels first + i of a row that are covered. */
void burnish_ink_blend(const burnish_pixels *pixels, int row, int first, int count,
                       const float *coverage, const burnish_ink *ink);

#endif
