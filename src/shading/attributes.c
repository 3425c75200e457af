/* Attributes a vertex, ready to be interpolated linearly on the screen. */
#include "shading/attributes.h"

#include <stdlib.h>
#include <string.h>

#include "core/memory.h"
#include "core/srgb.h"

static burnish_float4 scaled_normal(const float *normals, uint32_t vertex, float scale) {
    const float *n = normals + 3 * (size_t)vertex;
    return (burnish_float4){n[0], n[1], n[2], 1.0f} * scale;
}

static burnish_float4 scaled_color(const uint8_t *colors, uint32_t vertex, float scale) {
    const uint8_t *codes = colors + 4 * (size_t)vertex;
    burnish_float4 color = {burnish_srgb_to_linear[codes[0]], burnish_srgb_to_linear[codes[1]],
                            burnish_srgb_to_linear[codes[2]], 0.0f};
    return color * scale;
}

/* A vertex that clipping made takes the mean of its triangle's, weighted by where it lies. */
static void fill_clipped(burnish_attributes *attributes, const burnish_geometry *geometry,
                         const float *normals, const uint8_t *colors, const uint32_t *indices) {
    const burnish_screen_vertices *vertices = &geometry->vertices;
    for (size_t i = vertices->mesh_count; i < vertices->count; ++i) {
        const burnish_clip_vertex *clip = &geometry->clip_vertices[i - vertices->mesh_count];
        burnish_float4 normal = {0}, color = {0};
        for (size_t k = 0; k < 3; ++k) {
            uint32_t vertex = indices[3 * (size_t)clip->triangle + k];
            normal += scaled_normal(normals, vertex, clip->weights[k]);
            if (colors) {
                color += scaled_color(colors, vertex, clip->weights[k]);
            }
        }
        float inverse_w = vertices->inverse_w[i];
        normal[3] = 1.0f;
        attributes->normals[i] = normal * inverse_w;
        if (colors) {
            attributes->colors[i] = color * inverse_w;
        }
    }
}

/* What the tasks of burnish_attributes_update share. */
typedef struct fill_context {
    burnish_attributes *attributes;
    const burnish_screen_vertices *vertices;
    const float *normals;
    const uint8_t *colors;
} fill_context;

static void fill_chunk(void *of, size_t index, int thread) {
    const fill_context *context = of;
    const size_t first = index * BURNISH_TASK_GRAIN, rest = context->vertices->mesh_count - first;
    const size_t end = first + (rest < BURNISH_TASK_GRAIN ? rest : BURNISH_TASK_GRAIN);
    (void)thread;
    for (size_t i = first; i < end; ++i) {
        float inverse_w = context->vertices->inverse_w[i];
        context->attributes->normals[i] = scaled_normal(context->normals, (uint32_t)i, inverse_w);
        if (context->colors) {
            context->attributes->colors[i] = scaled_color(context->colors, (uint32_t)i, inverse_w);
        }
    }
}

burnish_status burnish_attributes_update(burnish_attributes *attributes,
                                         const burnish_geometry *geometry, const float *normals,
                                         const uint8_t *colors, const uint32_t *indices,
                                         burnish_tasks *pool, burnish_error *error) {
    const burnish_screen_vertices *vertices = &geometry->vertices;
    attributes->has_colors = colors != NULL;
    burnish_status status = burnish_legacy_reserve_discard(
        (void **)&attributes->normals, &attributes->normal_capacity, vertices->count,
        sizeof *attributes->normals, "normals on the screen", error);
    if (status == BURNISH_STATUS_OK && colors) {
        status = burnish_legacy_reserve_discard(
            (void **)&attributes->colors, &attributes->color_capacity, vertices->count,
            sizeof *attributes->colors, "colours on the screen", error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    fill_context context = {attributes, vertices, normals, colors};
    burnish_tasks_run(pool, (vertices->mesh_count + BURNISH_TASK_GRAIN - 1) / BURNISH_TASK_GRAIN, 1,
                      0, fill_chunk, &context);
    fill_clipped(attributes, geometry, normals, colors, indices);
    return BURNISH_STATUS_OK;
}

void burnish_attributes_destroy(burnish_attributes *attributes) {
    free(attributes->normals);
    free(attributes->colors);
    memset(attributes, 0, sizeof *attributes);
}
