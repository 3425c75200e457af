/* Images in memory: making, copying, hashing. */
#include <string.h>

#include "base/memory.h"
#include "burnish/image.h"
#include "core/float_mode.h"
#include "core/srgb.h"
#include "image/pixels.h"
#include "image/xxh64.h"

static size_t image_size(const burnish_image *image) {
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

burnish_status burnish_image_create(const burnish_context *context, burnish_image *image, int width,
                                    int height, int channels, burnish_error *error) {
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
    /* The largest product is 2^30, which fits a 32-bit size_t. */
    burnish_image made = {.width = width,
                          .height = height,
                          .channels = channels,
                          .context = burnish_memory_owner(context)};
    burnish_memory memory = burnish_memory_of(context, error);
    made.pixels = burnish_allocate_zeroed(&memory, image_size(&made), 1, "the image's pixels");
    if (made.pixels) {
        *image = made;
    }
    return memory.status;
}

void burnish_image_destroy(burnish_image *image) {
    if (image) {
        burnish_release(image->context, image->pixels);
        *image = (burnish_image){0};
    }
}

burnish_pixels burnish_image_get_pixels(const burnish_image *image) {
    const burnish_pixel_format format =
        image->channels == 4 ? BURNISH_PIXELS_RGBA8 : BURNISH_PIXELS_RGB8;
    return (burnish_pixels){image->width, image->height, format,
                            (size_t)image->width * (size_t)image->channels, image->pixels};
}

burnish_status burnish_pixels_check(const burnish_pixels *pixels, const char *what,
                                    burnish_error *error) {
    if (!pixels || !pixels->pixels) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: the image is empty; create or render it first", what);
    }
    if (pixels->width < 1 || pixels->width > BURNISH_IMAGE_MAX_SIZE || pixels->height < 1 ||
        pixels->height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: a size of %d x %d pixels; width and height must be 1 to %d", what,
                            pixels->width, pixels->height, BURNISH_IMAGE_MAX_SIZE);
    }
    if ((unsigned)pixels->format >= BURNISH_PIXELS_COUNT ||
        pixels->format == BURNISH_PIXELS_RGBA_FLOAT) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "%s: %d is not a pixel format; expected RGB8, RGBA8, BGRA8, GRAY16 or RGB16", what,
            (int)pixels->format);
    }
    if (pixels->stride < burnish_pixels_row(pixels)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: a stride of %zu bytes; a row has %zu", what, pixels->stride,
                            burnish_pixels_row(pixels));
    }
    return BURNISH_STATUS_OK;
}

void burnish_pixels_swap(const uint8_t *from, uint8_t *to, size_t count) {
    for (size_t i = 0; i < count; ++i, from += 4, to += 4) {
        const uint8_t first = from[0];
        to[0] = from[2];
        to[1] = from[1];
        to[2] = first;
        to[3] = from[3];
    }
}

/* A row of BGRA in pieces of this many pixels, in RGBA's order. */
enum { SWAPPED = 1024 };

static void hash_swapped(burnish_xxh64 *state, const uint8_t *row, size_t count) {
    uint8_t swapped[4 * SWAPPED];
    for (size_t i = 0; i < count; i += SWAPPED) {
        const size_t part = count - i < SWAPPED ? count - i : SWAPPED;
        burnish_pixels_swap(row + 4 * i, swapped, part);
        burnish_xxh64_update(state, swapped, 4 * part);
    }
}

uint64_t burnish_pixels_hash(const burnish_pixels *pixels) {
    burnish_xxh64 state = burnish_xxh64_begin();
    if (burnish_pixels_check(pixels, "hash", NULL) != BURNISH_STATUS_OK ||
        pixels->format > BURNISH_PIXELS_BGRA8) { /* 16 bits: their bytes differ with the machine */
        return burnish_xxh64_end(&state);
    }
    const size_t row = burnish_pixels_row(pixels);
    for (int y = 0; y < pixels->height; ++y) {
        const uint8_t *bytes = pixels->pixels + pixels->stride * (size_t)y;
        if (pixels->format == BURNISH_PIXELS_BGRA8) {
            hash_swapped(&state, bytes, (size_t)pixels->width);
        } else {
            burnish_xxh64_update(&state, bytes, row);
        }
    }
    return burnish_xxh64_end(&state);
}

uint64_t burnish_image_hash(const burnish_image *image) {
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    return burnish_pixels_hash(&pixels);
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

float burnish_srgb_decode(float value) {
    const burnish_float_mode before = burnish_float_mode_enter();
    const float linear = burnish_srgb_value_to_linear(value);
    burnish_float_mode_leave(before);
    return linear;
}
