/* A renderer: what is kept from frame to frame, and the checks of a call. */
#include <string.h>

#include "core/float_mode.h"
#include "render/frame/steps.h"

burnish_status burnish_renderer_create(const burnish_context *context, burnish_renderer **renderer,
                                       burnish_error *error) {
    if (!renderer) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "renderer: NULL; pass where to put it");
    }
    burnish_memory memory = burnish_memory_of(context, error);
    *renderer = burnish_allocate_zeroed(&memory, 1, sizeof **renderer, "a renderer");
    if (*renderer) {
        (*renderer)->context = context;
        (*renderer)->best = burnish_kernels_best();
        burnish_srgb_encoder_make(&(*renderer)->encoder);
    }
    return memory.status;
}

void burnish_renderer_destroy(burnish_renderer *renderer) {
    if (renderer) {
        const burnish_context *context = renderer->context;
        burnish_tiles_destroy(&renderer->tiles, context);
        burnish_occlusion_destroy(&renderer->occlusion, context);
        burnish_ray_tree_destroy(&renderer->rays, context);
        burnish_ray_tree_destroy(&renderer->volumes, context);
        burnish_line_art_destroy(&renderer->line_art, context);
        burnish_ground_destroy(&renderer->ground, context);
        burnish_shadow_destroy(&renderer->shadow, context);
        burnish_attributes_destroy(&renderer->attributes, context);
        burnish_transparency_destroy(&renderer->transparency, context);
        burnish_carving_destroy(&renderer->carving, context);
        burnish_casters_destroy(&renderer->casters, context);
        burnish_texturing_destroy(&renderer->texturing, context);
        burnish_area_destroy(&renderer->area, context);
        burnish_geometry_destroy(&renderer->geometry);
        burnish_layering_destroy(&renderer->layering, context);
        burnish_release(context, renderer->shaders.items);
        burnish_release(context, renderer->shaders.lights);
        burnish_release(context, renderer->background.bytes);
        burnish_release(context, renderer->drawn);
        burnish_release(context, renderer->outline.samples);
        burnish_release(context, renderer);
    }
}

const burnish_lines *burnish_renderer_get_lines(const burnish_renderer *renderer) {
    return renderer ? &renderer->line_art.lines : NULL;
}

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

/* Draws checked options into a checked target. */
static burnish_status draw_checked(burnish_renderer *renderer, const burnish_mesh *mesh,
                                   const burnish_render_options *options,
                                   const burnish_target *target, burnish_render_report *report,
                                   burnish_error *error) {
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    burnish_render_options resolved = burnish_render_options_resolve(options);
    burnish_call call = {.renderer = renderer,
                         .mesh = {mesh, burnish_mesh_get_view(mesh),
                                  burnish_mesh_get_material_count(mesh), options->ignore_colors,
                                  NULL, 0},
                         .solid = burnish_mesh_get_view(mesh),
                         .options = &resolved,
                         .splats = burnish_mesh_get_view(burnish_mesh_get_splats(mesh)),
                         .target = *target,
                         .counts = report ? options->counts : BURNISH_COUNTS_NONE,
                         .memory = burnish_memory_of(renderer->context, error)};
    burnish_mesh_view background = *call.solid;
    if (background.splats) { /* they have no light, and the rest draws nothing behind them */
        background.vertex_count = background.triangle_count = 0;
        background.point_radius = 0;
        call.solid = call.mesh.view = &background;
        resolved.occlusion = resolved.shadow = resolved.ground = resolved.edges = 0;
        resolved.outline_contrast = 0;
    }
    const burnish_status status = burnish_call_run(&call);
    if (status == BURNISH_STATUS_OK && report) {
        *report = call.report;
    }
    burnish_float_mode_leave(float_mode);
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
    return status == BURNISH_STATUS_OK
               ? draw_checked(renderer, mesh, options, target, report, error)
               : status;
}

/* An image of the options' rows: the one that is there if it fits. */
static burnish_status prepare_image(const burnish_context *context, burnish_image *image,
                                    const burnish_render_options *options, burnish_error *error) {
    const int channels = options->transparent ? 4 : 3;
    const burnish_row_range rows = burnish_drawn_rows(options);
    const int height = rows.end - rows.first;
    if (image->pixels && image->width == options->width && image->height == height &&
        image->channels == channels && image->context == burnish_memory_owner(context)) {
        return BURNISH_STATUS_OK;
    }
    burnish_image_destroy(image);
    return burnish_image_create(context, image, options->width, height, channels, error);
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
        status = prepare_image(renderer->context, image, options, error);
    }
    if (status == BURNISH_STATUS_OK) {
        target.pixels = burnish_image_get_pixels(image);
        status = draw_checked(renderer, mesh, options, &target, report, error);
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
    burnish_status status = burnish_render_options_check_cookie(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(options->context, &renderer, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_draw(renderer, mesh, options, image, report, error);
        burnish_renderer_destroy(renderer);
    }
    return status;
}
