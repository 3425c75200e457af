/* The effects of keys, --do and files. */
#include "base/cli/platform.h"
#include "render/flags.h"
#include "render/settings/flag_values.h"
#include "view/show.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "view/orbit.h"

/* ---- Files ---- */

/* Opening another file than a regular one may wait for ever. */
static stamp stamp_of(const char *path) {
    struct stat info;
    if (!path || path[0] == ':' || stat(path, &info) != 0 || !S_ISREG(info.st_mode)) {
        return (stamp){.size = -1};
    }
    return (stamp){info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec, (long long)info.st_ino};
}

static int is_same(const stamp *a, const stamp *b) {
    return a->size == b->size && a->seconds == b->seconds && a->nanoseconds == b->nanoseconds &&
           a->number == b->number;
}

/* The files of the scene: its input, its environment or NULL. */
static const char *file_at(const viewer *v, int i) {
    return i == 0 ? v->scene.input : v->scene.given.shading.environment.name;
}

void viewer_mark_file(viewer *v) {
    for (int i = 0; i < 2; ++i) {
        v->shown[i] = v->seen[i] = stamp_of(file_at(v, i));
    }
}

/* Loads the scene; shows a message if it fails. */
static int load_scene(viewer *v) {
    burnish_error error;
    viewer_mark_file(v);
    if (view_scene_load(&v->scene, &error) != BURNISH_STATUS_OK) {
        viewer_show_message(v, error.text);
        return 0;
    }
    viewer_touch(v, 1);
    return 1;
}

/* Loads a changed file, or the same with another section or look. The camera stays, except in a
 * framed view. */
static void reload(viewer *v, int is_new) {
    burnish_error error;
    if (load_scene(v) && is_new && v->scene.is_framed &&
        view_scene_aim(&v->scene, v->scene.view, &error) != BURNISH_STATUS_OK) {
        viewer_show_message(v, error.text);
    }
}

void viewer_look_at_file(viewer *v) {
    int has_changed[2];
    for (int i = 0; i < 2; ++i) {
        const stamp found = stamp_of(file_at(v, i));
        has_changed[i] =
            found.size >= 0 && !is_same(&found, &v->shown[i]) && is_same(&found, &v->seen[i]);
        v->seen[i] = found;
    }
    if (has_changed[0] || has_changed[1]) {
        v->scene.environment_is_old |= has_changed[1];
        reload(v, has_changed[0]);
        if (v->is_dirty) {
            viewer_show_message(v, "The file has changed: read again");
        }
    }
}

void viewer_open(viewer *v, char *name) {
    const char *before = v->scene.input;
    const view_section section = v->scene.section;
    burnish_error error;
    v->scene.input = name;
    v->scene.section.is_on = 0;
    if (!load_scene(v)) {
        v->scene.input = before;
        v->scene.section = section;
        viewer_mark_file(v);
        v->sdl.SDL_free(name);
        return;
    }
    v->sdl.SDL_free(v->dropped);
    v->dropped = name;
    if (view_scene_aim(&v->scene, v->scene.view, &error) != BURNISH_STATUS_OK) {
        viewer_show_message(v, error.text);
    }
    viewer_set_title(v);
}

/* "part-1.png": the first unused name. */
static void name_picture(const viewer *v, char *name, size_t size) {
    const char *base = cli_base_name(v->scene.input);
    base += base[0] == ':';
    const char *dot = strrchr(base, '.');
    const int length = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    struct stat info;
    for (int i = 1; i < 10000; ++i) {
        snprintf(name, size, "%.*s-%d.png", length > 200 ? 200 : length, base, i);
        if (stat(name, &info) != 0) {
            return;
        }
    }
}

/* Saves the picture without overlays. With one lobe it is the file of `burnish render`. */
static void save_picture(viewer *v) {
    char name[512], text[600];
    burnish_error error;
    burnish_image image = {0};
    burnish_status status = v->is_still ? BURNISH_STATUS_OK : viewer_draw(v, VIEW_STILL, &error);
    uint32_t *shown = malloc(4 * (size_t)v->width * (size_t)v->height);
    const burnish_pixels pixels = {v->width, v->height, BURNISH_PIXELS_BGRA8, 4 * (size_t)v->width,
                                   (uint8_t *)shown};
    if (status == BURNISH_STATUS_OK && shown) {
        status = burnish_image_create(NULL, &image, v->width, v->height, 3, &error);
    }
    if (status != BURNISH_STATUS_OK || !shown) {
        viewer_show_message(v, shown ? error.text : "out of memory for the picture");
        free(shown);
        return;
    }
    viewer_compose(v, &pixels);
    for (size_t i = 0; i < (size_t)v->width * (size_t)v->height; ++i) {
        for (int k = 0; k < 3; ++k) {
            image.pixels[3 * i + (size_t)k] = pixels.pixels[4 * i + 2 - (size_t)k];
        }
    }
    snprintf(name, sizeof name, "%s", v->settings->output ? v->settings->output : "");
    if (!v->settings->output) {
        name_picture(v, name, sizeof name);
    }
    status = burnish_image_write_png(&image, name, &error);
    snprintf(text, sizeof text, "Saved as %s", name);
    viewer_show_message(v, status == BURNISH_STATUS_OK ? text : error.text);
    burnish_image_destroy(&image);
    free(shown);
}

/* ---- Actions ---- */

/* The lights of the look studio have no lobes. */
static void show_lobes(viewer *v) {
    if (v->scene.given.shading.look == BURNISH_LOOK_STUDIO) {
        v->scene.given.shading.look = BURNISH_LOOK_THREE_POINT;
        load_scene(v);
    }
}

static void next_lobe(viewer *v, int index, int step) {
    char name[32];
    int count = 0, at = -1;
    const char *example;
    burnish_lobe_spec_name(&v->lobes[index], name, sizeof name);
    for (; (example = burnish_lobe_spec_example((size_t)count)); ++count) {
        at = strcmp(example, name) == 0 ? count : at;
    }
    /* from a lobe that is not in the list: to the first or the last */
    const int next = at < 0 ? (step > 0 ? 0 : count - 1) : (at + step + count) % count;
    burnish_lobe_spec_parse(burnish_lobe_spec_example((size_t)next), &v->lobes[index], NULL);
    show_lobes(v);
}

static void change_section(viewer *v, int axis) {
    view_section *section = &v->scene.section;
    const view_section before = *section;
    if (!section->is_on || section->axis != axis) {
        *section = (view_section){1, axis, 1, 0.5};
    } else if (section->side > 0) {
        section->side = -1;
    } else {
        section->is_on = 0;
    }
    v->scene.is_framed = 0;
    if (!load_scene(v)) {
        *section = before;
    }
}

static void move_section(viewer *v, int step) {
    view_section *section = &v->scene.section;
    const double before = section->share;
    if (!section->is_on) {
        viewer_show_message(v, "X, Y or Z cuts the object");
        return;
    }
    section->share = fmin(fmax(section->share + 0.02 * step, 0.01), 0.99);
    if (!load_scene(v)) {
        section->share = before;
    }
}

static void change_look(viewer *v, int step) {
    int count = 0, at = 0;
    for (; render_look_words[count].name; ++count) {
        at = render_look_words[count].value == v->scene.given.shading.look ? count : at;
    }
    const cli_word *next = &render_look_words[(at + step + count) % count];
    v->scene.given.shading.look = next->value;
    if (load_scene(v)) {
        viewer_show_message(v, next->name);
    }
}

static void change_exponent(viewer *v, int step) {
    burnish_error error;
    const double was = fmax(view_scene_exponent(&v->scene), 1);
    const double next = round(8 * (log2(was) * 2 + step)) / 8; /* steps of half a power of 2 */
    const double exponent = fmin(fmax(round(exp2(next / 2)), 1), 8192);
    if (view_scene_set_exponent(&v->scene, exponent, &error) != BURNISH_STATUS_OK) {
        viewer_show_message(v, error.text);
    }
}

static void move_camera(viewer *v, const view_action_row *row) {
    double up[3];
    burnish_camera *camera = &v->scene.camera;
    view_scene_up(&v->scene, up);
    v->scene.is_framed = 0;
    switch (row->action) {
    case VIEW_ACTION_TURN:
        view_orbit(camera, up, 15 * row->value, 0);
        break;
    case VIEW_ACTION_TILT:
        view_orbit(camera, up, 0, 15 * row->value);
        break;
    case VIEW_ACTION_ZOOM:
        view_zoom(camera, row->value > 0 ? 1.25 : 0.8, 0, 0);
        break;
    default:
        view_change_projection(camera, view_scene_radius(&v->scene));
    }
}

/* Actions that do not change the picture. Returns 0 for others. */
static int act_outside(viewer *v, const view_action_row *row) {
    switch (row->action) {
    case VIEW_ACTION_SCREENSHOT:
        save_picture(v);
        break;
    case VIEW_ACTION_COMMAND:
        view_scene_print(&v->scene, &v->lobes[0]);
        viewer_show_message(v, "The command is on standard output");
        break;
    case VIEW_ACTION_FULLSCREEN:
        v->fullscreen = !v->fullscreen;
        v->sdl.SDL_SetWindowFullscreen(v->window,
                                       v->fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
        break;
    case VIEW_ACTION_TEXT:
        v->hide_text = !v->hide_text;
        break;
    case VIEW_ACTION_HELP:
        v->help = !v->help;
        break;
    case VIEW_ACTION_QUIT:
        v->quit = !(v->help && row->key == VIEW_KEY_ESCAPE);
        v->help = 0;
        break;
    default:
        return 0;
    }
    v->repaint = 1;
    return 1;
}

void viewer_act(viewer *v, const view_action_row *row) {
    burnish_error error;
    if (act_outside(v, row)) {
        return;
    }
    viewer_touch(v, 1);
    switch (row->action) {
    case VIEW_ACTION_VIEW:
        if (view_scene_aim(&v->scene, (render_view)row->value, &error) != BURNISH_STATUS_OK) {
            viewer_show_message(v, error.text);
        }
        break;
    case VIEW_ACTION_LOBE:
        next_lobe(v, 0, row->value);
        break;
    case VIEW_ACTION_OTHER_LOBE:
        next_lobe(v, 1, row->value);
        v->split |= !v->errors;
        break;
    case VIEW_ACTION_EXPONENT:
        change_exponent(v, row->value);
        break;
    case VIEW_ACTION_SPLIT:
        v->split = v->errors || !v->split;
        v->errors = 0;
        show_lobes(v);
        break;
    case VIEW_ACTION_ERRORS:
        v->errors = !v->errors;
        show_lobes(v);
        break;
    case VIEW_ACTION_SECTION:
        change_section(v, row->value);
        break;
    case VIEW_ACTION_MOVE_SECTION:
        move_section(v, row->value);
        break;
    case VIEW_ACTION_LOOK:
        change_look(v, row->value);
        break;
    case VIEW_ACTION_WIREFRAME:
        v->scene.given.shading.wireframe = !v->scene.given.shading.wireframe;
        break;
    case VIEW_ACTION_RELOAD:
        reload(v, 1);
        break;
    default:
        move_camera(v, row);
    }
}
