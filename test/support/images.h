/* For tests: images that must be made, their pixels, and what fills them. */
#ifndef BURNISH_TEST_IMAGES_H
#define BURNISH_TEST_IMAGES_H

#include "burnish/image.h"
#include "support.h"

/* All bytes are 0. Without memory there is no test. */
static inline burnish_image make_image(int width, int height, int channels) {
    burnish_image image;
    burnish_error error;
    if (!CHECK_OK(burnish_image_create(NULL, &image, width, height, channels, &error), error)) {
        exit(EXIT_FAILURE);
    }
    return image;
}

static inline size_t image_size(const burnish_image *image) {
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

static inline burnish_image make_filled(int width, int height, int channels, int value) {
    burnish_image image = make_image(width, height, channels);
    memset(image.pixels, value, image_size(&image));
    return image;
}

static inline burnish_image make_noise(int width, int height, int channels, uint64_t number) {
    burnish_image image = make_image(width, height, channels);
    uint64_t state = test_seed(number);
    for (size_t i = 0; i < image_size(&image); ++i) {
        image.pixels[i] = (uint8_t)test_random32(&state);
    }
    return image;
}

static inline uint8_t *pixel_at(const burnish_image *image, int x, int y) {
    return image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
}

#endif
