/* For tests: meshes from files, from memory and from packed arrays. */
#ifndef BURNISH_TEST_MESH_ARRAYS_H
#define BURNISH_TEST_MESH_ARRAYS_H

#include <string.h>

#include "burnish/mesh.h"
#include "support.h"

/* normals and colors may be NULL. */
static inline burnish_mesh_description describe_arrays(const float *positions, const float *normals,
                                                       const uint8_t *colors, size_t vertex_count,
                                                       const uint32_t *indices,
                                                       size_t triangle_count) {
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){positions, vertex_count, 0};
    arrays.normals = (burnish_array){normals, normals ? vertex_count : 0, 0};
    arrays.colors = (burnish_array){colors, colors ? vertex_count : 0, 0};
    arrays.indices = (burnish_array){indices, 3 * triangle_count, 0};
    return arrays;
}

/* Quads whose corners follow one another: up to 300. colors may be NULL. */
static inline burnish_mesh_description describe_quads(const float *positions, const uint8_t *colors,
                                                      size_t count) {
    static uint32_t indices[6 * 300];
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t v = 4 * i;
        memcpy(indices + 6 * i, (uint32_t[]){v, v + 1, v + 2, v, v + 2, v + 3}, 24);
    }
    return describe_arrays(positions, NULL, colors, 4 * count, indices, 2 * count);
}

static inline void give_materials(burnish_mesh_description *arrays,
                                  const burnish_material *materials, size_t count) {
    arrays->materials = materials;
    arrays->material_count = count;
}

/* coordinates: of all vertices */
static inline void give_textures(burnish_mesh_description *arrays, const float *coordinates,
                                 const burnish_texture *textures, size_t count) {
    arrays->texture_coordinates = (burnish_array){coordinates, arrays->positions.count, 0};
    arrays->textures = textures;
    arrays->texture_count = count;
}

static inline void destroy_owned(burnish_mesh **mesh) {
    burnish_mesh_destroy(*mesh);
}

/* A mesh that its variable destroys: OWNED_MESH *mesh = load_mesh(...); */
#define OWNED_MESH __attribute__((cleanup(destroy_owned))) burnish_mesh

/* Meshes that must be made; NULL after a failed check. options: NULL for the defaults. */
#define MADE_MESH(make)                                                                            \
    const burnish_load_options defaults = burnish_load_options_default();                          \
    burnish_mesh *mesh = NULL;                                                                     \
    burnish_error error = {0};                                                                     \
    options = options ? options : &defaults;                                                       \
    CHECK_OK(make, error);                                                                         \
    return mesh

static inline burnish_mesh *load_mesh(const char *name, const burnish_load_options *options) {
    MADE_MESH(burnish_mesh_load(name, options, &mesh, &error));
}

static inline burnish_mesh *load_tessellated(const char *name, int tessellation) {
    burnish_load_options options = burnish_load_options_default();
    options.tessellation = tessellation;
    return load_mesh(name, &options);
}

/* With facts. */
static inline burnish_mesh *load_measured(const char *name, int tessellation) {
    burnish_load_options options = burnish_load_options_default();
    options.tessellation = tessellation;
    options.measure = 1;
    return load_mesh(name, &options);
}

static inline burnish_mesh *load_bytes(const void *bytes, size_t size, const char *name,
                                       const burnish_load_options *options) {
    MADE_MESH(burnish_mesh_load_memory(bytes, size, name, options, &mesh, &error));
}

/* Bytes that must not become a mesh, with the message. options: NULL for the defaults */
static inline void check_refused(const void *bytes, size_t size, const char *name,
                                 const burnish_load_options *options, burnish_status expected,
                                 const char *message) {
    const burnish_load_options defaults = burnish_load_options_default();
    burnish_error error = {0};
    burnish_mesh *mesh = (burnish_mesh *)&error; /* must become NULL */
    const burnish_status status =
        burnish_mesh_load_memory(bytes, size, name, options ? options : &defaults, &mesh, &error);
    CHECK(status == expected && !mesh, "%s: status %d", name, (int)status);
    CHECK_TEXT(error.text, message);
}

static inline burnish_mesh *create_mesh(const burnish_mesh_description *arrays,
                                        const burnish_load_options *options) {
    MADE_MESH(burnish_mesh_create(arrays, options, &mesh, &error));
}

static inline burnish_mesh *create_quads(const float *positions, const uint8_t *colors,
                                         size_t count) {
    const burnish_mesh_description arrays = describe_quads(positions, colors, count);
    return create_mesh(&arrays, NULL);
}

/* Drops what lies beyond the plane. */
static inline void cut_mesh(burnish_mesh *mesh, double x, double y, double z, double offset) {
    const burnish_clip_plane plane = {{x, y, z}, offset};
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_clip(mesh, &plane, &error), error);
}

/* text: the only warning; NULL: there is none */
static inline void check_only_warning(const burnish_mesh *mesh, const char *text) {
    const size_t count = burnish_mesh_get_warning_count(mesh);
    CHECK(count == (text != NULL), "%zu warnings, first: %s", count,
          count > 0 ? burnish_mesh_get_warning(mesh, 0) : "");
    if (text && count > 0) {
        CHECK_TEXT(burnish_mesh_get_warning(mesh, 0), text);
    }
}

static inline int same_arrays(const void *a, const void *b, size_t size) {
    return !a == !b && (!a || memcmp(a, b, size) == 0);
}

/* Whether two meshes have the same arrays, bit for bit. */
static inline int same_meshes(const burnish_mesh *a, const burnish_mesh *b) {
    const burnish_mesh_view *x = burnish_mesh_get_view(a), *y = burnish_mesh_get_view(b);
    if (!x || !y) {
        return !x && !y;
    }
    const size_t count = x->vertex_count;
    return count == y->vertex_count && x->triangle_count == y->triangle_count &&
           same_arrays(x->positions, y->positions, 12 * count) &&
           same_arrays(x->normals, y->normals, 12 * count) &&
           same_arrays(x->colors, y->colors, 4 * count) &&
           same_arrays(x->texture_coordinates, y->texture_coordinates, 8 * count) &&
           same_arrays(x->indices, y->indices, 12 * x->triangle_count) &&
           same_arrays(x->triangle_materials, y->triangle_materials, 2 * x->triangle_count) &&
           memcmp(x->bounds_min, y->bounds_min, sizeof x->bounds_min) == 0 &&
           memcmp(x->bounds_max, y->bounds_max, sizeof x->bounds_max) == 0;
}

#endif
