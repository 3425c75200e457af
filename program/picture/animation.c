/* Shared by all animations: buffers and frame times. */
#include "picture/animation.h"

#include <stdlib.h>
#include <string.h>

void picture_put(picture_bytes *bytes, const void *data, size_t size) {
    if (size == 0) {
        return;
    }
    if (size > bytes->capacity - bytes->size) {
        const size_t capacity =
            size > SIZE_MAX / 4 - bytes->size ? 0 : 2 * (bytes->size + size) + 256;
        uint8_t *grown = capacity > 0 ? realloc(bytes->data, capacity) : NULL;
        if (!grown) {
            bytes->failed = 1;
            return;
        }
        bytes->data = grown;
        bytes->capacity = capacity;
    }
    memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
}

void picture_put_byte(picture_bytes *bytes, int value) {
    const uint8_t byte = (uint8_t)value;
    picture_put(bytes, &byte, 1);
}

int picture_time(const picture_animation *animation, int frame, int units_per_second) {
    const int fps = animation->options.fps;
    return (2 * frame * units_per_second + fps) / (2 * fps);
}

static burnish_status check_memory(const picture_animation *animation, burnish_error *error) {
    return animation->out.failed
               ? cli_fail(error, BURNISH_STATUS_MEMORY,
                          "out of memory: the animation; free memory, raise --max-memory, or draw "
                          "smaller frames")
               : BURNISH_STATUS_OK;
}

static const picture_animator *animator_of(picture_format format) {
    return format == PICTURE_GIF    ? &picture_gif
           : format == PICTURE_WEBP ? &picture_webp
                                    : &picture_y4m;
}

burnish_status picture_animation_create(const picture_animation_options *options,
                                        picture_animation **animation, burnish_error *error) {
    *animation = calloc(1, sizeof **animation);
    if (!*animation) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the animation");
    }
    (*animation)->options = *options;
    (*animation)->animator = animator_of(options->format);
    burnish_status status = (*animation)->animator->begin(*animation, error);
    status = status == BURNISH_STATUS_OK ? check_memory(*animation, error) : status;
    if (status != BURNISH_STATUS_OK) {
        picture_animation_destroy(*animation);
        *animation = NULL;
    }
    return status;
}

void picture_animation_destroy(picture_animation *animation) {
    if (animation) {
        if (animation->state) {
            animation->animator->destroy(animation->state);
        }
        free(animation->out.data);
        free(animation);
    }
}

burnish_status picture_animation_add(picture_animation *animation, const burnish_image *frame,
                                     burnish_error *error) {
    if (animation->index > 0 && !animation->options.is_whole) {
        animation->out.size = 0; /* the first frame follows the header */
    }
    burnish_status status = frame ? animation->animator->add(animation, frame, error)
                                  : animation->animator->end(animation, error);
    ++animation->index;
    return status == BURNISH_STATUS_OK ? check_memory(animation, error) : status;
}
