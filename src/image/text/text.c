/* Text: layout, and glyphs as strokes of a round pen. */
#include "image/text/text.h"
#include "burnish/sheet.h"

#include <string.h>

#include "core/float_mode.h"
#include "image/text/stroke_font.h"

enum { SPAN = 256 }; /* pixels of a row that are covered at a time */

static const float least_height = 5;
static const float most_height = BURNISH_IMAGE_MAX_SIZE;
static const float pen_share = 0.12F;  /* of the height of a capital */
static const float widening = 0.35F;   /* pixels, at most, that a pen is widened to whole ones */
static const float far_away = 4194304; /* 2^22: beyond it a float has no quarter pixels */

/* The target of drawn glyphs. */
typedef struct page {
    burnish_pixels pixels;
    burnish_ink ink;
} page;

static void draw_span(const page *to, const burnish_stroke *strokes,
                      const burnish_rectangle *touched, size_t count, int row, int first,
                      int last) {
    float coverage[SPAN] = {0};
    for (size_t i = 0; i < count; ++i) {
        if (row < touched[i].top || row >= touched[i].bottom) {
            continue;
        }
        int left = touched[i].left > first ? touched[i].left : first;
        int right = touched[i].right < last ? touched[i].right : last;
        if (left < right) {
            burnish_stroke_cover(&strokes[i], row, left, right - left, coverage + (left - first));
        }
    }
    burnish_ink_blend(&to->pixels, row, first, last - first, coverage, &to->ink);
}

static void draw_strokes(void *context, const burnish_stroke *strokes, size_t count) {
    const page *to = context;
    const burnish_pixels *pixels = &to->pixels;
    burnish_rectangle touched[BURNISH_GLYPH_MAX_STROKES];
    burnish_rectangle all = {pixels->width, pixels->height, 0, 0};
    for (size_t i = 0; i < count; ++i) {
        touched[i] = burnish_stroke_bounds(&strokes[i], pixels->width, pixels->height);
        all.left = touched[i].left < all.left ? touched[i].left : all.left;
        all.top = touched[i].top < all.top ? touched[i].top : all.top;
        all.right = touched[i].right > all.right ? touched[i].right : all.right;
        all.bottom = touched[i].bottom > all.bottom ? touched[i].bottom : all.bottom;
    }
    for (int row = all.top; row < all.bottom; ++row) {
        for (int first = all.left; first < all.right; first += SPAN) {
            int last = all.right - first > SPAN ? first + SPAN : all.right;
            draw_span(to, strokes, touched, count, row, first, last);
        }
    }
}

static int near_image(float coordinate) {
    return coordinate > -far_away && coordinate < far_away;
}

/* The nearest whole pixel; beyond far_away the value itself, which is never drawn. */
static float snap_to_pixel(float value) {
    if (!near_image(value)) {
        return value;
    }
    return value < 0 ? -(float)(int)(0.5F - value) : (float)(int)(value + 0.5F);
}

/* The pen for capitals of the given height, its seat (the whole pixels that its width takes in the
 * layout) and the unit. A pen a little narrower than its seat is widened to fill it: two grey rows
 * look thinner than a black row next to a faint one. */
static burnish_glyph_scale make_scale(float height, float *seat) {
    height = height > least_height ? height : least_height; /* also for NaN */
    height = height < most_height ? height : most_height;
    float pen = height * pen_share;
    *seat = pen > 1 ? (float)(int)(pen + widening) : 1;
    pen = pen > *seat ? pen : *seat;
    return (burnish_glyph_scale){.unit = (height - *seat) / BURNISH_GLYPH_CAP,
                                 .radius = pen * 0.5F};
}

/* White between two glyphs (NULL: the line's end): never nothing, or small letters would touch. */
static float gap_pixels(const burnish_glyph_scale *scale, const burnish_glyph *before,
                        const burnish_glyph *after) {
    int units = (before ? before->right : 0) + (after ? after->left : 0);
    float pixels = burnish_glyph_pixels(scale, units);
    return pixels > 0 || units == 0 ? pixels : 1;
}

/* U+00C0 to U+017F without accents. */
static const char latin[] =
    "AAAAAAACEEEEIIIIDNOOOOOx\x7FUUUUYTsaaaaaaaceeeeiiiidnooooo/ouuuuyty"
    "AaAaAaCcCcCcCcDdDdEeEeEeEeEeGgGgGgGgHhHhIiIiIiIiIiIiJjKkkLlLlLlLlLlNnNnNnnNnOoOoOoOoRrRrRrSsSs"
    "SsSsTtTtTtUuUuUuUuUuUuWwYyYZzZzZzs";

/* The first character of a text, and its number of bytes. Returns an ASCII character or a diameter;
 * 0: it has no glyph; -1: it is an accent by itself, which is not drawn. */
static int read_character(const char *text, size_t length, size_t *size) {
    const unsigned char *bytes = (const unsigned char *)text;
    const size_t whole = bytes[0] >> 5 == 6 ? 2 : 3;
    unsigned code = bytes[0] & (whole == 2 ? 0x1FU : 0xFU);
    *size = 1;
    if (bytes[0] < 0x80) {
        return bytes[0] >= 32 && bytes[0] < 127 ? bytes[0] : 0;
    }
    for (; *size < length && (bytes[*size] & 0xC0) == 0x80; ++*size) {
        code = code << 6 | (bytes[*size] & 0x3F);
    }
    return *size != whole || bytes[0] < 0xC0  ? 0
           : code >= 0xC0 && code <= 0x17F    ? latin[code - 0xC0]
           : code >= 0x300 && code <= 0x36F   ? -1
           : code >= 0x2010 && code <= 0x2015 ? '-'
                                              : 0;
}

int burnish_text_is_legible(const char *text) {
    size_t size = 0;
    while (*text && read_character(text, strlen(text), &size) != 0) {
        text += size;
    }
    return *text == 0;
}

/* Positions and advances are whole pixels: every stem of a line is then equally sharp, and the
 * spacing of letters does not depend on their position. If take is NULL, the line is only
 * measured. */
static float set_line(float x, float y, float height, const char *text, size_t length,
                      burnish_take_strokes *take, void *context) {
    float seat;
    burnish_glyph_scale scale = make_scale(height, &seat);
    x = snap_to_pixel(x);
    scale.y = snap_to_pixel(y) - seat * 0.5F;
    const burnish_glyph *before = NULL;
    float advance = 0;
    size_t size;
    for (size_t i = 0; i < length; i += size) {
        const int character = read_character(text + i, length - i, &size);
        if (character < 0) {
            continue;
        }
        const burnish_glyph *glyph =
            burnish_glyph_find((unsigned char)(character ? character : '?'));
        advance += gap_pixels(&scale, before, glyph);
        scale.x = x + advance + seat * 0.5F;
        if (take && near_image(scale.x) && near_image(scale.y)) {
            burnish_stroke strokes[BURNISH_GLYPH_MAX_STROKES];
            take(context, strokes, burnish_glyph_strokes(glyph, &scale, strokes));
        }
        advance += burnish_glyph_pixels(&scale, glyph->width) + seat;
        before = glyph;
    }
    return advance + gap_pixels(&scale, before, NULL);
}

void burnish_text_strokes(float x, float y, float height, const char *text, size_t length,
                          burnish_take_strokes *take, void *context) {
    set_line(x, y, height, text, length, take, context);
}

float burnish_text_draw(burnish_image *image, float x, float y, float height,
                        const uint8_t color[3], const char *text, size_t length) {
    if (!image || !image->pixels) {
        return set_line(x, y, height, text, length, NULL, NULL);
    }
    page to = {burnish_image_get_pixels(image), burnish_ink_of(color, 1)};
    return set_line(x, y, height, text, length, draw_strokes, &to);
}

float burnish_image_draw_text(burnish_image *image, float x, float y, float height,
                              const uint8_t color[3], const char *text) {
    if (!text) {
        return 0;
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    const float advance = burnish_text_draw(image, x, y, height, color, text, strlen(text));
    burnish_float_mode_leave(before);
    return advance;
}

void burnish_stroke_list_append(void *context, const burnish_stroke *strokes, size_t count) {
    burnish_stroke_list *to = context;
    to->items = burnish_reserve(to->memory, to->items, &to->capacity, to->count + count,
                                sizeof *to->items, "strokes of a drawing");
    if (to->memory->status == BURNISH_STATUS_OK && count > 0) {
        memcpy(to->items + to->count, strokes, count * sizeof *strokes);
        to->count += count;
    }
}
