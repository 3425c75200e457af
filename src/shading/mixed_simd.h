/* The lighting equation over vectors of points of several materials, for directional lights and a
 * distant viewer where all lobes are the family's of one order, or composites with as many
 * products. A point's sums have the order of shade_simd.h, so they have the bits of its own
 * material's kernel. */
#ifndef BURNISH_SHADING_MIXED_SIMD_H
#define BURNISH_SHADING_MIXED_SIMD_H

#include "shading/shade_simd.h"

/* The materials of a vector of points, and the points of each. */
typedef struct mixed_materials {
    int count;
    int is_alike; /* 1: they have one lobe and specular colour; known where it is compiled */
    const burnish_kernels_shader *shaders[LANES];
    vm lanes[LANES];
} mixed_materials;

/* A light's constants for each point. */
typedef struct mixed_light {
    vf half[3], diffuse[3], specular[3];
} mixed_light;

BURNISH_INLINE void mixed_find(const burnish_kernels_shader *shaders, const int32_t *materials,
                               mixed_materials *mixed) {
    const vi all = vi_load(materials);
    unsigned rest = (unsigned)((1ull << LANES) - 1);
    mixed->count = 0;
    while (rest) {
        const int32_t material = materials[__builtin_ctz(rest)];
        const vm here = vi_equal(all, vi_set(material));
        mixed->shaders[mixed->count] = &shaders[material];
        mixed->lanes[mixed->count++] = here;
        rest &= ~vm_bits(here);
    }
}

/* The lobes of a vector of points, as shaders have them. */
typedef struct mixed_lobes {
    int squarings;
    vf at_zero;        /* base at cosine 0 */
    vf top, offset[4]; /* of composites */
} mixed_lobes;

/* The constant of material j where it is shown. */
BURNISH_INLINE vf mixed_put(const mixed_materials *mixed, int j, float constant, vf others) {
    return LANES == 1 || j == 0 ? vf_set(constant)
                                : vf_blend(mixed->lanes[j], vf_set(constant), others);
}

BURNISH_INLINE void mixed_load_light(const mixed_materials *mixed, int l, mixed_light *light) {
    const int output = BURNISH_SHADE_FLOAT;
    for (int j = 0; j < mixed->count; ++j) {
        const burnish_light_constants *of = &mixed->shaders[j]->lights[l];
        for (int k = 0; k < 3; ++k) {
            light->diffuse[k] = mixed_put(mixed, j, of->diffuse[output][k], light->diffuse[k]);
            if (mixed->is_alike && j > 0) {
                continue;
            }
            light->half[k] = mixed_put(mixed, j, of->half[k], light->half[k]);
            light->specular[k] = mixed_put(mixed, j, of->specular[output][k], light->specular[k]);
        }
    }
}

/* A material without a highlight has any lobe. */
BURNISH_INLINE void mixed_load_lobes(int body, const mixed_materials *mixed, mixed_lobes *lobes) {
    for (int j = 0; j < (mixed->is_alike ? 1 : mixed->count); ++j) {
        const burnish_lobe_constants *of = &mixed->shaders[j]->lobe;
        lobes->squarings =
            j == 0 || of->squarings > lobes->squarings ? of->squarings : lobes->squarings;
        lobes->at_zero = mixed_put(mixed, j, mixed->shaders[j]->offset, lobes->at_zero);
        lobes->top = j == 0 ? lobe_top(body, of) : lobes->top;
        for (int k = 0; k < 4 && body == BURNISH_LOBE_BODY_COMPOSITE; ++k) {
            lobes->top = mixed_put(mixed, j, of->top, lobes->top);
            lobes->offset[k] = mixed_put(mixed, j, of->offset[k], lobes->offset[k]);
        }
    }
}

/* As lobe_of_base. */
BURNISH_INLINE vf mixed_of_base(int body, const mixed_lobes *lobes, vf u) {
    u = vf_mul(u, u);
    for (int k = 1; body != BURNISH_LOBE_BODY_SQUARE && k < lobes->squarings; ++k) {
        u = vf_mul(u, body == BURNISH_LOBE_BODY_COMPOSITE ? vf_add(u, lobes->offset[k - 1]) : u);
    }
    return u;
}

/* Adds a light of one direction. */
BURNISH_INLINE void mixed_add(int body, const mixed_materials *mixed, int l,
                              const mixed_lobes *lobes, const vf normal[3], vf inverse_n,
                              shade_sums *sums) {
    const burnish_kernels_shader *first = mixed->shaders[0];
    const vf zero = vf_set(0.0f);
    mixed_light light;
    mixed_load_light(mixed, l, &light);
    const vf n_dot_l =
        vf_max(vf_mul(shade_dot_constant(normal, first->lights[l].vector), inverse_n), zero);
    const vf u = vf_add(vf_mul(shade_dot(normal, light.half), inverse_n), lobes->at_zero);
    const vm shines = vm_and(vf_greater(n_dot_l, zero), vf_greater(u, zero));
    for (int k = 0; k < 3; ++k) {
        sums->diffuse[k] = vf_add(sums->diffuse[k], vf_mul(n_dot_l, light.diffuse[k]));
    }
    if (vm_any(shines)) {
        const vf lobe = mixed_of_base(body, lobes, vf_and_mask(shines, vf_min(u, lobes->top)));
        for (int k = 0; k < 3; ++k) {
            sums->specular[k] = vf_add(sums->specular[k], vf_mul(lobe, light.specular[k]));
        }
    }
}

BURNISH_INLINE void mixed_array(int body, int is_alike, const burnish_kernels_shader *shaders,
                                const int32_t *materials, const burnish_kernels_points *points,
                                size_t count, float *const rgb[3]) {
    for (size_t i = 0; i < count; i += LANES) {
        mixed_materials mixed;
        shade_sums sums;
        vf normal[3];
        mixed_lobes lobes;
        mixed.is_alike = is_alike;
        mixed_find(shaders, materials + i, &mixed);
        mixed_load_lobes(body, &mixed, &lobes);
        for (int k = 0; k < 3; ++k) {
            normal[k] = vf_load(points->normal[k] + i);
            sums.specular[k] = vf_set(0.0f);
        }
        for (int j = 0; j < mixed.count; ++j) {
            for (int k = 0; k < 3; ++k) {
                const float ambient = mixed.shaders[j]->ambient[BURNISH_SHADE_FLOAT][k];
                sums.diffuse[k] = mixed_put(&mixed, j, ambient, sums.diffuse[k]);
            }
        }
        const vf inverse_n = vector_inverse_sqrt(shade_dot(normal, normal));
        for (int l = 0; l < shaders->light_count; ++l) {
            mixed_add(body, &mixed, l, &lobes, normal, inverse_n, &sums);
        }
        for (int k = 0; k < 3; ++k) {
            if (points->diffuse[0]) {
                sums.diffuse[k] = vf_mul(sums.diffuse[k], vf_load(points->diffuse[k] + i));
            }
            vf_store(rgb[k] + i, vf_max(vf_add(sums.diffuse[k], sums.specular[k]), vf_set(0.0f)));
        }
    }
}

#define MIXED_FUNCTION(name, body, is_alike)                                                       \
    static void mixed_##name(const burnish_kernels_shader *shaders, const int32_t *materials,      \
                             const burnish_kernels_points *points, size_t count,                   \
                             float *const rgb[3]) {                                                \
        mixed_array(body, is_alike, shaders, materials, points, count, rgb);                       \
    }
MIXED_FUNCTION(square, BURNISH_LOBE_BODY_SQUARE, 0)
MIXED_FUNCTION(squares, BURNISH_LOBE_BODY_SQUARES, 0)
MIXED_FUNCTION(square_alike, BURNISH_LOBE_BODY_SQUARE, 1)
MIXED_FUNCTION(squares_alike, BURNISH_LOBE_BODY_SQUARES, 1)
MIXED_FUNCTION(composite, BURNISH_LOBE_BODY_COMPOSITE, 0)
MIXED_FUNCTION(composite_alike, BURNISH_LOBE_BODY_COMPOSITE, 1)
#undef MIXED_FUNCTION

#endif
