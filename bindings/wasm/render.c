/* Meshes and their pictures. */
#include <stdio.h>
#include <string.h>

#include "base/cli/values.h"
#include "base/wasm/module.h"
#include "session.h"

static burnish_camera camera_shown; /* of open_camera: one caller at a time */

WASM_EXPORT(session_create) session *open_create(void);
WASM_EXPORT(session_destroy) void open_destroy(session *s);
WASM_EXPORT(session_offer)
int open_offer(session *s, const char *name, const void *bytes, size_t size);
WASM_EXPORT(session_open)
int open_load(session *s, const char *name, const void *bytes, size_t size,
              const session_option *options, size_t count, session_naming naming);
WASM_EXPORT(session_draw)
int open_draw(session *s, const session_option *options, size_t count, session_naming naming);
WASM_EXPORT(flag_row) const char *flag_row(size_t index);
WASM_EXPORT(session_pixels) const uint8_t *open_pixels(const session *s);
WASM_EXPORT(session_rgba) void open_rgba(const session *s, uint8_t *to);
WASM_EXPORT(session_number) double open_number(const session *s, int which);
WASM_EXPORT(session_warning) const char *open_warning(const session *s, size_t index);
WASM_EXPORT(session_camera) const burnish_camera *open_camera(const session *s);
WASM_EXPORT(session_contents) char *open_contents(const session *s);
WASM_EXPORT(format_extensions) const char *format_extensions(int index);

session *open_create(void) {
    return session_create(NULL);
}

void open_destroy(session *s) {
    session_destroy(s);
}

int open_offer(session *s, const char *name, const void *bytes, size_t size) {
    return session_offer(s, name, bytes, size);
}

/* Loads bytes, or a built-in object such as ":teapot", into a session without a mesh. Returns 1, or
 * 0 after an error. */
int open_load(session *s, const char *name, const void *bytes, size_t size,
              const session_option *options, size_t count, session_naming naming) {
    return session_open(s, name, name[0] == ':' ? NULL : bytes, size,
                        (session_options){options, count, naming},
                        module_error()) == BURNISH_STATUS_OK;
}

/* Draws the session's mesh. Returns 1, or 0 after an error; can be called again after either. */
int open_draw(session *s, const session_option *options, size_t count, session_naming naming) {
    return session_draw(s, (session_options){options, count, naming}, module_error()) ==
           BURNISH_STATUS_OK;
}

/* Flag number `index` that is an option: its name, what it is an option of (a sum of
 * cli_phase), the kind of its value ("" for a switch, "?" if it can be omitted, "+" if values
 * add up), its other names and its words, with tabs between them. NULL past the last. */
const char *flag_row(size_t index) {
    static char row[512];
    char words[256] = "";
    unsigned stages;
    const cli_flag *flag = session_flag_at(index, &stages);
    if (!flag) {
        return NULL;
    }
    if (flag->words) {
        cli_word_list(flag->words, words, sizeof words);
    }
    snprintf(row, sizeof row, "%s	%u	%s	%s	%s", flag->name, stages,
             !flag->value     ? ""
             : flag->repeats  ? "+"
             : flag->optional ? "?"
                              : "=",
             flag->also ? flag->also : "", words);
    return row;
}

/* JSON, to be released; NULL: out of memory. */
char *open_contents(const session *s) {
    return session_contents(s);
}

/* Line number `index`, NULL past the last. */
const char *open_warning(const session *s, size_t index) {
    return session_warning(s, index);
}

/* Rows from the top without gaps, valid until the next picture. */
const uint8_t *open_pixels(const session *s) {
    return session_image(s)->pixels;
}

/* The same with four channels; alpha is 255 if the picture has none. */
void open_rgba(const session *s, uint8_t *to) {
    const burnish_image *image = session_image(s);
    const size_t count = (size_t)image->width * (size_t)image->height;
    const uint8_t *from = image->pixels;
    if (image->channels == 4) {
        memcpy(to, from, 4 * count);
        return;
    }
    for (size_t i = 0; i < count; ++i, from += 3, to += 4) {
        uint32_t pixel = 0; /* WebAssembly is little-endian */
        memcpy(&pixel, from, 3);
        pixel |= 0xff000000u;
        memcpy(to, &pixel, sizeof pixel);
    }
}

const burnish_camera *open_camera(const session *s) {
    camera_shown = session_camera(s);
    return &camera_shown;
}

/* Numbers of the picture and the mesh, in the order of wasm.js. */
double open_number(const session *s, int which) {
    const burnish_mesh_view *view = burnish_mesh_get_view(session_mesh(s));
    const burnish_image *image = session_image(s);
    const uint64_t hash = session_hash(s);
    double low[3], high[3];
    session_bounds(s, low, high);
    const double numbers[] = {image->width,
                              image->height,
                              image->channels,
                              (double)(hash >> 32),
                              (double)(uint32_t)hash,
                              (double)session_report(s)->covered_pixels,
                              (double)view->triangle_count,
                              (double)view->vertex_count,
                              low[0],
                              low[1],
                              low[2],
                              high[0],
                              high[1],
                              high[2],
                              session_up_number(s)};
    return which >= 0 && (size_t)which < sizeof numbers / sizeof *numbers ? numbers[which] : 0;
}

/* File extensions of format number `index`, "" for none; NULL past the last. */
const char *format_extensions(int index) {
    const burnish_format_info *info = burnish_format_get_info((burnish_format)index);
    return info ? info->extensions : NULL;
}
