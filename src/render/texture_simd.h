/* Sampling textures, and turning normals by them, over vectors of points. */
#ifndef BURNISH_RENDER_TEXTURE_SIMD_H
#define BURNISH_RENDER_TEXTURE_SIMD_H

#include "render/texture.h"
#include "simd/vector_math.h"

/* Adding it to a float of magnitude below 2^22 leaves a whole number: 1.5 * 2^23. */
#define TEXTURE_ROUNDER 12582912.0f

/* Coordinates beyond it have no bits left for texels. */
#define TEXTURE_REACH 0x1p20f

/* The channels of a texel, whose bytes are r, g, b, a in memory. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
enum { TEXEL_R = 24, TEXEL_G = 16, TEXEL_B = 8, TEXEL_A = 0 };
#else
enum { TEXEL_R = 0, TEXEL_G = 8, TEXEL_B = 16, TEXEL_A = 24 };
#endif

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

static void locate_points(const burnish_rays *rays, const burnish_screen_points *points,
                          const float *const *triangles, size_t count, float *const *streams,
                          float *const weights[2]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf s[3], e1[3], e2[3];
        for (int k = 0; k < 3; ++k) {
            s[k] = vf_sub(vf_set(0.0f), vf_load(triangles[BURNISH_CORNER_P + k] + i));
            e1[k] = vf_load(triangles[BURNISH_CORNER_E1 + k] + i);
            e2[k] = vf_load(triangles[BURNISH_CORNER_E2 + k] + i);
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
            const vf along1 = vf_load(triangles[BURNISH_CORNER_UV1 + k] + i);
            const vf along2 = vf_load(triangles[BURNISH_CORNER_UV2 + k] + i);
            const vf from = vf_load(triangles[BURNISH_CORNER_UV + k] + i);
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
    }
    side.first = vi_min(vi_max(side.first, zero), last);
    side.second = vi_min(vi_max(side.second, zero), last);
    return side;
}

/* A texel's channels, by what codes mean; colours times alpha where they are weighted. */
BURNISH_INLINE void texture_fetch(const burnish_texture_sampler *sampler, vi index, vf out[4]) {
    const vi word = vi_gather(sampler->levels->texels, index), mask = vi_set(255);
    out[0] = vf_gather(sampler->codes, vi_and(vi_shr(word, TEXEL_R), mask));
    out[1] = vf_gather(sampler->codes, vi_and(vi_shr(word, TEXEL_G), mask));
    out[2] = vf_gather(sampler->codes, vi_and(vi_shr(word, TEXEL_B), mask));
    out[3] = vf_mul(vf_from_int(vi_and(vi_shr(word, TEXEL_A), mask)), vf_set(1.0f / 255));
    if (sampler->is_weighted) {
        for (int k = 0; k < 3; ++k) {
            out[k] = vf_mul(out[k], out[3]);
        }
    }
}

BURNISH_INLINE vf texture_mix(vf a, vf b, vf share) {
    return vf_add(a, vf_mul(share, vf_sub(b, a)));
}

/* The texels around (u, v) in each lane's level. nearest: where it holds, the nearest alone. */
BURNISH_INLINE void texture_bilinear(const burnish_texture_sampler *sampler, vf u, vf v, vi level,
                                     vm nearest, vf out[4]) {
    const burnish_texture_levels *levels = sampler->levels;
    const vi width = vi_gather(levels->width, level), height = vi_gather(levels->height, level);
    const vi offset = vi_gather(levels->offset, level);
    texture_side x = texture_find(u, width, sampler->wrap[0]);
    texture_side y = texture_find(v, height, sampler->wrap[1]);
    if (sampler->is_nearest) {
        const vf half = vf_set(0.5f), one = vf_set(1.0f);
        x.share = vf_blend(nearest, vf_and_mask(vf_greater(x.share, half), one), x.share);
        y.share = vf_blend(nearest, vf_and_mask(vf_greater(y.share, half), one), y.share);
    }
    const vi top = vi_add(offset, vi_mul(y.first, width));
    const vi bottom = vi_add(offset, vi_mul(y.second, width));
    vf a[4], b[4], c[4], d[4];
    texture_fetch(sampler, vi_add(top, x.first), a);
    texture_fetch(sampler, vi_add(top, x.second), b);
    texture_fetch(sampler, vi_add(bottom, x.first), c);
    texture_fetch(sampler, vi_add(bottom, x.second), d);
    for (int k = 0; k < 4; ++k) {
        out[k] = texture_mix(texture_mix(a[k], b[k], x.share), texture_mix(c[k], d[k], x.share),
                             y.share);
    }
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

BURNISH_INLINE void texture_vector(const burnish_texture_sampler *sampler,
                                   const float *const *streams, size_t i, vf out[4]) {
    const float *t = sampler->transform;
    const vf zero = vf_set(0.0f);
    vf from[6], to[6];
    for (int k = 0; k < 6; ++k) {
        from[k] = vf_load(streams[k] + i);
    }
    for (int k = 0; k < 6; k += 2) {
        to[k] = vf_add(vf_mul(vf_set(t[0]), from[k]), vf_mul(vf_set(t[1]), from[k + 1]));
        to[k + 1] = vf_add(vf_mul(vf_set(t[3]), from[k]), vf_mul(vf_set(t[4]), from[k + 1]));
    }
    const vf u = texture_wrap(vf_add(to[0], vf_set(t[2])), sampler->wrap[0]);
    const vf v = texture_wrap(vf_sub(vf_set(1.0f), vf_add(to[1], vf_set(t[5]))), sampler->wrap[1]);
    const vf level = texture_level(sampler->levels, to + 2);
    const vm is_small = vf_greater(level, zero);
    const vf floor = vf_max(texture_floor(level), zero);
    const vf share = vf_sub(level, floor);
    const vi first = texture_integer(floor);
    texture_bilinear(sampler, u, v, first, vm_not(is_small), out);
    if (vm_any(is_small)) {
        vf second[4];
        const vi next = vi_min(vi_add(first, vi_set(1)), vi_set(BURNISH_TEXTURE_LEVELS_MAX - 1));
        texture_bilinear(sampler, u, v, next, vm_not(is_small), second);
        for (int k = 0; k < 4; ++k) {
            out[k] = vf_blend(is_small, texture_mix(out[k], second[k], share), out[k]);
        }
    }
    if (sampler->is_weighted) {
        const vm is_seen = vf_greater(out[3], zero);
        const vf alpha = vf_blend(is_seen, out[3], vf_set(1.0f));
        for (int k = 0; k < 3; ++k) {
            out[k] = vf_and_mask(is_seen, vf_div(out[k], alpha));
        }
    }
}

static void sample_texture(const burnish_texture_sampler *sampler, const float *const *streams,
                           size_t count, float *const out[4]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf texel[4];
        texture_vector(sampler, streams, i, texel);
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
