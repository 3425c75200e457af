/* Drawing a cell whose camera is set, and warnings about it. */
#include <stdlib.h>

#include "picture/formats.h"
#include "render/output/annotate.h"
#include "render/output/cells.h"
#include "render/output/legend.h"
#include "render/output/projection.h"
#include "render/output/report.h"
#include "render/scene/camera.h"

static void warn_about_cell(render_result *result, const render_cell *cell) {
    const char *input = result->settings->input.name;
    const char *picture = result->cell_count > 1 ? cell->label : "the picture";
    const int is_printed =
        !result->settings->output.fail_on_blank && result->settings->picture.rows.count == 0;
    if (cell->report.lobe_fallbacks > 0) {
        char lobe[32];
        burnish_lobe_spec_name(&cell->lobe, lobe, sizeof lobe);
        render_warn(&result->warnings, 1,
                    "%.300s: %zu of %zu materials have an exponent too low for %s; drawn "
                    "with a lower order",
                    input, cell->report.lobe_fallbacks,
                    burnish_mesh_get_material_count(result->mesh), lobe);
    }
    if (cell->report.layers_dropped > 0) {
        render_warn(&result->warnings, 1,
                    "%.300s: some samples have more transparent layers than %d, or than "
                    "--max-overdraw allows; the farthest ones are omitted",
                    input, BURNISH_TRANSPARENT_LAYERS_MAX);
    }
    if (cell->report.covered_pixels == 0) {
        ++result->blank_cells;
        render_warn(&result->warnings, is_printed,
                    "%.300s: %s is blank: the object is not in it; check the camera", input,
                    picture);
    } else if (cell->has_one_color) {
        ++result->blank_cells;
        render_warn(&result->warnings, is_printed,
                    "%.300s: %s has only one colour: the object is invisible; check "
                    "colours, lights and background",
                    input, picture);
    }
}

static void aim_options(const render_result *result, burnish_render_options *options,
                        const render_cell *cell) {
    if (render_is_projection(result->settings)) {
        render_aim_projection(result, cell, options);
    }
    options->lobe = cell->lobe;
    options->camera = cell->camera;
    render_upward(result->mesh, &result->settings->camera, options->up);
}

burnish_status render_draw_pixels(render_result *result, burnish_renderer *renderer,
                                  burnish_render_options *options, render_cell *cell, float **depth,
                                  burnish_error *error) {
    aim_options(result, options, cell);
    burnish_status status = render_draw(result, renderer, options, cell, depth, error);
    result->seconds.transform += cell->report.seconds_transform;
    result->seconds.draw += cell->report.seconds_draw;
    return status;
}

burnish_status render_draw_cell(render_result *result, burnish_renderer *renderer,
                                burnish_render_options *options, render_cell *cell,
                                burnish_error *error) {
    float *depth = NULL;
    options->counts = result->settings->output.json ? BURNISH_COUNTS_AREA : BURNISH_COUNTS_PIXELS;
    burnish_status status = render_draw_pixels(result, renderer, options, cell, &depth, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (result->settings->output.json) {
        cell->tones = render_measure_tones(&cell->image, cell->report.covered_pixels, options);
    }
    if (result->settings->output.json || result->settings->job.on_result ||
        result->settings->output.fail_on_blank) {
        cell->has_one_color = render_has_one_color(&cell->image);
    }
    warn_about_cell(result, cell);
    status = render_annotate(result, options, cell, depth, error);
    if (status == BURNISH_STATUS_OK) {
        render_draw_legend(result, options->background, &cell->image);
    }
    if (status == BURNISH_STATUS_OK &&
        picture_is_drawing((picture_format)result->settings->output.format)) {
        status = render_trace(result, renderer, options, cell, depth, error);
    }
    free(depth);
    if ((result->settings->output.json || result->settings->job.on_result) &&
        status == BURNISH_STATUS_OK) {
        cell->hash = burnish_image_hash(&cell->image);
    }
    return status;
}
