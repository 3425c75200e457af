/* burnish/sheet.h: contact sheets and aligned views of images or drawings, and their labels.
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

/* Draws one line of text with burnish's stroke font, antialiased in linear light.
 *   image   receives the text; NULL: only measure. Parts outside the image are skipped
 *   x, y    left end of the baseline, in pixels from the top left corner
 *   height  of a capital letter in pixels, at least 5
 *   color   sRGB
 *   text    ASCII 32 to 126, and \u00d8 as the sign of a diameter; Latin letters lose their
 *           accents, other characters become '?'
 * Returns the advance in pixels. */
BURNISH_API float burnish_image_draw_text(burnish_image *image, float x, float y, float height,
                                          const uint8_t color[3], const char *text);

/* The segments of an outline, with the number of points that each one has. */
typedef enum burnish_outline_verb {
    BURNISH_OUTLINE_MOVE,  /* 1: begins a contour; the previous contour is closed */
    BURNISH_OUTLINE_LINE,  /* 1 */
    BURNISH_OUTLINE_CONIC, /* 2: control, end */
    BURNISH_OUTLINE_CUBIC  /* 3: control, control, end */
} burnish_outline_verb;

/* Receives a segment.
 *   user_data  the take_data of burnish_font.set_line
 *   points     x, y of each point in 1/256 pixels, y upward */
typedef void burnish_outline_sink(void *user_data, burnish_outline_verb verb,
                                  const int32_t *points);

/* A font for text that burnish's stroke font has no letters for. Outlines are filled with exact
 * area coverage in integers, so the pixels depend only on the font.
 *   set_line     sets one line of UTF-8 from its left end: passes the outlines to take, unless take
 *                is NULL, and returns the advance in 1/256 pixels
 *     text       length bytes of UTF-8
 *     height     of a capital letter, in pixels
 *     take_data  passed to take
 *   user_data    passed to set_line */
typedef struct burnish_font {
    int32_t (*set_line)(void *user_data, const char *text, size_t length, int height,
                        burnish_outline_sink *take, void *take_data);
    void *user_data;
} burnish_font;

/* ---- Sheets ---- */

/* One cell of a contact sheet. */
typedef struct burnish_sheet_cell {
    const burnish_image *image; /* of the same size and channels in all cells */
    const char *label;          /* one line under the image; NULL or "": no label */
    const burnish_font *font;   /* for the label; NULL: burnish's stroke font */
} burnish_sheet_cell;

/* The size of a sheet that burnish_image_sheet() would make. The pixels of the images can be NULL.
 *   cells          count of them
 *   columns        [1, count]
 *   width, height  receive the size in pixels, 0 on error
 * Errors: ARGUMENT (cells differ in size, or the sheet exceeds BURNISH_IMAGE_MAX_SIZE). */
BURNISH_API burnish_status burnish_image_sheet_size(const burnish_sheet_cell *cells, size_t count,
                                                    int columns, int *width, int *height,
                                                    burnish_error *error);

/* Arranges images row by row in a new image, with a label below each.
 *   sheet       receives the image, empty on error. It uses the context of the first image
 *   cells       count of them
 *   columns     [1, count]
 *   background  sRGB of the margins
 *   ink         sRGB of the labels
 * Errors: ARGUMENT (cells differ in size, or the sheet exceeds BURNISH_IMAGE_MAX_SIZE), MEMORY. */
BURNISH_API burnish_status burnish_image_sheet(burnish_image *sheet,
                                               const burnish_sheet_cell *cells, size_t count,
                                               int columns, const uint8_t background[3],
                                               const uint8_t ink[3], burnish_error *error);

/* Arranges drawings in a new drawing, with the layout of burnish_image_sheet().
 *   cells     their sizes and labels; the pixels can be NULL
 *   drawings  one per cell, of the size of the cells; copied
 *   columns   [1, count]
 *   ink       sRGB of the labels
 *   sheet     receives the drawing, NULL on error. It uses the context of the first drawing
 * Errors: as for burnish_image_sheet(); also ARGUMENT for a drawing of another size. */
BURNISH_API burnish_status burnish_drawing_sheet(const burnish_sheet_cell *cells,
                                                 burnish_drawing *const *drawings, size_t count,
                                                 int columns, const uint8_t ink[3],
                                                 burnish_drawing **sheet, burnish_error *error);

/* ---- Aligned views ---- */

/* Where the views are: in third angle the top view is above the front view, and the right view at
 * its right; in first angle the top view is below, and the left view at the right. */
typedef enum burnish_projection_method {
    BURNISH_PROJECTION_THIRD_ANGLE,
    BURNISH_PROJECTION_FIRST_ANGLE
} burnish_projection_method;

/* The views. SIDE is the right view in third angle, the left view in first angle. */
enum {
    BURNISH_PROJECTION_FRONT,
    BURNISH_PROJECTION_TOP,
    BURNISH_PROJECTION_SIDE,
    BURNISH_PROJECTION_PICTORIAL, /* in the free corner */
    BURNISH_PROJECTION_SECTION,   /* there is none unless `section` is set */
    BURNISH_PROJECTION_VIEWS
};

/* A rectangle of pixels. */
typedef struct burnish_projection_area {
    int x, y, width, height;
} burnish_projection_area;

/* A page with three aligned views at one scale, a pictorial view, and possibly a section: right of
 * the front and side views, or of the top view if it cuts across the height. */
typedef struct burnish_projection {
    burnish_projection_method method;
    int width, height; /* pixels, from 240 */
    double extents[3]; /* of the object: width, height and depth in the front view; >= 0, with a sum
                          above 0 */
    double pixels_per_millimetre; /* > 0: a unit is a millimetre, and the scale on paper is 1, 2 or
                                     5 times a power of 10, or 1 divided by that (ISO 5455); 0: the
                                     largest scale that fits */
    const char *paper; /* "A3": pixels_per_millimetre is above 0, the frame has the margins
                                     of ISO 5457, and the title block states it; NULL: none */
    int section;       /* 1, 2, 3: there is one, across width, height or depth */
    /* Set by burnish_projection_lay_out(): */
    double pixels_per_unit; /* of all but the pictorial view */
    char scale[16];         /* "1:2"; "": not a scale on paper */
    double text_height;     /* of a capital, pixels */
    burnish_projection_area
        cells[BURNISH_PROJECTION_VIEWS]; /* the object is in the middle of its cell */
} burnish_projection;

/* Computes scale and positions. Errors: ARGUMENT. */
BURNISH_API burnish_status burnish_projection_lay_out(burnish_projection *projection,
                                                      burnish_error *error);

/* Composes views into an image, with a frame and a title block: title, paper, mm and scale as far
 * as they are known, and the symbol of the method (a truncated cone, ISO 5456-2).
 *   projection  laid out
 *   title       ASCII, cut where the block ends; NULL: none
 *   views       of the sizes of the cells, with equal channels; the section's only if there is one
 *   background  sRGB
 *   ink         sRGB of lines and letters
 *   image       receives the image, empty on error. It uses the context of the first view
 * Errors: MEMORY. */
BURNISH_API burnish_status burnish_projection_image(
    const burnish_projection *projection, const char *title,
    const burnish_image *const views[BURNISH_PROJECTION_VIEWS], const uint8_t background[3],
    const uint8_t ink[3], burnish_image *image, burnish_error *error);

/* The same of drawings, which are copied.
 *   drawing  receives the drawing, NULL on error. It uses the context of the first view
 * Other parameters and errors as for burnish_projection_image(). */
BURNISH_API burnish_status
burnish_projection_drawing(const burnish_projection *projection, const char *title,
                           burnish_drawing *const views[BURNISH_PROJECTION_VIEWS],
                           const uint8_t ink[3], burnish_drawing **drawing, burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
