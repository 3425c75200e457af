/* The options of a frame and its target: defaults and checks. */
#include "render/options.h"

#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/memory.h"
#include "core/tasks.h"
#include "render/frame.h"
#include "render/materials.h"
#include "render/view.h"

/* Marks options that burnish_render_options_default() made. */
#define RENDER_COOKIE 0x62726e64u
#define TARGET_COOKIE 0x74677431u /* "tgt1" */

/* A key light from the upper left, a cooler and weaker fill from the right, a rim light from
 * behind: the photographer's three points. Directions in camera space. */
static const burnish_light DEFAULT_RIG[] = {
    {BURNISH_LIGHT_DIRECTIONAL, 1, {-0.55, 0.75, 0.85}, {1.22f, 1.19f, 1.13f}},
    {BURNISH_LIGHT_DIRECTIONAL, 1, {0.90, 0.15, 0.55}, {0.24f, 0.28f, 0.34f}},
    {BURNISH_LIGHT_DIRECTIONAL, 1, {0.35, 0.60, -0.80}, {0.68f, 0.68f, 0.72f}},
};

burnish_render_options burnish_render_options_default(void) {
    burnish_render_options options;
    memset(&options, 0, sizeof options);
    options.cookie = RENDER_COOKIE;
    options.width = 1024;
    options.height = 768;
    options.samples = 4;
    options.camera.view_up[1] = 1;
    options.camera.view_angle = 30;
    options.lobe.fit = BURNISH_FIT_ENERGY;
    options.lobe.order = 2;
    options.local_viewer = 1;
    for (int i = 0; i < 3; ++i) {
        options.ambient_light[i] = 0.08f;
        options.background[i] = 255;
    }
    memcpy(options.lights, DEFAULT_RIG, sizeof DEFAULT_RIG);
    options.light_count = sizeof DEFAULT_RIG / sizeof DEFAULT_RIG[0];
    return options;
}

static int finite(const double *values, int count) {
    for (int i = 0; i < count; ++i) {
        if (!(values[i] - values[i] == 0)) {
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
    if (!finite(camera->position, 3) || !finite(camera->focal_point, 3) ||
        !finite(camera->view_up, 3)) {
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
        if ((unsigned)light->kind > BURNISH_LIGHT_POINT || !finite(v, 3) || directionless ||
            !is_light_color(light->color)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "light %d: needs a finite vector (not 0 for a directional light) "
                                "and a colour in [0, 1e6]",
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

burnish_status burnish_render_options_check(const burnish_render_options *options,
                                            burnish_error *error) {
    if (!options || options->cookie != RENDER_COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: start from burnish_render_options_default()");
    }
    if (options->width < 1 || options->width > BURNISH_IMAGE_MAX_SIZE || options->height < 1 ||
        options->height > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "resolution %dx%d: each side must be in [1, %d]", options->width,
                            options->height, BURNISH_IMAGE_MAX_SIZE);
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
    burnish_status status = burnish_lobe_spec_check(&options->lobe, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_camera(&options->camera, error);
    }
    return status == BURNISH_STATUS_OK ? check_lights(options, error) : status;
}

/* ---- Targets ---- */

burnish_target burnish_target_default(void) {
    return (burnish_target){.cookie = TARGET_COOKIE};
}

/* Whether rows of `width` items of `size` bytes, made of words, fit a plane's stride. */
static burnish_status check_plane(const void *plane, size_t stride, size_t row, size_t word,
                                  const char *name, burnish_error *error) {
    if (plane && (stride < row || stride % word != 0)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: %s has a stride of %zu bytes; expected at least %zu, a "
                            "multiple of %zu",
                            name, stride, row, word);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_pixels(const burnish_pixels *pixels,
                                   const burnish_render_options *options, burnish_error *error) {
    if (!pixels->pixels) {
        return BURNISH_STATUS_OK;
    }
    if ((unsigned)pixels->format >= BURNISH_PIXELS_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: %d is no pixel format; expected RGB8, RGBA8, BGRA8 or "
                            "RGBA_FLOAT",
                            (int)pixels->format);
    }
    if (pixels->width != options->width || pixels->height != options->height) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: %d x %d pixels, but the options ask for %d x %d",
                            pixels->width, pixels->height, options->width, options->height);
    }
    if (options->transparent && pixels->format == BURNISH_PIXELS_RGB8) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: RGB8 has no alpha; use RGBA8 or BGRA8 for a transparent "
                            "background");
    }
    return check_plane(pixels->pixels, pixels->stride,
                       (size_t)pixels->width * burnish_pixel_size(pixels->format), 1, "pixels",
                       error);
}

burnish_status burnish_target_check(const burnish_target *target,
                                    const burnish_render_options *options, burnish_error *error) {
    if (!target || target->cookie != TARGET_COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: start from burnish_target_default()");
    }
    const size_t width = (size_t)options->width;
    burnish_status status = check_pixels(&target->pixels, options, error);
    const struct {
        const void *plane;
        size_t stride, size, word;
        const char *name;
    } planes[] = {{target->depth, target->depth_stride, 4, 4, "depth"},
                  {target->triangles, target->triangle_stride, 4, 4, "triangles"},
                  {target->normals, target->normal_stride, 12, 4, "normals"},
                  {target->coverage, target->coverage_stride, 1, 1, "coverage"}};
    for (size_t i = 0; i < sizeof planes / sizeof *planes && status == BURNISH_STATUS_OK; ++i) {
        status = check_plane(planes[i].plane, planes[i].stride, width * planes[i].size,
                             planes[i].word, planes[i].name, error);
    }
    return status;
}
