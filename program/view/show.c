/* Pictures and overlays. */
#include "view/show.h"
#include "base/cli/platform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "base/clock.h"

static const double slow_frame = 16; /* ms */
enum { SLOW_FRAMES = 4 };

double viewer_now(void) {
    return 1e3 * burnish_seconds_now();
}

void viewer_show_message(viewer *v, const char *text) {
    const size_t most = v->width > 300 ? (size_t)(v->width - 120) / 9 : 20;
    size_t length = strlen(text), start = 0, blank = 0;
    length = length < sizeof v->toast ? length : sizeof v->toast - 1;
    memcpy(v->toast, text, length);
    v->toast[length] = 0;
    for (size_t i = 0; i < length; ++i) {
        blank = v->toast[i] == ' ' ? i : blank;
        if (i - start > most && blank > start) {
            v->toast[blank] = '\n';
            start = blank + 1;
        }
    }
    v->toast_end = viewer_now() + TOAST;
    v->repaint = 1;
}

void viewer_touch(viewer *v, int at_once) {
    v->is_dirty = 1;
    v->moved = viewer_now() - (at_once ? REST : 0);
}

/* ---- Drawing ---- */

static burnish_pixels plane(const viewer *v, int index) {
    return (burnish_pixels){v->width, v->height, BURNISH_PIXELS_BGRA8, 4 * (size_t)v->width,
                            (uint8_t *)v->pixels[index]};
}

/* The pixels of the window. Returns 0 if their size has just changed; an event follows. */
static int window_pixels(const viewer *v, burnish_pixels *pixels) {
    const SDL_Surface *surface = v->sdl.SDL_GetWindowSurface(v->window);
    if (!surface || surface->w != v->width || surface->h != v->height) {
        return 0;
    }
    *pixels = (burnish_pixels){v->width, v->height, BURNISH_PIXELS_BGRA8, (size_t)surface->pitch,
                               surface->pixels};
    return 1;
}

/* Doubles a picture of half the size, which can be at the start of the other one. */
static void enlarge(const uint32_t *half, const burnish_pixels *pixels) {
    const size_t width = (size_t)(pixels->width + 1) / 2;
    for (int y = pixels->height - 1; y >= 0; --y) {
        const uint32_t *from = half + (size_t)(y / 2) * width;
        uint32_t *to = (uint32_t *)(void *)(pixels->pixels + (size_t)y * pixels->stride);
        for (int x = pixels->width - 1; x >= 0; --x) {
            to[x] = from[x / 2];
        }
    }
}

static burnish_status draw_lobe(viewer *v, int index, view_quality quality,
                                const burnish_pixels *pixels, burnish_error *error) {
    burnish_pixels half = plane(v, index);
    if (quality != VIEW_COARSE) {
        return view_scene_draw(&v->scene, &v->lobes[index], quality, pixels, error);
    }
    half.width = (v->width + 1) / 2;
    half.height = (v->height + 1) / 2;
    half.stride = 4 * (size_t)half.width;
    const burnish_status status =
        view_scene_draw(&v->scene, &v->lobes[index], quality, &half, error);
    enlarge(v->pixels[index], pixels);
    return status;
}

/* Only several slow frames in a row count, because other programs can delay single frames. */
static void adapt(viewer *v, double took) {
    v->slow_frames = took > slow_frame ? v->slow_frames + 1 : 0;
    if (v->slow_frames >= SLOW_FRAMES && v->moving < VIEW_COARSE) {
        ++v->moving;
        v->slow_frames = 0;
    }
}

burnish_status viewer_draw(viewer *v, view_quality quality, burnish_error *error) {
    const double start = viewer_now();
    const burnish_pixels a = plane(v, 0), b = plane(v, 1), map = plane(v, 2);
    burnish_pixels window;
    v->is_in_window = quality != VIEW_STILL && !v->split && !v->errors && window_pixels(v, &window);
    burnish_status status = draw_lobe(v, 0, quality, v->is_in_window ? &window : &a, error);
    if (status == BURNISH_STATUS_OK && (v->split || v->errors)) {
        status = draw_lobe(v, 1, quality, &b, error);
    }
    if (status == BURNISH_STATUS_OK && v->errors) {
        v->difference = view_paint_differences(&a, &b, &map, &v->scale);
    }
    const double took = viewer_now() - start;
    *(quality == VIEW_STILL ? &v->still_ms : &v->frame_ms) = took;
    if (quality == v->moving) {
        adapt(v, took);
    }
    return status;
}

void viewer_compose(const viewer *v, const burnish_pixels *to) {
    const int column = v->errors  ? v->width
                       : v->split ? (int)(v->divider * v->width + 0.5)
                                  : v->width;
    for (int y = 0; y < v->height; ++y) {
        const size_t row = (size_t)y * (size_t)v->width;
        uint8_t *line = to->pixels + (size_t)y * to->stride;
        memcpy(line, v->pixels[v->errors ? 2 : 0] + row, 4 * (size_t)column);
        if (column < v->width) {
            memcpy(line + 4 * (size_t)column, v->pixels[1] + row + column,
                   4 * (size_t)(v->width - column));
        }
    }
}

static void write_count(size_t count, char *text, size_t size) {
    char digits[32];
    size_t used = 0;
    const int length = snprintf(digits, sizeof digits, "%zu", count);
    for (int i = 0; i < length && used + 2 < size; ++i) {
        if (i > 0 && (length - i) % 3 == 0) {
            text[used++] = ',';
        }
        text[used++] = digits[i];
    }
    text[used] = 0;
}

static void paint_facts(viewer *v, const burnish_pixels *window) {
    char text[600], count[40], lobe[32], extra[120] = "";
    const view_section *section = &v->scene.section;
    write_count(v->scene.triangles, count, sizeof count);
    burnish_lobe_spec_name(&v->lobes[0], lobe, sizeof lobe);
    if (section->is_on) {
        const int axis = section->axis;
        const double *low = v->scene.low, *high = v->scene.high;
        snprintf(extra, sizeof extra, "\ncut at %c = %.4g", "xyz"[axis],
                 low[axis] + section->share * (high[axis] - low[axis]));
    }
    snprintf(text, sizeof text, "%.200s\n%s triangles\n%s%sn = %.4g%s",
             cli_base_name(v->scene.input), count, v->split || v->errors ? "" : lobe,
             v->split || v->errors ? "" : ", ", view_scene_exponent(&v->scene), extra);
    view_paint_panel(window, VIEW_TOP_LEFT, 12, 12, text, 1);
    if (v->is_still) {
        snprintf(text, sizeof text, "%.1f ms", v->still_ms);
    } else {
        snprintf(text, sizeof text, "%.1f ms, %.0f a second", v->frame_ms,
                 1000 / fmax(v->frame_ms, 0.01));
    }
    view_paint_panel(window, VIEW_TOP_RIGHT, v->width - 12, 12, text, 0);
    if (!v->toast[0] && !v->errors) {
        view_paint_panel(window, VIEW_BOTTOM_RIGHT, v->width - 12, v->height - 12, "? keys", 0);
    }
}

static void paint_errors(const viewer *v, const burnish_pixels *window) {
    char names[2][32], text[200];
    const view_difference *d = &v->difference;
    burnish_lobe_spec_name(&v->lobes[0], names[0], sizeof names[0]);
    burnish_lobe_spec_name(&v->lobes[1], names[1], sizeof names[1]);
    if (d->pixels == 0) {
        snprintf(text, sizeof text, "%s minus %s: no pixel differs", names[1], names[0]);
    } else {
        snprintf(text, sizeof text, "%s minus %s in 8-bit values: at most %d, PSNR %.1f dB",
                 names[1], names[0], d->largest, 20 * log10(255 / d->rmse));
    }
    view_paint_scale(window, v->scale, text);
}

static void paint_split(const viewer *v, const burnish_pixels *window) {
    const int x = (int)(v->divider * v->width + 0.5);
    view_paint_divider(window, x);
    for (int i = 0; i < 2 && !v->hide_text; ++i) {
        char name[32];
        burnish_lobe_spec_name(&v->lobes[i], name, sizeof name);
        view_paint_panel(window, i == 0 ? VIEW_BOTTOM_RIGHT : VIEW_BOTTOM_LEFT,
                         i == 0 ? x - 14 : x + 14, v->height - 12, name, 0);
    }
}

void viewer_present(viewer *v) {
    burnish_pixels window;
    if (!window_pixels(v, &window)) {
        return;
    }
    if (!v->is_in_window) {
        viewer_compose(v, &window);
    }
    if (v->split && !v->errors) {
        paint_split(v, &window);
    }
    if (!v->hide_text) {
        paint_facts(v, &window);
    }
    if (v->errors && !v->hide_text) {
        paint_errors(v, &window);
    }
    if (v->toast[0]) {
        view_paint_panel(&window, VIEW_BOTTOM_MIDDLE, v->width / 2,
                         v->height - 12 - (v->errors ? 90 : 0), v->toast, 0);
    }
    if (v->help) {
        view_paint_help(&window);
    }
    v->sdl.SDL_UpdateWindowSurface(v->window);
    v->repaint = 0;
}

void viewer_set_title(viewer *v) {
    char title[300];
    snprintf(title, sizeof title, "%.250s - burnish", cli_base_name(v->scene.input));
    v->sdl.SDL_SetWindowTitle(v->window, title);
}
