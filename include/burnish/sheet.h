/* burnish/sheet.h: contact sheets of images or drawings, and their labels.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_SHEET_H
#define BURNISH_SHEET_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/drawing.h"
#include "burnish/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Text ---- */

/* Draws one line of text (ASCII 32..126, others as '?') with a stroke font of round pens,
 * antialiased in linear light. x, y: left end of the baseline in pixels from the top left; height:
 * of a capital letter, in pixels, at least 5; color: sRGB 0..255. Parts outside the image are left
 * out. Returns the advance in pixels; with image NULL it only measures. */
BURNISH_API float burnish_image_draw_text(burnish_image *image, float x, float y, float height,
                                          const uint8_t color[3], const char *text);

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

/* ---- Sheets ---- */

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

#ifdef __cplusplus
}
#endif

#endif
