/* Pixels to places in space. */
#ifndef BURNISH_SHADING_LOCATE_SIMD_H
#define BURNISH_SHADING_LOCATE_SIMD_H

#include "shading/shade.h"
#include "simd/vector.h"

/* The pixels of a block from its first one. */
static const float PIXEL_X[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const float PIXEL_Y[16] = {0, 0, 0, 0, -1, -1, -1, -1, -2, -2, -2, -2, -3, -3, -3, -3};

static void locate_pixels(const burnish_rays *rays, float x, float y, size_t count,
                          const float *depths, float *const position[3], float *w) {
    for (size_t i = 0; i < count; i += LANES) {
        /* halves of pixels: exact */
        const vf at_x = vf_add(vf_set(x + (float)(i / 16 * 4)), vf_load(PIXEL_X + i % 16));
        const vf at_y = vf_add(vf_set(y), vf_load(PIXEL_Y + i % 16));
        const vf depth = vf_load(depths + i), far = vf_sub(vf_set(1.0f), depth);
        for (int k = 0; k < 3; ++k) {
            vf sum = vf_add(vf_set(rays->ray[k]), vf_mul(at_x, vf_set(rays->ray_x[k])));
            sum = vf_add(sum, vf_mul(at_y, vf_set(rays->ray_y[k])));
            vf_store(position[k] + i, vf_add(sum, vf_mul(far, vf_set(rays->ray_depth[k]))));
        }
        vf_store(w + i, vf_add(vf_mul(depth, vf_set(rays->q_per_depth)), vf_set(rays->q_constant)));
    }
}

#endif
