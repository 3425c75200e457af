/* Sheets of three aligned views and a pictorial view, with a frame, a title and the symbol of the
 * projection method: the views of a truncated cone (ISO 5456-2). */
#include "burnish/sheet.h"

#include <stdio.h>
#include <string.h>

#include "base/arithmetic.h"
#include "base/error.h"
#include "core/float_mode.h"
#include "image/text/drawing.h"
#include "image/text/text.h"

/* In heights of a capital. */
#define BORDER 1.4      /* from the edge of the page to its frame */
#define STRIP 3.2       /* height of the title's strip */
#define ROOM 5.2        /* around a view, for dimensions */
#define SYMBOL 0.75     /* radius of the symbol's larger circle */
#define TEXT_SHARE 60.0 /* a capital is the shorter side of the page by this, ... */
#define TEXT_LEAST 9    /* ... at least so many pixels */

/* Millimetres: heights of capitals (ISO 3098), margins (ISO 5457), the title block (ISO 7200). */
#define TEXT_SMALLEST 2.5
#define TEXT_LARGEST 3.5
#define MARGIN_LEFT 20
#define MARGIN 10
#define BLOCK 180

/* The pictorial view has at least this share of both sides. */
#define PICTORIAL_SHARE 0.3

enum { LEAST_SIDE = 240, CIRCLE = 48 };

/* ---- Layout ---- */

/* Pixels per unit at which `wide` and `deep` fit next to each other, with room around both; the
 * second has at least `share` of the side. */
static double fit_views(double side, double room, double wide, double deep, double share) {
    const double both = (side - 4 * room) / (wide + deep);
    const double one = wide > 0 ? ((1 - share) * side - 2 * room) / wide : both;
    return one < both ? one : both;
}

/* The first is deep or wide, with room; the rest is shared. */
static int divide_side(double side, double room, double wide, double deep, double share) {
    const double least = share * side, second = deep + 2 * room;
    const double rest = side - (wide + 2 * room) - (second > least ? second : least);
    return (int)(wide + 2 * room + rest / 2);
}

/* The largest of 1, 2 or 5 times a power of 10, or 1 divided by one, that is at most `limit`, with
 * its ratio as text (ISO 5455); `limit` without a text if it is not between 10^-6 and 10^6. */
static double standard_scale(double limit, char *text, size_t size) {
    static const int digits[3] = {5, 2, 1};
    *text = 0;
    for (int power = 100000; power >= 1 && limit < 1e6; power /= 10) {
        for (int i = 0; i < 3; ++i) {
            if (digits[i] * power <= limit) {
                snprintf(text, size, "%d:1", digits[i] * power);
                return digits[i] * power;
            }
        }
    }
    for (int power = 1; power <= 100000 && limit < 1; power *= 10) {
        for (int i = 2; i >= 0; --i) {
            if (1.0 / (digits[i] * power) <= limit) {
                snprintf(text, size, "1:%d", digits[i] * power);
                return 1.0 / (digits[i] * power);
            }
        }
    }
    return limit;
}

static burnish_status check_projection(const burnish_projection *projection, burnish_error *error) {
    double sum = 0;
    if (projection->width < LEAST_SIDE || projection->height < LEAST_SIDE ||
        projection->width > BURNISH_IMAGE_MAX_SIZE || projection->height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "sheet: %d x %d pixels; aligned views need %d to %d a side",
                            projection->width, projection->height, LEAST_SIDE,
                            BURNISH_IMAGE_MAX_SIZE);
    }
    for (int k = 0; k < 3; ++k) {
        sum += projection->extents[k];
        if (!(projection->extents[k] >= 0 && projection->extents[k] < 1e300)) {
            sum = -1;
            break;
        }
    }
    return sum > 0 ? BURNISH_STATUS_OK
                   : burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                  "sheet: an object without extent; aligned views need a size");
}

/* From the left edge of the page to its frame, or from another one, in whole pixels. */
static int border_of(const burnish_projection *projection, int is_left) {
    return (int)(projection->paper
                     ? (is_left ? MARGIN_LEFT : MARGIN) * projection->pixels_per_millimetre
                     : BORDER * projection->text_height);
}

static double text_height_of(const burnish_projection *projection) {
    const double shorter =
        projection->width < projection->height ? projection->width : projection->height;
    const double pixels = projection->pixels_per_millimetre;
    double text = shorter / TEXT_SHARE;
    if (pixels > 0) {
        text = text < TEXT_LARGEST * pixels ? text : TEXT_LARGEST * pixels;
        text = text > TEXT_SMALLEST * pixels ? text : TEXT_SMALLEST * pixels + 0.5;
    }
    return text > TEXT_LEAST ? (double)(int)(text + 0.5) : TEXT_LEAST;
}

/* The shares of the page: its frame without the strip, and the third column. */
typedef struct page {
    int left, top, wide, high;
    double room;  /* around a view */
    double third; /* units that the third column is wide: of the section, or of the pictorial view
                     if the section is next to the top view; -1: there is none */
} page;

static void choose_scale(burnish_projection *projection, const page *on) {
    const double *size = projection->extents, room = on->room;
    const double y = fit_views(on->high, room, size[1], size[2], PICTORIAL_SHARE);
    const double x = on->third >= 0
                         ? fit_views(on->wide - 2 * room, room, size[0] + on->third, size[2], 0)
                         : fit_views(on->wide, room, size[0], size[2], PICTORIAL_SHARE);
    projection->pixels_per_unit = x < y ? x : y;
    projection->scale[0] = 0;
    if (projection->pixels_per_millimetre > 0) {
        projection->pixels_per_unit =
            projection->pixels_per_millimetre *
            standard_scale(projection->pixels_per_unit / projection->pixels_per_millimetre,
                           projection->scale, sizeof projection->scale);
    }
}

/* Front and side view share a row, whose third column is the section's; pictorial and top view share
 * the other. A section across the height is in the pictorial view's place, which takes its. */
static void place_cells(burnish_projection *projection, const page *on) {
    const double *size = projection->extents, s = projection->pixels_per_unit, room = on->room;
    const double needed = s * (size[0] + size[2] + on->third) + 6 * room;
    const double spare = needed < on->wide ? (on->wide - needed) / 3 : 0;
    const int third = on->third >= 0 ? (int)(s * on->third + 2 * room + spare) : 0;
    const double share = third > 0 ? 0 : PICTORIAL_SHARE;
    const int column = divide_side(on->wide - third, room, s * size[0], s * size[2], share);
    const int row = divide_side(on->high, room, s * size[1], s * size[2], PICTORIAL_SHARE);
    const int is_first = projection->method == BURNISH_PROJECTION_FIRST_ANGLE;
    const int other = on->high - row, left = on->left, x = left + column;
    const int front = is_first ? on->top : on->top + other;
    const int behind = is_first ? on->top + row : on->top;
    const int right = on->wide - third - column;
    const int is_top = projection->section == 2;
    burnish_projection_area *cells = projection->cells;
    cells[BURNISH_PROJECTION_FRONT] = (burnish_projection_area){left, front, column, row};
    cells[BURNISH_PROJECTION_SIDE] = (burnish_projection_area){x, front, right, row};
    cells[BURNISH_PROJECTION_TOP] = (burnish_projection_area){left, behind, column, other};
    cells[is_top ? BURNISH_PROJECTION_SECTION : BURNISH_PROJECTION_PICTORIAL] =
        (burnish_projection_area){x, behind, right + third, other};
    cells[is_top ? BURNISH_PROJECTION_PICTORIAL : BURNISH_PROJECTION_SECTION] =
        (burnish_projection_area){x + right, front, third, row};
}

static void lay_out(burnish_projection *projection) {
    const int section = projection->section;
    projection->text_height = text_height_of(projection);
    const int left = border_of(projection, 1), other = border_of(projection, 0);
    const int wide = projection->width - left - other;
    const int high = (int)(projection->height - 2 * other - 0.5 - STRIP * projection->text_height);
    const double room = ROOM * projection->text_height, most = (wide < high ? wide : high) / 12.0;
    const page on = {left,
                     other,
                     wide,
                     high,
                     room < most ? room : most,
                     section > 0 ? projection->extents[section == 1 ? 2 : 0] : -1};
    choose_scale(projection, &on);
    place_cells(projection, &on);
}

burnish_status burnish_projection_lay_out(burnish_projection *projection, burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_status status = check_projection(projection, error);
    if (status == BURNISH_STATUS_OK) {
        lay_out(projection);
    }
    burnish_float_mode_leave(before);
    return status;
}

/* ---- Frame, title, symbol ---- */

static void push_line(burnish_stroke_list *to, const double from[2], const double end[2],
                      double width) {
    const burnish_stroke stroke = {(float)from[0], (float)from[1], (float)end[0], (float)end[1],
                                   (float)(width / 2)};
    burnish_stroke_list_append(to, &stroke, 1);
}

/* A polygon of x, y; closed. */
static void push_polygon(burnish_stroke_list *to, const double (*points)[2], int count,
                         double width) {
    for (int i = 0; i < count; ++i) {
        push_line(to, points[i], points[(i + 1) % count], width);
    }
}

/* By turning a vector: no libm. cos and sin of 2 pi / 48. */
static void push_circle(burnish_stroke_list *to, double x, double y, double radius, double width) {
    static const double cosine = 0.99144486137381041114, sine = 0.13052619222005159155;
    double points[CIRCLE][2], v[2] = {radius, 0};
    for (int i = 0; i < CIRCLE; ++i) {
        points[i][0] = x + v[0];
        points[i][1] = y + v[1];
        const double turned = cosine * v[0] - sine * v[1];
        v[1] = sine * v[0] + cosine * v[1];
        v[0] = turned;
    }
    push_polygon(to, (const double(*)[2])points, CIRCLE, width);
}

/* The views of a truncated cone whose small end is on the left: from the front, and from the left.
 * The latter is on the right in first angle, on the left in third angle. */
static void push_symbol(burnish_stroke_list *to, const burnish_projection *projection, double right,
                        double middle, double width) {
    const double r = SYMBOL * projection->text_height, cone = 3 * r, gap = r;
    const int is_first = projection->method == BURNISH_PROJECTION_FIRST_ANGLE;
    const double left = right - (cone + gap + 2 * r);
    const double at = is_first ? left : left + 2 * r + gap, x = is_first ? right - r : left + r;
    const double points[4][2] = {{at, middle - r / 2},
                                 {at + cone, middle - r},
                                 {at + cone, middle + r},
                                 {at, middle + r / 2}};
    push_polygon(to, points, 4, width);
    push_circle(to, x, middle, r, width);
    push_circle(to, x, middle, r / 2, width);
    const double over = 0.5 * r;
    push_line(to, (double[2]){left - over, middle}, (double[2]){right + over, middle}, width / 2);
    push_line(to, (double[2]){x, middle - r - over}, (double[2]){x, middle + r + over}, width / 2);
}

/* The frame and the fields of the title block (ISO 7200), each a path that is named by its text. */
enum { FRAME, TITLE, PAPER, UNIT, SCALE, PARTS };

typedef struct parts {
    burnish_stroke_list strokes[PARTS];
    const char *texts[PARTS]; /* NULL: none */
    char *title;
} parts;

static double width_of(const burnish_projection *projection, const char *text) {
    static const uint8_t unused[3] = {0};
    return (double)burnish_text_draw(NULL, 0, 0, (float)projection->text_height, unused, text,
                                     strlen(text));
}

static void push_text(const burnish_projection *projection, double left, double middle, int part,
                      parts *made) {
    const char *text = made->texts[part];
    burnish_text_strokes((float)left, (float)(int)(middle + projection->text_height / 2),
                         (float)projection->text_height, text, strlen(text),
                         burnish_stroke_list_append, &made->strokes[part]);
}

/* From the right: the symbol, then fields that have a text, between lines. On paper, the block is as
 * wide as ISO 7200 has it, if the page is wider. */
static void push_block(const burnish_projection *projection, const double frame[4], double width,
                       const char *title, parts *made) {
    const double text = projection->text_height, top = (double)(int)(frame[3] - STRIP * text) + 0.5;
    const double middle = (top + frame[3]) / 2, symbol = frame[2] - 2 * text;
    const double block = frame[2] - BLOCK * projection->pixels_per_millimetre;
    const double left = projection->paper && block > frame[0] ? (double)(int)block + 0.5 : frame[0];
    burnish_stroke_list *lines = &made->strokes[FRAME];
    double x = (double)(int)(symbol - 6 * SYMBOL * text - text) + 0.5;
    push_symbol(lines, projection, symbol, middle, text > 16 ? text / 8 : 1.5);
    push_line(lines, (double[2]){left, top}, (double[2]){frame[2], top}, width);
    push_line(lines, (double[2]){left, top}, (double[2]){left, frame[3]}, width);
    for (int i = SCALE; i > TITLE; --i) {
        if (made->texts[i]) {
            push_line(lines, (double[2]){x, top}, (double[2]){x, frame[3]}, width);
            x = (double)(int)(x - width_of(projection, made->texts[i]) - 2 * text) + 0.5;
            push_text(projection, x + text, middle, i, made);
        }
    }
    push_line(lines, (double[2]){x, top}, (double[2]){x, frame[3]}, width);
    made->title = title ? burnish_text_fit(NULL, title, (int)text, (float)(x - left - 2 * text),
                                           lines->memory)
                        : NULL;
    if (made->title) {
        made->texts[TITLE] = made->title;
        push_text(projection, left + text, middle, TITLE, made);
    }
}

static void make_parts(const burnish_projection *projection, const char *title,
                       burnish_memory *memory, parts *made) {
    const double text = projection->text_height;
    const double left = border_of(projection, 1) + 0.5, top = border_of(projection, 0) + 0.5;
    const double right = projection->width - top, bottom = projection->height - top;
    const double corners[4][2] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
    const double width = text > 16 ? (double)(int)(text / 8) : 1;
    *made = (parts){.texts = {[PAPER] = projection->paper,
                              [UNIT] = projection->pixels_per_millimetre > 0 ? "mm" : NULL,
                              [SCALE] = *projection->scale ? projection->scale : NULL}};
    for (int i = 0; i < PARTS; ++i) {
        made->strokes[i].memory = memory;
    }
    push_polygon(&made->strokes[FRAME], corners, 4, width);
    push_block(projection, (double[4]){left, top, right, bottom}, width, title, made);
}

static void release_parts(parts *made) {
    burnish_release(made->strokes[TITLE].memory->context, made->title);
    for (int i = 0; i < PARTS; ++i) {
        burnish_release(made->strokes[i].memory->context, made->strokes[i].items);
    }
}

/* ---- Of images ---- */

burnish_status burnish_projection_image(const burnish_projection *projection, const char *title,
                                        const burnish_image *const views[BURNISH_PROJECTION_VIEWS],
                                        const uint8_t background[3], const uint8_t ink[3],
                                        burnish_image *image, burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    burnish_memory memory = burnish_memory_of(views[0]->context, error);
    *image = (burnish_image){0};
    burnish_status status = burnish_image_create(views[0]->context, image, projection->width,
                                                 projection->height, views[0]->channels, error);
    if (status == BURNISH_STATUS_OK) {
        parts made;
        const burnish_pixels pixels = burnish_image_get_pixels(image);
        const burnish_ink color = burnish_ink_of(ink, 1);
        burnish_image_fill(image, background);
        for (int i = 0; i < BURNISH_PROJECTION_SECTION + (projection->section > 0); ++i) {
            burnish_image_copy(image, projection->cells[i].x, projection->cells[i].y, views[i]);
        }
        make_parts(projection, title, &memory, &made);
        for (int i = 0; i < PARTS && memory.status == BURNISH_STATUS_OK; ++i) {
            burnish_strokes_draw(&pixels, made.strokes[i].items, made.strokes[i].count, &color,
                                 NULL, &memory);
        }
        release_parts(&made);
        status = memory.status;
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(image);
    }
    burnish_float_mode_leave(before);
    return status;
}

/* ---- Of drawings ---- */

burnish_status burnish_projection_drawing(const burnish_projection *projection, const char *title,
                                          burnish_drawing *const views[BURNISH_PROJECTION_VIEWS],
                                          const uint8_t ink[3], burnish_drawing **drawing,
                                          burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    *drawing = NULL;
    burnish_status status = burnish_drawing_create(views[0]->context, projection->width,
                                                   projection->height, drawing, error);
    if (status == BURNISH_STATUS_OK) {
        burnish_drawing *to = *drawing;
        parts made;
        burnish_drawing_use(to, error);
        for (int i = 0; i < BURNISH_PROJECTION_SECTION + (projection->section > 0); ++i) {
            burnish_drawing_place(to, views[i], projection->cells[i].x, projection->cells[i].y);
        }
        make_parts(projection, title, &to->memory, &made);
        burnish_drawing_open(to, ink, 1);
        for (int i = 0; i < PARTS; ++i) {
            burnish_drawing_strokes(to, made.strokes[i].items, made.strokes[i].count,
                                    made.texts[i]);
        }
        burnish_drawing_close(to);
        release_parts(&made);
        status = to->memory.status;
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_drawing_destroy(*drawing);
        *drawing = NULL;
    }
    burnish_float_mode_leave(before);
    return status;
}
