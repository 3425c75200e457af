/* Statistics of brightness and contrast. */
#include "render/output/result.h"

#include <math.h>
#include <string.h>

enum { NEAR = 5 }; /* steps of 255 that look the same */

#define LUMINANCE_ONE (10000.0 * 65535)

/* BT.709's weights of linear light as integers, whose sums do not depend on the order. */
typedef struct luminance_table {
    uint32_t channels[3][256];
} luminance_table;

static void fill_table(luminance_table *table) {
    static const uint32_t weights[3] = {2126, 7152, 722};
    for (int channel = 0; channel < 3; ++channel) {
        for (int code = 0; code < 256; ++code) {
            const double light = (double)burnish_srgb_decode((float)code / 255);
            table->channels[channel][code] = weights[channel] * (uint32_t)(65535 * light + 0.5);
        }
    }
}

static uint32_t luminance_of(const luminance_table *table, const uint8_t *pixel) {
    return table->channels[0][pixel[0]] + table->channels[1][pixel[1]] +
           table->channels[2][pixel[2]];
}

typedef struct tone_sums {
    uint64_t white, black, ground, luminance, count;
} tone_sums;

static int is_near(const uint8_t *pixel, const uint8_t *other) {
    int difference = 0;
    for (int k = 0; k < 3; ++k) {
        const int d = pixel[k] - other[k];
        difference |= (d < 0 ? -d : d) > NEAR;
    }
    return !difference;
}

/* The sums of one pixel. */
static tone_sums sums_of(const luminance_table *table, const uint8_t *ground,
                         const uint8_t *pixel) {
    static const uint8_t white[3] = {255, 255, 255}, black[3] = {0, 0, 0};
    return (tone_sums){(uint64_t)is_near(pixel, white), (uint64_t)is_near(pixel, black),
                       (uint64_t)is_near(pixel, ground), luminance_of(table, pixel), 1};
}

static void add_one(tone_sums *to, const tone_sums *one) {
    to->white += one->white;
    to->black += one->black;
    to->ground += one->ground;
    to->luminance += one->luminance;
    to->count += one->count;
}

/* Subtracts up to 0. */
static void subtract(uint64_t *from, uint64_t one, uint64_t times) {
    *from -= times * one < *from ? times * one : *from;
}

static void subtract_pixels(tone_sums *from, const tone_sums *one, uint64_t times) {
    subtract(&from->white, one->white, times);
    subtract(&from->black, one->black, times);
    subtract(&from->ground, one->ground, times);
    subtract(&from->luminance, one->luminance, times);
    subtract(&from->count, one->count, times);
}

/* (L + 0.05) / (M + 0.05), the larger one in the numerator. */
static double contrast_of(double a, double b) {
    const double x = a / LUMINANCE_ONE + 0.05, y = b / LUMINANCE_ONE + 0.05;
    return x > y ? x / y : y / x;
}

/* Without a ground empty pixels have the background's colour and are subtracted at the end, or their
 * alpha is 0; on a ground coverage identifies them. An environment has many colours: then
 * nothing is measured. */
render_tones render_measure_tones(const burnish_image *image, const uint8_t *coverage,
                                  uint64_t covered, uint64_t step,
                                  const burnish_render_options *options) {
    const size_t channels = (size_t)image->channels;
    const uint64_t all = (uint64_t)image->width * (uint64_t)image->height;
    const uint8_t *ground = options->background;
    const int has_ground = channels == 3;
    luminance_table table;
    tone_sums sums = {0};
    fill_table(&table);
    for (uint64_t i = 0; i < all; i += step) {
        const uint8_t *pixel = image->pixels + i * channels;
        if (coverage ? coverage[i] > 0 : has_ground || pixel[3] > 0) {
            const tone_sums one = sums_of(&table, ground, pixel);
            add_one(&sums, &one);
        }
    }
    const tone_sums empty = sums_of(&table, ground, ground);
    subtract_pixels(&sums, &empty, has_ground && !coverage ? (all - covered) / step : 0);
    const double count = (double)sums.count, none = (double)NAN;
    if (sums.count == 0 || options->background_environment) {
        return (render_tones){none, none, none, none};
    }
    return (render_tones){
        .near_white = (double)sums.white / count,
        .near_black = (double)sums.black / count,
        .like_ground = has_ground ? (double)sums.ground / count : none,
        .contrast = has_ground
                        ? contrast_of((double)sums.luminance / count, (double)empty.luminance)
                        : none,
    };
}

int render_has_one_color(const burnish_image *image) {
    const size_t channels = (size_t)image->channels;
    const size_t bytes = (size_t)image->width * (size_t)image->height * channels;
    /* every byte equals the one a pixel before */
    return memcmp(image->pixels, image->pixels + channels, bytes - channels) == 0;
}
