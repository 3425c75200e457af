/* Meshes: options, release, access, materials. */
#include "mesh/data/mesh.h"

#include <float.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "base/layout.h"
#include "mesh/data/box.h"
#include "mesh/data/material.h"

/* burnish's grey, a satin plastic: tune it here and nowhere else. Colours are linear light. */
static const burnish_material default_material = {
    .ambient = {0.34f, 0.34f, 0.34f},
    .diffuse = {0.34f, 0.34f, 0.34f},
    .specular = {0.5f, 0.5f, 0.5f},
    .exponent = 64,
};

/* ---- options ---- */

#define COOKIE BURNISH_COOKIE(0x6c6f6436, burnish_load_options)

void burnish_load_options_init(burnish_load_options *options, uint64_t layout) {
    const burnish_load_options defaults = {.cookie = COOKIE,
                                           .format = BURNISH_FORMAT_AUTO,
                                           .crease_angle = BURNISH_CREASE_AUTO,
                                           .tessellation = 16,
                                           .animation_time = BURNISH_AT_REST,
                                           .max_input_bytes = (uint64_t)16 << 30,
                                           .max_triangles = BURNISH_TRIANGLES_MAX,
                                           .max_texture_pixels = BURNISH_TEXTURE_PIXELS_AUTO};
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_load_options), &defaults);
}

static burnish_status check_limits(const burnish_load_options *options, burnish_error *error) {
    if (options->max_triangles > BURNISH_TRIANGLES_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: max_triangles %llu is more than %u",
                            (unsigned long long)options->max_triangles, BURNISH_TRIANGLES_MAX);
    }
    if (options->threads < 0 || options->threads > BURNISH_THREADS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "options: threads %d is not in [0, %d]",
                            options->threads, BURNISH_THREADS_MAX);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_options(const burnish_load_options *options, burnish_error *error) {
#define NAME(name, ...) ", BURNISH_FORMAT_" #name
    static const char names[] = "BURNISH_FORMAT_AUTO" BURNISH_FORMAT_LIST(NAME);
#undef NAME
    const burnish_status status =
        burnish_layout_check(options, COOKIE, "options", "load_options", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_format_info *format = burnish_format_get_info(options->format);
    if (!format || (!format->is_file && options->format != BURNISH_FORMAT_AUTO)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: format %d is not a file format; use one of %s",
                            (int)options->format, names);
    }
    if (options->crease_angle != BURNISH_CREASE_AUTO &&
        !(options->crease_angle >= 0 && options->crease_angle <= 180)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "options: crease_angle %g is not in [0, 180] degrees or BURNISH_CREASE_AUTO",
            options->crease_angle);
    }
    if (options->normals < BURNISH_NORMALS_AUTO || options->normals > BURNISH_NORMALS_OWN) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: normals %d is not one of BURNISH_NORMALS_AUTO, _FILE, _OWN",
                            (int)options->normals);
    }
    if (!(options->point_size >= 0 && options->point_size <= 1e30)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: point_size %g is not in [0, 1e30]", options->point_size);
    }
    if (!(options->explode >= 0 && options->explode <= 1000)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: explode %g is not in [0, 1000]", options->explode);
    }
    if (options->tessellation < 1 || options->tessellation > 256) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: tessellation %d is not in [1, 256]", options->tessellation);
    }
    if (options->animation_time != BURNISH_AT_REST &&
        !(options->animation_time >= 0 && options->animation_time <= 1e9)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "options: animation_time %g is not in [0, 1e9] seconds or BURNISH_AT_REST",
            options->animation_time);
    }
    for (int k = 0; k < 3 && options->origin; ++k) {
        if (!(options->origin[k] >= -1e30 && options->origin[k] <= 1e30)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "options: origin %g is not in [-1e30, 1e30]", options->origin[k]);
        }
    }
    return check_limits(options, error);
}

burnish_status burnish_check_load(const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error) {
    if (!mesh) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "mesh: NULL; pass the address of a mesh pointer");
    }
    *mesh = NULL;
    if (!options) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: NULL; pass burnish_load_options_default()");
    }
    return check_options(options, error);
}

burnish_status burnish_check_triangle_count(const burnish_load_options *options, const char *where,
                                            uint64_t count, burnish_error *error) {
    if (count <= options->max_triangles) {
        return BURNISH_STATUS_OK;
    }
    return burnish_fail(error, BURNISH_STATUS_LIMIT, "%s: more than %llu triangles; %s", where,
                        (unsigned long long)options->max_triangles,
                        options->max_triangles < BURNISH_TRIANGLES_MAX
                            ? "raise the limit or simplify the mesh"
                            : "split or simplify the mesh");
}

/* ---- view ---- */

/* Whether an alpha is below 255. */
static int has_alpha(const uint8_t *colors, size_t count) {
    unsigned all = 255;
    for (size_t i = 0; colors && i < count; ++i) {
        all &= colors[4 * i + 3];
    }
    return all < 255;
}

void burnish_bound_positions(const float *positions, size_t count, float low[3], float high[3]) {
    enum { LANES = 48 }; /* a multiple of 3, above what compilers unroll instead of vectorising */
    const size_t first = 3 * count % LANES;
    float least[LANES], most[LANES];
    for (size_t k = 0; k < LANES; ++k) { /* the first ones, or again the first */
        least[k] = most[k] = positions[k < 3 * count ? k : k % 3];
    }
    for (size_t i = first; i < 3 * count; i += LANES) {
        for (size_t k = 0; k < LANES; ++k) {
            const float value = positions[i + k];
            least[k] = value < least[k] ? value : least[k];
            most[k] = value > most[k] ? value : most[k];
        }
    }
    memcpy(low, least, 3 * sizeof *low);
    memcpy(high, most, 3 * sizeof *high);
    for (size_t k = 3; k < LANES; ++k) {
        low[k % 3] = least[k] < low[k % 3] ? least[k] : low[k % 3];
        high[k % 3] = most[k] > high[k % 3] ? most[k] : high[k % 3];
    }
}

/* The bounds of a view of which not all is framed: of a point cloud, of the spheres that are. */
static void bound_framed(burnish_mesh *mesh) {
    burnish_mesh_view *view = &mesh->view;
    memcpy(mesh->points_min, view->bounds_min, sizeof mesh->points_min);
    memcpy(mesh->points_max, view->bounds_max, sizeof mesh->points_max);
    burnish_box inner, box;
    memcpy(inner.low, mesh->inner_min, sizeof inner.low);
    memcpy(inner.high, mesh->inner_max, sizeof inner.high);
    memcpy(box.low, view->bounds_min, sizeof box.low);
    memcpy(box.high, view->bounds_max, sizeof box.high);
    burnish_box_inside(view->positions, view->vertex_count, 1, &inner, &box);
    for (int k = 0; k < 3; ++k) { /* stays finite at the end of the range */
        const float low = box.low[k] - view->point_radius;
        const float high = box.high[k] + view->point_radius;
        view->bounds_min[k] = low < -FLT_MAX ? -FLT_MAX : low;
        view->bounds_max[k] = high > FLT_MAX ? FLT_MAX : high;
    }
}

void burnish_mesh_update_view(burnish_mesh *mesh) {
    static atomic_uint_fast64_t last_serial;
    burnish_mesh_view *view = &mesh->view;
    const float *positions = mesh->attributes[BURNISH_POSITION];
    view->positions = positions;
    view->normals = mesh->attributes[BURNISH_NORMAL];
    view->colors = mesh->attributes[BURNISH_COLOR];
    view->texture_coordinates = mesh->attributes[BURNISH_TEXCOORD];
    view->tangents = mesh->attributes[BURNISH_TANGENT];
    view->second_coordinates = mesh->attributes[BURNISH_TEXCOORD2];
    view->splats = mesh->attributes[BURNISH_SPLAT];
    view->indices = mesh->indices;
    view->triangle_materials = mesh->triangle_materials;
    view->triangle_parts = mesh->triangle_parts;
    view->has_transparent_colors = has_alpha(view->colors, view->vertex_count);
    view->serial = atomic_fetch_add_explicit(&last_serial, 1, memory_order_relaxed) + 1;
    if (view->vertex_count > 0) {
        burnish_bound_positions(positions, view->vertex_count, view->bounds_min, view->bounds_max);
    }
    if (view->point_radius > 0 || mesh->has_strays) {
        bound_framed(mesh);
    }
    memcpy(mesh->faces_min, view->bounds_min, sizeof mesh->faces_min);
    memcpy(mesh->faces_max, view->bounds_max, sizeof mesh->faces_max);
    for (int k = 0; k < 3 && mesh->splats; ++k) {
        const burnish_mesh_view *splats = &mesh->splats->view;
        float *low = &view->bounds_min[k], *high = &view->bounds_max[k];
        *low = splats->bounds_min[k] < *low ? splats->bounds_min[k] : *low;
        *high = splats->bounds_max[k] > *high ? splats->bounds_max[k] : *high;
    }
}

/* ---- access ---- */

void burnish_mesh_destroy(burnish_mesh *mesh) {
    if (!mesh) {
        return;
    }
    const burnish_context *context = mesh->context;
    burnish_texts_release(context, mesh->warnings, mesh->warning_count);
    burnish_texts_release(context, mesh->variants, mesh->variant_count);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_release(context, mesh->attributes[i]);
    }
    burnish_cameras_release(context, mesh->cameras, mesh->camera_count);
    burnish_release(context, mesh->lights);
    burnish_textures_release(context, mesh->textures, mesh->texture_count);
    burnish_release(context, mesh->materials);
    burnish_release(context, mesh->indices);
    burnish_release(context, mesh->triangle_materials);
    burnish_release(context, mesh->triangle_parts);
    burnish_mesh_destroy(mesh->negatives);
    burnish_mesh_destroy(mesh->splats);
    burnish_release(context, (void *)(uintptr_t)mesh->contents.parts);
    burnish_release(context, (void *)(uintptr_t)mesh->contents.plates);
    burnish_release(context, (void *)(uintptr_t)mesh->contents.filaments);
    burnish_release(context, mesh);
}

void burnish_mesh_keep_splats(burnish_mesh *mesh) {
    burnish_mesh *splats = mesh->splats, rest = *mesh;
    rest.info.point_count = splats->info.point_count;
    splats->info = rest.info;
    splats->warnings = rest.warnings;
    splats->warning_count = rest.warning_count;
    splats->cameras = rest.cameras;
    splats->camera_count = rest.camera_count;
    memcpy(splats->view.cuts, rest.view.cuts, sizeof rest.view.cuts);
    splats->view.cut_count = rest.view.cut_count;
    *mesh = *splats;
    rest.splats = NULL;
    rest.warning_count = rest.camera_count = 0;
    rest.warnings = NULL;
    rest.cameras = NULL;
    *splats = rest;
    burnish_mesh_destroy(splats);
}

const burnish_mesh_view *burnish_mesh_get_view(const burnish_mesh *mesh) {
    return mesh ? &mesh->view : NULL;
}

const burnish_mesh_info *burnish_mesh_get_info(const burnish_mesh *mesh) {
    return mesh ? &mesh->info : NULL;
}

const burnish_mesh_facts *burnish_mesh_get_facts(const burnish_mesh *mesh) {
    const int has_faces = mesh && mesh->info.point_count == 0 && !mesh->info.is_thumbnail &&
                          (mesh->info.line_count == 0 || mesh->has_beside);
    return has_faces && mesh->has_facts ? &mesh->facts : NULL;
}

void burnish_mesh_get_bounds(const burnish_mesh *mesh, float low[3], float high[3]) {
    const int are_points = mesh && (mesh->view.point_radius > 0 || mesh->has_strays);
    for (int k = 0; k < 3; ++k) {
        low[k] = !mesh ? 0 : are_points ? mesh->points_min[k] : mesh->faces_min[k];
        high[k] = !mesh ? 0 : are_points ? mesh->points_max[k] : mesh->faces_max[k];
        if (mesh && (mesh->info.line_count > 0 ||
                     mesh->has_beside)) { /* inside the rods, unless a cut left less */
            low[k] = low[k] < mesh->points_min[k] ? mesh->points_min[k] : low[k];
            high[k] = high[k] > mesh->points_max[k] ? mesh->points_max[k] : high[k];
        }
        if (mesh && mesh->splats) {
            const burnish_mesh *splats = mesh->splats;
            low[k] = low[k] > splats->points_min[k] ? splats->points_min[k] : low[k];
            high[k] = high[k] < splats->points_max[k] ? splats->points_max[k] : high[k];
        }
    }
}

size_t burnish_mesh_get_warning_count(const burnish_mesh *mesh) {
    return mesh ? mesh->warning_count : 0;
}

const char *burnish_mesh_get_warning(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->warning_count ? mesh->warnings[index] : NULL;
}

size_t burnish_mesh_get_variant_count(const burnish_mesh *mesh) {
    return mesh ? mesh->variant_count : 0;
}

const char *burnish_mesh_get_variant(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->variant_count ? mesh->variants[index] : NULL;
}

const burnish_contents *burnish_mesh_get_contents(const burnish_mesh *mesh) {
    return mesh ? &mesh->contents : NULL;
}

const burnish_mesh *burnish_mesh_get_negatives(const burnish_mesh *mesh) {
    return mesh ? mesh->negatives : NULL;
}

const burnish_mesh *burnish_mesh_get_splats(const burnish_mesh *mesh) {
    return mesh && mesh->view.splats ? mesh : mesh ? mesh->splats : NULL;
}

const char *burnish_part_role_name(burnish_part_role role) {
    static const char *const names[BURNISH_PART_ROLE_COUNT] = {
        "solid",   "negative volume", "modifier", "support blocker", "support enforcer",
        "support", "not printed",     "hidden"};
    return role < BURNISH_PART_ROLE_COUNT ? names[role] : NULL;
}

void burnish_mesh_bound_parts(const burnish_mesh *mesh, burnish_box *boxes) {
    const burnish_mesh_view *view = &mesh->view;
    for (size_t i = 0; i < mesh->contents.part_count; ++i) {
        boxes[i] = burnish_box_none();
    }
    for (size_t i = 0; i < 3 * view->triangle_count && mesh->contents.part_count > 0; ++i) {
        burnish_box_extend(&boxes[view->triangle_parts ? view->triangle_parts[i / 3] : 0],
                           view->positions + 3 * (size_t)view->indices[i]);
    }
}

size_t burnish_mesh_get_camera_count(const burnish_mesh *mesh) {
    return mesh ? mesh->camera_count : 0;
}

const burnish_named_camera *burnish_mesh_get_camera(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->camera_count ? &mesh->cameras[index] : NULL;
}

size_t burnish_mesh_get_light_count(const burnish_mesh *mesh) {
    return mesh ? mesh->light_count : 0;
}

const burnish_light *burnish_mesh_get_light(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->light_count ? &mesh->lights[index] : NULL;
}

/* ---- materials ---- */

burnish_material burnish_material_default(void) {
    return default_material;
}

size_t burnish_mesh_get_material_count(const burnish_mesh *mesh) {
    return mesh ? mesh->material_count : 0;
}

const burnish_material *burnish_mesh_get_material(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->material_count ? &mesh->materials[index] : NULL;
}

/* Texture coordinates and tangents were built only if a material used them at that time. */
static burnish_status check_attributes(const burnish_mesh_view *view,
                                       const burnish_material *material, burnish_error *error) {
    if (burnish_material_has_textures(material) && !view->texture_coordinates) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "material: uses a texture, but the mesh has no texture coordinates; "
                            "make it with keep_texture_coordinates or with such a material");
    }
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        if (material->textures[slot].coordinates && !view->second_coordinates) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "material: a texture has coordinates 1, but the mesh has no "
                                "second_coordinates; make it with such a material");
        }
    }
    if (burnish_material_needs_tangents(material) && !view->tangents) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "material: uses a normal texture or anisotropy, but the mesh has no "
                            "tangents; make it with such a material");
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_mesh_set_material(burnish_mesh *mesh, size_t index,
                                         const burnish_material *material, burnish_error *error) {
    if (!mesh || !material) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass one",
                            mesh ? "material" : "mesh");
    }
    if (index >= mesh->material_count) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "index: %zu is out of range, the mesh has %zu material%s", index,
                            mesh->material_count, mesh->material_count == 1 ? "" : "s");
    }
    burnish_status status =
        burnish_check_material(material, mesh->texture_count, "material", error);
    if (status == BURNISH_STATUS_OK) {
        status = check_attributes(&mesh->view, material, error);
    }
    if (status == BURNISH_STATUS_OK) {
        mesh->materials[index] = *material;
    }
    return status;
}
