/* burnish/drawing.h: a drawing of lines and areas, written as SVG.
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
