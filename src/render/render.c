/* burnish_render: checks the options and leads the data through raster, shade and image. */
#include "burnish/render.h"

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

static burnish_status check_options(const burnish_render_options *options, burnish_error *error) {
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

static size_t count_drawn(const uint8_t *drawn, size_t count) {
    size_t sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += drawn[i];
    }
    return sum;
}

static int needs_position(const burnish_kernels_lighting *lighting) {
    int needs = lighting->local_viewer;
    for (int i = 0; i < lighting->light_count; ++i) {
        needs |= lighting->lights[i].kind == BURNISH_LIGHT_POINT;
    }
    return needs;
}

/* What is kept from frame to frame. */
struct burnish_renderer {
    burnish_tasks tasks;
    int pool_threads; /* that the pool was made for */
    burnish_geometry geometry;
    burnish_attributes attributes;
    burnish_tiles tiles;
    burnish_srgb_encoder encoder;
    const burnish_kernels *best; /* to ask the processor takes as long as a tile */
    uint8_t *drawn;              /* a byte a triangle */
    size_t drawn_capacity;
};

burnish_status burnish_renderer_create(burnish_renderer **renderer, burnish_error *error) {
    if (!renderer) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "renderer: NULL; pass the place of a pointer");
    }
    *renderer = calloc(1, sizeof **renderer);
    if (!*renderer) {
        return burnish_fail_memory(error, "a renderer", sizeof **renderer);
    }
    burnish_srgb_encoder_make(&(*renderer)->encoder);
    return BURNISH_STATUS_OK;
}

void burnish_renderer_destroy(burnish_renderer *renderer) {
    if (renderer) {
        burnish_tiles_destroy(&renderer->tiles);
        burnish_attributes_destroy(&renderer->attributes);
        burnish_geometry_destroy(&renderer->geometry);
        free(renderer->drawn);
        free(renderer);
    }
}

/* Vertices to the screen, triangles to their chunks. */
static burnish_status transform(burnish_renderer *renderer, const burnish_mesh_view *mesh,
                                const burnish_render_options *options, const burnish_isa_ops *ops,
                                const burnish_raster_view *view, burnish_error *error) {
    burnish_status status =
        burnish_geometry_update(&renderer->geometry, ops, view, mesh->positions, mesh->vertex_count,
                                mesh->indices, mesh->triangle_count, &renderer->tasks, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_attributes_update(
            &renderer->attributes, &renderer->geometry, mesh->normals,
            options->ignore_colors ? NULL : mesh->colors, mesh->indices, &renderer->tasks, error);
    }
    return status;
}

/* Everything after the checks but for the materials; *image is allocated. */
static burnish_status draw(burnish_renderer *renderer, const burnish_mesh *scene,
                           const burnish_render_options *options, burnish_shader *shader,
                           burnish_image *image, burnish_counts counts,
                           burnish_render_report *report, burnish_error *error) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(scene);
    burnish_raster_view view;
    const double start = burnish_seconds_now();
    burnish_status status =
        burnish_view_create(mesh, options, &view, &shader->rays, &shader->lighting, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!options->batch && !renderer->best) {
        renderer->best = burnish_kernels_best(); /* asking the processor takes microseconds */
    }
    shader->batch = options->batch ? options->batch : renderer->best;
    shader->attributes = &renderer->attributes;
    shader->triangle_materials = mesh->triangle_materials;
    shader->needs_position = needs_position(&shader->lighting);
    report->isa = burnish_kernels_isa(shader->batch);
    status = burnish_shader_check(shader, burnish_mesh_material_count(scene), error);
    if (status == BURNISH_STATUS_OK) {
        status = transform(renderer, mesh, options, shader->batch, &view, error);
        report->seconds_transform = burnish_seconds_now() - start;
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_frame frame = {.view = &view,
                                     .ops = shader->batch,
                                     .geometry = &renderer->geometry,
                                     .encoder = &renderer->encoder,
                                     .shader = shader,
                                     .options = options,
                                     .image = image,
                                     .pool = &renderer->tasks,
                                     .wants_counts = counts != BURNISH_COUNTS_NONE,
                                     .drawn =
                                         counts == BURNISH_COUNTS_ALL ? renderer->drawn : NULL};
        status = burnish_frame_draw(&frame, &renderer->tiles, report, error);
        report->seconds_draw = burnish_seconds_now() - start - report->seconds_transform;
    }
    return status;
}

/* The bytes where drawn triangles are marked, all 0. */
static burnish_status prepare_drawn(burnish_renderer *renderer, size_t triangles,
                                    burnish_error *error) {
    burnish_status status =
        burnish_legacy_reserve_discard((void **)&renderer->drawn, &renderer->drawn_capacity,
                                       triangles, 1, "drawn triangles", error);
    if (status == BURNISH_STATUS_OK && triangles > 0) {
        memset(renderer->drawn, 0, triangles);
    }
    return status;
}

/* An image of the options' size: the one that is there if it fits. */
static burnish_status prepare_image(burnish_image *image, const burnish_render_options *options,
                                    burnish_error *error) {
    const int channels = options->transparent ? 4 : 3;
    if (image->pixels && image->width == options->width && image->height == options->height &&
        image->channels == channels) {
        return BURNISH_STATUS_OK;
    }
    burnish_image_destroy(image);
    return burnish_image_create(image, options->width, options->height, channels, error);
}

burnish_status burnish_renderer_draw(burnish_renderer *renderer, const burnish_mesh *scene,
                                     const burnish_render_options *options, burnish_image *image,
                                     burnish_render_report *report, burnish_error *error) {
    burnish_render_report own;
    burnish_shader shader;
    burnish_shade_material *materials = NULL;
    if (!renderer || !image || !scene) {
        burnish_image_destroy(image);
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "draw: the %s is NULL; create one first",
                            !renderer ? "renderer"
                            : !image  ? "image"
                                      : "scene");
    }
    memset(&own, 0, sizeof own);
    memset(&shader, 0, sizeof shader);
    burnish_status status = check_options(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = prepare_image(image, options, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(image);
        return status;
    }
    const burnish_counts counts = report ? options->counts : BURNISH_COUNTS_NONE;
    own.triangles = burnish_mesh_get_view(scene)->triangle_count;
    burnish_tasks_begin(&renderer->tasks, NULL, options->threads);
    own.threads = burnish_tasks_threads(&renderer->tasks);
    status = burnish_materials_create(scene, options, &materials, &own.lobe_fallbacks, error);
    shader.materials = materials;
    if (status == BURNISH_STATUS_OK && counts == BURNISH_COUNTS_ALL) {
        status = prepare_drawn(renderer, own.triangles, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw(renderer, scene, options, &shader, image, counts, &own, error);
    }
    free(materials);
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(image);
    } else if (report) {
        if (counts == BURNISH_COUNTS_ALL) {
            own.triangles_drawn = count_drawn(renderer->drawn, own.triangles);
        }
        *report = own;
    }
    return status;
}

burnish_status burnish_render(const burnish_mesh *scene, const burnish_render_options *options,
                              burnish_image *image, burnish_render_report *report,
                              burnish_error *error) {
    burnish_renderer *renderer;
    if (image) {
        memset(image, 0, sizeof *image);
    }
    burnish_status status = burnish_renderer_create(&renderer, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_draw(renderer, scene, options, image, report, error);
        burnish_renderer_destroy(renderer);
    }
    return status;
}
