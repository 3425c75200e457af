/* burnish/drawing.h: a drawing of lines and areas, written as SVG or PDF.
 *
 * burnish_renderer_trace() of render.h adds a mesh to a drawing, burnish_annotate_drawing() of
 * annotate.h dimensions and axes, burnish_drawing_sheet() of sheet.h arranges several.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DRAWING_H
#define BURNISH_DRAWING_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Lines and areas, from back to front. One thread at a time may use a drawing. After an error of a
 * function that adds to a drawing, it can only be destroyed. */
typedef struct burnish_drawing burnish_drawing;

/* Creates an empty drawing.
 *   context        supplies memory; NULL: the default. Must outlive the drawing
 *   width, height  in pixels, [1, BURNISH_IMAGE_MAX_SIZE]
 *   drawing        receives the drawing; release it with burnish_drawing_destroy()
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_drawing_create(const burnish_context *context, int width,
                                                  int height, burnish_drawing **drawing,
                                                  burnish_error *error);

/* Encodes a drawing as SVG, with the same bytes on every machine. It contains only paths, whose
 * coordinates are pixels with two decimals. Letters are paths with an aria-label, so the file needs
 * no font.
 *   title          UTF-8; what is not becomes '?'; NULL: no title
 *   background     sRGB; NULL: transparent
 *   dots_per_inch  [1, 1e6]: the size is in millimetres, 25.4 pixels / dots_per_inch; 0: the size
 *                  is in pixels
 *   text           receives the file and a terminating 0, NULL on error; release it with
 *                  burnish_release() and the context of the drawing
 *   size           receives the size in bytes, without the 0
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_drawing_encode_svg(const burnish_drawing *drawing,
                                                      const char *title,
                                                      const uint8_t background[3],
                                                      double dots_per_inch, char **text,
                                                      size_t *size, burnish_error *error);

/* Encodes a drawing as a PDF of one page, with the same bytes on every machine. Letters are paths;
 * labels are in addition invisible text, which readers can search.
 *   title          ASCII; other characters become '?'; NULL: no title
 *   dots_per_inch  [1, 1e6]; 0: 96
 * Other parameters and errors as for burnish_drawing_encode_svg(). */
BURNISH_API burnish_status burnish_drawing_encode_pdf(const burnish_drawing *drawing,
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
