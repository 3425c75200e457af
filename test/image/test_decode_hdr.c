/* Images of floats. Radiance HDR: pixels and runs by hand, every way round, and damaged files.
 * OpenEXR: channels of every type and place, in blocks of every shape. */
#include <math.h>

#include "image/decode/decode.h"
#include "support.h"

enum { PIXELS_MAX = 64 };

typedef struct decoded {
    int width, height, count, pixel_bytes;
    float rgb[PIXELS_MAX][3];
} decoded;

static burnish_status begin(void *context, uint64_t width, uint64_t height, uint64_t pixel_bytes) {
    decoded *d = context;
    *d = (decoded){.width = (int)width, .height = (int)height, .pixel_bytes = (int)pixel_bytes};
    return BURNISH_STATUS_OK;
}

static void add(void *context, int x, int y, const float rgb[3]) {
    decoded *d = context;
    if (CHECK1(x >= 0 && x < d->width && y >= 0 && y < d->height) &&
        y * d->width + x < PIXELS_MAX) {
        memcpy(d->rgb[y * d->width + x], rgb, sizeof d->rgb[0]);
        ++d->count;
    }
}

static burnish_error error;

static char logged[480];

static void take_log(void *user_data, const char *line) {
    (void)user_data;
    snprintf(logged, sizeof logged, "%s", line);
}

static burnish_status decode_bytes(const burnish_context *context, const uint8_t *bytes,
                                   size_t size, decoded *d) {
    burnish_memory memory = burnish_memory_of(context, &error);
    const burnish_float_sink sink = {begin, add, d};
    const burnish_encoded from = {
        .bytes = bytes, .size = size, .name = "x", .max_side = 32768, .max_pixels = 1 << 27};
    error.text[0] = 0;
    const burnish_status status = burnish_decode_floats(&from, &memory, &sink);
    CHECK1((status == BURNISH_STATUS_OK) == !error.text[0]);
    return status;
}

static burnish_status decode(const char *header, const void *pixels, size_t size, decoded *d) {
    uint8_t bytes[1024];
    const size_t head = strlen(header);
    memcpy(bytes, header, head);
    memcpy(bytes + head, pixels, size);
    return decode_bytes(NULL, bytes, head + size, d);
}

#define HEAD "#?RADIANCE\nSOFTWARE=by hand\nFORMAT=32-bit_rle_rgbe\n"

static void check_pixel(const decoded *d, int i, float r, float g, float b) {
    CHECK(d->rgb[i][0] == r && d->rgb[i][1] == g && d->rgb[i][2] == b, "%d: %g %g %g", i,
          (double)d->rgb[i][0], (double)d->rgb[i][1], (double)d->rgb[i][2]);
}

static void test_plain(void) {
    static const uint8_t pixels[] = {128, 64, 32, 129, 255, 0, 1, 0, 1, 2, 3, 255};
    decoded d;
    CHECK1(decode(HEAD "\n-Y 1 +X 3\n", pixels, sizeof pixels, &d) == BURNISH_STATUS_OK);
    check_pixel(&d, 0, 1, 0.5f, 0.25f);
    check_pixel(&d, 1, 0, 0, 0);
    check_pixel(&d, 2, 0x1p119f, 0x1p120f, 0x1.8p120f);
    CHECK1(decode(HEAD "EXPOSURE=2\nEXPOSURE= 4.0e0\nCOLORCORR=1 .5 1e-1\r\n\n-Y 1 +X 3\n", pixels,
                  sizeof pixels, &d) == BURNISH_STATUS_OK);
    check_pixel(&d, 0, 0.125f, 0.125f, 0.3125f);
}

/* The first scan line of each file has columns 1 to 3 of the image, the second line 4 to 6. */
static void test_orientations(void) {
    static const uint8_t pixels[] = {1, 0, 0, 136, 2, 0, 0, 136, 3, 0, 0, 136,
                                     4, 0, 0, 136, 5, 0, 0, 136, 6, 0, 0, 136};
    static const struct {
        const char *size;
        int width;
        float red[6];
    } ways[] = {{"-Y 2 +X 3", 3, {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", 3, {3, 2, 1, 6, 5, 4}},
                {"+Y 2 +X 3", 3, {4, 5, 6, 1, 2, 3}}, {"+Y 2 -X 3", 3, {6, 5, 4, 3, 2, 1}},
                {"+X 2 -Y 3", 2, {1, 4, 2, 5, 3, 6}}, {"-X 2 -Y 3", 2, {4, 1, 5, 2, 6, 3}},
                {"+X 2 +Y 3", 2, {3, 6, 2, 5, 1, 4}}, {"-X 2 +Y 3", 2, {6, 3, 5, 2, 4, 1}}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i) {
        char header[128];
        decoded d;
        snprintf(header, sizeof header, HEAD "\n%s\n", ways[i].size);
        CHECK1(decode(header, pixels, sizeof pixels, &d) == BURNISH_STATUS_OK);
        CHECK1(d.count == 6 && d.width == ways[i].width);
        for (int k = 0; k < 6; ++k) {
            CHECK(d.rgb[k][0] == ways[i].red[k], "%s: %d", ways[i].size, k);
        }
    }
}

static const uint8_t new_runs[] = {2,       2,   0, 9,             /* 9 pixels */
                                   137,     7,                     /* red: a run */
                                   4,       1,   2, 3,  4, 133, 5, /* green: 4, a run of 5 */
                                   9,       0,   1, 2,  3, 4,   5, 6, 7, 8, /* blue */
                                   128 + 8, 136, 1, 137};                   /* exponents */
static const uint8_t old_runs[] = {7, 1, 0, 136, 1, 1, 1, 2,                /* two more */
                                   9, 1, 0, 136, 1, 1, 1, 1, 1, 1, 1, 1};   /* 1 + 256 more */

static void test_runs(void) {
    decoded d;
    CHECK1(decode(HEAD "\n-Y 1 +X 9\n", new_runs, sizeof new_runs, &d) == BURNISH_STATUS_OK);
    check_pixel(&d, 0, 7, 1, 0);
    check_pixel(&d, 4, 7, 5, 4);
    check_pixel(&d, 8, 14, 10, 16);
    CHECK1(decode(HEAD "\n-Y 1 +X 261\n", old_runs, sizeof old_runs, &d) == BURNISH_STATUS_OK);
    check_pixel(&d, 2, 7, 1, 0);
    check_pixel(&d, 3, 9, 1, 0);
    check_pixel(&d, 40, 9, 1, 0);
}

/* Every file that ends early is truncated. */
static void test_damage(void) {
    decoded d;
    for (size_t size = 0; size < sizeof new_runs; ++size) {
        CHECK1(decode(HEAD "\n-Y 1 +X 9\n", new_runs, size, &d) == BURNISH_STATUS_FORMAT);
    }
    CHECK_TEXT(error.text, "x: scan line 1 of 1 is damaged, or the file is truncated");
}

static void test_errors(void) {
    static const struct {
        const char *header;
        burnish_status status;
        const char *part;
    } files[] = {
        {"#?RADIANCE\nEXPOSURE=1", BURNISH_STATUS_FORMAT, "the header has no end"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n1234", BURNISH_STATUS_FORMAT,
         "only the format 32-bit_rle_rgbe"},
        {"#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n1234", BURNISH_STATUS_FORMAT, "positive numbers"},
        {"#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\n1234", BURNISH_STATUS_FORMAT, "positive numbers"},
        {"#?RADIANCE\nEXPOSURE=1e99999\n\n-Y 1 +X 1\n1234", BURNISH_STATUS_FORMAT,
         "positive numbers"},
        {HEAD "\n-Y 1 -Y 1\n1234", BURNISH_STATUS_FORMAT, "no line such as"},
        {HEAD "\n-Z 1 +X 1\n1234", BURNISH_STATUS_FORMAT, "no line such as"},
        {HEAD "\n-Y 0 +X 1\n1234", BURNISH_STATUS_FORMAT, "0 pixels"},
        {HEAD "\n-Y 40000 +X 1\n1234", BURNISH_STATUS_LIMIT, "1 x 40000 pixels"},
        {HEAD "\n-Y 99999999999999999999 +X 1\n1234", BURNISH_STATUS_LIMIT, "1000000000 pixels"},
        {HEAD "\n-Y 30000 +X 30000\n1234", BURNISH_STATUS_LIMIT, "30000 x 30000"},
        {HEAD "\n-Y 1 +X 2\n\1\1\1\1"
              "1234",
         BURNISH_STATUS_FORMAT, "damaged"},
        {"P6 1 1 255\n123", BURNISH_STATUS_FORMAT, "neither Radiance HDR nor EXR"},
    };
    decoded d;
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        const burnish_status status = decode(files[i].header, "", 0, &d);
        CHECK(status == files[i].status && strstr(error.text, files[i].part), "%zu: %s", i,
              error.text);
    }
}

/* Whether this build has OpenEXR. */
static int reads_exr(void) {
    decoded d;
    CHECK1(decode("\x76\x2f\x31\x01\x02", "", 0, &d) != BURNISH_STATUS_OK);
    CHECK1(strstr(error.text, "EXR"));
    return !strstr(error.text, "built without OpenEXR");
}

/* ---- OpenEXR ---- */

enum { HALF = 1, FLOAT = 2, UINT = 0, WIDE = 6, HIGH = 4 };
enum { RAW = 0, ZIP = 3 }; /* ZIP blocks that would not become smaller are raw, too */
enum { IS_TILED = 0x200, IS_DEEP = 0x800, IS_MULTIPART = 0x1000 };

typedef struct channel {
    const char *name;
    int type, sampling;
    double values[2]; /* at x = y = 0, and how much a pixel to the right and two down add */
} channel;

typedef struct file {
    size_t size;
    uint8_t bytes[8192];
} file;

static void put(file *f, const void *bytes, size_t size) {
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

static void put32(file *f, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        f->bytes[f->size++] = (uint8_t)(value >> 8 * i);
    }
}

static void put_attribute(file *f, const char *name, const char *type, const void *bytes,
                          size_t size) {
    put(f, name, strlen(name) + 1);
    put(f, type, strlen(type) + 1);
    put32(f, (uint32_t)size);
    put(f, bytes, size);
}

static void put_header(file *f, const channel *list, int count, int compression, int flags) {
    const char *type = flags & IS_DEEP    ? "deepscanline"
                       : flags & IS_TILED ? "tiledimage"
                                          : "scanlineimage";
    file channels = {0}, window = {0}, numbers = {0};
    for (int i = 0; i < count; ++i) {
        put(&channels, list[i].name, strlen(list[i].name) + 1);
        put32(&channels, (uint32_t)list[i].type);
        put32(&channels, 0);
        put32(&channels, (uint32_t)list[i].sampling);
        put32(&channels, (uint32_t)list[i].sampling);
    }
    put(&channels, "", 1);
    put(&window, "\0\0\0\0\0\0\0\0\5\0\0\0\3\0\0\0", 16);
    put32(&numbers, 4); /* tiles of 4 x 4 */
    put32(&numbers, 4);
    put32(&numbers, 0);                          /* of one level */
    put32(&numbers, flags & IS_DEEP ? HIGH : 1); /* chunks */
    put_attribute(f, "channels", "chlist", channels.bytes, channels.size);
    put_attribute(f, "compression", "compression", &(uint8_t){(uint8_t)compression}, 1);
    put_attribute(f, "dataWindow", "box2i", window.bytes, window.size);
    put_attribute(f, "displayWindow", "box2i", window.bytes, window.size);
    put_attribute(f, "lineOrder", "lineOrder", "", 1);
    put_attribute(f, "pixelAspectRatio", "float", "\0\0\x80\x3f", 4);
    put_attribute(f, "screenWindowCenter", "v2f", "\0\0\0\0\0\0\0", 8);
    put_attribute(f, "screenWindowWidth", "float", "\0\0\x80\x3f", 4);
    if (flags & IS_TILED) {
        put_attribute(f, "tiles", "tiledesc", numbers.bytes, 9);
    }
    if (flags & (IS_MULTIPART | IS_DEEP)) {
        put_attribute(f, "name", "string", list[0].name, strlen(list[0].name));
        put_attribute(f, "type", "string", type, strlen(type));
        put_attribute(f, "chunkCount", "int", numbers.bytes + 12, 4);
        put_attribute(f, "version", "int", "\1\0\0", 4);
    }
    put(f, "", 1);
}

static double value_at(const channel *c, int x, int y) {
    return c->values[0] + c->values[1] * (x + 2 * y);
}

/* Whole numbers and multiples of a quarter below 1024 are exact in each type that can have them. */
static void put_sample(file *f, int type, double value) {
    const float single = (float)value;
    uint32_t bits;
    int exponent;
    memcpy(&bits, &single, sizeof bits);
    if (type == HALF) {
        const int mantissa = (int)(frexp(fabs(value), &exponent) * 2048);
        bits = mantissa ? (uint32_t)((exponent + 14) << 10 | (mantissa & 1023)) : 0;
        bits |= value < 0 ? 0x8000U : 0;
        put(f, (uint8_t[]){(uint8_t)bits, (uint8_t)(bits >> 8)}, 2);
    } else {
        put32(f, type == FLOAT ? bits : (uint32_t)value);
    }
}

/* The pixels of a box: x, y, width and height. */
static void put_chunk(file *f, const channel *list, int count, const int box[4], int flags) {
    size_t at;
    if (flags & IS_MULTIPART) {
        put32(f, 1);
    }
    if (flags & IS_TILED) {
        put32(f, (uint32_t)box[0] / 4);
    }
    put32(f, (uint32_t)box[1] / (flags & IS_TILED ? 4 : 1));
    if (flags & IS_TILED) {
        put(f, "\0\0\0\0\0\0\0", 8); /* level */
    }
    at = f->size;
    put32(f, 0);
    for (int y = box[1]; y < box[1] + box[3]; ++y) {
        for (int i = 0; i < count; ++i) {
            for (int x = box[0]; x < box[0] + box[2]; ++x) {
                if (x % list[i].sampling == 0 && y % list[i].sampling == 0) {
                    put_sample(f, list[i].type, value_at(&list[i], x, y));
                }
            }
        }
    }
    const size_t end = f->size;
    f->size = at;
    put32(f, (uint32_t)(end - at - 4));
    f->size = end;
}

/* WIDE x HIGH pixels. A file in parts has one without colours before it. */
static void make_exr(file *f, const channel *list, int count, int compression, int flags) {
    static const channel depth = {"Z", HALF, 1, {0, 0}};
    const int width = flags & IS_TILED ? 4 : WIDE, height = compression || flags & IS_TILED ? 4 : 1;
    f->size = 0;
    put32(f, 20000630);
    put32(f, 2U | (uint32_t)flags);
    if (flags & IS_MULTIPART) {
        put_header(f, &depth, 1, ZIP, IS_MULTIPART);
    }
    put_header(f, list, count, compression, flags);
    if (flags & IS_MULTIPART) {
        put(f, "\0\0\0\0\0\0\0\0", 9); /* no more parts; the first one's chunk is nowhere */
    }
    size_t entry = f->size;
    f->size += 8 * (size_t)((WIDE + width - 1) / width * (HIGH / height));
    for (int y = 0; y < HIGH; y += height) {
        for (int x = 0; x < WIDE; x += width, entry += 8) {
            const size_t start = f->size;
            f->size = entry;
            put32(f, (uint32_t)start);
            put32(f, 0);
            f->size = start;
            put_chunk(f, list, count, (int[4]){x, y, WIDE - x < width ? WIDE - x : width, height},
                      flags);
        }
    }
}

static const struct {
    int compression, flags;
} shapes[] = {{RAW, 0}, {ZIP, 0}, {RAW, IS_TILED}, {ZIP, IS_TILED}, {ZIP, IS_MULTIPART}};

enum { SHAPES = sizeof shapes / sizeof *shapes };

/* Expects functions of the channels' values. */
static void check_exr(const channel *list, int count, int first_shape, int shape_count,
                      void (*expect)(int x, int y, double rgb[3])) {
    for (int s = first_shape; s < first_shape + shape_count; ++s) {
        static file f;
        decoded d;
        make_exr(&f, list, count, shapes[s].compression, shapes[s].flags);
        CHECK(decode_bytes(NULL, f.bytes, f.size, &d) == BURNISH_STATUS_OK, "shape %d: %s", s,
              error.text);
        CHECK(d.count == WIDE * HIGH && d.width == WIDE, "shape %d: %d pixels", s, d.count);
        for (int i = 0; i < WIDE * HIGH; ++i) {
            double rgb[3];
            expect(i % WIDE, i / WIDE, rgb);
            for (int k = 0; k < 3; ++k) {
                CHECK(fabs((double)d.rgb[i][k] - rgb[k]) < 1e-5, "%s..., shape %d: pixel %d: %g",
                      list[0].name, s, i, (double)d.rgb[i][k]);
            }
        }
    }
}

static const channel red = {"R", HALF, 1, {100, 1}}, green = {"G", HALF, 1, {200, 2}},
                     blue = {"B", HALF, 1, {300, 3}};

static void expect_colors(int x, int y, double rgb[3]) {
    rgb[0] = value_at(&red, x, y);
    rgb[1] = value_at(&green, x, y);
    rgb[2] = value_at(&blue, x, y);
}

/* Alpha, depth and a layer before, between and behind the colours, in every mixture of types. */
static void test_exr_channels(void) {
    for (int types = 0; types < 81; ++types) {
        channel list[7] = {{"A", 0, 1, {1, 0}},   blue, green,
                           {"L.G", 0, 1, {7, 1}}, red,  {"Z", 0, 1, {9, 1}}};
        for (int i = 0, left = types; i < 4; ++i, left /= 3) {
            list[1 << i >> 1].type = left % 3; /* 0, 1, 2, 4 */
        }
        list[3].type = types % 3;
        list[5].type = types / 27;
        check_exr(list, 6, 0, SHAPES, expect_colors);
        check_exr(list, 5, 0, SHAPES, expect_colors); /* without Z */
        check_exr(list + 1, 5, 0, SHAPES, expect_colors);
        list[3] = list[4];
        check_exr(list, 4, 0, SHAPES, expect_colors); /* A, B, G, R */
        list[4] = list[5];
        check_exr(list + 1, 4, 0, SHAPES, expect_colors); /* B, G, R, Z */
        check_exr(list + 1, 3, 0, SHAPES, expect_colors);
        list[4].sampling = 2;
        check_exr(list, 5, 0, 2, expect_colors);
    }
}

static const channel luminance = {"Y", HALF, 1, {100, 1}},
                     chroma[2] = {{"RY", HALF, 2, {0.25, 0.25}}, {"BY", HALF, 2, {0.5, -0.25}}};

static void expect_gray(int x, int y, double rgb[3]) {
    rgb[0] = rgb[1] = rgb[2] = value_at(&luminance, x, y);
}

static void expect_chroma(int x, int y, double rgb[3]) {
    const double all = value_at(&luminance, x, y);
    rgb[0] = all * (1 + value_at(&chroma[0], x & ~1, y & ~1));
    rgb[2] = all * (1 + value_at(&chroma[1], x & ~1, y & ~1));
    rgb[1] = (all - 0.2126 * rgb[0] - 0.0722 * rgb[2]) / 0.7152;
}

static void test_exr_luminance(void) {
    for (int type = 0; type < 3; ++type) {
        channel list[4] = {{"A", type, 1, {1, 0}}, luminance, {"Z", type, 1, {9, 1}}};
        check_exr(list, 2, 0, SHAPES, expect_gray);
        check_exr(list, 3, 0, SHAPES, expect_gray);
        list[1].type = type;
        check_exr(list + 1, 1, 0, SHAPES, expect_gray);
    }
    const channel colors[4] = {{"A", HALF, 1, {1, 0}}, chroma[1], chroma[0], luminance};
    check_exr(colors, 4, 0, 2, expect_chroma);
    check_exr(colors + 1, 3, 0, 2, expect_chroma);
    check_exr(colors + 2, 2, 0, 2, expect_gray); /* half of the chroma is none */
    const channel reduced[3] = {{"B", FLOAT, 1, {300, 3}}, {"G", HALF, 2, {200, 2}}, red};
    static file f;
    decoded d;
    make_exr(&f, reduced, 3, ZIP, 0);
    CHECK_OK(decode_bytes(NULL, f.bytes, f.size, &d), error);
    CHECK1(d.rgb[WIDE + 3][1] == 204 && d.rgb[WIDE + 3][2] == 315);
    CHECK(d.pixel_bytes == 8, "%d", d.pixel_bytes);
}

/* The bits of halves that are not ordinary numbers. */
static void test_exr_halves(void) {
    static const struct {
        uint8_t bits[2];
        float value;
    } cases[] = {{{1, 0}, 0x1p-24f},    {{0xff, 0x83}, -0x1.ff8p-15f}, {{0, 4}, 0x1p-14f},
                 {{0xff, 0x7b}, 65504}, {{0, 0xfc}, -INFINITY},        {{0, 0x80}, 0}};
    static file f;
    decoded d;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        make_exr(&f, &luminance, 1, ZIP, 0);
        memcpy(f.bytes + f.size - 2, cases[i].bits, 2);
        CHECK_OK(decode_bytes(NULL, f.bytes, f.size, &d), error);
        CHECK(d.rgb[WIDE * HIGH - 1][0] == cases[i].value, "%zu: %g", i,
              (double)d.rgb[WIDE * HIGH - 1][0]);
    }
    memcpy(f.bytes + f.size - 2, "\1\xfc", 2);
    CHECK1(decode_bytes(NULL, f.bytes, f.size, &d) == BURNISH_STATUS_OK);
    CHECK1(isnan(d.rgb[WIDE * HIGH - 1][0]));
}

static void test_exr_parts(void) {
    const channel list[4] = {{"A", HALF, 1, {1, 0}}, blue, green, red};
    burnish_context_options options = burnish_context_options_default();
    burnish_context *context;
    static file f;
    decoded d;
    options.log = take_log;
    CHECK1(burnish_context_create(&options, &context, NULL) == BURNISH_STATUS_OK);
    make_exr(&f, list, 4, ZIP, IS_MULTIPART);
    CHECK_OK(decode_bytes(context, f.bytes, f.size, &d), error);
    CHECK_TEXT(logged, "x: only part 2 of 2 is used");
    CHECK(d.pixel_bytes == 8, "%d", d.pixel_bytes);
    burnish_context_destroy(context);
    make_exr(&f, list, 4, RAW, IS_DEEP);
    CHECK1(decode_bytes(NULL, f.bytes, f.size, &d) == BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "x: deep images are not supported; convert it");
    make_exr(&f, list, 3, ZIP, IS_MULTIPART);
    CHECK1(decode_bytes(NULL, f.bytes, f.size, &d) == BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "x: neither channels R, G and B nor Y; convert it");
}

/* The library sorts attributes in quadratic time. */
static void test_exr_long_header(void) {
    enum { COMMENT = 1 << 20 };
    static uint8_t bytes[COMMENT + sizeof(file)];
    static file f, comment;
    decoded d;
    make_exr(&f, &luminance, 1, ZIP, 0);
    put_attribute(&comment, "comment", "string", "", 0);
    memcpy(bytes, f.bytes, 8);
    memcpy(bytes + 8, comment.bytes, comment.size);
    bytes[8 + comment.size - 4 + 2] = 0x10; /* COMMENT bytes */
    memcpy(bytes + 8 + comment.size + COMMENT, f.bytes + 8, f.size - 8);
    const size_t size = comment.size + COMMENT + f.size;
    CHECK1(decode_bytes(NULL, bytes, size, &d) == BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text, "x: headers of more than 512 KiB; convert it");
}

/* Every file that ends early is refused. */
static void test_exr_damage(void) {
    const channel list[4] = {{"A", HALF, 1, {1, 0}}, blue, green, red};
    static file f;
    decoded d;
    for (int s = 0; s < SHAPES; ++s) {
        make_exr(&f, list, 4, shapes[s].compression, shapes[s].flags);
        for (size_t size = 4; size < f.size; ++size) {
            CHECK(decode_bytes(NULL, f.bytes, size, &d) == BURNISH_STATUS_FORMAT, "%zu bytes",
                  size);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_plain());
    RUN(test_orientations());
    RUN(test_runs());
    RUN(test_damage());
    RUN(test_errors());
    if (reads_exr()) {
        RUN(test_exr_channels());
        RUN(test_exr_luminance());
        RUN(test_exr_halves());
        RUN(test_exr_parts());
        RUN(test_exr_long_header());
        RUN(test_exr_damage());
    }
    return test_end("decode_hdr");
}
