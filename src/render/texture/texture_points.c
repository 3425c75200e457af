/* Texture coordinates of visible points: gathers the triangles, which the kernel then intersects
 * with rays (texture_points_simd.h). */
#include "render/texture/texture.h"

#include <string.h>

/* Corner 0 and the edges from it in the image. */
static void fill_image(const float *coordinates, const uint32_t *vertices, float *record) {
    const float *uv = coordinates + 2 * (size_t)vertices[0];
    record[BURNISH_CORNER_UV] = uv[0];
    record[BURNISH_CORNER_UV + 1] = uv[1];
    for (int edge = 0; edge < 2; ++edge) {
        const float *end_uv = coordinates + 2 * (size_t)vertices[edge + 1];
        record[BURNISH_CORNER_UV1 + 2 * edge] = end_uv[0] - uv[0];
        record[BURNISH_CORNER_UV1 + 2 * edge + 1] = end_uv[1] - uv[1];
    }
}

/* Corner 0 from the eye, in the raster's space, and the edges from it. */
static void fill_record(const burnish_texturing *texturing, const uint32_t *vertices,
                        float *record) {
    const burnish_mesh_view *mesh = texturing->mesh;
    const float *p = mesh->positions + 3 * (size_t)vertices[0];
    fill_image(mesh->texture_coordinates, vertices, record);
    for (int k = 0; k < 3; ++k) {
        record[BURNISH_CORNER_P + k] =
            (float)(((double)p[k] - texturing->origin[k]) * texturing->scale - texturing->eye[k]);
    }
    for (int edge = 0; edge < 2; ++edge) {
        const float *end = mesh->positions + 3 * (size_t)vertices[edge + 1];
        for (int k = 0; k < 3; ++k) {
            record[BURNISH_CORNER_E1 + 3 * edge + k] =
                (float)(((double)end[k] - (double)p[k]) * texturing->scale);
        }
    }
}

/* Whether all points of a group show the triangle and material of the first. */
static int is_uniform(const uint32_t *ids, const int32_t *materials) {
    uint32_t different = 0;
    for (int i = 1; i < BURNISH_TEXTURE_GROUP; ++i) {
        different |= ids[i] ^ ids[0];
    }
    for (int i = 1; i < (materials ? BURNISH_TEXTURE_GROUP : 0); ++i) {
        different |= (uint32_t)(materials[i] ^ materials[0]);
    }
    return different == 0;
}

void burnish_texture_begin(burnish_texture_scratch *scratch) {
    scratch->record_count = 1;
    memset(scratch->recent, 0, sizeof scratch->recent);
}

/* The record of a triangle: one that was used before, or a new one. */
static uint16_t record_of(const burnish_texturing *texturing, uint32_t id,
                          burnish_texture_scratch *scratch) {
    uint16_t *recent = &scratch->recent[(id >> 1) % BURNISH_TEXTURE_RECENT];
    if (*recent == 0 || scratch->record_ids[*recent] != id) {
        *recent = (uint16_t)scratch->record_count++;
        scratch->record_ids[*recent] = id;
        fill_record(texturing, texturing->mesh->indices + 3 * (size_t)(id >> 1),
                    scratch->corners[*recent]);
    }
    return *recent;
}

/* Record 0 is of points without an image. */
static void find_records(const burnish_texturing *texturing, const int32_t *materials, int count,
                         burnish_texture_scratch *scratch) {
    for (int first = 0; first < count; first += BURNISH_TEXTURE_GROUP) {
        uint32_t *ids = scratch->ids + first;
        const int32_t *shown = materials ? materials + first : NULL;
        uint16_t *records = scratch->records + first;
        const int size =
            count - first < BURNISH_TEXTURE_GROUP ? count - first : BURNISH_TEXTURE_GROUP;
        const int uniform = size == BURNISH_TEXTURE_GROUP && is_uniform(ids, shown);
        scratch->is_uniform[first / BURNISH_TEXTURE_GROUP] = (uint8_t)uniform;
        for (int i = 0; i < (uniform ? 1 : size); ++i) {
            records[i] = texturing->materials[shown ? shown[i] : 0].has_textures
                             ? record_of(texturing, ids[i], scratch)
                             : 0;
        }
        for (int i = size; i < BURNISH_TEXTURE_GROUP; ++i) { /* whole vectors are read */
            records[i] = 0;
            ids[i] = ids[0];
        }
    }
}

/* The same points in the second image: its records differ from the first's in the image alone. */
static void locate_second(const burnish_texturing *texturing, const burnish_screen_points *points,
                          int known, int count, burnish_texture_scratch *scratch) {
    const burnish_mesh_view *mesh = texturing->mesh;
    float *to[6];
    for (int i = known; i < scratch->record_count; ++i) {
        memcpy(scratch->second[i], scratch->corners[i], sizeof scratch->second[i]);
        fill_image(mesh->second_coordinates,
                   mesh->indices + 3 * (size_t)(scratch->record_ids[i] >> 1), scratch->second[i]);
    }
    for (int k = 0; k < 6; ++k) {
        to[k] = scratch->points[BURNISH_TEXTURE_SECOND + k];
    }
    texturing->ops->locate_points(points, scratch->second[0], scratch->records, scratch->is_uniform,
                                  (size_t)count, to, NULL);
}

void burnish_texture_locate(const burnish_texturing *texturing, const burnish_rays *rays,
                            const burnish_screen_points *points, const int32_t *materials,
                            int count, burnish_texture_scratch *scratch) {
    const burnish_render_ops *ops = texturing->ops;
    float *to[BURNISH_TEXTURE_TANGENT];
    float *const weights[2] = {scratch->weights[0], scratch->weights[1]};
    if (scratch->record_count + count > BURNISH_TEXTURE_RECORDS) {
        burnish_texture_begin(scratch);
    }
    const int known = scratch->record_count;
    find_records(texturing, materials, count, scratch);
    ops->plane_records(rays, scratch->corners[known], (size_t)(scratch->record_count - known));
    for (int k = 0; k < BURNISH_TEXTURE_TANGENT; ++k) {
        to[k] = scratch->points[k];
    }
    ops->locate_points(points, scratch->corners[0], scratch->records, scratch->is_uniform,
                       (size_t)count, to, texturing->needs_tangents ? weights : NULL);
    if (texturing->needs_second) {
        locate_second(texturing, points, known, count, scratch);
    }
    if (texturing->needs_tangents) {
        const float *const found[2] = {weights[0], weights[1]};
        for (int k = 0; k < 4; ++k) {
            to[k] = scratch->points[BURNISH_TEXTURE_TANGENT + k];
        }
        ops->interpolate_tangents(texturing->mesh, scratch->ids, found, (size_t)count, to);
    }
}
