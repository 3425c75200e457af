#include "render/output/projection.h"
#include "base/cli/platform.h"

#include <string.h>

#include "cli/main.h"
#include "render/scene/cameras.h"

/* The size of the page without --resolution: A4 at 144 dots per inch. */
enum { PAPER_WIDTH = 1684, PAPER_HEIGHT = 1190 };

#define SCALE_LEAST 1e-4 /* that ISO 5455 recommends */
#define SCALE_MOST 50

/* The size of a page in pixels. */
static void choose_page(render_settings *settings) {
    static const int sides[] = {1189, 841, 594, 420, 297, 210}; /* millimetres: A0 to A4 */
    double *dots = &settings->output.dots_per_inch.value;
    *dots = *dots > 0 ? *dots : 144;
    for (int k = 0; k < 2; ++k) {
        settings->picture.size[k] =
            (int)(sides[settings->picture.paper - 1 + k] * *dots / 25.4 + 0.5);
    }
}

burnish_status render_check_projection(render_settings *settings, burnish_error *error) {
    static const char *const sizes[] = {"resolution", "size", "width", "height"};
    int has_size = 0;
    if (!render_is_projection(settings)) {
        return BURNISH_STATUS_OK;
    }
    if (settings->shading.lobes.count > 1) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--lobe: a sheet of aligned views shows one lobe; omit the others");
    }
    if (settings->camera.projection == PROJECTION_PERSPECTIVE) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--camera-orthographic: aligned views are parallel; omit the flag");
    }
    settings->camera.orthographic_height.given = 0;
    settings->camera.zoom.value = 1;
    settings->camera.focal_point.given = 0;
    settings->picture.columns = settings->picture.no_labels = 0;
    settings->picture.labels = settings->picture.font = NULL;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        has_size |= cli_is_given(&render_command, settings, sizes[i]);
    }
    if (settings->picture.paper > 0) {
        choose_page(settings);
    } else if (!has_size) {
        settings->picture.size[0] = PAPER_WIDTH;
        settings->picture.size[1] = PAPER_HEIGHT;
    }
    return BURNISH_STATUS_OK;
}

/* The other views show the same scale with the object in the middle; the pictorial view has it too
 * if it fits its cell. */
static burnish_status aim_view(render_result *result, size_t i, burnish_error *error) {
    render_settings settings = *result->settings;
    const burnish_projection *projection = &result->projection;
    render_cell *cell = &result->cells[i];
    render_room room = {.is_given = 1};
    cell->image.width = settings.picture.size[0] = projection->cells[i].width;
    cell->image.height = settings.picture.size[1] = projection->cells[i].height;
    settings.picture.annotations = 0;
    settings.picture.callouts &= i == BURNISH_PROJECTION_PICTORIAL;
    if (i == BURNISH_PROJECTION_PICTORIAL) {
        room.is_given = 0;
    } else {
        room.height = projection->cells[i].height / projection->pixels_per_unit;
    }
    const burnish_status status =
        render_camera(result->mesh, &settings, cell->view, &room, &cell->camera, error);
    const double height = projection->cells[i].height / projection->pixels_per_unit;
    if (cell->camera.orthographic_height < height) {
        cell->camera.orthographic_height = height;
    }
    return status;
}

#define WIDE_LINE 0.5 /* millimetres, of the widths of ISO 128-2; others are half of it */

/* A pictorial view has neither hidden lines nor centre lines, a section no hidden lines. */
void render_aim_projection(const render_result *result, const render_cell *cell,
                           burnish_render_options *options) {
    const int is_pictorial = cell - result->cells == BURNISH_PROJECTION_PICTORIAL;
    options->width = cell->image.width;
    options->height = cell->image.height;
    const int has_hidden = result->settings->shading.hidden_lines && cell->view != VIEW_SECTION;
    const burnish_edge_flags hidden =
        (has_hidden ? BURNISH_EDGES_HIDDEN : 0) |
        (result->settings->shading.center_lines ? BURNISH_EDGES_CENTERS : 0);
    options->edges = is_pictorial ? options->edges & ~hidden : options->edges | hidden;
    const float wide = (float)(WIDE_LINE * result->projection.pixels_per_millimetre);
    if (!result->settings->shading.edge_width.given && wide > options->edge_width) {
        options->edge_width = wide < BURNISH_EDGE_WIDTH_MAX ? wide : BURNISH_EDGE_WIDTH_MAX;
    }
}

burnish_status render_lay_out_projection(render_result *result, burnish_error *error) {
    static const char *const papers[] = {NULL, "A0", "A1", "A2", "A3", "A4"};
    const render_settings *settings = result->settings;
    burnish_projection *projection = &result->projection;
    int axes[3];
    *projection =
        (burnish_projection){.method = settings->picture.views.layout == VIEW_FIRST_ANGLE
                                           ? BURNISH_PROJECTION_FIRST_ANGLE
                                           : BURNISH_PROJECTION_THIRD_ANGLE,
                             .width = settings->picture.size[0],
                             .height = settings->picture.size[1],
                             .pixels_per_millimetre = settings->output.dots_per_inch.value / 25.4,
                             .paper = papers[settings->picture.paper]};
    render_axes(result->mesh, &settings->camera, axes);
    for (int k = 0; k < 3; ++k) {
        projection->section += axes[k] == settings->input.section.axis - 1 ? k + 1 : 0;
    }
    render_extents(result->mesh, &settings->camera, projection->extents);
    burnish_status status = burnish_projection_lay_out(projection, error);
    const double scale = projection->pixels_per_unit / projection->pixels_per_millimetre;
    if (status == BURNISH_STATUS_OK && projection->pixels_per_millimetre > 0 &&
        !(scale >= SCALE_LEAST && scale <= SCALE_MOST)) {
        render_warn(&result->warnings, 1,
                    "%.200s: a unit counts as a millimetre, which needs a scale beyond the 1:10000 "
                    "to 50:1 of ISO 5455",
                    settings->input.name);
    }
    for (size_t i = 0; i < result->cell_count && status == BURNISH_STATUS_OK; ++i) {
        status = aim_view(result, i, error);
    }
    return status;
}

/* Width and height belong to the front view, depth to the side view. */
void render_limit_annotations(const render_result *result, const render_cell *cell,
                              burnish_annotate_options *annotations) {
    const size_t i = (size_t)(cell - result->cells);
    int axes[3]; /* of width, height, depth */
    render_axes(result->mesh, &result->settings->camera, axes);
    annotations->text_height =
        result->settings->picture.callouts && i == BURNISH_PROJECTION_PICTORIAL
            ? 0 /* as framing has them */
            : result->projection.text_height;
    const unsigned holes =
        i < BURNISH_PROJECTION_PICTORIAL && (annotations->kinds & BURNISH_ANNOTATION_DIMENSIONS)
            ? BURNISH_ANNOTATION_HOLES
            : 0;
    annotations->kinds &= i == BURNISH_PROJECTION_FRONT
                              ? ~(unsigned)(BURNISH_ANNOTATION_AXES | BURNISH_ANNOTATION_CALLOUTS)
                          : i == BURNISH_PROJECTION_SIDE ? BURNISH_ANNOTATION_DIMENSIONS
                          : i == BURNISH_PROJECTION_TOP
                              ? 0
                              : BURNISH_ANNOTATION_AXES | BURNISH_ANNOTATION_CALLOUTS;
    annotations->kinds |= holes;
    const size_t parent =
        result->projection.section == 3 ? BURNISH_PROJECTION_TOP : BURNISH_PROJECTION_FRONT;
    if (result->projection.section > 0 && (i == BURNISH_PROJECTION_SECTION || i == parent)) {
        annotations->kinds |= BURNISH_ANNOTATION_SECTION;
        annotations->section = result->settings->input.section.plane;
    }
    annotations->lengths =
        i == BURNISH_PROJECTION_SIDE ? 1U << axes[2] : 1U << axes[0] | 1U << axes[1];
}

size_t render_projection_place(const render_result *result, size_t cell) {
    const burnish_projection_area *cells = result->projection.cells, *at = &cells[cell];
    const size_t row =
        at->y > cells[BURNISH_PROJECTION_FRONT].y || at->y > cells[BURNISH_PROJECTION_TOP].y;
    const size_t column = at->x == cells[BURNISH_PROJECTION_FRONT].x  ? 0
                          : at->x == cells[BURNISH_PROJECTION_SIDE].x ? 1
                                                                      : 2;
    return row * (size_t)result->columns + column;
}

static const char *title(const render_result *result) {
    return cli_base_name(result->settings->input.name);
}

burnish_status render_compose_projection(const render_result *result, const uint8_t ink[3],
                                         burnish_image *image, burnish_error *error) {
    const burnish_image *views[BURNISH_PROJECTION_VIEWS] = {0};
    for (size_t i = 0; i < result->cell_count; ++i) {
        views[i] = &result->cells[i].image;
    }
    return burnish_projection_image(&result->projection, title(result), views,
                                    result->options->background, ink, image, error);
}

burnish_status render_join_projection(const render_result *result, const uint8_t ink[3],
                                      burnish_drawing **drawing, burnish_error *error) {
    burnish_drawing *views[BURNISH_PROJECTION_VIEWS] = {0};
    for (size_t i = 0; i < result->cell_count; ++i) {
        views[i] = result->cells[i].drawing;
    }
    return burnish_projection_drawing(&result->projection, title(result), views, ink, drawing,
                                      error);
}
