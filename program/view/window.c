/* The window, its events and its loop. */
#include "view/view.h"

#if BURNISH_HAS_VIEW

#include "view/show.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "view/orbit.h"

/* ---- Events ---- */

static int key_of(SDL_Keycode code) {
    static const struct {
        SDL_Keycode code;
        int key;
    } keys[] = {
        {SDLK_LEFT, VIEW_KEY_LEFT},
        {SDLK_RIGHT, VIEW_KEY_RIGHT},
        {SDLK_UP, VIEW_KEY_UP},
        {SDLK_DOWN, VIEW_KEY_DOWN},
        {SDLK_HOME, VIEW_KEY_HOME},
        {SDLK_PAGEUP, VIEW_KEY_PAGE_UP},
        {SDLK_PAGEDOWN, VIEW_KEY_PAGE_DOWN},
        {SDLK_ESCAPE, VIEW_KEY_ESCAPE},
        {SDLK_F1, VIEW_KEY_F1},
        {SDLK_F5, VIEW_KEY_F5},
        {SDLK_F11, VIEW_KEY_F11},
        {SDLK_KP_PLUS, '+'},
        {SDLK_KP_MINUS, '-'},
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        if (keys[i].code == code) {
            return keys[i].key;
        }
    }
    return code < 128 ? code : 0;
}

static void press(viewer *v, const SDL_Keysym *pressed) {
    const int shift = (pressed->mod & KMOD_SHIFT) != 0;
    int key = key_of(pressed->sym);
    if (pressed->mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) {
        v->quit |= (pressed->mod & KMOD_CTRL) && key == 'q';
        return;
    }
    const view_action_row *row = view_find_key(key, shift);
    if (!row && shift) { /* characters that need Shift on some keyboards */
        key = key == '/' ? '?' : key == '=' ? '+' : key;
        row = view_find_key(key, 0);
    } else if (!row && key == '=') {
        row = view_find_key('+', 0);
    }
    if (row) {
        viewer_act(v, row);
    }
}

static int near_divider(const viewer *v, int x) {
    return v->split && !v->errors && abs(x - (int)(v->divider * v->width)) <= 8;
}

static void press_button(viewer *v, const SDL_MouseButtonEvent *button) {
    v->drag = button->button != SDL_BUTTON_LEFT ? DRAG_PAN
              : near_divider(v, button->x)      ? DRAG_DIVIDER
                                                : DRAG_ORBIT;
}

static void move_mouse(viewer *v, const SDL_MouseMotionEvent *motion, int shift) {
    double up[3];
    const double size = v->height;
    view_scene_up(&v->scene, up);
    if (v->drag == DRAG_NONE) {
        v->sdl.SDL_SetCursor(v->cursors[near_divider(v, motion->x)]);
        return;
    }
    if (v->drag == DRAG_DIVIDER) {
        v->divider = fmin(fmax((double)motion->x / v->width, 0), 1);
        v->repaint = 1;
        return;
    }
    if (v->drag == DRAG_PAN || shift) {
        view_pan(&v->scene.camera, -motion->xrel / size, motion->yrel / size);
    } else { /* the height of the window is half a turn */
        view_orbit(&v->scene.camera, up, -180 * motion->xrel / size, 180 * motion->yrel / size);
    }
    v->scene.is_framed = 0;
    viewer_touch(v, 0);
}

static void turn_wheel(viewer *v, const SDL_MouseWheelEvent *wheel) {
    const double size = v->height;
    view_zoom(&v->scene.camera, pow(1.15, (double)wheel->preciseY),
              (wheel->mouseX - v->width / 2.0) / size, (v->height / 2.0 - wheel->mouseY) / size);
    v->scene.is_framed = 0;
    viewer_touch(v, 0);
}

/* Pixels for the size of the window's surface. */
static burnish_status resize(viewer *v, burnish_error *error) {
    const SDL_Surface *surface = v->sdl.SDL_GetWindowSurface(v->window);
    if (!surface || surface->format->BytesPerPixel != 4 || surface->format->Bmask != 0xff ||
        surface->w > BURNISH_IMAGE_MAX_SIZE || surface->h > BURNISH_IMAGE_MAX_SIZE) {
        return cli_fail(error, BURNISH_STATUS_READ,
                        "view: the window has no pixels of 32 bits: %s; use another display",
                        v->sdl.SDL_GetError());
    }
    if (surface->w == v->width && surface->h == v->height) {
        v->repaint = 1;
        return BURNISH_STATUS_OK;
    }
    v->width = v->scene.given.picture.size[0] = surface->w;
    v->height = v->scene.given.picture.size[1] = surface->h;
    for (int i = 0; i < 3; ++i) {
        free(v->pixels[i]);
        v->pixels[i] = calloc((size_t)v->width * (size_t)v->height, 4);
        if (!v->pixels[i]) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "view: out of memory for %d x %d pixels",
                            v->width, v->height);
        }
    }
    viewer_touch(v, 0);
    return v->scene.is_framed ? view_scene_aim(&v->scene, v->scene.view, error) : BURNISH_STATUS_OK;
}

static burnish_status take_event(viewer *v, const SDL_Event *event, int shift,
                                 burnish_error *error) {
    switch (event->type) {
    case SDL_QUIT:
        v->quit = 1;
        break;
    case SDL_KEYDOWN:
        press(v, &event->key.keysym);
        break;
    case SDL_MOUSEBUTTONDOWN:
        press_button(v, &event->button);
        break;
    case SDL_MOUSEBUTTONUP:
        v->drag = DRAG_NONE;
        break;
    case SDL_MOUSEMOTION:
        move_mouse(v, &event->motion, shift);
        break;
    case SDL_MOUSEWHEEL:
        turn_wheel(v, &event->wheel);
        break;
    case SDL_DROPFILE:
        viewer_open(v, event->drop.file);
        break;
    case SDL_WINDOWEVENT:
        if (event->window.event == SDL_WINDOWEVENT_SIZE_CHANGED) {
            return resize(v, error);
        }
        v->repaint |= event->window.event == SDL_WINDOWEVENT_EXPOSED;
        break;
    default:
        break;
    }
    return BURNISH_STATUS_OK;
}

/* Whether an event is pending, while a still picture is drawn. */
static int is_awaited(void *user_data) {
    static const SDL_EventType ranges[][2] = {{SDL_QUIT, SDL_QUIT},
                                              {SDL_KEYDOWN, SDL_KEYDOWN},
                                              {SDL_MOUSEBUTTONDOWN, SDL_MOUSEBUTTONDOWN},
                                              {SDL_MOUSEWHEEL, SDL_MOUSEWHEEL},
                                              {SDL_DROPFILE, SDL_DROPFILE}};
    viewer *v = user_data;
    v->sdl.SDL_PumpEvents();
    int waiting =
        v->drag != DRAG_NONE &&
        v->sdl.SDL_PeepEvents(NULL, 0, SDL_PEEKEVENT, SDL_MOUSEMOTION, SDL_MOUSEMOTION) > 0;
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges && !waiting; ++i) {
        SDL_Event event;
        waiting = v->sdl.SDL_PeepEvents(&event, 1, SDL_PEEKEVENT, ranges[i][0], ranges[i][1]) > 0;
    }
    return waiting;
}

/* ---- The loop ---- */

/* Draws the picture if necessary. */
static burnish_status update(viewer *v, burnish_error *error) {
    const double now = viewer_now();
    burnish_status status = BURNISH_STATUS_OK;
    if (v->toast[0] && now >= v->toast_end) {
        v->toast[0] = 0;
        v->repaint = 1;
    }
    if (v->is_dirty || (v->repaint && v->is_in_window)) {
        if (v->is_still && v->moving > VIEW_PLAIN) { /* a movement begins: try a higher quality */
            --v->moving;
        }
        status = viewer_draw(v, v->moving, error);
        v->is_dirty = 0;
        v->is_still = v->moving == VIEW_STILL;
        v->repaint = 1;
    } else if (!v->is_still && now >= v->moved + REST) {
        v->scene.may_stop = 1;
        status = viewer_draw(v, VIEW_STILL, error);
        v->scene.may_stop = 0;
        if (status == BURNISH_STATUS_CANCELLED) {
            v->moved = viewer_now();
            status = viewer_draw(v, v->moving, error); /* which has overwritten some pixels */
        } else {
            v->is_still = 1;
        }
        v->repaint = 1;
    }
    if (status == BURNISH_STATUS_OK && v->repaint) {
        viewer_present(v);
    }
    return status;
}

static int wait_ms(const viewer *v) {
    if (v->is_dirty || v->repaint || (v->actions && v->is_still)) {
        return 0;
    }
    const double left = v->is_still ? POLL : v->moved + REST - viewer_now();
    return left < 0 ? 0 : left > POLL ? POLL : (int)left + 1;
}

static burnish_status run_window(viewer *v, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    double looked = viewer_now();
    int shift = 0;
    while (!v->quit && status == BURNISH_STATUS_OK) {
        SDL_Event event;
        int is_there = v->sdl.SDL_WaitEventTimeout(&event, wait_ms(v));
        for (; is_there && status == BURNISH_STATUS_OK; is_there = v->sdl.SDL_PollEvent(&event)) {
            if (event.type == SDL_KEYDOWN || event.type == SDL_KEYUP) {
                shift = (event.key.keysym.mod & KMOD_SHIFT) != 0;
            }
            status = take_event(v, &event, shift, error);
        }
        if (viewer_now() - looked > POLL) {
            viewer_look_at_file(v);
            looked = viewer_now();
        }
        if (status == BURNISH_STATUS_OK) {
            status = update(v, error);
        }
        if (v->actions && v->is_still && !v->is_dirty) {
            viewer_act(v, view_next_word(&v->actions));
        }
    }
    return status;
}

static int compare_reals(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of all threads together, milliseconds. */
static double processor_ms(void) {
    struct timespec used;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return 1e3 * (double)used.tv_sec + 1e-6 * (double)used.tv_nsec;
}

static void print_times(const viewer *v, double *times, view_quality quality, double processor) {
    const int count = v->settings->frames;
    static const char *const how[] = {[VIEW_STILL] = "",
                                      [VIEW_PLAIN] = "no ambient occlusion",
                                      [VIEW_FAST] = "one sample per pixel",
                                      [VIEW_COARSE] = "one sample for 4 pixels"};
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        sum += times[i];
    }
    qsort(times, (size_t)count, sizeof *times, compare_reals);
    printf("%d frames of %d x %d: median %.1f ms, 99 of 100 within %.1f ms, %.0f per second; %.1f "
           "ms of processor time each; %s\n",
           count, v->width, v->height, times[count / 2], times[(size_t)count * 99 / 100],
           1000 * count / sum, processor / count, how[quality]);
}

/* SDL's last resort is an invisible window in memory, which is only useful on request. */
static int is_invisible(const viewer *v) {
    const char *driver = v->sdl.SDL_GetCurrentVideoDriver();
    return !getenv("SDL_VIDEODRIVER") && driver && strcmp(driver, "offscreen") == 0;
}

/* One turn, as dragging does, and the time of each frame until it is in the window. */
static burnish_status measure_turn(viewer *v, burnish_error *error) {
    const int count = v->settings->frames, before = 30; /* warm-up frames */
    double *times = malloc((size_t)count * sizeof *times), up[3], processor = 0;
    burnish_status status =
        times ? BURNISH_STATUS_OK
              : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %d times", count);
    view_quality quality = v->moving;
    view_scene_up(&v->scene, up);
    for (int i = -before; i < count && status == BURNISH_STATUS_OK; ++i) {
        const double start = viewer_now();
        processor = i == 0 ? processor_ms() : processor;
        v->sdl.SDL_PumpEvents();
        view_orbit(&v->scene.camera, up, 360.0 / count, 0);
        quality = i > 0 ? quality : v->moving;
        status = viewer_draw(v, quality, error);
        viewer_present(v);
        if (i >= 0) {
            times[i] = viewer_now() - start;
        }
    }
    if (status == BURNISH_STATUS_OK) {
        print_times(v, times, quality, processor_ms() - processor);
    }
    free(times);
    return status;
}

static burnish_status open_window(viewer *v, burnish_error *error) {
    burnish_status status = view_load_sdl(&v->sdl, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* Pixels are copied to the window without a GPU or an emulation. */
    v->sdl.SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    v->sdl.SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    v->sdl.SDL_SetHint(SDL_HINT_APP_NAME, "burnish");
    v->sdl.SDL_SetHint("SDL_VIDEO_X11_WMCLASS", "burnish");
    v->sdl.SDL_SetHint("SDL_VIDEO_WAYLAND_WMCLASS", "burnish");
#ifndef _WIN32
    setenv("DBUS_SESSION_BUS_ADDRESS",
           "disabled:", 0); /* SDL would start a bus, which outlives it */
#endif
    const int failed = v->sdl.SDL_Init(SDL_INIT_VIDEO) != 0;
    if (failed || is_invisible(v)) {
        return cli_fail(error, BURNISH_STATUS_READ,
                        "view: no window can be opened: %s; use burnish render without a display",
                        failed ? v->sdl.SDL_GetError() : "there is no display");
    }
    const int *size = v->scene.given.picture.size;
    v->window = v->sdl.SDL_CreateWindow("burnish", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED,
                                        size[0], size[1], SDL_WINDOW_RESIZABLE);
    if (!v->window) {
        return cli_fail(error, BURNISH_STATUS_READ, "view: no window can be opened: %s",
                        v->sdl.SDL_GetError());
    }
    v->sdl.SDL_SetWindowMinimumSize(v->window, size[0] < 240 ? size[0] : 240,
                                    size[1] < 160 ? size[1] : 160);
    v->cursors[0] = v->sdl.SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_ARROW);
    v->cursors[1] = v->sdl.SDL_CreateSystemCursor(SDL_SYSTEM_CURSOR_SIZEWE);
    viewer_set_title(v);
    return resize(v, error);
}

/* The window is destroyed with the process. Under X11, SDL sends itself messages through a second
 * connection while it waits; a message that arrives after the window was destroyed would end the
 * program with an X error. */
static void close_window(viewer *v) {
    if (v->sdl.SDL_free) {
        v->sdl.SDL_free(v->dropped);
    }
    for (int i = 0; i < 3; ++i) {
        free(v->pixels[i]);
    }
    view_scene_end(&v->scene);
}

burnish_status view_window(const view_settings *settings, burnish_error *error) {
    viewer v = {.settings = settings,
                .moving = VIEW_PLAIN,
                .divider = 0.5,
                .actions = settings->actions,
                .lobes = {settings->render.shading.lobes.items[0]}};
    const render_view first = settings->render.picture.views.count > 0
                                  ? settings->render.picture.views.items[0]
                                  : VIEW_FREE;
    v.scene = (view_scene){.given = settings->render,
                           .input = settings->render.input.name,
                           .interrupted = is_awaited,
                           .user_data = &v};
    v.scene.given.camera.same_scale = 0;
    if (settings->render.shading.lobes.count > 1) {
        v.lobes[1] = settings->render.shading.lobes.items[1];
        v.split = 1;
    } else {
        burnish_lobe_spec_parse("power", &v.lobes[1], NULL);
    }
    burnish_status status = view_scene_begin(&v.scene, error);
    if (status == BURNISH_STATUS_OK) {
        viewer_mark_file(&v);
        status = view_scene_load(&v.scene, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = view_scene_aim(&v.scene, first, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = open_window(&v, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = settings->frames > 0 ? measure_turn(&v, error) : run_window(&v, error);
    }
    close_window(&v);
    return status;
}

#else

#include "base/cli/options.h"

burnish_status view_window(const view_settings *settings, burnish_error *error) {
    (void)settings;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "view: this program was built without SDL2; install libsdl2-dev and build "
                    "again, or use burnish render");
}

#endif
