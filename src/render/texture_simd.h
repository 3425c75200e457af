/* Sampling textures, and turning normals by them, over vectors of points. */
#ifndef BURNISH_RENDER_TEXTURE_SIMD_H
#define BURNISH_RENDER_TEXTURE_SIMD_H

#include "render/texture.h"
#include "simd/vector_math.h"

/* Adding it to a float of magnitude below 2^22 leaves a whole number: 1.5 * 2^23. */
#define TEXTURE_ROUNDER 12582912.0f

/* Coordinates beyond it have no bits left for texels. */
#define TEXTURE_REACH 0x1p20f

BURNISH_INLINE vf texture_dot(const vf a[3], const vf b[3]) {
    return vf_add(vf_add(vf_mul(a[0], b[0]), vf_mul(a[1], b[1])), vf_mul(a[2], b[2]));
}

BURNISH_INLINE void texture_normalize(vf v[3]) {
    const vf inverse = vector_inverse_sqrt(texture_dot(v, v));
    for (int k = 0; k < 3; ++k) {
        v[k] = vf_mul(v[k], inverse);
    }
}

/* ---- Rays and triangles ---- */

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

/* A number that is linear on the screen: at the point, to the right, up. */
typedef struct texture_linear {
    vf at, x, y;
} texture_linear;

/* Where rays meet triangles (Moeller and Trumbore 1997): both numerators and the determinant of the
 * weights are linear on the screen. They come from edges, not from corners, so that single
 * precision is enough for triangles of any size. */
typedef struct texture_meeting {
    texture_linear first, second, determinant;
} texture_meeting;

/* In perspective rays d leave the eye, 0: with s = -p their dot products with e2 x s, s x e1 and
 * e2 x e1. */
BURNISH_INLINE texture_meeting texture_meet_perspective(const burnish_rays *rays, vf x, vf y,
                                                        const vf s[3], const vf e1[3],
                                                        const vf e2[3]) {
    vf ray[3], right[3], up[3], d[3], normals[3][3];
    texture_linear out[3];
    texture_set(rays->ray, ray);
    texture_set(rays->ray_x, right);
    texture_set(rays->ray_y, up);
    for (int k = 0; k < 3; ++k) {
        d[k] = vf_add(vf_add(ray[k], vf_mul(x, right[k])), vf_mul(y, up[k]));
    }
    texture_cross(e2, s, normals[0]);
    texture_cross(s, e1, normals[1]);
    texture_cross(e2, e1, normals[2]);
    for (int k = 0; k < 3; ++k) {
        out[k] = (texture_linear){texture_dot(d, normals[k]), texture_dot(right, normals[k]),
                                  texture_dot(up, normals[k])};
    }
    return (texture_meeting){out[0], out[1], out[2]};
}

/* In parallel projection they start on a plane, all in one direction d. */
BURNISH_INLINE texture_meeting texture_meet_parallel(const burnish_rays *rays, vf x, vf y,
                                                     const vf s[3], const vf e1[3],
                                                     const vf e2[3]) {
    vf right[3], up[3], d[3], from[3], normals[2][3];
    texture_linear out[2];
    texture_set(rays->ray_x, right);
    texture_set(rays->ray_y, up);
    texture_set(rays->ray_depth, d);
    for (int k = 0; k < 3; ++k) {
        from[k] = vf_add(s[k], vf_add(vf_mul(x, right[k]), vf_mul(y, up[k])));
    }
    texture_cross(d, e2, normals[0]);
    texture_cross(e1, d, normals[1]);
    for (int k = 0; k < 2; ++k) {
        out[k] = (texture_linear){texture_dot(from, normals[k]), texture_dot(right, normals[k]),
                                  texture_dot(up, normals[k])};
    }
    const vf zero = vf_set(0.0f);
    return (texture_meeting){out[0], out[1], {texture_dot(e1, normals[0]), zero, zero}};
}

/* A weight and how it changes. */
BURNISH_INLINE texture_linear texture_divide(texture_linear numerator, texture_linear determinant,
                                             vf inverse) {
    texture_linear weight;
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    weight.at = vf_min(vf_max(vf_mul(numerator.at, inverse), zero), one); /* 0 for NaN */
    weight.x = vf_mul(vf_sub(numerator.x, vf_mul(weight.at, determinant.x)), inverse);
    weight.y = vf_mul(vf_sub(numerator.y, vf_mul(weight.at, determinant.y)), inverse);
    return weight;
}

/* The records of LANES points, number by number. */
BURNISH_INLINE void texture_load_records(const float *corners, const uint16_t *records,
                                         vf out[BURNISH_CORNER_FLOATS]) {
    const void *from[LANES];
    for (int k = 0; k < BURNISH_CORNER_FLOATS; k += 4) {
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = corners + BURNISH_CORNER_FLOATS * (size_t)records[lane] + k;
        }
        vf_load_aos4(from, out + k);
    }
}

static void locate_points(const burnish_rays *rays, const burnish_screen_points *points,
                          const float *corners, const uint16_t *records, size_t count,
                          float *const *streams, float *const weights[2]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf record[BURNISH_CORNER_FLOATS], s[3];
        texture_load_records(corners, records + i, record);
        const vf *e1 = record + BURNISH_CORNER_E1, *e2 = record + BURNISH_CORNER_E2;
        for (int k = 0; k < 3; ++k) {
            s[k] = vf_sub(vf_set(0.0f), record[BURNISH_CORNER_P + k]);
        }
        const vf x = vf_add(vf_set(points->x), vf_load(points->x_offset + i));
        const vf y = vf_add(vf_set(points->y), vf_load(points->y_offset + i));
        const int is_parallel = !(rays->q_per_depth > 0);
        const texture_meeting meeting = is_parallel
                                            ? texture_meet_parallel(rays, x, y, s, e1, e2)
                                            : texture_meet_perspective(rays, x, y, s, e1, e2);
        const vf inverse = vf_div(vf_set(1.0f), meeting.determinant.at);
        const texture_linear first = texture_divide(meeting.first, meeting.determinant, inverse);
        const texture_linear second = texture_divide(meeting.second, meeting.determinant, inverse);
        for (int k = 0; k < 2; ++k) {
            const vf along1 = record[BURNISH_CORNER_UV1 + k];
            const vf along2 = record[BURNISH_CORNER_UV2 + k];
            const vf from = record[BURNISH_CORNER_UV + k];
            vf_store(streams[k] + i,
                     vf_add(from, vf_add(vf_mul(first.at, along1), vf_mul(second.at, along2))));
            vf_store(streams[2 + k] + i, vf_add(vf_mul(first.x, along1), vf_mul(second.x, along2)));
            vf_store(streams[4 + k] + i, vf_add(vf_mul(first.y, along1), vf_mul(second.y, along2)));
        }
        vf_store(weights[0] + i, first.at);
        vf_store(weights[1] + i, second.at);
    }
}

/* ---- Texels ---- */

/* The whole number below x, abs(x) < 2^21; one less for some whole x, which then are that plus 1:
 * interpolation comes to the same. */
BURNISH_INLINE vf texture_floor(vf x) {
    const vf rounder = vf_set(TEXTURE_ROUNDER);
    return vf_sub(vf_add(vf_sub(x, vf_set(0.5f)), rounder), rounder);
}

/* A whole number as an integer. */
BURNISH_INLINE vi texture_integer(vf x) {
    return vi_sub(vf_bits(vf_add(x, vf_set(TEXTURE_ROUNDER))), vi_set(0x4b400000));
}

/* One coordinate in [0, 1], about, by its wrap. NaN gives some number. */
BURNISH_INLINE vf texture_wrap(vf u, int wrap) {
    u = vf_min(vf_max(u, vf_set(-TEXTURE_REACH)), vf_set(TEXTURE_REACH));
    if (wrap == BURNISH_WRAP_CLAMP) {
        return vf_min(vf_max(u, vf_set(0.0f)), vf_set(1.0f));
    }
    if (wrap == BURNISH_WRAP_MIRROR) {
        const vf half = vf_mul(u, vf_set(0.5f));
        const vf m = vf_mul(vf_sub(half, texture_floor(half)), vf_set(2.0f));
        return vf_min(m, vf_sub(vf_set(2.0f), m));
    }
    return vf_sub(u, texture_floor(u));
}

/* The two texels next to a coordinate on a side of `size`, and the share of the second. */
typedef struct texture_side {
    vi first, second;
    vf share;
} texture_side;

BURNISH_INLINE texture_side texture_find(vf u, vi size, int wrap) {
    const vi zero = vi_set(0), last = vi_sub(size, vi_set(1));
    const vf x = vf_sub(vf_mul(u, vf_from_int(size)), vf_set(0.5f));
    const vf below = texture_floor(x);
    texture_side side = {.share = vf_sub(x, below), .first = texture_integer(below)};
    side.second = vi_add(side.first, vi_set(1));
    if (wrap == BURNISH_WRAP_REPEAT) {
        side.first = vi_blend(vi_not_negative(side.first), side.first, last);
        side.second = vi_blend(vi_greater(side.second, last), zero, side.second);
    } else { /* next to the edge there is one texel */
        side.share = vf_and_mask(vi_not_negative(side.first), side.share);
        side.share = vf_and_mask(vi_greater(last, side.first), side.share);
    }
    side.first = vi_min(vi_max(side.first, zero), last);
    side.second = vi_min(vi_max(side.second, zero), last);
    return side;
}

/* The first 16 bits of each lane in memory, and the others. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define TEXTURE_FIRST(x) vi_shr(x, 16)
#define TEXTURE_OTHER(x) vi_and(x, vi_set(0xffff))
#else
#define TEXTURE_FIRST(x) vi_and(x, vi_set(0xffff))
#define TEXTURE_OTHER(x) vi_shr(x, 16)
#endif

BURNISH_INLINE vf texture_mix(vf a, vf b, vf share) {
    return vf_add(a, vf_mul(share, vf_sub(b, a)));
}

/* Base-2 logarithm of the longer of a pixel's two sides in texels of level 0, within the levels. */
BURNISH_INLINE vf texture_level(const burnish_texture_levels *levels, const vf change[4]) {
    const vf width = vf_set((float)levels->width[0]), height = vf_set((float)levels->height[0]);
    const vf ux = vf_mul(change[0], width), vx = vf_mul(change[1], height);
    const vf uy = vf_mul(change[2], width), vy = vf_mul(change[3], height);
    vf squared =
        vf_max(vf_add(vf_mul(ux, ux), vf_mul(vx, vx)), vf_add(vf_mul(uy, uy), vf_mul(vy, vy)));
    squared = vf_min(vf_max(squared, vf_set(1.0f)), vf_set(0x1p60f));
    const vf level = vf_mul(vector_log2(squared), vf_set(0.5f));
    return vf_min(vf_max(level, vf_set(0.0f)), vf_set((float)(levels->count - 1)));
}

/* The texels around (u, v) in each lane's level. nearest: where it holds, the nearest alone. */
BURNISH_INLINE void texture_find_taps(const burnish_texture_sampler *sampler, vf u, vf v, vi level,
                                      vm nearest, size_t i, burnish_texture_level_taps *taps) {
    const burnish_texture_levels *levels = sampler->levels;
    const vi width = vi_gather16(levels->width, level), height = vi_gather16(levels->height, level);
    const vi offset = vi_gather16(levels->offset, level), stride = vi_add(width, vi_set(1));
    texture_side x = texture_find(u, width, sampler->wrap[0]);
    texture_side y = texture_find(v, height, sampler->wrap[1]);
    if (sampler->is_nearest) {
        const vf half = vf_set(0.5f), one = vf_set(1.0f);
        x.share = vf_blend(nearest, vf_and_mask(vf_greater(x.share, half), one), x.share);
        y.share = vf_blend(nearest, vf_and_mask(vf_greater(y.share, half), one), y.share);
    }
    const vi left = vi_add(offset, x.first);
    vi_store(taps->upper + i, vi_add(left, vi_mul(y.first, stride)));
    vi_store(taps->lower + i, vi_add(left, vi_mul(y.second, stride)));
    vf_store(taps->x + i, x.share);
    vf_store(taps->y + i, y.share);
}

static void find_taps(const burnish_texture_sampler *sampler, const float *const *streams,
                      size_t count, burnish_texture_taps *taps) {
    const float *t = sampler->transform;
    const vf zero = vf_set(0.0f);
    for (size_t i = 0; i < count; i += LANES) {
        vf from[6], to[6];
        for (int k = 0; k < 6; ++k) {
            from[k] = vf_load(streams[k] + i);
        }
        for (int k = 0; k < 6; k += 2) {
            to[k] = vf_add(vf_mul(vf_set(t[0]), from[k]), vf_mul(vf_set(t[1]), from[k + 1]));
            to[k + 1] = vf_add(vf_mul(vf_set(t[3]), from[k]), vf_mul(vf_set(t[4]), from[k + 1]));
        }
        const vf u = texture_wrap(vf_add(to[0], vf_set(t[2])), sampler->wrap[0]);
        const vf v =
            texture_wrap(vf_sub(vf_set(1.0f), vf_add(to[1], vf_set(t[5]))), sampler->wrap[1]);
        const vf level = texture_level(sampler->levels, to + 2);
        const vm is_small = vf_greater(level, zero);
        const vf floor = vf_max(texture_floor(level), zero);
        const vi first = texture_integer(floor);
        texture_find_taps(sampler, u, v, first, vm_not(is_small), i, &taps->level[0]);
        vf_store(taps->share + i, vf_sub(level, floor));
        taps->has_second[i / LANES] = (uint8_t)vm_any(is_small);
        if (vm_any(is_small)) {
            const vi next =
                vi_min(vi_add(first, vi_set(1)), vi_set(BURNISH_TEXTURE_LEVELS_MAX - 1));
            texture_find_taps(sampler, u, v, next, vm_not(is_small), i, &taps->level[1]);
        }
    }
}

/* The mean of texels and their right neighbours, in units of 1 / BURNISH_TEXEL_ONE. */
BURNISH_INLINE void texture_row(const uint16_t *texels, const int32_t *indices, vf share,
                                vf out[4]) {
    const void *from[LANES];
    vf pairs[4];
    for (int lane = 0; lane < LANES; ++lane) {
        from[lane] = texels + 4 * (size_t)indices[lane];
    }
    vf_load_aos4(from, pairs);
    for (int k = 0; k < 2; ++k) {
        const vi left = vf_bits(pairs[k]), right = vf_bits(pairs[2 + k]);
        out[2 * k] =
            texture_mix(vf_from_int(TEXTURE_FIRST(left)), vf_from_int(TEXTURE_FIRST(right)), share);
        out[2 * k + 1] =
            texture_mix(vf_from_int(TEXTURE_OTHER(left)), vf_from_int(TEXTURE_OTHER(right)), share);
    }
}

BURNISH_INLINE void texture_bilinear(const uint16_t *texels, const burnish_texture_level_taps *taps,
                                     size_t i, vf out[4]) {
    const vf x = vf_load(taps->x + i), y = vf_load(taps->y + i);
    vf lower[4];
    texture_row(texels, taps->upper + i, x, out);
    texture_row(texels, taps->lower + i, x, lower);
    for (int k = 0; k < 4; ++k) {
        out[k] = texture_mix(out[k], lower[k], y);
    }
}

static void sample_texture(const burnish_texture_levels *levels, const burnish_texture_taps *taps,
                           size_t count, float *const out[4]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf texel[4];
        texture_bilinear(levels->texels, &taps->level[0], i, texel);
        if (taps->has_second[i / LANES]) {
            const vf share = vf_load(taps->share + i);
            vf second[4];
            texture_bilinear(levels->texels, &taps->level[1], i, second);
            for (int k = 0; k < 4; ++k) {
                texel[k] = texture_mix(texel[k], second[k], share);
            }
        }
        for (int k = 0; k < 4; ++k) {
            texel[k] = vf_mul(texel[k], vf_set(1.0f / (float)BURNISH_TEXEL_ONE));
        }
        if (levels->is_weighted) {
            const vm is_seen = vf_greater(texel[3], vf_set(0.0f));
            const vf alpha = vf_blend(is_seen, texel[3], vf_set(1.0f));
            for (int k = 0; k < 3; ++k) {
                texel[k] = vf_and_mask(is_seen, vf_div(texel[k], alpha));
            }
        }
        for (int k = 0; k < 4; ++k) {
            vf_store(out[k] + i, texel[k]);
        }
    }
}

/* ---- Normals ---- */

static void turn_normals(float strength, const float *const normal[3], const float *const *tangent,
                         const float *const sample[4], size_t count, float *const out[4]) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f);
    for (size_t i = 0; i < count; i += LANES) {
        vf n[3], t[3], b[3], turned[3];
        for (int k = 0; k < 3; ++k) {
            n[k] = vf_load(normal[k] + i);
            t[k] = vf_load(tangent[k] + i);
        }
        texture_normalize(n);
        const vf along = texture_dot(n, t);
        for (int k = 0; k < 3; ++k) {
            t[k] = vf_sub(t[k], vf_mul(n[k], along));
        }
        texture_normalize(t);
        const vf sign = vf_load(tangent[3] + i);
        for (int k = 0; k < 3; ++k) {
            const int j = (k + 1) % 3, l = (k + 2) % 3;
            b[k] = vf_mul(sign, vf_sub(vf_mul(n[j], t[l]), vf_mul(n[l], t[j])));
        }
        const vf x = vf_mul(vf_sub(vf_mul(vf_load(sample[0] + i), two), one), vf_set(strength));
        const vf y = vf_mul(vf_sub(vf_mul(vf_load(sample[1] + i), two), one), vf_set(strength));
        const vf z = vf_sub(vf_mul(vf_load(sample[2] + i), two), one);
        for (int k = 0; k < 3; ++k) {
            turned[k] = vf_add(vf_add(vf_mul(x, t[k]), vf_mul(y, b[k])), vf_mul(z, n[k]));
        }
        texture_normalize(turned);
        for (int k = 0; k < 3; ++k) {
            vf_store(out[k] + i, turned[k]);
        }
        const vf missing = vf_sub(one, vf_load(sample[3] + i));
        vf_store(out[3] + i, vf_max(vf_sub(one, vf_mul(missing, missing)), vf_set(0.0f)));
    }
}

#endif
