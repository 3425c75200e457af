/* Annotations of a cell, and drawings: lines and areas instead of pixels. */
#include "burnish/drawing.h"
#include "burnish/sheet.h"
#include "render/output/result.h"

#include <stdio.h>
#include <string.h>

#include "render/output/projection.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"

static burnish_annotate_options make_annotations(const render_result *result,
                                                 const render_cell *cell, const float *depth) {
    const burnish_render_options *options = result->options;
    burnish_annotate_options annotations = render_make_annotations(result->mesh, result->settings);
    memcpy(annotations.background, options->background, sizeof annotations.background);
    if (render_is_calibrated(result->settings)) {
        annotations.kinds = 0; /* its camera is the pinhole in the middle */
    }
    if (render_is_projection(result->settings)) {
        render_limit_annotations(result, cell, &annotations);
    }
    annotations.callouts = cell->callouts;
    annotations.triangles = cell->triangles;
    annotations.transparent = options->transparent;
    annotations.depth = depth;
    annotations.depth_stride = (size_t)options->width * sizeof *depth;
    return annotations;
}

/* Names the entries of the parts list without a number in the picture. */
static void warn_about_callouts(render_result *result, const render_cell *cell, const char *where) {
    const burnish_part *parts = burnish_mesh_get_contents(result->mesh)->parts;
    const burnish_callouts *list = cell->callouts;
    char names[300] = "";
    const char *example = NULL;
    size_t count = 0, used = 0, foreign = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const char *c = parts[list->items[i].part].name;
        while ((unsigned char)(*c - 1) < 127) {
            ++c;
        }
        foreign += *c != 0;
        example = *c && !example ? parts[list->items[i].part].name : example;
        count += !list->items[i].has_balloon;
        if (!list->items[i].has_balloon && used < 200) {
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%zu %s",
                                     used ? ", " : "", i + 1, parts[list->items[i].part].name);
        }
    }
    if (foreign > 0 && (cell == result->cells || cell->plate || !result->cells->callouts->count)) {
        render_warn(&result->warnings, 1,
                    "%.300s: --callouts: %zu of %zu names have letters beyond ASCII, such as "
                    "\"%s\"; the list omits accents, and has #N for part N if it lacks letters",
                    result->settings->input.name, foreign, list->count, example);
    }
    if (list->left_out > 0) {
        render_warn(&result->warnings, 1,
                    "%.300s: --callouts: %zu more parts, which differ from these, are not listed; "
                    "use --only",
                    result->settings->input.name, list->left_out);
    }
    if (count > 0) {
        render_warn(&result->warnings, 1,
                    "%.300s: --callouts: %zu of %zu parts are hidden or have no room for a number "
                    "in %s, such as %s; use --explode, another camera or a larger picture",
                    result->settings->input.name, count, list->count, where, names);
    }
}

burnish_status render_annotate(render_result *result, render_cell *cell, const float *depth,
                               burnish_error *error) {
    const render_settings *settings = result->settings;
    const burnish_annotate_options annotations = make_annotations(result, cell, depth);
    const char *where = result->cell_count > 1 ? cell->label : "the picture";
    if (cell == result->cells &&
        (settings->picture.annotations & ~render_make_annotations(result->mesh, settings).kinds)) {
        render_warn(
            &result->warnings, 1,
            "%.300s: --annotate: dimensions: --explode moves parts, so lengths of the whole "
            "are not drawn; omit one of them",
            settings->input.name);
    }
    if (!annotations.kinds) {
        return BURNISH_STATUS_OK;
    }
    const burnish_pixels pixels = burnish_image_get_pixels(&cell->image);
    size_t left_out = 0;
    const burnish_status status =
        burnish_annotate(result->mesh, &annotations, &cell->camera, &pixels, &left_out, error);
    if (status == BURNISH_STATUS_OK && (annotations.kinds & BURNISH_ANNOTATION_SCALE) &&
        !(cell->camera.orthographic_height > 0)) {
        render_warn(&result->warnings, 1,
                    "%.300s: --annotate: scale: a perspective has no scale, so %s has no bar; use "
                    "--camera-orthographic, or omit it",
                    settings->input.name, where);
    }
    if (status == BURNISH_STATUS_OK && left_out > 0) {
        render_warn(
            &result->warnings, 1,
            "%.300s: %s has no room for %zu of the annotations; enlarge the picture or its margin",
            settings->input.name, where, left_out);
    }
    if (status == BURNISH_STATUS_OK && cell->callouts) {
        warn_about_callouts(result, cell, where);
    }
    return status;
}

/* ---- Drawings ---- */

burnish_status render_trace(const render_result *result, render_cell *cell, const float *depth,
                            burnish_error *error) {
    const burnish_render_options *options = result->options;
    const burnish_annotate_options annotations = make_annotations(result, cell, depth);
    burnish_status status =
        burnish_drawing_create(NULL, options->width, options->height, &cell->drawing, error);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_renderer_trace(result->renderer, result->mesh, options, cell->drawing, error);
    }
    if (status == BURNISH_STATUS_OK && annotations.kinds) {
        status = burnish_annotate_drawing(result->mesh, &annotations, &cell->camera, cell->drawing,
                                          NULL, error);
    }
    return status;
}

static void release_text(void *bytes) {
    burnish_release(NULL, bytes);
}

static burnish_status encode_drawing(const render_result *result, const burnish_drawing *drawing,
                                     picture_file *file, burnish_error *error) {
    const render_settings *settings = result->settings;
    const burnish_render_options *options = result->options;
    const char *slash = strrchr(settings->input.name, '/');
    char *text = NULL;
    const burnish_status status =
        (settings->output.format == PICTURE_PDF ? burnish_drawing_encode_pdf
                                                : burnish_drawing_encode_svg)(
            drawing, slash ? slash + 1 : settings->input.name,
            options->transparent ? NULL : options->background, settings->output.dots_per_inch.value,
            &text, &file->size, error);
    file->bytes = (uint8_t *)text;
    file->release = release_text;
    return status;
}

burnish_status render_encode_drawing(const render_result *result, const burnish_sheet_cell *cells,
                                     const uint8_t ink[3], picture_file *file,
                                     burnish_error *error) {
    burnish_drawing *drawings[RENDER_LIST_MAX * RENDER_LIST_MAX], *sheet = NULL;
    if (result->cell_count == 1) {
        return encode_drawing(result, result->cells[0].drawing, file, error);
    }
    for (size_t i = 0; i < result->cell_count; ++i) {
        drawings[i] = result->cells[i].drawing;
    }
    burnish_status status = render_is_projection(result->settings)
                                ? render_join_projection(result, ink, &sheet, error)
                                : burnish_drawing_sheet(cells, drawings, result->cell_count,
                                                        result->columns, ink, &sheet, error);
    if (status == BURNISH_STATUS_OK) {
        status = encode_drawing(result, sheet, file, error);
    }
    burnish_drawing_destroy(sheet);
    return status;
}
