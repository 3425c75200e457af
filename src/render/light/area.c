#include "render/light/area.h"

#include <string.h>

#include "base/numbers.h"
#include "core/vec3.h"
#include "environment/area_lights.h"
#include "environment/map_fill.h"

/* The least of the largest sizes of maps. */
enum { SMALL_MAP = 64 };

/* Pictures of so many pixels look up most directions: their maps of usual size are completed first. */
enum { LARGE_PICTURE = 1 << 20 };

/* The most alphas of a frame below BURNISH_LIGHT_ALPHA_USUAL, whose maps are large. */
enum { NARROW_ALPHAS = 4 };

/* ---- What shines ---- */

static int is_dark(const float color[3]) {
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

/* A distant light that turns its back to the object shines on nothing. */
static int light_shines(const burnish_area_light *light) {
    const burnish_vec3 u = burnish_vec3_load(light->half_u), v = burnish_vec3_load(light->half_v);
    const double front =
        burnish_vec3_dot(burnish_vec3_load(light->center), burnish_vec3_cross(u, v));
    return !is_dark(light->color) &&
           (!light->is_distant || light->is_two_sided || front < 0 || !burnish_area_is_flat(light));
}

static int has_environment(const burnish_render_options *options) {
    return options->environment && options->environment_strength > 0;
}

int burnish_area_is_needed(const burnish_render_options *options) {
    int needed = options->has_dome || has_environment(options);
    for (int i = 0; i < options->area_light_count; ++i) {
        needed |= light_shines(&options->area_lights[i]);
    }
    return needed;
}

/* ---- Sources in the space of the maps ---- */

/* Whether a light is in the maps; near ones and the one that casts a shadow are not. */
static int is_mapped(const burnish_area *area, const burnish_render_options *options, int number) {
    const burnish_area_light *light = &options->area_lights[number];
    return light->is_distant && number != area->key && light_shines(light);
}

/* Whether the maps are in camera space, where a camera that moves leaves them as they are. Else in
 * the mesh's axes. */
static int all_follow_camera(const burnish_area *area, const burnish_render_options *options) {
    int follow = (!options->has_dome || options->dome.follows_camera) &&
                 (!has_environment(options) || options->environment_follows_camera);
    for (int i = 0; i < options->area_light_count; ++i) {
        follow &= options->area_lights[i].follows_camera || !is_mapped(area, options, i);
    }
    return follow;
}

static burnish_vec3 from_camera_space(const burnish_area_view *view, const double v[3]) {
    const burnish_vec3 x = burnish_vec3_scale(burnish_vec3_load(view->axes[0]), v[0]);
    const burnish_vec3 y = burnish_vec3_scale(burnish_vec3_load(view->axes[1]), v[1]);
    const burnish_vec3 z = burnish_vec3_scale(burnish_vec3_load(view->axes[2]), v[2]);
    return burnish_vec3_add(burnish_vec3_add(x, y), z);
}

/* A vector in the space of the maps. */
static void store_vector(const burnish_area_view *view, int follows_camera, int in_camera_space,
                         const double v[3], double out[3]) {
    const int turns = follows_camera && !in_camera_space;
    burnish_vec3_store(turns ? from_camera_space(view, v) : burnish_vec3_load(v), out);
}

/* A picture needs no more texels across half of the sphere than half of its pixels. */
static int largest_map(const burnish_render_options *options) {
    const int side = options->width > options->height ? options->width : options->height;
    const int size = side / 4 * 2;
    return size < SMALL_MAP                   ? SMALL_MAP
           : size < BURNISH_LIGHT_MAP_LARGEST ? size
                                              : BURNISH_LIGHT_MAP_LARGEST;
}

static void gather_sources(const burnish_area *area, const burnish_render_options *options,
                           const burnish_area_view *view, int in_camera,
                           burnish_area_light lights[BURNISH_AREA_LIGHT_MAX],
                           burnish_light_sources *sources) {
    static const double y[3] = {0, 1, 0};
    double axes[3][3];
    *sources = (burnish_light_sources){.distant = lights,
                                       .strength = options->environment_strength,
                                       .largest = largest_map(options)};
    for (int i = 0; i < options->area_light_count; ++i) {
        const burnish_area_light *from = &options->area_lights[i];
        if (is_mapped(area, options, i)) {
            burnish_area_light *to = &lights[sources->distant_count++];
            *to = *from;
            store_vector(view, from->follows_camera, in_camera, from->center, to->center);
            store_vector(view, from->follows_camera, in_camera, from->half_u, to->half_u);
            store_vector(view, from->follows_camera, in_camera, from->half_v, to->half_v);
        }
    }
    if (options->has_dome) {
        const int follows = options->dome.follows_camera;
        sources->dome = &options->dome;
        store_vector(view, follows, in_camera, follows ? y : view->up, sources->up);
    }
    if (has_environment(options)) {
        const int follows = options->environment_follows_camera;
        sources->environment = options->environment;
        burnish_light_axes(follows ? y : view->up, options->environment_turn, axes);
        for (int k = 0; k < 3; ++k) {
            store_vector(view, follows, in_camera, axes[k], sources->environment_axes[k]);
        }
    }
}

/* ---- Near lights in the space of the points ---- */

/* A light in the space of the points, which count from the eye. */
static burnish_area_light near_light(const burnish_area_view *view,
                                     const burnish_area_light *from) {
    burnish_area_light light = *from;
    const double scale = from->is_distant ? 1 : from->follows_camera ? view->reach : view->scale;
    double *const to[3] = {light.center, light.half_u, light.half_v};
    for (int k = 0; k < 3; ++k) {
        burnish_vec3 v = burnish_vec3_load(to[k]);
        if (from->follows_camera) {
            v = from_camera_space(view, to[k]);
        } else if (k == 0 && !from->is_distant) {
            v = burnish_vec3_sub(v, burnish_vec3_load(view->origin));
        }
        v = burnish_vec3_scale(v, scale);
        if (k == 0 && !from->follows_camera && !from->is_distant) {
            v = burnish_vec3_sub(v, burnish_vec3_load(view->eye));
        }
        burnish_vec3_store(v, to[k]);
    }
    return light;
}

static void gather_near(burnish_area *area, const burnish_render_options *options,
                        const burnish_area_view *view) {
    burnish_near_lights *lights = &area->near_lights;
    lights->count = 0;
    lights->key = -1;
    for (int i = 0; i < options->area_light_count; ++i) {
        const burnish_area_light *from = &options->area_lights[i];
        if (light_shines(from) && !is_mapped(area, options, i)) {
            const burnish_area_light light = near_light(view, from);
            const int before = lights->count;
            burnish_near_lights_add(lights, &light);
            lights->key = i == area->key && lights->count > before ? before : lights->key;
        }
    }
}

/* ---- The light that casts a shadow ---- */

/* The cosine that a flat light is seen at from `center` away. */
static double facing_of(const burnish_area_light *light, burnish_vec3 normal, burnish_vec3 center) {
    const double facing = -burnish_vec3_dot(normal, center) /
                          (burnish_vec3_length(normal) * burnish_vec3_length(center) + 1e-300);
    return facing < 0 && light->is_two_sided ? -facing : facing;
}

static double luminance_of(const float rgb[3]) {
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

/* A light in the raster's space, in which the object's centre is 0. */
static burnish_area_light light_from_center(const burnish_area_view *view,
                                            const burnish_area_light *from) {
    burnish_area_light light = near_light(view, from);
    for (int k = 0; k < 3 && !light.is_distant; ++k) {
        light.center[k] += view->eye[k];
    }
    return light;
}

/* A light as the object's centre sees it: its direction, and how much it lights a surface there that
 * faces it, if it is a disc that is far away or on its axis. */
static double strength_of(const burnish_area_view *view, const burnish_area_light *from,
                          burnish_vec3 *toward) {
    const burnish_area_light light = light_from_center(view, from);
    const burnish_vec3 u = burnish_vec3_load(light.half_u), v = burnish_vec3_load(light.half_v);
    const burnish_vec3 normal = burnish_vec3_cross(u, v), center = burnish_vec3_load(light.center);
    const double radius = burnish_area_radius(&light);
    double cosine = 1, area = BURNISH_PI * radius * radius;
    *toward = burnish_vec3_normalize(center);
    if (burnish_area_is_flat(&light)) {
        area = (light.shape == BURNISH_AREA_RECT ? 4 : BURNISH_PI) * burnish_vec3_length(normal);
        cosine = facing_of(&light, normal, center);
    } else if (light.shape == BURNISH_AREA_LINE) {
        area = 4 * radius * burnish_vec3_length(burnish_vec3_cross(u, *toward));
    }
    return luminance_of(light.color) * area * cosine /
           (area + BURNISH_PI * burnish_vec3_dot(center, center));
}

/* Occlusion that takes most of what is hidden draws the shadow of a light of a larger solid angle than
 * this better than one depth map. */
#define WIDE 0.35

static int is_occluded(const burnish_render_options *options, const burnish_area_light *light,
                       double strength) {
    return options->occlusion != 0 && options->occlusion_strength >= 0.5f &&
           strength * BURNISH_PI > WIDE * luminance_of(light->color);
}

/* The strongest light, unless another one casts the shadow; the ground's needs no map. */
static void find_key(burnish_area *area, const burnish_render_options *options,
                     const burnish_area_view *view) {
    double most = 0;
    const int casts = options->light_count == 0 && (options->shadow || options->ground);
    area->key = -1;
    area->toward_key = (burnish_vec3){0, 0, 0};
    for (int i = 0; casts && i < options->area_light_count; ++i) {
        burnish_vec3 toward;
        const double strength = strength_of(view, &options->area_lights[i], &toward);
        if (light_shines(&options->area_lights[i]) && strength > most) {
            most = strength;
            area->key = options->shadow ? i : -1;
            area->toward_key = toward;
        }
    }
    if (area->key >= 0 && !options->raytracing &&
        is_occluded(options, &options->area_lights[area->key], most)) {
        area->key = -1;
    }
}

/* ---- Maps ---- */

static burnish_status update_maps(burnish_area *area, const burnish_render_options *options,
                                  const burnish_area_view *view, burnish_memory *memory) {
    burnish_area_light lights[BURNISH_AREA_LIGHT_MAX];
    burnish_light_sources sources;
    burnish_status status = BURNISH_STATUS_OK;
    const int is_camera = all_follow_camera(area, options);
    gather_sources(area, options, view, is_camera, lights, &sources);
    area->constants.diffuse = NULL;
    if (sources.distant_count == 0 && !sources.dome && !sources.environment) {
        return status;
    }
    if (!area->maps) {
        status = burnish_light_maps_create(memory->context, &area->maps, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_light_maps_set(area->maps, &sources, options->kernels, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        area->diffuse = *burnish_light_maps_diffuse(area->maps);
        area->constants.diffuse = &area->diffuse;
    }
    for (int k = 0; k < 9; ++k) {
        area->constants.axes[k / 3][k % 3] =
            is_camera ? (float)view->axes[k / 3][k % 3] : (k % 4 == 0 ? 1.0f : 0.0f);
    }
    return status;
}

/* ---- Materials ---- */

/* Whether a point's roughness is not the material's. */
static int varies_roughness(const burnish_textured_material *material) {
    const int slot = material->material.is_metallic ? BURNISH_TEXTURE_METALLIC_ROUGHNESS
                                                    : BURNISH_TEXTURE_EXPONENT;
    return material->is_varied && (material->has_normals || material->samplers[slot].levels);
}

static float clamped_value(float x, float low, float high) {
    return x > low ? x < high ? x : high : low;
}

/* The least roughness of a material's points: exponents only become lower. */
static float least_roughness(const burnish_textured_material *material, float roughness) {
    const double n = (double)material->material.exponent;
    const burnish_texture_levels *metal =
        material->samplers[BURNISH_TEXTURE_METALLIC_ROUGHNESS].levels;
    if (material->material.is_metallic) {
        return metal ? roughness * (float)metal->least[1] / 255 : roughness;
    }
    return clamped_value((float)burnish_sqrt(burnish_sqrt(2 / (n + 2))), 0.0f, roughness);
}

/* The alpha of a material that reflects, among those of the frame; levels if it varies or there are
 * too many. */
static void find_alpha(burnish_area *area, const burnish_textured_material *textured,
                       burnish_area_material *material) {
    const float roughness = material->reflecting.roughness;
    const int varies = textured && varies_roughness(textured);
    const float least =
        area->narrow_count < NARROW_ALPHAS ? area->least_alpha : BURNISH_LIGHT_ALPHA_USUAL;
    const float alpha = clamped_value(roughness * roughness, least, 1.0f);
    int i = 0;
    while (i < area->alpha_count && area->alphas[i] != alpha) {
        ++i;
    }
    if (varies || i == BURNISH_LIGHT_ALPHAS_MAX) {
        material->reflecting.has_levels = area->has_levels = 1;
        material->reflecting.specular = area->levels;
        const float lowest = varies ? least_roughness(textured, roughness) : roughness;
        const int first = (int)(lowest * (BURNISH_LIGHT_LEVELS - 1) - 0.01f); /* for rounding */
        area->first_level = first < area->first_level ? first : area->first_level;
        return;
    }
    material->alpha = i;
    material->reflecting.specular = &area->specular[i];
    if (i == area->alpha_count) {
        area->narrow_count += alpha < BURNISH_LIGHT_ALPHA_USUAL;
        area->alphas[area->alpha_count++] = alpha;
    }
}

/* Maps and near lobes of the frame's alphas. */
static burnish_status prepare_alphas(burnish_area *area, burnish_memory *memory) {
    burnish_status status = BURNISH_STATUS_OK;
    int count = area->alpha_count;
    for (int i = 0; area->constants.diffuse && i < count && status == BURNISH_STATUS_OK; ++i) {
        status =
            burnish_light_maps_need(area->maps, area->alphas[i], &area->specular[i], memory->error);
    }
    if (status == BURNISH_STATUS_OK && area->constants.diffuse && area->has_levels) {
        status =
            burnish_light_maps_levels(area->maps, area->first_level, area->levels, memory->error);
    }
    for (int i = 0; area->has_levels && i < BURNISH_LIGHT_LEVELS; ++i) {
        const float roughness = (float)i / (BURNISH_LIGHT_LEVELS - 1);
        area->alphas[count++] = clamped_value(roughness * roughness, area->least_alpha, 1.0f);
    }
    if (status == BURNISH_STATUS_OK && area->near_lights.count > 0) {
        status = burnish_near_lights_prepare(&area->near_lights, area->alphas, count, memory);
    }
    return status;
}

static burnish_reflecting_material reflecting_of(const burnish_material *from, int has_colors) {
    const int is_metallic = burnish_has_roughness(from);
    const float *color = from->is_metallic || !is_metallic ? from->diffuse : from->ambient;
    const float n = from->exponent, metallic = from->metallic;
    burnish_reflecting_material to = {.is_metallic = is_metallic, .reflects = is_metallic};
    if (from->is_unlit) {
        return (burnish_reflecting_material){.roughness = 1};
    }
    for (int k = 0; k < 3; ++k) { /* vertex colours replace a colour that the file lacks */
        const float base = has_colors && !from->has_diffuse ? 1.0f : color[k];
        const float f0 = is_metallic ? from->reflectance[k] * (1 - metallic) + base * metallic
                                     : 8 * from->specular[k] / (n + 4);
        to.reflects |= f0 > 0;
        to.diffuse[k] = is_metallic ? base * (1 - metallic) : base;
        to.reflectance[k] = clamped_value(f0, 0.0f, 1.0f);
    }
    to.edge_loss = is_metallic ? from->edge_loss * (1 - metallic) : 0;
    to.roughness =
        is_metallic ? from->roughness : (float)burnish_sqrt(burnish_sqrt(2 / ((double)n + 2)));
    return to;
}

/* Finds the materials that triangles have: others need no maps. */
static burnish_status find_used(burnish_area *area, const burnish_drawn_mesh *mesh,
                                burnish_memory *memory) {
    const burnish_mesh_view *view = mesh->view;
    if (area->used_mesh == view->serial) {
        return BURNISH_STATUS_OK;
    }
    area->used_mesh = 0;
    area->used = burnish_reserve_discard(memory, area->used, &area->used_capacity,
                                         mesh->material_count, 1, "materials");
    if (memory->status == BURNISH_STATUS_OK && mesh->material_count > 0) {
        memset(area->used, view->triangle_materials == NULL, mesh->material_count);
        for (size_t t = 0; view->triangle_materials && t < view->triangle_count; ++t) {
            area->used[view->triangle_materials[t]] = 1;
        }
        area->used_mesh = view->serial;
    }
    return memory->status;
}

static burnish_status update_materials(burnish_area *area, const burnish_drawn_mesh *mesh,
                                       const burnish_texturing *texturing, burnish_memory *memory) {
    const int has_colors = mesh->view->colors && !mesh->ignore_colors;
    burnish_status status = find_used(area, mesh, memory);
    const size_t count = mesh->material_count + mesh->coat_count;
    area->materials = burnish_reserve_discard(memory, area->materials, &area->material_capacity,
                                              count, sizeof *area->materials, "materials");
    status = memory->status;
    area->alpha_count = area->narrow_count = area->has_levels = 0;
    area->first_level = BURNISH_LIGHT_LEVELS - 1;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_material *from = burnish_drawn_material(mesh, i);
        const size_t base =
            i < mesh->material_count ? i : mesh->coats[i - mesh->material_count].base;
        const burnish_textured_material *textured = texturing ? &texturing->materials[i] : NULL;
        burnish_area_material *to = &area->materials[i];
        *to = (burnish_area_material){.reflecting = reflecting_of(from, has_colors)};
        for (int k = 0; k < 3 && textured && textured->is_varied; ++k) {
            to->reflecting.diffuse[k] = 1; /* points have it */
        }
        to->reflecting.reflects &= area->used[base];
        if (to->reflecting.reflects) {
            find_alpha(area, textured, to);
        }
    }
    return status == BURNISH_STATUS_OK ? prepare_alphas(area, memory) : status;
}

static void complete_map(burnish_light_map *map, burnish_tasks *tasks) {
    if (map->size <= BURNISH_LIGHT_MAP_USUAL) {
        burnish_light_map_complete(map, tasks);
    }
}

static void complete_maps(burnish_area *area, burnish_tasks *tasks) {
    complete_map(&area->diffuse, tasks);
    for (int i = 0; i < area->alpha_count; ++i) {
        complete_map(&area->specular[i], tasks);
    }
    for (int i = 0; area->has_levels && i < BURNISH_LIGHT_LEVELS; ++i) {
        complete_map(&area->levels[i], tasks);
    }
}

burnish_status burnish_area_update(burnish_area *area, const burnish_drawn_mesh *mesh,
                                   const burnish_render_options *options,
                                   const burnish_area_view *view,
                                   const burnish_texturing *texturing, burnish_tasks *tasks,
                                   burnish_memory *memory) {
    burnish_status status;
    area->constants = (burnish_environment_constants){.local_viewer = view->local_viewer};
    memcpy(area->constants.viewer, view->viewer, sizeof area->constants.viewer);
    if (options->reflection_distance > 0 && !has_environment(options)) {
        area->constants.nearness = 1 / options->reflection_distance;
        for (int k = 0; k < 3; ++k) {
            area->constants.offset[k] = (float)view->eye[k] * area->constants.nearness;
        }
    }
    area->least_alpha = burnish_light_least_alpha(largest_map(options));
    find_key(area, options, view);
    gather_near(area, options, view);
    status = update_maps(area, options, view, memory);
    status = status == BURNISH_STATUS_OK ? update_materials(area, mesh, texturing, memory) : status;
    if (status == BURNISH_STATUS_OK && area->constants.diffuse &&
        (int64_t)options->width * options->height >= LARGE_PICTURE) {
        complete_maps(area, tasks);
        status = burnish_tasks_check(tasks, memory->error);
    }
    return status;
}

void burnish_area_destroy(burnish_area *area, const burnish_context *context) {
    burnish_light_maps_destroy(area->maps);
    burnish_near_lights_destroy(&area->near_lights, context);
    burnish_release(context, area->materials);
    burnish_release(context, area->used);
    memset(area, 0, sizeof *area);
}

/* ---- Points ---- */

/* What textures say of points. */
static void read_textures(const burnish_area_batch *batch, burnish_kernels_points *points,
                          burnish_reflecting_points *each) {
    const burnish_textured_material *material = batch->textured;
    const burnish_texture_scratch *textures = batch->textures;
    for (int k = 0; k < 3; ++k) {
        each->diffuse[k] = textures->diffuse[k];
        if (material->is_varied) {
            points->normal[k] = material->has_normals ? textures->normal[k] : points->normal[k];
            each->reflectance[k] = textures->reflectance[k];
        }
    }
    if (material->is_varied) {
        const int has_occlusion = material->samplers[BURNISH_TEXTURE_OCCLUSION].levels != NULL;
        each->roughness = varies_roughness(material) ? textures->roughness : NULL;
        for (int k = 0; k < 3 && material->is_bent; ++k) {
            each->bent[k] = textures->bent[k];
        }
        each->edge_loss = material->has_edge ? textures->edge_loss : NULL;
        each->open = has_occlusion ? textures->open : NULL;
    }
}

void burnish_area_integrate(const burnish_area *area, const burnish_kernels *kernels,
                            const burnish_area_points *points, burnish_near_scratch *scratch,
                            float (*values)[BURNISH_NEAR_BATCH]) {
    const burnish_area_material *material = &area->materials[points->material];
    const burnish_reflecting_material *reflecting = &material->reflecting;
    const size_t count = (size_t)points->count;
    float *const axis[3] = {scratch->axis[0], scratch->axis[1], scratch->axis[2]};
    float(*const leaned)[BURNISH_NEAR_BATCH] = scratch->leaned;
    burnish_kernels_points mirrors = *points->points;
    for (int k = 0; k < 3 && points->bent; ++k) {
        mirrors.normal[k] = points->bent[k];
    }
    burnish_near_batch near = {.points = points->points,
                               .count = points->count,
                               .only_specular = points->only_specular,
                               .is_stretched = reflecting->is_metallic,
                               .alpha = -1,
                               .roughness = points->roughness};
    if (reflecting->reflects) {
        kernels->reflect_points(&area->constants, reflecting, &mirrors, points->roughness, count,
                                axis, NULL);
        if (near.is_stretched) {
            kernels->reflect_points(&area->constants, reflecting, &mirrors, points->roughness,
                                    count, (float *const[3]){leaned[0], leaned[1], leaned[2]},
                                    (float *const[3]){leaned[3], leaned[4], leaned[5]});
        }
        near.alpha = reflecting->has_levels ? area->alpha_count : material->alpha;
        near.level_count = reflecting->has_levels ? BURNISH_LIGHT_LEVELS : 0;
    }
    if (near.level_count > 0 && !near.roughness) { /* too many alphas */
        burnish_texture_fill(scratch->roughness, points->count, reflecting->roughness);
        near.roughness = scratch->roughness;
    }
    burnish_near_lights_shine(&area->near_lights, kernels, &near, scratch, values);
}

/* Integrates the points of a batch that no cell has lit: all light or the specular part. */
static void integrate_rest(const burnish_area *area, const burnish_kernels *kernels,
                           const burnish_area_batch *batch, const burnish_kernels_points *points,
                           int only_specular) {
    burnish_near_scratch *scratch = batch->scratch;
    const float *const from[7] = {
        points->normal[0],   points->normal[1],   points->normal[2], points->position[0],
        points->position[1], points->position[2], points->w};
    burnish_kernels_points rest = {.w = scratch->rest[6]};
    const int32_t *number = scratch->left.number[only_specular];
    const int count = scratch->left.count[only_specular];
    for (int i = 0; i < count; ++i) {
        const int32_t at = number[i];
        for (int k = 0; k < 7; ++k) {
            scratch->rest[k][i] = from[k][at];
        }
    }
    for (int i = count; i % 16; ++i) { /* vectors are read to their end */
        for (int k = 0; k < 7; ++k) {
            scratch->rest[k][i] = 0;
        }
    }
    for (int k = 0; k < 3; ++k) {
        rest.normal[k] = scratch->rest[k];
        rest.position[k] = scratch->rest[3 + k];
    }
    const burnish_area_points part = {&rest, batch->material, count, only_specular, NULL, NULL};
    burnish_area_integrate(area, kernels, &part, scratch, scratch->rest_values);
    for (int k = 0; k < BURNISH_NEAR_VALUES; ++k) {
        const int is_diffuse = k < BURNISH_NEAR_SPECULAR || k == BURNISH_NEAR_KEY_DIFFUSE;
        const float *own = scratch->rest_values[k];
        float *to = scratch->values[k];
        for (int i = 0; i < count && !(only_specular && is_diffuse); ++i) {
            to[number[i]] = own[i];
        }
    }
}

/* The light of near lights that arrives. */
static void add_near_lights(const burnish_area *area, const burnish_kernels *kernels,
                            const burnish_render_ops *ops, const burnish_area_batch *batch,
                            const burnish_kernels_points *points, burnish_reflecting_points *each) {
    burnish_near_scratch *scratch = batch->scratch;
    if (each->bent[0] || area->materials[batch->material].reflecting.has_levels) {
        const burnish_area_points all = {points,          batch->material,
                                         batch->count,    0,
                                         each->roughness, each->bent[0] ? each->bent : NULL};
        burnish_area_integrate(area, kernels, &all, scratch, scratch->values);
    } else {
        scratch->left.shown = batch->shown;
        ops->apply_near_cells(batch->cells, batch->material, points, batch->screen,
                              (size_t)batch->count, scratch->values, &scratch->left);
        if (scratch->left.count[0] > 0) {
            integrate_rest(area, kernels, batch, points, 0);
        }
        if (scratch->left.count[1] > 0 && area->materials[batch->material].reflecting.reflects) {
            integrate_rest(area, kernels, batch, points, 1);
        }
    }
    burnish_near_lights_add_key(&area->near_lights, points->first_light, batch->count,
                                scratch->values);
    for (int k = 0; k < 3; ++k) {
        each->near_diffuse[k] = scratch->values[BURNISH_NEAR_DIFFUSE + k];
        each->near_specular[k] = scratch->values[BURNISH_NEAR_SPECULAR + k];
    }
}

void burnish_area_add(const burnish_area *area, const burnish_kernels *kernels,
                      const burnish_render_ops *ops, const burnish_area_batch *batch,
                      float *const rgb[3]) {
    burnish_kernels_points points = *batch->points;
    burnish_reflecting_points each = {.open = NULL};
    each.clear = batch->open ? batch->open[BURNISH_SEEN_CLEAR] : NULL;
    for (int k = 0; k < 3; ++k) {
        each.diffuse[k] = points.diffuse[k];
        each.mirrored[k] = batch->open ? batch->open[BURNISH_SEEN_MIRRORED + k] : NULL;
        each.around[k] = batch->open ? batch->open[BURNISH_SEEN_AROUND + k] : NULL;
    }
    if (batch->textured) {
        read_textures(batch, &points, &each);
    }
    if (area->near_lights.count > 0) {
        add_near_lights(area, kernels, ops, batch, &points, &each);
    }
    kernels->add_environment(&area->constants, &area->materials[batch->material].reflecting,
                             &points, &each, (size_t)batch->count, rgb);
}

void burnish_area_add_radiance(const burnish_area *area, const burnish_render_options *options,
                               const burnish_area_view *view, float zeta, const float *const w[3],
                               int count, float *const rgb[3]) {
    burnish_area_light lights[BURNISH_AREA_LIGHT_MAX];
    burnish_map_filler filler = {.kernels = options->kernels};
    burnish_map_light light = {
        .filler = &filler, .lobes = {1, {{2, zeta, 1.0f}}}, .has_dome = 1, .has_environment = 1};
    filler.kernels = filler.kernels ? filler.kernels : burnish_kernels_best();
    gather_sources(area, options, view, 0, lights, &filler.sources);
    for (int i = 0; i < options->area_light_count; ++i) {
        const burnish_area_light *from = &options->area_lights[i];
        if (light_shines(from) && i != area->key && !from->is_distant) {
            burnish_area_light *to = &lights[filler.sources.distant_count];
            *to = light_from_center(view, from);
            const double distance = burnish_vec3_length(burnish_vec3_load(to->center));
            /* one around the centre has no direction */
            filler.sources.distant_count +=
                burnish_area_is_flat(to) || burnish_area_radius(to) < distance;
        }
    }
    burnish_map_light_add_polygons(&light);
    burnish_map_light_add(&light, w, count, rgb);
}

int burnish_area_list(const burnish_render_options *options, const burnish_area_view *view,
                      burnish_area_light lights[BURNISH_AREA_LIGHT_MAX], int numbers[]) {
    int count = 0;
    for (int i = 0; i < options->area_light_count; ++i) {
        if (light_shines(&options->area_lights[i])) {
            numbers[count] = i;
            lights[count++] = light_from_center(view, &options->area_lights[i]);
        }
    }
    return count;
}
