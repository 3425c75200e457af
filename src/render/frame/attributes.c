#include "render/frame/surface.h"

#include <string.h>

#include "core/srgb.h"

static burnish_float4 scaled_normal(const float *normals, uint32_t vertex, float scale) {
    const float *n = normals + 3 * (size_t)vertex;
    return (burnish_float4){n[0], n[1], n[2], 1.0f} * scale;
}

static burnish_float4 scaled_color(const uint8_t *colors, uint32_t vertex, float scale) {
    const uint8_t *codes = colors + 4 * (size_t)vertex;
    burnish_float4 color = {burnish_srgb_to_linear[codes[0]], burnish_srgb_to_linear[codes[1]],
                            burnish_srgb_to_linear[codes[2]], (float)codes[3] * (1.0f / 255)};
    return color * scale;
}

/* What the tasks of burnish_attributes_update share. */
typedef struct fill_context {
    burnish_attributes *attributes;
    const burnish_screen_vertices *vertices;
    const burnish_mesh_view *mesh;
} fill_context;

/* A vertex that clipping made takes the mean of its triangle's, weighted by where it lies. */
static void fill_clipped(const fill_context *fill, const burnish_clip_vertex *clip_vertices) {
    const burnish_screen_vertices *vertices = fill->vertices;
    const burnish_mesh_view *mesh = fill->mesh;
    for (size_t i = vertices->mesh_count; i < vertices->count; ++i) {
        const burnish_clip_vertex *clip = &clip_vertices[i - vertices->mesh_count];
        burnish_float4 normal = {0}, color = {0};
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh->indices[3 * (size_t)clip->triangle + k];
            normal += scaled_normal(mesh->normals, vertex, clip->weights[k]);
            if (fill->attributes->has_colors) {
                color += scaled_color(mesh->colors, vertex, clip->weights[k]);
            }
        }
        const float inverse_w = vertices->inverse_w[i];
        normal[3] = 1.0f;
        fill->attributes->normals[i] = normal * inverse_w;
        if (fill->attributes->has_colors) {
            fill->attributes->colors[i] = color * inverse_w;
        }
    }
}

static void fill_range(void *context, size_t first, size_t end) {
    const fill_context *fill = context;
    const burnish_attributes *attributes = fill->attributes;
    for (size_t i = first; i < end; ++i) {
        const float inverse_w = fill->vertices->inverse_w[i];
        attributes->normals[i] = scaled_normal(fill->mesh->normals, (uint32_t)i, inverse_w);
        if (attributes->has_colors) {
            attributes->colors[i] = scaled_color(fill->mesh->colors, (uint32_t)i, inverse_w);
        }
    }
}

burnish_status burnish_attributes_update(burnish_attributes *attributes,
                                         const burnish_geometry *geometry,
                                         const burnish_mesh_view *mesh, int ignore_colors,
                                         burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_screen_vertices *vertices = &geometry->vertices;
    attributes->has_colors = mesh->colors && !ignore_colors;
    attributes->normals =
        burnish_reserve_discard(memory, attributes->normals, &attributes->normal_capacity,
                                vertices->count, sizeof *attributes->normals, "screen normals");
    if (attributes->has_colors) {
        attributes->colors =
            burnish_reserve_discard(memory, attributes->colors, &attributes->color_capacity,
                                    vertices->count, sizeof *attributes->colors, "screen colours");
    }
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    fill_context fill = {attributes, vertices, mesh};
    burnish_tasks_ranges(tasks, vertices->mesh_count, BURNISH_TASK_GRAIN, fill_range, &fill);
    fill_clipped(&fill, geometry->clip_vertices);
    return BURNISH_STATUS_OK;
}

void burnish_attributes_destroy(burnish_attributes *attributes, const burnish_context *context) {
    burnish_release(context, attributes->normals);
    burnish_release(context, attributes->colors);
    memset(attributes, 0, sizeof *attributes);
}
