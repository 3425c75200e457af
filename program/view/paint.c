#include "view/paint.h"
#include "burnish/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/difference.h"
#include "view/actions.h"

enum {
    CAPITAL = 10, /* height of a capital letter, pixels */
    LINE = 21,
    PADDING = 12,
    RADIUS = 7
};
static const uint8_t dark_ink[3] = {34, 40, 49}, grey_ink[3] = {92, 101, 112};

/* ---- Panels ---- */

typedef struct panel {
    const burnish_pixels *window;
    int x, y;
    burnish_image image; /* RGB */
} panel;

static uint8_t *window_pixel(const panel *p, int x, int y) {
    return p->window->pixels + (size_t)(p->y + y) * p->window->stride + (size_t)(p->x + x) * 4;
}

/* Coverage of a pixel by a rectangle with round corners. */
static float cover(int x, int y, int width, int height, float radius) {
    const float cx = fminf((float)x + 0.5F, (float)(width - x) - 0.5F);
    const float cy = fminf((float)y + 0.5F, (float)(height - y) - 0.5F);
    if (cx >= radius || cy >= radius) {
        return 1;
    }
    return fminf(fmaxf(radius - hypotf(radius - cx, radius - cy) + 0.5F, 0), 1);
}

/* Paints a light card with a thin border, clipped to the window. Returns 0 if it has no room. */
static int begin_painting(panel *p, const burnish_pixels *window, int x, int y, int width,
                          int height) {
    *p = (panel){window, x, y, {0}};
    if (x < 0 || y < 0 || width > window->width - x || height > window->height - y ||
        burnish_image_create(NULL, &p->image, width, height, 3, NULL) != BURNISH_STATUS_OK) {
        return 0;
    }
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const float outer = cover(column, row, width, height, RADIUS);
            const int inside = column > 0 && row > 0 && column < width - 1 && row < height - 1;
            const float inner =
                inside ? cover(column - 1, row - 1, width - 2, height - 2, RADIUS - 1) : 0;
            const uint8_t *from = window_pixel(p, column, row);
            uint8_t *to = p->image.pixels + 3 * ((size_t)row * (size_t)width + (size_t)column);
            for (int k = 0; k < 3; ++k) {
                const float under = from[2 - k];
                const float edge = under + 0.45F * outer * (150 - under);
                const float card = under + 0.9F * (252 - under);
                to[k] = (uint8_t)(edge + inner * (card - edge) + 0.5F);
            }
        }
    }
    return 1;
}

static void end_painting(panel *p) {
    for (int row = 0; row < p->image.height; ++row) {
        const uint8_t *from = p->image.pixels + 3 * (size_t)row * (size_t)p->image.width;
        for (int column = 0; column < p->image.width; ++column, from += 3) {
            uint8_t *to = window_pixel(p, column, row);
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
        }
    }
    burnish_image_destroy(&p->image);
}

static int text_width(const char *text) {
    return (int)ceilf(burnish_image_draw_text(NULL, 0, 0, CAPITAL, dark_ink, text));
}

static void draw_text(panel *p, int x, int line, const uint8_t ink[3], const char *text) {
    burnish_image_draw_text(&p->image, (float)x, (float)(PADDING + line * LINE + CAPITAL), CAPITAL,
                            ink, text);
}

/* The lines of a text: copies number `index` and returns 1, or 0 past the last. */
static int line_at(const char *text, int index, char line[256]) {
    for (; index > 0; --index) {
        text = strchr(text, '\n');
        if (!text) {
            return 0;
        }
        ++text;
    }
    snprintf(line, 256, "%.*s", (int)strcspn(text, "\n"), text);
    return 1;
}

void view_paint_panel(const burnish_pixels *window, view_anchor anchor, int x, int y,
                      const char *text, int is_title) {
    char line[256];
    int width = 0, lines = 0;
    for (; line_at(text, lines, line); ++lines) {
        const int wide = text_width(line);
        width = wide > width ? wide : width;
    }
    width += 2 * PADDING;
    const int height = 2 * PADDING + CAPITAL + (lines - 1) * LINE;
    if (anchor == VIEW_TOP_RIGHT || anchor == VIEW_BOTTOM_RIGHT) {
        x -= width;
    } else if (anchor == VIEW_BOTTOM_MIDDLE) {
        x -= width / 2;
    }
    if (anchor >= VIEW_BOTTOM_LEFT) {
        y -= height;
    }
    panel p;
    if (begin_painting(&p, window, x, y, width, height)) {
        for (int i = 0; line_at(text, i, line); ++i) {
            draw_text(&p, PADDING, i, i > 0 && is_title ? grey_ink : dark_ink, line);
        }
        end_painting(&p);
    }
}

/* ---- Help ---- */

static const struct {
    const char *keys, *what;
} mouse[] = {{"drag", "walk around"},
             {"right drag", "move (also Shift + drag)"},
             {"wheel", "nearer, farther, at the pointer"},
             {"drop a file", "show it"}};
enum { MOUSE = sizeof mouse / sizeof *mouse };

/* Row `index` of the help: mouse actions, then keys. Returns 0 past the last. */
static int help_row(size_t index, const char **keys, const char **what) {
    if (index < MOUSE) {
        *keys = mouse[index].keys;
        *what = mouse[index].what;
        return 1;
    }
    size_t left = index - MOUSE;
    for (size_t i = 0; i < view_action_count; ++i) {
        if (view_actions[i].keys && left-- == 0) {
            *keys = view_actions[i].keys;
            *what = view_actions[i].what;
            return 1;
        }
    }
    return 0;
}

void view_paint_help(const burnish_pixels *window) {
    enum { GAP = 14, COLUMNS_GAP = 32 };
    const char *keys, *what;
    int rows = 0, key_width = 0, what_width = 0;
    for (; help_row((size_t)rows, &keys, &what); ++rows) {
        const int wide = text_width(keys), far = text_width(what);
        key_width = wide > key_width ? wide : key_width;
        what_width = far > what_width ? far : what_width;
    }
    const int column = key_width + GAP + what_width;
    int columns = 2, height = 2 * PADDING + CAPITAL + (rows + 1) / 2 * LINE;
    int width = 2 * PADDING + 2 * column + COLUMNS_GAP;
    if (width > window->width) { /* narrow windows show as much as fits */
        columns = 1;
        width = 2 * PADDING + column;
        height = 2 * PADDING + CAPITAL + (rows - 1) * LINE;
    }
    const int per_column = (rows + columns - 1) / columns;
    panel p;
    height = 2 * PADDING + CAPITAL + (per_column - 1) * LINE;
    if (!begin_painting(&p, window, (window->width - width) / 2, (window->height - height) / 2,
                        width, height)) {
        view_paint_panel(window, VIEW_BOTTOM_MIDDLE, window->width / 2, window->height - PADDING,
                         "The window is too small for the keys: enlarge it", 0);
        return;
    }
    for (int i = 0; help_row((size_t)i, &keys, &what); ++i) {
        const int x = PADDING + i / per_column * (column + COLUMNS_GAP), line = i % per_column;
        draw_text(&p, x + key_width - text_width(keys), line, dark_ink, keys);
        draw_text(&p, x + key_width + GAP, line, grey_ink, what);
    }
    end_painting(&p);
}

/* ---- The divider ---- */

static void mix(const burnish_pixels *window, int x, int y, int code, float share) {
    if (x >= 0 && y >= 0 && x < window->width && y < window->height) {
        uint8_t *to = window->pixels + (size_t)y * window->stride + (size_t)x * 4;
        for (int k = 0; k < 3; ++k) {
            to[k] = (uint8_t)((float)to[k] + share * (float)(code - to[k]) + 0.5F);
        }
    }
}

void view_paint_divider(const burnish_pixels *window, int x) {
    enum { HALF_WIDTH = 9, HALF_HEIGHT = 18, ARROW = 4 };
    for (int y = 0; y < window->height; ++y) {
        mix(window, x - 2, y, 60, 0.35F);
        mix(window, x - 1, y, 255, 1);
        mix(window, x, y, 255, 1);
        mix(window, x + 1, y, 60, 0.35F);
    }
    const int middle = window->height / 2;
    for (int row = 0; row < 2 * HALF_HEIGHT; ++row) {
        for (int column = 0; column < 2 * HALF_WIDTH; ++column) {
            const int at_x = x - HALF_WIDTH + column, at_y = middle - HALF_HEIGHT + row;
            const int inside =
                column > 0 && row > 0 && column < 2 * HALF_WIDTH - 1 && row < 2 * HALF_HEIGHT - 1;
            mix(window, at_x, at_y, 110,
                cover(column, row, 2 * HALF_WIDTH, 2 * HALF_HEIGHT, HALF_WIDTH));
            if (inside) {
                mix(window, at_x, at_y, 255,
                    cover(column - 1, row - 1, 2 * HALF_WIDTH - 2, 2 * HALF_HEIGHT - 2,
                          HALF_WIDTH - 1));
            }
        }
    }
    for (int i = 0; i < ARROW; ++i) { /* triangles that point outward */
        for (int y = -(ARROW - 1 - i); y <= ARROW - 1 - i; ++y) {
            mix(window, x - 3 - i, middle + y, 92, 1);
            mix(window, x + 2 + i, middle + y, 92, 1);
        }
    }
}

/* ---- Differences ---- */

void view_paint_scale(const burnish_pixels *window, int limit, const char *title) {
    enum { WIDTH = 360, BAR = 12, SIDES = 28, HEIGHT = 78 };
    panel p;
    const int room = window->width - 2 * PADDING;
    const int width = room < WIDTH + 2 * SIDES ? room : WIDTH + 2 * SIDES;
    if (width > 4 * SIDES && begin_painting(&p, window, (window->width - width) / 2,
                                            window->height - HEIGHT - PADDING, width, HEIGHT)) {
        picture_draw_centered(&p.image, (float)width / 2, PADDING + CAPITAL, CAPITAL, title);
        const int box[4] = {SIDES, PADDING + CAPITAL + 10, width - 2 * SIDES, BAR};
        picture_draw_scale(&p.image, box, CAPITAL - 1, -limit, limit);
        end_painting(&p);
    }
}

/* b - a of the channel with the largest difference. */
static int extreme(const uint8_t *a, const uint8_t *b) {
    int result = 0;
    for (int k = 0; k < 3; ++k) {
        const int difference = b[k] - a[k];
        result = abs(difference) > abs(result) ? difference : result;
    }
    return result;
}

static view_difference measure_difference(const burnish_pixels *a, const burnish_pixels *b) {
    view_difference found = {0};
    uint64_t squares = 0;
    for (int y = 0; y < a->height; ++y) {
        const uint8_t *pa = a->pixels + (size_t)y * a->stride;
        const uint8_t *pb = b->pixels + (size_t)y * b->stride;
        for (int x = 0; x < a->width; ++x, pa += 4, pb += 4) {
            if (memcmp(pa, pb, 4) == 0) {
                continue;
            }
            ++found.pixels;
            for (int k = 0; k < 3; ++k) {
                const int difference = abs(pb[k] - pa[k]);
                squares += (unsigned)(difference * difference);
                found.largest = difference > found.largest ? difference : found.largest;
            }
        }
    }
    found.rmse = sqrt((double)squares / (3.0 * a->width * a->height));
    return found;
}

view_difference view_paint_differences(const burnish_pixels *a, const burnish_pixels *b,
                                       const burnish_pixels *map, int *limit) {
    uint8_t colors[511][4];
    const view_difference found = measure_difference(a, b);
    *limit = 8;
    while (*limit < found.largest && *limit < 128) {
        *limit *= 2;
    }
    for (int i = -255; i <= 255; ++i) {
        uint8_t rgb[3];
        picture_difference_color(i, *limit, rgb);
        const uint8_t bgra[4] = {rgb[2], rgb[1], rgb[0], 255};
        memcpy(colors[i + 255], bgra, 4);
    }
    for (int y = 0; y < a->height; ++y) {
        const uint8_t *pa = a->pixels + (size_t)y * a->stride;
        const uint8_t *pb = b->pixels + (size_t)y * b->stride;
        uint8_t *to = map->pixels + (size_t)y * map->stride;
        for (int x = 0; x < a->width; ++x, pa += 4, pb += 4, to += 4) {
            const int difference = extreme(pa, pb);
            memcpy(to, colors[difference + 255], 4);
            if (difference == 0) { /* a fifth of the picture's contrast */
                const int luma = (pa[0] + 5 * pa[1] + 2 * pa[2]) / 8;
                for (int k = 0; k < 3; ++k) {
                    to[k] = (uint8_t)((4 * to[k] + luma) / 5);
                }
            }
        }
    }
    return found;
}
