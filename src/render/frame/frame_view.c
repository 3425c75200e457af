/* Camera, lights and materials in the raster's space: all in double precision, rounded to float
 * once at the end. */

#include "render/frame/frame_view.h"

#include <string.h>

#include "base/error.h"
#include "base/numbers.h"
#include "core/vec3.h"

/* Distance of the near plane in units of the scene's size; a power of two, so 1/w can be computed
 * from the depth exactly. */
#define NEAR_PLANE 0x1p-14

/* Camera distances beyond this many scene sizes leave too few bits for the scene. */
#define MAX_DISTANCE 1e6

/* Entries of the matrices stay below this, and so do their products with coordinates: nothing
 * overflows on the way to the screen. */
#define LARGEST_ENTRY 1e36

/* The camera's position and axes in the raster's space (moved and scaled). */
typedef struct camera_frame {
    burnish_vec3 eye, right, up, forward;
    double scale; /* raster units a scene unit */
} camera_frame;

static burnish_status make_frame(const burnish_mesh_view *mesh, const burnish_camera *camera,
                                 camera_frame *frame, burnish_error *error) {
    burnish_vec3 position = burnish_vec3_load(camera->position);
    burnish_vec3 direction = burnish_vec3_sub(burnish_vec3_load(camera->focal_point), position);
    frame->scale = burnish_space_scale(mesh);
    frame->forward = burnish_vec3_normalize(direction);
    frame->right = burnish_vec3_normalize(
        burnish_vec3_cross(frame->forward, burnish_vec3_load(camera->view_up)));
    frame->up = burnish_vec3_cross(frame->right, frame->forward);
    frame->eye =
        burnish_vec3_scale(burnish_vec3_sub(position, burnish_space_center(mesh)), frame->scale);
    if (!(burnish_vec3_length(frame->forward) > 0.5)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: position and focal point are the same; move one");
    }
    if (!(burnish_vec3_length(frame->right) > 0.5)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: view up is parallel to the direction of view; turn it");
    }
    if (!(burnish_vec3_length(frame->eye) <= MAX_DISTANCE)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "camera: the position is more than %g scene sizes away; move it closer",
                            MAX_DISTANCE);
    }
    return BURNISH_STATUS_OK;
}

/* row . (p - origin, 1) = factor * axis . (p * scale - eye) + constant */
static void store_row(const camera_frame *frame, burnish_vec3 axis, double factor, double constant,
                      float row[4]) {
    burnish_space_store(burnish_vec3_scale(axis, factor * frame->scale), row);
    row[3] = (float)(constant - factor * burnish_vec3_dot(axis, frame->eye));
}

/* Moves the middle of the image away from the axis. */
static void move_axis(const double point[2], burnish_raster_view *raster, burnish_rays *rays) {
    for (int i = 0; i < 4; ++i) {
        raster->rows[0][i] += (float)point[0] * raster->rows[3][i];
        raster->rows[1][i] += (float)point[1] * raster->rows[3][i];
    }
    for (int k = 0; k < 3; ++k) {
        rays->ray[k] -= (float)point[0] * rays->ray_x[k] + (float)point[1] * rays->ray_y[k];
    }
}

static void make_perspective(const camera_frame *frame, const burnish_render_options *options,
                             burnish_view *view) {
    burnish_raster_view *raster = &view->raster;
    burnish_rays *rays = &view->shading.rays;
    double sine, cosine;
    burnish_sincos(options->camera.view_angle * (BURNISH_DEGREE / 2), &sine, &cosine);
    double pixels = options->height * 0.5 * cosine / sine; /* a unit at distance 1 */
    double columns = pixels / options->pixel_aspect;
    store_row(frame, frame->right, columns, 0, raster->rows[0]);
    store_row(frame, frame->up, pixels, 0, raster->rows[1]);
    memset(raster->rows[2], 0, sizeof raster->rows[2]);
    raster->rows[2][3] = (float)NEAR_PLANE;
    store_row(frame, frame->forward, 1, 0, raster->rows[3]);
    burnish_space_store(frame->forward, rays->ray);
    burnish_space_store(burnish_vec3_scale(frame->right, 1 / columns), rays->ray_x);
    burnish_space_store(burnish_vec3_scale(frame->up, 1 / pixels), rays->ray_y);
    memset(rays->ray_depth, 0, sizeof rays->ray_depth);
    rays->q_per_depth = (float)(1 / NEAR_PLANE);
    rays->q_constant = 0;
    if (options->principal_point[0] != 0 || options->principal_point[1] != 0) {
        move_axis(options->principal_point, raster, rays);
    }
    view->distance = (burnish_view_distance){(float)(1 / frame->scale), 0};
    view->pixel = burnish_vec3_length(frame->eye) / pixels;
}

/* Depth falls from 1 at the camera to 0 beyond the scene. */
static void make_orthographic(const camera_frame *frame, double view_height, int height,
                              burnish_view *view) {
    burnish_raster_view *raster = &view->raster;
    burnish_rays *rays = &view->shading.rays;
    double pixels = height / (view_height * frame->scale);
    double range = burnish_vec3_length(frame->eye) + 2;
    store_row(frame, frame->right, pixels, 0, raster->rows[0]);
    store_row(frame, frame->up, pixels, 0, raster->rows[1]);
    store_row(frame, frame->forward, -1 / range, 1, raster->rows[2]);
    memset(raster->rows[3], 0, sizeof raster->rows[3]);
    raster->rows[3][3] = 1;
    memset(rays->ray, 0, sizeof rays->ray);
    burnish_space_store(burnish_vec3_scale(frame->right, 1 / pixels), rays->ray_x);
    burnish_space_store(burnish_vec3_scale(frame->up, 1 / pixels), rays->ray_y);
    burnish_space_store(burnish_vec3_scale(frame->forward, range), rays->ray_depth);
    rays->q_per_depth = 0;
    rays->q_constant = 1;
    view->distance = (burnish_view_distance){0, (float)(range / frame->scale)};
    view->pixel = 1 / pixels;
}

/* Refuses what single precision can't hold: meshes of next to no size (1e-33 and less), pictures
 * of next to nothing. */
static burnish_status check_rows(const camera_frame *frame, const burnish_raster_view *raster,
                                 burnish_error *error) {
    double half_diagonal = 1 / frame->scale;
    double reach = half_diagonal > 1 ? half_diagonal : 1;
    for (int i = 0; i < 16; ++i) {
        double entry = raster->rows[i / 4][i % 4] * (i % 4 < 3 ? reach : 1);
        if (!(entry >= -LARGEST_ENTRY && entry <= LARGEST_ENTRY)) {
            return burnish_fail(error, BURNISH_STATUS_LIMIT,
                                "camera: a mesh %g across is too small, or too much enlarged, for "
                                "single precision; scale it up or show more of it",
                                2 * half_diagonal);
        }
    }
    return BURNISH_STATUS_OK;
}

/* A vector in camera space (x right, y up, z toward the viewer) in the raster's axes. */
static burnish_vec3 from_camera_space(const camera_frame *frame, burnish_vec3 v) {
    burnish_vec3 sum =
        burnish_vec3_add(burnish_vec3_scale(frame->right, v.x), burnish_vec3_scale(frame->up, v.y));
    return burnish_vec3_sub(sum, burnish_vec3_scale(frame->forward, v.z));
}

/* Beyond this many scene sizes a point light's rays are parallel to the last bit of a float. */
#define POINT_REACH 0x1p40

/* A point light's cone, and how it falls off, in the raster's scale. */
static void make_beam(const camera_frame *frame, double unit, const burnish_light *light,
                      burnish_light *made) {
    burnish_vec3 axis = burnish_vec3_load(light->axis);
    float rounded[3];
    axis = light->follows_camera ? from_camera_space(frame, axis) : axis;
    burnish_space_store(burnish_vec3_normalize(axis), rounded);
    for (int k = 0; k < 3; ++k) {
        made->axis[k] = (double)rounded[k];
    }
    memcpy(made->cone, light->cone, sizeof made->cone);
    made->distance = light->distance * unit;
    made->range = light->range * unit;
}

/* The length of a light's unit: positions in camera space count in distances of the camera. */
static double light_unit(const camera_frame *frame, const burnish_camera *camera,
                         const burnish_light *light) {
    const burnish_vec3 reach = burnish_vec3_sub(burnish_vec3_load(camera->focal_point),
                                                burnish_vec3_load(camera->position));
    return frame->scale * (light->follows_camera ? burnish_vec3_length(reach) : 1);
}

/* Where a light stands from the eye, or in which direction. */
static burnish_vec3 light_vector(const camera_frame *frame, const burnish_mesh_view *mesh,
                                 const burnish_camera *camera, const burnish_light *light) {
    const int is_point = light->kind == BURNISH_LIGHT_POINT;
    burnish_vec3 v = burnish_vec3_load(light->vector);
    if (light->follows_camera) {
        double unit = is_point ? light_unit(frame, camera, light) : 1;
        return burnish_vec3_scale(from_camera_space(frame, v), unit);
    }
    if (is_point) {
        v = burnish_vec3_scale(burnish_vec3_sub(v, burnish_space_center(mesh)), frame->scale);
        return burnish_vec3_sub(v, frame->eye);
    }
    return v;
}

static double largest_component(burnish_vec3 v) {
    double x = v.x < 0 ? -v.x : v.x, y = v.y < 0 ? -v.y : v.y, z = v.z < 0 ? -v.z : v.z;
    double largest = x > y ? x : y;
    return largest > z ? largest : z;
}

static burnish_light make_light(const camera_frame *frame, const burnish_mesh_view *mesh,
                                const burnish_camera *camera, const burnish_light *light) {
    burnish_light made;
    float vector[3];
    burnish_vec3 v = light_vector(frame, mesh, camera, light);
    double largest = largest_component(v);
    memset(&made, 0, sizeof made);
    memcpy(made.color, light->color, sizeof made.color);
    made.kind = light->kind == BURNISH_LIGHT_POINT && largest < POINT_REACH
                    ? BURNISH_LIGHT_POINT
                    : BURNISH_LIGHT_DIRECTIONAL;
    if (made.kind == BURNISH_LIGHT_DIRECTIONAL) {
        v = burnish_vec3_normalize(burnish_vec3_scale(v, 1 / largest));
    }
    if (made.kind == BURNISH_LIGHT_POINT) {
        make_beam(frame, light_unit(frame, camera, light), light, &made);
    }
    burnish_space_store(v, vector);
    for (int k = 0; k < 3; ++k) {
        made.vector[k] = (double)vector[k];
    }
    return made;
}

/* Lights from the eye, and viewer; no material. */
static void make_lighting(const camera_frame *frame, const burnish_mesh_view *mesh,
                          const burnish_render_options *options,
                          burnish_kernels_lighting *lighting) {
    const burnish_camera *camera = &options->camera;
    *lighting = burnish_kernels_lighting_default();
    lighting->specular_model = options->specular_model;
    memcpy(lighting->ambient_light, options->ambient_light, sizeof lighting->ambient_light);
    lighting->local_viewer = options->local_viewer && !(camera->orthographic_height > 0);
    memset(lighting->viewer, 0, sizeof lighting->viewer); /* positions count from the eye */
    if (!lighting->local_viewer) {
        burnish_space_store(burnish_vec3_scale(frame->forward, -1), lighting->viewer);
    }
    lighting->light_count = options->light_count;
    for (int i = 0; i < options->light_count; ++i) {
        lighting->lights[i] = make_light(frame, mesh, camera, &options->lights[i]);
    }
}

/* ---- Materials ---- */

/* A lobe of the family for an exponent, solved, its value at the peak in *scale: the order asked
 * for or the highest below it that the exponent allows, and when none suits the fit, energy at
 * order 2, which exists for every exponent. */
static burnish_lobe_spec solved_lobe(const burnish_lobe_spec *lobe, double exponent, double *scale,
                                     size_t *fallbacks) {
    burnish_lobe_spec solved = *lobe;
    solved.fit = BURNISH_FIT_GIVEN;
    for (burnish_lobe_spec lower = *lobe; lower.order >= 2; lower.order /= 2) {
        if (burnish_lobe_solve(&lower, exponent, &solved.parameter, scale) == BURNISH_LOBE_OK) {
            *fallbacks += lower.order != lobe->order;
            solved.order = lower.order;
            return solved;
        }
    }
    *fallbacks += 1;
    solved.fit = BURNISH_FIT_ENERGY;
    solved.order = 2;
    *scale = 1;
    return solved;
}

/* The lobe for an exponent, the factor for the specular colour, and whether its order is lower than
 * requested. */
typedef struct drawn_lobe {
    float exponent; /* 0: none yet */
    burnish_lobe_spec lobe;
    float scale;
    size_t fallbacks;
} drawn_lobe;

static drawn_lobe lobe_for(const burnish_lobe_spec *lobe, float exponent) {
    drawn_lobe drawn = {exponent, *lobe, 1.0f, 0};
    double scale = 1;
    if (lobe->kind == BURNISH_LOBE_LYON) {
        drawn.lobe.order = burnish_lobe_highest_order(lobe->order, exponent);
        drawn.fallbacks = drawn.lobe.order != lobe->order;
    } else if (lobe->kind == BURNISH_LOBE_FAMILY) {
        drawn.lobe = solved_lobe(lobe, (double)exponent, &scale, &drawn.fallbacks);
    }
    drawn.scale = (float)scale;
    return drawn;
}

/* Lobes that were solved in this frame, by exponent: a search takes up to 100 microseconds, and
 * materials mostly share a few exponents. */
enum { KNOWN_LOBES = 64 };

static const drawn_lobe *known_lobe(drawn_lobe known[KNOWN_LOBES], const burnish_lobe_spec *lobe,
                                    float exponent) {
    uint32_t bits;
    memcpy(&bits, &exponent, sizeof bits);
    drawn_lobe *entry = &known[(bits * 0x9e3779b1u) >> 26];
    if (entry->exponent != exponent) {
        *entry = lobe_for(lobe, exponent);
    }
    return entry;
}

/* Vertex colours replace burnish's grey, and multiply a colour of the file. */
static burnish_material drawn_material(const burnish_material *material, int has_colors,
                                       float specular_scale) {
    burnish_material drawn = *material;
    for (int k = 0; k < 3; ++k) {
        if (has_colors && !material->has_diffuse) {
            drawn.diffuse[k] = drawn.ambient[k] = 1.0f;
        }
        drawn.specular[k] *= specular_scale;
    }
    return drawn;
}

/* A material that is drawn in its colour: ambient light of 1, and no other. */
static burnish_status fold_unlit(const burnish_kernels_lighting *lighting,
                                 const burnish_material *material, const burnish_lobe_spec *lobe,
                                 burnish_kernels_shader *shader, burnish_error *error) {
    burnish_kernels_lighting unlit = *lighting;
    burnish_material drawn = *material;
    unlit.light_count = 0;
    for (int k = 0; k < 3; ++k) {
        unlit.ambient_light[k] = 1;
        drawn.ambient[k] = material->diffuse[k];
    }
    return burnish_shader_fold(&unlit, &drawn, lobe, NULL, shader, error);
}

/* White that reflects all light: what arrives. */
static const burnish_material WHITE = {.ambient = {1, 1, 1}, .diffuse = {1, 1, 1}, .exponent = 1};

/* What a material reflects of light that arrives by other surfaces; unlit ones nothing. */
static void store_albedo(const burnish_material *material, int is_base_ambient, float albedo[3]) {
    for (int k = 0; k < 3; ++k) {
        const float own = is_base_ambient ? material->ambient[k] : material->diffuse[k];
        albedo[k] = material->is_unlit ? 0 : own;
    }
}

/* Folds each material with the lights, and white after them. */
static burnish_status fold_materials(const burnish_drawn_mesh *mesh,
                                     const burnish_render_options *options,
                                     const burnish_kernels_lighting *lighting,
                                     burnish_shaders *shaders, burnish_view *view,
                                     burnish_memory *memory) {
    const size_t count = mesh->material_count + mesh->coat_count + 1;
    const size_t lights = (size_t)lighting->light_count;
    const int has_colors = mesh->view->colors && !mesh->ignore_colors;
    const drawn_lobe exact = {.lobe = {.kind = BURNISH_LOBE_EXACT}, .scale = 1};
    drawn_lobe known[KNOWN_LOBES] = {{0}};
    burnish_status status = burnish_lighting_check(lighting, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    shaders->items = burnish_reserve_discard(memory, shaders->items, &shaders->item_capacity, count,
                                             sizeof *shaders->items, "shaders");
    shaders->lights = burnish_reserve_discard(memory, shaders->lights, &shaders->light_capacity,
                                              count * lights, sizeof *shaders->lights, "lights");
    status = memory->status;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const int is_white = i + 1 == count;
        const burnish_material *material = is_white ? &WHITE : burnish_drawn_material(mesh, i);
        const drawn_lobe *lobe = is_white || (options->lobe.by_material && material->has_exponent)
                                     ? &exact
                                     : known_lobe(known, &options->lobe, material->exponent);
        const burnish_material drawn = drawn_material(material, has_colors, lobe->scale);
        view->lobe_fallbacks += lobe->fallbacks;
        status = material->is_unlit
                     ? fold_unlit(lighting, &drawn, &lobe->lobe, &shaders->items[i], memory->error)
                     : burnish_shader_fold(lighting, &drawn, &lobe->lobe,
                                           lights ? shaders->lights + i * lights : NULL,
                                           &shaders->items[i], memory->error);
        store_albedo(&drawn, burnish_has_roughness(material) && !material->is_metallic,
                     shaders->items[i].albedo);
    }
    return status;
}

/* ---- All ---- */

/* What lights of many directions need; `up` is the caller's to set. */
static void make_area_view(const camera_frame *frame, const burnish_mesh_view *mesh,
                           const burnish_camera *camera, const burnish_kernels_lighting *lighting,
                           burnish_area_view *area) {
    const burnish_vec3 reach = burnish_vec3_sub(burnish_vec3_load(camera->focal_point),
                                                burnish_vec3_load(camera->position));
    burnish_vec3_store(frame->right, area->axes[0]);
    burnish_vec3_store(frame->up, area->axes[1]);
    burnish_vec3_store(burnish_vec3_scale(frame->forward, -1), area->axes[2]);
    burnish_vec3_store(frame->eye, area->eye);
    burnish_vec3_store(burnish_space_center(mesh), area->origin);
    area->scale = frame->scale;
    area->reach = burnish_vec3_length(reach) * frame->scale;
    area->local_viewer = lighting->local_viewer;
    memcpy(area->viewer, lighting->viewer, sizeof area->viewer);
}

/* The body by which all materials can be shaded at once; NONE if there is none. Its specular colour
 * is 0 where a material's own body is NONE. */
static burnish_lobe_body mixed_body(const burnish_kernels_shader *shaders, size_t count) {
    int squarings = shaders->lobe.squarings, is_composite = 0;
    for (size_t i = 0; i < count && !is_composite; ++i) {
        is_composite = shaders[i].lobe.body == BURNISH_LOBE_BODY_COMPOSITE;
        squarings = is_composite ? shaders[i].lobe.squarings : squarings;
    }
    for (size_t i = 0; i < count; ++i) {
        const burnish_lobe_constants *lobe = &shaders[i].lobe;
        const int is_family =
            lobe->body == BURNISH_LOBE_BODY_SQUARE || lobe->body == BURNISH_LOBE_BODY_SQUARES;
        const int is_none = lobe->body == BURNISH_LOBE_BODY_NONE;
        const int suits =
            is_composite ? lobe->body == BURNISH_LOBE_BODY_COMPOSITE : is_family || is_none;
        const int is_free = is_composite && is_none && lobe->squarings <= squarings;
        if (!((suits && lobe->squarings == squarings) || is_free) ||
            shaders[i].geometry != BURNISH_SHADE_DISTANT ||
            shaders[i].light_count != shaders->light_count) {
            return BURNISH_LOBE_BODY_NONE;
        }
    }
    return is_composite    ? BURNISH_LOBE_BODY_COMPOSITE
           : squarings > 1 ? BURNISH_LOBE_BODY_SQUARES
                           : BURNISH_LOBE_BODY_SQUARE;
}

/* Whether all materials have the lobe and the specular colours of the first one; they have equally
 * many lights. */
static int are_alike(const burnish_kernels_shader *shaders, size_t count) {
    int different = 0;
    for (size_t i = 1; i < count; ++i) {
        different |= shaders[i].offset != shaders->offset;
        for (int l = 0; l < shaders->light_count; ++l) {
            const burnish_light_constants *own = &shaders[i].lights[l],
                                          *first = &shaders->lights[l];
            different |= memcmp(own->half, first->half, sizeof own->half) != 0 ||
                         memcmp(own->specular, first->specular, sizeof own->specular) != 0;
        }
    }
    return !different;
}

static void make_shading(const burnish_kernels_lighting *lighting,
                         const burnish_render_options *options, const burnish_shaders *shaders,
                         const burnish_drawn_mesh *mesh, burnish_shading *shading) {
    const size_t count = mesh->material_count;
    shading->shaders = shaders->items;
    shading->white = &shaders->items[count + mesh->coat_count];
    shading->mixed_body =
        shading->layers ? BURNISH_LOBE_BODY_NONE : mixed_body(shaders->items, count);
    shading->is_alike =
        shading->mixed_body != BURNISH_LOBE_BODY_NONE && are_alike(shaders->items, count);
    shading->needs_position = lighting->local_viewer || options->occlusion != 0 || options->shadow;
    for (int i = 0; i < lighting->light_count; ++i) {
        shading->needs_position |= lighting->lights[i].kind == BURNISH_LIGHT_POINT;
    }
    shading->is_lyon = options->lobe.kind == BURNISH_LOBE_LYON &&
                       options->specular_model == BURNISH_SPECULAR_BLINN;
}

static burnish_status make_raster(const burnish_mesh_view *mesh,
                                  const burnish_render_options *options, const camera_frame *frame,
                                  burnish_view *view, burnish_error *error) {
    const burnish_camera *camera = &options->camera;
    burnish_raster_view *raster = &view->raster;
    raster->width = options->width;
    raster->height = options->height;
    raster->samples = options->samples;
    /* caps replace what is seen from inside */
    raster->cull_back_faces = options->cull_back_faces && mesh->inside == BURNISH_INSIDE_UNKNOWN;
    burnish_space_store(burnish_space_center(mesh), raster->origin);
    if (camera->orthographic_height > 0) {
        make_orthographic(frame, camera->orthographic_height, options->height, view);
    } else {
        make_perspective(frame, options, view);
    }
    return check_rows(frame, raster, error);
}

burnish_status burnish_view_create(const burnish_drawn_mesh *mesh,
                                   const burnish_render_options *options, burnish_shaders *shaders,
                                   burnish_texturing *texturing, burnish_view *view,
                                   burnish_memory *memory) {
    const burnish_mesh_view *shape = mesh->view;
    burnish_kernels_lighting lighting;
    camera_frame frame;
    view->lobe_fallbacks = 0;
    burnish_status status = make_frame(shape, &options->camera, &frame, memory->error);
    if (status == BURNISH_STATUS_OK) {
        status = make_raster(shape, options, &frame, view, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_vec3_store(frame.eye, view->eye);
        make_lighting(&frame, shape, options, &lighting);
        make_area_view(&frame, shape, &options->camera, &lighting, &view->area);
        view->key = (burnish_vec3){0, 0, 0};
        if (lighting.light_count > 0 && lighting.lights[0].kind == BURNISH_LIGHT_DIRECTIONAL) {
            view->key = burnish_vec3_load(lighting.lights[0].vector);
        }
        status = fold_materials(mesh, options, &lighting, shaders, view, memory);
    }
    if (status == BURNISH_STATUS_OK && texturing) {
        burnish_vec3_store(burnish_space_center(shape), texturing->origin);
        burnish_vec3_store(frame.eye, texturing->eye);
        texturing->scale = frame.scale;
        status = burnish_texturing_view(texturing, &lighting, &options->lobe, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        make_shading(&lighting, options, shaders, mesh, &view->shading);
        view->shading.texturing = texturing;
    }
    return status;
}
