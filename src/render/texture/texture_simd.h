/* Sampling textures over vectors of points. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_SIMD_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_SIMD_H

#include <string.h>

#include "render/texture/texture.h"
#include "simd/vector_math.h"

/* Adding it to a float of magnitude below 2^22 leaves a whole number: 1.5 * 2^23. */
#define TEXTURE_ROUNDER 12582912.0f

/* Points whose texels are prefetched. */
#define TEXTURE_AHEAD 32

/* Coordinates beyond it have no bits left for texels. */
#define TEXTURE_REACH 0x1p20f

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

/* The first of the two texels next to a coordinate on a side of `size`, and the share of the
 * second, which is next to it in memory. u: from texture_wrap. */
typedef struct texture_side {
    vi first;
    vf share;
} texture_side;

BURNISH_INLINE texture_side texture_find(vf u, vi size, int wrap) {
    const vi zero = vi_set(0), last = vi_sub(size, vi_set(1));
    const vf x = vf_sub(vf_mul(u, vf_from_int(size)), vf_set(0.5f));
    const vf below = texture_floor(x);
    texture_side side = {.share = vf_sub(x, below), .first = texture_integer(below)};
    const vm is_inside = vi_not_negative(side.first);
    if (wrap == BURNISH_WRAP_REPEAT) {
        side.first = vi_blend(is_inside, side.first, last);
    } else { /* next to the edge there is one texel */
        side.share = vf_and_mask(is_inside, side.share);
        side.share = vf_and_mask(vi_greater(last, side.first), side.share);
        side.first = vi_max(side.first, zero);
    }
    return side;
}

/* Channel k of texels in their first lane words: of 8 bits, or k and k + 1 of 16. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define TEXTURE_SHIFT(bits, k) (32 - (bits) * ((k) + 1))
#else
#define TEXTURE_SHIFT(bits, k) ((bits) * (k))
#endif
#define TEXTURE_PART(x, bits, k)                                                                   \
    vf_from_int(vi_and(vi_shr(x, TEXTURE_SHIFT(bits, k)), vi_set((1 << (bits)) - 1)))

BURNISH_INLINE vf texture_mix(vf a, vf b, vf share) {
    return vf_add(a, vf_mul(share, vf_sub(b, a)));
}

/* A level, 0 the largest, and the share of the next one. */
typedef struct texture_level {
    vi first;
    vf share;
    vm is_small; /* texels are smaller than pixels */
} texture_level;

/* Half the base-2 logarithm of a square in [1, 4^k], exact for powers of 4: 4^e (1 + f) and
 * 2 * 4^e (1 + f), where log2(1 + f) is f + f (1 - f) Q(f), Q by Remez exchange to 1.6e-5. */
BURNISH_INLINE texture_level texture_half_log2(vf squared) {
    const vi exponent = vi_sub(vi_shr(vf_bits(squared), 23), vi_set(127));
    const vi mantissa = vi_or(vi_and(vf_bits(squared), vi_set(0x7fffff)), vi_set(0x3f800000));
    const vf one = vf_set(1.0f), half = vf_set(0.5f);
    const vf f = vf_sub(vf_from_bits(mantissa), one);
    vf q = vf_set(-0.045149014747f);
    q = vf_add(vf_mul(q, f), vf_set(0.148426602971f));
    q = vf_sub(vf_mul(q, f), vf_set(0.267179385633f));
    q = vf_add(vf_mul(q, f), vf_set(0.441917036809f));
    const vf fraction = vf_add(f, vf_mul(vf_mul(f, vf_sub(one, f)), q));
    const vf odd = vf_from_int(vi_and(exponent, vi_set(1)));
    return (texture_level){.first = vi_shr(exponent, 1),
                           .share = vf_mul(vf_add(odd, fraction), half),
                           .is_small = vf_greater(squared, one)};
}

/* By the longer of a pixel's two sides in texels of level 0. */
BURNISH_INLINE texture_level texture_level_of(const burnish_texture_levels *levels,
                                              const vf change[4]) {
    const vf width = vf_set((float)levels->width[0]), height = vf_set((float)levels->height[0]);
    const vf most = vf_from_bits(vi_set((127 + 2 * (levels->count - 1)) << 23));
    const vf ux = vf_mul(change[0], width), vx = vf_mul(change[1], height);
    const vf uy = vf_mul(change[2], width), vy = vf_mul(change[3], height);
    const vf squared =
        vf_max(vf_add(vf_mul(ux, ux), vf_mul(vx, vx)), vf_add(vf_mul(uy, uy), vf_mul(vy, vy)));
    return texture_half_log2(vf_min(vf_max(squared, vf_set(1.0f)), most));
}

/* Texels of level 0 from the first to the last one: column, row. */
typedef struct texture_box {
    vi first[2], last[2];
} texture_box;

BURNISH_INLINE void texture_add_to_box(texture_box *box, vm is_inside, int k, vi first) {
    const vi last = vi_add(first, vi_set(1));
    box->first[k] = vi_min(box->first[k], vi_blend(is_inside, first, vi_set(INT32_MAX)));
    box->last[k] = vi_max(box->last[k], vi_blend(is_inside, last, vi_set(-1)));
}

/* The texels around u, v in each lane's level. nearest: where it holds, the nearest alone.
 *   box  grows by those of level 0; may be NULL */
BURNISH_INLINE void texture_find_taps(const burnish_texture_sampler *sampler, const vf uv[2],
                                      vi level, vm nearest, size_t i,
                                      burnish_texture_level_taps *taps, texture_box *box) {
    const burnish_texture_levels *levels = sampler->levels;
    const vi width = vi_gather16(levels->width, level), height = vi_gather16(levels->height, level);
    const vi offset = vi_gather16(levels->offset, level), stride = vi_add(width, vi_set(1));
    texture_side x = texture_find(uv[0], width, sampler->wrap[0]);
    texture_side y = texture_find(uv[1], height, sampler->wrap[1]);
    if (sampler->is_nearest) {
        const vf half = vf_set(0.5f), one = vf_set(1.0f);
        x.share = vf_blend(nearest, vf_and_mask(vf_greater(x.share, half), one), x.share);
        y.share = vf_blend(nearest, vf_and_mask(vf_greater(y.share, half), one), y.share);
    }
    const vi upper = vi_add(vi_add(offset, x.first), vi_mul(y.first, stride));
    vi_store(taps->upper + i, upper);
    vi_store(taps->lower + i, vi_add(upper, stride));
    vf_store(taps->x + i, x.share);
    vf_store(taps->y + i, y.share);
    if (box) {
        const vm is_inside = vi_greater(vi_set(1), level);
        texture_add_to_box(box, is_inside, 0, x.first);
        texture_add_to_box(box, is_inside, 1, y.first);
    }
}

/* A texture's own coordinates and their changes. */
BURNISH_INLINE void texture_transform(const burnish_texture_sampler *sampler,
                                      const float *const *streams, size_t i, vf to[6]) {
    const float *t = sampler->transform;
    vf from[6];
    for (int k = 0; k < 6; ++k) {
        to[k] = from[k] = vf_load(streams[k] + i);
    }
    if (sampler->has_transform) {
        for (int k = 0; k < 6; k += 2) {
            to[k] = vf_add(vf_mul(vf_set(t[0]), from[k]), vf_mul(vf_set(t[1]), from[k + 1]));
            to[k + 1] = vf_add(vf_mul(vf_set(t[3]), from[k]), vf_mul(vf_set(t[4]), from[k + 1]));
        }
        to[0] = vf_add(to[0], vf_set(t[2]));
        to[1] = vf_add(to[1], vf_set(t[5]));
    }
}

static void find_taps(const burnish_texture_sampler *sampler, const float *const *streams,
                      size_t count, burnish_texture_taps *taps) {
    const vi most = vi_set(INT32_MAX), none = vi_set(-1);
    texture_box box = {{most, most}, {none, none}};
    for (size_t i = 0; i < count; i += LANES) {
        vf at[6];
        texture_transform(sampler, streams, i, at);
        const vf uv[2] = {texture_wrap(at[0], sampler->wrap[0]),
                          texture_wrap(vf_sub(vf_set(1.0f), at[1]), sampler->wrap[1])};
        const texture_level level = texture_level_of(sampler->levels, at + 2);
        const vm nearest = vm_not(level.is_small);
        texture_find_taps(sampler, uv, level.first, nearest, i, &taps->level[0], &box);
        const int has_second = !sampler->is_single && vm_any(level.is_small);
        vf_store(taps->share + i, sampler->is_single ? vf_set(0.0f) : level.share);
        taps->has_second[i / LANES] = (uint8_t)has_second;
        if (has_second) {
            const vi next =
                vi_min(vi_add(level.first, vi_set(1)), vi_set(BURNISH_TEXTURE_LEVELS_MAX - 1));
            texture_find_taps(sampler, uv, next, nearest, i, &taps->level[1], NULL);
        }
    }
    for (int k = 0; k < 2; ++k) {
        int32_t first[LANES], last[LANES];
        vi_store(first, box.first[k]);
        vi_store(last, box.last[k]);
        taps->box.first[k] = INT32_MAX;
        taps->box.last[k] = -1;
        for (int lane = 0; lane < LANES; ++lane) {
            taps->box.first[k] =
                first[lane] < taps->box.first[k] ? first[lane] : taps->box.first[k];
            taps->box.last[k] = last[lane] > taps->box.last[k] ? last[lane] : taps->box.last[k];
        }
    }
}

/* A kind of texels: light, 8 bytes each, or codes of 4; and the channels of them that are wanted,
 * bit k for channel k. All is known when the kernel is compiled. */
typedef struct texture_kind {
    int is_light;
    unsigned channels;
} texture_kind;

BURNISH_INLINE const uint8_t *texture_memory(texture_kind kind,
                                             const burnish_texture_levels *levels, int32_t index) {
    return kind.is_light ? (const uint8_t *)(levels->texels + 4 * (size_t)(uint32_t)index)
                         : levels->codes + 4 * (size_t)(uint32_t)index;
}

/* Channel k of texels and of their right neighbours: four words of each lane's memory. */
BURNISH_INLINE void texture_channel(texture_kind kind, const vf words[4], int k, vf *left,
                                    vf *right) {
    const vi first = vf_bits(words[kind.is_light ? k / 2 : 0]);
    const vi second = vf_bits(words[kind.is_light ? 2 + k / 2 : 1]);
    if (kind.is_light) {
        *left = k % 2 ? TEXTURE_PART(first, 16, 1) : TEXTURE_PART(first, 16, 0);
        *right = k % 2 ? TEXTURE_PART(second, 16, 1) : TEXTURE_PART(second, 16, 0);
    } else if (k < 2) {
        *left = k ? TEXTURE_PART(first, 8, 1) : TEXTURE_PART(first, 8, 0);
        *right = k ? TEXTURE_PART(second, 8, 1) : TEXTURE_PART(second, 8, 0);
    } else {
        *left = k == 3 ? TEXTURE_PART(first, 8, 3) : TEXTURE_PART(first, 8, 2);
        *right = k == 3 ? TEXTURE_PART(second, 8, 3) : TEXTURE_PART(second, 8, 2);
    }
}

/* The mean of texels and their right neighbours, in their own units. */
BURNISH_INLINE void texture_row(texture_kind kind, const burnish_texture_levels *levels,
                                const int32_t *indices, vf share, vf out[4]) {
    const void *from[LANES];
    vf words[4];
    for (int lane = 0; lane < LANES; ++lane) {
        from[lane] = texture_memory(kind, levels, indices[lane]);
    }
    vf_load_aos4(from, words);
    for (int k = 0; k < 4; ++k) {
        vf left, right;
        if (kind.channels >> k & 1) {
            texture_channel(kind, words, k, &left, &right);
            out[k] = texture_mix(left, right, share);
        }
    }
}

BURNISH_INLINE void texture_mix_channels(texture_kind kind, vf to[4], const vf with[4], vf share) {
    for (int k = 0; k < 4; ++k) {
        if (kind.channels >> k & 1) {
            to[k] = texture_mix(to[k], with[k], share);
        }
    }
}

BURNISH_INLINE void texture_bilinear(texture_kind kind, const burnish_texture_levels *levels,
                                     const burnish_texture_level_taps *taps, size_t i, vf out[4]) {
    const vf x = vf_load(taps->x + i);
    vf lower[4];
    texture_row(kind, levels, taps->upper + i, x, out);
    texture_row(kind, levels, taps->lower + i, x, lower);
    texture_mix_channels(kind, out, lower, vf_load(taps->y + i));
}

/* Asks for the texels of a vector of points: of some lanes, whose cache lines hold most others'. */
BURNISH_INLINE void texture_prefetch(texture_kind kind, const burnish_texture_levels *levels,
                                     const burnish_texture_taps *taps, size_t i) {
    for (size_t lane = i; lane < i + LANES; lane += 3) {
        for (int k = 0; k < (taps->has_second[i / LANES] ? 2 : 1); ++k) {
            __builtin_prefetch(texture_memory(kind, levels, taps->level[k].upper[lane]));
            __builtin_prefetch(texture_memory(kind, levels, taps->level[k].lower[lane]));
        }
    }
}

/* Colours as if they had not been multiplied by alpha. */
BURNISH_INLINE void texture_divide_alpha(vf texel[4]) {
    const vm is_seen = vf_greater(texel[3], vf_set(0.0f));
    const vf alpha = vf_blend(is_seen, texel[3], vf_set(1.0f));
    for (int k = 0; k < 3; ++k) {
        texel[k] = vf_and_mask(is_seen, vf_div(texel[k], alpha));
    }
}

BURNISH_INLINE void texture_sample(texture_kind kind, const burnish_texture_levels *levels,
                                   const burnish_texture_taps *taps, size_t count,
                                   float *const out[4]) {
    const vf unit = vf_set(1.0f / (float)(kind.is_light ? BURNISH_TEXEL_ONE : 255));
    for (size_t i = 0; i < count; i += LANES) {
        vf texel[4];
        if (i + TEXTURE_AHEAD < count) {
            texture_prefetch(kind, levels, taps, i + TEXTURE_AHEAD);
        }
        texture_bilinear(kind, levels, &taps->level[0], i, texel);
        if (taps->has_second[i / LANES]) {
            vf second[4];
            texture_bilinear(kind, levels, &taps->level[1], i, second);
            texture_mix_channels(kind, texel, second, vf_load(taps->share + i));
        }
        for (int k = 0; k < 4; ++k) {
            if (kind.channels >> k & 1) {
                texel[k] = vf_mul(texel[k], unit);
            }
        }
        if (kind.channels == 15 && levels->is_weighted) {
            texture_divide_alpha(texel);
        }
        for (int k = 0; k < 4; ++k) {
            if (kind.channels >> k & 1) {
                vf_store(out[k] + i, texel[k]);
            }
        }
    }
}

static void sample_texture(const burnish_texture_levels *levels, const burnish_texture_taps *taps,
                           unsigned channels, size_t count, float *const out[4]) {
    if (levels->texels) {
        if (channels == 7) {
            texture_sample((texture_kind){1, 7}, levels, taps, count, out);
        } else if (channels == 8) {
            texture_sample((texture_kind){1, 8}, levels, taps, count, out);
        } else {
            texture_sample((texture_kind){1, 15}, levels, taps, count, out);
        }
    } else if (channels == 1) {
        texture_sample((texture_kind){0, 1}, levels, taps, count, out);
    } else if (channels == 6) {
        texture_sample((texture_kind){0, 6}, levels, taps, count, out);
    } else {
        texture_sample((texture_kind){0, 15}, levels, taps, count, out);
    }
}

#endif
