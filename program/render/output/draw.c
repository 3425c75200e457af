#include "render/output/result.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "picture/formats.h"
#include "render/output/projection.h"
#include "render/scene/cameras.h"
#include "render/scene/prepare.h"

/* ---- A cell ---- */

/* Draws the mesh, its coverage if tones need it, and its triangles for callouts. *depth receives the
 * distances that annotations behind it need, or NULL; free it. It is NULL after an error. */
static burnish_status draw_mesh(const render_result *result, render_cell *cell, float **depth,
                                burnish_error *error) {
    const burnish_render_options *options = result->options;
    const int rows = options->row_count ? options->row_count : options->height;
    const size_t width = (size_t)options->width, height = (size_t)rows;
    const int has_holes = render_is_projection(result->settings);
    const unsigned behind = BURNISH_ANNOTATION_BOX | BURNISH_ANNOTATION_GRID |
                            (has_holes ? BURNISH_ANNOTATION_DIMENSIONS : 0);
    const int needs_depth = (result->settings->picture.annotations & behind) != 0;
    const int needs_coverage = options->counts == BURNISH_COUNTS_AREA && options->ground;
    const int needs_triangles = result->settings->picture.callouts;
    *depth = NULL;
    if (!needs_depth && !needs_coverage && !needs_triangles) {
        return burnish_renderer_draw(result->renderer, result->mesh, options, &cell->image,
                                     &cell->report, error);
    }
    burnish_image_destroy(&cell->image);
    burnish_status status = burnish_image_create(NULL, &cell->image, options->width, rows,
                                                 options->transparent ? 4 : 3, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_target target = burnish_target_default();
    target.pixels = burnish_image_get_pixels(&cell->image);
    target.depth_stride = width * sizeof **depth;
    target.depth = *depth = needs_depth ? malloc(target.depth_stride * height) : NULL;
    target.coverage_stride = width;
    target.coverage = cell->coverage = needs_coverage ? malloc(width * height) : NULL;
    target.triangle_stride = width * sizeof *cell->triangles;
    target.triangles = cell->triangles =
        needs_triangles ? malloc(target.triangle_stride * height) : NULL;
    cell->callouts = needs_triangles ? calloc(1, sizeof *cell->callouts) : NULL;
    if ((needs_depth && !*depth) || (needs_coverage && !cell->coverage) ||
        (needs_triangles && (!cell->triangles || !cell->callouts))) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY,
                          "out of memory for %d x %d distances, coverages or triangles",
                          options->width, rows);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_draw_into(result->renderer, result->mesh, options, &target,
                                            &cell->report, error);
    }
    if (status != BURNISH_STATUS_OK) {
        free(*depth);
        *depth = NULL;
    }
    return status;
}

/* Warns about the facts of its report. */
static void warn_about_cell(render_result *result, const render_cell *cell) {
    const char *input = result->settings->input.name;
    if (cell->report.lobe_fallbacks > 0) {
        char lobe[32];
        burnish_lobe_spec_name(&cell->lobe, lobe, sizeof lobe);
        render_warn(&result->warnings, 1,
                    "%.300s: %zu of %zu materials have an exponent too low for %s; drawn with a "
                    "lower order",
                    input, cell->report.lobe_fallbacks,
                    burnish_mesh_get_material_count(result->mesh), lobe);
    }
    if (cell->report.layers_dropped > 0) {
        render_warn(&result->warnings, 1,
                    "%.300s: some samples have more transparent layers than %d, or than "
                    "--max-overdraw allows; the farthest ones are omitted",
                    input, BURNISH_TRANSPARENT_LAYERS_MAX);
    }
}

/* Draws the pixels; *depth as in draw_mesh. */
static burnish_status draw_pixels(render_result *result, render_cell *cell, float **depth,
                                  burnish_error *error) {
    burnish_render_options *options = result->options;
    if (render_is_projection(result->settings)) {
        render_aim_projection(result, cell, options);
    }
    options->lobe = cell->lobe;
    options->camera = cell->camera;
    render_upward(result->mesh, &result->settings->camera, options->up);
    const burnish_status status = draw_mesh(result, cell, depth, error);
    result->seconds.transform += cell->report.seconds_transform;
    result->seconds.draw += cell->report.seconds_draw;
    return status;
}

/* Whether the report has a hash. */
static int is_hashed(const render_result *result) {
    return result->settings->output.json || result->settings->job.on_result;
}

burnish_status render_draw_frame(render_result *result, render_cell *cell, burnish_error *error) {
    float *depth = NULL;
    result->options->counts = BURNISH_COUNTS_PIXELS;
    const burnish_status status = draw_pixels(result, cell, &depth, error);
    free(depth);
    if (status == BURNISH_STATUS_OK) {
        render_draw_legend(result, &cell->image);
    }
    return status;
}

burnish_status render_draw_cell(render_result *result, render_cell *cell, burnish_error *error) {
    const render_output_settings *output = &result->settings->output;
    burnish_render_options *options = result->options;
    float *depth = NULL;
    const int is_reported = output->json || result->settings->job.is_reported;
    options->counts = is_reported ? BURNISH_COUNTS_AREA : BURNISH_COUNTS_PIXELS;
    burnish_status status = draw_pixels(result, cell, &depth, error);
    if (status != BURNISH_STATUS_OK) {
        free(cell->coverage);
        free(cell->triangles);
        return status;
    }
    if (is_reported) {
        cell->tones = render_measure_tones(&cell->image, cell->coverage,
                                           cell->report.covered_pixels, 1, options);
    }
    free(cell->coverage);
    cell->coverage = NULL;
    cell->has_one_color = render_has_one_color(&cell->image);
    warn_about_cell(result, cell);
    render_warn_illegible(result, cell);
    status = render_annotate(result, cell, depth, error);
    if (status == BURNISH_STATUS_OK) {
        render_draw_legend(result, &cell->image);
    }
    if (status == BURNISH_STATUS_OK && picture_is_drawing((picture_format)output->format)) {
        status = render_trace(result, cell, depth, error);
    }
    free(cell->triangles);
    cell->triangles = NULL;
    free(depth);
    if (is_hashed(result) && status == BURNISH_STATUS_OK) {
        cell->hash = burnish_image_hash(&cell->image);
    }
    return status;
}

/* ---- All cells ---- */

/* Passes for cells with one scale: the room that annotations need on each side, the height of the
 * picture, the cameras. Other cells need only the last pass. */
enum { AIM_ROOM, AIM_HEIGHT, AIM_CAMERA, AIM_PASSES };

static void widen(render_room *shared, const render_room *room, double height) {
    shared->height = height > shared->height ? height : shared->height;
    for (int k = 0; k < 4; ++k) {
        shared->inset[k] = room->inset[k] > shared->inset[k] ? room->inset[k] : shared->inset[k];
    }
}

/* The cameras of all cells. */
static burnish_status aim_cells(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    if (render_is_projection(settings)) {
        return render_lay_out_projection(result, error);
    }
    const int is_shared = settings->camera.same_scale || settings->camera.orthographic_height.given;
    burnish_status status = BURNISH_STATUS_OK;
    render_room shared = {.is_given = 0};
    for (int pass = is_shared ? AIM_ROOM : AIM_CAMERA; pass < AIM_PASSES; ++pass) {
        render_room widest = shared;
        for (size_t i = 0; i < result->cell_count && status == BURNISH_STATUS_OK; ++i) {
            burnish_camera *camera = &result->cells[i].camera;
            render_room room = shared;
            status = settings->output.plays
                         ? render_play_camera(result, result->cells[i].view, &room, camera, error)
                         : (settings->output.turntable ? render_turntable_camera : render_camera)(
                               result->mesh, settings, result->cells[i].view, &room, camera, error);
            widen(&widest, &room, camera->orthographic_height * settings->camera.zoom.value);
        }
        if (pass == AIM_ROOM) {
            widest.height = 0;
        }
        shared = widest;
        shared.is_given = 1;
    }
    return status;
}

/* Draws the planes of the output and of --plane, for a single picture. */
static burnish_status draw_planes(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    unsigned kinds = settings->output.format == PICTURE_EXR   ? (1U << PLANE_KINDS) - 1
                     : settings->output.format == PICTURE_NPY ? 1U << PLANE_COLOR
                                                              : 0;
    for (size_t i = 0; i < settings->output.planes.count; ++i) {
        kinds |= 1U << settings->output.planes.items[i].kind;
    }
    return kinds == 0 ? BURNISH_STATUS_OK
                      : render_draw_planes(result->renderer, result->mesh, result->options, kinds,
                                           &result->planes, error);
}

burnish_status render_draw_picture(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    const int progress = result->cell_count > 1 && !settings->job.quiet && isatty(STDERR_FILENO);
    int are_plates = 0;
    burnish_status status = settings->input.load.plate < 0
                                ? render_draw_plates(result, &are_plates, error)
                                : BURNISH_STATUS_OK;
    if (status == BURNISH_STATUS_OK && !are_plates) {
        status = aim_cells(result, error);
    }
    for (size_t i = 0; i < result->cell_count && !are_plates && status == BURNISH_STATUS_OK; ++i) {
        render_cell *cell = &result->cells[i];
        if (progress) {
            fprintf(stderr, "\rburnish: %zu of %zu: %s\033[K", i + 1, result->cell_count,
                    cell->label);
        }
        if (cell->view == VIEW_SECTION && render_is_projection(settings)) { /* the last one */
            const render_scene scene = {
                .settings = result->settings, .mesh = result->mesh, .warnings = &result->warnings};
            status = render_cut_section(&scene, error);
        }
        status = status == BURNISH_STATUS_OK ? render_draw_cell(result, cell, error) : status;
    }
    if (progress) {
        fprintf(stderr, "\r\033[K");
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_planes(result, error);
    }
    result->picture = &result->cells[0].image;
    result->hash = result->cells[0].hash;
    if (status == BURNISH_STATUS_OK && result->cell_count > 1) {
        status = render_compose(result, &result->sheet, error);
        result->picture = &result->sheet;
        result->hash = status == BURNISH_STATUS_OK && is_hashed(result)
                           ? burnish_image_hash(&result->sheet)
                           : 0;
    }
    return status;
}
