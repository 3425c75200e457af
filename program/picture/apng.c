/* APNG (PNG, third edition): each frame is the changed part, encoded as a PNG whose image data
 * is copied. Readers without animation show the first frame. */
#include <stdlib.h>
#include <string.h>

#include "picture/animation.h"

enum { SIGNATURE = 8, FRAME = 12, FCTL_SIZE = 26 };

/* Sequence number of the next frame chunk. */
typedef struct apng_state {
    uint32_t sequence;
    uint32_t crc[256];
} apng_state;

static uint32_t read_u32(const uint8_t *from) {
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

static uint8_t *put_u32(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)(value >> 24);
    to[1] = (uint8_t)(value >> 16);
    to[2] = (uint8_t)(value >> 8);
    to[3] = (uint8_t)value;
    return to + 4;
}

static uint32_t crc_of(const apng_state *state, uint32_t crc, const uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        crc = state->crc[(crc ^ bytes[i]) & 255] ^ crc >> 8;
    }
    return crc;
}

/* Writes a chunk with data in two pieces. */
static void put_chunk(picture_animation *animation, const char *type, const uint8_t *head,
                      size_t head_size, const uint8_t *body, size_t body_size) {
    const apng_state *state = animation->state;
    uint8_t start[8], end[4];
    put_u32(start, (uint32_t)(head_size + body_size));
    memcpy(start + 4, type, 4);
    uint32_t crc = crc_of(state, UINT32_MAX, start + 4, 4);
    crc = crc_of(state, crc, head, head_size);
    crc = crc_of(state, crc, body, body_size);
    put_u32(end, ~crc);
    picture_put(&animation->out, start, sizeof start);
    picture_put(&animation->out, head, head_size);
    picture_put(&animation->out, body, body_size);
    picture_put(&animation->out, end, sizeof end);
}

static burnish_status begin(picture_animation *animation, burnish_error *error) {
    apng_state *state = calloc(1, sizeof *state);
    animation->state = state;
    if (!state) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the animation");
    }
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit) {
            crc = crc & 1 ? 0xEDB88320u ^ crc >> 1 : crc >> 1;
        }
        state->crc[i] = crc;
    }
    return BURNISH_STATUS_OK;
}

static void put_animation_control(picture_animation *animation) {
    uint8_t control[8];
    put_u32(put_u32(control, (uint32_t)animation->options.frames), 0); /* 0: for ever */
    put_chunk(animation, "acTL", control, sizeof control, NULL, 0);
}

static void put_frame_control(picture_animation *animation, const int box[4]) {
    apng_state *state = animation->state;
    uint8_t control[FCTL_SIZE], *to = put_u32(control, state->sequence++);
    to = put_u32(to, (uint32_t)box[2]);
    to = put_u32(to, (uint32_t)box[3]);
    to = put_u32(to, (uint32_t)box[0]);
    to = put_u32(to, (uint32_t)box[1]);
    const int fps = animation->options.fps;
    memcpy(to, (uint8_t[]){0, 1, (uint8_t)(fps >> 8), (uint8_t)fps, 0, 0}, 6); /* leave, replace */
    put_chunk(animation, "fcTL", control, sizeof control, NULL, 0);
}

/* Copies chunks of a frame's PNG: for the first frame all except IEND, for others the image data. */
static void put_frame(picture_animation *animation, const uint8_t *png, size_t size,
                      const int box[4]) {
    apng_state *state = animation->state;
    const int is_first = animation->index == 0;
    int has_control = 0;
    if (is_first) {
        picture_put(&animation->out, png, SIGNATURE);
    }
    for (size_t at = SIGNATURE; at + FRAME <= size;) {
        const uint8_t *chunk = png + at;
        const size_t data = read_u32(chunk);
        const int is_data = memcmp(chunk + 4, "IDAT", 4) == 0;
        at += FRAME + data;
        if (is_data && !has_control) {
            has_control = 1;
            if (is_first) {
                put_animation_control(animation);
            }
            put_frame_control(animation, box);
        }
        if (is_first && memcmp(chunk + 4, "IEND", 4) != 0) {
            picture_put(&animation->out, chunk, FRAME + data);
        } else if (is_data && !is_first) {
            uint8_t number[4];
            put_u32(number, state->sequence++);
            put_chunk(animation, "fdAT", number, sizeof number, chunk + 8, data);
        }
    }
}

static burnish_status add(picture_animation *animation, const burnish_image *frame,
                          burnish_error *error) {
    int box[4];
    picture_changed(animation, frame, box);
    burnish_pixels part = burnish_image_get_pixels(frame);
    part.pixels += part.stride * (size_t)box[1] + (size_t)frame->channels * (size_t)box[0];
    part.width = box[2];
    part.height = box[3];
    burnish_png_options options = burnish_png_options_default();
    uint8_t *png;
    size_t size;
    options.threads = animation->options.threads;
    burnish_status status = burnish_png_encode(&part, &options, &png, &size, error);
    if (status == BURNISH_STATUS_OK) {
        put_frame(animation, png, size, box);
        burnish_release(NULL, png);
    }
    return status;
}

static burnish_status end(picture_animation *animation, burnish_error *error) {
    (void)error;
    put_chunk(animation, "IEND", NULL, 0, NULL, 0);
    return BURNISH_STATUS_OK;
}

const picture_animator picture_apng = {begin, add, end, free};
