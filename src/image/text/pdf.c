/* Drawings as PDF 1.4: one page whose content is the display list, uncompressed. Names of lines and
 * areas are in addition invisible text, which readers can search and copy. */
#include "burnish/drawing.h"

#include <string.h>

#include "base/error.h"
#include "core/float_mode.h"
#include "image/text/drawing.h"
#include "image/text/text.h"

/* Objects: 1 the catalog, 2 the list of pages, 3 the page, 4 its content, 5 the facts. */
enum { OBJECTS = 5, PERCENT = 100 };

typedef struct pdf {
    burnish_text_writer out;
    size_t offsets[OBJECTS + 1];
    uint8_t has_opacity[PERCENT + 1]; /* of a percentage: 1: a group has it */
} pdf;

static void put_text(pdf *w, const char *text) {
    burnish_put_text(&w->out, text);
}

/* Other than in SVG, a sign needs a blank before it. */
static void put_number(pdf *w, int64_t value, int digits) {
    put_text(w, " ");
    burnish_put_decimal(&w->out, value, digits, 0);
}

static void put_hundredths(pdf *w, int32_t value) {
    put_number(w, value, 2);
}

/* A component of a colour, as 10000ths of 1. */
static void put_color(pdf *w, const uint8_t color[3], const char *operator) {
    for (int k = 0; k < 3; ++k) {
        put_number(w, (color[k] * 10000 + 127) / 255, 4);
    }
    put_text(w, operator);
}

/* A string in parentheses; characters beyond ASCII become ?, but for the diameter. */
static void put_string(pdf *w, const char *text) {
    put_text(w, "(");
    for (; *text; ++text) {
        const char c = *text;
        if (c == '(' || c == ')' || c == '\\') {
            put_text(w, "\\");
        }
        if (((unsigned char)c & 0xC0) != 0x80) { /* once for a character of UTF-8 */
            const int is_diameter = strncmp(text, BURNISH_DIAMETER, 2) == 0;
            put_text(w, is_diameter ? "\\330" : c >= ' ' && c < 127 ? (char[]){c, 0} : "?");
        }
    }
    put_text(w, ")");
}

/* ---- Content ---- */

static int32_t hundredths_of(const burnish_drawing *drawing, size_t point, int axis) {
    return burnish_to_hundredths(drawing->points[2 * point + (size_t)axis]);
}

static void put_line(pdf *w, const burnish_drawing *drawing, size_t line, int is_area) {
    const size_t first = drawing->starts[line], end = drawing->starts[line + 1], last = end - 1;
    const int closes = end - first > 3 &&
                       hundredths_of(drawing, first, 0) == hundredths_of(drawing, last, 0) &&
                       hundredths_of(drawing, first, 1) == hundredths_of(drawing, last, 1);
    for (size_t i = first; i < end - (size_t)closes; ++i) {
        put_hundredths(w, hundredths_of(drawing, i, 0));
        put_hundredths(w, hundredths_of(drawing, i, 1));
        put_text(w, i == first ? " m" : " l");
    }
    put_text(w, closes || is_area ? " h\n" : "\n");
}

/* The name as text without ink, in the box of the path that shows it. */
static void put_name(pdf *w, const burnish_drawing *drawing, const burnish_drawing_op *op) {
    const char *name = burnish_drawing_name(drawing, op);
    if (!name || op->first == op->end) {
        return;
    }
    int32_t left = INT32_MAX, top = INT32_MAX, bottom = INT32_MIN;
    for (size_t i = drawing->starts[op->first]; i < drawing->starts[op->end]; ++i) {
        const int32_t x = hundredths_of(drawing, i, 0), y = hundredths_of(drawing, i, 1);
        left = x < left ? x : left;
        top = y < top ? y : top;
        bottom = y > bottom ? y : bottom;
    }
    put_text(w, "BT /F1");
    put_hundredths(w, bottom - top);
    put_text(w, " Tf 3 Tr 1 0 0 -1");
    put_hundredths(w, left);
    put_hundredths(w, bottom);
    put_text(w, " Tm ");
    put_string(w, name);
    put_text(w, " Tj ET\n");
}

static void put_path(pdf *w, const burnish_drawing *drawing, const burnish_drawing_op *op) {
    const int is_area = op->kind == BURNISH_DRAWING_AREA;
    put_name(w, drawing, op);
    if (is_area) {
        put_color(w, op->color, " rg\n");
    } else if (op->kind == BURNISH_DRAWING_HATCH) {
        put_text(w, "q 0 J");
        put_color(w, op->color, " RG");
    }
    if (!is_area) {
        put_hundredths(w, burnish_to_hundredths(op->width));
        put_text(w, " w\n");
    }
    for (size_t i = op->first; i < op->end; ++i) {
        put_line(w, drawing, i, is_area);
    }
    put_text(w, !is_area ? "S\n" : op->is_even_odd ? "f*\n" : "f\n");
    put_text(w, op->kind == BURNISH_DRAWING_HATCH ? "Q\n" : "");
}

static int percent_of(float opacity) {
    const int percent = burnish_to_hundredths(opacity);
    return percent < 0 ? 0 : percent > PERCENT ? PERCENT : percent;
}

static void put_op(pdf *w, const burnish_drawing *drawing, const burnish_drawing_op *op) {
    switch (op->kind) {
    case BURNISH_DRAWING_OPEN:
        put_text(w, "q 1 J 1 j");
        if (op->width < 1) {
            put_text(w, " /G");
            burnish_put_decimal(&w->out, percent_of(op->width), 0, 0);
            put_text(w, " gs");
            w->has_opacity[percent_of(op->width)] = 1;
        }
        put_color(w, op->color, " RG\n");
        break;
    case BURNISH_DRAWING_PLACE:
        put_text(w, "q 1 0 0 1");
        put_number(w, op->area[0], 0);
        put_number(w, op->area[1], 0);
        put_text(w, " cm 0 0");
        put_number(w, op->area[2], 0);
        put_number(w, op->area[3], 0);
        put_text(w, " re W n\n");
        break;
    case BURNISH_DRAWING_CLOSE:
    case BURNISH_DRAWING_LEAVE:
        put_text(w, "Q\n");
        break;
    default:
        put_path(w, drawing, op);
    }
}

/* Pixels of the drawing, downward from the top left corner, become points of the page. */
static void put_content(pdf *w, const burnish_drawing *drawing, const uint8_t background[3],
                        double points) {
    const int64_t scale = (int64_t)(points * 1e6 + 0.5);
    burnish_put_decimal(&w->out, scale, 6, 0);
    put_text(w, " 0 0");
    put_number(w, -scale, 6);
    put_text(w, " 0");
    put_number(w, (int64_t)(drawing->height * points * 1e4 + 0.5), 4);
    put_text(w, " cm\n");
    if (background) {
        put_color(w, background, " rg 0 0");
        put_number(w, drawing->width, 0);
        put_number(w, drawing->height, 0);
        put_text(w, " re f\n");
    }
    for (size_t i = 0; i < drawing->op_count; ++i) {
        put_op(w, drawing, &drawing->ops[i]);
    }
}

/* ---- The file ---- */

static void begin_object(pdf *w, size_t number) {
    w->offsets[number] = w->out.size;
    burnish_put_decimal(&w->out, (int64_t)number, 0, 0);
    put_text(w, " 0 obj\n");
}

static void put_page(pdf *w, const burnish_drawing *drawing, double points) {
    begin_object(w, 3);
    put_text(w, "<< /Type /Page /Parent 2 0 R /Contents 4 0 R /MediaBox [0 0");
    put_number(w, (int64_t)(drawing->width * points * 1e4 + 0.5), 4);
    put_number(w, (int64_t)(drawing->height * points * 1e4 + 0.5), 4);
    put_text(w, "] /Resources << /Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica "
                "/Encoding /WinAnsiEncoding "
                ">> >> /ExtGState <<");
    for (int i = 0; i <= PERCENT; ++i) {
        if (w->has_opacity[i]) {
            put_text(w, " /G");
            burnish_put_decimal(&w->out, i, 0, 0);
            put_text(w, " << /CA");
            put_hundredths(w, i);
            put_text(w, " >>");
        }
    }
    put_text(w, " >> >> >>\nendobj\n");
}

static void put_objects(pdf *w, const burnish_drawing *drawing, const char *title,
                        const burnish_text_writer *content, double points) {
    put_text(w, "%PDF-1.4\n%burnish\n");
    begin_object(w, 1);
    put_text(w, "<< /Type /Catalog /Pages 2 0 R >>\nendobj\n");
    begin_object(w, 2);
    put_text(w, "<< /Type /Pages /Kids [3 0 R] /Count 1 >>\nendobj\n");
    put_page(w, drawing, points);
    begin_object(w, 4);
    put_text(w, "<< /Length");
    put_number(w, (int64_t)content->size, 0);
    put_text(w, " >>\nstream\n");
    burnish_put(&w->out, content->text, content->size);
    put_text(w, "endstream\nendobj\n");
    begin_object(w, 5);
    put_text(w, "<< /Producer (burnish)");
    if (title) {
        put_text(w, " /Title ");
        put_string(w, title);
    }
    put_text(w, " >>\nendobj\n");
}

/* The table of objects, whose offsets have ten digits. */
static void put_table(pdf *w) {
    const size_t start = w->out.size;
    put_text(w, "xref\n0 6\n0000000000 65535 f \n");
    for (int i = 1; i <= OBJECTS; ++i) {
        char digits[] = "0000000000 00000 n \n";
        size_t rest = w->offsets[i];
        for (int k = 9; k >= 0; --k, rest /= 10) {
            digits[k] = (char)('0' + rest % 10);
        }
        put_text(w, digits);
    }
    put_text(w, "trailer\n<< /Size 6 /Root 1 0 R /Info 5 0 R >>\nstartxref\n");
    burnish_put_decimal(&w->out, (int64_t)start, 0, 0);
    put_text(w, "\n%%EOF\n");
}

burnish_status burnish_drawing_encode_pdf(const burnish_drawing *drawing, const char *title,
                                          const uint8_t background[3], double dots_per_inch,
                                          char **text, size_t *size, burnish_error *error) {
    const burnish_status status =
        burnish_drawing_check_encode("PDF", drawing, dots_per_inch, text && size, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    const double points = 72 / (dots_per_inch > 0 ? dots_per_inch : 96);
    pdf file = {.out = {.memory = burnish_memory_of(drawing->context, error)}};
    put_content(&file, drawing, background, points);
    burnish_text_writer content = file.out;
    file.out = (burnish_text_writer){.memory = content.memory};
    if (content.memory.status == BURNISH_STATUS_OK) {
        put_objects(&file, drawing, title, &content, points);
        put_table(&file);
    }
    burnish_release(drawing->context, content.text);
    burnish_float_mode_leave(float_mode);
    return burnish_drawing_end_encode(&file.out, text, size);
}
