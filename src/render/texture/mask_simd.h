/* Coverage of the samples of pixels by masks, with SIMD.
 *
 * Where texels are larger than pixels each sample is there or not, by the texels around the point
 * as they are interpolated, followed to where the sample lies. Where they are smaller, alpha is
 * coverage (BURNISH_TEXTURE_MASKED), which samples take for their opacity: its sum over pixels is
 * the mask's area at any distance. Where levels 0 and 1 are mixed, a sample's opacity rises from 0
 * to 1 while alpha passes the cutoff by as much as level 1 counts. This is the sharpening
 * (alpha - cutoff) / width + 1/2 of alpha to coverage (B. Golus, "Anti-aliased alpha test: the
 * esoteric alpha to coverage", 2017), with the level's share for the width. */
#ifndef BURNISH_RENDER_TEXTURE_MASK_SIMD_H
#define BURNISH_RENDER_TEXTURE_MASK_SIMD_H

#include "raster/raster_view.h"
#include "render/texture/texture_simd.h"

/* How far beyond the texels around a point their interpolation is followed. */
#define MASK_REACH 0.5f

/* Texels of level 0 around points, and where they lie between them. */
typedef struct mask_patch {
    vf alpha[2][2];                  /* upper and lower, left and right */
    vf x, y;                         /* [0, 1] */
    vf x_right, x_up, y_right, y_up; /* changes per pixel */
    int is_nearest;                  /* 1: where share is 0 the nearest one counts alone */
    vm is_sharp;                     /* share, of level 1, is 0 */
} mask_patch;

BURNISH_INLINE void mask_row(texture_kind kind, const burnish_texture_levels *levels,
                             const int32_t *indices, vf alpha[2]) {
    const void *from[LANES];
    vf words[4];
    for (int lane = 0; lane < LANES; ++lane) {
        from[lane] = texture_memory(kind, levels, indices[lane]);
    }
    vf_load_aos4(from, words);
    texture_channel(kind, words, 3, &alpha[0], &alpha[1]);
    for (int k = 0; k < 2; ++k) {
        alpha[k] =
            vf_mul(alpha[k], vf_set(1.0f / (float)(kind.is_light ? BURNISH_TEXEL_ONE : 255)));
    }
}

/* Texels per unit of an own coordinate, as the wrap has it there: 0 where there is only one. */
BURNISH_INLINE vf mask_scale(vf own, int wrap, int size) {
    const vf zero = vf_set(0.0f), whole = vf_set((float)size), half = vf_set(0.5f);
    if (wrap == BURNISH_WRAP_REPEAT) {
        return whole;
    }
    const vf x = vf_sub(vf_mul(texture_wrap(own, wrap), whole), half);
    const vm is_between = vm_and_not(vf_greater(vf_set((float)(size - 1)), x), vf_greater(zero, x));
    vf scale = whole;
    if (wrap == BURNISH_WRAP_MIRROR) {
        const vf turn = vf_mul(own, half);
        const vm is_turned = vf_greater(vf_sub(turn, texture_floor(turn)), half);
        scale = vf_blend(is_turned, vf_sub(zero, whole), whole);
    }
    return vf_and_mask(is_between, scale);
}

BURNISH_INLINE mask_patch mask_find(texture_kind kind, const burnish_texture_sampler *sampler,
                                    const burnish_texture_taps *taps, const float *const *streams,
                                    size_t i) {
    const burnish_texture_levels *levels = sampler->levels;
    mask_patch patch;
    vf at[6];
    texture_transform(sampler, streams, i, at);
    const vf down = vf_sub(vf_set(1.0f), at[1]), zero = vf_set(0.0f);
    const vf width = mask_scale(at[0], sampler->wrap[0], levels->width[0]);
    const vf height = vf_sub(zero, mask_scale(down, sampler->wrap[1], levels->height[0]));
    mask_row(kind, levels, taps->level[0].upper + i, patch.alpha[0]);
    mask_row(kind, levels, taps->level[0].lower + i, patch.alpha[1]);
    if (sampler->is_nearest) { /* taps have 0 or 1 there */
        const vf u = texture_wrap(at[0], sampler->wrap[0]);
        const vf v = texture_wrap(down, sampler->wrap[1]);
        patch.x = texture_find(u, vi_set(levels->width[0]), sampler->wrap[0]).share;
        patch.y = texture_find(v, vi_set(levels->height[0]), sampler->wrap[1]).share;
    } else {
        patch.x = vf_load(taps->level[0].x + i);
        patch.y = vf_load(taps->level[0].y + i);
    }
    patch.is_sharp = vm_not(vf_greater(vf_load(taps->share + i), zero));
    patch.x_right = vf_mul(at[2], width);
    patch.x_up = vf_mul(at[4], width);
    patch.y_right = vf_mul(at[3], height);
    patch.y_up = vf_mul(at[5], height);
    patch.is_nearest = sampler->is_nearest;
    return patch;
}

BURNISH_INLINE vf mask_interpolate(const mask_patch *patch, vf x, vf y) {
    if (patch->is_nearest) {
        const vf zero = vf_set(0.0f), one = vf_set(1.0f), half = vf_set(0.5f);
        x = vf_blend(patch->is_sharp, vf_blend(vf_greater(x, half), one, zero), x);
        y = vf_blend(patch->is_sharp, vf_blend(vf_greater(y, half), one, zero), y);
    }
    const vf upper = texture_mix(patch->alpha[0][0], patch->alpha[0][1], x);
    const vf lower = texture_mix(patch->alpha[1][0], patch->alpha[1][1], x);
    return texture_mix(upper, lower, y);
}

BURNISH_INLINE vf mask_clamp(vf x, float low, float high) {
    return vf_min(vf_max(x, vf_set(low)), vf_set(high));
}

/* What the kernel was called with. */
typedef struct mask_call {
    const burnish_texture_sampler *sampler;
    const burnish_mask *mask;
    const burnish_texture_taps *taps;
    const float *const *streams;
    size_t count;
    const float *alpha;
    float (*cover)[BURNISH_TEXTURE_BATCH];
} mask_call;

/* A vector of points, some of which are in level 0. */
BURNISH_INLINE void mask_vector(texture_kind kind, const mask_call *call, vm is_level0, size_t i) {
    const burnish_mask *mask = call->mask;
    const float *const *streams = call->streams;
    const vf share = vf_load(call->taps->share + i), alpha = vf_load(call->alpha + i);
    const float step = 1.0f / BURNISH_SUBPIXELS * BURNISH_SAMPLE_STEP / mask->spread;
    const vf inverse_spread = vf_set(1.0f / mask->spread);
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), half = vf_set(0.5f);
    const mask_patch patch = mask_find(kind, call->sampler, call->taps, streams, i);
    const vf here = mask_interpolate(&patch, patch.x, patch.y);
    const vf edge = vf_add(vf_set(mask->alpha), vf_mul(share, vf_sub(half, vf_set(mask->alpha))));
    const vf inverse = vf_div(one, vf_blend(patch.is_sharp, one, share));
    const vf rest = vf_sub(one, share);
    const vf left = vf_mul(vf_load(streams[BURNISH_TEXTURE_SHIFT_X] + i), inverse_spread);
    const vf below = vf_mul(vf_load(streams[BURNISH_TEXTURE_SHIFT_Y] + i), inverse_spread);
    for (int s = 0; s < mask->samples; ++s) {
        const vf right = vf_sub(vf_set(step * (float)mask->offsets[s][0]), left);
        const vf up = vf_sub(vf_set(-step * (float)mask->offsets[s][1]), below);
        vf x = vf_add(patch.x, vf_add(vf_mul(right, patch.x_right), vf_mul(up, patch.x_up)));
        vf y = vf_add(patch.y, vf_add(vf_mul(right, patch.y_right), vf_mul(up, patch.y_up)));
        x = mask_clamp(x, -MASK_REACH, 1 + MASK_REACH);
        y = mask_clamp(y, -MASK_REACH, 1 + MASK_REACH);
        const vf change = vf_mul(rest, vf_sub(mask_interpolate(&patch, x, y), here));
        const vf moved = vf_add(alpha, change);
        const vf slope = vf_mul(vf_sub(moved, edge), inverse);
        const vf soft = mask_clamp(vf_add(slope, half), 0, 1);
        const vm is_out = vf_greater(vf_set(mask->cutoff), vf_mul(vf_set(mask->solid), moved));
        const vf sharp = vf_blend(is_out, zero, one);
        const vf near = vf_blend(patch.is_sharp, sharp, soft);
        vf_store(call->cover[s] + i, vf_blend(is_level0, near, alpha));
    }
}

BURNISH_INLINE void mask_points(texture_kind kind, const mask_call *call) {
    const burnish_texture_levels *levels = call->sampler->levels;
    const vi end = vi_set(levels->count > 1 ? levels->offset[1] : INT32_MAX);
    for (size_t i = 0; i < call->count; i += LANES) {
        const vm is_level0 = vi_greater(end, vi_load(call->taps->level[0].upper + i));
        if (vm_any(is_level0)) {
            mask_vector(kind, call, is_level0, i);
            continue;
        }
        for (int s = 0; s < call->mask->samples; ++s) {
            vf_store(call->cover[s] + i, vf_load(call->alpha + i));
        }
    }
}

static void cover_samples(const burnish_texture_sampler *sampler, const burnish_mask *mask,
                          const burnish_texture_taps *taps, const float *const *streams,
                          size_t count, const float *alpha, float (*cover)[BURNISH_TEXTURE_BATCH]) {
    const mask_call call = {sampler, mask, taps, streams, count, alpha, cover};
    if (sampler->levels->texels) {
        mask_points((texture_kind){1, 8}, &call);
    } else {
        mask_points((texture_kind){0, 8}, &call);
    }
}

#endif
