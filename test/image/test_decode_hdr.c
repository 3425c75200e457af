/* Radiance HDR: pixels and runs by hand, every way round, and damaged files. */
#include <math.h>

#include "image/decode/decode.h"
#include "support.h"

enum { PIXELS_MAX = 64 };

typedef struct decoded {
    int width, height, count;
    float rgb[PIXELS_MAX][3];
} decoded;

static burnish_status begin(void *context, uint64_t width, uint64_t height) {
    decoded *d = context;
    *d = (decoded){.width = (int)width, .height = (int)height};
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

static burnish_status decode(const char *header, const void *pixels, size_t size, decoded *d) {
    uint8_t bytes[1024];
    const size_t head = strlen(header);
    burnish_memory memory = burnish_memory_of(NULL, &error);
    const burnish_float_sink sink = {begin, add, d};
    memcpy(bytes, header, head);
    memcpy(bytes + head, pixels, size);
    const burnish_encoded from = {.bytes = bytes,
                                  .size = head + size,
                                  .name = "x.hdr",
                                  .max_side = 32768,
                                  .max_pixels = 1 << 27};
    error.text[0] = 0;
    const burnish_status status = burnish_decode_floats(&from, &memory, &sink);
    CHECK1((status == BURNISH_STATUS_OK) == !error.text[0]);
    return status;
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

/* Every file that ends early is truncated; no byte that is changed is read out of bounds. */
static void test_damage(void) {
    uint8_t pixels[sizeof new_runs];
    decoded d;
    for (size_t size = 0; size < sizeof new_runs; ++size) {
        CHECK1(decode(HEAD "\n-Y 1 +X 9\n", new_runs, size, &d) == BURNISH_STATUS_FORMAT);
    }
    CHECK_TEXT(error.text, "x.hdr: scan line 1 of 1 is damaged, or the file is truncated");
    for (int i = 0; i < 20000; ++i) {
        memcpy(pixels, new_runs, sizeof pixels);
        pixels[(size_t)rand() % sizeof pixels] = (uint8_t)rand();
        pixels[(size_t)rand() % sizeof pixels] = (uint8_t)rand();
        const burnish_status status = decode(HEAD "\n-Y 1 +X 9\n", pixels, sizeof pixels, &d);
        CHECK1(status == BURNISH_STATUS_OK || status == BURNISH_STATUS_FORMAT);
    }
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
    CHECK1(decode("\x76\x2f\x31\x01\x02", "", 0, &d) != BURNISH_STATUS_OK); /* by the build */
    CHECK1(strstr(error.text, "EXR"));
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_plain());
    RUN(test_orientations());
    RUN(test_runs());
    RUN(test_damage());
    RUN(test_errors());
    return test_end("decode_hdr");
}
