/* Drawings within the library: what the public functions put into one.
 *
 * A drawing is a display list of operations in the order of the calls: later parts cover earlier
 * ones. Coordinates are pixels from the top left corner. svg.c and pdf.c round them to hundredths
 * and write them. */
#ifndef BURNISH_IMAGE_TEXT_DRAWING_H
#define BURNISH_IMAGE_TEXT_DRAWING_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"
#include "burnish/drawing.h"
#include "burnish/image.h"
#include "burnish/sheet.h"
#include "image/text/glyph_outline.h"
#include "image/text/strokes.h"

/* ---- Text with numbers that no locale changes ---- */

/* All zero before the first piece, but for memory, whose status errors go to. */
typedef struct burnish_text_writer {
    burnish_memory memory;
    char *text; /* ends in 0 */
    size_t size, capacity;
} burnish_text_writer;

void burnish_put(burnish_text_writer *w, const char *text, size_t size);
void burnish_put_text(burnish_text_writer *w, const char *text);

/* value / 10^digits as a decimal, in the shortest exact form, without a 0 before the point: -1205
 * with 2 digits is "-12.05". A blank separates it from a preceding number if necessary. */
void burnish_put_decimal(burnish_text_writer *w, int64_t value, int digits, int needs_blank);

/* A number of hundredths between two texts. */
void burnish_put_number(burnish_text_writer *w, const char *before, int32_t hundredths,
                        const char *after);

/* To the nearest hundredth, within 1e7. */
int32_t burnish_to_hundredths(float value);

typedef enum burnish_drawing_kind {
    BURNISH_DRAWING_OPEN,  /* a group of lines: color; width is its opacity */
    BURNISH_DRAWING_CLOSE, /* ... ends */
    BURNISH_DRAWING_LINES, /* of one width, in the group's colour, with round ends */
    BURNISH_DRAWING_HATCH, /* of one width, with ends that are cut straight */
    BURNISH_DRAWING_AREA,  /* between closed lines */
    BURNISH_DRAWING_PLACE, /* a drawing within this one: area */
    BURNISH_DRAWING_LEAVE  /* ... ends */
} burnish_drawing_kind;

typedef struct burnish_drawing_op {
    burnish_drawing_kind kind;
    uint8_t color[3];
    int is_even_odd; /* of an area */
    float width;
    int area[4];       /* x, y, width, height */
    size_t name;       /* 1 + where it starts in the names; 0: none */
    size_t first, end; /* lines */
} burnish_drawing_op;

struct burnish_drawing {
    const burnish_context *context;
    int width, height;
    burnish_memory memory; /* of the current call */
    burnish_drawing_op *ops;
    size_t op_count, op_capacity;
    size_t *starts; /* of each line its first point, and the end of the last */
    size_t line_count, start_capacity;
    float *points; /* x, y */
    size_t point_count, point_capacity;
    char *names; /* each ends in 0 */
    size_t name_size, name_capacity;
};

/* The text that an operation shows, or NULL. */
const char *burnish_drawing_name(const burnish_drawing *drawing, const burnish_drawing_op *op);

/* Checks arguments of encoders. Errors: ARGUMENT. */
burnish_status burnish_drawing_check_encode(const char *format, const burnish_drawing *drawing,
                                            double dots_per_inch, int has_target,
                                            burnish_error *error);

/* Hands over what was written; returns its status. */
burnish_status burnish_drawing_end_encode(burnish_text_writer *out, char **text, size_t *size);

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

/* An area between closed lines: begin, then each line.
 *   is_even_odd  1: a line inside another is a hole; 0: one of the same sense is not
 *   points       count of them, the last one equal to the first */
void burnish_drawing_begin_area(burnish_drawing *drawing, const uint8_t color[3], int is_even_odd);
void burnish_drawing_add_border(burnish_drawing *drawing, const float *points, size_t count);

/* Lines of one width whose ends are cut straight: x0, y0, x1, y1 of each. */
void burnish_drawing_hatch(burnish_drawing *drawing, const uint8_t color[3], float width,
                           const float *lines, size_t count);

/* A letter's outline, in the outline's colour. */
void burnish_drawing_outline(burnish_drawing *drawing, const burnish_outline *outline,
                             const uint8_t color[3], const char *name);

/* Another drawing, moved; what is outside its picture does not show. */
void burnish_drawing_place(burnish_drawing *drawing, const burnish_drawing *part, int x, int y);

#endif
