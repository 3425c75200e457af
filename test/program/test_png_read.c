/* Reading PNG: every pixel format of libpng, and truncated, damaged or inconsistent files. */
#include <png.h>

#include "picture/read_png.h"
#include "support.h"

/* A file in memory. */
typedef struct file {
    uint8_t bytes[1 << 16];
    size_t size;
} file;

static void put(png_structp png, png_bytep from, size_t count) {
    file *f = png_get_io_ptr(png);
    if (count > sizeof f->bytes - f->size) {
        png_error(png, "too large for the test");
    }
    memcpy(f->bytes + f->size, from, count);
    f->size += count;
}

static void flush(png_structp png) {
    (void)png;
}

typedef struct kind {
    int color, depth;
    int transparent; /* a tRNS chunk */
} kind;

enum { WIDTH = 13, HEIGHT = 9 };

/* The sample of a channel, which depends on position and channel and has all values. */
static unsigned sample(const kind *k, int x, int y, int channel) {
    return (unsigned)(x * 5003 + y * 9001 + channel * 21001) & ((1u << k->depth) - 1);
}

static int channels_of(int color) {
    return color == PNG_COLOR_TYPE_GRAY || color == PNG_COLOR_TYPE_PALETTE ? 1
           : color == PNG_COLOR_TYPE_GRAY_ALPHA                            ? 2
           : color == PNG_COLOR_TYPE_RGB                                   ? 3
                                                                           : 4;
}

static png_color palette_entry(int i) {
    return (png_color){(png_byte)(i * 7), (png_byte)(255 - i), (png_byte)(i * i)};
}

static void write_header(png_structp png, png_infop info, const kind *k, int interlaced) {
    png_color palette[256];
    png_byte alphas[2] = {0, 100};
    png_color_16 clear = {.gray = 0};
    png_set_IHDR(png, info, WIDTH, HEIGHT, k->depth, k->color,
                 interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (k->color == PNG_COLOR_TYPE_PALETTE) {
        for (int i = 0; i < 1 << k->depth; ++i) {
            palette[i] = palette_entry(i);
        }
        png_set_PLTE(png, info, palette, 1 << k->depth);
    }
    if (k->transparent && k->color == PNG_COLOR_TYPE_PALETTE) {
        png_set_tRNS(png, info, alphas, 2, NULL);
    } else if (k->transparent) { /* the first pixel's colour */
        clear.gray = (png_uint_16)sample(k, 0, 0, 0);
        clear.red = clear.gray;
        clear.green = (png_uint_16)sample(k, 0, 0, 1);
        clear.blue = (png_uint_16)sample(k, 0, 0, 2);
        png_set_tRNS(png, info, NULL, 0, &clear);
    }
    png_set_gAMA(png, info, 1.0); /* which must not matter */
    png_write_info(png, info);
}

/* Rows for libpng: packed samples, 16 bits with the high byte first. */
static void write_rows(png_structp png, const kind *k, int interlaced) {
    uint8_t rows[HEIGHT][WIDTH * 8];
    png_bytep pointers[HEIGHT];
    const int channels = channels_of(k->color);
    memset(rows, 0, sizeof rows);
    for (int y = 0; y < HEIGHT; ++y) {
        pointers[y] = rows[y];
        for (int i = 0; i < WIDTH * channels; ++i) {
            const unsigned value = sample(k, i / channels, y, i % channels);
            const int bit = i * k->depth;
            if (k->depth == 16) {
                rows[y][2 * i] = (uint8_t)(value >> 8);
                rows[y][2 * i + 1] = (uint8_t)value;
            } else {
                rows[y][bit / 8] |= (uint8_t)(value << (8 - k->depth - bit % 8));
            }
        }
    }
    if (interlaced) {
        png_set_interlace_handling(png);
    }
    png_write_image(png, pointers);
}

static void write_png(const kind *k, int interlaced, file *f) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    f->size = 0;
    if (setjmp(png_jmpbuf(png))) {
        exit(EXIT_FAILURE);
    }
    png_set_write_fn(png, f, put, flush);
    write_header(png, info, k, interlaced);
    write_rows(png, k, interlaced);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
}

/* A sample as the nearest 8-bit value. */
static int code_of(const kind *k, unsigned value) {
    const unsigned most = (1u << k->depth) - 1;
    return (int)((value * 510 + most) / (2 * most));
}

static void expect_pixel(const kind *k, int x, int y, int rgba[4]) {
    const int channels = channels_of(k->color);
    unsigned v[4] = {0};
    int same = 1;
    for (int c = 0; c < channels; ++c) {
        v[c] = sample(k, x, y, c);
        same &= v[c] == sample(k, 0, 0, c);
    }
    rgba[3] = k->transparent && same ? 0 : 255;
    if (k->color == PNG_COLOR_TYPE_PALETTE) {
        const png_color color = palette_entry((int)v[0]);
        rgba[0] = color.red, rgba[1] = color.green, rgba[2] = color.blue;
        rgba[3] = !k->transparent ? 255 : v[0] == 0 ? 0 : v[0] == 1 ? 100 : 255;
        return;
    }
    for (int c = 0; c < 3; ++c) {
        rgba[c] = code_of(k, v[channels < 3 ? 0 : c]);
    }
    if (channels % 2 == 0) {
        rgba[3] = code_of(k, v[channels - 1]);
    }
}

static void check_pixels(const kind *k, const burnish_image *image) {
    const int alpha = k->transparent || channels_of(k->color) % 2 == 0;
    CHECK1(image->width == WIDTH && image->height == HEIGHT && image->channels == 3 + alpha);
    for (int i = 0; i < WIDTH * HEIGHT && image->pixels; ++i) {
        const uint8_t *found = image->pixels + i * image->channels;
        int rgba[4];
        expect_pixel(k, i % WIDTH, i / WIDTH, rgba);
        for (int c = 0; c < image->channels; ++c) {
            CHECK(found[c] == rgba[c],
                  "colour type %d, depth %d, tRNS %d: pixel %d, channel %d: %d, not %d", k->color,
                  k->depth, k->transparent, i, c, found[c], rgba[c]);
        }
    }
}

static void test_kinds(void) {
    static const int depths[] = {1, 2, 4, 8, 16};
    static file f;
    for (int color = 0; color <= 6; ++color) {
        for (int i = 0; i < 5 * 2 * 2; ++i) {
            const kind k = {color, depths[i % 5], i / 5 % 2};
            const int whole = k.depth >= 8, palette = color == PNG_COLOR_TYPE_PALETTE;
            const int allowed =
                color == 0 || (palette ? k.depth <= 8 : color != 1 && color != 5 && whole);
            burnish_image image;
            burnish_error error = {0};
            if (!allowed || (k.transparent && color >= 4)) {
                continue;
            }
            write_png(&k, i / 10, &f);
            CHECK_OK(picture_decode_png("x.png", f.bytes, f.size, &image, &error), error);
            check_pixels(&k, &image);
            burnish_image_destroy(&image);
        }
    }
}

/* A truncated file is an error, with one line, at any length. */
static void test_cut(void) {
    static file f;
    const kind k = {PNG_COLOR_TYPE_RGB, 8, 0};
    burnish_image image;
    write_png(&k, 1, &f);
    for (size_t size = 0; size < f.size; ++size) {
        burnish_error error = {0};
        uint8_t *exact = malloc(size + 1); /* to detect reading beyond the end */
        memcpy(exact, f.bytes, size);
        CHECK(picture_decode_png("x.png", exact, size, &image, &error) == BURNISH_STATUS_FORMAT,
              "%zu bytes are accepted", size);
        CHECK(strncmp(error.text, "x.png: ", 7) == 0 && !image.pixels, "%s", error.text);
        free(exact);
    }
}

/* Damaged bytes give a picture or an error line. */
static void test_damaged(void) {
    static file f, damaged;
    const kind k = {PNG_COLOR_TYPE_PALETTE, 4, 1};
    uint64_t state = test_seed(1);
    int refused = 0;
    write_png(&k, 0, &f);
    for (int round = 0; round < 2000; ++round) {
        burnish_image image;
        burnish_error error = {0};
        damaged = f;
        for (int i = 0; i <= round % 3; ++i) {
            damaged.bytes[8 + test_random32(&state) % (f.size - 8)] ^=
                (uint8_t)(1u << test_random32(&state) % 8);
        }
        const burnish_status status =
            picture_decode_png("x.png", damaged.bytes, damaged.size, &image, &error);
        CHECK((status == BURNISH_STATUS_OK) == (image.pixels != NULL), "round %d", round);
        refused += status != BURNISH_STATUS_OK;
        burnish_image_destroy(&image);
    }
    CHECK(refused > 1000, "%d of 2000", refused);
}

/* CRC-32 of PNG, from its definition. */
static uint32_t crc_of(const uint8_t *bytes, size_t size) {
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
        }
    }
    return ~crc;
}

static void put_u32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> (24 - 8 * i));
    }
}

static void refuse_size(uint32_t width, uint32_t height, burnish_status wanted, const char *line) {
    static file f;
    const kind k = {PNG_COLOR_TYPE_RGB_ALPHA, 8, 0};
    burnish_image image;
    burnish_error error = {0};
    write_png(&k, 0, &f);
    put_u32(f.bytes + 16, width);
    put_u32(f.bytes + 20, height);
    put_u32(f.bytes + 29, crc_of(f.bytes + 12, 17));
    CHECK1(picture_decode_png("x.png", f.bytes, f.size, &image, &error) == wanted);
    CHECK(strncmp(error.text, line, strlen(line)) == 0, "%s", error.text);
    CHECK1(!image.pixels);
}

static void test_limits(void) {
    refuse_size(16384, 16384, BURNISH_STATUS_FORMAT,
                "x.png: 16384 x 16384 pixels can't be in a PNG of ");
    refuse_size(16385, 1, BURNISH_STATUS_LIMIT,
                "x.png: 16385 x 1 pixels; pictures of up to 16384 x 16384 are read");
    refuse_size(2, 0x7fffffff, BURNISH_STATUS_LIMIT, "x.png: 2 x 2147483647 pixels; ");
    refuse_size(13, 10, BURNISH_STATUS_FORMAT, "x.png: no sound PNG: ");
    refuse_size(0, 1, BURNISH_STATUS_FORMAT, "x.png: no sound PNG: ");
    burnish_image image;
    burnish_error error;
    CHECK1(picture_decode_png("x.png", (const uint8_t *)"P6\n1 1", 6, &image, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "x.png: not a PNG file; convert the picture to PNG");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_kinds());
    RUN(test_cut());
    RUN(test_damaged());
    RUN(test_limits());
    return test_end("png_read");
}
