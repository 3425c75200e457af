/* Comparing pictures: closed forms, SSIM by its definition, FLIP by its authors' program. */
#include <math.h>

#include "burnish/compare.h"
#include "counting_context.h"
#include "images.h"

#define CHECK_NEAR(actual, expected, most)                                                         \
    CHECK(fabs((actual) - (expected)) <= (most), "got %.17g, expected %.17g", (double)(actual),    \
          (double)(expected))

/* Gradients, a disc and bars of many colours; `shift` moves them. */
static burnish_image make_scene(int width, int height, int shift) {
    burnish_image image = make_image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            uint8_t *rgb = pixel_at(&image, x, y);
            const int at = x + shift, dx = at - 24, dy = y - 20;
            const int disc = dx * dx + dy * dy < 200, bar = (at / 5 + y / 9) % 4;
            rgb[0] = (uint8_t)(disc ? 210 - 3 * y : 40 + 50 * bar);
            rgb[1] = (uint8_t)(disc ? 90 + 2 * x : 200 - 30 * bar);
            rgb[2] = (uint8_t)(disc ? 30 : 60 + x + y);
        }
    }
    return image;
}

static burnish_comparison compare(const burnish_image *a, const burnish_image *b,
                                  const burnish_compare_options *options) {
    const burnish_pixels pa = burnish_image_get_pixels(a), pb = burnish_image_get_pixels(b);
    burnish_comparison found;
    burnish_error error = {0};
    CHECK_OK(burnish_pixels_compare(&pa, &pb, options, &found, &error), error);
    return found;
}

static void test_flat(void) {
    static const int greys[][2] = {{100, 103}, {0, 255}, {255, 0}, {17, 18}, {200, 90}};
    for (size_t i = 0; i < sizeof greys / sizeof *greys; ++i) {
        const int a = greys[i][0], b = greys[i][1], d = abs(a - b);
        burnish_image first = make_filled(31, 75, 3, a);
        burnish_image second = make_filled(31, 75, 3, b);
        const burnish_comparison found = compare(&first, &second, NULL);
        const double c1 = 6.5025;
        CHECK1(found.different_pixels == 31 * 75 && found.largest[2] == d && found.largest[3] == 0);
        CHECK1(found.bounds[0] == 0 && found.bounds[1] == 0 && found.bounds[2] == 31 &&
               found.bounds[3] == 75);
        CHECK1(found.mean[0] == d && found.mean[3] == 0 && found.mean_squared_error == d * d);
        CHECK_NEAR(found.psnr, 20 * log10(255.0 / d), 1e-12);
        CHECK_NEAR(found.ssim, (2.0 * a * b + c1) / ((double)a * a + (double)b * b + c1), 1e-12);
        CHECK(isnan(found.silhouette_iou), "flat pictures have no object");
        burnish_image_destroy(&first);
        burnish_image_destroy(&second);
    }
}

/* Values of FLIP's authors' program (github.com/NVlabs/flip, C++, its mean summed in double
 * precision), for PNG files of the same pictures. */
static void test_flip(void) {
    static const struct {
        int width, height, shift;
        double value;
    } cases[] = {
        {64, 48, 0, 0}, {64, 48, 1, 0.198363}, {64, 48, 7, 0.617012}, {100, 130, 2, 0.369176}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_image a = make_scene(cases[i].width, cases[i].height, 0);
        burnish_image b = make_scene(cases[i].width, cases[i].height, cases[i].shift);
        CHECK_NEAR(compare(&a, &b, NULL).flip, cases[i].value, 1e-6);
        burnish_image_destroy(&a);
        burnish_image_destroy(&b);
    }
}

/* The map's mean is the value, and it is 0 far from a dot that differs. */
static void test_map(void) {
    static float map[90 * 140];
    burnish_compare_options options = burnish_compare_options_default();
    burnish_image a = make_image(90, 140, 3), b = make_image(90, 140, 3);
    double sum = 0;
    for (size_t i = 0; i < image_size(&a); ++i) {
        a.pixels[i] = b.pixels[i] = (uint8_t)(120 + 10 * (i % 3));
    }
    memset(b.pixels + 3 * (70 * 90 + 45), 255, 3);
    options.flip_map = map;
    const burnish_comparison found = compare(&a, &b, &options);
    for (int y = 0; y < 140; ++y) {
        for (int x = 0; x < 90; ++x) {
            const int away = abs(x - 45) > 10 || abs(y - 70) > 10;
            sum += map[90 * y + x];
            CHECK((map[90 * y + x] == 0) == away, "at %d, %d: %g", x, y, (double)map[90 * y + x]);
        }
    }
    CHECK_NEAR(found.flip, sum / (90 * 140), 1e-9);
    CHECK_NEAR((double)map[90 * 70 + 44], (double)map[90 * 70 + 46], 1e-6);
    CHECK_NEAR((double)map[90 * 69 + 45], (double)map[90 * 70 + 44], 1e-6);
    CHECK1(found.different_pixels == 1 && found.bounds[0] == 45 && found.bounds[1] == 70 &&
           found.bounds[2] == 46 && found.bounds[3] == 71);
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

/* SSIM as its paper has it: every window by itself. */
static double slow_ssim(const burnish_image *a, const burnish_image *b) {
    double weights[11][11], all = 0, sum = 0;
    for (int i = 0; i < 121; ++i) {
        const int x = i % 11 - 5, y = i / 11 - 5;
        all += weights[i / 11][i % 11] = exp(-(x * x + y * y) / 4.5);
    }
    for (int top = 0; top + 11 <= a->height; ++top) {
        for (int left = 0; left + 11 <= a->width; ++left) {
            double m[5] = {0};
            for (int i = 0; i < 121; ++i) {
                const size_t at = 3 * (size_t)((top + i / 11) * a->width + left + i % 11);
                const uint8_t *p = a->pixels + at, *q = b->pixels + at;
                const double u = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
                const double v = 0.299 * q[0] + 0.587 * q[1] + 0.114 * q[2];
                const double w = weights[i / 11][i % 11] / all,
                             terms[5] = {u, v, u * u, v * v, u * v};
                for (int k = 0; k < 5; ++k) {
                    m[k] += w * terms[k];
                }
            }
            sum += (2 * m[0] * m[1] + 6.5025) * (2 * (m[4] - m[0] * m[1]) + 58.5225) /
                   ((m[0] * m[0] + m[1] * m[1] + 6.5025) *
                    (m[2] - m[0] * m[0] + m[3] - m[1] * m[1] + 58.5225));
        }
    }
    return sum / ((a->width - 10) * (a->height - 10));
}

static void test_ssim(void) {
    static const int sizes[][2] = {{11, 11}, {12, 11}, {11, 70}, {37, 64},
                                   {20, 69}, {15, 74}, {15, 75}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        burnish_image a = make_scene(sizes[i][0], sizes[i][1], 0);
        burnish_image b = make_scene(sizes[i][0], sizes[i][1], 3);
        CHECK_NEAR(compare(&a, &b, NULL).ssim, slow_ssim(&a, &b), 1e-12);
        burnish_image_destroy(&a);
        burnish_image_destroy(&b);
    }
    burnish_image a = make_scene(10, 40, 0), b = make_scene(40, 10, 0);
    CHECK(isnan(compare(&a, &a, NULL).ssim), "a side below the window's");
    CHECK(isnan(compare(&b, &b, NULL).ssim), "a side below the window's");
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

/* A bar 10 wide that moves by 4: 2 * 4 columns differ; a tolerance of its contrast hides them. */
static void test_bars(void) {
    burnish_image a = make_filled(40, 100, 3, 200), b = make_filled(40, 100, 3, 200);
    burnish_compare_options options = burnish_compare_options_default();
    for (int y = 60; y < 90; ++y) {
        for (int x = 0; x < 10; ++x) {
            a.pixels[3 * (40 * y + 12 + x) + 1] = 150;
            b.pixels[3 * (40 * y + 16 + x) + 1] = 150;
        }
    }
    burnish_comparison found = compare(&a, &b, &options);
    CHECK1(found.different_pixels == 8 * 30 && found.largest[1] == 50 && found.largest[0] == 0);
    CHECK1(found.bounds[0] == 12 && found.bounds[1] == 60 && found.bounds[2] == 26 &&
           found.bounds[3] == 90);
    CHECK_NEAR(found.mean[1], 50.0 * 8 * 30 / 4000, 1e-15);
    CHECK_NEAR(found.silhouette_iou, 6.0 / 14, 1e-15);
    options.tolerance = 49;
    CHECK1(compare(&a, &b, &options).different_pixels == 8 * 30);
    options.tolerance = 50;
    found = compare(&a, &b, &options);
    CHECK1(found.different_pixels == 0 && found.bounds[2] == 0 && found.largest[1] == 50);
    options.metrics = 0;
    found = compare(&a, &b, &options);
    CHECK1(isnan(found.ssim) && isnan(found.flip) && found.mean_squared_error > 0);
    a.pixels[0] = 190; /* corners of two colours: no telling the ground */
    CHECK1(isnan(compare(&a, &b, &options).silhouette_iou));
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

/* Soft coverage, given and in alpha; and what lies under transparent pixels. */
static void test_alpha(void) {
    static const uint8_t one[4] = {255, 128, 0, 0}, two[4] = {255, 64, 10, 0};
    burnish_image a = make_image(2, 2, 4), b = make_image(2, 2, 4), plain = make_image(2, 2, 3);
    burnish_compare_options options = burnish_compare_options_default();
    for (int i = 0; i < 4; ++i) {
        memset(a.pixels + 4 * i, 40 * i, 3); /* different colours, which the last pixel hides */
        memset(b.pixels + 4 * i, i < 3 ? 40 * i : 7, 3);
        a.pixels[4 * i + 3] = one[i];
        b.pixels[4 * i + 3] = two[i];
        memset(plain.pixels + 3 * i,
               i == 0   ? 0
               : i == 1 ? (128 * 40 + 127 * 255 + 127) / 255
                        : 255,
               3);
    }
    burnish_comparison found = compare(&a, &b, NULL);
    CHECK_NEAR(found.silhouette_iou, (255.0 + 64) / (255 + 128 + 10), 1e-15);
    CHECK1(found.largest[3] == 64 && found.different_pixels == 2);
    found = compare(&a, &plain, NULL);
    CHECK1(found.largest[0] == 0 && found.largest[3] == 255);
    options.coverage[0] = one;
    options.coverage[1] = one;
    CHECK1(compare(&a, &plain, &options).silhouette_iou == 1);
    options.coverage[1] = NULL; /* colours tell no part of a pixel */
    burnish_image ground = make_filled(3, 3, 3, 9);
    static const uint8_t middle[9] = {0, 0, 0, 7, 200, 0, 0, 0, 0};
    ground.pixels[3 * 4] = 14;
    options.coverage[0] = middle;
    CHECK_NEAR(compare(&ground, &ground, &options).silhouette_iou, 0.5, 0);
    ground.pixels[3 * 4] = 13;
    CHECK_NEAR(compare(&ground, &ground, &options).silhouette_iou, 0, 0);
    burnish_image_destroy(&ground);
    options.coverage[0] = options.coverage[1] = one;
    options.background[0] = 0;
    CHECK1(compare(&a, &plain, &options).largest[0] == 255);
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
    burnish_image_destroy(&plain);
}

/* The same pixels in another order and with gaps between rows. */
static void test_formats(void) {
    burnish_image a = make_scene(33, 20, 0), b = make_image(41, 20, 4);
    burnish_comparison found;
    for (size_t i = 0; i < 33 * 20; ++i) {
        uint8_t *to = b.pixels + 4 * (i / 33 * 41 + i % 33);
        to[0] = a.pixels[3 * i + 2];
        to[1] = a.pixels[3 * i + 1];
        to[2] = a.pixels[3 * i];
        to[3] = 255;
    }
    const burnish_pixels first = burnish_image_get_pixels(&a),
                         second = {33, 20, BURNISH_PIXELS_BGRA8, 4 * 41, b.pixels};
    CHECK1(burnish_pixels_compare(&first, &second, NULL, &found, NULL) == BURNISH_STATUS_OK);
    CHECK1(found.pixels == 33 * 20 && found.different_pixels == 0 && found.largest[3] == 0);
    CHECK1(found.bounds[2] == 0 && found.bounds[3] == 0 && found.mean_squared_error == 0);
    CHECK1(isinf(found.psnr) && found.psnr > 0 && found.ssim == 1 && found.flip == 0);
    CHECK1(burnish_pixels_compare(&second, &first, NULL, &found, NULL) == BURNISH_STATUS_OK);
    CHECK1(found.different_pixels == 0 && found.mean_squared_error == 0);
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

static void test_threads(void) {
    burnish_image a = make_scene(90, 300, 0), b = make_scene(90, 300, 5);
    burnish_compare_options options = burnish_compare_options_default();
    burnish_comparison first = {0};
    for (int threads = 1; threads <= 7; threads += 3) {
        options.threads = threads;
        const burnish_comparison found = compare(&a, &b, &options);
        first = threads == 1 ? found : first;
        CHECK(memcmp(&found, &first, sizeof found) == 0, "%d threads", threads);
    }
    const unsigned before = control_bits();
    set_mode(1);
    const burnish_comparison found = compare(&a, &b, NULL);
    set_mode(0);
    CHECK(memcmp(&found, &first, sizeof found) == 0, "the caller's rounding changes it");
    CHECK1(control_bits() == before);
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

static burnish_status compare_again(const burnish_context *context, const void *data,
                                    uint64_t *hash, burnish_error *error) {
    const burnish_pixels pixels = burnish_image_get_pixels(data);
    burnish_compare_options options = burnish_compare_options_default();
    burnish_comparison found;
    options.context = context;
    const burnish_status status = burnish_pixels_compare(&pixels, &pixels, &options, &found, error);
    *hash = (uint64_t)found.pixels;
    return status;
}

static void test_context(void) {
    burnish_image a = make_scene(20, 200, 0);
    int cancelled;
    CHECK1(check_stops(compare_again, &a, &cancelled) == 2 && cancelled > 0);
    burnish_image_destroy(&a);
}

static void refuse(const burnish_pixels *a, const burnish_pixels *b,
                   const burnish_compare_options *options, const char *line) {
    burnish_comparison found;
    burnish_error error;
    CHECK1(burnish_pixels_compare(a, b, options, &found, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, line);
    CHECK1(found.pixels == 0);
}

static void test_errors(void) {
    burnish_image a = make_image(4, 4, 3), b = make_image(4, 5, 3);
    const burnish_pixels first = burnish_image_get_pixels(&a),
                         second = burnish_image_get_pixels(&b);
    burnish_pixels none = {0};
    burnish_compare_options options = {0};
    refuse(&first, &second, NULL,
           "compare: 4 x 4 and 4 x 5 pixels; pictures of one size are compared");
    refuse(&first, &first, &options,
           "compare options: not initialised; start from burnish_compare_options_default()");
    refuse(&none, &first, NULL,
           "compare: first picture: the image is empty; create or render it first");
    refuse(&first, NULL, NULL,
           "compare: second picture: the image is empty; create or render it first");
    const burnish_pixels deep = {2, 2, BURNISH_PIXELS_RGB16, 12, a.pixels};
    refuse(&deep, &deep, NULL, "compare: pictures of 16 bits; RGB8, RGBA8 and BGRA8 are compared");
    options = burnish_compare_options_default();
    options.tolerance = 256;
    refuse(&first, &first, &options,
           "compare options: a tolerance of 256; expected 0 to 255 codes");
    options.tolerance = 0;
    options.threads = -1;
    refuse(&first, &first, &options, "compare options: -1 threads; expected 0 to 1024");
    burnish_image_destroy(&a);
    burnish_image_destroy(&b);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_flat());
    RUN(test_flip());
    RUN(test_map());
    RUN(test_ssim());
    RUN(test_bars());
    RUN(test_alpha());
    RUN(test_formats());
    RUN(test_threads());
    RUN(test_context());
    RUN(test_errors());
    return test_end("compare");
}
