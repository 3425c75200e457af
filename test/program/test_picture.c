/* Image files are read back by the decoders of their formats. */
#include <math.h>

#include "picture/formats.h"
#include "support.h"

/* A small drawing: a flat background, a coloured edge, a smooth gradient, some alpha. */
static burnish_image make(int width, int height, int channels) {
    burnish_image image;
    if (burnish_image_create(NULL, &image, width, height, channels, NULL) != BURNISH_STATUS_OK) {
        exit(EXIT_FAILURE);
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            uint8_t *pixel = image.pixels + (size_t)channels * (size_t)(y * width + x);
            const int inside = 3 * x + y > width;
            pixel[0] = (uint8_t)(inside ? 40 + 180 * y / height : 238);
            pixel[1] = (uint8_t)(inside ? 60 + 90 * x / width : 238);
            pixel[2] = (uint8_t)(inside ? 30 : 240);
            if (channels == 4) {
                pixel[3] = (uint8_t)(inside ? 255 : x % 5 == 0 ? 0 : 128);
            }
        }
    }
    return image;
}

/* Peak signal to noise ratio in dB of two arrays of bytes. */
__attribute__((unused)) static double psnr(const uint8_t *a, const uint8_t *b, size_t size) {
    double sum = 0;
    for (size_t i = 0; i < size; ++i) {
        const double difference = (double)a[i] - b[i];
        sum += difference * difference;
    }
    return sum == 0 ? INFINITY : 10 * log10(255.0 * 255.0 * (double)size / sum);
}

static burnish_status encode(picture_format format, const burnish_image *image,
                             picture_options options, picture_file *file, burnish_error *error) {
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    return picture_encode(format, &pixels, &options, file, error);
}

/* ---- JPEG ---- */

#if BURNISH_HAS_JPEG
#include <jpeglib.h>

/* Decodes into new memory of width * height * 3 bytes; leaves the header in *codec. */
static uint8_t *decode_jpeg(const picture_file *file, struct jpeg_decompress_struct *codec) {
    static struct jpeg_error_mgr manager; /* ends the program after an error, which fails the test
                                             */
    codec->err = jpeg_std_error(&manager);
    jpeg_create_decompress(codec);
    jpeg_mem_src(codec, file->bytes, (unsigned long)file->size);
    jpeg_read_header(codec, TRUE);
    codec->out_color_space = JCS_RGB;
    jpeg_start_decompress(codec);
    const size_t row = (size_t)codec->output_width * 3;
    uint8_t *pixels = malloc(row * codec->output_height);
    while (pixels && codec->output_scanline < codec->output_height) {
        JSAMPROW to = pixels + row * codec->output_scanline;
        jpeg_read_scanlines(codec, &to, 1);
    }
    return pixels;
}

/* A higher quality has smaller errors and more bytes. Bounds: 1 dB below measurements. */
static void test_jpeg(void) {
    static const struct {
        int quality;
        double least;
    } CASES[] = {{25, 31}, {0, 42}, {PICTURE_JPEG_QUALITY, 42}, {100, 50}};
    burnish_image image = make(157, 91, 3);
    const size_t size = 157 * 91 * 3;
    size_t before = 0;
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
        picture_file file;
        burnish_error error;
        const picture_options options = {.quality = CASES[i].quality};
        struct jpeg_decompress_struct codec;
        CHECK_OK(encode(PICTURE_JPEG, &image, options, &file, &error), error);
        uint8_t *pixels = decode_jpeg(&file, &codec);
        CHECK(codec.output_width == 157 && codec.output_height == 91 && codec.density_unit == 0,
              "not the header");
        CHECK(codec.comp_info[0].h_samp_factor == codec.comp_info[1].h_samp_factor &&
                  codec.comp_info[0].v_samp_factor == codec.comp_info[1].v_samp_factor,
              "colour is subsampled");
        const double ratio = psnr(pixels, image.pixels, size);
        CHECK(ratio >= CASES[i].least, "quality %d: %.1f dB", CASES[i].quality, ratio);
        CHECK(file.size >= before, "quality %d: smaller than one below", CASES[i].quality);
        before = file.size;
        jpeg_destroy_decompress(&codec);
        picture_release(&file);
        free(pixels);
    }
    burnish_image_destroy(&image);
}

static void test_jpeg_density(void) {
    burnish_image image = make(16, 16, 3);
    picture_file file;
    burnish_error error;
    struct jpeg_decompress_struct codec;
    picture_options options = {.dots_per_inch = 299.7};
    CHECK_OK(encode(PICTURE_JPEG, &image, options, &file, &error), error);
    free(decode_jpeg(&file, &codec));
    CHECK(codec.density_unit == 1 && codec.X_density == 300 && codec.Y_density == 300,
          "%d x %d per unit %d", codec.X_density, codec.Y_density, codec.density_unit);
    jpeg_destroy_decompress(&codec);
    picture_release(&file);
    options.dots_per_inch = 70000;
    CHECK1(encode(PICTURE_JPEG, &image, options, &file, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "JPEG holds at most 65535 dots per inch; write PNG");
    burnish_image_destroy(&image);
    burnish_image alpha = make(16, 16, 4);
    options.dots_per_inch = 0;
    CHECK1(encode(PICTURE_JPEG, &alpha, options, &file, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "JPEG has no alpha; write PNG or WebP");
    burnish_image_destroy(&alpha);
}
#endif

/* ---- WebP ---- */

#if BURNISH_HAS_WEBP
#include <webp/decode.h>

/* Lossless by default, including colours with alpha 0; similar with a quality. */
static void test_webp(void) {
    for (int channels = 3; channels <= 4; ++channels) {
        burnish_image image = make(157, 91, channels);
        const size_t size = 157 * 91 * (size_t)channels;
        for (int quality = 0; quality <= 90; quality += 90) {
            picture_file file;
            burnish_error error;
            const picture_options options = {.quality = quality};
            int width = 0, height = 0;
            CHECK_OK(encode(PICTURE_WEBP, &image, options, &file, &error), error);
            uint8_t *pixels = channels == 4 ? WebPDecodeRGBA(file.bytes, file.size, &width, &height)
                                            : WebPDecodeRGB(file.bytes, file.size, &width, &height);
            if (CHECK(pixels && width == 157 && height == 91, "%d x %d pixels", width, height)) {
                const double ratio = psnr(pixels, image.pixels, size);
                CHECK(quality == 0 ? isinf(ratio) : ratio >= 35, "quality %d: %.1f dB", quality,
                      ratio);
            }
            WebPFree(pixels);
            picture_release(&file);
        }
        burnish_image_destroy(&image);
    }
}

static void test_large_webp(void) {
    burnish_image image = make(16384, 1, 3);
    picture_file file;
    burnish_error error;
    CHECK1(encode(PICTURE_WEBP, &image, (picture_options){0}, &file, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "WebP holds at most 16383 x 16383 pixels, not 16384 x 1; write PNG");
    burnish_image_destroy(&image);
}
#endif

/* ---- Names ---- */

static void test_choice(void) {
    static const struct {
        const char *path;
        picture_format wanted, format; /* COUNT: an error */
    } CASES[] = {
        {"x.png", PICTURE_AUTO, PICTURE_PNG},
        {"x", PICTURE_AUTO, PICTURE_PNG},
        {"-", PICTURE_AUTO, PICTURE_PNG},
        {"a.jpg/x", PICTURE_AUTO, PICTURE_PNG},
        {".x", PICTURE_AUTO, PICTURE_PNG},
        {"tmp.AbC12", PICTURE_AUTO, PICTURE_COUNT},
        {"tmp.AbC12", PICTURE_PNG, PICTURE_PNG},
        {"x.stl", PICTURE_AUTO, PICTURE_COUNT},
        {"x.STL.gz", PICTURE_PNG, PICTURE_COUNT},
        {"x.step", PICTURE_PNG, PICTURE_COUNT},
        {"x.jpg", PICTURE_PNG, PICTURE_PNG},
        {"x.bmp", PICTURE_AUTO, PICTURE_COUNT},
        {"X.TIFF", PICTURE_AUTO, PICTURE_COUNT},
        {"x.svg", PICTURE_AUTO, PICTURE_COUNT},
        {"x.gif", PICTURE_AUTO, PICTURE_COUNT},
        {"x.bmp", PICTURE_PNG, PICTURE_PNG},
#if BURNISH_HAS_JPEG
        {"x.JpG", PICTURE_AUTO, PICTURE_JPEG},
        {"x.jpeg", PICTURE_AUTO, PICTURE_JPEG},
        {"-", PICTURE_JPEG, PICTURE_JPEG},
#else
        {"x.JpG", PICTURE_AUTO, PICTURE_COUNT},
#endif
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
        picture_format format;
        burnish_error error;
        const burnish_status status = picture_choose("output", CASES[i].path, PICTURE_STILL,
                                                     CASES[i].wanted, &format, &error);
        const int refused = CASES[i].format == PICTURE_COUNT;
        CHECK(status == (refused ? BURNISH_STATUS_ARGUMENT : BURNISH_STATUS_OK) &&
                  (refused || format == CASES[i].format),
              "%s: format %d", CASES[i].path, (int)format);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_choice());
#if BURNISH_HAS_JPEG
    RUN(test_jpeg());
    RUN(test_jpeg_density());
#else
    printf("picture: SKIPPED: JPEG, no libjpeg\n");
#endif
#if BURNISH_HAS_WEBP
    RUN(test_webp());
    RUN(test_large_webp());
#else
    printf("picture: SKIPPED: WebP, no libwebp\n");
#endif
    return test_end("picture");
}
