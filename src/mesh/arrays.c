/* A mesh from the caller's arrays. */
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/layout.h"
#include "base/numbers.h"
#include "core/float_mode.h"
#include "core/vec3.h"
#include "mesh/build/build.h"
#include "mesh/data/material.h"

enum { MATERIALS_MAX = 65536 }; /* numbered in 16 bits */

/* The state of a creation. */
typedef struct creation {
    const burnish_mesh_description *from;
    burnish_mesh_data data;
    size_t vertex_count, triangle_count;
    burnish_error *error;
} creation;

#define COOKIE BURNISH_COOKIE(0x6d736832, burnish_mesh_description)

void burnish_mesh_description_init(burnish_mesh_description *description, uint64_t layout) {
    const burnish_mesh_description defaults = {
        .cookie = COOKIE, .index_size = 4, .up_axis = {0, 1, 0}};
    burnish_layout_init(description, layout, BURNISH_LAYOUT(burnish_mesh_description), &defaults);
}

/* Whether the array has `count` items of `size` bytes; a missing array is valid. */
static burnish_status check_array(const burnish_array *array, const char *name, size_t size,
                                  size_t count, const char *per, burnish_error *error) {
    if (!array->items && array->count == 0) {
        return BURNISH_STATUS_OK;
    }
    if (!array->items) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: items is NULL, but count is %zu; pass an array", name,
                            array->count);
    }
    if (array->count != count) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: count is %zu; expected one per %s, that is %zu", name,
                            array->count, per, count);
    }
    if (array->stride != 0 && array->stride < size) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: stride is %zu; an item has %zu bytes", name, array->stride, size);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_counts(creation *c) {
    const burnish_mesh_description *from = c->from;
    c->vertex_count = from->positions.count;
    if (!from->positions.items) {
        return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT, "positions: NULL; pass an array");
    }
    if (c->vertex_count < 3 || c->vertex_count > BURNISH_VALUE_LIMIT) {
        return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT,
                            "positions: count is %zu, not in [3, 2^32 - 2]", c->vertex_count);
    }
    const burnish_array *threes = from->indices.items ? &from->indices : &from->positions;
    c->triangle_count = threes->count / 3;
    if (threes->count % 3 != 0 || threes->count == 0) {
        return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT,
                            "%s: count is %zu; triangles need a multiple of 3, at least 3",
                            from->indices.items ? "indices" : "positions", threes->count);
    }
    if (from->index_size != 1 && from->index_size != 2 && from->index_size != 4) {
        return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT, "index_size: %d is not 1, 2 or 4",
                            from->index_size);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_arrays(const creation *c) {
    const burnish_mesh_description *from = c->from;
    const struct {
        const burnish_array *array;
        const char *name;
        size_t size, count;
        const char *per;
    } arrays[] = {
        {&from->positions, "positions", 12, c->vertex_count, "vertex"},
        {&from->normals, "normals", 12, c->vertex_count, "vertex"},
        {&from->colors, "colors", 4, c->vertex_count, "vertex"},
        {&from->texture_coordinates, "texture_coordinates", 8, c->vertex_count, "vertex"},
        {&from->second_coordinates, "second_coordinates", 8, c->vertex_count, "vertex"},
        {&from->tangents, "tangents", 16, c->vertex_count, "vertex"},
        {&from->indices, "indices", (size_t)from->index_size, 3 * c->triangle_count, "corner"},
        {&from->triangle_materials, "triangle_materials", 2, c->triangle_count, "triangle"}};
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays && status == BURNISH_STATUS_OK; ++i) {
        status = check_array(arrays[i].array, arrays[i].name, arrays[i].size, arrays[i].count,
                             arrays[i].per, c->error);
    }
    return status;
}

static burnish_status check_materials(const burnish_mesh_description *from, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    if (from->material_count > MATERIALS_MAX || (from->material_count > 0 && !from->materials)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "materials: there are %zu at %s; expected at most %d, and an array",
                            from->material_count, from->materials ? "an array" : "NULL",
                            MATERIALS_MAX);
    }
    for (size_t i = 0; i < from->material_count && status == BURNISH_STATUS_OK; ++i) {
        char name[40];
        snprintf(name, sizeof name, "materials[%zu]", i);
        status = burnish_check_material(&from->materials[i], from->texture_count, name, error);
    }
    return status;
}

static burnish_status check_textures(const burnish_mesh_description *from, burnish_error *error) {
    if (from->texture_count > BURNISH_TEXTURES_MAX ||
        (from->texture_count > 0 && !from->textures)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "textures: there are %zu at %s; expected at most %d, and an array",
                            from->texture_count, from->textures ? "an array" : "NULL",
                            BURNISH_TEXTURES_MAX);
    }
    for (size_t i = 0; i < from->texture_count; ++i) {
        const burnish_texture *texture = &from->textures[i];
        if (texture->width < 1 || texture->width > BURNISH_TEXTURE_SIZE_MAX ||
            texture->height < 1 || texture->height > BURNISH_TEXTURE_SIZE_MAX || !texture->pixels) {
            return burnish_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "textures[%zu]: %d x %d texels at %s; expected sides in [1, %d], and pixels", i,
                texture->width, texture->height, texture->pixels ? "an array" : "NULL",
                BURNISH_TEXTURE_SIZE_MAX);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_description(creation *c) {
    const burnish_mesh_description *from = c->from;
    burnish_status status =
        burnish_layout_check(from, COOKIE, "description", "mesh_description", c->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const float *up = from->up_axis;
    for (int i = 0; i < 3; ++i) {
        if (!(up[i] >= -FLT_MAX && up[i] <= FLT_MAX) || (up[0] == 0 && up[1] == 0 && up[2] == 0)) {
            return burnish_fail(
                c->error, BURNISH_STATUS_ARGUMENT,
                "up_axis: needs three finite numbers, not all 0; use for example 0, 1, 0");
        }
    }
    status = check_counts(c);
    if (status == BURNISH_STATUS_OK) {
        status = check_arrays(c);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_textures(from, c->error);
    }
    return status == BURNISH_STATUS_OK ? check_materials(from, c->error) : status;
}

/* Item i of an array whose items have `size` bytes. */
static const uint8_t *array_item(const burnish_array *array, size_t size, size_t i) {
    return (const uint8_t *)array->items + i * (array->stride ? array->stride : size);
}

static void copy_items(const burnish_array *array, size_t size, void *to) {
    if (array->stride == 0 || array->stride == size) {
        memcpy(to, array->items, array->count * size);
        return;
    }
    for (size_t i = 0; i < array->count; ++i) {
        memcpy((uint8_t *)to + i * size, array_item(array, size, i), size);
    }
}

static void copy_stream(creation *c, burnish_attribute attribute, const burnish_array *array) {
    burnish_stream *stream = &c->data.streams[attribute];
    if (array->items &&
        burnish_mesh_data_reserve(&c->data, attribute, array->count) == BURNISH_STATUS_OK) {
        copy_items(array, burnish_attribute_size(attribute), stream->items);
        stream->count = array->count;
    }
}

/* Checks the copies, since the caller's arrays might change meanwhile. */
static burnish_status check_finite(const creation *c, burnish_attribute attribute, size_t width,
                                   const char *name) {
    const float *values = c->data.streams[attribute].items;
    for (size_t i = 0; i < width * c->data.streams[attribute].count; ++i) {
        if (!burnish_is_finitef(values[i])) {
            return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT,
                                "%s[%zu]: number %zu of %zu is not finite", name, i / width,
                                i % width + 1, width);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status copy_indices(creation *c) {
    const burnish_array *indices = &c->from->indices;
    const size_t count = 3 * c->triangle_count, size = (size_t)c->from->index_size;
    if (burnish_mesh_data_reserve_corners(&c->data, BURNISH_POSITION, c->triangle_count) !=
        BURNISH_STATUS_OK) {
        return c->data.memory.status;
    }
    uint32_t *corners = c->data.streams[BURNISH_POSITION].corners;
    for (size_t i = 0; i < count; ++i) {
        uint16_t half = 0;
        corners[i] = (uint32_t)i;
        if (indices->items && size == 4) {
            memcpy(&corners[i], array_item(indices, size, i), 4);
        } else if (indices->items && size == 2) {
            memcpy(&half, array_item(indices, size, i), 2);
            corners[i] = half;
        } else if (indices->items) {
            corners[i] = *array_item(indices, size, i);
        }
        if (corners[i] >= c->vertex_count) {
            return burnish_fail(c->error, BURNISH_STATUS_ARGUMENT,
                                "indices[%zu]: %u is out of range, there are %zu vertices", i,
                                (unsigned)corners[i], c->vertex_count);
        }
    }
    c->data.triangle_count = c->triangle_count;
    return BURNISH_STATUS_OK;
}

static burnish_status copy_materials(creation *c) {
    const burnish_mesh_description *from = c->from;
    burnish_mesh_data *data = &c->data;
    data->materials =
        burnish_allocate(&data->memory, from->material_count, sizeof *data->materials, "materials");
    data->triangle_materials =
        burnish_allocate(&data->memory, from->triangle_materials.items ? c->triangle_count : 0,
                         sizeof *data->triangle_materials, "materials");
    if (data->memory.status != BURNISH_STATUS_OK) {
        return data->memory.status;
    }
    if (data->materials) {
        memcpy(data->materials, from->materials, from->material_count * sizeof *data->materials);
        data->material_count = data->material_capacity = from->material_count;
    }
    if (data->triangle_materials) {
        copy_items(&from->triangle_materials, sizeof *data->triangle_materials,
                   data->triangle_materials);
        data->triangle_material_capacity = c->triangle_count;
        const size_t materials = from->material_count > 0 ? from->material_count : 1;
        for (size_t i = 0; i < c->triangle_count; ++i) {
            if (data->triangle_materials[i] >= materials) {
                return burnish_fail(
                    c->error, BURNISH_STATUS_ARGUMENT,
                    "triangle_materials[%zu]: %d is out of range, there %s %zu material%s", i,
                    data->triangle_materials[i], materials == 1 ? "is" : "are", materials,
                    materials == 1 ? "" : "s");
            }
        }
    }
    return BURNISH_STATUS_OK;
}

/* Copies the textures. Fails above the limit, since dropping some would renumber the others. */
static burnish_status copy_textures(creation *c, const burnish_load_options *options) {
    uint64_t texels = 0;
    for (size_t i = 0; i < c->from->texture_count; ++i) {
        const burnish_texture *from = &c->from->textures[i];
        const size_t count = (size_t)from->width * (size_t)from->height;
        texels += count;
        if (texels > options->max_texture_pixels) {
            return burnish_fail(
                c->error, BURNISH_STATUS_LIMIT,
                "textures: more than %llu texels; raise max_texture_pixels or make them smaller",
                (unsigned long long)options->max_texture_pixels);
        }
        uint8_t *pixels = burnish_allocate(&c->data.memory, count, 4, "textures");
        if (pixels) {
            memcpy(pixels, from->pixels, 4 * count);
            burnish_mesh_data_add_texture(&c->data, from->name, from->width, from->height, pixels,
                                          from->is_color);
        }
        if (c->data.memory.status != BURNISH_STATUS_OK) {
            return c->data.memory.status;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status copy_arrays(creation *c, const burnish_load_options *options) {
    const burnish_mesh_description *from = c->from;
    copy_stream(c, BURNISH_POSITION, &from->positions);
    copy_stream(c, BURNISH_NORMAL, &from->normals);
    copy_stream(c, BURNISH_COLOR, &from->colors);
    copy_stream(c, BURNISH_TEXCOORD, &from->texture_coordinates);
    copy_stream(c, BURNISH_TANGENT, &from->tangents);
    copy_stream(c, BURNISH_TEXCOORD2, &from->second_coordinates);
    burnish_status status = copy_indices(c);
    if (status == BURNISH_STATUS_OK) {
        status = copy_materials(c);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_finite(c, BURNISH_POSITION, 3, "positions");
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_finite(c, BURNISH_TEXCOORD, 2, "texture_coordinates");
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_finite(c, BURNISH_TANGENT, 4, "tangents");
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_finite(c, BURNISH_TEXCOORD2, 2, "second_coordinates");
    }
    if (status == BURNISH_STATUS_OK) {
        status = copy_textures(c, options);
    }
    return status;
}

static burnish_status create_mesh(creation *c, const burnish_load_options *options,
                                  burnish_mesh **mesh) {
    const char *name = c->from->name ? c->from->name : "mesh";
    burnish_status status =
        burnish_check_triangle_count(options, name, c->triangle_count, c->error);
    if (status == BURNISH_STATUS_OK) {
        status = copy_arrays(c, options);
    }
    const burnish_vec3 up = burnish_vec3_normalize(burnish_vec3_loadf(c->from->up_axis));
    c->data.up_axis[0] = (float)up.x;
    c->data.up_axis[1] = (float)up.y;
    c->data.up_axis[2] = (float)up.z;
    return status == BURNISH_STATUS_OK
               ? burnish_mesh_build(&c->data, name, options, BURNISH_FORMAT_ARRAYS, mesh)
               : status;
}

burnish_status burnish_mesh_create(const burnish_mesh_description *description,
                                   const burnish_load_options *options, burnish_mesh **mesh,
                                   burnish_error *error) {
    creation c = {.from = description, .error = error};
    burnish_status status = burnish_check_load(options, mesh, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_description(&c);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, options->context, options->threads);
    c.data = burnish_mesh_data_begin(options->context, &tasks, error);
    status = create_mesh(&c, options, mesh);
    burnish_mesh_data_destroy(&c.data);
    burnish_float_mode_leave(before);
    return status;
}
