/* Drawings as SVG. */
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "core/float_mode.h"
#include "image/text/drawing.h"

typedef struct svg {
    burnish_text_writer out;
    int has_point; /* 1: the current path has a point; the next one is relative to it */
    int32_t x, y;  /* that point, hundredths */
} svg;

/* What replaces a character of `size` bytes (0: not UTF-8) that XML would read or not allow; NULL:
 * nothing. */
static const char *xml_replacement(const char *text, size_t size) {
    switch (*text) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    default:
        break;
    }
    if (*text > 0 && *text < ' ') {
        return " ";
    }
    const int is_noncharacter =
        size == 3 && (memcmp(text, "\xEF\xBF\xBE", 3) == 0 || memcmp(text, "\xEF\xBF\xBF", 3) == 0);
    return size == 0 || is_noncharacter ? "?" : NULL;
}

static void put_escaped(svg *w, const char *text) {
    while (*text) {
        const size_t size = burnish_printable_size(text);
        const char *replaced = xml_replacement(text, size);
        burnish_put(&w->out, replaced ? replaced : text, replaced ? strlen(replaced) : size);
        text += size > 0 ? size : 1;
    }
}

static void put_color(svg *w, const uint8_t color[3]) {
    char text[8];
    snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
    burnish_put(&w->out, text, 7);
}

/* A line as a move to its first point and relative steps; points that rounding makes equal are
 * skipped. */
static void put_line(svg *w, const float *p, size_t count) {
    int32_t x = burnish_to_hundredths(p[0]), y = burnish_to_hundredths(p[1]);
    const int32_t start_x = x, start_y = y;
    burnish_put_text(&w->out, w->has_point ? "m" : "M");
    burnish_put_decimal(&w->out, x - (w->has_point ? w->x : 0), 2, 0);
    burnish_put_decimal(&w->out, y - (w->has_point ? w->y : 0), 2, 1);
    int steps = 0;
    for (size_t i = 1; i < count; ++i) {
        const int32_t next_x = burnish_to_hundredths(p[2 * i]),
                      next_y = burnish_to_hundredths(p[2 * i + 1]);
        const int closes = i + 1 == count && steps > 1 && next_x == start_x && next_y == start_y;
        if (closes) {
            burnish_put_text(&w->out, "z");
        } else if (next_x != x || next_y != y || (i + 1 == count && steps == 0)) {
            burnish_put_text(&w->out, steps == 0 ? "l" : "");
            burnish_put_decimal(&w->out, next_x - x, 2, steps > 0);
            burnish_put_decimal(&w->out, next_y - y, 2, 1);
            ++steps;
        }
        x = next_x;
        y = next_y;
    }
    w->x = x;
    w->y = y;
    w->has_point = 1;
}

/* ---- Operations ---- */

static void put_name(svg *w, const char *name) {
    if (name) {
        burnish_put_text(&w->out, " aria-label=\"");
        put_escaped(w, name);
        burnish_put_text(&w->out, "\"");
    }
}

static void put_paint(svg *w, const char *attribute, const burnish_drawing_op *op) {
    burnish_put_text(&w->out, attribute);
    put_color(w, op->color);
    burnish_put_text(&w->out, "\"");
}

static void put_path(svg *w, const burnish_drawing *drawing, const burnish_drawing_op *op) {
    const int is_stroke = op->kind == BURNISH_DRAWING_LINES || op->kind == BURNISH_DRAWING_HATCH;
    burnish_put_text(&w->out, "<path");
    put_name(w, burnish_drawing_name(drawing, op));
    if (op->kind == BURNISH_DRAWING_HATCH) {
        put_paint(w, " fill=\"none\" stroke=\"", op);
    } else if (op->kind == BURNISH_DRAWING_AREA) {
        put_paint(w, " fill=\"", op);
    }
    if (op->is_even_odd) {
        burnish_put_text(&w->out, " fill-rule=\"evenodd\"");
    }
    if (is_stroke) {
        burnish_put_number(&w->out, " stroke-width=\"", burnish_to_hundredths(op->width), "\"");
    }
    burnish_put_text(&w->out, " d=\"");
    w->has_point = 0;
    for (size_t i = op->first; i < op->end; ++i) {
        const size_t first = drawing->starts[i];
        put_line(w, drawing->points + 2 * first, drawing->starts[i + 1] - first);
    }
    burnish_put_text(&w->out, "\"/>\n");
}

static void put_op(svg *w, const burnish_drawing *drawing, const burnish_drawing_op *op) {
    switch (op->kind) {
    case BURNISH_DRAWING_OPEN:
        put_paint(w, "<g fill=\"none\" stroke=\"", op);
        burnish_put_text(&w->out, " stroke-linecap=\"round\" stroke-linejoin=\"round\"");
        if (op->width < 1) {
            burnish_put_number(&w->out, " opacity=\"", burnish_to_hundredths(op->width), "\"");
        }
        burnish_put_text(&w->out, ">\n");
        break;
    case BURNISH_DRAWING_CLOSE:
        burnish_put_text(&w->out, "</g>\n");
        break;
    case BURNISH_DRAWING_PLACE:
        burnish_put_number(&w->out, "<svg x=\"", 100 * op->area[0], "\"");
        burnish_put_number(&w->out, " y=\"", 100 * op->area[1], "\"");
        burnish_put_number(&w->out, " width=\"", 100 * op->area[2], "\"");
        burnish_put_number(&w->out, " height=\"", 100 * op->area[3], "\">\n");
        break;
    case BURNISH_DRAWING_LEAVE:
        burnish_put_text(&w->out, "</svg>\n");
        break;
    default:
        put_path(w, drawing, op);
    }
}

/* ---- The file ---- */

/* pixels / dots_per_inch, in ten thousandths of a millimetre. */
static int64_t ten_thousandths(int pixels, double dots_per_inch) {
    return (int64_t)(pixels * 254000.0 / dots_per_inch + 0.5);
}

static void put_size(svg *w, const char *before, int pixels, double dots_per_inch) {
    burnish_put_text(&w->out, before);
    if (dots_per_inch > 0) {
        burnish_put_decimal(&w->out, ten_thousandths(pixels, dots_per_inch), 4, 0);
        burnish_put_text(&w->out, "mm\"");
    } else {
        burnish_put_decimal(&w->out, pixels, 0, 0);
        burnish_put_text(&w->out, "\"");
    }
}

static void put_head(svg *w, const burnish_drawing *drawing, const char *title,
                     const uint8_t background[3], double dots_per_inch) {
    put_size(w, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", drawing->width,
             dots_per_inch);
    put_size(w, " height=\"", drawing->height, dots_per_inch);
    burnish_put_number(&w->out, " viewBox=\"0 0 ", 100 * drawing->width, " ");
    burnish_put_number(&w->out, "", 100 * drawing->height, "\">\n<!-- burnish -->\n");
    if (title) {
        burnish_put_text(&w->out, "<title>");
        put_escaped(w, title);
        burnish_put_text(&w->out, "</title>\n");
    }
    if (background) {
        burnish_put_text(&w->out, "<rect width=\"100%\" height=\"100%\" fill=\"");
        put_color(w, background);
        burnish_put_text(&w->out, "\"/>\n");
    }
}

burnish_status burnish_drawing_encode_svg(const burnish_drawing *drawing, const char *title,
                                          const uint8_t background[3], double dots_per_inch,
                                          char **text, size_t *size, burnish_error *error) {
    const burnish_status status =
        burnish_drawing_check_encode("SVG", drawing, dots_per_inch, text && size, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    svg file = {.out = {.memory = burnish_memory_of(drawing->context, error)}};
    put_head(&file, drawing, title, background, dots_per_inch);
    for (size_t i = 0; i < drawing->op_count; ++i) {
        put_op(&file, drawing, &drawing->ops[i]);
    }
    burnish_put_text(&file.out, "</svg>\n");
    burnish_float_mode_leave(float_mode);
    return burnish_drawing_end_encode(&file.out, text, size);
}
