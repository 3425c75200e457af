/* Drawings within the library: what the public functions put into one.
 *
 * A drawing is the text of an SVG's body, in the order of the calls: later parts cover earlier
 * ones. Coordinates are pixels from the top left corner, rounded to hundredths; libc does not
 * format them, since a locale could change its output. */
#ifndef BURNISH_IMAGE_TEXT_DRAWING_H
#define BURNISH_IMAGE_TEXT_DRAWING_H

#include "burnish/drawing.h"
#include "burnish/image.h"
#include "burnish/sheet.h"
#include "core/memory.h"
#include "image/text/outline.h"
#include "image/text/strokes.h"

struct burnish_drawing {
    const burnish_context *context;
    int width, height;
    burnish_memory memory; /* of the current call */
    char *text;
    size_t size, capacity;
    int has_point; /* 1: the current path has a point; the next one is relative to it */
    int32_t x, y;  /* that point, hundredths */
    float *points; /* of the current line: x, y */
    size_t point_count, point_capacity;
};

/* Errors of the functions below go to `error`, and stay in drawing->memory.status. */
void burnish_drawing_use(burnish_drawing *drawing, burnish_error *error);

/* A group of lines in one colour; opacity counts for the group as a whole, so crossings are no
 * darker. */
void burnish_drawing_open(burnish_drawing *drawing, const uint8_t color[3], float opacity);
void burnish_drawing_close(burnish_drawing *drawing);

/* One path for all lines of one width.
 *   starts  count + 1: of each line its first point
 *   points  x, y of each point
 *   widths  of each line */
void burnish_drawing_lines(burnish_drawing *drawing, const uint32_t *starts, const float *points,
                           const float *widths, size_t count);

/* One path for all strokes of one radius; strokes that continue each other are one line.
 *   name  the text that the strokes show, an attribute of the first path; NULL: none */
void burnish_drawing_strokes(burnish_drawing *drawing, const burnish_stroke *strokes, size_t count,
                             const char *name);

/* An area between closed lines: begin, each line, end.
 *   is_even_odd  1: a line inside another is a hole; 0: one of the same sense is not
 *   points       count of them, the last one equal to the first */
void burnish_drawing_begin_area(burnish_drawing *drawing, const uint8_t color[3], int is_even_odd);
void burnish_drawing_add_border(burnish_drawing *drawing, const float *points, size_t count);
void burnish_drawing_end_area(burnish_drawing *drawing);

/* Lines of one width whose ends are cut straight: x0, y0, x1, y1 of each. */
void burnish_drawing_hatch(burnish_drawing *drawing, const uint8_t color[3], float width,
                           const float *lines, size_t count);

/* A letter's outline, in the outline's colour. */
void burnish_drawing_outline(burnish_drawing *drawing, const burnish_outline *outline,
                             const uint8_t color[3], const char *name);

/* Another drawing, moved; what is outside its picture does not show. */
void burnish_drawing_place(burnish_drawing *drawing, const burnish_drawing *part, int x, int y);

#endif
