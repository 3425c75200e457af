/* burnish_render and burnish_renderer: lead the data through raster, shading and the target. */
#include <string.h>

#include "core/clock.h"
#include "core/environment.h"
#include "core/memory.h"
#include "core/tasks.h"
#include "render/frame.h"
#include "render/materials.h"
#include "render/options.h"
#include "render/view.h"

/* What is kept from frame to frame. */
struct burnish_renderer {
    const burnish_context *context;
    burnish_tasks tasks;
    burnish_materials materials;
    burnish_shader_table shaders;
    burnish_geometry geometry;
    burnish_attributes attributes;
    burnish_tiles tiles;
    burnish_output_row background;
    burnish_srgb_encoder encoder;
    const burnish_kernels *best; /* asking the processor takes as long as drawing a tile */
    uint8_t *drawn;              /* a byte per triangle */
    size_t drawn_capacity;
};

burnish_status burnish_renderer_create(const burnish_context *context, burnish_renderer **renderer,
                                       burnish_error *error) {
    if (!renderer) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "renderer: NULL; pass where to put it");
    }
    burnish_memory memory = burnish_memory_of(context, error);
    *renderer = burnish_allocate_zeroed(&memory, 1, sizeof **renderer, "a renderer");
    if (*renderer) {
        (*renderer)->context = context;
        burnish_srgb_encoder_make(&(*renderer)->encoder);
    }
    return memory.status;
}

void burnish_renderer_destroy(burnish_renderer *renderer) {
    if (renderer) {
        const burnish_context *context = renderer->context;
        burnish_tiles_destroy(&renderer->tiles, context);
        burnish_attributes_destroy(&renderer->attributes, context);
        burnish_geometry_destroy(&renderer->geometry);
        burnish_shader_table_destroy(&renderer->shaders, context);
        burnish_release(context, renderer->materials.items);
        burnish_release(context, renderer->background.bytes);
        burnish_release(context, renderer->drawn);
        burnish_release(context, renderer);
    }
}

/* ---- A frame ---- */

/* What one call draws, and what it learns. */
typedef struct drawing {
    burnish_renderer *renderer;
    const burnish_mesh *mesh;
    const burnish_render_options *options;
    const burnish_target *target;
    burnish_counts counts;
    burnish_render_report report;
    burnish_memory memory;
    burnish_view view;
    burnish_shading shading;
} drawing;

/* Materials folded with the lights. */
static burnish_status fold_materials(drawing *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_kernels_lighting *lighting = &d->view.lighting;
    burnish_status status = burnish_materials_update(&renderer->materials, d->mesh, d->options,
                                                     &d->report.lobe_fallbacks, &d->memory);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_shader_table_update(&renderer->shaders, lighting, renderer->materials.items,
                                        burnish_mesh_material_count(d->mesh), &d->memory);
    }
    d->shading.rays = d->view.rays;
    d->shading.shaders = renderer->shaders.shaders;
    d->shading.needs_position = lighting->local_viewer;
    for (int i = 0; i < lighting->light_count; ++i) {
        d->shading.needs_position |= lighting->lights[i].kind == BURNISH_LIGHT_POINT;
    }
    d->shading.is_lyon = d->options->lobe.kind == BURNISH_LOBE_LYON &&
                         d->options->specular_model == BURNISH_SPECULAR_BLINN;
    return status;
}

/* Vertices to the screen, triangles to batches. */
static burnish_status transform(drawing *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_mesh_view *mesh = burnish_mesh_get_view(d->mesh);
    const burnish_triangles triangles = {mesh->positions, mesh->vertex_count, mesh->indices,
                                         mesh->triangle_count};
    burnish_status status =
        burnish_geometry_update(&renderer->geometry, d->shading.ops, &d->view.raster, &triangles,
                                &renderer->tasks, d->memory.error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_attributes_update(&renderer->attributes, &renderer->geometry, mesh,
                                           d->options->ignore_colors, &renderer->tasks, &d->memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_tasks_check(&renderer->tasks, d->memory.error);
    }
    burnish_tasks_progress(&renderer->tasks, BURNISH_STAGE_TRANSFORM, 1);
    return status;
}

/* The bytes where drawn triangles are marked, all 0. */
static uint8_t *clear_drawn(drawing *d) {
    burnish_renderer *renderer = d->renderer;
    const size_t count = d->report.triangles;
    if (d->counts != BURNISH_COUNTS_ALL) {
        return NULL;
    }
    renderer->drawn = burnish_reserve_discard(
        &d->memory, renderer->drawn, &renderer->drawn_capacity, count, 1, "drawn triangles");
    if (renderer->drawn) {
        memset(renderer->drawn, 0, count);
    }
    return renderer->drawn;
}

static void count_drawn(drawing *d) {
    for (size_t i = 0; d->counts == BURNISH_COUNTS_ALL && i < d->report.triangles; ++i) {
        d->report.triangles_drawn += d->renderer->drawn[i];
    }
}

/* Tiles to pixels. */
static burnish_status draw_tiles(drawing *d) {
    burnish_renderer *renderer = d->renderer;
    burnish_frame frame = {.ops = d->shading.ops,
                           .geometry = &renderer->geometry,
                           .surface = {&d->view.raster, &d->shading, &renderer->attributes,
                                       burnish_mesh_get_view(d->mesh)->triangle_materials},
                           .output = {.ops = d->shading.ops, .encoder = &renderer->encoder},
                           .has_planes = burnish_target_has_planes(d->target),
                           .counts_pixels = d->counts != BURNISH_COUNTS_NONE,
                           .drawn = clear_drawn(d),
                           .tasks = &renderer->tasks,
                           .context = renderer->context};
    frame.planes = (burnish_plane_writer){&frame.output, &frame.surface, d->view.distance};
    burnish_status status = burnish_output_begin(&frame.output, d->target, d->options,
                                                 &renderer->background, &d->memory);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_frame_draw(&frame, &renderer->tiles, &d->report, d->memory.error);
    }
    if (status == BURNISH_STATUS_OK) {
        count_drawn(d);
    }
    return status;
}

static const burnish_kernels *choose_kernels(burnish_renderer *renderer,
                                             const burnish_render_options *options) {
    if (!options->kernels && !renderer->best) {
        renderer->best = burnish_kernels_best();
    }
    return options->kernels ? options->kernels : renderer->best;
}

/* Everything after the checks. */
static burnish_status draw(drawing *d) {
    burnish_renderer *renderer = d->renderer;
    const double start = burnish_seconds_now();
    burnish_tasks_begin(&renderer->tasks, renderer->context, d->options->threads);
    d->shading.ops = choose_kernels(renderer, d->options);
    d->report.threads = burnish_tasks_threads(&renderer->tasks);
    d->report.isa = burnish_kernels_isa(d->shading.ops);
    d->report.triangles = burnish_mesh_get_view(d->mesh)->triangle_count;
    burnish_status status =
        burnish_view_create(burnish_mesh_get_view(d->mesh), d->options, &d->view, d->memory.error);
    if (status == BURNISH_STATUS_OK) {
        status = fold_materials(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = transform(d);
        d->report.seconds_transform = burnish_seconds_now() - start;
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_tiles(d);
        d->report.seconds_draw = burnish_seconds_now() - start - d->report.seconds_transform;
    }
    return status;
}

/* ---- Entries ---- */

static burnish_status check_call(const burnish_renderer *renderer, const burnish_mesh *mesh,
                                 const burnish_render_options *options, burnish_error *error) {
    if (!renderer || !mesh) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "draw: the %s is NULL; create one first",
                            !renderer ? "renderer" : "mesh");
    }
    burnish_status status = burnish_render_options_check(options, error);
    if (status == BURNISH_STATUS_OK && options->context && options->context != renderer->context) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "options: the renderer was made with another context; leave it NULL");
    }
    return status;
}

burnish_status burnish_renderer_draw_into(burnish_renderer *renderer, const burnish_mesh *mesh,
                                          const burnish_render_options *options,
                                          const burnish_target *target,
                                          burnish_render_report *report, burnish_error *error) {
    burnish_status status = check_call(renderer, mesh, options, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_target_check(target, options, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_environment environment = burnish_environment_enter();
    drawing d = {.renderer = renderer,
                 .mesh = mesh,
                 .options = options,
                 .target = target,
                 .counts = report ? options->counts : BURNISH_COUNTS_NONE,
                 .memory = burnish_memory_of(renderer->context, error)};
    status = draw(&d);
    if (status == BURNISH_STATUS_OK && report) {
        *report = d.report;
    }
    burnish_environment_leave(environment);
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

burnish_status burnish_renderer_draw(burnish_renderer *renderer, const burnish_mesh *mesh,
                                     const burnish_render_options *options, burnish_image *image,
                                     burnish_render_report *report, burnish_error *error) {
    if (!image) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "draw: the image is NULL; pass an empty one");
    }
    burnish_target target = burnish_target_default();
    burnish_status status = check_call(renderer, mesh, options, error);
    if (status == BURNISH_STATUS_OK) {
        status = prepare_image(image, options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        target.pixels = burnish_image_pixels(image);
        status = burnish_renderer_draw_into(renderer, mesh, options, &target, report, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(image);
    }
    return status;
}

burnish_status burnish_render(const burnish_mesh *mesh, const burnish_render_options *options,
                              burnish_image *image, burnish_render_report *report,
                              burnish_error *error) {
    burnish_renderer *renderer;
    if (image) {
        memset(image, 0, sizeof *image);
    }
    burnish_status status = burnish_render_options_check(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(options->context, &renderer, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_draw(renderer, mesh, options, image, report, error);
        burnish_renderer_destroy(renderer);
    }
    return status;
}
