#include "render/frame/steps.h"

#include <string.h>

#include "base/clock.h"
#include "base/elementary.h"
#include "core/vec3.h"
#include "render/space.h"

/* NULL where every triangle is opaque. */
static const burnish_transparency *transparency_of(const burnish_call *d) {
    return d->renderer->transparency.has_some ? &d->renderer->transparency : NULL;
}

/* NULL where there are no negative volumes. */
static const burnish_carving *carving_of(const burnish_call *d) {
    return d->renderer->carving.own_count > 0 ? &d->renderer->carving : NULL;
}

static int is_part(const burnish_call *d) {
    return d->options->row_count > 0;
}

static burnish_picture_key key_of(const burnish_call *d) {
    const burnish_render_options *options = d->options;
    burnish_picture_key key;
    memset(&key, 0, sizeof key);
    key.version = d->renderer->transparency.version;
    key.camera = options->camera;
    key.view = d->view.raster;
    key.ignore_colors = options->ignore_colors;
    key.cull_back_faces = options->cull_back_faces;
    key.edges = options->edges;
    key.edge_width = options->edge_width;
    key.edge_opacity = options->edge_opacity;
    memcpy(key.edge_color, options->edge_color, sizeof key.edge_color);
    return key;
}

static double overdraw_limit(const burnish_call *d) {
    enum { LEAST_AREA = 512 * 512 };
    return burnish_overdraw_limit(&d->view.raster, d->options->max_overdraw, LEAST_AREA);
}

/* Vertices to the screen, triangles to batches; for rows of a picture only once. */
static burnish_status transform_geometry(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_mesh_view *mesh = d->mesh.view;
    const burnish_triangles triangles = {mesh->positions,
                                         mesh->vertex_count,
                                         mesh->indices,
                                         burnish_drawn_count(mesh),
                                         transparency_of(d) ? renderer->transparency.masks : NULL,
                                         mesh->point_radius};
    const burnish_picture_key key = key_of(d);
    const int is_done = is_part(d) && memcmp(&key, &renderer->picture, sizeof key) == 0;
    burnish_status status = BURNISH_STATUS_OK;
    memset(&renderer->picture, 0, sizeof renderer->picture);
    renderer->has_picture_lines &= is_done;
    renderer->has_outline &= is_done;
    if (!is_done) {
        status = burnish_geometry_update(&renderer->geometry, d->raster, &d->view.raster,
                                         &triangles, &renderer->tasks, d->memory.error);
    }
    if (status == BURNISH_STATUS_OK) {
        d->report.overdraw = burnish_overdraw(renderer->geometry.cells, &d->view.raster);
        status = burnish_check_overdraw(d->report.overdraw, overdraw_limit(d), "the picture",
                                        d->memory.error);
    }
    if (status == BURNISH_STATUS_OK && !is_done) {
        status = burnish_attributes_update(&renderer->attributes, &renderer->geometry, mesh,
                                           d->options->ignore_colors, &renderer->tasks, &d->memory);
    }
    if (status == BURNISH_STATUS_OK && transparency_of(d)) {
        status = burnish_transparency_add_clipped(&renderer->transparency, &renderer->geometry,
                                                  &d->memory);
    }
    if (status == BURNISH_STATUS_OK && carving_of(d)) {
        status = burnish_carving_find(&renderer->carving, &renderer->geometry, transparency_of(d),
                                      &d->view.raster, &d->memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_tasks_check(&renderer->tasks, d->memory.error);
    }
    if (status == BURNISH_STATUS_OK && is_part(d)) {
        renderer->picture = key;
    }
    burnish_tasks_progress(&renderer->tasks, BURNISH_STAGE_TRANSFORM, 1);
    return status;
}

static int marks_drawn(const burnish_call *d) {
    return d->counts == BURNISH_COUNTS_ALL || d->counts == BURNISH_COUNTS_AREA;
}

/* The bytes where drawn triangles are marked, all 0. */
static uint8_t *clear_drawn(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const size_t count = d->mesh.view->triangle_count;
    if (!marks_drawn(d) || count == 0) {
        return NULL;
    }
    renderer->drawn = burnish_reserve_discard(
        &d->memory, renderer->drawn, &renderer->drawn_capacity, count, 1, "drawn triangles");
    if (renderer->drawn) {
        memset(renderer->drawn, 0, count);
    }
    return renderer->drawn;
}

static void count_drawn(burnish_call *d) {
    for (size_t i = 0; marks_drawn(d) && i < d->report.triangles; ++i) {
        d->report.triangles_drawn += d->renderer->drawn[i];
    }
}

static burnish_vec3 corner_of(const burnish_mesh_view *mesh, size_t corner) {
    return burnish_vec3_loadf(mesh->positions + 3 * (size_t)mesh->indices[corner]);
}

/* Sums in the order of the triangles, whatever the threads. */
static void measure_hidden(burnish_call *d) {
    const burnish_mesh_view *mesh = d->solid;
    double hidden = 0, all = 0;
    for (size_t i = 0; d->counts == BURNISH_COUNTS_AREA && i < mesh->triangle_count; ++i) {
        const burnish_vec3 a = corner_of(mesh, 3 * i);
        const burnish_vec3 b = burnish_vec3_sub(corner_of(mesh, 3 * i + 1), a);
        const burnish_vec3 c = burnish_vec3_sub(corner_of(mesh, 3 * i + 2), a);
        const double area = burnish_vec3_length(burnish_vec3_cross(b, c));
        all += area;
        hidden += d->renderer->drawn[i] ? 0 : area;
    }
    d->report.hidden_share = all > 0 ? hidden / all : 0;
}

/* How often a tile may collect transparent layers: all passes together are the work that
 * max_overdraw allows. */
static int layer_passes(const burnish_call *d) {
    const double passes = overdraw_limit(d) / d->report.overdraw; /* by 0: inf */
    return passes < BURNISH_LAYER_PASSES ? (int)passes : BURNISH_LAYER_PASSES;
}

/* Tiles to pixels. */
static burnish_status draw_tiles(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_caps caps = d->mesh.view->cut_count > 0
                                  ? burnish_caps_create(d->solid, &d->view.raster)
                                  : (burnish_caps){0};
    const burnish_backdrop backdrop = d->options->background_environment
                                          ? burnish_backdrop_make(d->options, burnish_call_up(d))
                                          : (burnish_backdrop){0};
    renderer->geometry.points.opacity = renderer->transparency.opacities[0];
    burnish_frame frame = {
        .ops = d->raster,
        .geometry = &renderer->geometry,
        .surface = {&d->view.raster, &d->view.shading, &renderer->attributes,
                    d->mesh.view->triangle_materials, d->mesh.view->triangle_count,
                    transparency_of(d), caps.count > 0 ? &caps : NULL,
                    d->mesh.view->point_radius > 0 ? &renderer->geometry.points : NULL, 0},
        .output = {.ops = d->view.shading.ops,
                   .encoder = &renderer->encoder,
                   .view = &d->view,
                   .ground = d->report.ground ? &d->view.ground : NULL,
                   .backdrop = d->options->background_environment ? &backdrop : NULL,
                   .outline = d->outline,
                   .surface = d->surface,
                   .own_triangles = d->solid->triangle_count,
                   .hosts = carving_of(d) ? renderer->carving.hosts : NULL},
        .carving = carving_of(d),
        .counts_pixels = d->counts != BURNISH_COUNTS_NONE,
        .layer_passes = layer_passes(d),
        .drawn = clear_drawn(d),
        .tasks = &renderer->tasks,
        .context = renderer->context};
    burnish_status status = burnish_output_begin(&frame.output, &d->target, d->options,
                                                 &renderer->background, &d->memory);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_frame_draw(&frame, &renderer->tiles, &d->report, d->memory.error);
    }
    if (status == BURNISH_STATUS_OK) {
        count_drawn(d);
        measure_hidden(d);
    }
    return status;
}

/* The samples that a row of the picture covers, for the outline. */
static burnish_status draw_outline_row(const burnish_call *d, int y) {
    burnish_render_options options = *d->options;
    burnish_call row = *d;
    options.first_row = y;
    options.row_count = 1;
    row.options = &options;
    row.target = row.surface = burnish_target_default();
    row.counts = BURNISH_COUNTS_NONE;
    return draw_tiles(&row);
}

/* Tiles, and the hairline along the outline. */
static burnish_status draw_outlined(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    burnish_outline *outline = &renderer->outline;
    int rows[2] = {-1, -1};
    if (!d->target.pixels.pixels || !burnish_outline_is_wanted(d->options) ||
        burnish_mesh_get_info(d->mesh.mesh)->is_thumbnail) { /* whose object the file has drawn */
        renderer->has_outline = 0;
        return draw_tiles(d);
    }
    burnish_status status =
        burnish_outline_begin(outline, d->options, renderer->has_outline, rows, &d->memory);
    renderer->has_outline = 0;
    d->outline = outline;
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        status = rows[i] >= 0 ? draw_outline_row(d, rows[i]) : BURNISH_STATUS_OK;
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_tiles(d);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_outline_draw(outline, d->options, &d->target.pixels, &renderer->tasks);
        status = burnish_tasks_check(&renderer->tasks, d->memory.error);
        renderer->has_outline = status == BURNISH_STATUS_OK && is_part(d);
    }
    return status;
}

/* Lines from the target's depths and triangles. */
static burnish_status find_lines(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_line_view view = {&d->view.raster, d->view.distance};
    return burnish_line_art_update(&renderer->line_art, d->solid, &view, d->options, &d->target,
                                   &renderer->tasks, &d->memory);
}

/* The lines of all rows, where some are drawn: which show depends on what lies along them. */
static burnish_status find_picture_lines(const burnish_call *d) {
    burnish_line_art *art = &d->renderer->line_art;
    burnish_render_options options = *d->options;
    burnish_call whole = *d;
    options.first_row = options.row_count = 0;
    whole.options = &options;
    whole.target = whole.surface = burnish_target_default();
    whole.counts = BURNISH_COUNTS_NONE;
    burnish_status status = burnish_line_art_planes(art, &options, &whole.target, &whole.memory);
    if (status == BURNISH_STATUS_OK) {
        status = draw_tiles(&whole);
    }
    if (status == BURNISH_STATUS_OK) {
        status = find_lines(&whole);
    }
    burnish_line_art_drop_planes(art, d->memory.context);
    d->renderer->has_picture_lines = status == BURNISH_STATUS_OK;
    return status;
}

/* Tiles, and edges over them. */
static burnish_status draw_edged(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    burnish_line_art *art = &renderer->line_art;
    burnish_status status = BURNISH_STATUS_OK;
    if (!renderer->has_picture_lines) {
        memset(&art->lines, 0, sizeof art->lines);
        status = is_part(d) ? find_picture_lines(d)
                            : burnish_line_art_planes(art, d->options, &d->target, &d->memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = draw_outlined(d);
    }
    if (status == BURNISH_STATUS_OK && !is_part(d)) {
        status = find_lines(d);
    }
    if (status == BURNISH_STATUS_OK && d->target.pixels.pixels && art->lines.line_count > 0) {
        status =
            burnish_line_art_draw(art, d->options, &d->target.pixels, &renderer->tasks, &d->memory);
    }
    return status;
}

static burnish_tones tones_of(const burnish_render_options *options, const burnish_target *target) {
    const double exponent = (double)options->exposure * 0.693147180559945309417; /* ln 2 */
    return (burnish_tones){
        .is_linear = target->pixels.format == BURNISH_PIXELS_RGBA_FLOAT ||
                     (options->exposure == 0 && options->tone_mapping == BURNISH_TONES_NONE),
        .curve = options->tone_mapping,
        .exposure = (float)(1 + burnish_expm1(exponent))};
}

/* Planes of the opaque triangles among which splats are. */
static burnish_status reserve_surface(burnish_call *d) {
    const burnish_row_range rows = burnish_drawn_rows(d->options);
    const size_t width = (size_t)d->options->width, count = width * (size_t)(rows.end - rows.first);
    d->surface.depth = burnish_allocate(&d->memory, count, sizeof(float) + 1, "depths for splats");
    d->surface.coverage = d->surface.depth ? (uint8_t *)(d->surface.depth + count) : NULL;
    d->surface.depth_stride = width * sizeof(float);
    d->surface.coverage_stride = width;
    return d->memory.status;
}

/* Splats over the background and among triangles. */
static burnish_status draw_splats(burnish_call *d) {
    const burnish_row_range rows = burnish_drawn_rows(d->options);
    const burnish_splat_call call = {
        .mesh = d->splats,
        .view = &d->view.raster,
        .target = &d->target,
        .surface = &d->surface,
        .depth_scale = {d->view.distance.constant, d->view.distance.slope},
        .ops = d->view.shading.ops,
        .first_row = rows.first,
        .end_row = rows.end,
        .transparent = d->options->transparent,
        .max_overdraw = overdraw_limit(d)};
    return burnish_splats_draw(&call, &d->report, &d->renderer->tasks, &d->memory);
}

burnish_status burnish_call_run(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const double start = burnish_seconds_now();
    burnish_tasks_begin(&renderer->tasks, renderer->context, d->options->threads);
    d->view.shading.kernels = d->options->kernels ? d->options->kernels : renderer->best;
    d->report.isa = d->view.shading.kernels->isa;
    d->view.shading.ops = burnish_render_ops_for(d->report.isa);
    d->view.shading.tones = tones_of(d->options, &d->target);
    d->raster = burnish_raster_ops_for(d->report.isa);
    renderer->texturing.kernels = d->view.shading.kernels;
    renderer->texturing.ops = d->view.shading.ops;
    d->report.threads = burnish_tasks_threads(&renderer->tasks);
    d->report.triangles = d->solid->triangle_count;
    burnish_status status = burnish_carving_update(&renderer->carving, &d->mesh, &d->memory);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_layering_update(&renderer->layering, &d->mesh, &d->view.shading, &d->memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_texturing_update(&renderer->texturing, &d->mesh, d->options->samples,
                                          &renderer->tasks, &d->memory);
    }
    burnish_texturing *texturing = renderer->texturing.has_some ? &renderer->texturing : NULL;
    if (status == BURNISH_STATUS_OK) {
        status = burnish_view_create(&d->mesh, d->options, &renderer->shaders, texturing, &d->view,
                                     &d->memory);
        d->report.lobe_fallbacks = d->view.lobe_fallbacks;
        d->view.raster.cull_back_faces &= !carving_of(d);
        d->view.shading.hollow_from = renderer->carving.own_count;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_transparency_update(&renderer->transparency, &d->mesh, texturing,
                                             &renderer->tasks, &d->memory);
    }
    if (status == BURNISH_STATUS_OK) { /* first: what covers the picture too often needs no map */
        status = transform_geometry(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_call_find_light(d, texturing);
    }
    if (status == BURNISH_STATUS_OK) {
        d->report.seconds_transform = burnish_seconds_now() - start;
    }
    const int has_edges = d->options->edges && d->report.triangles > 0;
    if (status == BURNISH_STATUS_OK && d->splats && d->report.triangles > 0) {
        status = reserve_surface(d);
    }
    if (status != BURNISH_STATUS_OK || !has_edges) {
        memset(&renderer->line_art.lines, 0, sizeof renderer->line_art.lines);
        renderer->has_picture_lines = 0;
    }
    if (status == BURNISH_STATUS_OK) {
        status = (has_edges ? draw_edged : draw_outlined)(d);
    }
    if (status == BURNISH_STATUS_OK && d->splats) {
        status = draw_splats(d);
    }
    burnish_release(d->memory.context, d->surface.depth);
    if (status == BURNISH_STATUS_OK) {
        d->report.seconds_draw = burnish_seconds_now() - start - d->report.seconds_transform;
    }
    return status;
}
