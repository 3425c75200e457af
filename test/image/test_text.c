/* Text: clipping, measuring, every glyph, blending in linear light, the same bits everywhere. */
#include <math.h>

#include "burnish/sheet.h"
#include "core/srgb.h"
#include "image/text/stroke_font.h"
#include "images.h"

static const uint8_t black[3] = {0, 0, 0};

/* x0, y0, x1, y1 (exclusive) of the pixels that are not white; all 0 when there is none. */
static void ink_bounds(const burnish_image *image, int bounds[4]) {
    memset(bounds, 0, 4 * sizeof *bounds);
    for (int y = 0; y < image->height; ++y) {
        for (int x = 0; x < image->width; ++x) {
            if (pixel_at(image, x, y)[0] != 255) {
                int first = bounds[2] == 0;
                bounds[0] = first || x < bounds[0] ? x : bounds[0];
                bounds[1] = first ? y : bounds[1];
                bounds[2] = x + 1 > bounds[2] ? x + 1 : bounds[2];
                bounds[3] = y + 1;
            }
        }
    }
}

/* Text at every offset around a small image is the same as the crop of a large one. */
static void test_clipping(void) {
    static const char text[] = "@gW|j";
    enum { BORDER = 70, WIDTH = 12, HEIGHT = 10 };
    for (int y = -12; y <= HEIGHT + 30; y += 3) {
        for (int x = -60; x <= WIDTH + 6; ++x) {
            burnish_image small = make_filled(WIDTH, HEIGHT, 3, 255);
            burnish_image large = make_filled(WIDTH + 2 * BORDER, HEIGHT + 2 * BORDER, 3, 255);
            burnish_image crop = make_filled(WIDTH, HEIGHT, 3, 0);
            burnish_image_draw_text(&small, (float)x, (float)y, 14, black, text);
            burnish_image_draw_text(&large, (float)(x + BORDER), (float)(y + BORDER), 14, black,
                                    text);
            burnish_image_copy(&crop, -BORDER, -BORDER, &large);
            CHECK(burnish_image_hash(&small) == burnish_image_hash(&crop), "at %d, %d", x, y);
            burnish_image_destroy(&small);
            burnish_image_destroy(&large);
            burnish_image_destroy(&crop);
        }
    }
}

static void test_extremes(void) {
    const float values[] = {
        (float)NAN, (float)INFINITY, -(float)INFINITY, 1e30F, -1e30F, 5e6F, -5e6F, 4e6F, -4e6F,
        40000};
    burnish_image image = make_filled(31, 9, 4, 255);
    uint64_t before = burnish_image_hash(&image);
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        burnish_image_draw_text(&image, values[i], 5, 20, black, "text");
        burnish_image_draw_text(&image, 5, values[i], 20, black, "text");
    }
    CHECK(burnish_image_hash(&image) == before, "text far outside must draw nothing");
    for (size_t i = 0; i < sizeof values / sizeof *values; ++i) {
        float advance = burnish_image_draw_text(&image, 1, 8, values[i], black, "M");
        CHECK(advance > 0 && advance < 2 * BURNISH_IMAGE_MAX_SIZE, "height %g", (double)values[i]);
    }
    CHECK(burnish_image_hash(&image) != before, "a text at any height is drawn");
    CHECK(burnish_image_draw_text(&image, 0, 0, 9, black, NULL) == 0, "NULL");
    CHECK(burnish_image_draw_text(&image, 0, 0, 9, black, "") == 0, "no text");
    burnish_image_destroy(&image);
    CHECK(burnish_image_draw_text(&image, 0, 0, 9, black, "A") > 0, "an empty image only measures");
}

static void test_measuring(void) {
    static const char text[] = "energy:2 (W1)  n = 32";
    burnish_image image = make_filled(400, 80, 3, 255);
    for (float height = 5; height < 80; height += 0.75F) {
        float measured = burnish_image_draw_text(NULL, 0, 0, height, black, text);
        float drawn = burnish_image_draw_text(&image, 3.3F, 60, height, black, text);
        CHECK(measured == drawn, "height %g: %g and %g", (double)height, (double)measured,
              (double)drawn);
        CHECK(measured > 8 * height && measured < 16 * height, "height %g: %g", (double)height,
              (double)measured);
    }
    burnish_image_destroy(&image);
}

/* Each glyph has ink within its advance, and no two look the same. */
static void test_glyphs(int height) {
    uint64_t hashes[127] = {0};
    for (int c = 33; c < 127; ++c) {
        char text[2] = {(char)c, 0};
        burnish_image image = make_filled(3 * height, 3 * height, 3, 255);
        float advance = burnish_image_draw_text(&image, (float)height, 2.0F * (float)height,
                                                (float)height, black, text);
        int bounds[4];
        ink_bounds(&image, bounds);
        CHECK(bounds[2] > 0, "'%c' has no ink", c);
        CHECK(bounds[0] >= height - 1 && (float)bounds[2] <= (float)height + advance + 1,
              "'%c' from %d to %d with advance %g", c, bounds[0] - height, bounds[2] - height,
              (double)advance);
        CHECK(bounds[1] >= height - height / 4 && bounds[3] <= 2 * height + height / 2,
              "'%c' from row %d to %d", c, bounds[1], bounds[3]);
        hashes[c] = burnish_image_hash(&image);
        for (int other = 33; other < c; ++other) {
            CHECK(hashes[other] != hashes[c], "'%c' and '%c' look the same", other, c);
        }
        burnish_image_destroy(&image);
    }
}

static void test_stroke_limit(void) {
    burnish_glyph_scale scale = {.unit = BURNISH_IMAGE_MAX_SIZE / 100.0F, .radius = 900};
    burnish_stroke strokes[BURNISH_GLYPH_MAX_STROKES];
    size_t most = 0;
    for (int c = 0; c < 256; ++c) {
        size_t count = burnish_glyph_strokes(burnish_glyph_find((unsigned char)c), &scale, strokes);
        most = count > most ? count : most;
    }
    CHECK(most > 200 && most < BURNISH_GLYPH_MAX_STROKES, "%zu strokes", most);
}

static uint64_t hash_of(const char *text) {
    burnish_image image = make_filled(80, 20, 3, 255);
    burnish_image_draw_text(&image, 2, 15, 12, black, text);
    uint64_t hash = burnish_image_hash(&image);
    burnish_image_destroy(&image);
    return hash;
}

static void test_other_characters(void) {
    CHECK(hash_of("a\tb") == hash_of("a?b"), "a control character");
    CHECK(hash_of("a\x7f") == hash_of("a?"), "DEL");
    CHECK(hash_of("\xc3\xa4z\xc5\xbe") == hash_of("azz"), "Latin letters");
    CHECK(hash_of("a\xcc\x88z") == hash_of("az"), "an accent by itself");
    CHECK(hash_of("\xd0\xb4z") == hash_of("?z"), "two bytes of UTF-8");
    CHECK(hash_of("\xe2\x82\xacz") == hash_of("?z"), "three bytes of UTF-8");
    CHECK(hash_of("a\x80") == hash_of("a?"), "a stray byte");
    CHECK(hash_of("a\xff\xff") == hash_of("a??"), "bytes that are no UTF-8");
    CHECK(hash_of("a b") != hash_of("ab"), "a space");
}

/* Over nothing, alpha is the coverage and the colour is pure; over white, the same coverage mixes
 * linear light. */
static void test_blending(void) {
    const uint8_t color[3] = {200, 100, 0};
    burnish_image layer = make_filled(60, 30, 4, 0);
    burnish_image plain = make_filled(60, 30, 3, 255);
    burnish_image solid = make_filled(60, 30, 4, 255);
    burnish_image_draw_text(&layer, 2, 22, 17, color, "S&8e");
    burnish_image_draw_text(&plain, 2, 22, 17, color, "S&8e");
    burnish_image_draw_text(&solid, 2, 22, 17, color, "S&8e");
    int partial = 0;
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 60; ++x) {
            const uint8_t *over_nothing = pixel_at(&layer, x, y);
            const uint8_t *over_white = pixel_at(&plain, x, y);
            float share = (float)over_nothing[3] / 255.0F;
            partial += over_nothing[3] > 20 && over_nothing[3] < 235;
            CHECK(over_nothing[3] == 0 || memcmp(over_nothing, color, 3) == 0, "pure colour");
            for (int k = 0; k < 3; ++k) {
                float mixed = share * burnish_srgb_to_linear[color[k]] + (1 - share);
                /* Half a step of alpha and half a code of the result. */
                CHECK(fabsf(burnish_srgb_to_linear[over_white[k]] - mixed) <= 0.0065F,
                      "%d, %d: got %d, expected %d", x, y, over_white[k],
                      burnish_linear_to_srgb(mixed));
            }
            const uint8_t *over_solid = pixel_at(&solid, x, y);
            CHECK(memcmp(over_solid, over_white, 3) == 0 && over_solid[3] == 255, "opaque RGBA");
        }
    }
    CHECK(partial > 60, "%d partly covered pixels", partial);
    burnish_image_destroy(&layer);
    burnish_image_destroy(&plain);
    burnish_image_destroy(&solid);
}

/* Bits are a promise: a changed hash is a changed picture, to be listed in the changelog. */
static void test_golden(void) {
    char all[96];
    for (int c = 32; c < 127; ++c) {
        all[c - 32] = (char)c;
    }
    all[95] = 0;
    burnish_image image = make_filled(1200, 120, 3, 40);
    const uint8_t color[3] = {230, 231, 229};
    burnish_image_draw_text(&image, 5, 20, 10, color, all);
    burnish_image_draw_text(&image, 5, 60, 14, color, all);
    burnish_image_draw_text(&image, -40, 100, 31.5F, color, all);
    uint64_t hash = burnish_image_hash(&image);
    CHECK(hash == 0xb3ce27dc39387da9, "got 0x%016llx", (unsigned long long)hash);
    burnish_image_destroy(&image);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_clipping());
    RUN(test_extremes());
    RUN(test_measuring());
    RUN(test_glyphs(8));
    RUN(test_glyphs(14));
    RUN(test_glyphs(50));
    RUN(test_stroke_limit());
    RUN(test_other_characters());
    RUN(test_blending());
    RUN(test_golden());
    return test_end("text");
}
