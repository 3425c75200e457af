/* What a frame's light needs before its tiles are drawn: area lights, shadow, ground, occlusion. */
#include "base/elementary.h"
#include "core/vec3.h"
#include "render/frame/steps.h"
#include "render/space.h"

burnish_vec3 burnish_call_up(const burnish_call *d) {
    const double *up = d->options->up;
    return up[0] == 0 && up[1] == 0 && up[2] == 0 ? burnish_vec3_loadf(d->mesh.view->up_axis)
                                                  : burnish_vec3_normalize(burnish_vec3_load(up));
}

/* Whether rays replace depth maps. */
static int casts_rays(const burnish_call *d) {
    return d->options->raytracing && d->solid->point_radius == 0;
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

/* Whether the shadow of the first directional light is drawn. */
static int has_first_shadow(const burnish_call *d) {
    return d->report.shadow && d->options->light_count > 0;
}

/* The light that arrives from directions, except from the light whose shadow is drawn.
 *   count  at most BURNISH_OCCLUSION_MAX, evenly over the sphere */
static void find_radiance(const burnish_call *d, const burnish_render_options *options,
                          const float *const w[3], int count, float *radiance) {
    const burnish_vec3 up = burnish_call_up(d);
    float rgb[3][BURNISH_OCCLUSION_MAX] = {{0}}, lamps = 0;
    for (int i = has_first_shadow(d) ? 1 : 0; i < options->light_count; ++i) {
        lamps += luminance_of(options->lights[i].color);
    }
    if (d->view.shading.area) {
        const float zeta = (float)count / DIRECTIONS_PER_ZETA;
        burnish_area_add_radiance(d->view.shading.area, options, &d->view.area, zeta > 1 ? zeta : 1,
                                  w, count, (float *const[3]){rgb[0], rgb[1], rgb[2]});
    }
    for (int i = 0; i < count; ++i) {
        const float height = w[0][i] * (float)up.x + w[1][i] * (float)up.y + w[2][i] * (float)up.z;
        const float sky = DARK_SKY + (1 - DARK_SKY) * (0.5f + 0.5f * height);
        radiance[i] = luminance_of((float[3]){rgb[0][i], rgb[1][i], rgb[2][i]}) +
                      luminance_of(options->ambient_light) + lamps * SKY_OF_LIGHT * sky;
    }
}

/* Weighs the directions of occlusion by the light that arrives from them. */
static void weigh_directions(burnish_call *d) {
    burnish_occlusion *occlusion = &d->renderer->occlusion;
    float w[3][BURNISH_OCCLUSION_MAX], radiance[BURNISH_OCCLUSION_MAX];
    for (int i = 0; i < occlusion->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const float toward = occlusion->pairs[i / 2].toward[k];
            w[k][i] = i % 2 ? -toward : toward;
        }
    }
    find_radiance(d, d->options, (const float *const[3]){w[0], w[1], w[2]}, occlusion->count,
                  radiance);
    burnish_occlusion_weigh(occlusion, radiance);
}

/* How far off its triangle a ray starts: twice what positions that count from the eye are off. */
#define RAY_OFFSET 0x1p-14

/* Pixels of one surface are this near to its plane, in widths of a pixel. */
#define RAY_NEAR 2.0

/* The tree of volumes that refract, if there are any. */
static burnish_status update_volumes(burnish_call *d, burnish_ray_mesh mesh) {
    enum { BITS = 16 };
    const burnish_textured_material *materials = d->view.shading.texturing->materials;
    const uint16_t *of = d->solid->triangle_materials;
    const size_t count = mesh.view->triangle_count;
    int are_any = 0;
    uint16_t *out = burnish_allocate_zeroed(&d->memory, count / BITS + 1, sizeof *out, "volumes");
    for (size_t i = 0; out && i < count; ++i) {
        const int is_one = i < d->solid->triangle_count && materials[of ? of[i] : 0].refracts;
        out[i / BITS] |= (uint16_t)(!is_one << i % BITS);
        are_any |= is_one;
    }
    mesh.left_out = out;
    if (are_any && burnish_ray_tree_update(&d->renderer->volumes, &mesh, &d->renderer->tasks,
                                           &d->memory) == BURNISH_STATUS_OK) {
        d->view.ray_light.volumes = &d->renderer->volumes;
        d->view.ray_light.textured = materials;
    }
    burnish_release(d->renderer->context, out);
    return d->memory.status;
}

/* The trees of what casts shadows, and of what refracts. */
static burnish_status update_trees(burnish_call *d) {
    burnish_renderer *renderer = d->renderer;
    burnish_status status =
        burnish_casters_update(&renderer->casters, d->solid, &renderer->transparency, &d->memory);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_ray_mesh mesh = {.view = &renderer->casters.mesh,
                             .left_out = renderer->casters.transparent,
                             .scale = (float)burnish_space_scale(d->solid),
                             .most_work = 2 * d->options->max_overdraw};
    burnish_space_store(burnish_space_center(d->solid), mesh.center);
    d->view.ray_light.volumes = NULL;
    status = burnish_ray_tree_update(&renderer->rays, &mesh, &renderer->tasks, &d->memory);
    const burnish_texturing *texturing = d->view.shading.texturing;
    return status == BURNISH_STATUS_OK && d->view.ray_light.has_sky && texturing &&
                   texturing->has_passing
               ? update_volumes(d, mesh)
               : status;
}

/* No direction's light is less than this share of the mean, as with depth maps. */
#define LEAST_LIGHT 0.03125f

/* The light that rays to the sky stand for: all but that of lamps. */
static void find_sky(const burnish_call *d, burnish_ray_light *light) {
    enum { COUNT = BURNISH_RAY_LIGHT_EDGE * BURNISH_RAY_LIGHT_EDGE };
    _Static_assert((int)COUNT <= (int)BURNISH_OCCLUSION_MAX, "the table fits");
    burnish_render_options sky = *d->options;
    float w[3][COUNT], all[COUNT], mean = 0;
    for (int i = 0; i < COUNT; ++i) {
        const burnish_vec3 toward = burnish_ray_light_direction(i);
        w[0][i] = (float)toward.x;
        w[1][i] = (float)toward.y;
        w[2][i] = (float)toward.z;
    }
    const float *const directions[3] = {w[0], w[1], w[2]};
    find_radiance(d, d->options, directions, COUNT, all);
    for (int i = 0; i < COUNT; ++i) {
        mean += all[i] / COUNT;
    }
    sky.area_light_count = 0;
    find_radiance(d, &sky, directions, COUNT, light->sky);
    light->sky_mean = 0;
    for (int i = 0; i < COUNT; ++i) {
        const float least = mean > 0 ? LEAST_LIGHT * mean : 1;
        light->light[i] = light->sky[i] > least ? light->sky[i] : least;
        light->sky_mean += light->sky[i] / COUNT;
    }
}

/* Half the width of a directional light, as of the sun. */
#define SUN_RADIUS 0.0047

/* What rays need of the mesh, and where it is. */
static void set_space(const burnish_call *d, burnish_ray_light *light) {
    const double distance = burnish_vec3_length(burnish_vec3_load(d->view.eye));
    for (int k = 0; k < 3; ++k) {
        light->eye[k] = (float)d->view.eye[k];
        light->viewer[k] = (float)d->view.area.axes[2][k];
    }
    light->tree = &d->renderer->rays;
    light->ops = burnish_ray_ops_for(d->report.isa);
    light->mesh = d->mesh.view;
    light->solid = d->solid;
    light->shaders = d->view.shading.shaders;
    light->reflecting = d->view.shading.area ? d->view.shading.area->materials : NULL;
    light->pixels = &d->view.shading.rays;
    light->is_parallel = light->pixels->q_per_depth == 0;
    light->has_colors = d->solid->colors && !d->mesh.ignore_colors;
    light->scale = (float)burnish_space_scale(d->solid);
    burnish_space_store(burnish_space_center(d->solid), light->center);
    light->offset = (float)(RAY_OFFSET * (distance > 1 ? distance : 1));
    light->near = (float)(RAY_NEAR * d->view.pixel) + 2 * light->offset;
}

/* The lights whose shadows rays find. */
static void find_lamps(const burnish_call *d, burnish_ray_light *light) {
    const burnish_area *area = d->view.shading.area;
    burnish_area_light lamps[BURNISH_AREA_LIGHT_MAX];
    int numbers[BURNISH_AREA_LIGHT_MAX];
    const int count = area ? burnish_area_list(d->options, &d->view.area, lamps, numbers) : 0;
    light->lamp_count = 0;
    light->key = -1;
    for (int i = 0; i < count; ++i) {
        light->key = numbers[i] == area->key ? i : light->key;
        burnish_ray_light_add(light, &lamps[i]);
    }
    light->mirrored_lamps = count;
    if (has_first_shadow(d)) {
        burnish_area_light sun = {
            .shape = BURNISH_AREA_DISC, .is_distant = 1, .is_two_sided = 1, .color = {1, 1, 1}};
        const burnish_vec3 across = burnish_space_across(d->view.key);
        burnish_vec3_store(d->view.key, sun.center);
        burnish_vec3_store(burnish_vec3_scale(across, SUN_RADIUS), sun.half_u);
        burnish_vec3_store(burnish_vec3_scale(burnish_vec3_cross(d->view.key, across), SUN_RADIUS),
                           sun.half_v);
        light->key = light->lamp_count;
        burnish_ray_light_add(light, &sun);
        light->lamps[light->key].strength *=
            luminance_of(d->options->lights[0].color) / (float)(SUN_RADIUS * SUN_RADIUS);
    }
}

/* What rays need: the tree, where they start, and the light that they stand for. */
static burnish_status update_rays(burnish_call *d) {
    burnish_ray_light *light = &d->view.ray_light;
    d->view.shading.ray_light = NULL;
    if (!casts_rays(d) || !d->target.pixels.pixels ||
        !(d->options->occlusion || d->options->ground || d->report.shadow)) {
        return BURNISH_STATUS_OK;
    }
    set_space(d, light);
    light->has_sky = d->options->occlusion != 0;
    memcpy(light->ambient, d->options->ambient_light, sizeof light->ambient);
    burnish_ray_light_prepare(light);
    if (light->has_sky) {
        find_mean_light(d, light->tint);
        light->mean = luminance_of(light->tint);
        for (int k = 0; k < 3; ++k) {
            light->tint[k] = light->mean > 0 ? light->tint[k] / light->mean : 1;
        }
        find_sky(d, light);
        d->report.occlusion_directions = BURNISH_RAY_DIRECTIONS;
    }
    find_lamps(d, light);
    if (light->has_sky || light->key >= 0) {
        d->view.shading.ray_light = light;
    }
    return update_trees(d);
}

/* What ambient occlusion needs of the mesh. */
static burnish_status update_occlusion(burnish_call *d) {
    d->view.shading.occlusion = NULL;
    if (d->options->occlusion == 0 || !d->target.pixels.pixels) {
        return BURNISH_STATUS_OK;
    }
    d->view.occlusion.is_traced = casts_rays(d);
    d->view.occlusion.strength = d->options->occlusion_strength;
    d->view.shading.occlusion = &d->view.occlusion;
    find_mean_light(d, d->view.occlusion.mean);
    if (casts_rays(d)) {
        return BURNISH_STATUS_OK;
    }
    const burnish_status status = update_maps(d, d->view.eye, &d->view.occlusion);
    d->report.occlusion_directions = d->view.occlusion.count;
    if (status == BURNISH_STATUS_OK) {
        weigh_directions(d);
    }
    return status;
}

/* The depth map of the light that casts a shadow, unless rays find it. */
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
    d->report.shadow = status == BURNISH_STATUS_OK;
    if (status != BURNISH_STATUS_OK || casts_rays(d)) {
        return status; /* rays also find the shadow on the ground */
    }
    d->view.shading.shadow = &d->view.shadow;
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
    burnish_vec3_store(burnish_call_up(d), d->view.area.up);
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
        .shadow = d->report.shadow && is_directional && !casts_rays(d) ? &renderer->shadow : NULL,
        .rays = casts_rays(d) ? &d->view.ray_light : NULL,
        .sun = is_directional ? d->view.ray_light.key : -1,
        .key = area ? area->toward_key : (burnish_vec3){0, 0, 0},
        .side = options->width < options->height ? options->width : options->height};
    burnish_occlusion_lookup lookup;
    if (!options->ground || !d->target.pixels.pixels) {
        return BURNISH_STATUS_OK;
    }
    burnish_ground_place(ground, mesh, burnish_call_up(d));
    d->report.ground = burnish_ground_is_seen(ground, &d->view.shading.rays, eye);
    if (!d->report.ground) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = casts_rays(d) ? BURNISH_STATUS_OK : update_maps(d, origin, &lookup);
    if (status == BURNISH_STATUS_OK && !burnish_ground_is_drawn(ground, &light)) {
        status =
            burnish_ground_draw(ground, d->view.shading.ops, &light, &renderer->tasks, &d->memory);
    }
    d->view.ground =
        burnish_ground_look(ground, &d->view.shading.rays, eye, options->width, options->height);
    return status;
}

burnish_status burnish_call_find_light(burnish_call *d, burnish_texturing *texturing) {
    burnish_status status = update_area(d, texturing);
    if (status == BURNISH_STATUS_OK) {
        status = update_shadow(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_rays(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_ground(d);
    }
    if (status == BURNISH_STATUS_OK) {
        status = update_occlusion(d);
    }
    return status;
}
