/* The report of `burnish render`: JSON and times. */
#include "render/output/result.h"

#include "render/output/projection.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "cli/coordinates.h"
#include "import/importers.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"
#include "render/scene/winding.h"
#include "render/settings/flag_values.h"

static cJSON *hash_text(uint64_t hash) {
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    return cJSON_CreateString(text);
}

cJSON *render_camera_object(const burnish_camera *camera, const double origin[3], int *failed) {
    cJSON *object = cJSON_CreateObject();
    cli_json_add(object, "position", cli_json_real_position(camera->position, origin), failed);
    cli_json_add(object, "focal_point", cli_json_real_position(camera->focal_point, origin),
                 failed);
    cli_json_add(object, "view_up", cli_json_reals(3, camera->view_up), failed);
    cli_json_add(object, "view_angle", cli_json_real(camera->view_angle), failed);
    cli_json_add(object, "orthographic_height", cli_json_real(camera->orthographic_height), failed);
    return object;
}

static int compare_floats(const void *a, const void *b) {
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The different exponents of all materials, ascending. */
static cJSON *exponents_array(const burnish_mesh *mesh) {
    size_t size = burnish_mesh_get_material_count(mesh), kept = 0;
    float *values = malloc(size * sizeof *values);
    if (!values) {
        return NULL;
    }
    for (size_t i = 0; i < size; ++i) {
        values[i] = burnish_mesh_get_material(mesh, i)->exponent;
    }
    qsort(values, size, sizeof *values, compare_floats);
    for (size_t i = 0; i < size; ++i) {
        if (i == 0 || values[i] != values[kept - 1]) {
            values[kept++] = values[i];
        }
    }
    cJSON *array = cli_json_floats(kept, values);
    free(values);
    return array;
}

static void add_callouts(cJSON *object, const render_result *result, const burnish_callouts *list,
                         int *failed) {
    const burnish_part *parts = burnish_mesh_get_contents(result->mesh)->parts;
    cJSON *array = cJSON_CreateArray();
    for (size_t i = 0; i < list->count; ++i) {
        const burnish_callout *item = &list->items[i];
        const int point[2] = {item->x, item->y};
        cJSON *row = cJSON_CreateObject();
        cli_json_add(row, "number", cli_json_count(i + 1), failed);
        cli_json_add(row, "name", cli_json_text(parts[item->part].name), failed);
        cli_json_add(row, "count", cli_json_count(item->count), failed);
        cli_json_add(row, "part", cli_json_count(item->part + 1), failed);
        cli_json_add(row, "point",
                     item->is_visible ? cli_json_integers(2, point) : cJSON_CreateNull(), failed);
        cli_json_add(row, "balloon", cJSON_CreateBool(item->has_balloon), failed);
        cli_json_add(array, NULL, row, failed);
    }
    cli_json_add(object, "callouts", array, failed);
}

/* The keys that a single picture and a cell share. */
static void add_picture(cJSON *object, const render_result *result, const render_cell *cell,
                        int *failed) {
    const double *origin = burnish_mesh_get_view(result->mesh)->origin;
    char lobe[32];
    burnish_lobe_spec_name(&cell->lobe, lobe, sizeof lobe);
    cli_json_add(object, "triangles_drawn", cli_json_count(cell->report.triangles_drawn), failed);
    cli_json_add(object, "hidden", cli_json_real(cell->report.hidden_share), failed);
    cli_json_add(object, "covered_pixels", cli_json_count(cell->report.covered_pixels), failed);
    cli_json_add(object, "overdraw", cli_json_real(cell->report.overdraw), failed);
    cli_json_add(object, "layers_dropped", cli_json_count(cell->report.layers_dropped), failed);
    cli_json_add(object, "pixel_bounds", cli_json_integers(4, cell->report.bounds), failed);
    cli_json_add(object, "near_white", cli_json_real(cell->tones.near_white), failed);
    cli_json_add(object, "near_black", cli_json_real(cell->tones.near_black), failed);
    cli_json_add(object, "like_ground", cli_json_real(cell->tones.like_ground), failed);
    cli_json_add(object, "contrast", cli_json_real(cell->tones.contrast), failed);
    cli_json_add(object, "camera", render_camera_object(&cell->camera, origin, failed), failed);
    if (render_is_calibrated(result->settings)) {
        cli_json_add(object, "intrinsics",
                     cli_json_reals(4, result->settings->camera.intrinsics.values), failed);
    }
    if (cell->callouts) {
        add_callouts(object, result, cell->callouts, failed);
    }
    const double height = cell->camera.orthographic_height;
    const int picture_height =
        render_is_projection(result->settings) ? cell->image.height : result->options->height;
    cli_json_add(object, "pixels_per_unit",
                 cli_json_real(height > 0 ? picture_height / height : (double)NAN), failed);
    cli_json_add(object, "lobe", cJSON_CreateString(lobe), failed);
}

static void add_cells(cJSON *root, const render_result *result, int *failed) {
    cJSON *cells = cJSON_CreateArray();
    for (size_t i = 0; i < result->cell_count; ++i) {
        const render_cell *cell = &result->cells[i];
        cJSON *object = cJSON_CreateObject();
        const size_t place =
            render_is_projection(result->settings) ? render_projection_place(result, i) : i;
        cli_json_add(object, "row", cli_json_count(place / (size_t)result->columns), failed);
        cli_json_add(object, "column", cli_json_count(place % (size_t)result->columns), failed);
        if (cell->plate > 0) {
            cli_json_add(object, "plate", cJSON_CreateNumber(cell->plate), failed);
        }
        if (cell->view != VIEW_FREE) {
            cli_json_add(object, "view", cJSON_CreateString(render_view_name(cell->view)), failed);
        }
        cli_json_add(object, "width", cJSON_CreateNumber(cell->image.width), failed);
        cli_json_add(object, "height", cJSON_CreateNumber(cell->image.height), failed);
        add_picture(object, result, cell, failed);
        cli_json_add(object, "blank", cJSON_CreateBool(render_is_blank(result, cell)), failed);
        cli_json_add(object, "hash", hash_text(cell->hash), failed);
        cli_json_add(cells, NULL, object, failed);
    }
    cli_json_add(root, "cells", cells, failed);
}

static void add_cuts(cJSON *root, const burnish_mesh_view *view, int *failed) {
    cJSON *cuts = cJSON_CreateArray();
    for (int i = 0; i < view->cut_count; ++i) {
        const burnish_clip_plane *plane = &view->cuts[i];
        const double values[4] = {plane->normal[0], plane->normal[1], plane->normal[2],
                                  render_file_offset(plane, view->origin)};
        cli_json_add(cuts, NULL, cli_json_reals(4, values), failed);
    }
    cli_json_add(root, "cuts", cuts, failed);
    cli_json_add(root, "filled",
                 cJSON_CreateBool(view->cut_count > 0 && view->inside != BURNISH_INSIDE_UNKNOWN),
                 failed);
}

static cJSON *output_name(const render_result *result, const char *path) {
    return cli_json_text(result->written ? path : NULL);
}

/* Whether the surface is inside out; null if it is not closed. */
static cJSON *inside_out(const burnish_mesh_view *view, int has_faces) {
    const render_winding winding = render_measure_winding(view);
    return has_faces && winding.is_closed ? cJSON_CreateBool(winding.volume < 0)
                                          : cJSON_CreateNull();
}

/* What a scene joined. */
static cJSON *part_at(const void *from, size_t i) {
    const burnish_part *part = &burnish_mesh_get_contents(from)->parts[i];
    int failed = 0;
    cJSON *row = cJSON_CreateObject();
    cli_json_add(row, "name", cli_json_text(part->name), &failed);
    cli_json_add(row, "triangles", cli_json_count(part->triangle_count), &failed);
    cli_json_add(row, "transform", cli_json_reals(12, part->transform), &failed);
    return row;
}

static void add_mesh(cJSON *root, const render_result *result, int *failed) {
    const render_settings *settings = result->settings;
    const burnish_mesh *mesh = result->mesh;
    const burnish_mesh_info *info = burnish_mesh_get_info(mesh);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_view *splats = burnish_mesh_get_view(burnish_mesh_get_splats(mesh));
    char extension[IMPORT_EXTENSION_SIZE];
    const char *format =
        import_format_word(settings->input.name, settings->input.load.format, info, extension);
    const int is_flag = settings->camera.up != UP_AUTO && settings->camera.up != UP_FORMAT;
    const char *source = is_flag ? "flag" : settings->camera.stands_otherwise ? "auto" : "format";
    cJSON *box = cJSON_CreateObject();
    float low[3], high[3];
    burnish_mesh_get_bounds(mesh, low, high);
    cli_json_add(root, "input", cli_json_text(settings->input.name), failed);
    cli_json_add(root, "format", cJSON_CreateString(format), failed);
    cli_json_add(root, "output", output_name(result, render_output_path(&settings->output)),
                 failed);
    cli_json_add(root, "width", cJSON_CreateNumber(result->picture->width), failed);
    cli_json_add(root, "height", cJSON_CreateNumber(result->picture->height), failed);
    if (settings->picture.rows.count > 0) {
        const int rows[2] = {settings->picture.rows.first, settings->picture.rows.count};
        cli_json_add(root, "rows", cli_json_integers(2, rows), failed);
    }
    if (info->format == BURNISH_FORMAT_SCENE || info->format == BURNISH_FORMAT_URDF) {
        cli_json_add(root, "parts",
                     cli_json_array(burnish_mesh_get_contents(mesh)->part_count, part_at, mesh),
                     failed);
    }
    cli_json_add(root, "triangles", cli_json_count(view->triangle_count), failed);
    cli_json_add(root, "vertices", cli_json_count(view->vertex_count), failed);
    cli_json_add(root, "points", cli_json_count(info->point_count), failed);
    cli_json_add(root, "splats", cli_json_count(splats ? splats->vertex_count : 0), failed);
    cli_json_add(root, "lines", cli_json_count(info->line_count), failed);
    cli_json_add(root, "thumbnail", cJSON_CreateBool(info->is_thumbnail), failed);
    const size_t materials = burnish_mesh_get_material_count(mesh);
    cli_json_add(root, "materials", cli_json_count(materials), failed);
    cli_json_add(root, "textures", cli_json_count(burnish_mesh_get_texture_count(mesh)), failed);
    cli_json_add(root, "exponents", exponents_array(mesh), failed);
    cli_json_add(box, "min", cli_json_position(low, view->origin), failed);
    cli_json_add(box, "max", cli_json_position(high, view->origin), failed);
    cli_json_add(root, "bounding_box", box, failed);
    cli_json_add(root, "unit", cli_json_text(info->unit), failed);
    cli_json_add(root, "origin", cli_json_reals(3, view->origin), failed);
    add_cuts(root, view, failed);
    const char *by = settings->input.coloring.by;
    cli_json_add(root, "color_by", cli_json_text(by), failed);
    cli_json_add(root, "color_range",
                 by ? cli_json_reals(2, result->color_range) : cJSON_CreateNull(), failed);
    const char *up = render_up_name(mesh, &settings->camera);
    cli_json_add(root, "up", cJSON_CreateString(up), failed);
    cli_json_add(root, "up_source", cJSON_CreateString(source), failed);
    cli_json_add(root, "up_reason", cli_json_text(settings->camera.stands_otherwise), failed);
    cli_json_add(root, "inside_out", inside_out(view, info->point_count + info->line_count == 0),
                 failed);
}

static const char *word_of(const cli_word *words, int value) {
    while (words->value != value) {
        ++words;
    }
    return words->name;
}

static void add_planes(cJSON *root, const render_result *result, int *failed) {
    const render_planes *planes = &result->settings->output.planes;
    cJSON *array = cJSON_CreateArray();
    for (size_t i = 0; i < planes->count; ++i) {
        const render_plane *plane = &planes->items[i];
        cJSON *object = cJSON_CreateObject();
        const char *kind = word_of(render_plane_words, (int)plane->kind);
        cli_json_add(object, "plane", cJSON_CreateString(kind), failed);
        cli_json_add(object, "output", output_name(result, plane->path), failed);
        if (plane->kind == PLANE_DEPTH) {
            cli_json_add(object, "low", cli_json_float(result->planes.low), failed);
            cli_json_add(object, "high", cli_json_float(result->planes.high), failed);
        }
        cli_json_add(array, NULL, object, failed);
    }
    cli_json_add(root, "planes", array, failed);
}

/* The phases of render_seconds, in their order. */
static const char *const phases[] = {"start", "load",   "read",  "build", "transform",
                                     "draw",  "encode", "write", "total"};
enum { PHASES = sizeof phases / sizeof *phases };
_Static_assert(sizeof(render_seconds) == PHASES * sizeof(double), "each phase has a name");

static void list_seconds(const render_seconds *seconds, double values[PHASES]) {
    memcpy(values, seconds, PHASES * sizeof *values);
}

static void add_run(cJSON *root, const render_result *result, int *failed) {
    const burnish_render_options *options = result->options;
    const burnish_render_report *cell = &result->cells[0].report;
    const char *model = options->specular_model == BURNISH_SPECULAR_BLINN ? "blinn" : "phong";
    const char *viewer = options->local_viewer ? "local" : "distant";
    const char *look = word_of(render_look_words, result->settings->shading.look);
    double seconds[PHASES];
    cJSON *times = cJSON_CreateObject();
    list_seconds(&result->seconds, seconds);
    for (int i = 0; i < PHASES; ++i) {
        cli_json_add(times, phases[i], cli_json_seconds(seconds[i]), failed);
    }
    cli_json_add(root, "equation", cJSON_CreateString(model), failed);
    cli_json_add(root, "viewer", cJSON_CreateString(viewer), failed);
    cli_json_add(root, "look", cJSON_CreateString(look), failed);
    cli_json_add(root, "occlusion", cJSON_CreateNumber(cell->occlusion_directions), failed);
    cli_json_add(root, "shadow", cJSON_CreateBool(cell->shadow), failed);
    cli_json_add(root, "ground", cJSON_CreateBool(cell->ground), failed);
    cli_json_add(root, "lights", cJSON_CreateNumber(options->light_count), failed);
    cli_json_add(root, "area_lights", cJSON_CreateNumber(options->area_light_count), failed);
    cli_json_add(root, "samples", cJSON_CreateNumber(options->samples), failed);
    cli_json_add(root, "threads", cJSON_CreateNumber(cell->threads), failed);
    cli_json_add(root, "isa", cJSON_CreateString(burnish_isa_name(cell->isa)), failed);
    cli_json_add(root, "seconds", times, failed);
    cli_json_add(root, "hash", hash_text(result->hash), failed);
    cli_json_add(root, "hash_algorithm", cJSON_CreateString("xxh64"), failed);
    cli_json_add(root, "blank", cJSON_CreateBool(result->blank_cells > 0), failed);
    cli_json_add(root, "legible", cJSON_CreateBool(result->faulty_cells == 0), failed);
    render_add_reference(root, result, failed);
    cli_json_add(root, "warnings", cli_json_texts(result->warnings.count, result->warnings.lines),
                 failed);
}

cJSON *render_describe_failure(const char *input, int code, const char *message, double total,
                               int *failed) {
    cJSON *root = cJSON_CreateObject(), *times = cJSON_CreateObject();
    cli_json_add(times, "total", cli_json_seconds(total), failed);
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), failed);
    cli_json_add(root, "input", cli_json_text(input), failed);
    cli_json_add(root, "output", cJSON_CreateNull(), failed);
    cli_json_add_outcome(root, code, message, failed);
    cli_json_add(root, "seconds", times, failed);
    cli_json_add(root, "hash", cJSON_CreateNull(), failed);
    cli_json_add(root, "warnings", cJSON_CreateArray(), failed);
    return root;
}

static cJSON *describe_result(const render_result *result, int *failed) {
    burnish_error line;
    const int code = render_judge_result(result, &line);
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), failed);
    add_mesh(root, result, failed);
    cli_json_add_outcome(root, code, code != 0 ? line.text : NULL, failed);
    if (result->cell_count > 1) {
        add_cells(root, result, failed);
    } else {
        if (result->cells[0].view != VIEW_FREE) {
            cli_json_add(root, "view", cJSON_CreateString(render_view_name(result->cells[0].view)),
                         failed);
        }
        add_picture(root, result, &result->cells[0], failed);
    }
    if (result->settings->output.turntable) {
        cli_json_add(root, "frames", cJSON_CreateNumber(result->settings->output.frames), failed);
        cli_json_add(root, "fps", cJSON_CreateNumber(result->settings->output.fps), failed);
        const double length = burnish_mesh_get_info(result->mesh)->animation_seconds;
        cli_json_add(root, "animation_seconds", cli_json_seconds(length), failed);
    }
    if (result->settings->output.planes.count > 0) {
        add_planes(root, result, failed);
    }
    add_run(root, result, failed);
    return root;
}

char *render_json_line(const render_result *result) {
    int failed = 0;
    cJSON *root = describe_result(result, &failed);
    return cli_json_string(root, failed, 0);
}

burnish_status render_write_json(const render_result *result, burnish_error *error) {
    cli_output output;
    int failed = 0;
    burnish_status status = cli_output_begin(&output, error);
    if (status == BURNISH_STATUS_OK) {
        cJSON *root = describe_result(result, &failed);
        status = cli_json_print(output.stream, root, failed, error);
        status = cli_output_end(&output, result->settings->output.json, status, error);
    }
    return status;
}

void render_print_timing(const render_seconds *seconds) {
    double values[PHASES];
    list_seconds(seconds, values);
    for (int i = 0; i < PHASES; ++i) {
        if (strcmp(phases[i], "load") != 0) { /* read plus build */
            fprintf(stderr, "%s%s %.2f ms", i == 0 ? "burnish: " : ", ", phases[i],
                    values[i] * 1e3);
        }
    }
    fprintf(stderr, "\n");
}
