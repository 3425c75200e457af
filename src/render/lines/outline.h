/* A hairline along the outline of what a picture shows, where its colour is close to the
 * background's. It depends on integers only: the 8-bit values of each pixel, and the samples covered
 * in the pixel and its eight neighbours. */
#ifndef BURNISH_RENDER_LINES_OUTLINE_H
#define BURNISH_RENDER_LINES_OUTLINE_H

#include "base/memory.h"
#include "burnish/render.h"
#include "core/tasks.h"
#include "raster/fragments.h"

/* Covered samples of each pixel of some rows, and of one row above and below. Kept from frame to
 * frame; all zero before the first. */
typedef struct burnish_outline {
    uint8_t *samples;
    size_t capacity, stride;
    int first, end; /* rows of the picture */
    int width, sample_count;
} burnish_outline;

/* Whether options ask for a hairline. */
int burnish_outline_is_wanted(const burnish_render_options *options);

/* Makes room for the rows of a frame. Pixels outside the picture count as covered: no line follows
 * its border. Errors: MEMORY.
 *   continues  1: the last frame showed the same picture. If its rows end where these begin, its
 *              last row is kept
 *   rows       receives the rows of the picture around these, whose samples are missing: -1 if
 *              there are none */
burnish_status burnish_outline_begin(burnish_outline *outline,
                                     const burnish_render_options *options, int continues,
                                     int rows[2], burnish_memory *memory);

/* What a row of blocks covers. */
typedef struct burnish_outline_pixels {
    const int32_t *simple;   /* >= 0: all samples */
    const uint8_t *covered;  /* samples, if not simple. NULL: one sample per pixel */
    const uint16_t *layered; /* bits of the pixels that show layers, or NULL */
} burnish_outline_pixels;

/* Keeps a row of blocks.
 *   number        of the row in the tile
 *   first, end    pixel rows of the row of blocks that are kept
 *   pixels        NULL: nothing is covered */
void burnish_outline_store(const burnish_outline *outline, const burnish_tile *tile, int number,
                           int first, int end, const burnish_outline_pixels *pixels);

/* Draws the hairline into the pixels of the options' rows. */
void burnish_outline_draw(const burnish_outline *outline, const burnish_render_options *options,
                          const burnish_pixels *pixels, burnish_tasks *tasks);

#endif
