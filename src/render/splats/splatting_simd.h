/* Blends splats into rows of an image. */
#ifndef BURNISH_RENDER_SPLATS_SPLATTING_SIMD_H
#define BURNISH_RENDER_SPLATS_SPLATTING_SIMD_H

#include "burnish/lobe.h"
#include "render/splats/splatting.h"
#include "simd/vector.h"

/* Where less light passes, what is behind does not show. */
#define SPLAT_UNSEEN 0x1p-12f

/* burnish_exp_falloff5 for d >= 0. */
BURNISH_INLINE vf splat_falloff(vf d) {
    vf v = vf_sub(vf_set(0.812974453f), vf_mul(vf_set(0.087877281f), d));
    v = vf_max(v, vf_set(0.0f));
    v = vf_mul(v, v);
    v = vf_mul(v, vf_add(v, vf_set(0.273172706f)));
    v = vf_mul(v, vf_add(v, vf_set(0.955595791f)));
    return vf_mul(v, vf_add(v, vf_set(0.0586450733f)));
}

/* Pixels [first, end) of a row, and the rest of their vectors: which pixels a splat reaches depends
 * on them alone. */
static inline void blend_row(const burnish_splat_item *item, const burnish_splat_band *band, int y,
                             const float steps[LANES]) {
    const float up = (float)y + 0.5f - item->y, rest = item->b * (up * up);
    const float square = (BURNISH_EXP_FALLOFF_END5 - rest) / item->a;
    if (!(square > 0)) {
        return;
    }
    const float center = item->x + item->slope * up, half = __builtin_sqrtf(square);
    const float reach = half + 1 + 4e-7f * (__builtin_fabsf(center) + half); /* rounding */
    const float low = center - reach, high = center + reach, width = (float)band->width;
    const int first = low > 0 ? (int)(low < width ? low : width) : 0;
    const int end = high < width ? (int)(high > 0 ? high : 0) : band->width;
    const size_t row = (size_t)(y - band->first_row) * band->stride;
    for (int x = first - first % LANES; x < end; x += LANES) {
        float *to = band->through + row + x;
        const vf through = vf_load(to);
        const vf u = vf_sub(vf_add(vf_set((float)x + 0.5f), vf_load(steps)), vf_set(center));
        const vf squared = vf_mul(u, u);
        const vm seen =
            vm_and(vf_greater(vf_set(square), squared), vf_greater(through, vf_set(SPLAT_UNSEEN)));
        if (!vm_any(seen)) {
            continue;
        }
        const vf d = vf_add(vf_mul(vf_set(item->a), squared), vf_set(rest));
        vf alpha = vf_mul(vf_set(item->opacity), splat_falloff(d));
        if (band->surface) {
            const vm nearer = vf_greater(vf_load(band->surface + row + x), vf_set(item->depth));
            alpha = vf_mul(alpha, vf_blend(nearer, vf_set(1.0f), vf_load(band->open + row + x)));
        }
        const vf share = vf_and_mask(seen, vf_mul(through, alpha));
        vf_store(to, vf_sub(through, share));
        for (int k = 0; k < 3; ++k) {
            float *light = band->rgb[k] + row + x;
            vf_store(light, vf_add(vf_load(light), vf_mul(share, vf_set(item->color[k]))));
        }
    }
}

static void blend_splats(const burnish_splat_item *items, size_t count,
                         const burnish_splat_band *band) {
    float steps[LANES];
    for (int i = 0; i < LANES; ++i) {
        steps[i] = (float)i;
    }
    for (size_t i = 0; i < count; ++i) {
        const int from = items[i].first_row, to = items[i].end_row;
        const int end = to < band->end_row ? to : band->end_row;
        for (int y = from < band->first_row ? band->first_row : from; y < end; ++y) {
            blend_row(items + i, band, y, steps);
        }
    }
}

#endif
