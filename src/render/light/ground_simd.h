/* The ground's shadow at points of the screen. */
#ifndef BURNISH_RENDER_LIGHT_GROUND_SIMD_H
#define BURNISH_RENDER_LIGHT_GROUND_SIMD_H

#include "render/light/ground.h"
#include "render/light/maps/depth_map_simd.h"

BURNISH_INLINE vf ground_row(const float row[3], vf x, vf y) {
    const vf sum = vf_add(vf_set(row[0]), vf_mul(vf_set(row[1]), x));
    return vf_add(sum, vf_mul(vf_set(row[2]), y));
}

/* Four texels of a silhouette: the part of them that shows the mesh, bilinear, and the nearest
 * depth. */
typedef struct silhouette_texels {
    vf covered, depth;
} silhouette_texels;

BURNISH_INLINE vf shown_of(vi texel) {
    return vf_min(vf_from_int(texel), vf_set(1.0f));
}

BURNISH_INLINE silhouette_texels silhouette_at(const burnish_silhouette *silhouette, vf x, vf y) {
    const vf x0 = texel_before(x, silhouette->size), y0 = texel_before(y, silhouette->size);
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf u = vf_min(vf_max(vf_sub(x, x0), zero), one);
    const vf v = vf_min(vf_max(vf_sub(y, y0), zero), one);
    const vi index = texel_index(x0, y0, silhouette->size), low = vi_set(0xffff);
    const vi upper = vi_gather_pair(silhouette->depths, index);
    const vi lower = vi_gather_pair(silhouette->depths + silhouette->size, index);
    const vi texels[4] = {vi_and(upper, low), vi_shr(upper, 16), vi_and(lower, low),
                          vi_shr(lower, 16)};
    const vf left = shown_of(texels[0]), left_below = shown_of(texels[2]);
    const vf above = vf_add(left, vf_mul(vf_sub(shown_of(texels[1]), left), u));
    const vf below = vf_add(left_below, vf_mul(vf_sub(shown_of(texels[3]), left_below), u));
    const vi nearest = vi_max(vi_max(texels[0], texels[1]), vi_max(texels[2], texels[3]));
    return (silhouette_texels){vf_add(above, vf_mul(vf_sub(below, above), v)),
                               vf_from_int(nearest)};
}

/* Half the width of layer k's tent, about: 0, 2, 4, 8 ... texels. */
#define LAYER_WIDTH(k) ((k) > 0 ? (float)(1 << (k)) : 0.0f)

/* Narrows a range of texels [0] to [1] of a row to those where a map's coordinate, start + step x,
 * is between 0 and `last`, and one more. */
static void narrow(float start, float step, float last, float range[2]) {
    if (step != 0) {
        const float a = -start / step, b = (last - start) / step;
        const float first = (a < b ? a : b) - 1, end = (a < b ? b : a) + 1;
        range[0] = first > range[0] ? first : range[0];
        range[1] = end < range[1] ? end : range[1];
    }
}

static void add_silhouette(const burnish_silhouette *silhouette, float row, size_t count,
                           float *const *layers) {
    const vf y = vf_set(row), zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf last = vf_set((float)(silhouette->size - 1));
    const float *column_row = silhouette->column, *row_row = silhouette->row;
    float range[2] = {0, (float)count};
    narrow(column_row[0] + column_row[2] * row, column_row[1], (float)(silhouette->size - 1),
           range);
    narrow(row_row[0] + row_row[2] * row, row_row[1], (float)(silhouette->size - 1), range);
    if (!(range[0] < range[1])) {
        return;
    }
    for (size_t i = (size_t)range[0] / LANES * LANES; (float)i < range[1]; i += LANES) {
        const vf x = vf_from_int(vi_add(vi_ramp(1), vi_set((int32_t)i)));
        const vf column = ground_row(silhouette->column, x, y);
        const vf map_row = ground_row(silhouette->row, x, y);
        vm inside = vm_and(vf_greater(column, zero), vf_greater(last, column));
        inside = vm_and(inside, vm_and(vf_greater(map_row, zero), vf_greater(last, map_row)));
        if (!vm_any(inside)) { /* the map's border is empty */
            continue;
        }
        const silhouette_texels at = silhouette_at(silhouette, column, map_row);
        if (!vm_any(vf_greater(at.covered, zero))) {
            continue;
        }
        const vf weight = vf_mul(at.covered, vf_set(silhouette->weight));
        const vf distance = vf_max(vf_sub(ground_row(silhouette->depth, x, y), at.depth), zero);
        const vf width = vf_min(vf_mul(distance, vf_set(silhouette->spread)),
                                vf_set(LAYER_WIDTH(BURNISH_GROUND_LAYERS - 1)));
        vf rest = one; /* what wider layers get: each takes what is left of its wider neighbour */
        for (int k = 0; k < BURNISH_GROUND_LAYERS; ++k) {
            const float step = LAYER_WIDTH(k + 1) - LAYER_WIDTH(k);
            const vf wider = vf_min(
                vf_max(vf_mul(vf_sub(width, vf_set(LAYER_WIDTH(k))), vf_set(1.0f / step)), zero),
                one);
            const vf part = vf_sub(rest, wider);
            if (vm_any(vf_greater(part, zero))) {
                vf_store(layers[k] + i, vf_add(vf_load(layers[k] + i), vf_mul(weight, part)));
            }
            rest = wider;
        }
    }
}

/* The mean of 2 radius + 1 numbers around each of `count`; beyond the ends are zeros. A column of
 * vectors, each `stride` after the one before. */
BURNISH_INLINE void blur_column(const float *from, size_t stride, size_t count, size_t radius,
                                float *to, size_t to_stride) {
    const vf part = vf_set(1.0f / (float)(2 * radius + 1));
    vf sum = vf_set(0.0f);
    for (size_t i = 0; i < radius; ++i) {
        sum = vf_add(sum, vf_load(from + i * stride));
    }
    for (size_t i = 0; i < count; ++i) {
        if (i + radius < count) {
            sum = vf_add(sum, vf_load(from + (i + radius) * stride));
        }
        if (i > radius) {
            sum = vf_sub(sum, vf_load(from + (i - radius - 1) * stride));
        }
        vf_store(to + i * to_stride, vf_mul(sum, part));
    }
}

static void blur_columns(float *texels, size_t edge, int radius, float *scratch) {
    for (size_t i = 0; i < 16; i += LANES) { /* twice: a tent */
        blur_column(texels + i, edge, edge, (size_t)radius, scratch + i, 16);
        blur_column(scratch + i, 16, edge, (size_t)radius, texels + i, edge);
    }
}

BURNISH_INLINE vf smooth_step(vf x) {
    const vf t = vector_saturate(x);
    return vf_mul(vf_mul(t, t), vf_sub(vf_set(3.0f), vf_add(t, t)));
}

/* From this share of the texture's reach on the shadow fades. */
#define GROUND_FADE 0.6f

/* 1 in the middle, 0 from the circle in the square of the texture on, smooth. */
BURNISH_INLINE vf texture_fade(vf x, vf y, size_t edge) {
    const float middle = 0.5f * (float)(edge - 1), radius = middle - 1;
    const vf u = vf_sub(x, vf_set(middle)), v = vf_sub(y, vf_set(middle));
    const vf squared = vf_add(vf_mul(u, u), vf_mul(v, v));
    const vf inside = vf_sub(vf_set(1.0f), vf_mul(squared, vf_set(1.0f / (radius * radius))));
    return smooth_step(vf_mul(inside, vf_set(1 / (1 - GROUND_FADE * GROUND_FADE))));
}

static void darken_ground(const float *layers, size_t edge, int layer_count, float strength,
                          float row, uint16_t *texels) {
    const vf y = vf_set(row), rounder = vf_set(BURNISH_ROUNDER);
    for (size_t i = 0; i < edge; i += LANES) {
        const vf x = vf_from_int(vi_add(vi_ramp(1), vi_set((int32_t)i)));
        int32_t codes[LANES];
        vf hidden = vf_set(0.0f);
        for (int k = 0; k < layer_count; ++k) {
            hidden = vf_add(hidden, vf_load(layers + (size_t)k * edge * edge + i));
        }
        const vf dark = vf_mul(vector_saturate(hidden), texture_fade(x, y, edge));
        const vf scaled = vf_mul(dark, vf_set(strength * 65535.0f));
        vi_store(codes, vi_sub(vf_bits(vf_add(scaled, rounder)), vf_bits(rounder)));
        for (size_t j = 0; j < LANES; ++j) {
            const uint32_t left = 65535U - texels[i + j];
            texels[i + j] = (uint16_t)(texels[i + j] + left * (uint32_t)codes[j] / 65535U);
        }
    }
}

/* 1 inside, 0 at two opposite edges of the image, smooth.
 *   at    from its middle, half of it at the edges */
BURNISH_INLINE vf border_fade(vf at, float half, float per_border) {
    return smooth_step(vf_mul(vf_sub(vf_set(half), map_magnitude(at)), vf_set(per_border)));
}

static void shadow_ground(const burnish_ground_view *view, const burnish_screen_points *points,
                          size_t count, float *shadow) {
    const vf zero = vf_set(0.0f), least = vf_set(0x1p-40f);
    const vf end = vf_set((float)(view->size - 1));
    for (size_t i = 0; i < count; i += LANES) {
        const vf x = vf_add(vf_set(points->x), vf_load(points->x_offset + i));
        const vf y = vf_add(vf_set(points->y), vf_load(points->y_offset + i));
        const vf depth = ground_row(view->depth, x, y);
        const vf scale = vf_div(vf_set(1.0f), vf_max(depth, least));
        map_point point = {.depth = zero, .slope_x = zero, .slope_y = zero};
        point.x = vf_mul(ground_row(view->column, x, y), scale);
        point.y = vf_mul(ground_row(view->row, x, y), scale);
        vm seen = vm_and(vf_greater(depth, least), vf_greater(point.x, zero));
        seen = vm_and(seen, vf_greater(point.y, zero));
        seen = vm_and(seen, vm_and(vf_greater(end, point.x), vf_greater(end, point.y)));
        vf dark = zero;
        if (vm_any(seen)) {
            dark = map_over(view->texels, vi_set(0), view->size, &point, vf_set(1.0f),
                            vf_set(1.0f / 65535.0f));
            dark = vf_mul(dark, border_fade(x, view->half[0], view->per_border[0]));
            dark = vf_mul(dark, border_fade(y, view->half[1], view->per_border[1]));
        }
        vf_store(shadow + i, vf_and_mask(seen, dark));
    }
}

#endif
