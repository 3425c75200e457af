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

/* The direction in which the object stands. */
static burnish_vec3 up_of(const burnish_call *d) {
    const double *up = d->options->up;
    return up[0] == 0 && up[1] == 0 && up[2] == 0 ? burnish_vec3_loadf(d->mesh.view->up_axis)
                                                  : burnish_vec3_normalize(burnish_vec3_load(up));
}

/* Blended triangles cast no shadow, masked ones by their pieces. */
static burnish_status set_drawer(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_status status =
        burnish_casters_update(&renderer->casters, d->solid, &renderer->transparency, &d->memory);
    renderer->occlusion.drawer.ops = d->raster;
    renderer->occlusion.drawer.transparent = renderer->casters.transparent;
    renderer->occlusion.drawer.max_overdraw = d->options->max_overdraw;
    return status;
}

/* The depth maps, for points that count from `eye`. */
static burnish_status update_maps(burnish_call *d, const double eye[3],
                                  burnish_occlusion_lookup *lookup) {
    burnish_renderer *renderer = d->renderer;
    const burnish_render_options *options = d->options;
    const burnish_occlusion_options wanted = {
        .count = options->occlusion ? options->occlusion : BURNISH_OCCLUSION_AUTO,
        .side = options->width < options->height ? options->width : options->height,
        .eye = eye,
        .pixel = d->view.pixel};
    const burnish_status status = set_drawer(d);
    return status != BURNISH_STATUS_OK
               ? status
               : burnish_occlusion_update(&renderer->occlusion, &renderer->casters.mesh, &wanted,
                                          &renderer->tasks, &d->memory, lookup);
}

/* The mean light of the surfaces that are seen, on white: of a sphere in the middle of the object as
 * the camera sees it. */
static void find_mean_light(const burnish_call *d, float mean[3]) {
    enum { COUNT = 16 };
    const double golden_angle = 2.39996322972865332;
    const burnish_shading *shading = &d->view.shading;
    const burnish_area_view *view = &d->view.area;
    float normal[3][COUNT], position[3][COUNT], w[COUNT], light[3][COUNT];
    float *const rgb[3] = {light[0], light[1], light[2]};
    for (int i = 0; i < COUNT; ++i) { /* evenly over the disc that is seen */
        const double squared = (i + 0.5) / COUNT, radius = burnish_sqrt(squared);
        double sine, cosine;
        burnish_sincos(golden_angle * i, &sine, &cosine);
        const double n[3] = {radius * cosine, radius * sine, burnish_sqrt(1 - squared)};
        for (int k = 0; k < 3; ++k) {
            normal[k][i] = (float)(n[0] * view->axes[0][k] + n[1] * view->axes[1][k] +
                                   n[2] * view->axes[2][k]);
            position[k][i] = (float)-view->eye[k];
        }
        w[i] = 1;
    }
    const burnish_kernels_points points = {.normal = {normal[0], normal[1], normal[2]},
                                           .position = {position[0], position[1], position[2]},
                                           .w = w};
    shading->kernels->shade[shading->white->lobe.body][shading->white->geometry]
                           [BURNISH_SHADE_FLOAT](shading->white, &points, COUNT, NULL, rgb);
    if (shading->area) {
        burnish_area_add_white(shading->area, shading->kernels, &points, COUNT, rgb);
    }
    for (int k = 0; k < 3; ++k) {
        float sum = 0;
        for (int i = 0; i < COUNT; ++i) {
            sum += light[k][i];
        }
        mean[k] = sum / COUNT;
    }
}

/* Luminance of linear light. */
static float luminance_of(const float rgb[3]) {
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

/* The light of points and directions counts as that of a sky, which is this bright below where it is
 * 1 above: depth maps are too coarse for its shadow. It lights a sphere to a quarter on average. */
#define DARK_SKY 0.35f
#define SKY_OF_LIGHT (0.25f / (0.5f + 0.5f * DARK_SKY))

/* Of a lobe of order 2: a cap of its integral is 1.5 times a direction's part of the sphere. Less
 * shows the silhouettes of single directions, more takes shadows' direction away. */
#define DIRECTIONS_PER_ZETA 9.0f

/* Weighs the directions of occlusion by the light that arrives from them, except from the light
 * whose shadow is drawn. */
static void weigh_directions(burnish_call *d) {
    burnish_occlusion *occlusion = &d->renderer->occlusion;
    const burnish_render_options *options = d->options;
    const burnish_vec3 up = up_of(d);
    float w[3][BURNISH_OCCLUSION_MAX], rgb[3][BURNISH_OCCLUSION_MAX] = {{0}};
    float light[BURNISH_OCCLUSION_MAX], lamps = 0;
    for (int i = d->view.shading.shadow ? 1 : 0; i < options->light_count; ++i) {
        lamps += luminance_of(options->lights[i].color);
    }
    for (int i = 0; i < occlusion->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const float toward = occlusion->pairs[i / 2].toward[k];
            w[k][i] = i % 2 ? -toward : toward;
        }
    }
    if (d->view.shading.area) {
        const float count = (float)occlusion->count, zeta = count / DIRECTIONS_PER_ZETA;
        burnish_area_add_radiance(d->view.shading.area, options, &d->view.area, zeta > 1 ? zeta : 1,
                                  (const float *const[3]){w[0], w[1], w[2]}, occlusion->count,
                                  (float *const[3]){rgb[0], rgb[1], rgb[2]});
    }
    for (int i = 0; i < occlusion->count; ++i) {
        const float height = w[0][i] * (float)up.x + w[1][i] * (float)up.y + w[2][i] * (float)up.z;
        const float sky = DARK_SKY + (1 - DARK_SKY) * (0.5f + 0.5f * height);
        light[i] = luminance_of((float[3]){rgb[0][i], rgb[1][i], rgb[2][i]}) +
                   luminance_of(options->ambient_light) + lamps * SKY_OF_LIGHT * sky;
    }
    burnish_occlusion_weigh(occlusion, light);
}

/* What ambient occlusion needs of the mesh. */
static burnish_status update_occlusion(burnish_call *d) {
    d->view.shading.occlusion = NULL;
    if (d->options->occlusion == 0 || !d->target.pixels.pixels) {
        return BURNISH_STATUS_OK;
    }
    d->view.occlusion.strength = d->options->occlusion_strength;
    d->view.shading.occlusion = &d->view.occlusion;
    find_mean_light(d, d->view.occlusion.mean);
    const burnish_status status = update_maps(d, d->view.eye, &d->view.occlusion);
    d->report.occlusion_directions = d->view.occlusion.count;
    if (status == BURNISH_STATUS_OK) {
        weigh_directions(d);
    }
    return status;
}

/* The depth map of the light that casts a shadow. */
static burnish_status update_shadow(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    const burnish_render_options *options = d->options;
    const int side = options->width > options->height ? options->width : options->height;
    const burnish_area *area = d->view.shading.area;
    const int is_area = options->light_count == 0, has_key = !is_area || (area && area->key >= 0);
    const burnish_shadow_options wanted = {
        .toward = is_area && has_key ? area->toward_key : d->view.key,
        .size = side <= BURNISH_SHADOW_SMALL ? BURNISH_SHADOW_SMALL : BURNISH_SHADOW_LARGE,
        .is_area = is_area,
        .eye = d->view.eye};
    d->view.shading.shadow = NULL;
    if (!options->shadow || !d->target.pixels.pixels || !has_key) {
        /* occlusion draws the shadow of a wide light */
        d->report.shadow = options->shadow && area && burnish_vec3_length(area->toward_key) > 0;
        return BURNISH_STATUS_OK;
    }
    const burnish_status status = set_drawer(d);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    d->view.shading.shadow = &d->view.shadow;
    d->report.shadow = 1;
    return burnish_shadow_update(&renderer->shadow, &renderer->occlusion.drawer,
                                 &renderer->casters.mesh, &wanted, &renderer->tasks, &d->memory,
                                 &d->view.shadow);
}

/* Light from many directions. */
static burnish_status update_area(burnish_call *d, burnish_texturing *texturing) {
    burnish_renderer *renderer = d->renderer;
    const int needed = d->target.pixels.pixels && burnish_area_is_needed(d->options);
    d->view.shading.area = needed ? &renderer->area : NULL;
    if (texturing) {
        texturing->wants_reflectance = needed;
    }
    burnish_vec3_store(up_of(d), d->view.area.up);
    d->view.shading.needs_position |= needed && d->options->reflection_distance > 0;
    for (int i = 0; i < d->options->area_light_count; ++i) {
        d->view.shading.needs_position |= !d->options->area_lights[i].is_distant;
    }
    return needed ? burnish_area_update(&renderer->area, &d->mesh, d->options, &d->view.area,
                                        texturing, &renderer->tasks, &d->memory)
                  : BURNISH_STATUS_OK;
}

/* The ground's shadow, where the camera sees it; before what occlusion needs, whose maps it takes.
 */
static burnish_status update_ground(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    burnish_ground *ground = &renderer->ground;
    const burnish_mesh_view *mesh = d->solid;
    const burnish_vec3 eye = burnish_vec3_load(d->view.eye);
    const double origin[3] = {0, 0, 0};
    const burnish_render_options *options = d->options;
    const int is_directional = options->light_count > 0;
    const burnish_area *area = is_directional ? NULL : d->view.shading.area;
    const burnish_ground_light light = {
        .occlusion = &renderer->occlusion,
        .shadow = d->report.shadow && is_directional ? &renderer->shadow : NULL,
        .key = area ? area->toward_key : (burnish_vec3){0, 0, 0},
        .side = options->width < options->height ? options->width : options->height};
    burnish_occlusion_lookup lookup;
    if (!options->ground || !d->target.pixels.pixels) {
        return BURNISH_STATUS_OK;
    }
    burnish_ground_place(ground, mesh, up_of(d));
    d->report.ground = burnish_ground_is_seen(ground, &d->view.shading.rays, eye);
    if (!d->report.ground) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = update_maps(d, origin, &lookup);
    if (status == BURNISH_STATUS_OK && !burnish_ground_is_drawn(ground, &light)) {
        status =
            burnish_ground_draw(ground, d->view.shading.ops, &light, &renderer->tasks, &d->memory);
    }
    d->view.ground =
        burnish_ground_look(ground, &d->view.shading.rays, eye, options->width, options->height);
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
                                          ? burnish_backdrop_make(d->options, up_of(d))
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
    row.target = burnish_target_default();
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
    whole.target = burnish_target_default();
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

/* Splats over the background. */
static burnish_status draw_splats(burnish_call *d) {
    const burnish_row_range rows = burnish_drawn_rows(d->options);
    const burnish_splat_call call = {.mesh = d->splats,
                                     .view = &d->view.raster,
                                     .target = &d->target,
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
        status = update_area(d, texturing);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_shadow(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_ground(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_occlusion(d);
    }
    if (status == BURNISH_STATUS_OK) {
        d->report.seconds_transform = burnish_seconds_now() - start;
    }
    const int has_edges = d->options->edges && d->report.triangles > 0;
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
    if (status == BURNISH_STATUS_OK) {
        d->report.seconds_draw = burnish_seconds_now() - start - d->report.seconds_transform;
    }
    return status;
}
