/* What `burnish render` tells: JSON, times, warnings. */
#include "render/report.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/camera.h"

void render_result_warn(render_result *result, int printed, const char *format, ...) {
    burnish_error line;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line.text, sizeof line.text, format, arguments);
    va_end(arguments);
    cli_clean(line.text);
    if (printed && !result->settings->quiet) {
        cli_warn(line.text);
    }
    char **grown = realloc(result->warnings, (result->warning_count + 1) * sizeof *grown);
    char *copy = strdup(line.text);
    if (grown) {
        result->warnings = grown;
    }
    if (!grown || !copy) {
        free(copy); /* the line has been printed; only the JSON lacks it */
        return;
    }
    result->warnings[result->warning_count++] = copy;
}

/* Adds an item to an object; a NULL item (out of memory) makes *failed 1. */
static void add(cJSON *object, const char *key, cJSON *item, int *failed) {
    if (!item || !cJSON_AddItemToObject(object, key, item)) {
        cJSON_Delete(item);
        *failed = 1;
    }
}

/* The shortest decimal that reads back as the same double. The program never leaves the C locale.
 */
static cJSON *real(double value) {
    char text[40];
    for (int digits = 6; digits <= 17; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    return value - value == 0 ? cJSON_CreateRaw(text) : cJSON_CreateNull();
}

/* The same for a float: 1.1f is written 1.1. */
static cJSON *single(float value) {
    char text[40];
    for (int digits = 6; digits <= 9; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            break;
        }
    }
    return value - value == 0 ? cJSON_CreateRaw(text) : cJSON_CreateNull();
}

/* Length of the UTF-8 sequence at text (RFC 3629: no overlong forms, no surrogates), 0 for none. */
static size_t sequence_length(const unsigned char *text) {
    unsigned char first = text[0];
    if (first < 0x80) {
        return 1;
    }
    size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    unsigned char low = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
    unsigned char high = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
    if (first < 0xC2 || first > 0xF4 || text[1] < low || text[1] > high) {
        return 0;
    }
    for (size_t i = 2; i < length; ++i) {
        if ((text[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    return length;
}

/* A string; bytes that are no UTF-8, as file names may hold, become '?': JSON has no other text. */
static cJSON *string(const char *text) {
    char *copy = strdup(text);
    size_t at = 0;
    while (copy && copy[at]) {
        size_t length = sequence_length((const unsigned char *)copy + at);
        if (length == 0) {
            copy[at] = '?';
        }
        at += length > 0 ? length : 1;
    }
    cJSON *item = copy ? cJSON_CreateString(copy) : NULL;
    free(copy);
    return item;
}

static cJSON *count(size_t value) {
    char text[24];
    snprintf(text, sizeof text, "%zu", value);
    return cJSON_CreateRaw(text);
}

/* Seconds to the microsecond: more digits are noise. */
static cJSON *duration(double seconds) {
    char text[40];
    snprintf(text, sizeof text, "%.6f", seconds);
    return cJSON_CreateRaw(text);
}

static cJSON *hash_text(uint64_t hash) {
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    return cJSON_CreateString(text);
}

/* An array of the `size` items that make(values, i) gives. */
static cJSON *array_of(size_t size, cJSON *(*make)(const void *values, size_t index),
                       const void *values) {
    cJSON *array = cJSON_CreateArray();
    for (size_t i = 0; array && i < size; ++i) {
        cJSON *item = make(values, i);
        if (!item || !cJSON_AddItemToArray(array, item)) {
            cJSON_Delete(item);
            cJSON_Delete(array);
            return NULL;
        }
    }
    return array;
}

static cJSON *real_at(const void *values, size_t i) {
    return real(((const double *)values)[i]);
}
static cJSON *single_at(const void *values, size_t i) {
    return single(((const float *)values)[i]);
}
static cJSON *integer_at(const void *values, size_t i) {
    return cJSON_CreateNumber(((const int *)values)[i]);
}
static cJSON *text_at(const void *values, size_t i) {
    return string(((char *const *)values)[i]);
}

static cJSON *camera_object(const burnish_camera *camera, int *failed) {
    cJSON *object = cJSON_CreateObject();
    add(object, "position", array_of(3, real_at, camera->position), failed);
    add(object, "focal_point", array_of(3, real_at, camera->focal_point), failed);
    add(object, "view_up", array_of(3, real_at, camera->view_up), failed);
    add(object, "view_angle", real(camera->view_angle), failed);
    add(object, "orthographic_height", real(camera->orthographic_height), failed);
    return object;
}

static int compare_floats(const void *a, const void *b) {
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The different exponents of all materials, ascending. */
static cJSON *exponents_array(const burnish_mesh *scene) {
    size_t size = burnish_mesh_material_count(scene), kept = 0;
    float *values = malloc(size * sizeof *values);
    if (!values) {
        return NULL;
    }
    for (size_t i = 0; i < size; ++i) {
        values[i] = burnish_mesh_material(scene, i)->exponent;
    }
    qsort(values, size, sizeof *values, compare_floats);
    for (size_t i = 0; i < size; ++i) {
        if (i == 0 || values[i] != values[kept - 1]) {
            values[kept++] = values[i];
        }
    }
    cJSON *array = array_of(kept, single_at, values);
    free(values);
    return array;
}

/* The keys that a single picture and a cell share. */
static void add_picture(cJSON *object, const render_cell *cell, int *failed) {
    char lobe[32];
    burnish_lobe_spec_name(&cell->lobe, lobe, sizeof lobe);
    add(object, "triangles_drawn", count(cell->report.triangles_drawn), failed);
    add(object, "covered_pixels", count(cell->report.covered_pixels), failed);
    add(object, "pixel_bounds", array_of(4, integer_at, cell->report.bounds), failed);
    add(object, "camera", camera_object(&cell->camera, failed), failed);
    add(object, "lobe", cJSON_CreateString(lobe), failed);
}

static void add_cells(cJSON *root, const render_result *result, int *failed) {
    cJSON *cells = cJSON_CreateArray();
    for (size_t i = 0; i < result->cell_count; ++i) {
        const render_cell *cell = &result->cells[i];
        cJSON *object = cJSON_CreateObject();
        add(object, "row", count(i / (size_t)result->columns), failed);
        add(object, "column", count(i % (size_t)result->columns), failed);
        if (cell->view != VIEW_FREE) {
            add(object, "view", cJSON_CreateString(render_view_name(cell->view)), failed);
        }
        add(object, "width", cJSON_CreateNumber(cell->image.width), failed);
        add(object, "height", cJSON_CreateNumber(cell->image.height), failed);
        add_picture(object, cell, failed);
        add(object, "blank", cJSON_CreateBool(cell->report.covered_pixels == 0), failed);
        add(object, "hash", hash_text(cell->hash), failed);
        if (!object || !cJSON_AddItemToArray(cells, object)) {
            cJSON_Delete(object);
            *failed = 1;
        }
    }
    add(root, "cells", cells, failed);
}

static void add_scene(cJSON *root, const render_result *result, int *failed) {
    const burnish_format_info *format =
        burnish_format_get_info(burnish_mesh_get_info(result->scene)->format);
    const burnish_mesh_view *mesh = burnish_mesh_get_view(result->scene);
    cJSON *box = cJSON_CreateObject();
    add(root, "input", string(result->settings->input), failed);
    add(root, "format", cJSON_CreateString(format->name), failed);
    add(root, "output", result->written ? string(result->settings->output) : cJSON_CreateNull(),
        failed);
    add(root, "width", cJSON_CreateNumber(result->picture->width), failed);
    add(root, "height", cJSON_CreateNumber(result->picture->height), failed);
    add(root, "triangles", count(mesh->triangle_count), failed);
    add(root, "vertices", count(mesh->vertex_count), failed);
    add(root, "materials", count(burnish_mesh_material_count(result->scene)), failed);
    add(root, "exponents", exponents_array(result->scene), failed);
    add(box, "min", array_of(3, single_at, mesh->bounds_min), failed);
    add(box, "max", array_of(3, single_at, mesh->bounds_max), failed);
    add(root, "bounding_box", box, failed);
    add(root, "up", cJSON_CreateString(render_up_name(result->scene, result->settings)), failed);
}

static void add_run(cJSON *root, const render_result *result, int *failed) {
    const render_seconds *seconds = &result->seconds;
    const burnish_render_options *options = result->options;
    cJSON *times = cJSON_CreateObject();
    add(root, "equation",
        cJSON_CreateString(options->specular_model == BURNISH_SPECULAR_BLINN ? "blinn" : "phong"),
        failed);
    add(root, "viewer", cJSON_CreateString(options->local_viewer ? "local" : "distant"), failed);
    add(root, "lights", cJSON_CreateNumber(options->light_count), failed);
    add(root, "samples", cJSON_CreateNumber(options->samples), failed);
    add(root, "threads", cJSON_CreateNumber(result->cells[0].report.threads), failed);
    add(times, "start", duration(seconds->start), failed);
    add(root, "isa", cJSON_CreateString(burnish_isa_name(result->cells[0].report.isa)), failed);
    add(times, "load", duration(seconds->load), failed);
    add(times, "read", duration(seconds->read), failed);
    add(times, "build", duration(seconds->build), failed);
    add(times, "transform", duration(seconds->transform), failed);
    add(times, "draw", duration(seconds->draw), failed);
    add(times, "encode", duration(seconds->encode), failed);
    add(times, "write", duration(seconds->write), failed);
    add(times, "total", duration(seconds->total), failed);
    add(root, "seconds", times, failed);
    add(root, "hash", hash_text(result->hash), failed);
    add(root, "hash_algorithm", cJSON_CreateString("xxh64"), failed);
    add(root, "blank", cJSON_CreateBool(result->blank_cells > 0), failed);
    add(root, "warnings", array_of(result->warning_count, text_at, result->warnings), failed);
}

burnish_status render_print_json(const render_result *result, burnish_error *error) {
    int failed = 0;
    cJSON *root = cJSON_CreateObject();
    add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    add_scene(root, result, &failed);
    if (result->cell_count > 1) {
        add_cells(root, result, &failed);
    } else {
        if (result->cells[0].view != VIEW_FREE) {
            add(root, "view", cJSON_CreateString(render_view_name(result->cells[0].view)), &failed);
        }
        add_picture(root, &result->cells[0], &failed);
    }
    add_run(root, result, &failed);
    char *text = failed ? NULL : cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the JSON report");
    }
    int printed = puts(text);
    cJSON_free(text);
    if (printed < 0 || fflush(stdout) != 0) {
        return cli_fail(error, BURNISH_STATUS_WRITE, "standard output: %s", strerror(errno));
    }
    return BURNISH_STATUS_OK;
}

void render_print_timing(const render_seconds *seconds) {
    const struct {
        const char *name;
        double seconds;
    } phases[] = {{"start", seconds->start}, {"read", seconds->read},
                  {"build", seconds->build}, {"transform", seconds->transform},
                  {"draw", seconds->draw},   {"encode", seconds->encode},
                  {"write", seconds->write}, {"total", seconds->total}};
    for (size_t i = 0; i < sizeof phases / sizeof *phases; ++i) {
        fprintf(stderr, "%s%s %.2f ms", i == 0 ? "burnish: " : ", ", phases[i].name,
                phases[i].seconds * 1e3);
    }
    fprintf(stderr, "\n");
}
