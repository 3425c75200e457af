/* Drawing a cell with its annotations. */
#include "render/annotate.h"

#include <stdlib.h>
#include <string.h>

#include "render/camera.h"

burnish_status render_draw(const render_result *result, burnish_renderer *renderer,
                           const burnish_render_options *options, render_cell *cell, float **depth,
                           burnish_error *error) {
    const unsigned hidden = BURNISH_ANNOTATION_BOX | BURNISH_ANNOTATION_GRID;
    *depth = NULL;
    if (!(result->settings->annotations & hidden)) {
        return burnish_renderer_draw(renderer, result->mesh, options, &cell->image, &cell->report,
                                     error);
    }
    burnish_status status = burnish_image_create(&cell->image, options->width, options->height,
                                                 options->transparent ? 4 : 3, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_target target = burnish_target_default();
    target.pixels = burnish_image_pixels(&cell->image);
    target.depth_stride = (size_t)options->width * sizeof **depth;
    target.depth = *depth = malloc(target.depth_stride * (size_t)options->height);
    if (!*depth) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %d x %d distances",
                        options->width, options->height);
    }
    status =
        burnish_renderer_draw_into(renderer, result->mesh, options, &target, &cell->report, error);
    if (status != BURNISH_STATUS_OK) {
        free(*depth);
        *depth = NULL;
    }
    return status;
}

burnish_status render_annotate(render_result *result, const burnish_render_options *options,
                               render_cell *cell, const float *depth, burnish_error *error) {
    const render_settings *settings = result->settings;
    if (!settings->annotations) {
        return BURNISH_STATUS_OK;
    }
    const burnish_pixels pixels = burnish_image_pixels(&cell->image);
    burnish_annotations annotations = render_make_annotations(result->mesh, settings);
    size_t left_out = 0;
    memcpy(annotations.background, options->background, sizeof annotations.background);
    annotations.transparent = options->transparent;
    const burnish_status status =
        burnish_annotate(result->mesh, &annotations, &cell->camera, &pixels, depth,
                         (size_t)pixels.width * sizeof *depth, &left_out, error);
    if (status == BURNISH_STATUS_OK && left_out > 0) {
        render_result_warn(result, 1,
                           "%.300s: %s has no room for %zu of the annotations; make it larger, or "
                           "show more of it",
                           settings->input, result->cell_count > 1 ? cell->label : "the picture",
                           left_out);
    }
    return status;
}
