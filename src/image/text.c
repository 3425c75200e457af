/* Text: layout, and exact distances from pixel centres to the strokes of a round pen. */
#include "image/text.h"

#include <string.h>

#include "core/elementary.h"
#include "core/environment.h"
#include "core/srgb.h"
#include "image/stroke_font.h"

enum { SPAN = 256 }; /* pixels of a row that are covered at a time */

static const float least_height = 5;
static const float most_height = BURNISH_IMAGE_MAX_SIZE;
static const float pen_share = 0.12F;  /* of the height of a capital */
static const float widening = 0.35F;   /* pixels, at most, that a pen is widened to whole ones */
static const float far_away = 4194304; /* 2^22: beyond it a float has no quarter pixels */

typedef struct rectangle {
    int left, top, right, bottom; /* right and bottom exclusive */
} rectangle;

/* floor(value) clamped to [0, most]; NaN gives 0. */
static int clamp_to_pixels(float value, int most) {
    if (!(value > 0)) {
        return 0;
    }
    return value < (float)most ? (int)value : most;
}

/* The pixels that strokes can touch, within the image. */
static rectangle touched_pixels(const burnish_image *image, const burnish_stroke *stroke) {
    float reach = stroke->radius + 0.5F;
    float left = stroke->x0 < stroke->x1 ? stroke->x0 : stroke->x1;
    float right = stroke->x0 < stroke->x1 ? stroke->x1 : stroke->x0;
    float top = stroke->y0 < stroke->y1 ? stroke->y0 : stroke->y1;
    float bottom = stroke->y0 < stroke->y1 ? stroke->y1 : stroke->y0;
    return (rectangle){clamp_to_pixels(left - reach, image->width),
                       clamp_to_pixels(top - reach, image->height),
                       clamp_to_pixels(right + reach + 1, image->width),
                       clamp_to_pixels(bottom + reach + 1, image->height)};
}

/* Raises coverage[i] of pixels first + i of a row to the stroke's:
 * clamp(1/2 + radius - distance from the pixel's centre to the segment, 0, 1). */
static void cover_row(const burnish_stroke *stroke, int row, int first, int count,
                      float *coverage) {
    float ex = stroke->x1 - stroke->x0;
    float ey = stroke->y1 - stroke->y0;
    float length2 = ex * ex + ey * ey;
    float inverse = length2 > 0 ? 1 / length2 : 0;
    float py = (float)row + 0.5F - stroke->y0;
    for (int i = 0; i < count; ++i) {
        float px = (float)(first + i) + 0.5F - stroke->x0;
        float t = (px * ex + py * ey) * inverse;
        t = t > 0 ? (t < 1 ? t : 1) : 0;
        float dx = px - t * ex;
        float dy = py - t * ey;
        float share = 0.5F + stroke->radius - burnish_sqrtf(dx * dx + dy * dy);
        share = share < 1 ? share : 1;
        coverage[i] = share > coverage[i] ? share : coverage[i];
    }
}

/* Mixes the linear colour over a pixel. */
static void blend_pixel(uint8_t *pixel, int channels, const float linear[3], float share) {
    if (channels == 4) {
        float alpha = (float)pixel[3] / 255.0F;
        float sum = share + alpha * (1 - share);
        share = share / sum;
        pixel[3] = (uint8_t)(sum * 255.0F + 0.5F);
    }
    float below = 1 - share;
    for (int k = 0; k < 3; ++k) {
        float behind = burnish_srgb_to_linear[pixel[k]];
        pixel[k] = burnish_linear_to_srgb(linear[k] * share + behind * below);
    }
}

static void draw_span(burnish_image *image, const burnish_stroke *strokes, const rectangle *touched,
                      size_t count, int row, int first, int last, const float linear[3]) {
    float coverage[SPAN] = {0};
    for (size_t i = 0; i < count; ++i) {
        if (row < touched[i].top || row >= touched[i].bottom) {
            continue;
        }
        int left = touched[i].left > first ? touched[i].left : first;
        int right = touched[i].right < last ? touched[i].right : last;
        if (left < right) {
            cover_row(&strokes[i], row, left, right - left, coverage + (left - first));
        }
    }
    size_t channels = (size_t)image->channels;
    uint8_t *pixels =
        image->pixels + ((size_t)row * (size_t)image->width + (size_t)first) * channels;
    for (int i = 0; i < last - first; ++i) {
        if (coverage[i] > 0) {
            blend_pixel(pixels + (size_t)i * channels, image->channels, linear, coverage[i]);
        }
    }
}

static void draw_glyph(burnish_image *image, const burnish_glyph *glyph,
                       const burnish_glyph_scale *scale, const float linear[3]) {
    burnish_stroke strokes[BURNISH_GLYPH_MAX_STROKES];
    rectangle touched[BURNISH_GLYPH_MAX_STROKES];
    size_t count = burnish_glyph_strokes(glyph, scale, strokes);
    rectangle all = {image->width, image->height, 0, 0};
    for (size_t i = 0; i < count; ++i) {
        touched[i] = touched_pixels(image, &strokes[i]);
        all.left = touched[i].left < all.left ? touched[i].left : all.left;
        all.top = touched[i].top < all.top ? touched[i].top : all.top;
        all.right = touched[i].right > all.right ? touched[i].right : all.right;
        all.bottom = touched[i].bottom > all.bottom ? touched[i].bottom : all.bottom;
    }
    for (int row = all.top; row < all.bottom; ++row) {
        for (int first = all.left; first < all.right; first += SPAN) {
            int last = all.right - first > SPAN ? first + SPAN : all.right;
            draw_span(image, strokes, touched, count, row, first, last, linear);
        }
    }
}

static int near_image(float coordinate) {
    return coordinate > -far_away && coordinate < far_away;
}

/* The nearest whole pixel; beyond far_away the value itself, which is never drawn. */
static float snap(float value) {
    if (!near_image(value)) {
        return value;
    }
    return value < 0 ? -(float)(int)(0.5F - value) : (float)(int)(value + 0.5F);
}

/* The pen for capitals of the given height, its seat (the whole pixels that its width takes in the
 * layout) and the unit. A pen a little narrower than its seat is widened to fill it: two grey rows
 * look thinner than a black one beside a faint one. */
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

/* Positions and advances are whole pixels: every stem of a line is then equally sharp, and the same
 * letters are spaced alike wherever they stand. */
float burnish_text_draw(burnish_image *image, float x, float y, float height,
                        const uint8_t color[3], const char *text, size_t length) {
    float seat;
    burnish_glyph_scale scale = make_scale(height, &seat);
    float linear[3] = {0, 0, 0};
    for (int k = 0; image && k < 3; ++k) {
        linear[k] = burnish_srgb_to_linear[color[k]];
    }
    x = snap(x);
    scale.y = snap(y) - seat * 0.5F;
    const burnish_glyph *before = NULL;
    float advance = 0;
    for (size_t i = 0; i < length; ++i) {
        unsigned char character = (unsigned char)text[i];
        if ((character & 0xC0) == 0x80 && i > 0 && (unsigned char)text[i - 1] >= 0x80) {
            continue; /* the rest of a UTF-8 character, whose first byte gave the '?' */
        }
        const burnish_glyph *glyph = burnish_glyph_find(character);
        advance += gap_pixels(&scale, before, glyph);
        scale.x = x + advance + seat * 0.5F;
        if (image && image->pixels && near_image(scale.x) && near_image(scale.y)) {
            draw_glyph(image, glyph, &scale, linear);
        }
        advance += burnish_glyph_pixels(&scale, glyph->width) + seat;
        before = glyph;
    }
    return advance + gap_pixels(&scale, before, NULL);
}

float burnish_image_draw_text(burnish_image *image, float x, float y, float height,
                              const uint8_t color[3], const char *text) {
    if (!text) {
        return 0;
    }
    const burnish_environment before = burnish_environment_enter();
    const float advance = burnish_text_draw(image, x, y, height, color, text, strlen(text));
    burnish_environment_leave(before);
    return advance;
}
