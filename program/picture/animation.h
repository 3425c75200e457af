/* Animations: GIF, WebP and Y4M, a frame at a time. */
#ifndef TOOL_PICTURE_ANIMATION_H
#define TOOL_PICTURE_ANIMATION_H

#include "picture/formats.h"
#include "picture/palette.h"

typedef struct picture_animation_options {
    picture_format format; /* GIF, WEBP, or Y4M also for videos */
    int width, height;
    int channels; /* of the frames; Y4M takes 3 */
    int frames;   /* how many will come */
    int fps;      /* frames per second; GIF at most 50 */
    int quality;  /* of WebP, [1, 100]; 0: without loss */
    int threads;
    int is_whole;                   /* 1: `out` keeps the whole file */
    const picture_palette *palette; /* GIF: must outlive the animation; others: NULL */
} picture_animation_options;

enum { PICTURE_GIF_FPS_MAX = 50 }; /* browsers replace shorter delays by 0.1 s */

/* A growing buffer. Empty: {0}; release with free(data). */
typedef struct picture_bytes {
    uint8_t *data;
    size_t size, capacity;
    int failed; /* 1: out of memory; later bytes are lost */
} picture_bytes;

void picture_put(picture_bytes *bytes, const void *data, size_t size);
void picture_put_byte(picture_bytes *bytes, int value);

typedef struct picture_animation picture_animation;

/* The encoder of a format; it owns `state`, which is NULL before begin. All functions append to `out`. */
typedef struct picture_animator {
    burnish_status (*begin)(picture_animation *animation, burnish_error *error);
    burnish_status (*add)(picture_animation *animation, const burnish_image *frame,
                          burnish_error *error);
    burnish_status (*end)(picture_animation *animation, burnish_error *error);
    void (*destroy)(void *state);
} picture_animator;

struct picture_animation {
    picture_animation_options options;
    const picture_animator *animator;
    void *state;
    int index;         /* of the next frame */
    picture_bytes out; /* the next bytes of the file */
};

extern const picture_animator picture_gif, picture_webp, picture_y4m;

/* *animation is NULL on error. Errors: ARGUMENT, MEMORY. */
burnish_status picture_animation_create(const picture_animation_options *options,
                                        picture_animation **animation, burnish_error *error);
void picture_animation_destroy(picture_animation *animation); /* NULL is allowed */

/* Encodes the next frame, or the end of the file (NULL). animation->out then has the bytes to write,
 * until the next call. Errors: MEMORY, and errors of the format. */
burnish_status picture_animation_add(picture_animation *animation, const burnish_image *frame,
                                     burnish_error *error);

/* The start time of a frame in the given units, rounded. */
int picture_time(const picture_animation *animation, int frame, int units_per_second);

#endif
