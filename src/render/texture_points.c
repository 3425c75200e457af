/* Where visible points lie in their triangles' images: gathers the triangles, which the kernel then
 * meets with rays (texture_simd.h). */
#include <string.h>

#include "render/texture.h"

/* Corner 0 from the eye, in the raster's space, and the edges from it. */
static void fill_record(const burnish_texturing *texturing, const uint32_t *vertices,
                        float *record) {
    const burnish_mesh_view *mesh = texturing->mesh;
    const float *p = mesh->positions + 3 * (size_t)vertices[0];
    const float *uv = mesh->texture_coordinates + 2 * (size_t)vertices[0];
    for (int k = 0; k < 3; ++k) {
        record[BURNISH_CORNER_P + k] =
            (float)(((double)p[k] - texturing->origin[k]) * texturing->scale - texturing->eye[k]);
    }
    record[BURNISH_CORNER_UV] = uv[0];
    record[BURNISH_CORNER_UV + 1] = uv[1];
    for (int edge = 0; edge < 2; ++edge) {
        const float *end = mesh->positions + 3 * (size_t)vertices[edge + 1];
        const float *end_uv = mesh->texture_coordinates + 2 * (size_t)vertices[edge + 1];
        for (int k = 0; k < 3; ++k) {
            record[BURNISH_CORNER_E1 + 3 * edge + k] =
                (float)(((double)end[k] - (double)p[k]) * texturing->scale);
        }
        record[BURNISH_CORNER_UV1 + 2 * edge] = end_uv[0] - uv[0];
        record[BURNISH_CORNER_UV1 + 2 * edge + 1] = end_uv[1] - uv[1];
    }
}

enum { GROUP = 16 }; /* points; a row of blocks is a multiple */

/* Whether all points of a group show the triangle and material of the first. */
static int is_uniform(const uint32_t *ids, const int32_t *materials) {
    uint32_t different = 0;
    for (int i = 1; i < GROUP; ++i) {
        different |= ids[i] ^ ids[0];
    }
    for (int i = 1; i < (materials ? GROUP : 0); ++i) {
        different |= (uint32_t)(materials[i] ^ materials[0]);
    }
    return different == 0;
}

/* The record of a triangle: one of the last ones, as blocks show the same few triangles row after
 * row, or record *used. */
static uint16_t record_of(const burnish_texturing *texturing, uint32_t id, int *used,
                          burnish_texture_scratch *scratch) {
    uint16_t *recent = &scratch->recent[(id >> 1) % BURNISH_TEXTURE_RECENT];
    if (*recent == 0 || *recent >= *used || scratch->record_ids[*recent] != id) {
        scratch->record_ids[*used] = id;
        fill_record(texturing, texturing->mesh->indices + 3 * (size_t)(id >> 1),
                    scratch->corners[*used]);
        *recent = (uint16_t)(*used)++;
    }
    return *recent;
}

/* Record 0 is of points without an image. */
static void find_records(const burnish_texturing *texturing, const int32_t *materials, int count,
                         burnish_texture_scratch *scratch) {
    int used = 1;
    memset(scratch->corners[0], 0, sizeof scratch->corners[0]);
    for (int first = 0; first < count; first += GROUP) {
        const uint32_t *ids = scratch->ids + first;
        const int32_t *shown = materials ? materials + first : NULL;
        uint16_t *records = scratch->records + first;
        const int size = count - first < GROUP ? count - first : GROUP;
        const int step = size == GROUP && is_uniform(ids, shown) ? GROUP : 1;
        for (int i = 0; i < size; i += step) {
            records[i] = texturing->materials[shown ? shown[i] : 0].has_textures
                             ? record_of(texturing, ids[i], &used, scratch)
                             : 0;
        }
        for (int i = step == GROUP ? 1 : size; i < GROUP; ++i) { /* whole vectors are read */
            records[i] = step == GROUP ? records[0] : 0;
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
    float *to[BURNISH_TEXTURE_TANGENT];
    float *const weights[2] = {scratch->weights[0], scratch->weights[1]};
    find_records(texturing, materials, count, scratch);
    for (int k = 0; k < BURNISH_TEXTURE_TANGENT; ++k) {
        to[k] = scratch->points[k];
    }
    ops->locate_points(rays, points, scratch->corners[0], scratch->records, (size_t)count, to,
                       weights);
    for (int i = 0; i < count && texturing->needs_tangents; ++i) {
        if (texturing->materials[materials ? materials[i] : 0].has_normals) {
            interpolate_tangents(texturing, ids[i], i, scratch);
        }
    }
}
