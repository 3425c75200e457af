/* Sheen of textiles: Charlie's distribution (Estevez and Kulla 2017), roughness^2 its width, with
 * the visibility of Ashikhmin and Premoze (2007), over vectors of points. */
#ifndef BURNISH_SHADING_SHEEN_SIMD_H
#define BURNISH_SHADING_SHEEN_SIMD_H

#include "shading/environment_simd.h"

/* Smoother sheen than this shows within a degree of the edge alone. */
#define SHEEN_ROUGHNESS_MIN 0.1f

/* What sheen reflects of uniform light, at most 1: within 0.011 of sums over 288,000 directions. */
BURNISH_INLINE vf sheen_albedo(vf roughness, vf n_dot_v) {
    static const float powers[4][3] = {{-1.4433f, 0.8239f, -0.0351f},
                                       {-2.0849f, -0.8292f, -0.5531f},
                                       {1.3452f, 2.2837f, -0.178f},
                                       {0.6128f, -2.7803f, -0.2137f}};
    const vf one = vf_set(1.0f), inverse = vf_div(one, vf_add(roughness, vf_set(0.1f)));
    vf power = vf_set(0.0f);
    for (int i = 3; i >= 0; --i) {
        power = vf_add(vf_mul(power, n_dot_v), environment_polynomial(powers[i], 3, inverse));
    }
    return vf_min(vector_exp2(vf_max(power, vf_set(-120.0f))), one);
}

/* Adds what it reflects of a directional or point light, `lit` of which arrives. */
BURNISH_INLINE void sheen_add_light(const burnish_light_constants *light, const shade_vectors *at,
                                    vf x, vf inverse_alpha, vf lit, vf sum[3]) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f), zero = vf_set(0.0f);
    const shade_cosines cosines = shade_cosines_of(light, at);
    const vf y = vf_max(cosines.n_dot_l, zero), both = vf_add(y, x);
    const vf squared = vf_max(vf_add(two, vf_mul(two, cosines.l_dot_v)), vf_set(0x1p-20f));
    const vf sine = vf_max(vf_sub(one, vf_div(vf_mul(both, both), squared)), zero);
    const vf d =
        vf_mul(vf_add(two, inverse_alpha), vector_power(sine, vf_mul(vf_set(0.5f), inverse_alpha)));
    const vf v = vf_div(y, vf_max(vf_sub(both, vf_mul(x, y)), vf_set(0x1p-20f)));
    const vf value = vf_mul(vf_mul(vf_mul(vf_set(0.125f), d), v), lit);
    for (int k = 0; k < 3; ++k) {
        const vf color = vf_set(light->diffuse[BURNISH_SHADE_FLOAT][k]);
        sum[k] = vf_add(sum[k], vf_mul(value, color));
    }
}

static void lay_sheen(const burnish_kernels_shader *white, const burnish_sheen_points *sheen,
                      const burnish_kernels_points *points, size_t count, float *const rgb[3]) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    for (size_t i = 0; i < count; i += LANES) {
        shade_vectors at;
        vf sum[3] = {zero, zero, zero}, wide[3], color[3], most = zero;
        vf r = vf_set(sheen->roughness);
        r = sheen->each[3] ? vf_mul(r, vf_load(sheen->each[3] + i)) : r;
        r = vf_max(r, vf_set(SHEEN_ROUGHNESS_MIN));
        shade_load(BURNISH_SHADE_GENERAL, white, points, i, &at);
        at.squared_n = shade_dot(at.normal, at.normal);
        at.inverse_n = vector_inverse_sqrt(at.squared_n);
        shade_view(white, &at);
        const vf x = vf_min(vf_max(at.n_dot_v, zero), one), albedo = sheen_albedo(r, x);
        const vf inverse_alpha = vf_div(one, vf_mul(r, r));
        for (int l = 0; l < white->light_count; ++l) {
            const vf lit = l == 0 && points->first_light ? vf_load(points->first_light + i) : one;
            sheen_add_light(&white->lights[l], &at, x, inverse_alpha, lit, sum);
        }
        for (int k = 0; k < 3; ++k) {
            color[k] = vf_set(sheen->color[k]);
            color[k] = sheen->each[0] ? vf_mul(color[k], vf_load(sheen->each[k] + i)) : color[k];
            most = vf_max(most, color[k]);
            wide[k] = sheen->wide[0] ? vf_load(sheen->wide[k] + i) : zero;
            wide[k] = vf_add(wide[k], vf_set(white->ambient[BURNISH_SHADE_FLOAT][k]));
            wide[k] = sheen->open ? vf_mul(wide[k], vf_load(sheen->open + i)) : wide[k];
        }
        const vf below = vf_sub(one, vf_mul(most, albedo));
        for (int k = 0; k < 3; ++k) { /* a NaN has other bits on other processors */
            const vf light = vf_mul(color[k], vf_add(sum[k], vf_mul(albedo, wide[k])));
            const vf base = vf_mul(vf_load(rgb[k] + i), below);
            vf_store(rgb[k] + i, vf_max(vf_add(base, light), zero));
        }
    }
}

#endif
