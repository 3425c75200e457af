/* YUV4MPEG2: uncompressed frames for video encoders. 4:2:0 with chroma in the middle of each 2 x 2
 * pixels (C420jpeg), limited range, BT.709's matrix on sRGB codes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/animation.h"
#include "picture/video.h"

static const char marker[] = "FRAME\n";
enum { MARKER_SIZE = sizeof marker - 1 };

static size_t chroma_size(int width, int height) {
    return (size_t)((width + 1) / 2) * (size_t)((height + 1) / 2);
}

picture_frames picture_expect_frames(int width, int height, int fps, int frames) {
    picture_frames f = {.frame_size = MARKER_SIZE + (uint64_t)width * (uint64_t)height +
                                      2 * chroma_size(width, height)};
    f.head_size = (uint64_t)snprintf(
        f.head, sizeof f.head,
        "YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C420jpeg XYSCSS=420JPEG XCOLORRANGE=LIMITED\n", width,
        height, fps);
    f.total = f.head_size + f.frame_size * (uint64_t)frames;
    return f;
}

int picture_check_frames(picture_frames *f, const void *bytes, size_t size) {
    const char *text = bytes;
    if (size > f->total - f->next) {
        return 0;
    }
    while (size > 0) {
        const int is_head = f->next < f->head_size;
        const uint64_t at = is_head ? f->next : (f->next - f->head_size) % f->frame_size;
        const uint64_t text_size = is_head ? f->head_size : MARKER_SIZE;
        const uint64_t left = (at < text_size ? text_size : f->frame_size) - at;
        const size_t count = left < size ? (size_t)left : size;
        if (at < text_size && memcmp(text, (is_head ? f->head : marker) + at, count) != 0) {
            return 0;
        }
        f->next += count;
        text += count;
        size -= count;
    }
    return 1;
}

static burnish_status y4m_begin(picture_animation *animation, burnish_error *error) {
    const picture_animation_options *o = &animation->options;
    if (o->channels != 3) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "Y4M has no alpha; write WebP or GIF");
    }
    const picture_frames stream = picture_expect_frames(o->width, o->height, o->fps, o->frames);
    picture_put(&animation->out, stream.head, (size_t)stream.head_size);
    return BURNISH_STATUS_OK;
}

/* Coefficients in 2^16: luma 219 (0.2126, 0.7152, 0.0722) / 255; chroma 112 (B - Y) / 0.9278 /
 * 127.5 and 112 (R - Y) / 0.7874 / 127.5. */
static uint8_t pixel_luma(const uint8_t *p) {
    return (uint8_t)((11966 * p[0] + 40254 * p[1] + 4064 * p[2] + (16 << 16) + 32768) >> 16);
}

/* From the sum of four pixels. */
static uint8_t blue_of(const int s[3]) {
    return (uint8_t)((-6596 * s[0] - 22189 * s[1] + 28785 * s[2] + (512 << 16) + 131072) >> 18);
}
static uint8_t red_of(const int s[3]) {
    return (uint8_t)((28785 * s[0] - 26145 * s[1] - 2640 * s[2] + (512 << 16) + 131072) >> 18);
}

/* The chroma planes; pixels at odd ends count twice. */
static void put_chroma(const burnish_image *frame, uint8_t *u, uint8_t *v) {
    for (int y = 0; y < frame->height; y += 2) {
        for (int x = 0; x < frame->width; x += 2) {
            const int x1 = x + (x + 1 < frame->width), y1 = y + (y + 1 < frame->height);
            const int at[4][2] = {{x, y}, {x1, y}, {x, y1}, {x1, y1}};
            int sum[3] = {0};
            for (int i = 0; i < 4; ++i) {
                const uint8_t *p = frame->pixels +
                                   3 * ((size_t)at[i][1] * (size_t)frame->width + (size_t)at[i][0]);
                for (int k = 0; k < 3; ++k) {
                    sum[k] += p[k];
                }
            }
            *u++ = blue_of(sum);
            *v++ = red_of(sum);
        }
    }
}

static burnish_status y4m_add(picture_animation *animation, const burnish_image *frame,
                              burnish_error *error) {
    const size_t count = (size_t)frame->width * (size_t)frame->height;
    const size_t chroma = chroma_size(frame->width, frame->height);
    uint8_t *planes = malloc(count + 2 * chroma);
    (void)error;
    if (!planes) {
        animation->out.failed = 1;
        return BURNISH_STATUS_OK;
    }
    for (size_t i = 0; i < count; ++i) {
        planes[i] = pixel_luma(frame->pixels + 3 * i);
    }
    put_chroma(frame, planes + count, planes + count + chroma);
    picture_put(&animation->out, marker, MARKER_SIZE);
    picture_put(&animation->out, planes, count + 2 * chroma);
    free(planes);
    return BURNISH_STATUS_OK;
}

static burnish_status y4m_end(picture_animation *animation, burnish_error *error) {
    (void)animation, (void)error;
    return BURNISH_STATUS_OK;
}

const picture_animator picture_y4m = {y4m_begin, y4m_add, y4m_end, NULL};
