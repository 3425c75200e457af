/* Positions of what pixels show. */
#ifndef BURNISH_RENDER_SCREEN_SIMD_H
#define BURNISH_RENDER_SCREEN_SIMD_H

#include "render/screen.h"
#include "simd/vector.h"

static void position_from_depth(const burnish_rays *rays, const burnish_screen_points *points,
                                size_t count, float *const position[3], float *w) {
    for (size_t i = 0; i < count; i += LANES) {
        const vf x = vf_add(vf_set(points->x), vf_load(points->x_offset + i));
        const vf y = vf_add(vf_set(points->y), vf_load(points->y_offset + i));
        const vf depth = vf_load(points->depth + i), beyond = vf_sub(vf_set(1.0f), depth);
        for (int k = 0; k < 3; ++k) {
            vf sum = vf_add(vf_set(rays->ray[k]), vf_mul(x, vf_set(rays->ray_x[k])));
            sum = vf_add(sum, vf_mul(y, vf_set(rays->ray_y[k])));
            vf_store(position[k] + i, vf_add(sum, vf_mul(beyond, vf_set(rays->ray_depth[k]))));
        }
        vf_store(w + i, vf_add(vf_mul(depth, vf_set(rays->q_per_depth)), vf_set(rays->q_constant)));
    }
}

#endif
