/* Whether a finished picture shows its object. */
#include "render/output/result.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cli/main.h"

enum {
    SAMPLES = 1 << 15, /* pixels that are inspected, about */
    GLANCE = 1 << 9,   /* of which the first are enough for most pictures */
    SIDES = 50         /* a smaller object has a side of less than 1 / SIDES of the picture's */
};

/* The first flag given that aims or cuts; NULL: none. */
static const char *find_aim(const render_settings *settings) {
    static const char *const flags[] = {
        "camera-position", "camera-focal-point", "camera", "camera-orthographic-height", "zoom",
        "margin",          "same-scale",         "clip"};
    for (size_t i = 0; i < sizeof flags / sizeof *flags; ++i) {
        if (cli_is_given(&render_command, settings, flags[i])) {
            return flags[i];
        }
    }
    return NULL;
}

static int longer(int a, int b) {
    return a > b ? a : b;
}

/* A small object, or few pixels over a large box: parts far apart, or thin points. A thin line that is
 * connected has a pixel for each one of its length. */
static int is_speck(const render_cell *cell) {
    const int *bounds = cell->report.bounds;
    const int width = cell->image.width, height = cell->image.height;
    const int side = longer(bounds[2] - bounds[0], bounds[3] - bounds[1]);
    const uint64_t covered = cell->report.covered_pixels;
    return side * SIDES < longer(width, height) ||
           (covered * SIDES * SIDES < (uint64_t)width * (uint64_t)height &&
            covered < (uint64_t)side);
}

static uint64_t common_divisor(uint64_t a, uint64_t b) {
    return b > 0 ? common_divisor(b, a % b) : a;
}

/* The tones of about so many pixels, evenly from all columns. */
static render_tones measure(const render_result *result, const render_cell *cell,
                            uint64_t samples) {
    const burnish_image *image = &cell->image;
    uint64_t step = 1 + (uint64_t)image->width * (uint64_t)image->height / samples;
    while (common_divisor(step, (uint64_t)image->width) > 1) { /* would pass columns over */
        ++step;
    }
    return render_measure_tones(image, NULL, cell->report.covered_pixels, step, result->options);
}

int render_is_blank(const render_result *result, const render_cell *cell) {
    const int has_own_background = cell->report.ground || result->options->background_environment;
    return cell->has_one_color || (cell->report.covered_pixels == 0 && has_own_background);
}

/* Whether edges in another colour than the background's are drawn: they show any object. */
static int has_edges(const render_result *result) {
    const burnish_lines *lines = burnish_renderer_get_lines(result->renderer);
    int difference = 0;
    for (int k = 0; k < 3; ++k) {
        difference = longer(difference, abs(lines->color[k] - result->options->background[k]));
    }
    return lines->line_count > 0 && (double)lines->opacity * difference > 32;
}

/* What is wrong and what helps, or NULL. */
static const char *find_fault(const render_result *result, const render_cell *cell, char *buffer,
                              size_t size) {
    const uint64_t all = (uint64_t)cell->image.width * (uint64_t)cell->image.height;
    const uint64_t covered = cell->report.covered_pixels;
    const char *aim = find_aim(result->settings);
    const int is_drawing = result->settings->shading.look == BURNISH_LOOK_DRAWING;
    const int has_points = burnish_mesh_get_info(result->mesh)->point_count > 0;
    if (covered == 0 && aim) {
        snprintf(buffer, size, "is blank: the object is not in it; check --%s", aim);
        return buffer;
    }
    if (covered == 0) {
        return !render_is_blank(result, cell) ? NULL
                                              : "is blank: the object is too thin or too small in "
                                                "it, or transparent; use --edges, "
                                                "--opacity, or --zoom with --camera-focal-point";
    }
    if (cell->has_one_color && is_drawing && has_points) {
        return "is empty: points have no lines to draw; use another --look";
    }
    if (cell->has_one_color) {
        return "has only one colour: the object is invisible; check --color, --light and "
               "--background-color";
    }
    if (is_speck(cell)) {
        snprintf(buffer, size, "shows the object in only %llu of %llu pixels; %s%s",
                 (unsigned long long)covered, (unsigned long long)all, aim ? "check --" : "use ",
                 aim          ? aim
                 : has_points ? "--point-size"
                              : "--zoom with --camera-focal-point");
        return buffer;
    }
    if (is_drawing) {
        return NULL; /* its areas are as white as its paper */
    }
    render_tones tones = measure(result, cell, GLANCE);
    if (covered > all / 10 && !(tones.like_ground > 0.5) && tones.near_black < 0.5) {
        return NULL; /* far from both limits */
    }
    tones = measure(result, cell, SAMPLES);
    return tones.like_ground > 0.95 && !has_edges(result)
               ? "shows the object in the colour of its background; change --background-color"
           : tones.near_black > fmax(0.5, 0.9 - 3 / sqrt((double)covered)) /* outlines mix */
               ? "is nearly black; raise --exposure or --ambient, or use --color"
               : NULL;
}

void render_warn_illegible(render_result *result, const render_cell *cell) {
    const int is_blank = render_is_blank(result, cell);
    const int is_part = result->settings->picture.rows.count > 0;
    char buffer[200];
    const char *fault =
        is_part && !is_blank ? NULL : find_fault(result, cell, buffer, sizeof buffer);
    result->blank_cells += (size_t)is_blank;
    result->faulty_cells += fault != NULL;
    if (fault) {
        render_warn(&result->warnings,
                    !is_part && !(is_blank && result->settings->output.fail_on_blank),
                    "%.200s: %s %s", result->settings->input.name,
                    result->cell_count > 1 ? cell->label : "the picture", fault);
    }
}
