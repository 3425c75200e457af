/* Images in memory: making, copying, hashing. */
#include "burnish/image.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL /* one function: no library to load for it */
#include <xxhash.h>

#include "core/memory.h"

static size_t image_size(const burnish_image *image) {
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

burnish_status burnish_image_create(burnish_image *image, int width, int height, int channels,
                                    burnish_error *error) {
    if (!image) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "image: NULL; pass a burnish_image");
    }
    *image = (burnish_image){0};
    if (width < 1 || width > BURNISH_IMAGE_MAX_SIZE || height < 1 ||
        height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "image: a size of %d x %d pixels; width and height must be 1 to %d",
                            width, height, BURNISH_IMAGE_MAX_SIZE);
    }
    if (channels != 3 && channels != 4) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "image: %d channels; use 3 (RGB) or 4 (RGBA)", channels);
    }
    /* The largest product is 2^30, so it fits a 32-bit size_t too. */
    burnish_image made = {.width = width, .height = height, .channels = channels};
    made.pixels = calloc(image_size(&made), 1);
    if (!made.pixels) {
        return burnish_fail_memory(error, "the image's pixels", image_size(&made));
    }
    *image = made;
    return BURNISH_STATUS_OK;
}

void burnish_image_destroy(burnish_image *image) {
    if (image) {
        free(image->pixels);
        *image = (burnish_image){0};
    }
}

uint64_t burnish_image_hash(const burnish_image *image) {
    return XXH64(image->pixels, image->pixels ? image_size(image) : 0, 0);
}

void burnish_image_copy(burnish_image *target, int x, int y, const burnish_image *source) {
    if (!target->pixels || !source->pixels || target->channels != source->channels) {
        return;
    }
    /* 64 bits: x + width must not overflow for any x. */
    int64_t left = x > 0 ? x : 0;
    int64_t top = y > 0 ? y : 0;
    int64_t right = (int64_t)x + source->width;
    int64_t bottom = (int64_t)y + source->height;
    right = right < target->width ? right : target->width;
    bottom = bottom < target->height ? bottom : target->height;
    if (left >= right || top >= bottom) {
        return;
    }
    size_t pixel = (size_t)target->channels;
    size_t bytes = (size_t)(right - left) * pixel;
    for (int64_t row = top; row < bottom; ++row) {
        size_t to = (size_t)(row * target->width + left) * pixel;
        size_t from = (size_t)((row - y) * source->width + (left - x)) * pixel;
        memmove(target->pixels + to, source->pixels + from, bytes);
    }
}
