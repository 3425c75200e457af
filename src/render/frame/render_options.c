/* Options of a frame, and whether they can be drawn. */
#include "render/frame/render_options.h"

#include "base/layout.h"
#include "base/numbers.h"
#include "core/tasks.h"
#include "core/vec3.h"
#include "raster/raster_view.h"

#define COOKIE BURNISH_COOKIE(0x62726e64, burnish_render_options)

void burnish_render_options_init(burnish_render_options *options, uint64_t layout) {
    burnish_render_options defaults = {
        .cookie = COOKIE,
        .width = 1024,
        .height = 768,
        .samples = 4,
        .camera = {.view_up = {0, 1, 0}, .view_angle = 30},
        .pixel_aspect = 1,
        .lobe = {.fit = BURNISH_FIT_ENERGY, .order = 2, .by_material = 1},
        .local_viewer = 1,
        .environment_strength = 1,
        .edge_color = {20, 20, 20},
        .edge_opacity = 1,
        .max_overdraw = BURNISH_OVERDRAW_DEFAULT};
    burnish_look_apply(BURNISH_LOOK_PLAIN, &defaults);
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_render_options), &defaults);
}

/* ---- Checks ---- */

/* Of the angle between the sides of an area light. */
#define LEAST_SINE 1e-4

burnish_status burnish_render_options_check_cookie(const burnish_render_options *options,
                                                   burnish_error *error) {
    return burnish_layout_check(options, COOKIE, "options", "render_options", error);
}

static int all_finite(const double *values, int count) {
    for (int i = 0; i < count; ++i) {
        if (!burnish_is_finite(values[i])) {
            return 0;
        }
    }
    return 1;
}

static int is_light_color(const float color[3]) {
    for (int i = 0; i < 3; ++i) {
        if (!(color[i] >= 0 && color[i] <= 1e6f)) {
            return 0;
        }
    }
    return 1;
}

static burnish_status check_camera(const burnish_camera *camera, burnish_error *error) {
    if (!all_finite(camera->position, 3) || !all_finite(camera->focal_point, 3) ||
        !all_finite(camera->view_up, 3)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: position, focal point and view up must be finite numbers");
    }
    if (!(camera->orthographic_height >= 0 && camera->orthographic_height <= 1e300)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: orthographic height must be a finite number >= 0");
    }
    if (camera->orthographic_height == 0 && !(camera->view_angle >= BURNISH_VIEW_ANGLE_MIN &&
                                              camera->view_angle <= BURNISH_VIEW_ANGLE_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: view angle %g is not in [0.001, 179] degrees",
                            camera->view_angle);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_lens(const burnish_render_options *options, burnish_error *error) {
    const double *point = options->principal_point;
    if (!(options->pixel_aspect >= 0.01 && options->pixel_aspect <= 100)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: pixel aspect %g is not in [0.01, 100]", options->pixel_aspect);
    }
    for (int i = 0; i < 2; ++i) {
        if (!(point[i] >= -BURNISH_IMAGE_MAX_SIZE && point[i] <= BURNISH_IMAGE_MAX_SIZE)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "camera: principal point %g, %g is more than %d pixels from the "
                                "middle",
                                point[0], point[1], BURNISH_IMAGE_MAX_SIZE);
        }
    }
    const int is_usual = point[0] == 0 && point[1] == 0 && options->pixel_aspect == 1;
    return options->camera.orthographic_height > 0 && !is_usual
               ? burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "camera: only a perspective has a principal point and pixels that "
                              "are not square; leave 0, 0 and 1")
               : BURNISH_STATUS_OK;
}

static burnish_status check_lights(const burnish_render_options *options, burnish_error *error) {
    if (options->light_count < 0 || options->light_count > BURNISH_LIGHT_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lights: %d is not in [0, %d]",
                            options->light_count, BURNISH_LIGHT_MAX);
    }
    for (int i = 0; i < options->light_count; ++i) {
        const burnish_light *light = &options->lights[i];
        const double *v = light->vector;
        int directionless =
            light->kind == BURNISH_LIGHT_DIRECTIONAL && v[0] == 0 && v[1] == 0 && v[2] == 0;
        if ((unsigned)light->kind > BURNISH_LIGHT_POINT || !all_finite(v, 3) || directionless ||
            !is_light_color(light->color)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "light %d: needs a finite vector (not 0 for a directional light) "
                                "and a colour in [0, 1e6]",
                                i + 1);
        }
        if (!all_finite(light->axis, 3) || !(light->distance >= 0 && light->distance <= 1e30) ||
            !(light->range >= 0 && light->range <= 1e30) || !(light->cone[1] >= -1) ||
            !(light->cone[0] >= light->cone[1] && light->cone[0] <= 1)) {
            return burnish_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "light %d: needs distances in [0, 1e30], and of a cone a finite axis "
                "and cosines, the larger one first",
                i + 1);
        }
    }
    if ((unsigned)options->specular_model > BURNISH_SPECULAR_PHONG) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "specular model %d does not exist",
                            (int)options->specular_model);
    }
    if (!is_light_color(options->ambient_light)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "ambient light: not in [0, 1e6]");
    }
    return BURNISH_STATUS_OK;
}

/* half_u x half_v, which must not vanish. */
static int has_sides(const burnish_area_light *light) {
    const burnish_vec3 u = burnish_vec3_load(light->half_u), v = burnish_vec3_load(light->half_v);
    const double sine = burnish_vec3_length(
        burnish_vec3_cross(burnish_vec3_normalize(u), burnish_vec3_normalize(v)));
    return all_finite(light->half_u, 3) && all_finite(light->half_v, 3) && sine >= LEAST_SINE;
}

/* What is wrong with the sizes of a sphere or line, or NULL. */
static const char *wrong_of_round(const burnish_area_light *light) {
    const int is_line = light->shape == BURNISH_AREA_LINE;
    const double length = burnish_vec3_length(burnish_vec3_load(light->half_u));
    const double radius = is_line ? burnish_vec3_length(burnish_vec3_load(light->half_v)) : length;
    if (!(length > 0 && burnish_is_finite(length) && radius > 0 && burnish_is_finite(radius))) {
        return is_line ? "needs finite half_u and half_v that are not 0"
                       : "needs a finite half_u that is not 0";
    }
    return light->is_distant && !(radius < burnish_vec3_length(burnish_vec3_load(light->center)))
               ? "is distant: its radius must be less than the length of center"
               : NULL;
}

static burnish_status check_area_lights(const burnish_render_options *options,
                                        burnish_error *error) {
    if (options->area_light_count < 0 || options->area_light_count > BURNISH_AREA_LIGHT_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "area lights: %d is not in [0, %d]",
                            options->area_light_count, BURNISH_AREA_LIGHT_MAX);
    }
    for (int i = 0; i < options->area_light_count; ++i) {
        const burnish_area_light *light = &options->area_lights[i];
        const double *c = light->center;
        const char *wrong = NULL;
        const int is_flat = light->shape <= BURNISH_AREA_DISC;
        if ((unsigned)light->shape > BURNISH_AREA_LINE) {
            wrong = "has a shape that does not exist";
        } else if (!is_light_color(light->color)) {
            wrong = "needs a radiance in [0, 1e6]";
        } else if (is_flat && !has_sides(light)) {
            wrong = "needs two finite half sides that are not parallel";
        } else if (!all_finite(c, 3) ||
                   (light->is_distant && c[0] == 0 && c[1] == 0 && c[2] == 0)) {
            wrong = "needs a finite center (not 0 for a distant light)";
        } else if (!is_flat) {
            wrong = wrong_of_round(light);
        }
        if (wrong) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "area light %d: %s", i + 1, wrong);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_surroundings(const burnish_render_options *options,
                                         burnish_error *error) {
    const burnish_dome *dome = &options->dome;
    if (options->has_dome && (!is_light_color(dome->zenith) || !is_light_color(dome->horizon) ||
                              !is_light_color(dome->nadir))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "dome: needs radiances in [0, 1e6]");
    }
    if (options->reflection_distance != 0 &&
        !(options->reflection_distance >= 1.25f && options->reflection_distance <= 1e6f)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "reflection distance: %g is neither 0 nor in [1.25, 1e6]",
                            (double)options->reflection_distance);
    }
    for (int k = 0; options->has_dome && k < 3; ++k) {
        const double h = (double)dome->horizon[k];
        const double b = ((double)dome->zenith[k] - (double)dome->nadir[k]) / 2;
        const double a = ((double)dome->zenith[k] + (double)dome->nadir[k]) / 2 - h;
        /* radiance h + b y + a y^2: its least is h - b^2 / 4a, at y = -b / 2a */
        if (a > 0 && b * b < 4 * a * a && b * b > 4 * a * h) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "dome: the radiance is negative between zenith, horizon and nadir; "
                                "raise the horizon's");
        }
    }
    if (!(options->environment_strength >= 0 && options->environment_strength <= 1e6f)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "environment: a strength of %g is not in [0, 1e6]",
                            (double)options->environment_strength);
    }
    if (!all_finite(&options->environment_turn, 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "environment: the turn must be a finite number of degrees");
    }
    if (options->background_environment && (!options->environment || options->transparent)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "background: %s",
                            options->transparent
                                ? "it can't be transparent and show the environment; choose one"
                                : "there is no environment to show; set one");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_tones(const burnish_render_options *options, burnish_error *error) {
    if ((unsigned)options->tone_mapping >= BURNISH_TONES_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "tone mapping %d does not exist",
                            (int)options->tone_mapping);
    }
    if (!(options->exposure >= -BURNISH_EXPOSURE_MAX &&
          options->exposure <= BURNISH_EXPOSURE_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "exposure: %g stops are not in [-%d, %d]", (double)options->exposure,
                            BURNISH_EXPOSURE_MAX, BURNISH_EXPOSURE_MAX);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_occlusion(const burnish_render_options *options, burnish_error *error) {
    if (options->occlusion < BURNISH_OCCLUSION_AUTO || options->occlusion > BURNISH_OCCLUSION_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "occlusion: %d directions are not in [0, %d], nor automatic",
                            options->occlusion, BURNISH_OCCLUSION_MAX);
    }
    if (!(options->occlusion_strength >= 0 && options->occlusion_strength <= 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "occlusion: a strength of %g is not in [0, 1]",
                            (double)options->occlusion_strength);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_ground(const burnish_render_options *options, burnish_error *error) {
    if (!all_finite(options->up, 3)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "up: needs three finite numbers");
    }
    if (options->ground != 0 && options->ground != 1) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "ground: %d is neither 0 nor 1",
                            options->ground);
    }
    if (options->shadow != 0 && options->shadow != 1) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "shadow: %d is neither 0 nor 1",
                            options->shadow);
    }
    const int has_point =
        options->light_count > 0 && options->lights[0].kind != BURNISH_LIGHT_DIRECTIONAL;
    if (options->shadow &&
        (has_point || (options->light_count < 1 && options->area_light_count < 1))) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "shadow: %s; put a directional light first%s",
                            has_point ? "the first light is a point light" : "there is no light",
                            has_point ? "" : ", or use an area light");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_edges(const burnish_render_options *options, burnish_error *error) {
    const burnish_edge_flags all = BURNISH_EDGES_FEATURES | BURNISH_EDGES_ALL |
                                   BURNISH_EDGES_AXIS_VIEWS | BURNISH_EDGES_HIDDEN |
                                   BURNISH_EDGES_CENTERS | BURNISH_EDGES_TANGENTS;
    if (options->edges & ~all) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "edges: %u is not a sum of BURNISH_EDGES_... values", options->edges);
    }
    if (!(options->edge_width > 0 && options->edge_width <= BURNISH_EDGE_WIDTH_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "edges: a width of %g pixels is not in (0, %d]",
                            (double)options->edge_width, BURNISH_EDGE_WIDTH_MAX);
    }
    if (!(options->edge_opacity >= 0 && options->edge_opacity <= 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "edges: an opacity of %g is not in [0, 1]",
                            (double)options->edge_opacity);
    }
    if (options->outline_contrast < 0 || options->outline_contrast > 255) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "outline: a contrast of %d is not in [0, 255]",
                            options->outline_contrast);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_render_options_check(const burnish_render_options *options,
                                            burnish_error *error) {
    burnish_status status = burnish_render_options_check_cookie(options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (options->width < 1 || options->width > BURNISH_IMAGE_MAX_SIZE || options->height < 1 ||
        options->height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "resolution %dx%d: each side must be in [1, %d]", options->width,
                            options->height, BURNISH_IMAGE_MAX_SIZE);
    }
    if (options->first_row < 0 || options->row_count < 0 ||
        options->first_row > options->height - options->row_count ||
        (options->row_count == 0 && options->first_row > 0)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "rows: %d from %d on are not among the picture's %d; 0 from 0 on means all",
            options->row_count, options->first_row, options->height);
    }
    if (options->samples != 1 && options->samples != 4 && options->samples != 8 &&
        options->samples != BURNISH_MAX_SAMPLES) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "samples: %d is not 1, 4, 8 or 16",
                            options->samples);
    }
    if (options->threads < 0 || options->threads > BURNISH_THREADS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "threads: %d is not in [0, %d]",
                            options->threads, BURNISH_THREADS_MAX);
    }
    if (!(options->max_overdraw >= 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "max-overdraw: %g is not at least 1; HUGE_VAL means no limit",
                            options->max_overdraw);
    }
    status = burnish_lobe_spec_check(&options->lobe, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_camera(&options->camera, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_lens(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_occlusion(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_tones(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_edges(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_ground(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_area_lights(options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_surroundings(options, error);
    }
    return status == BURNISH_STATUS_OK ? check_lights(options, error) : status;
}

/* ---- Views along an axis ---- */

/* Of lines in views along an axis, times the options'. */
#define AXIS_WIDTH 0.7f
#define AXIS_OPACITY 0.55f

/* A direction along an axis: the sine of its angle to it. */
#define AXIS_SINE 1e-6

static int looks_along_axis(const burnish_camera *camera) {
    const burnish_vec3 d = burnish_vec3_normalize(burnish_vec3_sub(
        burnish_vec3_load(camera->focal_point), burnish_vec3_load(camera->position)));
    const double x = d.x * d.x, y = d.y * d.y, z = d.z * d.z, least = 1 - AXIS_SINE * AXIS_SINE;
    return camera->orthographic_height > 0 && (x >= least || y >= least || z >= least);
}

burnish_render_options burnish_render_options_resolve(const burnish_render_options *options) {
    burnish_render_options resolved = *options;
    resolved.edges &= ~BURNISH_EDGES_AXIS_VIEWS;
    if (options->edges == BURNISH_EDGES_AXIS_VIEWS && looks_along_axis(&options->camera)) {
        resolved.edges = BURNISH_EDGES_FEATURES;
        resolved.edge_width *= AXIS_WIDTH;
        resolved.edge_opacity *= AXIS_OPACITY;
    }
    return resolved;
}
