/* Texture coordinates of visible points: where the ray of a pixel meets a triangle. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_POINTS_SIMD_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_POINTS_SIMD_H

#include "render/texture/texture.h"
#include "simd/vector_math.h"

BURNISH_INLINE vf texture_dot(const vf a[3], const vf b[3]) {
    return vf_add(vf_add(vf_mul(a[0], b[0]), vf_mul(a[1], b[1])), vf_mul(a[2], b[2]));
}

BURNISH_INLINE void texture_cross(const vf a[3], const vf b[3], vf out[3]) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = vf_sub(vf_mul(a[i], b[j]), vf_mul(a[j], b[i]));
    }
}

BURNISH_INLINE void texture_set(const float from[3], vf out[3]) {
    for (int k = 0; k < 3; ++k) {
        out[k] = vf_set(from[k]);
    }
}

/* A plane over the screen: at its centre, per pixel to the right and up. */
typedef struct texture_plane {
    vf at, x, y;
} texture_plane;

BURNISH_INLINE texture_plane texture_plane_of(const vf ray[3], const vf right[3], const vf up[3],
                                              const vf normal[3]) {
    return (texture_plane){texture_dot(ray, normal), texture_dot(right, normal),
                           texture_dot(up, normal)};
}

BURNISH_INLINE void texture_store_plane(texture_plane plane, vf *out) {
    out[0] = plane.at;
    out[1] = plane.x;
    out[2] = plane.y;
}

/* Where rays meet triangles (Moeller and Trumbore 1997): both numerators and the determinant of the
 * weights are linear on the screen. They are computed from edges, not from corners, so single
 * precision suffices for triangles of any size.
 *
 * In perspective rays d leave the eye, 0: with s = -p they are d's dot products with e2 x s, s x e1
 * and e2 x e1. In parallel projection they start on a plane, all in one direction d: s moves, and
 * its dot products with d x e2 and e1 x d count. */
BURNISH_INLINE void texture_meet(const burnish_rays *rays, vf record[BURNISH_CORNER_FLOATS]) {
    const int is_parallel = !(rays->q_per_depth > 0);
    vf e1[3], e2[3], s[3], ray[3], right[3], up[3], normals[3][3];
    texture_plane first, second, determinant;
    texture_set(rays->ray_x, right);
    texture_set(rays->ray_y, up);
    for (int k = 0; k < 3; ++k) {
        s[k] = vf_sub(vf_set(0.0f), record[BURNISH_CORNER_P + k]);
        e1[k] = record[BURNISH_CORNER_E1 + k];
        e2[k] = record[BURNISH_CORNER_E2 + k];
    }
    if (is_parallel) {
        texture_set(rays->ray_depth, ray);
        texture_cross(ray, e2, normals[0]);
        texture_cross(e1, ray, normals[1]);
        const vf zero = vf_set(0.0f);
        first = texture_plane_of(s, right, up, normals[0]);
        second = texture_plane_of(s, right, up, normals[1]);
        determinant = (texture_plane){texture_dot(e1, normals[0]), zero, zero};
    } else {
        texture_set(rays->ray, ray);
        texture_cross(e2, s, normals[0]);
        texture_cross(s, e1, normals[1]);
        texture_cross(e2, e1, normals[2]);
        first = texture_plane_of(ray, right, up, normals[0]);
        second = texture_plane_of(ray, right, up, normals[1]);
        determinant = texture_plane_of(ray, right, up, normals[2]);
    }
    texture_store_plane(first, record + BURNISH_CORNER_FIRST);
    texture_store_plane(second, record + BURNISH_CORNER_SECOND);
    texture_store_plane(determinant, record + BURNISH_CORNER_DETERMINANT);
}

static void plane_records(const burnish_rays *rays, float *records, size_t count) {
    enum { SIZE = BURNISH_CORNER_FLOATS };
    for (size_t i = 0; i < count; i += LANES) {
        float aside[4 * LANES];
        vf record[SIZE];
        const void *from[LANES];
        for (int k = 0; k < SIZE; k += 4) {
            for (size_t lane = 0; lane < LANES; ++lane) {
                from[lane] = records + SIZE * (i + lane) + k;
            }
            vf_load_aos4(from, record + k);
        }
        texture_meet(rays, record);
        for (int k = 0; k < SIZE; k += 4) {
            vf_store_aos4(aside, record[k], record[k + 1], record[k + 2], record[k + 3]);
            for (size_t lane = 0; lane < LANES; ++lane) {
                memcpy(records + SIZE * (i + lane) + k, aside + 4 * lane, 4 * sizeof *aside);
            }
        }
    }
}

/* The records of LANES points, number by number. */
BURNISH_INLINE void texture_load_records(const float *corners, const uint16_t *records,
                                         int is_uniform, vf out[BURNISH_CORNER_FLOATS]) {
    const void *from[LANES];
    if (is_uniform) {
        const float *record = corners + BURNISH_CORNER_FLOATS * (size_t)records[0];
        for (int k = 0; k < BURNISH_CORNER_FLOATS; ++k) {
            out[k] = vf_set(record[k]);
        }
        return;
    }
    for (int k = 0; k < BURNISH_CORNER_FLOATS; k += 4) {
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = corners + BURNISH_CORNER_FLOATS * (size_t)records[lane] + k;
        }
        vf_load_aos4(from, out + k);
    }
}

BURNISH_INLINE vf texture_plane_at(const vf plane[3], vf x, vf y) {
    return vf_add(plane[0], vf_add(vf_mul(x, plane[1]), vf_mul(y, plane[2])));
}

/* A weight and its change per pixel to the right and up, from planes. */
BURNISH_INLINE texture_plane texture_divide(const vf plane[3], const vf determinant[3], vf inverse,
                                            vf x, vf y) {
    texture_plane weight;
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    weight.at = vf_mul(texture_plane_at(plane, x, y), inverse);
    weight.at = vf_min(vf_max(weight.at, zero), one); /* 0 for NaN */
    weight.x = vf_mul(vf_sub(plane[1], vf_mul(weight.at, determinant[1])), inverse);
    weight.y = vf_mul(vf_sub(plane[2], vf_mul(weight.at, determinant[2])), inverse);
    return weight;
}

static void locate_points(const burnish_screen_points *points, const float *corners,
                          const uint16_t *records, const uint8_t *is_uniform, size_t count,
                          float *const *streams, float *const *weights) {
    for (size_t i = 0; i < count; i += LANES) {
        vf record[BURNISH_CORNER_FLOATS];
        const int uniform = is_uniform[i / BURNISH_TEXTURE_GROUP];
        const size_t at = uniform ? i / BURNISH_TEXTURE_GROUP * BURNISH_TEXTURE_GROUP : i;
        texture_load_records(corners, records + at, uniform, record);
        const vf *determinant = record + BURNISH_CORNER_DETERMINANT;
        const vf x = vf_add(vf_set(points->x), vf_load(points->x_offset + i));
        const vf y = vf_add(vf_set(points->y), vf_load(points->y_offset + i));
        const vf inverse = vf_div(vf_set(1.0f), texture_plane_at(determinant, x, y));
        const texture_plane first =
            texture_divide(record + BURNISH_CORNER_FIRST, determinant, inverse, x, y);
        const texture_plane second =
            texture_divide(record + BURNISH_CORNER_SECOND, determinant, inverse, x, y);
        for (int k = 0; k < 2; ++k) {
            const vf along1 = record[BURNISH_CORNER_UV1 + k];
            const vf along2 = record[BURNISH_CORNER_UV2 + k];
            const vf from = record[BURNISH_CORNER_UV + k];
            vf_store(streams[k] + i,
                     vf_add(from, vf_add(vf_mul(first.at, along1), vf_mul(second.at, along2))));
            vf_store(streams[2 + k] + i, vf_add(vf_mul(first.x, along1), vf_mul(second.x, along2)));
            vf_store(streams[4 + k] + i, vf_add(vf_mul(first.y, along1), vf_mul(second.y, along2)));
        }
        if (weights) {
            vf_store(weights[0] + i, first.at);
            vf_store(weights[1] + i, second.at);
        }
    }
}

#endif
