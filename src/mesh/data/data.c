/* Mesh data: allocation, release, warnings. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/context.h"
#include "mesh/data/data.h"
#include "mesh/data/material.h"

enum { WARNING_LIMIT = 16, WARNING_SIZE = 480 };

void burnish_mesh_data_drop(burnish_mesh_data *mesh, burnish_attribute attribute) {
    burnish_stream *stream = &mesh->streams[attribute];
    burnish_release(mesh->memory.context, stream->items);
    burnish_release(mesh->memory.context, stream->corners);
    *stream = (burnish_stream){0};
}

void burnish_texts_release(const burnish_context *context, char **texts, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        burnish_release(context, texts[i]);
    }
    burnish_release(context, texts);
}

void burnish_cameras_release(const burnish_context *context, burnish_named_camera *cameras,
                             size_t count) {
    for (size_t i = 0; i < count; ++i) {
        burnish_release(context, (void *)(uintptr_t)cameras[i].name);
    }
    burnish_release(context, cameras);
}

void burnish_mesh_data_destroy(burnish_mesh_data *mesh) {
    const burnish_context *context = mesh->memory.context;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_mesh_data_drop(mesh, (burnish_attribute)i);
    }
    burnish_texts_release(context, mesh->warnings, mesh->warning_count);
    burnish_texts_release(context, mesh->variants, mesh->variant_count);
    burnish_textures_release(context, mesh->textures, mesh->texture_count);
    burnish_cameras_release(context, mesh->cameras, mesh->camera_count);
    burnish_release(context, mesh->lights);
    burnish_release(context, mesh->materials);
    burnish_release(context, mesh->triangle_materials);
    burnish_release(context, mesh->triangle_parts);
    struct burnish_mesh_data *const more[2] = {mesh->negatives, mesh->splats};
    for (int i = 0; i < 2; ++i) {
        if (more[i]) {
            burnish_mesh_data_destroy(more[i]);
            burnish_release(context, more[i]);
        }
    }
    burnish_release(context, mesh->parts);
    burnish_release(context, mesh->plates);
    burnish_release(context, mesh->filaments);
    *mesh = (burnish_mesh_data){.memory = mesh->memory, .tasks = mesh->tasks, .start = mesh->start};
}

burnish_mesh_data *burnish_mesh_data_add_splats(burnish_mesh_data *mesh) {
    burnish_memory *memory = &mesh->memory;
    mesh->splats = burnish_allocate_zeroed(memory, 1, sizeof *mesh->splats, "splats");
    if (mesh->splats) {
        *mesh->splats = burnish_mesh_data_begin(memory->context, mesh->tasks, memory->error);
        memcpy(mesh->splats->origin, mesh->origin, sizeof mesh->origin);
    }
    return mesh->splats;
}

static const char *const item_names[BURNISH_ATTRIBUTE_COUNT] = {
    "positions",           "normals", "colours", "texture coordinates", "tangents",
    "texture coordinates", "splats"};
static const char *const corner_names[BURNISH_ATTRIBUTE_COUNT] = {
    "triangles",       "normal indices",
    "colour indices",  "texture coordinate indices",
    "tangent indices", "texture coordinate indices",
    "splat indices"};

burnish_status burnish_mesh_data_reserve(burnish_mesh_data *mesh, burnish_attribute attribute,
                                         size_t count) {
    burnish_stream *stream = &mesh->streams[attribute];
    stream->items =
        burnish_reserve_discard(&mesh->memory, stream->items, &stream->capacity, count,
                                burnish_attribute_size(attribute), item_names[attribute]);
    return mesh->memory.status;
}

burnish_status burnish_mesh_data_reserve_corners(burnish_mesh_data *mesh,
                                                 burnish_attribute attribute, size_t triangles) {
    burnish_stream *stream = &mesh->streams[attribute];
    stream->corners =
        burnish_reserve_discard(&mesh->memory, stream->corners, &stream->corner_capacity, triangles,
                                3 * sizeof *stream->corners, corner_names[attribute]);
    return mesh->memory.status;
}

void burnish_mesh_data_list_warning(burnish_mesh_data *mesh, const char *line) {
    mesh->warnings = burnish_reserve(&mesh->memory, mesh->warnings, &mesh->warning_capacity,
                                     mesh->warning_count + 1, sizeof *mesh->warnings, "warnings");
    char *copy = burnish_allocate(&mesh->memory, strlen(line) + 1, 1, "warnings");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        strcpy(copy, line);
        mesh->warnings[mesh->warning_count++] = copy;
    } else {
        burnish_release(mesh->memory.context, copy);
    }
}

void burnish_mesh_data_warn(burnish_mesh_data *mesh, const char *format, ...) {
    char line[WARNING_SIZE];
    va_list arguments;
    if (mesh->is_silent) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    burnish_clean_text(line);
    burnish_context_warn(mesh->memory.context, line);
    if (mesh->warning_count < WARNING_LIMIT) {
        burnish_mesh_data_list_warning(mesh, line);
    }
}
