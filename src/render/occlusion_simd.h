/* Looking points up in the depth maps of ambient occlusion. */
#ifndef BURNISH_RENDER_OCCLUSION_SIMD_H
#define BURNISH_RENDER_OCCLUSION_SIMD_H

#include "render/occlusion.h"
#include "simd/vector_math.h"

/* row . (point, 1) */
BURNISH_INLINE vf transform_row(const float row[4], const vf point[3]) {
    vf sum = vf_add(vf_mul(vf_set(row[0]), point[0]), vf_mul(vf_set(row[1]), point[1]));
    sum = vf_add(sum, vf_mul(vf_set(row[2]), point[2]));
    return vf_add(sum, vf_set(row[3]));
}

/* A whole number at most half a texel from x - 1/2, inside a map with its neighbour; NaN becomes
 * 0. */
BURNISH_INLINE vf texel_before(vf x, int size) {
    const vf rounder = vf_set(BURNISH_ROUNDER);
    vf at = vf_max(vf_sub(x, vf_set(0.5f)), vf_set(0.0f));
    at = vf_min(at, vf_set((float)(size - 2)));
    return vf_sub(vf_add(at, rounder), rounder);
}

/* How much a texel's depth hides of a point's. */
BURNISH_INLINE vf hide(vi texel, vf depth, vf slope) {
    const vf over = vf_mul(vf_sub(vf_from_int(texel), depth), slope);
    return vf_min(vf_max(over, vf_set(0.0f)), vf_set(1.0f));
}

/* The same of two neighbouring texels, mixed. */
BURNISH_INLINE vf hide_pair(const uint16_t *depths, vi index, vf depth, vf slope, vf u) {
    const vi pair = vi_gather_pair(depths, index);
    const vf left = hide(vi_and(pair, vi_set(0xffff)), depth, slope);
    const vf right = hide(vi_shr(pair, 16), depth, slope);
    return vf_add(left, vf_mul(vf_sub(right, left), u));
}

/* The share of a direction's sky that is hidden from points: four texels, bilinear. */
BURNISH_INLINE vf look_up(const burnish_occlusion_direction *direction, const vf point[3], int size,
                          vf slope) {
    const vf x = transform_row(direction->map.column, point),
             y = transform_row(direction->map.row, point);
    const vf depth = transform_row(direction->map.depth, point);
    const vf x0 = texel_before(x, size), y0 = texel_before(y, size), zero = vf_set(0.0f),
             one = vf_set(1.0f);
    const vf u = vf_min(vf_max(vf_sub(x, x0), zero), one);
    const vf v = vf_min(vf_max(vf_sub(y, y0), zero), one);
    const vf at = vf_add(vf_add(vf_mul(y0, vf_set((float)size)), x0), vf_set(BURNISH_ROUNDER));
    const vi index = vi_sub(vf_bits(at), vf_bits(vf_set(BURNISH_ROUNDER))); /* below 2^22: exact */
    const vf upper = hide_pair(direction->depths, index, depth, slope, u);
    const vf lower = hide_pair(direction->depths + size, index, depth, slope, u);
    return vf_add(upper, vf_mul(vf_sub(lower, upper), v));
}

static void occlude(const burnish_occlusion_lookup *lookup, const burnish_kernels_points *points,
                    size_t count, float *const rgb[3]) {
    const vf slope = vf_set(lookup->slope);
    for (size_t i = 0; i < count; i += LANES) {
        const vf inverse_w = vf_div(vf_set(1.0f), vf_load(points->w + i));
        vf normal[3], point[3], squared = vf_set(0.0f), hidden = vf_set(0.0f);
        vf sky = vf_set(0x1p-20f); /* a point without a normal is not occluded */
        for (int k = 0; k < 3; ++k) {
            normal[k] = vf_load(points->normal[k] + i);
            squared = vf_add(squared, vf_mul(normal[k], normal[k]));
        }
        const vf scale = vector_inverse_sqrt(squared);
        for (int k = 0; k < 3; ++k) {
            normal[k] = vf_mul(normal[k], scale);
            point[k] = vf_add(vf_mul(vf_load(points->position[k] + i), inverse_w),
                              vf_mul(normal[k], vf_set(lookup->offset)));
        }
        for (int d = 0; d < lookup->count; ++d) {
            const burnish_occlusion_direction *direction = &lookup->directions[d];
            vf cosine = vf_add(vf_mul(normal[0], vf_set(direction->toward[0])),
                               vf_mul(normal[1], vf_set(direction->toward[1])));
            cosine = vf_add(cosine, vf_mul(normal[2], vf_set(direction->toward[2])));
            if (!vm_any(vf_greater(cosine, vf_set(0.0f)))) {
                continue;
            }
            const vf weight = vf_mul(vf_max(cosine, vf_set(0.0f)), vf_set(direction->weight));
            sky = vf_add(sky, weight);
            hidden = vf_add(hidden, vf_mul(weight, look_up(direction, point, lookup->size, slope)));
        }
        const vf lost = vf_mul(vf_set(lookup->strength), vf_div(hidden, sky));
        for (int k = 0; k < 3; ++k) {
            const vf light = vf_load(rgb[k] + i);
            vf_store(rgb[k] + i, vf_sub(light, vf_mul(light, lost)));
        }
    }
}

#endif
