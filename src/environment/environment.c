#include "environment/environment.h"

#include <string.h>

#include "base/context.h"
#include "base/elementary.h"
#include "base/numbers.h"
#include "core/float_mode.h"
#include "environment/environment_builder.h"
#include "image/decode/decode.h"

typedef burnish_environment_builder builder;

static burnish_status builder_begin(void *context, uint64_t width, uint64_t height) {
    builder *b = context;
    return burnish_environment_builder_begin(b, width, height, b->name, b->memory);
}

/* A byte of a file may unpack to EXPANSION_MAX, and a small file counts as EXPANSION_LEAST bytes. A
 * pixel counts as PIXEL_LEAST bytes, since adding it takes as long as unpacking these. 1 MB then
 * takes less than 2 seconds. Images of one colour would unpack to more: they may have 8192 x 4096
 * pixels of four halves. */
enum { EXPANSION_MAX = 256, EXPANSION_LEAST = 1 << 20, PIXEL_LEAST = 4 };

/* A file that is decoded. */
typedef struct decoding {
    builder builder;
    size_t size;
} decoding;

static burnish_status begin_file(void *context, uint64_t width, uint64_t height,
                                 uint64_t pixel_bytes) {
    decoding *d = context;
    const uint64_t pixels = width * height;
    const uint64_t size = d->size > EXPANSION_LEAST ? d->size : EXPANSION_LEAST;
    if (pixels > BURNISH_ENVIRONMENT_MAX_PIXELS) {
        return burnish_fail(
            d->builder.memory->error, BURNISH_STATUS_LIMIT,
            "%.200s: %llu x %llu pixels; environments of up to %llu pixels are read",
            d->builder.name, (unsigned long long)width, (unsigned long long)height,
            (unsigned long long)BURNISH_ENVIRONMENT_MAX_PIXELS);
    }
    pixel_bytes = pixel_bytes > PIXEL_LEAST ? pixel_bytes : PIXEL_LEAST;
    if (pixels * pixel_bytes > size * EXPANSION_MAX) {
        return burnish_fail(d->builder.memory->error, BURNISH_STATUS_LIMIT,
                            "%.200s: %llu x %llu pixels of %llu bytes in a file of %zu; store it "
                            "without compression",
                            d->builder.name, (unsigned long long)width, (unsigned long long)height,
                            (unsigned long long)pixel_bytes, d->size);
    }
    return builder_begin(&d->builder, width, height);
}

static void builder_add_pixel(void *context, int x, int y, const float rgb[3]) {
    burnish_environment_builder_add(&((decoding *)context)->builder, x, y, rgb);
}

static void warn_of_clamped(const builder *b) {
    burnish_error line;
    if (b->clamped > 0) {
        burnish_fail(&line, BURNISH_STATUS_FORMAT,
                     "%.200s: %zu values are negative, above %.0f or not numbers; they are clamped",
                     b->name, b->clamped, (double)BURNISH_RADIANCE_MAX);
        burnish_context_warn(b->memory->context, line.text);
    }
}

/* Ends the builder, which has failed with `status` if that is not OK. */
static burnish_status builder_end(builder *b, burnish_status status,
                                  burnish_environment **environment) {
    if (status == BURNISH_STATUS_OK) {
        warn_of_clamped(b);
        return burnish_environment_builder_end(b, environment);
    }
    burnish_environment_builder_cancel(b);
    return status;
}

static burnish_status create_from_floats(builder *b, int width, int height, const float *rgb,
                                         burnish_environment **environment) {
    burnish_status status = builder_begin(b, (uint64_t)width, (uint64_t)height);
    for (int y = 0; y < height && status == BURNISH_STATUS_OK; ++y) {
        for (int x = 0; x < width; ++x, rgb += 3) {
            burnish_environment_builder_add(b, x, y, rgb);
        }
    }
    return builder_end(b, status, environment);
}

burnish_status burnish_environment_create(const burnish_context *context, int width, int height,
                                          const float *rgb, burnish_environment **environment,
                                          burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    builder b = {.memory = &memory, .name = "environment"};
    if (!environment || !rgb || width < 1 || height < 1) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "environment: %s",
                            !environment ? "NULL; pass where to put it"
                            : !rgb       ? "rgb is NULL; pass colours"
                                         : "width and height must be at least 1");
    }
    *environment = NULL;
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_status status = create_from_floats(&b, width, height, rgb, environment);
    burnish_float_mode_leave(before);
    return status;
}

static burnish_status create_named(const burnish_context *context, const char *name,
                                   burnish_environment **environment, burnish_error *error) {
    enum { WIDTH = 512, HEIGHT = 256 };
    burnish_memory memory = burnish_memory_of(context, error);
    builder b = {.memory = &memory, .name = name};
    float *rgb = burnish_allocate(&memory, 3 * WIDTH * HEIGHT, sizeof *rgb, name);
    if (!rgb) {
        return memory.status;
    }
    (strcmp(name, "sky") == 0 ? burnish_sky_fill : burnish_room_fill)(WIDTH, HEIGHT, rgb);
    const burnish_status status = create_from_floats(&b, WIDTH, HEIGHT, rgb, environment);
    burnish_release(context, rgb);
    return status;
}

burnish_status burnish_environment_create_named(const burnish_context *context, const char *name,
                                                burnish_environment **environment,
                                                burnish_error *error) {
    if (!environment || !name) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "environment: NULL; pass one");
    }
    *environment = NULL;
    if (strcmp(name, "sky") != 0 && strcmp(name, "room") != 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "environment: \"%.200s\"; expected sky or room", name);
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_status status = create_named(context, name, environment, error);
    burnish_float_mode_leave(before);
    return status;
}

burnish_status burnish_environment_decode(const burnish_context *context, const void *bytes,
                                          size_t size, const char *name,
                                          burnish_environment **environment, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    decoding d = {{.memory = &memory, .name = name ? name : "environment"}, size};
    if (!environment || (!bytes && size > 0)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass one",
                            environment ? "bytes" : "environment");
    }
    *environment = NULL;
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_encoded from = {.bytes = bytes,
                                  .size = size,
                                  .name = d.builder.name,
                                  .max_side = BURNISH_ENVIRONMENT_MAX_SIDE,
                                  .max_pixels = UINT64_MAX};
    const burnish_float_sink sink = {begin_file, builder_add_pixel, &d};
    const burnish_status status =
        builder_end(&d.builder, burnish_decode_floats(&from, &memory, &sink), environment);
    burnish_float_mode_leave(before);
    return status;
}

void burnish_environment_destroy(burnish_environment *environment) {
    if (environment) {
        const burnish_context *owner = environment->owner;
        burnish_release(owner, environment->memory);
        burnish_release(owner, environment);
    }
}

/* ---- Radiance in a direction ---- */

int burnish_environment_level_of(const burnish_environment *environment, double angle) {
    int level = 0;
    while (level + 1 < environment->level_count &&
           2 * BURNISH_PI / environment->levels[level + 1].width <= angle) {
        ++level;
    }
    return level;
}

/* Weights of four neighbours of a position, and the first of them, which can be -2. */
static int weigh_texels(double position, float weights[4]) {
    const int second = (int)(position + 2) - 2; /* rounded down: positions begin at -1/2 */
    const float t = (float)(position - second), s = 1 - t;
    weights[0] = s * s * s * (1.0f / 6);
    weights[1] = (4 + t * t * (3 * t - 6)) * (1.0f / 6);
    weights[2] = (4 + s * s * (3 * s - 6)) * (1.0f / 6);
    weights[3] = t * t * t * (1.0f / 6);
    return second - 1;
}

void burnish_environment_lookup(const burnish_environment *environment, int level,
                                const double direction[3], float rgb[3]) {
    const burnish_environment_level *image = &environment->levels[level];
    const int width = image->width, height = image->height;
    const double x = direction[0], y = direction[1], z = direction[2];
    const double polar = burnish_atan2(__builtin_sqrt(x * x + z * z), y);
    const double azimuth = burnish_atan2(z, x) + BURNISH_PI;
    float across[4], down[4];
    const int left = weigh_texels(azimuth / (2 * BURNISH_PI) * width - 0.5, across);
    const int top = weigh_texels(polar / BURNISH_PI * height - 0.5, down);
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int j = 0; j < 4; ++j) {
        const int row = top + j, is_beyond = row < 0 || row >= height; /* over a pole */
        const int nearest = row < 0 ? -1 - row : row >= height ? 2 * height - 1 - row : row;
        const size_t first = (size_t)nearest * (size_t)width;
        for (int i = 0; i < 4; ++i) {
            const int column = left + i + (is_beyond ? width / 2 : 0);
            const size_t texel = first + (size_t)((column + width) % width);
            for (int k = 0; k < 3; ++k) {
                rgb[k] += down[j] * across[i] * image->texels[k][texel];
            }
        }
    }
}
