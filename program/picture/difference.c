#include "picture/difference.h"
#include "burnish/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void picture_difference_color(double difference, double end, uint8_t color[3]) {
    static const uint8_t inks[2][3][3] = {{{241, 243, 245}, {74, 159, 208}, {8, 54, 97}},
                                          {{241, 243, 245}, {240, 138, 60}, {122, 42, 0}}};
    const uint8_t(*ink)[3] = inks[difference > 0];
    double rest = 2 * fmin(fabs(difference) / end, 1);
    const int from = rest >= 1 ? 1 : 0;
    rest -= from;
    for (int k = 0; k < 3; ++k) {
        color[k] = (uint8_t)(ink[from][k] * (1 - rest) + ink[from + 1][k] * rest + 0.5);
    }
}

/* A code over white. */
static int code_at(const burnish_image *image, size_t pixel, int channel) {
    const uint8_t *codes = image->pixels + pixel * (size_t)image->channels;
    const int alpha = image->channels == 4 ? codes[3] : 255;
    return (alpha * codes[channel] + (255 - alpha) * 255 + 127) / 255;
}

burnish_status picture_subtract(const burnish_image *reference, const burnish_image *image,
                                double end, burnish_image *result, burnish_error *error) {
    const burnish_status status =
        burnish_image_create(NULL, result, image->width, image->height, image->channels, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t p = 0; p < pixels; ++p) {
        int extreme = 0;
        uint8_t *to = result->pixels + p * (size_t)result->channels;
        for (int k = 0; k < 3; ++k) {
            const int difference = code_at(image, p, k) - code_at(reference, p, k);
            extreme = abs(difference) > abs(extreme) ? difference : extreme;
        }
        picture_difference_color(extreme, end, to);
        if (result->channels == 4) {
            to[3] = 255;
        }
    }
    return BURNISH_STATUS_OK;
}

/* Draws a line of text centred at x. */
static void draw_centered(burnish_image *image, float x, float y, float height, const char *text) {
    static const uint8_t ink[3] = {47, 54, 63};
    const float width = burnish_image_draw_text(NULL, 0, 0, height, ink, text);
    burnish_image_draw_text(image, x - width / 2, y, height, ink, text);
}

void picture_draw_scale(burnish_image *card, const int box[4], float height, double low,
                        double end) {
    enum { MARKS = 5 };
    const int left = box[0], top = box[1], width = box[2], thickness = box[3];
    for (int x = 0; x < width; ++x) {
        uint8_t color[3];
        picture_difference_color(low + (x + 0.5) / width * (end - low), end, color);
        for (int y = 0; y < thickness; ++y) {
            const size_t pixel = (size_t)(top + y) * (size_t)card->width + (size_t)(left + x);
            memcpy(card->pixels + (size_t)card->channels * pixel, color, 3);
        }
    }
    for (int i = 0; i < MARKS; ++i) {
        char text[32];
        const double share = (double)i / (MARKS - 1), value = low + share * (end - low);
        snprintf(text, sizeof text, low < 0 && value != 0 ? "%+.3g" : "%.3g", value);
        draw_centered(card, (float)(left + share * width), (float)(top + thickness) + 2 * height,
                      height, text);
    }
}
