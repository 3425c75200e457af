/* Drawings: a list of operations, which svg.c and pdf.c write. */
#include "image/text/drawing.h"

#include <string.h>

#include "base/error.h"
#include "core/float_mode.h"

/* ---- Text, without libc's formats, which would use the locale ---- */

void burnish_put(burnish_text_writer *w, const char *text, size_t size) {
    w->text =
        burnish_reserve(&w->memory, w->text, &w->capacity, w->size + size + 1, 1, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        memcpy(w->text + w->size, text, size);
        w->size += size;
        w->text[w->size] = 0;
    }
}

void burnish_put_text(burnish_text_writer *w, const char *text) {
    burnish_put(w, text, strlen(text));
}

void burnish_put_decimal(burnish_text_writer *w, int64_t value, int digits, int needs_blank) {
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
    burnish_put(w, text + at, sizeof text - (size_t)at);
}

void burnish_put_number(burnish_text_writer *w, const char *before, int32_t hundredths,
                        const char *after) {
    burnish_put_text(w, before);
    burnish_put_decimal(w, hundredths, 2, 0);
    burnish_put_text(w, after);
}

int32_t burnish_to_hundredths(float value) {
    const double scaled = (double)value * 100, most = 1e9;
    const double kept = scaled > -most ? scaled < most ? scaled : most : -most;
    return (int32_t)(kept < 0 ? kept - 0.5 : kept + 0.5);
}

/* ---- The list ---- */

static void push_op(burnish_drawing *w, burnish_drawing_op op) {
    op.first = op.end = w->line_count;
    w->ops = burnish_reserve(&w->memory, w->ops, &w->op_capacity, w->op_count + 1, sizeof *w->ops,
                             "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        w->ops[w->op_count++] = op;
    }
}

static void push_point(burnish_drawing *w, float x, float y) {
    w->points = burnish_reserve(&w->memory, w->points, &w->point_capacity, 2 * w->point_count + 2,
                                sizeof *w->points, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        w->points[2 * w->point_count] = x;
        w->points[2 * w->point_count++ + 1] = y;
    }
}

/* Ends the line whose points were pushed; it belongs to the last operation. */
static void end_line(burnish_drawing *w) {
    w->starts = burnish_reserve(&w->memory, w->starts, &w->start_capacity, w->line_count + 2,
                                sizeof *w->starts, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        w->starts[0] = 0;
        w->starts[++w->line_count] = w->point_count;
        w->ops[w->op_count - 1].end = w->line_count;
    }
}

static void push_line(burnish_drawing *w, const float *points, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        push_point(w, points[2 * i], points[2 * i + 1]);
    }
    end_line(w);
}

/* Where the points of the line that is pushed start. */
static size_t line_start(const burnish_drawing *w) {
    return w->line_count > 0 ? w->starts[w->line_count] : 0;
}

/* The number of a copy of the name; 0 for NULL. */
static size_t push_name(burnish_drawing *w, const char *name) {
    const size_t size = name ? strlen(name) + 1 : 0, at = w->name_size;
    if (size == 0) {
        return 0;
    }
    w->names = burnish_reserve(&w->memory, w->names, &w->name_capacity, at + size, 1, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        memcpy(w->names + at, name, size);
        w->name_size += size;
    }
    return at + 1;
}

const char *burnish_drawing_name(const burnish_drawing *drawing, const burnish_drawing_op *op) {
    return op->name > 0 ? drawing->names + op->name - 1 : NULL;
}

static burnish_drawing_op colored_op(burnish_drawing_kind kind, const uint8_t color[3],
                                     float width) {
    return (burnish_drawing_op){
        .kind = kind, .color = {color[0], color[1], color[2]}, .width = width};
}

/* ---- Lines ---- */

void burnish_drawing_use(burnish_drawing *drawing, burnish_error *error) {
    drawing->memory = burnish_memory_of(drawing->context, error);
}

void burnish_drawing_open(burnish_drawing *drawing, const uint8_t color[3], float opacity) {
    push_op(drawing, colored_op(BURNISH_DRAWING_OPEN, color, opacity));
}

void burnish_drawing_close(burnish_drawing *drawing) {
    push_op(drawing, (burnish_drawing_op){.kind = BURNISH_DRAWING_CLOSE});
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
        push_op(drawing, (burnish_drawing_op){.kind = BURNISH_DRAWING_LINES, .width = width});
        for (size_t i = first; i < count; ++i) {
            if (line_widths[i] == width && starts[i + 1] > starts[i] + 1) {
                push_line(drawing, points + 2 * (size_t)starts[i], starts[i + 1] - starts[i]);
            }
        }
    }
}

void burnish_drawing_strokes(burnish_drawing *drawing, const burnish_stroke *strokes, size_t count,
                             const char *name) {
    widths all = {.count = 0};
    for (size_t first = 0; first < count; ++first) {
        const float radius = strokes[first].radius;
        if (!is_new(&all, radius)) {
            continue;
        }
        push_op(drawing, (burnish_drawing_op){.kind = BURNISH_DRAWING_LINES,
                                              .width = 2 * radius,
                                              .name = all.count == 1 ? push_name(drawing, name)
                                                                     : 0}); /* once */
        for (size_t i = first; i < count; ++i) {
            const burnish_stroke *s = &strokes[i];
            const size_t n = drawing->point_count;
            if (s->radius != radius) {
                continue;
            }
            if (n == line_start(drawing) || drawing->points[2 * n - 2] != s->x0 ||
                drawing->points[2 * n - 1] != s->y0) {
                if (n > line_start(drawing)) {
                    end_line(drawing);
                }
                push_point(drawing, s->x0, s->y0);
            }
            push_point(drawing, s->x1, s->y1);
        }
        end_line(drawing);
    }
}

/* ---- Areas ---- */

void burnish_drawing_begin_area(burnish_drawing *drawing, const uint8_t color[3], int is_even_odd) {
    burnish_drawing_op op = colored_op(BURNISH_DRAWING_AREA, color, 0);
    op.is_even_odd = is_even_odd;
    push_op(drawing, op);
}

void burnish_drawing_add_border(burnish_drawing *drawing, const float *points, size_t count) {
    push_line(drawing, points, count);
}

void burnish_drawing_hatch(burnish_drawing *drawing, const uint8_t color[3], float width,
                           const float *lines, size_t count) {
    if (count == 0) {
        return;
    }
    push_op(drawing, colored_op(BURNISH_DRAWING_HATCH, color, width));
    for (size_t i = 0; i < count; ++i) {
        push_line(drawing, lines + 4 * i, 2);
    }
}

void burnish_drawing_outline(burnish_drawing *drawing, const burnish_outline *outline,
                             const uint8_t color[3], const char *name) {
    burnish_drawing_op op = colored_op(BURNISH_DRAWING_AREA, color, 0);
    op.name = push_name(drawing, name);
    push_op(drawing, op);
    for (size_t i = 0; i < outline->count; ++i) {
        const burnish_outline_edge *e = &outline->edges[i];
        const float x = (float)e->x0 / 256, y = (float)e->y0 / 256;
        const size_t n = drawing->point_count;
        /* outlines have no edges along a row: edges that continue in a row are one line */
        if (n > line_start(drawing) && drawing->points[2 * n - 1] != y) {
            end_line(drawing);
        }
        push_point(drawing, x, y);
        push_point(drawing, (float)e->x1 / 256, (float)e->y1 / 256);
    }
    if (drawing->point_count > line_start(drawing)) {
        end_line(drawing);
    }
}

void burnish_drawing_place(burnish_drawing *drawing, const burnish_drawing *part, int x, int y) {
    push_op(drawing, (burnish_drawing_op){.kind = BURNISH_DRAWING_PLACE,
                                          .area = {x, y, part->width, part->height}});
    for (size_t i = 0; i < part->op_count; ++i) {
        burnish_drawing_op op = part->ops[i];
        const size_t first = op.first, end = op.end;
        op.name = push_name(drawing, burnish_drawing_name(part, &op));
        push_op(drawing, op);
        for (size_t line = first; line < end; ++line) {
            push_line(drawing, part->points + 2 * part->starts[line],
                      part->starts[line + 1] - part->starts[line]);
        }
    }
    push_op(drawing, (burnish_drawing_op){.kind = BURNISH_DRAWING_LEAVE});
}

/* ---- Creation, encoding ---- */

burnish_status burnish_drawing_create(const burnish_context *context, int width, int height,
                                      burnish_drawing **drawing, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    if (!drawing || width < 1 || height < 1 || width > BURNISH_IMAGE_MAX_SIZE ||
        height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "drawing: a size of %d x %d; 1 to %d a side, and where to put it, are expected", width,
            height, BURNISH_IMAGE_MAX_SIZE);
    }
    *drawing = burnish_allocate_zeroed(&memory, 1, sizeof **drawing, "a drawing");
    if (*drawing) {
        (*drawing)->context = context;
        (*drawing)->width = width;
        (*drawing)->height = height;
    }
    return memory.status;
}

burnish_status burnish_drawing_check_encode(const char *format, const burnish_drawing *drawing,
                                            double dots_per_inch, int has_target,
                                            burnish_error *error) {
    if (!drawing || !has_target ||
        !(dots_per_inch == 0 || (dots_per_inch >= 1 && dots_per_inch <= 1e6))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: a drawing, 0 or 1 to 1000000 dots per inch, and where to put the "
                            "text are expected",
                            format);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_drawing_end_encode(burnish_text_writer *out, char **text, size_t *size) {
    if (out->memory.status != BURNISH_STATUS_OK) {
        burnish_release(out->memory.context, out->text);
        out->text = NULL;
        out->size = 0;
    }
    *text = out->text;
    *size = out->size;
    return out->memory.status;
}

void burnish_drawing_destroy(burnish_drawing *drawing) {
    if (drawing) {
        burnish_release(drawing->context, drawing->ops);
        burnish_release(drawing->context, drawing->starts);
        burnish_release(drawing->context, drawing->points);
        burnish_release(drawing->context, drawing->names);
        burnish_release(drawing->context, drawing);
    }
}
