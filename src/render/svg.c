/* Lines as SVG: text without libc's numbers, so that no locale changes it. */
#include <stdio.h>
#include <string.h>

#include "burnish/render.h"
#include "core/environment.h"
#include "core/memory.h"

/* A text that grows. */
typedef struct writer {
    burnish_memory memory;
    char *text;
    size_t size, capacity;
    int has_point; /* of the path at hand */
    int32_t x, y;  /* hundredths: the last point, from which the next one counts */
} writer;

static void put(writer *w, const char *text, size_t size) {
    w->text = burnish_reserve(&w->memory, w->text, &w->capacity, w->size + size + 1, 1, "the SVG");
    if (w->memory.status == BURNISH_STATUS_OK) {
        memcpy(w->text + w->size, text, size);
        w->size += size;
        w->text[w->size] = 0;
    }
}

static void put_text(writer *w, const char *text) {
    put(w, text, strlen(text));
}

/* Hundredths as a decimal, as short as it is exact: -1205 is "-12.05", 50 is ".5". A blank goes
 * before it where the number before could run into it. */
static void put_hundredths(writer *w, int32_t value, int needs_blank) {
    char text[16];
    const uint32_t size = value < 0 ? 0u - (uint32_t)value : (uint32_t)value;
    const unsigned whole = size / 100, part = size % 100;
    int length = 0;
    if (value < 0) {
        text[length++] = '-';
    } else if (needs_blank) {
        text[length++] = ' ';
    }
    if (whole > 0 || part == 0) {
        length += snprintf(text + length, 12, "%u", whole);
    }
    if (part > 0) {
        length +=
            snprintf(text + length, 4, part % 10 ? ".%02u" : ".%.1u", part % 10 ? part : part / 10);
    }
    put(w, text, (size_t)length);
}

/* To the nearest hundredth; points lie in a picture, or little outside. */
static int32_t to_hundredths(float value) {
    const double scaled = (double)value * 100;
    return (int32_t)(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

/* XML's special characters, and those that it has none for. */
static void put_escaped(writer *w, const char *text) {
    for (; *text; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '&') {
            put_text(w, "&amp;");
        } else if (c == '<') {
            put_text(w, "&lt;");
        } else if (c == '>') {
            put_text(w, "&gt;");
        } else {
            put(w, c < ' ' || c == 127 ? " " : text, 1);
        }
    }
}

static void put_color(writer *w, const uint8_t color[3]) {
    char text[8];
    snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
    put(w, text, 7);
}

static void put_number(writer *w, const char *before, int32_t hundredths, const char *after) {
    put_text(w, before);
    put_hundredths(w, hundredths, 0);
    put_text(w, after);
}

/* A line as a move to its first point and relative steps; points that rounding joins are left out.
 */
static void put_line(writer *w, const burnish_lines *lines, size_t line) {
    const size_t first = lines->starts[line], end = lines->starts[line + 1];
    const float *p = lines->points;
    int32_t x = to_hundredths(p[2 * first]), y = to_hundredths(p[2 * first + 1]);
    const int32_t start_x = x, start_y = y;
    put_text(w, w->has_point ? "m" : "M");
    put_hundredths(w, x - (w->has_point ? w->x : 0), 0);
    put_hundredths(w, y - (w->has_point ? w->y : 0), 1);
    int steps = 0;
    for (size_t i = first + 1; i < end; ++i) {
        const int32_t next_x = to_hundredths(p[2 * i]), next_y = to_hundredths(p[2 * i + 1]);
        const int closes = i + 1 == end && steps > 1 && next_x == start_x && next_y == start_y;
        if (closes) {
            put_text(w, "z");
        } else if (next_x != x || next_y != y || (i + 1 == end && steps == 0)) {
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

/* All lines of one width as a path; their first one is `first`. */
static void put_path(writer *w, const burnish_lines *lines, size_t first) {
    const float width = lines->widths[first];
    put_number(w, "<path stroke-width=\"", to_hundredths(width), "\" d=\"");
    w->has_point = 0;
    for (size_t i = first; i < lines->line_count; ++i) {
        if (lines->widths[i] == width && lines->starts[i + 1] > lines->starts[i] + 1) {
            put_line(w, lines, i);
        }
    }
    put_text(w, "\"/>\n");
}

static void put_head(writer *w, const burnish_lines *lines, const char *title,
                     const uint8_t background[3]) {
    put_number(w, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", 100 * lines->width, "\"");
    put_number(w, " height=\"", 100 * lines->height, "\"");
    put_number(w, " viewBox=\"0 0 ", 100 * lines->width, " ");
    put_number(w, "", 100 * lines->height, "\">\n");
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
    put_text(w, "<g fill=\"none\" stroke=\"");
    put_color(w, lines->color);
    put_text(w, "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    if (lines->opacity < 1) {
        put_number(w, " opacity=\"", to_hundredths(lines->opacity), "\"");
    }
    put_text(w, ">\n");
}

/* 1: no line before has this one's width. */
static int is_first_of_width(const burnish_lines *lines, size_t line, const float *known,
                             size_t count) {
    for (size_t i = 0; i < count; ++i) {
        if (known[i] == lines->widths[line]) {
            return 0;
        }
    }
    return 1;
}

burnish_status burnish_lines_svg(const burnish_lines *lines, const char *title,
                                 const uint8_t background[3], const burnish_context *context,
                                 char **text, size_t *size, burnish_error *error) {
    enum { WIDTHS_MAX = 16 }; /* frames have two */
    float known[WIDTHS_MAX];
    size_t count = 0;
    if (!text || !size || !lines || lines->width < 1 || lines->height < 1 ||
        lines->width > BURNISH_IMAGE_MAX_SIZE || lines->height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "SVG: the lines of a frame that was drawn with edges, and where to put "
                            "the text, are expected");
    }
    const burnish_environment environment = burnish_environment_enter();
    writer w = {.memory = burnish_memory_of(context, error)};
    put_head(&w, lines, title, background);
    for (size_t i = 0; i < lines->line_count && count < WIDTHS_MAX; ++i) {
        if (is_first_of_width(lines, i, known, count)) {
            known[count++] = lines->widths[i];
            put_path(&w, lines, i);
        }
    }
    put_text(&w, "</g>\n</svg>\n");
    if (w.memory.status != BURNISH_STATUS_OK) {
        burnish_release(context, w.text);
        w = (writer){.memory = w.memory};
    }
    *text = w.text;
    *size = w.size;
    burnish_environment_leave(environment);
    return w.memory.status;
}
