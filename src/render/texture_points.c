/* Where visible points lie in their triangles' images: gathers the triangles, which the kernel then
 * meets with rays (texture_simd.h). */
#include <string.h>

#include "render/texture.h"

/* Corner 0 from the eye, in the raster's space, and the edges from it. */
static void gather_corners(const burnish_texturing *texturing, const uint32_t *vertices, int at,
                           float (*corners)[BURNISH_TEXTURE_BATCH]) {
    const burnish_mesh_view *mesh = texturing->mesh;
    const float *p = mesh->positions + 3 * (size_t)vertices[0];
    const float *uv = mesh->texture_coordinates + 2 * (size_t)vertices[0];
    for (int k = 0; k < 3; ++k) {
        corners[BURNISH_CORNER_P + k][at] =
            (float)(((double)p[k] - texturing->origin[k]) * texturing->scale - texturing->eye[k]);
    }
    corners[BURNISH_CORNER_UV][at] = uv[0];
    corners[BURNISH_CORNER_UV + 1][at] = uv[1];
    for (int edge = 0; edge < 2; ++edge) {
        const float *end = mesh->positions + 3 * (size_t)vertices[edge + 1];
        const float *end_uv = mesh->texture_coordinates + 2 * (size_t)vertices[edge + 1];
        for (int k = 0; k < 3; ++k) {
            corners[BURNISH_CORNER_E1 + 3 * edge + k][at] =
                (float)(((double)end[k] - (double)p[k]) * texturing->scale);
        }
        corners[BURNISH_CORNER_UV1 + 2 * edge][at] = end_uv[0] - uv[0];
        corners[BURNISH_CORNER_UV1 + 2 * edge + 1][at] = end_uv[1] - uv[1];
    }
}

/* Points without an image get 0. */
static void clear_corners(int at, float (*corners)[BURNISH_TEXTURE_BATCH]) {
    for (int k = 0; k < BURNISH_CORNER_STREAMS; ++k) {
        corners[k][at] = 0;
    }
}

/* Points up to `end` are of the same triangle. */
static void repeat_corners(int first, int end, float (*corners)[BURNISH_TEXTURE_BATCH]) {
    for (int k = 0; k < BURNISH_CORNER_STREAMS; ++k) {
        const float value = corners[k][first];
        for (int i = first + 1; i < end; ++i) {
            corners[k][i] = value;
        }
    }
}

/* Tangents by the weights that the kernel has found. */
static void interpolate_tangents(const burnish_texturing *texturing, uint32_t id, int i,
                                 burnish_texture_scratch *scratch) {
    const uint32_t *vertices = texturing->mesh->indices + 3 * (size_t)(id >> 1);
    const float *tangents = texturing->mesh->tangents;
    const float *a = tangents + 4 * (size_t)vertices[0], *b = tangents + 4 * (size_t)vertices[1];
    const float *c = tangents + 4 * (size_t)vertices[2];
    const float side = id & 1 ? -1.0f : 1.0f; /* seen from its back all of the frame turns */
    const float weight1 = scratch->weights[0][i], weight2 = scratch->weights[1][i];
    for (int k = 0; k < 3; ++k) {
        scratch->points[BURNISH_TEXTURE_TANGENT + k][i] =
            side * ((a[k] + weight1 * (b[k] - a[k])) + weight2 * (c[k] - a[k]));
    }
    scratch->points[BURNISH_TEXTURE_SIGN][i] = side * a[3];
}

void burnish_texture_locate(const burnish_texturing *texturing, const burnish_isa_ops *ops,
                            const burnish_rays *rays, const burnish_screen_points *points,
                            const int32_t *materials, int count, burnish_texture_scratch *scratch) {
    const uint32_t *ids = scratch->ids;
    const float *from[BURNISH_CORNER_STREAMS];
    float *to[BURNISH_TEXTURE_TANGENT];
    float *const weights[2] = {scratch->weights[0], scratch->weights[1]};
    for (int i = 0, end; i < count; i = end) {
        const int material = materials ? materials[i] : 0;
        for (end = i + 1; end < count && ids[end] == ids[i]; ++end) {
        }
        if (texturing->materials[material].has_textures) {
            gather_corners(texturing, texturing->mesh->indices + 3 * (size_t)(ids[i] >> 1), i,
                           scratch->corners);
        } else {
            clear_corners(i, scratch->corners);
        }
        repeat_corners(i, end, scratch->corners);
    }
    for (int i = count; i % 16; ++i) { /* whole vectors are read */
        clear_corners(i, scratch->corners);
    }
    for (int k = 0; k < BURNISH_CORNER_STREAMS; ++k) {
        from[k] = scratch->corners[k];
    }
    for (int k = 0; k < BURNISH_TEXTURE_TANGENT; ++k) {
        to[k] = scratch->points[k];
    }
    ops->locate_points(rays, points, from, (size_t)count, to, weights);
    for (int i = 0; i < count && texturing->needs_tangents; ++i) {
        if (texturing->materials[materials ? materials[i] : 0].has_normals) {
            interpolate_tangents(texturing, ids[i], i, scratch);
        }
    }
}
