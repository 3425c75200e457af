/* Looking points up in the depth map of a light. */
#ifndef BURNISH_RENDER_LIGHT_SHADOW_SIMD_H
#define BURNISH_RENDER_LIGHT_SHADOW_SIMD_H

#include "render/light/maps/depth_map_simd.h"
#include "render/light/maps/shadow.h"

/* A disc of taps, in radii of the filter: sqrt((i + 1/2) / 12) at i golden angles. */
enum { SHADOW_TAPS = 12 };
static const float SHADOW_DISC[SHADOW_TAPS][2] = {
    {0.204f, 0.000f},   {-0.261f, 0.239f}, {0.040f, -0.455f}, {0.329f, 0.429f},
    {-0.603f, -0.107f}, {0.571f, -0.363f}, {-0.191f, 0.711f}, {-0.364f, -0.702f},
    {0.791f, 0.289f},   {-0.822f, 0.339f}, {0.396f, -0.847f}, {0.293f, 0.934f}};

/* Where light grazes, facets of a smooth surface would hide each other: shadows fade below this
 * cosine, where there is little light anyway. */
#define SHADOW_GRAZING 0.15f

BURNISH_INLINE vf shadow_at(const burnish_shadow_lookup *lookup, const map_point *point) {
    const vf one = vf_set(1.0f), factor = vf_set(lookup->slope);
    vf hidden = vf_set(0.0f);
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        const vf dx = vf_set(lookup->radius * SHADOW_DISC[i][0]);
        const vf dy = vf_set(lookup->radius * SHADOW_DISC[i][1]);
        const vf rise = vf_add(vf_mul(dx, point->slope_x), vf_mul(dy, point->slope_y));
        map_point tap = *point;
        tap.x = vf_add(point->x, dx);
        tap.y = vf_add(point->y, dy);
        tap.depth = vf_add(point->depth, rise);
        hidden =
            vf_add(hidden, map_over(lookup->depths, vi_set(0), lookup->size, &tap, one, factor));
    }
    return vf_mul(hidden, vf_set(1.0f / SHADOW_TAPS));
}

static void cast_shadow(const burnish_shadow_lookup *lookup, const burnish_kernels_points *points,
                        size_t count, float *lit) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    for (size_t i = 0; i < count; i += LANES) {
        const vf inverse_w = vf_div(one, vf_load(points->w + i));
        vf n[3], p[3], squared = zero;
        for (int k = 0; k < 3; ++k) {
            n[k] = vf_load(points->normal[k] + i);
            squared = vf_add(squared, vf_mul(n[k], n[k]));
        }
        const vf scale = vector_inverse_sqrt(squared);
        for (int k = 0; k < 3; ++k) {
            n[k] = vf_mul(n[k], scale);
            p[k] = vf_add(vf_mul(vf_load(points->position[k] + i), inverse_w),
                          vf_mul(n[k], vf_set(lookup->offset)));
        }
        const vf cosine = map_dot(lookup->toward, n);
        vf hidden = zero;
        if (vm_any(vf_greater(cosine, zero))) {
            const map_point point =
                map_locate(&lookup->map, p, n, vf_max(cosine, vf_set(0.125f)), lookup->plane);
            const vf fade = vf_mul(cosine, vf_set(1.0f / SHADOW_GRAZING));
            hidden = vf_mul(shadow_at(lookup, &point), vector_saturate(fade));
        }
        vf_store(lit + i, vf_sub(one, hidden));
    }
}

#endif
