/* --plate=sheet: each plate of a print project is loaded and prepared by itself, and is a cell. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/output/result.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"

typedef struct plate_scene {
    render_settings settings;
    burnish_render_options options;
    burnish_mesh *mesh;
} plate_scene;

/* The height of a parallel picture, or the distance from the object. */
static double extent_of(const burnish_camera *camera) {
    const double *a = camera->position, *b = camera->focal_point;
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return camera->orthographic_height > 0 ? camera->orthographic_height
                                           : sqrt(x * x + y * y + z * z);
}

/* Lists the plates that have a solid, with their names, in cells. */
static burnish_status list_plates(render_result *result, burnish_error *error) {
    const burnish_contents *contents = burnish_mesh_get_contents(result->mesh);
    const render_cell pattern = result->cells[0];
    render_cell *cells = realloc(result->cells, (contents->plate_count + 1) * sizeof *cells);
    if (!cells) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu plates",
                        contents->plate_count);
    }
    result->cells = cells;
    result->cell_count = 0;
    for (size_t i = 0; i < contents->plate_count; ++i) {
        const burnish_plate *plate = &contents->plates[i];
        int is_used = 0;
        for (size_t k = 0; k < contents->part_count; ++k) {
            is_used |= contents->parts[k].plate == plate->number &&
                       contents->parts[k].role == BURNISH_PART_SOLID;
        }
        if (is_used) {
            render_cell *cell = &cells[result->cell_count++];
            *cell = pattern;
            cell->plate = plate->number;
            snprintf(cell->label, sizeof cell->label, *plate->name ? "%d: %s" : "%d", plate->number,
                     plate->name);
        }
    }
    if (result->cell_count < 2) {
        result->cell_count = 1;
        cells[0] = pattern;
    }
    result->columns = render_sheet_columns(result->settings, result->cell_count);
    return BURNISH_STATUS_OK;
}

static burnish_status load_plate(render_result *result, render_cell *cell, plate_scene *plate,
                                 burnish_error *error) {
    render_settings *settings = &plate->settings;
    render_room room = {.is_given = 0};
    *settings = result->given;
    settings->input.load.plate = cell->plate;
    memcpy(settings->input.coloring.range, result->color_range, sizeof result->color_range);
    burnish_status status =
        render_load(&settings->input, settings->job.threads, &plate->mesh, error);
    render_scene scene = {settings,          plate->mesh,
                          &plate->options,   &result->environment,
                          &result->warnings, result->color_range};
    status = status == BURNISH_STATUS_OK ? render_prepare(&scene, error) : status;
    return status == BURNISH_STATUS_OK
               ? render_camera(plate->mesh, settings, cell->view, &room, &cell->camera, error)
               : status;
}

/* Gives all cameras the largest extent. */
static void share_scale(render_result *result) {
    double largest = 0;
    for (size_t i = 0; i < result->cell_count; ++i) {
        largest = fmax(largest, extent_of(&result->cells[i].camera));
    }
    for (size_t i = 0; i < result->cell_count; ++i) {
        burnish_camera *camera = &result->cells[i].camera;
        const double scale = largest / extent_of(camera);
        camera->orthographic_height *= scale;
        for (int k = 0; k < 3; ++k) {
            const double side = camera->position[k] - camera->focal_point[k];
            camera->position[k] = camera->focal_point[k] + side * scale;
        }
    }
}

burnish_status render_draw_plates(render_result *result, int *are_drawn, burnish_error *error) {
    burnish_status status = list_plates(result, error);
    *are_drawn = status == BURNISH_STATUS_OK && result->cell_count > 1;
    if (!*are_drawn) {
        return status;
    }
    plate_scene *plates = calloc(result->cell_count, sizeof *plates);
    if (!plates) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu plates",
                        result->cell_count);
    }
    for (size_t i = 0; i < result->cell_count && status == BURNISH_STATUS_OK; ++i) {
        status = load_plate(result, &result->cells[i], &plates[i], error);
    }
    if (status == BURNISH_STATUS_OK) {
        share_scale(result);
    }
    const render_result whole = *result;
    for (size_t i = 0; i < whole.cell_count && status == BURNISH_STATUS_OK; ++i) {
        result->mesh = plates[i].mesh;
        result->settings = &plates[i].settings;
        result->options = &plates[i].options;
        status = render_draw_cell(result, &result->cells[i], error);
    }
    result->mesh = whole.mesh;
    result->settings = whole.settings;
    result->options = whole.options;
    for (size_t i = 0; i < result->cell_count; ++i) {
        burnish_mesh_destroy(plates[i].mesh);
    }
    free(plates);
    render_settings labels = *whole.settings; /* the file has them, too late to open a font */
    labels.picture.opens_no_font = 1;
    labels.picture.font = NULL;
    result->settings = &labels;
    status = status == BURNISH_STATUS_OK ? render_open_font(result, error) : status;
    result->settings = whole.settings;
    return status;
}
