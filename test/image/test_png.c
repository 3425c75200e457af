/* PNG files against libpng. */
#include <png.h>
#include <sys/mman.h>
#include <unistd.h>

#include "counting_context.h"
#include "images.h"

#define CHECK_STATUS(call, expected) CHECK((call) == (expected), "not the expected status")

static burnish_image make(int width, int height, int channels) {
    burnish_image image = make_noise(width, height, channels, (uint64_t)(width * 31 + height));
    const size_t stride = (size_t)width * (size_t)channels;
    for (size_t i = stride; i < image_size(&image); ++i) {
        /* Noise, runs and gradients, so that every kind of deflate block occurs. */
        const size_t row = i / stride;
        image.pixels[i] = (uint8_t)(row % 3 == 0 ? image.pixels[i] : row % 3 == 1 ? 77 : i + row);
    }
    return image;
}

/* The pixels as libpng reads them equal the image's, and the header says what it should. */
static void check_decoded(const burnish_image *image, const void *bytes, size_t size) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!CHECK(png_image_begin_read_from_memory(&png, bytes, size), "%s", png.message)) {
        return;
    }
    int alpha = image->channels == 4;
    CHECK(png.format == (alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB), "format %u",
          (unsigned)png.format);
    CHECK((int)png.width == image->width && (int)png.height == image->height, "size");
    CHECK((png.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB) == 0, "not sRGB");
    size_t pixels_size = PNG_IMAGE_SIZE(png);
    uint8_t *pixels = malloc(pixels_size);
    if (CHECK(pixels && png_image_finish_read(&png, NULL, pixels, 0, NULL), "%s", png.message)) {
        CHECK(png.warning_or_error == 0, "%s", png.message);
        CHECK(memcmp(pixels, image->pixels, pixels_size) == 0, "%d x %d x %d: pixels differ",
              image->width, image->height, image->channels);
    }
    free(pixels);
}

static burnish_status encode(const burnish_image *image, int threads, uint8_t **bytes, size_t *size,
                             burnish_error *error) {
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    burnish_png_options options = burnish_png_options_default();
    options.threads = threads;
    return burnish_png_encode(&pixels, &options, bytes, size, error);
}

/* Filtered rows of noise (which nothing can shorten), of next to nothing, and of symbols very
 * unlike in frequency; kind 4: what make() gives. */
static burnish_image make_kind(int width, int height, int channels, int kind) {
    burnish_image image = make(width, height, channels);
    size_t stride = (size_t)width * (size_t)channels, size = stride * (size_t)height;
    uint64_t state = test_seed(1);
    size_t fibonacci[24] = {1, 1}, sum = 0, symbol = 0, left = 0;
    for (int i = 2; i < 24; ++i) {
        fibonacci[i] = fibonacci[i - 1] + fibonacci[i - 2];
    }
    for (size_t i = 0; i < size && kind < 4; ++i) {
        uint8_t noise = (uint8_t)test_random32(&state);
        if (left == 0) {
            symbol = (symbol + 1) % 24;
            left = fibonacci[symbol];
        }
        --left;
        uint8_t above = i >= stride ? image.pixels[i - stride] : 0;
        uint8_t rare = (uint8_t)(symbol + (i % 5 == 0 ? 100 * (i % 2) : 0));
        image.pixels[i] = (uint8_t)(above + (kind == 0   ? noise
                                             : kind == 1 ? (i % 4000 == 0)
                                             : kind == 2 ? 0
                                                         : rare));
        sum += image.pixels[i];
    }
    CHECK(size < 1000 || kind == 2 || kind == 4 || sum > 0, "an empty picture");
    return image;
}

/* Sizes on both sides of every change in the number of bands, every kind of content, and the same
 * file from any number of threads. */
static void test_bands(void) {
    enum { BAND = 1 << 17 };
    static const int widths[] = {1, 2, 5, 341, 10922, 16384};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; ++w) {
        for (int channels = 3; channels <= 4; ++channels) {
            int row = widths[w] * channels + 1, most = row < 64 ? 8192 : 3 * BAND / row + 2;
            for (int height = 1; height <= most; height += height < 20 ? 1 : most / 9 + 1) {
                int near = BAND / row + height % 3 - 1; /* a band less one row, full, and more */
                int chosen = height % 2 && near > 0 && near <= 16384 ? near : height;
                burnish_image image = make_kind(widths[w], chosen, channels, height % 5);
                uint8_t *bytes, *again;
                size_t size, again_size;
                CHECK_STATUS(encode(&image, 1, &bytes, &size, NULL), BURNISH_STATUS_OK);
                check_decoded(&image, bytes, size);
                for (int threads = 2; threads <= 7; threads += 5) {
                    CHECK_STATUS(encode(&image, threads, &again, &again_size, NULL),
                                 BURNISH_STATUS_OK);
                    CHECK(size == again_size && memcmp(bytes, again, size) == 0,
                          "%d x %d: %d threads make another file", widths[w], chosen, threads);
                    burnish_release(NULL, again);
                }
                burnish_release(NULL, bytes);
                burnish_image_destroy(&image);
            }
        }
    }
}

/* Signature and chunks, byte by byte up to the image data; libpng checks the CRC of the header. */
static void test_chunks(void) {
    static const uint8_t start[] = {137, 'P', 'N', 'G', 13,  10, 26,   10,   0,    0,   0, 13,
                                    'I', 'H', 'D', 'R', 0,   0,  1,    2,    0,    0,   0, 3,
                                    8,   6,   0,   0,   0,   0,  0,    0,    0,    0,   0, 0,
                                    1,   's', 'R', 'G', 'B', 0,  0xAE, 0xCE, 0x1C, 0xE9};
    static const uint8_t end[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
    burnish_image image = make(258, 3, 4);
    uint8_t *bytes;
    size_t size;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, NULL), BURNISH_STATUS_OK);
    CHECK(memcmp(bytes, start, 29) == 0, "IHDR");
    CHECK(memcmp(bytes + 33, start + 33, sizeof start - 33) == 0, "sRGB");
    CHECK(memcmp(bytes + sizeof start, "\0\0\0\x10tEXtSoftware\0burnish", 24) == 0, "tEXt");
    CHECK(memcmp(bytes + sizeof start + 12 + 16 + 4, "IDAT", 4) == 0, "IDAT");
    CHECK(memcmp(bytes + size - sizeof end, end, sizeof end) == 0, "IEND");
    burnish_release(NULL, bytes);
    burnish_image_destroy(&image);
    burnish_error error;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "PNG: the image is empty; create or render it first");
    CHECK(!bytes && size == 0, "no bytes on error");
}

/* Rows apart and channels in another order make the same file and hash. */
static void test_views(void) {
    enum { WIDTH = 2100, HEIGHT = 70, GAP = 13 };
    burnish_image image = make_kind(WIDTH, HEIGHT, 4, 3);
    const size_t row = WIDTH * 4;
    uint8_t *apart = calloc(HEIGHT, row + GAP), *bytes, *again;
    size_t size, again_size;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, NULL), BURNISH_STATUS_OK);
    for (int format = BURNISH_PIXELS_RGBA8; apart && format <= BURNISH_PIXELS_BGRA8; ++format) {
        const size_t red = format == BURNISH_PIXELS_BGRA8 ? 2 : 0;
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; ++i) {
            const uint8_t *from = image.pixels + 4 * i;
            uint8_t *to = apart + i / WIDTH * (row + GAP) + i % WIDTH * 4;
            to[red] = from[0], to[1] = from[1], to[2 - red] = from[2], to[3] = from[3];
        }
        const burnish_pixels view = {WIDTH, HEIGHT, (burnish_pixel_format)format, row + GAP, apart};
        CHECK(burnish_pixels_hash(&view) == burnish_image_hash(&image), "format %d: hash", format);
        CHECK_STATUS(burnish_png_encode(&view, NULL, &again, &again_size, NULL), BURNISH_STATUS_OK);
        CHECK(size == again_size && memcmp(bytes, again, size) == 0, "format %d: file", format);
        burnish_release(NULL, again);
    }
    burnish_release(NULL, bytes);
    free(apart);
    burnish_image_destroy(&image);
}

static void test_bad_views(void) {
    uint8_t pixel[4] = {0}, *bytes;
    size_t size;
    burnish_error error;
    static const struct {
        int width, height;
        burnish_pixel_format format;
        size_t stride;
        const char *text;
    } CASES[] = {{0, 1, BURNISH_PIXELS_RGB8, 3,
                  "PNG: a size of 0 x 1 pixels; width and height must be 1 to 16384"},
                 {1, 16385, BURNISH_PIXELS_RGB8, 3,
                  "PNG: a size of 1 x 16385 pixels; width and height must be 1 to 16384"},
                 {1, 1, BURNISH_PIXELS_RGBA8, 3, "PNG: a stride of 3 bytes; a row has 4"},
                 {1, 1, BURNISH_PIXELS_RGBA_FLOAT, 4,
                  "PNG: 3 is not a pixel format; expected RGB8, RGBA8, BGRA8, GRAY16 or RGB16"}};
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
        const burnish_pixels view = {CASES[i].width, CASES[i].height, CASES[i].format,
                                     CASES[i].stride, pixel};
        CHECK_STATUS(burnish_png_encode(&view, NULL, &bytes, &size, &error),
                     BURNISH_STATUS_ARGUMENT);
        CHECK_TEXT(error.text, CASES[i].text);
    }
    const burnish_pixels view = {1, 1, BURNISH_PIXELS_RGB8, 3, pixel};
    const burnish_png_options unset = {0};
    CHECK_STATUS(burnish_png_encode(&view, &unset, &bytes, &size, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text,
               "PNG options: not initialised; start from burnish_png_options_default()");
}

/* What libpng finds before the pixels, or with `rows` also there. */
typedef struct opened_png {
    FILE *file;
    png_structp png;
    png_infop info;
} opened_png;

static opened_png open_png(uint8_t *bytes, size_t size, int rows) {
    opened_png p = {fmemopen(bytes, size, "rb"),
                    png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL), NULL};
    p.info = png_create_info_struct(p.png);
    png_init_io(p.png, p.file);
    if (rows) {
        png_read_png(p.png, p.info, PNG_TRANSFORM_IDENTITY, NULL);
    } else {
        png_read_info(p.png, p.info);
    }
    return p;
}

static void close_png(opened_png *p) {
    png_destroy_read_struct(&p->png, &p->info, NULL);
    fclose(p->file);
}

/* Numbers of 16 bits come back as they were, several bands of them, and no sRGB says they are
 * colours. */
static void test_16_bits(void) {
    enum { WIDTH = 401, HEIGHT = 233, GAP = 6 };
    for (int channels = 1; channels <= 3; channels += 2) {
        const size_t stride = WIDTH * 2 * (size_t)channels + GAP, row = WIDTH * (size_t)channels;
        uint8_t *rows = calloc(HEIGHT, stride), *bytes;
        uint64_t state = test_seed((unsigned)channels);
        size_t size;
        for (size_t i = 0; rows && i < HEIGHT * row; ++i) {
            const uint16_t value = (uint16_t)(i % 3 ? i * 7 : test_random32(&state));
            memcpy(rows + i / row * stride + 2 * (i % row), &value, sizeof value);
        }
        const burnish_pixels view = {WIDTH, HEIGHT,
                                     channels == 1 ? BURNISH_PIXELS_GRAY16 : BURNISH_PIXELS_RGB16,
                                     stride, rows};
        CHECK_STATUS(burnish_png_encode(&view, NULL, &bytes, &size, NULL), BURNISH_STATUS_OK);
        opened_png p = open_png(bytes, size, 1);
        CHECK(png_get_bit_depth(p.png, p.info) == 16 &&
                  png_get_channels(p.png, p.info) == channels &&
                  png_get_image_width(p.png, p.info) == WIDTH &&
                  png_get_image_height(p.png, p.info) == HEIGHT,
              "%d channels: not the header", channels);
        CHECK(!png_get_valid(p.png, p.info, PNG_INFO_sRGB), "16 bits are no sRGB colours");
        uint8_t *const *read = png_get_rows(p.png, p.info);
        int wrong = 0;
        for (size_t i = 0; i < HEIGHT * row; ++i) {
            uint16_t value;
            memcpy(&value, rows + i / row * stride + 2 * (i % row), sizeof value);
            const uint8_t *big = read[i / row] + 2 * (i % row);
            wrong += (big[0] << 8 | big[1]) != value;
        }
        CHECK(wrong == 0, "%d channels: %d of the values differ", channels, wrong);
        close_png(&p);
        burnish_release(NULL, bytes);
        free(rows);
    }
}

/* pHYs as libpng reads it: dots per metre, the nearest whole number; no sRGB in data. */
static void test_density(void) {
    static const struct {
        double dots_per_inch;
        unsigned per_metre;
    } CASES[] = {{0, 0}, {1, 39}, {72, 2835}, {300, 11811}, {96.5, 3799}, {1e6, 39370079}};
    burnish_image image = make(5, 4, 3);
    const burnish_pixels pixels = burnish_image_get_pixels(&image);
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
        burnish_png_options options = burnish_png_options_default();
        uint8_t *bytes;
        size_t size;
        options.dots_per_inch = CASES[i].dots_per_inch;
        options.is_data = (int)i % 2;
        CHECK_STATUS(burnish_png_encode(&pixels, &options, &bytes, &size, NULL), BURNISH_STATUS_OK);
        opened_png p = open_png(bytes, size, 0);
        const unsigned x = (unsigned)png_get_x_pixels_per_meter(p.png, p.info);
        const unsigned y = (unsigned)png_get_y_pixels_per_meter(p.png, p.info);
        CHECK(x == CASES[i].per_metre && y == x, "%g dots per inch: %u and %u per metre",
              CASES[i].dots_per_inch, x, y);
        CHECK((png_get_valid(p.png, p.info, PNG_INFO_sRGB) == 0) == options.is_data, "sRGB or not");
        close_png(&p);
        burnish_release(NULL, bytes);
    }
    static const double wrong[] = {0.5, -1, 1e7, 0.0 / 0.0};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        burnish_png_options options = burnish_png_options_default();
        burnish_error error;
        uint8_t *bytes;
        size_t size;
        options.dots_per_inch = wrong[i];
        CHECK_STATUS(burnish_png_encode(&pixels, &options, &bytes, &size, &error),
                     BURNISH_STATUS_ARGUMENT);
        CHECK(strstr(error.text, "dots per inch; expected 1 to 1e6"), "%s", error.text);
    }
    burnish_image_destroy(&image);
}

/* Every allocation goes through the context, and any of them may fail. */
static burnish_status encode_again(const burnish_context *context, const void *data, uint64_t *hash,
                                   burnish_error *error) {
    const burnish_pixels pixels = burnish_image_get_pixels(data);
    burnish_png_options options = burnish_png_options_default();
    uint8_t *bytes;
    size_t size;
    options.threads = 1;
    options.context = context;
    const burnish_status status = burnish_png_encode(&pixels, &options, &bytes, &size, error);
    CHECK1((status == BURNISH_STATUS_OK) == (bytes != NULL));
    *hash = test_add_hash(0, bytes, size);
    burnish_release(context, bytes);
    return status;
}

static void test_context(void) {
    burnish_image image = make_kind(600, 400, 3, 1);
    int cancelled;
    const int failed = check_stops(encode_again, &image, &cancelled);
    CHECK(failed > 5 && cancelled > 0, "%d failures, cancelled %d times", failed, cancelled);
    burnish_image_destroy(&image);
}

enum { HEAD = 64 }; /* before what is allocated: its size */

/* Memory at an address that is another one each time. */
static void *placed_allocate(void *user_data, size_t size, size_t alignment) {
    uint64_t *state = user_data;
    const uint64_t place = (test_random32(state) % 0x50000000) << 16;
    (void)alignment; /* 64 at most */
    size_t *head = mmap((void *)(uintptr_t)(place + 0x100000000), size + HEAD,
                        PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (head == MAP_FAILED) {
        return NULL;
    }
    *head = size + HEAD;
    return (uint8_t *)head + HEAD;
}

static void placed_release(void *user_data, void *memory) {
    size_t *head = (size_t *)((uint8_t *)memory - HEAD);
    (void)user_data;
    munmap(head, *head);
}

/* The file's bytes don't depend on where its memory lies. --places N: at fewer places. */
static void test_places(int count) {
    uint64_t state = test_seed(1);
    burnish_context *context;
    burnish_context_options wanted = burnish_context_options_default();
    wanted.allocator = (burnish_allocator){placed_allocate, placed_release, &state};
    burnish_png_options options = burnish_png_options_default();
    options.threads = 1;
    CHECK_STATUS(burnish_context_create(&wanted, &context, NULL), BURNISH_STATUS_OK);
    options.context = context;
    uint8_t *first = NULL;
    size_t first_size = 0;
    int others = 0;
    burnish_image image = make(32, 16, 3);
    memset(image.pixels, 200, (size_t)32 * 16 * 3);
    const burnish_pixels pixels = burnish_image_get_pixels(&image);
    for (int i = 0; i < count; ++i) {
        uint8_t *bytes;
        size_t size;
        CHECK_STATUS(burnish_png_encode(&pixels, &options, &bytes, &size, NULL), BURNISH_STATUS_OK);
        if (!first) {
            first = bytes, first_size = size;
            continue;
        }
        others += size != first_size || memcmp(bytes, first, size) != 0;
        burnish_release(options.context, bytes);
    }
    CHECK(others == 0, "%d of %d files are others", others, count);
    burnish_release(options.context, first);
    burnish_image_destroy(&image);
    burnish_context_destroy(context);
}

#define PATH TEST_BINARY_DIR "/test_png.png"

/* An image's file, and that of a view with a stride and options, is what burnish_png_encode gives. */
static void check_written(const burnish_pixels *pixels, const burnish_png_options *options) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    uint8_t *bytes = NULL, found[8000];
    size_t size = 0;
    CHECK_OK(burnish_png_encode(pixels, options, &bytes, &size, &error), error);
    FILE *file = fopen(PATH, "rb");
    if (CHECK(file != NULL, "no file")) {
        CHECK(fread(found, 1, sizeof found, file) == size && memcmp(found, bytes, size) == 0,
              "another file");
        fclose(file);
    }
    unlink(PATH);
    burnish_release(NULL, bytes);
}

static void test_write(void) {
    burnish_image image = make(40, 30, 4), empty = {0};
    const burnish_pixels whole = burnish_image_get_pixels(&image),
                         view = {20, 11, BURNISH_PIXELS_RGBA8, 4 * 40, pixel_at(&image, 3, 5)};
    burnish_png_options options = burnish_png_options_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    CHECK_OK(burnish_image_write_png(&image, PATH, &error), error);
    check_written(&whole, NULL);
    options.dots_per_inch = 300;
    CHECK_OK(burnish_png_write(&view, PATH, &options, &error), error);
    check_written(&view, &options);
    CHECK1(burnish_image_write_png(&empty, PATH, NULL) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_png_write(NULL, PATH, &options, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_png_write(&view, TEST_BINARY_DIR "/none/a.png", &options, &error) ==
           BURNISH_STATUS_WRITE);
    CHECK(access(PATH, F_OK) != 0, "a file after an error");
    burnish_image_destroy(&image);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--places");
    RUN(test_bands());
    RUN(test_chunks());
    RUN(test_views());
    RUN(test_16_bits());
    RUN(test_density());
    RUN(test_bad_views());
    RUN(test_context());
    RUN(test_places(test_option() ? atoi(test_option()) : 6000));
    RUN(test_write());
    return test_end("png");
}
