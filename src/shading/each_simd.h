/* The lighting equation where each point has a material of its own: coefficients and exponent. */
#ifndef BURNISH_SHADING_EACH_SIMD_H
#define BURNISH_SHADING_EACH_SIMD_H

#include "shading/shade_simd.h"

/* Lobes of a vector of points. */
typedef struct each_lobe {
    vf exponent, zeta, scale;
} each_lobe;

/* Slope and scale from the table, linear in the logarithm of the exponent. */
BURNISH_INLINE each_lobe each_lobe_of(int body, const burnish_point_materials *materials,
                                      vf exponent) {
    const vf one = vf_set(1.0f), rounder = vf_set(12582912.0f);
    each_lobe lobe = {.scale = one, .zeta = one};
    lobe.exponent = vf_min(vf_max(exponent, vf_set(materials->least_exponent)), vf_set(65536.0f));
    if (lobe_has_base(body)) {
        const vf at = vf_max(vf_mul(vector_log2(lobe.exponent), vf_set((float)BURNISH_EACH_STEPS)),
                             vf_set(0.0f));
        const vf below =
            vf_max(vf_sub(vf_add(vf_sub(at, vf_set(0.5f)), rounder), rounder), vf_set(0.0f));
        const vf share = vf_sub(at, below);
        const vi i = vi_sub(vf_bits(vf_add(below, rounder)), vi_set(0x4b400000));
        const vi next = vi_add(i, vi_set(1));
        const vf slope = vf_gather(materials->slopes, i), scale = vf_gather(materials->scales, i);
        lobe.zeta =
            vf_mul(lobe.exponent,
                   vf_add(slope, vf_mul(share, vf_sub(vf_gather(materials->slopes, next), slope))));
        lobe.scale =
            vf_add(scale, vf_mul(share, vf_sub(vf_gather(materials->scales, next), scale)));
    }
    return lobe;
}

/* A lobe at a cosine, as lobe_of and lobe_of_cosine have it. */
BURNISH_INLINE vf each_value(int body, const burnish_kernels_shader *shader, const each_lobe *lobe,
                             vf cosine) {
    const vf one = vf_set(1.0f), half = vf_set(0.5f), n = lobe->exponent;
    vf c, lambda;
    switch (body) {
    case BURNISH_LOBE_BODY_SQUARE:
    case BURNISH_LOBE_BODY_SQUARES:
        c = vector_saturate(vf_sub(one, vf_mul(lobe->zeta, vf_sub(one, cosine))));
        return lobe_of_base(body, &shader->lobe, c);
    case BURNISH_LOBE_BODY_POWER:
        return vector_power(cosine, n);
    case BURNISH_LOBE_BODY_SCHLICK:
        c = vector_saturate(cosine);
        return vector_saturate(vf_div(c, vf_add(c, vf_mul(n, vf_sub(one, c)))));
    case BURNISH_LOBE_BODY_GAUSSIAN:
        lambda = vf_max(vf_sub(one, cosine), vf_set(0.0f));
        c = vf_mul(vf_add(n, vf_set(0.775f)), vf_set(-1.44269504088896340736f));
        return vf_and_mask(vf_greater(cosine, vf_set(-0x1.fffffep127f)),
                           vf_min(vector_exp2(vf_mul(c, lambda)), one));
    case BURNISH_LOBE_BODY_GX:
        c = vector_saturate(cosine);
        lambda = vf_mul(vf_sub(one, c), vf_add(one, c));
        c = vf_mul(c, c);
        return vector_saturate(vf_div(c, vf_add(c, vf_mul(vf_mul(half, n), lambda))));
    default:
        return vf_set(0.0f);
    }
}

BURNISH_INLINE void each_light(int body, const burnish_kernels_shader *shader,
                               const burnish_light_constants *light, const shade_vectors *at,
                               const each_lobe *lobe, shade_sums *sums) {
    const shade_kernel kernel = {body, BURNISH_SHADE_GENERAL, BURNISH_SHADE_FLOAT, 3};
    const vf zero = vf_set(0.0f);
    const shade_cosines cosines = shade_cosines_of(light, at);
    const vf share = cosines.share, lambert = vf_max(cosines.n_dot_l, zero);
    shade_add_diffuse(kernel, light, light->is_lessened ? vf_mul(lambert, share) : lambert, sums);
    const vm lit = vf_greater(cosines.n_dot_l, zero);
    if (vm_any(lit)) {
        const vf cosine = shade_lobe_cosine(shader, at, &cosines);
        const vf value = vf_and_mask(lit, each_value(body, shader, lobe, cosine));
        shade_add_specular(kernel, light, light->is_lessened ? vf_mul(value, share) : value, sums);
    }
}

BURNISH_INLINE void each_vector(int body, const burnish_kernels_shader *shader,
                                const burnish_kernels_points *points,
                                const burnish_point_materials *materials, size_t i, vf color[3]) {
    shade_vectors at;
    shade_sums sums;
    shade_load(BURNISH_SHADE_GENERAL, shader, points, i, &at);
    for (int k = 0; k < 3; ++k) {
        sums.diffuse[k] = sums.specular[k] = vf_set(0.0f);
    }
    at.squared_n = shade_dot(at.normal, at.normal);
    at.inverse_n = vector_inverse_sqrt(at.squared_n);
    shade_view(shader, &at);
    const each_lobe lobe = each_lobe_of(body, materials, vf_load(materials->exponent + i));
    for (int l = 0; l < shader->light_count; ++l) {
        each_light(body, shader, &shader->lights[l], &at, &lobe, &sums);
        if (l == 0 && points->first_light) {
            const vf lit = vf_load(points->first_light + i);
            for (int k = 0; k < 3; ++k) {
                sums.diffuse[k] = vf_mul(sums.diffuse[k], lit);
                sums.specular[k] = vf_mul(sums.specular[k], lit);
            }
        }
    }
    for (int k = 0; k < 3; ++k) {
        const vf ambient = vf_mul(vf_load(materials->ambient[k] + i),
                                  vf_set(shader->ambient[BURNISH_SHADE_FLOAT][k]));
        const vf diffuse = vf_mul(vf_load(materials->diffuse[k] + i), sums.diffuse[k]);
        const vf specular =
            vf_mul(vf_mul(vf_load(materials->specular[k] + i), lobe.scale), sums.specular[k]);
        /* a NaN has other bits on other processors */
        color[k] = vf_max(vf_add(vf_add(ambient, diffuse), specular), vf_set(0.0f));
    }
}

BURNISH_INLINE void each_array(int body, const burnish_kernels_shader *restrict shader,
                               const burnish_kernels_points *restrict points,
                               const burnish_point_materials *restrict materials, size_t count,
                               float *const rgb[3]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf color[3];
        each_vector(body, shader, points, materials, i, color);
        for (int k = 0; k < 3; ++k) {
            vf_store(rgb[k] + i, color[k]);
        }
    }
}

/* ---- The kernels ---- */

#define EACH_FUNCTION(name, body)                                                                  \
    static void each_##name(                                                                       \
        const burnish_kernels_shader *shader, const burnish_kernels_points *points,                \
        const burnish_point_materials *materials, size_t count, float *const rgb[3]) {             \
        each_array(body, shader, points, materials, count, rgb);                                   \
    }
EACH_FUNCTION(none, BURNISH_LOBE_BODY_NONE)
EACH_FUNCTION(square, BURNISH_LOBE_BODY_SQUARE)
EACH_FUNCTION(squares, BURNISH_LOBE_BODY_SQUARES)
EACH_FUNCTION(power, BURNISH_LOBE_BODY_POWER)
EACH_FUNCTION(schlick, BURNISH_LOBE_BODY_SCHLICK)
EACH_FUNCTION(gaussian, BURNISH_LOBE_BODY_GAUSSIAN)
EACH_FUNCTION(gx, BURNISH_LOBE_BODY_GX)
#undef EACH_FUNCTION

#endif
