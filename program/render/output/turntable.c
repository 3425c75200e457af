/* Turntables: frames are drawn, encoded and written one after the other; while one is encoded, a
 * thread draws the next. Everything that affects pixels uses plain IEEE operations. */

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/file.h"
#include "base/cli/values.h"
#include "base/clock.h"
#include "picture/animation.h"
#include "picture/formats.h"
#include "picture/video.h"
#include "render/output/result.h"
#include "render/scene/cameras.h"
#include "sandbox/worker.h"

/* ---- The camera's path ---- */

/* Sine and cosine of index / count of a turn. The eighth of the turn is found in integers; within
 * it the truncated series has an error below 1e-17. */
static void turn(int index, int count, double *sine, double *cosine) {
    const long eighths = (8L * index / count) & 7; /* the part of the turn, in eighths */
    const long rest = 8L * index - (8L * index / count) * count;
    const int back = (int)(eighths & 1); /* counted from the next quarter backward */
    const double x = (back ? (double)(count - rest) : (double)rest) / count * (CLI_PI / 4);
    double s = 0, c = 0;
    for (int k = 8; k > 0; --k) { /* x - x^3 / 3! + ..., Horner */
        s = 1 - s * x * x / ((2 * k) * (2 * k + 1));
        c = 1 - c * x * x / ((2 * k - 1) * (2 * k));
    }
    s *= x;
    const double quarter[2] = {back ? -s : s, c};
    const int quarters = (int)((eighths + back) / 2 & 3);
    const double signs[4][2] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}}; /* of sine and cosine */
    *sine = signs[quarters][0] * quarter[quarters & 1];
    *cosine = signs[quarters][1] * quarter[!(quarters & 1)];
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* v turned around a unit axis (Rodrigues). */
static void rotate(double v[3], const double axis[3], double sine, double cosine) {
    const double along = dot(axis, v) * (1 - cosine);
    const double across[3] = {axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                              axis[0] * v[1] - axis[1] * v[0]};
    for (int k = 0; k < 3; ++k) {
        v[k] = v[k] * cosine + across[k] * sine + axis[k] * along;
    }
}

/* A position of the axis: the focal point, or the middle of the object's box. */
static void find_pivot(const burnish_mesh *mesh, const render_settings *settings, double pivot[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    for (int k = 0; k < 3; ++k) {
        pivot[k] = settings->camera.focal_point.given
                       ? settings->camera.focal_point.values[k]
                       : ((double)view->bounds_min[k] + view->bounds_max[k]) / 2;
    }
}

/* Rotates a camera to the right, to a frame. */
static void orbit(const burnish_mesh *mesh, const render_settings *settings, int frame,
                  burnish_camera *camera) {
    double sine, cosine, axis[3], pivot[3];
    if (frame == 0) {
        return;
    }
    turn(frame, settings->output.frames, &sine, &cosine);
    render_up_in_use(mesh, &settings->camera, axis);
    find_pivot(mesh, settings, pivot);
    for (int k = 0; k < 3; ++k) {
        camera->position[k] -= pivot[k];
        camera->focal_point[k] -= pivot[k];
    }
    rotate(camera->position, axis, sine, cosine);
    rotate(camera->focal_point, axis, sine, cosine);
    rotate(camera->view_up, axis, sine, cosine);
    for (int k = 0; k < 3; ++k) {
        camera->position[k] += pivot[k];
        camera->focal_point[k] += pivot[k];
    }
}

/* ---- Framing of the whole turn ---- */

enum {
    SLICES = 64,  /* of the height */
    SEGMENTS = 96 /* of a ring; it lies outside its circle by 0.05 % at its corners */
};

/* Vertices of one slice of the height: the largest distance from the axis, and the range of
 * heights. */
typedef struct slice {
    double radius, low, high; /* radius -1: no vertex */
} slice;

static void measure_slices(const burnish_mesh *mesh, const double axis[3], const double pivot[3],
                           slice slices[SLICES]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_view *splats = burnish_mesh_get_view(burnish_mesh_get_splats(mesh));
    const size_t count = view->vertex_count;
    double low = 0, high = 0, diagonal = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = (double)(corner >> k & 1 ? view->bounds_max[k] : view->bounds_min[k]) - pivot[k];
        }
        const double height = dot(p, axis), length = dot(p, p);
        low = corner == 0 || height < low ? height : low;
        high = corner == 0 || height > high ? height : high;
        diagonal = length > diagonal ? length : diagonal;
    }
    for (int i = 0; i < SLICES; ++i) {
        slices[i] = (slice){-1, 0, 0};
    }
    const double scale = high > low ? SLICES / (high - low) : 0;
    for (size_t i = 0; i < count + (splats ? splats->vertex_count : 0); ++i) {
        const float *at = i < count ? view->positions + 3 * i : splats->positions + 3 * (i - count);
        const double p[3] = {(double)at[0] - pivot[0], (double)at[1] - pivot[1],
                             (double)at[2] - pivot[2]};
        if (i >= count && dot(p, p) > diagonal) {
            continue; /* surroundings that are not framed */
        }
        const double height = dot(p, axis), squared = dot(p, p) - height * height;
        int index = (int)((height - low) * scale);
        index = index < 0 ? 0 : index >= SLICES ? SLICES - 1 : index;
        slice *s = &slices[index];
        s->low = s->radius < 0 || height < s->low ? height : s->low;
        s->high = s->radius < 0 || height > s->high ? height : s->high;
        s->radius = squared > s->radius ? squared : s->radius;
    }
    for (int i = 0; i < SLICES; ++i) { /* squares so far; a slice on the axis has a minimal area */
        const double least = 1e-8 * diagonal;
        slices[i].radius = slices[i].radius < 0       ? -1
                           : slices[i].radius < least ? sqrt(least)
                                                      : sqrt(slices[i].radius);
    }
}

/* The volume that the object sweeps in a turn: discs at the ends of every slice. */
typedef struct swept {
    float positions[2 * SLICES][SEGMENTS + 1][3]; /* the last one of each is its middle */
    uint32_t indices[2 * SLICES][SEGMENTS][3];
    int discs;
} swept;

static void add_disc(swept *s, const double axis[3], const double pivot[3], double radius,
                     double height) {
    const double u[3] = {axis[1], axis[2], axis[0]}; /* the axis is a coordinate axis */
    const double v[3] = {axis[1] * u[2] - axis[2] * u[1], axis[2] * u[0] - axis[0] * u[2],
                         axis[0] * u[1] - axis[1] * u[0]};
    const uint32_t first = (uint32_t)s->discs * (SEGMENTS + 1);
    double half_sine, half_cosine;
    turn(1, 2 * SEGMENTS, &half_sine, &half_cosine);
    for (int i = 0; i <= SEGMENTS; ++i) {
        double sine, cosine;
        turn(i % SEGMENTS, SEGMENTS, &sine, &cosine);
        const double reach =
            i < SEGMENTS ? radius / half_cosine : 0; /* its sides touch the circle */
        for (int k = 0; k < 3; ++k) {
            s->positions[s->discs][i][k] =
                (float)(pivot[k] + axis[k] * height + reach * (u[k] * cosine + v[k] * sine));
        }
    }
    for (uint32_t i = 0; i < SEGMENTS; ++i) {
        const uint32_t triangle[3] = {first + SEGMENTS, first + i, first + (i + 1) % SEGMENTS};
        memcpy(s->indices[s->discs][i], triangle, sizeof triangle);
    }
    ++s->discs;
}

static burnish_status sweep(const burnish_mesh *mesh, const double axis[3], const double pivot[3],
                            burnish_mesh **result, burnish_error *error) {
    slice slices[SLICES];
    swept *s = malloc(sizeof *s);
    if (!s) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the turntable");
    }
    s->discs = 0;
    measure_slices(mesh, axis, pivot, slices);
    for (int i = 0; i < SLICES; ++i) {
        if (slices[i].radius >= 0) {
            add_disc(s, axis, pivot, slices[i].radius, slices[i].low);
            add_disc(s, axis, pivot, slices[i].radius, slices[i].high);
        }
    }
    burnish_mesh_description description = burnish_mesh_description_default();
    burnish_load_options options = burnish_load_options_default();
    const size_t discs = (size_t)s->discs;
    description.name = "turntable";
    description.positions = (burnish_array){s->positions, discs * (SEGMENTS + 1), 0};
    description.indices = (burnish_array){s->indices, discs * SEGMENTS * 3, 0};
    options.threads = 1;
    burnish_status status = burnish_mesh_create(&description, &options, result, error);
    free(s);
    return status;
}

burnish_status render_turntable_camera(const burnish_mesh *mesh, const render_settings *settings,
                                       render_view view, render_room *room, burnish_camera *camera,
                                       burnish_error *error) {
    double axis[3], pivot[3];
    burnish_mesh *all = NULL;
    render_settings same = *settings;
    same.camera.up = render_up_in_use(mesh, &settings->camera, axis);
    find_pivot(mesh, settings, pivot);
    burnish_status status = sweep(mesh, axis, pivot, &all, error);
    if (status == BURNISH_STATUS_OK) {
        status = render_camera(all, &same, view, room, camera, error);
    }
    burnish_mesh_destroy(all);
    return status;
}

/* ---- Frames ---- */

/* Maximum number of frames for the palette. */
enum { SAMPLED = 8 };

/* Bytes of frames drawn for the palette that are kept until they are written. */
enum { KEPT_BYTES = 64 << 20 };

/* A turntable that is being written. */
typedef struct stream {
    render_result *result;
    burnish_file_check *ready; /* receives the result */
    picture_animation *animation;
    burnish_camera first; /* the first frame's camera */
    int kept[SAMPLED];    /* numbers of the frames for the palette, whose pixels are in ... */
    uint8_t *kept_pixels; /* ... this array; NULL: drawn again */
    int drawn;            /* frame in the cell's image; the first one comes with it */
    /* the thread that draws the next frame into the cell while this one is encoded */
    pthread_t thread;
    int is_drawing;
    int next; /* frame */
    burnish_status status;
    burnish_error error;
    burnish_image shown; /* a copy of the frame that is encoded; without pixels: no thread */
    /* writing */
    int written;  /* frames */
    size_t taken; /* bytes of animation->out */
    int has_progress;
    burnish_status write_status;
    burnish_error write_error;
} stream;

/* Draws a frame into the cell. */
static burnish_status draw_frame(stream *s, int frame, burnish_error *error) {
    render_result *result = s->result;
    render_cell *cell = &result->cells[0];
    const burnish_render_report first = cell->report;
    if (s->drawn == frame) {
        return BURNISH_STATUS_OK;
    }
    s->drawn = frame;
    cell->camera = s->first;
    if (!result->settings->output.plays) {
        orbit(result->mesh, result->settings, frame, &cell->camera);
    }
    const burnish_status status = result->settings->output.plays
                                      ? render_draw_moment(result, cell, frame, error)
                                      : render_draw_frame(result, cell, error);
    cell->camera = s->first; /* the report is about the first frame */
    cell->report = first;
    return status;
}

static size_t image_size(const burnish_image *image) {
    return (size_t)image->width * (size_t)image->height * (size_t)image->channels;
}

/* Draws a frame, or copies it if it was drawn for the palette. */
static burnish_status make_frame(stream *s, int frame, burnish_error *error) {
    burnish_image *image = &s->result->cells[0].image;
    for (int i = 0; i < SAMPLED && s->kept_pixels && s->drawn != frame; ++i) {
        if (s->kept[i] == frame) {
            memcpy(image->pixels, s->kept_pixels + (size_t)i * image_size(image),
                   image_size(image));
            s->drawn = frame;
        }
    }
    return draw_frame(s, frame, error);
}

static void *draw_next(void *context) {
    stream *s = context;
    s->status = make_frame(s, s->next, &s->error);
    return NULL;
}

/* Drawing needs more stack than threads have by default with some C libraries (128 KiB with musl). */
static int start_drawing(stream *s) {
    enum { STACK = 1 << 20 };
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) {
        return 0;
    }
    const int is_started = pthread_attr_setstacksize(&attributes, STACK) == 0 &&
                           pthread_create(&s->thread, &attributes, draw_next, s) == 0;
    pthread_attr_destroy(&attributes);
    return is_started;
}

static void wait_for_next(stream *s) {
    if (s->is_drawing) {
        pthread_join(s->thread, NULL);
        s->is_drawing = 0;
    }
}

/* Makes a frame, and has the next one made while it is encoded. */
static burnish_status take_frame(stream *s, int frame, const burnish_image **image,
                                 burnish_error *error) {
    const render_result *result = s->result;
    burnish_status status = BURNISH_STATUS_OK;
    *image = &result->cells[0].image;
    wait_for_next(s);
    if (s->status != BURNISH_STATUS_OK) {
        *error = s->error;
        return s->status;
    }
    status = make_frame(s, frame, error);
    s->next = frame + 1;
    if (status == BURNISH_STATUS_OK && s->shown.pixels &&
        s->next < result->settings->output.frames) {
        memcpy(s->shown.pixels, (*image)->pixels, image_size(*image));
        *image = &s->shown;
        s->is_drawing = start_drawing(s);
    }
    return status;
}

/* A palette from frames of the whole turn. */
static burnish_status choose_palette(stream *s, picture_palette *palette, burnish_error *error) {
    const render_result *result = s->result;
    const int count = result->settings->output.frames;
    const int sampled = count < SAMPLED ? count : SAMPLED;
    const burnish_image *image = &result->cells[0].image;
    const size_t size = image_size(image);
    s->kept_pixels = size <= KEPT_BYTES / SAMPLED ? malloc(SAMPLED * size) : NULL;
    picture_histogram *histogram = picture_histogram_create();
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < sampled && status == BURNISH_STATUS_OK; ++i) {
        s->kept[i] = (int)((long)i * count / sampled);
        status = draw_frame(s, s->kept[i], error);
        if (status == BURNISH_STATUS_OK &&
            !(histogram && picture_histogram_add(histogram, image))) {
            status =
                cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the palette; write WebP");
        }
        if (status == BURNISH_STATUS_OK && s->kept_pixels) {
            memcpy(s->kept_pixels + (size_t)i * size, image->pixels, size);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = picture_palette_choose(histogram, result->options->background, palette, error);
    }
    picture_histogram_destroy(histogram);
    return status;
}

/* Makes and encodes the next frame, and the end of the file after the last one. */
static burnish_status encode_next(stream *s, burnish_error *error) {
    render_result *result = s->result;
    const burnish_image *image = NULL;
    const int count = result->settings->output.frames;
    burnish_status status = BURNISH_STATUS_OK;
    if (s->has_progress && s->written < count) {
        fprintf(stderr, "\rburnish: frame %d of %d\033[K", s->written + 1, count);
    }
    if (s->written < count) {
        status = take_frame(s, s->written, &image, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const double start = burnish_seconds_now();
        status = picture_animation_add(s->animation, image, error);
        result->seconds.encode += burnish_seconds_now() - start;
    }
    s->taken = 0;
    s->written += 1;
    return status;
}

/* burnish_file_source */
static size_t take_bytes(void *context, char *buffer, size_t size) {
    stream *s = context;
    const picture_bytes *out = &s->animation->out;
    while (s->taken == out->size && s->write_status == BURNISH_STATUS_OK &&
           s->written <= s->result->settings->output.frames) {
        s->write_status = encode_next(s, &s->write_error);
    }
    if (s->write_status != BURNISH_STATUS_OK) {
        return 0;
    }
    const size_t left = out->size - s->taken, count = left < size ? left : size;
    if (count > 0) {
        memcpy(buffer, out->data + s->taken, count);
    }
    s->taken += count;
    return count;
}

/* burnish_file_check */
static burnish_status finish_file(void *context, burnish_error *error) {
    const stream *s = context;
    render_result *result = s->result;
    if (s->write_status != BURNISH_STATUS_OK) {
        *error = s->write_error;
        return s->write_status;
    }
    result->encoded = burnish_seconds_now();
    result->written = 1;
    return s->ready(result, error);
}

static burnish_status write_frames(stream *s, burnish_error *error) {
    const render_settings *settings = s->result->settings;
    const char *path = render_output_path(&settings->output);
    const char *container = picture_container((picture_format)settings->output.format);
    s->taken = s->written > 0 ? 0 : s->animation->out.size; /* the header comes with the first
                                                               frame */
    burnish_status status =
        container && !sandbox_is_worker() /* the broker runs ffmpeg */
            ? picture_write_video(container, path, take_bytes, s, finish_file, error)
            : cli_file_write_stream(path, take_bytes, s, finish_file, error);
    if (s->write_status != BURNISH_STATUS_OK) { /* ffmpeg complains about a truncated stream */
        *error = s->write_error;
        status = s->write_status;
    }
    if (s->has_progress) {
        fprintf(stderr, "\r\033[K");
    }
    return status;
}

burnish_status render_write_turntable(render_result *result, burnish_file_check *ready,
                                      burnish_error *error) {
    const render_settings *settings = result->settings;
    const burnish_image *image = &result->cells[0].image;
    /* in a sandbox, loading frames can request files of the process that receives the output */
    const int is_whole = settings->output.plays && sandbox_is_worker();
    picture_palette palette;
    stream s = {.result = result,
                .ready = ready,
                .first = result->cells[0].camera,
                .has_progress = !settings->job.quiet && isatty(STDERR_FILENO)};
    const picture_animation_options options = {.format = (picture_format)settings->output.format,
                                               .width = image->width,
                                               .height = image->height,
                                               .channels = image->channels,
                                               .frames = settings->output.frames,
                                               .fps = settings->output.fps,
                                               .quality = settings->output.quality,
                                               .threads = settings->job.threads,
                                               .is_whole = is_whole,
                                               .palette = &palette};
    burnish_status status = settings->output.format == PICTURE_GIF
                                ? choose_palette(&s, &palette, error)
                                : BURNISH_STATUS_OK;
    if (status == BURNISH_STATUS_OK) {
        status = picture_animation_create(&options, &s.animation, error);
    }
    if (settings->job.threads != 1 && !settings->output.plays) {
        s.shown = *image;
        s.shown.pixels = malloc(image_size(image));
    }
    while (status == BURNISH_STATUS_OK && is_whole && s.written <= settings->output.frames) {
        status = encode_next(&s, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = write_frames(&s, error);
    }
    wait_for_next(&s);
    free(s.shown.pixels);
    picture_animation_destroy(s.animation);
    free(s.kept_pixels);
    return status;
}
