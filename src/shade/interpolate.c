/* Attributes a vertex become attributes a point. In perspective an attribute times 1/w is linear on
 * the screen; a normal's length is of no interest, so its interpolation needs no division. */
#include "shade/interpolate.h"

#include "base/srgb.h"

/* The mesh's vertices and their weights at a point: up to three vertices. */
typedef struct corner_weights {
    uint32_t vertices[3];
    float weights[3]; /* times 1/w, not normalised */
} corner_weights;

static corner_weights weights_at(const burnish_shader *shader, const burnish_fragments *fragments,
                                 int i) {
    const burnish_screen_vertices *screen = &shader->geometry->vertices;
    const burnish_setup_triangle *triangle = &shader->geometry->triangles[fragments->triangle[i]];
    const uint32_t *v = triangle->vertices;
    float weight1 = fragments->weight1[i], weight2 = fragments->weight2[i];
    float weight0 = (1.0f - weight1) - weight2;
    corner_weights corners = {{v[0], v[1], v[2]},
                              {weight0 * screen->inverse_w[v[0]], weight1 * screen->inverse_w[v[1]],
                               weight2 * screen->inverse_w[v[2]]}};
    if (v[0] < screen->mesh_count) {
        return corners;
    }
    /* A clipped triangle: go on to the weights of the mesh's triangle that it is part of. */
    const burnish_clip_vertex *clips = shader->geometry->clip_vertices;
    corner_weights whole = {{0}, {0}};
    for (int k = 0; k < 3; ++k) {
        const burnish_clip_vertex *clip = &clips[v[k] - screen->mesh_count];
        whole.vertices[k] = shader->indices[3 * (size_t)clip->triangle + (size_t)k];
        for (int j = 0; j < 3; ++j) {
            whole.weights[j] += corners.weights[k] * clip->weights[j];
        }
    }
    return whole;
}

static void interpolate_color(const uint8_t *colors, const corner_weights *corners, float inverse,
                              burnish_points *points, int i) {
    for (int channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
            uint8_t code = colors[4 * (size_t)corners->vertices[k] + (size_t)channel];
            sum += corners->weights[k] * burnish_srgb_to_linear[code];
        }
        points->diffuse[channel][i] = sum * inverse;
    }
}

static void interpolate_normal(const float *normals, const corner_weights *corners, float scale,
                               burnish_points *points, int i) {
    for (int axis = 0; axis < 3; ++axis) {
        float sum = 0;
        for (int k = 0; k < 3; ++k) {
            sum += corners->weights[k] * normals[3 * (size_t)corners->vertices[k] + (size_t)axis];
        }
        points->normal[axis][i] = sum * scale;
    }
}

void burnish_interpolate(const burnish_shader *shader, const burnish_fragments *fragments,
                         burnish_points *points) {
    int needs_weights = shader->colors || shader->lighting.lyon;
    points->count = fragments->count;
    for (int i = 0; i < fragments->count; ++i) {
        corner_weights corners = weights_at(shader, fragments, i);
        uint32_t source = shader->geometry->triangles[fragments->triangle[i]].source;
        float scale = source & 1 ? -1.0f : 1.0f;
        if (needs_weights) {
            float sum = (corners.weights[0] + corners.weights[1]) + corners.weights[2];
            float inverse = 1.0f / sum;
            scale = shader->lighting.lyon ? scale * inverse : scale;
            if (shader->colors) {
                interpolate_color(shader->colors, &corners, inverse, points, i);
            }
        }
        interpolate_normal(shader->normals, &corners, scale, points, i);
        points->material[i] =
            shader->triangle_materials ? shader->triangle_materials[source >> 1] : 0;
    }
}
