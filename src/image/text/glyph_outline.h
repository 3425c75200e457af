/* Outlines: closed curves filled with exact area coverage, all in integers. */
#ifndef BURNISH_IMAGE_TEXT_GLYPH_OUTLINE_H
#define BURNISH_IMAGE_TEXT_GLYPH_OUTLINE_H

#include "base/memory.h"
#include "burnish/image.h"
#include "burnish/sheet.h"
#include "image/text/strokes.h"

/* A straight piece of an outline, in 1/256 pixels from the top left corner of the picture. */
typedef struct burnish_outline_edge {
    int32_t x0, y0, x1, y1;
} burnish_outline_edge;

/* The edges of an outline that is being built. */
typedef struct burnish_outline {
    burnish_outline_edge *edges;
    size_t count, capacity;
    int32_t x, y;            /* of the origin of the points that are added */
    int32_t at[2], start[2]; /* the current point and the contour's first */
    burnish_memory *memory;
} burnish_outline;

/* A burnish_outline_sink; user_data is a burnish_outline. */
void burnish_outline_add(void *user_data, burnish_outline_verb verb, const int32_t *points);

/* Fills what the edges enclose. A pixel's coverage is the absolute value of the area that they wind
 * around in it, at most 1. Contours of the same sense may overlap. Releases the edges.
 * Errors: MEMORY. */
burnish_status burnish_outline_fill(burnish_outline *outline, const burnish_pixels *pixels,
                                    const burnish_ink *ink);

#endif
