/* The whole lighting equation over vectors of points.
 *
 * A skipped lobe is exactly 0 and sums are never negative, so skipping what a whole vector does not
 * need changes no bit, for any length of vectors. */
#ifndef BURNISH_SHADING_SHADE_SIMD_H
#define BURNISH_SHADING_SHADE_SIMD_H

#include "shading/lobe_simd.h"

/* Which of the kernels: constants where it is compiled. */
typedef struct shade_kernel {
    int body, geometry, output; /* burnish_lobe_body, BURNISH_SHADE_... */
    int channels;               /* 3; 1: all have the first one's constants */
} shade_kernel;

/* Vectors that are shaded side by side: alone, each would wait for its own results. */
enum { SHADE_WAYS = 2 };

/* Where colours go, by the kernel's output. */
typedef struct shade_colors {
    uint8_t *rgba;
    float *const *rgb;
} shade_colors;

/* One vector of points: what the arrays hold, and what all lights need of it. */
typedef struct shade_vectors {
    vf normal[3], position[3], w;
    vf squared_n, inverse_n;  /* |N|^2, 1 / |N| */
    vf to_viewer[3], n_dot_v; /* GENERAL: unit vector, cosine */
} shade_vectors;

/* What every light adds to. */
typedef struct shade_sums {
    vf diffuse[3], specular[3];
} shade_sums;

BURNISH_INLINE vf shade_dot(const vf a[3], const vf b[3]) {
    return vf_add(vf_add(vf_mul(a[0], b[0]), vf_mul(a[1], b[1])), vf_mul(a[2], b[2]));
}

BURNISH_INLINE vf shade_dot_constant(const vf a[3], const float b[3]) {
    return vf_add(vf_add(vf_mul(a[0], vf_set(b[0])), vf_mul(a[1], vf_set(b[1]))),
                  vf_mul(a[2], vf_set(b[2])));
}

BURNISH_INLINE void shade_add_diffuse(shade_kernel kernel, const burnish_light_constants *light,
                                      vf n_dot_l, shade_sums *sums) {
    for (int k = 0; k < kernel.channels; ++k) {
        sums->diffuse[k] =
            vf_add(sums->diffuse[k], vf_mul(n_dot_l, vf_set(light->diffuse[kernel.output][k])));
    }
}

BURNISH_INLINE void shade_add_specular(shade_kernel kernel, const burnish_light_constants *light,
                                       vf lobe, shade_sums *sums) {
    for (int k = 0; k < kernel.channels; ++k) {
        sums->specular[k] =
            vf_add(sums->specular[k], vf_mul(lobe, vf_set(light->specular[kernel.output][k])));
    }
}

/* A lobe from its base u, where lit and above 0; adds nothing where no lane is.
 *   share  of the light; NULL: all of it */
BURNISH_INLINE void shade_add_base(shade_kernel kernel, const burnish_kernels_shader *shader,
                                   const burnish_light_constants *light, vm lit, vf u,
                                   const vf *share, shade_sums *sums) {
    const vf top = lobe_top(kernel.body, &shader->lobe);
    if (kernel.channels == 1) { /* too little to skip */
        u = vf_and_mask(lit, vf_min(vf_max(u, vf_set(0.0f)), top));
        const vf lobe = lobe_of_base(kernel.body, &shader->lobe, u);
        shade_add_specular(kernel, light, share ? vf_mul(lobe, *share) : lobe, sums);
        return;
    }
    vm shines = vm_and(lit, vf_greater(u, vf_set(0.0f)));
    if (vm_any(shines)) {
        u = vf_and_mask(shines, vf_min(u, top));
        const vf lobe = lobe_of_base(kernel.body, &shader->lobe, u);
        shade_add_specular(kernel, light, share ? vf_mul(lobe, *share) : lobe, sums);
    }
}

/* A directional light and a distant viewer, from N.L >= 0 and the cosine with the half vector. */
BURNISH_INLINE void shade_add_distant(shade_kernel kernel, const burnish_kernels_shader *shader,
                                      const burnish_light_constants *light, vf n_dot_l, vf cosine,
                                      shade_sums *sums) {
    shade_add_diffuse(kernel, light, n_dot_l, sums);
    if (kernel.body == BURNISH_LOBE_BODY_NONE) {
        return;
    }
    vm lit = vf_greater(n_dot_l, vf_set(0.0f));
    if (lobe_has_base(kernel.body)) {
        vf u = vf_add(cosine, vf_set(shader->offset)); /* zeta is in the half vector */
        shade_add_base(kernel, shader, light, lit, u, NULL, sums);
    } else if (vm_any(lit)) {
        vf lobe = vf_and_mask(lit, lobe_of_cosine(kernel.body, &shader->lobe, cosine));
        shade_add_specular(kernel, light, lobe, sums);
    }
}

/* A directional light and a distant viewer: one constant half vector. */
BURNISH_INLINE void shade_distant_light(shade_kernel kernel, const burnish_kernels_shader *shader,
                                        const burnish_light_constants *light,
                                        const shade_vectors *at, shade_sums *sums) {
    const vf inverse = at->inverse_n;
    const vf n_dot_l = vf_mul(shade_dot_constant(at->normal, light->vector), inverse);
    const vf cosine = vf_mul(shade_dot_constant(at->normal, light->half), inverse);
    shade_add_distant(kernel, shader, light, vf_max(n_dot_l, vf_set(0.0f)), cosine, sums);
}

/* Cosines of one light, and what arrives of it if it is lessened. */
typedef struct shade_cosines {
    vf n_dot_l, l_dot_v, share;
} shade_cosines;

/* Lyon's lobe: N of length s is scaled by three terms of 1/s instead of exactly; what is left of
 * the length, g, shows in the chord: lambda = (g^2 + 1)/2 - g c, u = 1 - zeta lambda. */
BURNISH_INLINE vf shade_lyon(const burnish_kernels_shader *shader, vf squared, vf inverse,
                             vf cosine) {
    const vf one = vf_set(1.0f), half = vf_set(0.5f);
    vf e = vf_sub(one, squared);
    vf factor = vf_add(one, vf_mul(e, vf_add(half, vf_mul(vf_set(0.375f), e))));
    vf g = vf_mul(vf_mul(squared, inverse), factor);
    vf lambda = vf_sub(vf_mul(vf_add(vf_mul(g, g), one), half), vf_mul(g, cosine));
    return vf_sub(one, vf_mul(vf_set(shader->lobe.zeta), lambda));
}

/* Whether the boundary cosine says that no lane can shine. |L + V|^2 = 2 + 2 L.V and
 * N.(L + V) = N.L + N.V, so no root is needed to know. */
BURNISH_INLINE int shade_is_dark(const burnish_kernels_shader *shader, vm lit, vf sum, vf squared) {
    if (shader->cutoff <= 0.0f) {
        return !vm_any(lit);
    }
    vf bound = vf_mul(vf_set(shader->cutoff * shader->cutoff), squared);
    vm near = vm_and(vf_greater(sum, vf_set(0.0f)), vf_greater(vf_mul(sum, sum), bound));
    return !vm_any(vm_and(lit, near));
}

BURNISH_INLINE void shade_general_specular(shade_kernel kernel,
                                           const burnish_kernels_shader *shader,
                                           const burnish_light_constants *light,
                                           const shade_vectors *at, const shade_cosines *cosines,
                                           shade_sums *sums) {
    const vf two = vf_set(2.0f);
    vm lit = vf_greater(cosines->n_dot_l, vf_set(0.0f));
    vf cosine;
    if (shader->phong) {
        cosine = vf_sub(vf_mul(vf_mul(two, cosines->n_dot_l), at->n_dot_v), cosines->l_dot_v);
    } else {
        /* opposite L and V leave no half vector: any bound that is not 0 will do */
        vf squared = vf_max(vf_add(two, vf_mul(two, cosines->l_dot_v)), vf_set(0x1p-20f));
        vf sum = vf_add(cosines->n_dot_l, at->n_dot_v);
        if (lobe_has_base(kernel.body) && shade_is_dark(shader, lit, sum, squared)) {
            return;
        }
        cosine = vf_mul(sum, vector_inverse_sqrt(squared));
    }
    if (lobe_has_base(kernel.body)) {
        vf u = shader->lyon
                   ? shade_lyon(shader, at->squared_n, at->inverse_n, cosine)
                   : vf_add(vf_mul(cosine, vf_set(shader->lobe.zeta)), vf_set(shader->offset));
        shade_add_base(kernel, shader, light, lit, u, light->is_lessened ? &cosines->share : NULL,
                       sums);
    } else if (vm_any(lit)) {
        vf lobe = vf_and_mask(lit, lobe_of_cosine(kernel.body, &shader->lobe, cosine));
        lobe = light->is_lessened ? vf_mul(lobe, cosines->share) : lobe;
        shade_add_specular(kernel, light, lobe, sums);
    }
}

/* What arrives of a light that falls off or has a cone, at 1 / inverse from it. Anything nearer than
 * 1/1024 of its distance gets as much as there, so that no value is infinite. */
BURNISH_INLINE vf shade_share(const burnish_light_constants *light, vf inverse, vf cosine) {
    const vf one = vf_set(1.0f), near = vf_mul(inverse, inverse);
    vf share = one;
    if (light->squared_distance > 0) {
        share = vf_min(vf_mul(vf_set(light->squared_distance), near), vf_set(0x1p20f));
    }
    if (light->squared_range > 0) {
        const vf part = vf_div(one, vf_mul(vf_set(light->squared_range), near));
        share = vf_mul(share, vector_saturate(vf_sub(one, vf_mul(part, part))));
    }
    if (light->cone_scale > 0) {
        const vf t = vector_saturate(
            vf_add(vf_mul(cosine, vf_set(light->cone_scale)), vf_set(light->cone_offset)));
        share = vf_mul(share, vf_mul(t, t));
    }
    return share;
}

/* What a light makes of a point, whatever light and viewer are. */
BURNISH_INLINE shade_cosines shade_cosines_of(const burnish_light_constants *light,
                                              const shade_vectors *at) {
    vf to_light[3];
    vf inverse = at->inverse_n;
    shade_cosines cosines;
    for (int k = 0; k < 3; ++k) {
        to_light[k] = vf_set(light->vector[k]);
        if (light->is_point) {
            to_light[k] = vf_sub(vf_mul(to_light[k], at->w), at->position[k]);
        }
    }
    cosines.share = vf_set(1.0f);
    cosines.l_dot_v = shade_dot(to_light, at->to_viewer);
    if (light->is_point) {
        vf inverse_l = vector_inverse_sqrt(shade_dot(to_light, to_light));
        inverse = vf_mul(inverse, inverse_l);
        cosines.l_dot_v = vf_mul(cosines.l_dot_v, inverse_l);
        if (light->is_lessened) {
            const vf cosine = vf_mul(shade_dot_constant(to_light, light->to_light), inverse_l);
            cosines.share = shade_share(light, vf_mul(at->w, inverse_l), cosine);
        }
    }
    cosines.n_dot_l = vf_mul(shade_dot(at->normal, to_light), inverse);
    return cosines;
}

/* The argument of the lobe: N.H or R.V. */
BURNISH_INLINE vf shade_lobe_cosine(const burnish_kernels_shader *shader, const shade_vectors *at,
                                    const shade_cosines *cosines) {
    const vf two = vf_set(2.0f);
    if (shader->phong) {
        return vf_sub(vf_mul(vf_mul(two, cosines->n_dot_l), at->n_dot_v), cosines->l_dot_v);
    }
    vf squared = vf_max(vf_add(two, vf_mul(two, cosines->l_dot_v)), vf_set(0x1p-20f));
    return vf_mul(vf_add(cosines->n_dot_l, at->n_dot_v), vector_inverse_sqrt(squared));
}

/* Any light and viewer. */
BURNISH_INLINE void shade_general_light(shade_kernel kernel, const burnish_kernels_shader *shader,
                                        const burnish_light_constants *light,
                                        const shade_vectors *at, shade_sums *sums) {
    const shade_cosines cosines = shade_cosines_of(light, at);
    const vf lambert = vf_max(cosines.n_dot_l, vf_set(0.0f));
    shade_add_diffuse(kernel, light, light->is_lessened ? vf_mul(lambert, cosines.share) : lambert,
                      sums);
    if (kernel.body != BURNISH_LOBE_BODY_NONE) {
        shade_general_specular(kernel, shader, light, at, &cosines, sums);
    }
}

/* Toward the viewer. */
BURNISH_INLINE void shade_view(const burnish_kernels_shader *shader, shade_vectors *at) {
    for (int k = 0; k < 3; ++k) {
        at->to_viewer[k] = vf_set(shader->viewer[k]);
        if (shader->local_viewer) {
            at->to_viewer[k] = vf_sub(vf_mul(at->to_viewer[k], at->w), at->position[k]);
        }
    }
    if (shader->local_viewer) {
        vf inverse = vector_inverse_sqrt(shade_dot(at->to_viewer, at->to_viewer));
        for (int k = 0; k < 3; ++k) {
            at->to_viewer[k] = vf_mul(at->to_viewer[k], inverse);
        }
    }
    at->n_dot_v = vf_mul(shade_dot(at->normal, at->to_viewer), at->inverse_n);
}

BURNISH_INLINE void shade_load(int geometry, const burnish_kernels_shader *shader,
                               const burnish_kernels_points *points, size_t i, shade_vectors *at) {
    for (int k = 0; k < 3; ++k) {
        at->normal[k] = vf_load(points->normal[k] + i);
    }
    if (geometry == BURNISH_SHADE_GENERAL) {
        at->w = points->w ? vf_load(points->w + i) : vf_set(1.0f);
        for (int k = 0; k < 3; ++k) {
            at->position[k] =
                shader->needs_position ? vf_load(points->position[k] + i) : vf_set(0.0f);
        }
    }
}

/* Of the first light's part of the sums, `lit` stays. */
BURNISH_INLINE void shade_lessen_first(const burnish_kernels_shader *shader, int output, vf lit,
                                       shade_sums *sums) {
    for (int k = 0; k < 3; ++k) {
        const vf ambient = vf_set(shader->ambient[output][k]);
        const vf diffuse = vf_sub(sums->diffuse[k], ambient);
        sums->diffuse[k] = vf_add(ambient, vf_mul(diffuse, lit));
        sums->specular[k] = vf_mul(sums->specular[k], lit);
    }
}

/* `ways` vectors of points from i on: the colours, in [0, 255] for RGBA8, not yet clamped. */
BURNISH_INLINE void shade_points(shade_kernel kernel, int ways,
                                 const burnish_kernels_shader *shader,
                                 const burnish_kernels_points *points, size_t i, vf (*color)[3]) {
    shade_vectors at[SHADE_WAYS];
    shade_sums sums[SHADE_WAYS];
    for (int j = 0; j < ways; ++j) {
        shade_load(kernel.geometry, shader, points, i + (size_t)j * LANES, &at[j]);
        for (int k = 0; k < kernel.channels; ++k) {
            sums[j].diffuse[k] = vf_set(shader->ambient[kernel.output][k]);
            sums[j].specular[k] = vf_set(0.0f);
        }
    }
    for (int j = 0; j < ways; ++j) {
        at[j].squared_n = shade_dot(at[j].normal, at[j].normal);
    }
    for (int j = 0; j < ways; ++j) {
        at[j].inverse_n = vector_inverse_sqrt(at[j].squared_n);
        if (kernel.geometry == BURNISH_SHADE_GENERAL) {
            shade_view(shader, &at[j]);
        }
    }
    for (int l = 0; l < shader->light_count; ++l) {
        for (int j = 0; j < ways; ++j) {
            if (kernel.geometry == BURNISH_SHADE_GENERAL) {
                shade_general_light(kernel, shader, &shader->lights[l], &at[j], &sums[j]);
            } else {
                shade_distant_light(kernel, shader, &shader->lights[l], &at[j], &sums[j]);
            }
            if (l == 0 && points->first_light) {
                const vf lit = vf_load(points->first_light + i + (size_t)j * LANES);
                shade_lessen_first(shader, kernel.output, lit, &sums[j]);
            }
        }
    }
    for (int j = 0; j < ways; ++j) {
        for (int k = 0; k < kernel.channels; ++k) {
            vf diffuse = sums[j].diffuse[k];
            if (points->diffuse[0]) {
                diffuse = vf_mul(diffuse, vf_load(points->diffuse[k] + i + (size_t)j * LANES));
            }
            color[j][k] = vf_add(diffuse, sums[j].specular[k]);
            if (kernel.output == BURNISH_SHADE_FLOAT) {
                /* a NaN has other bits on other processors */
                color[j][k] = vf_max(color[j][k], vf_set(0.0f));
            }
        }
    }
}

/* Whether the vector of points at i has the bits of the vector before: flat faces have. */
BURNISH_INLINE int shade_repeats(const float *const normal[3], size_t i) {
    vm same = vi_equal(vf_bits(vf_load(normal[0] + i)), vf_bits(vf_load(normal[0] + i - LANES)));
    for (int k = 1; k < 3; ++k) {
        same = vm_and(same, vi_equal(vf_bits(vf_load(normal[k] + i)),
                                     vf_bits(vf_load(normal[k] + i - LANES))));
    }
    return !vm_any(vm_not(same));
}

/* Colours in [0, 255] to pixels. Adding 2^23 rounds to a whole number in the lowest bits; the
 * exponent's bits fall out by the shifts, or under the alpha. */
BURNISH_INLINE vi shade_pack(const vf color[3]) {
    vi bits[3];
    for (int k = 0; k < 3; ++k) {
        bits[k] = vf_bits(vf_add(vf_min(color[k], vf_set(255.0f)), vf_set(0x1p23f)));
    }
    vi opaque = vi_or(bits[0], vi_set((int32_t)0xff000000u));
    return vi_or(vi_or(opaque, vi_shl(bits[1], 8)), vi_shl(bits[2], 16));
}

/* Fewer points than a vector has. */
BURNISH_INLINE void shade_rest(shade_kernel kernel, const burnish_kernels_shader *shader,
                               const burnish_kernels_points *points, size_t first, size_t count,
                               shade_colors colors) {
    enum { ARRAYS = 11 };
    float block[ARRAYS][LANES];
    const float *from[ARRAYS];
    uint8_t bytes[4 * LANES];
    burnish_kernels_points padded = *points;
    const float **to[ARRAYS] = {&padded.normal[0],   &padded.normal[1],   &padded.normal[2],
                                &padded.diffuse[0],  &padded.diffuse[1],  &padded.diffuse[2],
                                &padded.position[0], &padded.position[1], &padded.position[2],
                                &padded.w,           &padded.first_light};
    memset(block, 0, sizeof block);
    for (int k = 0; k < ARRAYS; ++k) {
        from[k] = *to[k];
        if (from[k]) {
            memcpy(block[k], from[k] + first, count * sizeof(float));
            *to[k] = block[k];
        }
    }
    vf color[1][3];
    shade_points(kernel, 1, shader, &padded, 0, color);
    if (kernel.output == BURNISH_SHADE_RGBA8) {
        vi_store_le_bytes(bytes, shade_pack(color[0]));
        memcpy(colors.rgba + 4 * first, bytes, 4 * count);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        vf_store(block[k], color[0][k]);
        memcpy(colors.rgb[k] + first, block[k], count * sizeof(float));
    }
}

/* Shades `ways` vectors from i on, or repeats the last colour. */
BURNISH_INLINE void shade_some(shade_kernel kernel, int ways,
                               const burnish_kernels_shader *restrict shader,
                               const burnish_kernels_points *restrict points, size_t i,
                               vf (*color)[3], shade_colors colors) {
    int repeats = i > 0 && kernel.geometry == BURNISH_SHADE_DISTANT && !points->diffuse[0] &&
                  !points->first_light;
    for (int j = 0; j < ways && repeats; ++j) {
        repeats = shade_repeats(points->normal, i + (size_t)j * LANES);
    }
    if (!repeats) {
        shade_points(kernel, ways, shader, points, i, color);
    }
    for (int j = 0; j < ways; ++j) {
        vf *const of = repeats ? color[ways - 1] : color[j];
        if (kernel.output == BURNISH_SHADE_RGBA8) {
            vi_store_le_bytes(colors.rgba + 4 * (i + (size_t)j * LANES), shade_pack(of));
        }
        for (int k = 0; k < 3 && kernel.output == BURNISH_SHADE_FLOAT; ++k) {
            vf_store(colors.rgb[k] + i + (size_t)j * LANES, of[k]);
        }
    }
}

BURNISH_INLINE void shade_array(shade_kernel kernel, const burnish_kernels_shader *restrict shader,
                                const burnish_kernels_points *restrict points, size_t count,
                                shade_colors colors) {
    enum { PAIR = SHADE_WAYS * LANES };
    size_t i = 0;
    vf color[SHADE_WAYS][3];
    for (; i + PAIR <= count; i += PAIR) {
        shade_some(kernel, SHADE_WAYS, shader, points, i, color, colors);
    }
    for (; i + LANES <= count; i += LANES) {
        shade_some(kernel, 1, shader, points, i, color + SHADE_WAYS - 1, colors);
    }
    if (i < count) {
        shade_rest(kernel, shader, points, i, count - i, colors);
    }
}

/* ---- The kernels ---- */

#define SHADE_FUNCTION(name, body, geometry, output)                                               \
    static __attribute__((unused)) void name(const burnish_kernels_shader *restrict shader,        \
                                             const burnish_kernels_points *restrict points,        \
                                             size_t count, uint8_t *restrict rgba,                 \
                                             float *const rgb[3]) {                                \
        const shade_kernel kernel = {body, geometry, output, 3};                                   \
        shade_array(kernel, shader, points, count, (shade_colors){rgba, rgb});                     \
    }
#define SHADE_FUNCTIONS(name, body)                                                                \
    SHADE_FUNCTION(shade_##name##_distant_rgba8, body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_RGBA8) \
    SHADE_FUNCTION(shade_##name##_distant_float, body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT) \
    SHADE_FUNCTION(shade_##name##_general_rgba8, body, BURNISH_SHADE_GENERAL, BURNISH_SHADE_RGBA8) \
    SHADE_FUNCTION(shade_##name##_general_float, body, BURNISH_SHADE_GENERAL, BURNISH_SHADE_FLOAT)

SHADE_FUNCTIONS(none, BURNISH_LOBE_BODY_NONE)
SHADE_FUNCTIONS(square, BURNISH_LOBE_BODY_SQUARE)
SHADE_FUNCTIONS(squares, BURNISH_LOBE_BODY_SQUARES)
SHADE_FUNCTIONS(power, BURNISH_LOBE_BODY_POWER)
SHADE_FUNCTIONS(multiply, BURNISH_LOBE_BODY_MULTIPLY)
SHADE_FUNCTIONS(schlick, BURNISH_LOBE_BODY_SCHLICK)
SHADE_FUNCTIONS(gaussian, BURNISH_LOBE_BODY_GAUSSIAN)
SHADE_FUNCTIONS(gx, BURNISH_LOBE_BODY_GX)
SHADE_FUNCTIONS(composite, BURNISH_LOBE_BODY_COMPOSITE)
#undef SHADE_FUNCTIONS
#undef SHADE_FUNCTION

#endif
