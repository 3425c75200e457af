/* Drawings: SVG. Numbers are written without libc, which would use the locale. */
#include "image/text/drawing.h"

#include <stdio.h>
#include <string.h>

#include "core/error.h"
#include "core/float_mode.h"

/* ---- Text ---- */

static void put(burnish_drawing *w, const char *text, size_t size) {
    w->text =
        burnish_reserve(&w->memory, w->text, &w->capacity, w->size + size + 1, 1, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        memcpy(w->text + w->size, text, size);
        w->size += size;
        w->text[w->size] = 0;
    }
}

static void put_text(burnish_drawing *w, const char *text) {
    put(w, text, strlen(text));
}

/* value / 10^digits as a decimal, in the shortest exact form, without a 0 before the point: -1205
 * with 2 digits is "-12.05". A blank separates it from a preceding number if necessary. */
static void put_decimal(burnish_drawing *w, int64_t value, int digits, int needs_blank) {
    char text[32];
    uint64_t rest = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    int at = (int)sizeof text, is_fraction = 0;
    for (int i = 0; i < digits; ++i, rest /= 10) {
        is_fraction |= rest % 10 != 0;
        if (is_fraction) {
            text[--at] = (char)('0' + rest % 10);
        }
    }
    if (is_fraction) {
        text[--at] = '.';
    }
    for (; rest > 0 || at == (int)sizeof text; rest /= 10) {
        text[--at] = (char)('0' + rest % 10);
    }
    if (value < 0) {
        text[--at] = '-';
    } else if (needs_blank) {
        text[--at] = ' ';
    }
    put(w, text + at, sizeof text - (size_t)at);
}

static void put_hundredths(burnish_drawing *w, int32_t value, int needs_blank) {
    put_decimal(w, value, 2, needs_blank);
}

/* To the nearest hundredth. Lines end within a picture, or little outside. */
static int32_t to_hundredths(float value) {
    const double scaled = (double)value * 100, most = 1e9;
    const double kept = scaled > -most ? scaled < most ? scaled : most : -most;
    return (int32_t)(kept < 0 ? kept - 0.5 : kept + 0.5);
}

/* Replaces XML's special characters, and characters that XML does not allow. */
static void put_escaped(burnish_drawing *w, const char *text) {
    for (; *text; ++text) {
        const unsigned char c = (unsigned char)*text;
        const char *escaped = c == '&'   ? "&amp;"
                              : c == '<' ? "&lt;"
                              : c == '>' ? "&gt;"
                              : c == '"' ? "&quot;"
                                         : NULL;
        if (escaped) {
            put_text(w, escaped);
        } else {
            put(w, c < ' ' || c == 127 ? " " : text, 1);
        }
    }
}

static void put_color(burnish_drawing *w, const uint8_t color[3]) {
    char text[8];
    snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
    put(w, text, 7);
}

static void put_number(burnish_drawing *w, const char *before, int32_t hundredths,
                       const char *after) {
    put_text(w, before);
    put_hundredths(w, hundredths, 0);
    put_text(w, after);
}

/* ---- Lines ---- */

/* A line as a move to its first point and relative steps; points that rounding makes equal are
 * skipped.
 */
static void put_line(burnish_drawing *w, const float *p, size_t count) {
    int32_t x = to_hundredths(p[0]), y = to_hundredths(p[1]);
    const int32_t start_x = x, start_y = y;
    put_text(w, w->has_point ? "m" : "M");
    put_hundredths(w, x - (w->has_point ? w->x : 0), 0);
    put_hundredths(w, y - (w->has_point ? w->y : 0), 1);
    int steps = 0;
    for (size_t i = 1; i < count; ++i) {
        const int32_t next_x = to_hundredths(p[2 * i]), next_y = to_hundredths(p[2 * i + 1]);
        const int closes = i + 1 == count && steps > 1 && next_x == start_x && next_y == start_y;
        if (closes) {
            put_text(w, "z");
        } else if (next_x != x || next_y != y || (i + 1 == count && steps == 0)) {
            put_text(w, steps == 0 ? "l" : "");
            put_hundredths(w, next_x - x, steps > 0);
            put_hundredths(w, next_y - y, 1);
            ++steps;
        }
        x = next_x;
        y = next_y;
    }
    w->x = x;
    w->y = y;
    w->has_point = 1;
}

static void begin_path(burnish_drawing *w, float width, const char *name) {
    put_text(w, "<path");
    if (name) {
        put_text(w, " aria-label=\"");
        put_escaped(w, name);
        put_text(w, "\"");
    }
    put_number(w, " stroke-width=\"", to_hundredths(width), "\" d=\"");
    w->has_point = 0;
}

static void end_path(burnish_drawing *w) {
    put_text(w, "\"/>\n");
}

void burnish_drawing_use(burnish_drawing *drawing, burnish_error *error) {
    drawing->memory = burnish_memory_of(drawing->context, error);
}

void burnish_drawing_open(burnish_drawing *drawing, const uint8_t color[3], float opacity) {
    put_text(drawing, "<g fill=\"none\" stroke=\"");
    put_color(drawing, color);
    put_text(drawing, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    if (opacity < 1) {
        put_number(drawing, " opacity=\"", to_hundredths(opacity), "\"");
    }
    put_text(drawing, ">\n");
}

void burnish_drawing_close(burnish_drawing *drawing) {
    put_text(drawing, "</g>\n");
}

/* Adds a value to the known ones; returns 1 if it is new. Frames have two widths, annotations a
 * few; values beyond the array are not drawn. */
typedef struct widths {
    float known[16];
    size_t count;
} widths;

static int is_new(widths *all, float width) {
    for (size_t i = 0; i < all->count; ++i) {
        if (all->known[i] == width) {
            return 0;
        }
    }
    if (all->count == sizeof all->known / sizeof *all->known) {
        return 0;
    }
    all->known[all->count++] = width;
    return 1;
}

void burnish_drawing_lines(burnish_drawing *drawing, const uint32_t *starts, const float *points,
                           const float *line_widths, size_t count) {
    widths all = {.count = 0};
    for (size_t first = 0; first < count; ++first) {
        const float width = line_widths[first];
        if (!is_new(&all, width)) {
            continue;
        }
        begin_path(drawing, width, NULL);
        for (size_t i = first; i < count; ++i) {
            if (line_widths[i] == width && starts[i + 1] > starts[i] + 1) {
                put_line(drawing, points + 2 * (size_t)starts[i], starts[i + 1] - starts[i]);
            }
        }
        end_path(drawing);
    }
}

static void push_point(burnish_drawing *w, float x, float y) {
    w->points = burnish_reserve(&w->memory, w->points, &w->point_capacity, 2 * w->point_count + 2,
                                sizeof *w->points, "a line");
    if (w->memory.status == BURNISH_STATUS_OK) {
        w->points[2 * w->point_count] = x;
        w->points[2 * w->point_count++ + 1] = y;
    }
}

static void flush_line(burnish_drawing *w) {
    if (w->point_count > 1) {
        put_line(w, w->points, w->point_count);
    }
    w->point_count = 0;
}

void burnish_drawing_strokes(burnish_drawing *drawing, const burnish_stroke *strokes, size_t count,
                             const char *name) {
    widths all = {.count = 0};
    for (size_t first = 0; first < count; ++first) {
        const float radius = strokes[first].radius;
        if (!is_new(&all, radius)) {
            continue;
        }
        begin_path(drawing, 2 * radius, all.count == 1 ? name : NULL); /* once */
        for (size_t i = first; i < count; ++i) {
            const burnish_stroke *s = &strokes[i];
            const size_t n = drawing->point_count;
            if (s->radius != radius) {
                continue;
            }
            if (n == 0 || drawing->points[2 * n - 2] != s->x0 ||
                drawing->points[2 * n - 1] != s->y0) {
                flush_line(drawing);
                push_point(drawing, s->x0, s->y0);
            }
            push_point(drawing, s->x1, s->y1);
        }
        flush_line(drawing);
        end_path(drawing);
    }
}

/* ---- Areas ---- */

void burnish_drawing_begin_area(burnish_drawing *drawing, const uint8_t color[3], int is_even_odd) {
    put_text(drawing, "<path fill=\"");
    put_color(drawing, color);
    put_text(drawing, is_even_odd ? "\" fill-rule=\"evenodd\" d=\"" : "\" d=\"");
    drawing->has_point = 0;
}

void burnish_drawing_add_border(burnish_drawing *drawing, const float *points, size_t count) {
    put_line(drawing, points, count);
}

void burnish_drawing_end_area(burnish_drawing *drawing) {
    end_path(drawing);
}

void burnish_drawing_hatch(burnish_drawing *drawing, const uint8_t color[3], float width,
                           const float *lines, size_t count) {
    if (count == 0) {
        return;
    }
    put_text(drawing, "<path fill=\"none\" stroke=\"");
    put_color(drawing, color);
    put_number(drawing, "\" stroke-width=\"", to_hundredths(width), "\" d=\"");
    drawing->has_point = 0;
    for (size_t i = 0; i < count; ++i) {
        put_line(drawing, lines + 4 * i, 2);
    }
    end_path(drawing);
}

void burnish_drawing_outline(burnish_drawing *drawing, const burnish_outline *outline,
                             const uint8_t color[3], const char *name) {
    put_text(drawing, "<path aria-label=\"");
    put_escaped(drawing, name);
    put_text(drawing, "\" fill=\"");
    put_color(drawing, color);
    put_text(drawing, "\" d=\"");
    drawing->has_point = 0;
    for (size_t i = 0; i < outline->count; ++i) {
        const burnish_outline_edge *e = &outline->edges[i];
        const float x = (float)e->x0 / 256, y = (float)e->y0 / 256;
        const size_t n = drawing->point_count;
        /* outlines have no edges along a row: edges that continue in a row are one line */
        if (n > 0 && drawing->points[2 * n - 1] != y) {
            flush_line(drawing);
        }
        push_point(drawing, x, y);
        push_point(drawing, (float)e->x1 / 256, (float)e->y1 / 256);
    }
    flush_line(drawing);
    end_path(drawing);
}

void burnish_drawing_place(burnish_drawing *drawing, const burnish_drawing *part, int x, int y) {
    put_number(drawing, "<svg x=\"", 100 * x, "\"");
    put_number(drawing, " y=\"", 100 * y, "\"");
    put_number(drawing, " width=\"", 100 * part->width, "\"");
    put_number(drawing, " height=\"", 100 * part->height, "\">\n");
    if (part->size > 0) {
        put(drawing, part->text, part->size);
    }
    put_text(drawing, "</svg>\n");
}

/* ---- The file ---- */

burnish_status burnish_drawing_create(const burnish_context *context, int width, int height,
                                      burnish_drawing **drawing, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    if (!drawing || width < 1 || height < 1 || width > BURNISH_IMAGE_MAX_SIZE ||
        height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "drawing: a size of %d x %d; 1 to %d a side, and where to put it, are "
                            "expected",
                            width, height, BURNISH_IMAGE_MAX_SIZE);
    }
    *drawing = burnish_allocate_zeroed(&memory, 1, sizeof **drawing, "a drawing");
    if (*drawing) {
        (*drawing)->context = context;
        (*drawing)->width = width;
        (*drawing)->height = height;
    }
    return memory.status;
}

/* pixels / dots_per_inch, in ten thousandths of a millimetre. */
static int64_t ten_thousandths(int pixels, double dots_per_inch) {
    return (int64_t)(pixels * 254000.0 / dots_per_inch + 0.5);
}

static void put_size(burnish_drawing *w, const char *before, int pixels, double dots_per_inch) {
    put_text(w, before);
    if (dots_per_inch > 0) {
        put_decimal(w, ten_thousandths(pixels, dots_per_inch), 4, 0);
        put_text(w, "mm\"");
    } else {
        put_decimal(w, pixels, 0, 0);
        put_text(w, "\"");
    }
}

static void put_head(burnish_drawing *w, const char *title, const uint8_t background[3],
                     double dots_per_inch) {
    put_size(w, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", w->width, dots_per_inch);
    put_size(w, " height=\"", w->height, dots_per_inch);
    put_number(w, " viewBox=\"0 0 ", 100 * w->width, " ");
    put_number(w, "", 100 * w->height, "\">\n");
    if (title) {
        put_text(w, "<title>");
        put_escaped(w, title);
        put_text(w, "</title>\n");
    }
    if (background) {
        put_text(w, "<rect width=\"100%\" height=\"100%\" fill=\"");
        put_color(w, background);
        put_text(w, "\"/>\n");
    }
}

burnish_status burnish_drawing_encode_svg(const burnish_drawing *drawing, const char *title,
                                          const uint8_t background[3], double dots_per_inch,
                                          char **text, size_t *size, burnish_error *error) {
    if (!drawing || !text || !size ||
        !(dots_per_inch == 0 || (dots_per_inch >= 1 && dots_per_inch <= 1e6))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "SVG: a drawing, 0 or 1 to 1000000 dots per inch, and where to put the "
                            "text are expected");
    }
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    burnish_drawing file = {.context = drawing->context,
                            .width = drawing->width,
                            .height = drawing->height,
                            .memory = burnish_memory_of(drawing->context, error)};
    put_head(&file, title, background, dots_per_inch);
    if (drawing->size > 0) {
        put(&file, drawing->text, drawing->size);
    }
    put_text(&file, "</svg>\n");
    if (file.memory.status != BURNISH_STATUS_OK) {
        burnish_release(drawing->context, file.text);
        file.text = NULL;
        file.size = 0;
    }
    *text = file.text;
    *size = file.size;
    burnish_float_mode_leave(float_mode);
    return file.memory.status;
}

void burnish_drawing_destroy(burnish_drawing *drawing) {
    if (drawing) {
        burnish_release(drawing->context, drawing->text);
        burnish_release(drawing->context, drawing->points);
        burnish_release(drawing->context, drawing);
    }
}
