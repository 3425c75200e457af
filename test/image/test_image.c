/* Images: making, hashing, copying, contact sheets. */
#include <limits.h>

#include "burnish/sheet.h"
#include "counting_context.h"
#include "images.h"

#define CHECK_STATUS(call, expected) CHECK((call) == (expected), "not the expected status")

static void test_create(void) {
    static const struct {
        int width, height, channels;
        const char *text;
    } bad[] = {
        {0, 1, 3, "image: a size of 0 x 1 pixels; width and height must be 1 to 16384"},
        {1, -1, 3, "image: a size of 1 x -1 pixels; width and height must be 1 to 16384"},
        {16385, 1, 3, "image: a size of 16385 x 1 pixels; width and height must be 1 to 16384"},
        {1, INT_MAX, 4,
         "image: a size of 1 x 2147483647 pixels; width and height must be 1 to 16384"},
        {1, 1, 1, "image: 1 channels; use 3 (RGB) or 4 (RGBA)"},
        {1, 1, 5, "image: 5 channels; use 3 (RGB) or 4 (RGBA)"},
    };
    burnish_error error;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        burnish_image image = {1, 2, 3, NULL, NULL};
        CHECK_STATUS(burnish_image_create(NULL, &image, bad[i].width, bad[i].height,
                                          bad[i].channels, &error),
                     BURNISH_STATUS_ARGUMENT);
        CHECK_TEXT(error.text, bad[i].text);
        CHECK(image.width == 0 && image.height == 0 && image.channels == 0 && !image.pixels,
              "the image must be empty");
    }
    CHECK_STATUS(burnish_image_create(NULL, NULL, 1, 1, 3, NULL), BURNISH_STATUS_ARGUMENT);
    burnish_image image;
    CHECK_STATUS(burnish_image_create(NULL, &image, 5, 7, 4, NULL), BURNISH_STATUS_OK);
    for (int i = 0; i < 5 * 7 * 4; ++i) {
        CHECK(image.pixels[i] == 0, "a new image must be zero");
    }
    burnish_image_destroy(&image);
    CHECK(!image.pixels && image.width == 0, "the image must be empty");
    burnish_image_destroy(&image);
    burnish_image_destroy(NULL);
}

/* Pixels are the context's memory; those of a context without an allocator outlive it. */
static void test_context(void) {
    counts c;
    burnish_context *context = make_context(&c);
    const burnish_context_options without = burnish_context_options_default();
    const long before = c.live;
    burnish_image image, sheet;
    CHECK_STATUS(burnish_image_create(context, &image, 5, 7, 4, NULL), BURNISH_STATUS_OK);
    const burnish_sheet_cell cell = {.image = &image};
    const uint8_t color[3] = {0};
    CHECK1(image.context == context && c.live == before + 1);
    CHECK_STATUS(burnish_image_sheet(&sheet, &cell, 1, 1, color, color, NULL), BURNISH_STATUS_OK);
    CHECK1(sheet.context == context && c.live == before + 2);
    burnish_image_destroy(&sheet);
    burnish_image_destroy(&image);
    CHECK1(c.live == before);
    burnish_context_destroy(context);
    CHECK_STATUS(burnish_context_create(&without, &context, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_image_create(context, &image, 5, 7, 4, NULL), BURNISH_STATUS_OK);
    burnish_context_destroy(context);
    CHECK1(!image.context);
    burnish_image_destroy(&image);
}

/* XXH64 with seed 0 of bytes 37 i + i / 7, by another implementation. */
static void test_hash(void) {
    static const struct {
        int width, height, channels;
        uint64_t hash;
    } cases[] = {{1, 1, 4, 0xA9C00AE8F9B200F0},  {2, 2, 3, 0x2EF9B7CDDDE7104A},
                 {5, 1, 3, 0xA577B636B8CBB326},  {3, 3, 3, 0xB092599AB141B617},
                 {2, 4, 4, 0xFAA81787443D514F},  {11, 1, 3, 0x8CF55F44B9B5F748},
                 {11, 1, 4, 0xC0DA60A9534C309C}, {7, 3, 3, 0x6A6AA433D040E036},
                 {69, 1, 3, 0x05E3773F6B1E0BBB}, {31, 12, 4, 0x39E9A4E8B07D3DEA}};
    burnish_image image = {0};
    CHECK(burnish_image_hash(&image) == 0xEF46DB3751D8E999, "XXH64 of nothing");
    image = make_image(1, 1, 3);
    memcpy(image.pixels, "abc", 3);
    CHECK(burnish_image_hash(&image) == 0x44BC2CF5AD770999, "XXH64 of abc");
    burnish_image_destroy(&image);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        image = make_image(cases[i].width, cases[i].height, cases[i].channels);
        for (size_t k = 0; k < image_size(&image); ++k) {
            image.pixels[k] = (uint8_t)(37 * k + k / 7);
        }
        CHECK(burnish_image_hash(&image) == cases[i].hash, "case %zu: %016llx", i,
              (unsigned long long)burnish_image_hash(&image));
        burnish_image_destroy(&image);
    }
}

/* Every placement of a small picture around and in another one, against a pixel-wise copy. */
static void test_copy(void) {
    for (int channels = 3; channels <= 4; ++channels) {
        burnish_image source = make_noise(4, 3, channels, 1);
        for (int y = -4; y <= 7; ++y) {
            for (int x = -5; x <= 8; ++x) {
                burnish_image target = make_noise(7, 6, channels, 2);
                burnish_image expected = make_noise(7, 6, channels, 2);
                for (int j = 0; j < 6; ++j) {
                    for (int i = 0; i < 7; ++i) {
                        if (i >= x && i < x + 4 && j >= y && j < y + 3) {
                            memcpy(expected.pixels + (j * 7 + i) * channels,
                                   source.pixels + ((j - y) * 4 + i - x) * channels,
                                   (size_t)channels);
                        }
                    }
                }
                burnish_image_copy(&target, x, y, &source);
                CHECK(burnish_image_hash(&target) == burnish_image_hash(&expected), "at %d, %d", x,
                      y);
                burnish_image_destroy(&target);
                burnish_image_destroy(&expected);
            }
        }
        burnish_image_destroy(&source);
    }
}

static void test_copy_extremes(void) {
    const int places[] = {INT_MIN, INT_MIN + 1, -100000, 100000, INT_MAX - 1, INT_MAX};
    burnish_image target = make_noise(9, 9, 3, 1);
    burnish_image source = make_noise(20, 20, 3, 2);
    uint64_t before = burnish_image_hash(&target);
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        burnish_image_copy(&target, places[i], 0, &source);
        burnish_image_copy(&target, 0, places[i], &source);
        burnish_image_copy(&target, places[i], places[i], &source);
    }
    burnish_image other = make_noise(3, 3, 4, 3);
    burnish_image empty = {0};
    burnish_image_copy(&target, 0, 0, &other);
    burnish_image_copy(&target, 0, 0, &empty);
    burnish_image_copy(&empty, 0, 0, &source);
    CHECK(burnish_image_hash(&target) == before, "nothing may be copied from outside");
    burnish_image_destroy(&other);
    burnish_image_destroy(&target);
    burnish_image_destroy(&source);
}

/* Whether source stands in the sheet at (x, y). */
static int contains(const burnish_image *sheet, const burnish_image *source, int x, int y) {
    for (int j = 0; j < source->height; ++j) {
        if (memcmp(pixel_at(sheet, x, y + j), pixel_at(source, 0, j),
                   (size_t)source->width * (size_t)source->channels) != 0) {
            return 0;
        }
    }
    return 1;
}

static const uint8_t background[3] = {10, 20, 30};
static const uint8_t ink[3] = {240, 230, 220};

static void check_sheet(int channels, int count, int columns, int labels) {
    burnish_image images[7];
    burnish_sheet_cell cells[7];
    for (int i = 0; i < count; ++i) {
        images[i] = make_noise(96, 72, channels, (uint64_t)i);
        cells[i] = (burnish_sheet_cell){&images[i], labels ? "energy:2" : NULL, NULL};
    }
    burnish_image sheet;
    burnish_error error;
    CHECK_STATUS(
        burnish_image_sheet(&sheet, cells, (size_t)count, columns, background, ink, &error),
        BURNISH_STATUS_OK);
    int rows = (count + columns - 1) / columns;
    const int gap = 4;
    int band = (sheet.height - gap) / rows - 72 - gap;
    CHECK(sheet.width == gap + columns * (96 + gap) && sheet.channels == channels, "size");
    CHECK(sheet.height == gap + rows * (72 + band + gap), "rows of equal height");
    CHECK(labels ? band >= 16 : band == 0, "a label's band of %d", band);
    for (int i = 0; i < count; ++i) {
        int x = gap + i % columns * (96 + gap);
        int y = gap + i / columns * (72 + band + gap);
        CHECK(contains(&sheet, &images[i], x, y), "picture %d", i);
        int inked = 0;
        for (int j = 0; j < band * 96; ++j) {
            inked += memcmp(pixel_at(&sheet, x + j % 96, y + 72 + j / 96), background, 3) != 0;
        }
        CHECK((inked > 50) == labels, "label %d has %d pixels", i, inked);
    }
    for (int x = 0; x < sheet.width; ++x) {
        const uint8_t *pixel = pixel_at(&sheet, x, 0);
        CHECK(memcmp(pixel, background, 3) == 0 && (channels == 3 || pixel[3] == 255), "margin");
    }
    burnish_image_destroy(&sheet);
    for (int i = 0; i < count; ++i) {
        burnish_image_destroy(&images[i]);
    }
}

/* A label much wider than its cell: cut, and nothing in the neighbour's column or the margin. */
static void test_long_label(void) {
    burnish_image image = make_noise(60, 40, 3, 1);
    static char text[5000];
    memset(text, 'W', sizeof text - 1);
    burnish_sheet_cell cells[2] = {{&image, "", NULL}, {&image, text, NULL}};
    burnish_image sheet;
    CHECK_STATUS(burnish_image_sheet(&sheet, cells, 2, 2, background, ink, NULL),
                 BURNISH_STATUS_OK);
    int outside = 0;
    int inside = 0;
    for (int y = 4 + 40; y < sheet.height; ++y) {
        for (int x = 0; x < sheet.width; ++x) {
            int inked = memcmp(pixel_at(&sheet, x, y), background, 3) != 0;
            *(x >= 4 + 60 + 4 && x < 4 + 60 + 4 + 60 ? &inside : &outside) += inked;
        }
    }
    CHECK(inside > 50 && outside == 0, "%d pixels inside, %d outside", inside, outside);
    burnish_image_destroy(&sheet);
    burnish_image_destroy(&image);

    image = make_noise(3, 3, 4, 1);
    burnish_sheet_cell tiny = {&image, "label", NULL};
    CHECK(burnish_image_sheet(&sheet, &tiny, 1, 1, background, ink, NULL) == BURNISH_STATUS_OK,
          "a cell too narrow for its label");
    CHECK(sheet.width == 11, "%d", sheet.width);
    burnish_image_destroy(&sheet);
    burnish_image_destroy(&image);
}

/* A label a little too wide makes all labels smaller, so that it need not be cut. */
static void test_smaller_labels(void) {
    burnish_image image = make_noise(100, 280, 3, 1);
    int heights[2];
    for (int i = 0; i < 2; ++i) {
        burnish_sheet_cell cells[2] = {{&image, "front", NULL},
                                       {&image, i ? "from the left front" : "", NULL}};
        burnish_image sheet;
        CHECK_STATUS(burnish_image_sheet(&sheet, cells, 2, 2, background, ink, NULL),
                     BURNISH_STATUS_OK);
        heights[i] = sheet.height;
        burnish_image_destroy(&sheet);
    }
    CHECK(heights[1] < heights[0] && heights[1] >= 280 + 15, "%d, %d", heights[0], heights[1]);
    burnish_image_destroy(&image);
}

static void test_sheet_errors(void) {
    burnish_image a = make_noise(8, 8, 3, 1);
    burnish_image b = make_noise(8, 9, 3, 1);
    burnish_image wide = make_noise(9000, 1, 3, 1);
    burnish_image empty = {0};
    burnish_image sheet;
    burnish_error error;
    burnish_sheet_cell cells[2] = {{&a, NULL, NULL}, {&b, NULL, NULL}};
#define REFUSED(count, columns, line)                                                              \
    CHECK_STATUS(burnish_image_sheet(&sheet, cells, count, columns, background, ink, &error),      \
                 BURNISH_STATUS_ARGUMENT);                                                         \
    CHECK_TEXT(error.text, line);                                                                  \
    CHECK(!sheet.pixels && sheet.width == 0, "the sheet must be empty")
    REFUSED(
        2, 1,
        "sheet: picture 2 is 8 x 9 with 3 channels, the first is 8 x 8 with 3; make them equal");
    cells[1].image = &empty;
    REFUSED(2, 1, "sheet: picture 2 is empty; render it first");
    REFUSED(1, 2, "sheet: 2 columns for 1 pictures; use 1 to the number of pictures");
    REFUSED(0, 1, "sheet: 1 columns for 0 pictures; use 1 to the number of pictures");
    REFUSED(2, 0, "sheet: 0 columns for 2 pictures; use 1 to the number of pictures");
    cells[0].image = cells[1].image = &wide;
    REFUSED(2, 2,
            "sheet: 2 pictures of 9000 x 1 in 2 columns exceed 16384 pixels; use smaller pictures "
            "or another number of columns");
#undef REFUSED
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
    burnish_image_destroy(&wide);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_create());
    RUN(test_context());
    RUN(test_hash());
    RUN(test_copy());
    RUN(test_copy_extremes());
    for (int channels = 3; channels <= 4; ++channels) {
        RUN(check_sheet(channels, 1, 1, 1));
        RUN(check_sheet(channels, 6, 3, 0));
        RUN(check_sheet(channels, 7, 3, 1));
        RUN(check_sheet(channels, 4, 1, 1));
    }
    RUN(test_long_label());
    RUN(test_smaller_labels());
    RUN(test_sheet_errors());
    return test_end("image");
}
