/* Attributes a vertex become attributes a point. In perspective an attribute times 1/w is linear on
 * the screen; a normal's length is of no interest, so its interpolation needs no division. */
#include "shading/interpolate.h"

static burnish_float4 mix(const burnish_float4 *attributes, const uint32_t v[3], float weight1,
                          float weight2) {
    const float weight0 = (1.0f - weight1) - weight2;
    return (attributes[v[0]] * weight0 + attributes[v[1]] * weight1) + attributes[v[2]] * weight2;
}

void burnish_interpolate(const burnish_shader *shader, const burnish_fragments *fragments,
                         burnish_points *points) {
    const burnish_attributes *attributes = shader->attributes;
    const int needs_w = attributes->has_colors || burnish_shader_is_lyon(shader);
    points->count = fragments->count;
    for (int i = 0; i < fragments->count; ++i) {
        const burnish_primitive *corners = &fragments->primitives[i];
        const float weight1 = fragments->weight1[i], weight2 = fragments->weight2[i];
        burnish_float4 normal = mix(attributes->normals, corners->vertices, weight1, weight2);
        float scale = corners->id_and_facing & 1 ? -1.0f : 1.0f;
        if (needs_w) {
            const float w = 1.0f / normal[3];
            scale = burnish_shader_is_lyon(shader) ? scale * w : scale;
            if (attributes->has_colors) {
                burnish_float4 color =
                    mix(attributes->colors, corners->vertices, weight1, weight2) * w;
                points->diffuse[0][i] = color[0];
                points->diffuse[1][i] = color[1];
                points->diffuse[2][i] = color[2];
            }
        }
        normal *= scale;
        points->normal[0][i] = normal[0];
        points->normal[1][i] = normal[1];
        points->normal[2][i] = normal[2];
        points->material[i] = shader->triangle_materials
                                  ? shader->triangle_materials[corners->id_and_facing >> 1]
                                  : 0;
    }
}
