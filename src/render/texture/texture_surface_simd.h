/* What samples of textures make of a surface: tangents, turned normals, coefficients of each point.
 */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_SURFACE_SIMD_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_SURFACE_SIMD_H

#include "render/texture/film_simd.h"
#include "render/texture/texture_points_simd.h"
#include "render/texture/texture_simd.h"

/* ---- Normals ---- */

BURNISH_INLINE void texture_normalize(vf v[3]) {
    const vf inverse = vector_inverse_sqrt(texture_dot(v, v));
    for (int k = 0; k < 3; ++k) {
        v[k] = vf_mul(v[k], inverse);
    }
}

/* Tangents by the weights of corners 1 and 2. */
static void interpolate_tangents(const burnish_mesh_view *mesh, const uint32_t *ids,
                                 const float *const weights[2], size_t count, float *const *out) {
    for (size_t i = 0; i < count; i += LANES) {
        const vf weight1 = vf_load(weights[0] + i), weight2 = vf_load(weights[1] + i);
        vf corners[3][4];
        float sides[LANES];
        for (int corner = 0; corner < 3; ++corner) {
            const void *from[LANES];
            for (size_t lane = 0; lane < LANES; ++lane) {
                const size_t triangle = ids[i + lane] >> 1;
                from[lane] =
                    mesh->tangents + 4 * (size_t)mesh->indices[3 * triangle + (size_t)corner];
            }
            vf_load_aos4(from, corners[corner]);
        }
        for (size_t lane = 0; lane < LANES; ++lane) { /* from its back all of the frame turns */
            sides[lane] = ids[i + lane] & 1 ? -1.0f : 1.0f;
        }
        const vf side = vf_load(sides);
        for (int k = 0; k < 3; ++k) {
            const vf a = corners[0][k];
            const vf along1 = vf_mul(weight1, vf_sub(corners[1][k], a));
            const vf along2 = vf_mul(weight2, vf_sub(corners[2][k], a));
            vf_store(out[k] + i, vf_mul(side, vf_add(vf_add(a, along1), along2)));
        }
        vf_store(out[3] + i, vf_mul(side, corners[0][3]));
    }
}

/* Unit vectors: the normal n, already normalised, the tangent at right angles to it, and the
 * bitangent. */
BURNISH_INLINE void texture_frame(const float *const *tangent, size_t i, const vf n[3], vf t[3],
                                  vf b[3]) {
    for (int k = 0; k < 3; ++k) {
        t[k] = vf_load(tangent[k] + i);
    }
    const vf along = texture_dot(n, t);
    for (int k = 0; k < 3; ++k) {
        t[k] = vf_sub(t[k], vf_mul(n[k], along));
    }
    texture_normalize(t);
    const vf sign = vf_load(tangent[3] + i);
    texture_cross(n, t, b);
    for (int k = 0; k < 3; ++k) {
        b[k] = vf_mul(sign, b[k]);
    }
}

static void turn_normals(float strength, const float *const normal[3], const float *const *tangent,
                         const float *const sample[4], size_t count, float *const out[4]) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f);
    for (size_t i = 0; i < count; i += LANES) {
        vf n[3], t[3], b[3], turned[3];
        for (int k = 0; k < 3; ++k) {
            n[k] = vf_load(normal[k] + i);
        }
        texture_normalize(n);
        texture_frame(tangent, i, n, t, b);
        const vf x = vf_mul(vf_sub(vf_mul(vf_load(sample[0] + i), two), one), vf_set(strength));
        const vf y = vf_mul(vf_sub(vf_mul(vf_load(sample[1] + i), two), one), vf_set(strength));
        const vf z = vf_sub(vf_mul(vf_load(sample[2] + i), two), one);
        for (int k = 0; k < 3; ++k) {
            turned[k] = vf_add(vf_add(vf_mul(x, t[k]), vf_mul(y, b[k])), vf_mul(z, n[k]));
        }
        texture_normalize(turned);
        for (int k = 0; k < 3; ++k) {
            vf_store(out[k] + i, turned[k]);
        }
        const vf missing = vf_sub(one, vf_load(sample[3] + i));
        vf_store(out[3] + i, vf_max(vf_sub(one, vf_mul(missing, missing)), vf_set(0.0f)));
    }
}

/* Unit vectors toward the outside and the viewer. */
BURNISH_INLINE void texture_vectors(const burnish_kernels_shader *view,
                                    const burnish_kernels_points *points, size_t i, vf normal[3],
                                    vf viewer[3]) {
    for (int k = 0; k < 3; ++k) {
        normal[k] = vf_load(points->normal[k] + i);
        viewer[k] = vf_set(view->viewer[k]);
        if (view->local_viewer) {
            viewer[k] =
                vf_sub(vf_mul(viewer[k], vf_load(points->w + i)), vf_load(points->position[k] + i));
        }
    }
    texture_normalize(normal);
    texture_normalize(viewer);
}

static void find_facing(const burnish_kernels_shader *view, const burnish_kernels_points *points,
                        size_t count, float *facing) {
    for (size_t i = 0; i < count; i += LANES) {
        vf n[3], v[3];
        texture_vectors(view, points, i, n, v);
        vf_store(facing + i, vector_saturate(texture_dot(n, v)));
    }
}

/* As KHR_materials_anisotropy's page and three.js do: the part of V at right angles to the direction
 * across is mixed with N, whose share is (1 - strength (1 - roughness))^4. */
static void bend_normals(const burnish_kernels_shader *view,
                         const burnish_textured_material *material,
                         const burnish_kernels_points *points, const float *const *tangent,
                         size_t count, burnish_texture_scratch *scratch) {
    const float *along = material->material.anisotropy;
    const vf one = vf_set(1.0f), two = vf_set(2.0f), least = vf_set(0x1p-40f);
    const vf turn[2] = {vf_set(along[0]), vf_set(along[1])};
    for (size_t i = 0; i < count; i += LANES) {
        vf n[3], v[3], t[3], b[3], across[3], bent[3], x = one, y = vf_set(0.0f), size = one;
        texture_vectors(view, points, i, n, v);
        texture_frame(tangent, i, n, t, b);
        if (material->samplers[BURNISH_TEXTURE_ANISOTROPY].levels) {
            x = vf_sub(vf_mul(vf_load(scratch->sample[0] + i), two), one);
            y = vf_sub(vf_mul(vf_load(scratch->sample[1] + i), two), one);
            const vf squared = vf_max(vf_add(vf_mul(x, x), vf_mul(y, y)), least);
            size = vf_mul(vf_load(scratch->sample[2] + i), vector_inverse_sqrt(squared));
        }
        const vf d[2] = {vf_mul(size, vf_sub(vf_mul(turn[0], x), vf_mul(turn[1], y))),
                         vf_mul(size, vf_add(vf_mul(turn[1], x), vf_mul(turn[0], y)))};
        const vf squared = vf_max(vf_add(vf_mul(d[0], d[0]), vf_mul(d[1], d[1])), least);
        const vf inverse = vector_inverse_sqrt(squared);
        const vf strength = vf_min(vf_mul(squared, inverse), one);
        for (int k = 0; k < 3; ++k) {
            across[k] = vf_mul(vf_sub(vf_mul(d[0], b[k]), vf_mul(d[1], t[k])), inverse);
        }
        const vf part = texture_dot(across, v);
        const vf smooth = vf_sub(one, vf_load(scratch->roughness + i));
        const vf rest = vf_sub(one, vf_mul(strength, smooth)), share = vf_mul(rest, rest);
        for (int k = 0; k < 3; ++k) {
            bent[k] = vf_sub(v[k], vf_mul(part, across[k]));
        }
        texture_normalize(bent);
        for (int k = 0; k < 3; ++k) {
            bent[k] = vf_add(bent[k], vf_mul(vf_mul(share, share), vf_sub(n[k], bent[k])));
        }
        texture_normalize(bent);
        for (int k = 0; k < 3; ++k) {
            vf_store(scratch->bent[k] + i, bent[k]);
        }
    }
}

/* ---- Coefficients ---- */

/* Coefficients of a vector of points. */
typedef struct texture_coefficients {
    vf ambient[3], diffuse[3], specular[3], exponent;
    vf roughness; /* METALLIC_ROUGHNESS's; 0 for Phong */
} texture_coefficients;

/* Mixes reflectances with those of the material's film. */
BURNISH_INLINE void texture_film(const burnish_material *from, unsigned sampled, size_t i,
                                 const burnish_texture_scratch *scratch, vf reflectance[3]) {
    const float *limits = from->film_thickness;
    vf share = vf_set(from->iridescence), thickness = vf_set(limits[1]), colored[3];
    if (sampled >> BURNISH_TEXTURE_IRIDESCENCE & 1) {
        share = vf_mul(share, vf_load(scratch->film[0] + i));
    }
    if (sampled >> BURNISH_TEXTURE_FILM & 1) {
        const vf part = vf_load(scratch->film[1] + i);
        thickness = vf_add(vf_set(limits[0]), vf_mul(part, vf_set(limits[1] - limits[0])));
    }
    film_reflectance(vf_load(scratch->facing + i), vf_set(from->film_index), thickness, reflectance,
                     colored);
    for (int k = 0; k < 3; ++k) {
        reflectance[k] = vf_add(reflectance[k], vf_mul(share, vf_sub(colored[k], reflectance[k])));
    }
}

/* Metal's parameters become coefficients: shading.h has the formulas. Of light that passes, the
 * share before Fresnel's stays in scratch, with and without the base colour. */
BURNISH_INLINE void texture_metal(const burnish_material *from, unsigned sampled, size_t i,
                                  burnish_texture_scratch *scratch, texture_coefficients *to) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f);
    vf roughness = vf_set(from->roughness), metallic = vf_set(from->metallic);
    if (sampled >> BURNISH_TEXTURE_METALLIC_ROUGHNESS & 1) {
        roughness = vf_mul(roughness, vf_load(scratch->sample[1] + i));
        metallic = vf_mul(metallic, vf_load(scratch->sample[2] + i));
    }
    to->roughness = roughness;
    const vf squared = vf_mul(roughness, roughness), alpha2 = vf_mul(squared, squared);
    const vf wanted = vf_sub(vf_div(two, vf_max(alpha2, vf_set(0x1p-20f))), two);
    to->exponent = vf_max(vf_min(wanted, vf_set(65536.0f)), one);
    vf passing = vf_set(from->transmission);
    if (sampled >> BURNISH_TEXTURE_TRANSMISSION & 1) {
        passing = vf_mul(passing, vf_load(scratch->transmission + i));
    }
    if (from->transmission > 0) {
        vf_store(scratch->transmission + i, vf_mul(passing, vf_sub(one, metallic)));
    }
    const vf rest = vf_sub(one, metallic);
    const int has_strength = sampled >> BURNISH_TEXTURE_SPECULAR_STRENGTH & 1;
    const vf strength = has_strength ? vf_load(scratch->edge_loss + i) : one;
    if (from->edge_loss > 0 || has_strength) {
        const vf f90 = vf_mul(vf_set(1 - from->edge_loss), strength);
        vf_store(scratch->edge_loss + i, vf_mul(vf_sub(one, f90), rest));
    }
    for (int k = 0; k < 3; ++k) {
        const vf base = vf_mul(vf_set(from->diffuse[k]), vf_load(scratch->diffuse[k] + i));
        to->ambient[k] = base;
        vf reflectance = vf_mul(vf_set(from->reflectance[k]), strength);
        if (sampled >> BURNISH_TEXTURE_SPECULAR & 1) {
            reflectance = vf_mul(reflectance, vf_load(scratch->specular[k] + i));
        }
        to->specular[k] = vf_add(vf_mul(reflectance, rest), vf_mul(base, metallic));
        to->diffuse[k] = vf_mul(base, rest);
        if (from->transmission > 0) {
            vf_store(scratch->passed[k] + i, vf_mul(to->diffuse[k], passing));
            to->diffuse[k] = vf_mul(to->diffuse[k], vf_sub(one, passing));
            to->ambient[k] = vf_mul(base, vf_sub(one, vf_mul(rest, passing)));
        }
    }
    if (from->iridescence > 0) {
        texture_film(from, sampled, i, scratch, to->specular);
    }
}

/* Phong's coefficients times what textures say. */
BURNISH_INLINE void texture_phong(const burnish_material *from, unsigned sampled, size_t i,
                                  const burnish_texture_scratch *scratch,
                                  texture_coefficients *to) {
    to->exponent = vf_set(from->exponent);
    to->roughness = vf_set(0.0f);
    if (sampled >> BURNISH_TEXTURE_EXPONENT & 1) {
        to->exponent = vf_max(vf_mul(to->exponent, vf_load(scratch->exponent + i)), vf_set(1.0f));
    }
    for (int k = 0; k < 3; ++k) {
        const vf color = vf_load(scratch->diffuse[k] + i);
        to->ambient[k] = vf_mul(vf_set(from->ambient[k]), color);
        to->diffuse[k] = vf_mul(vf_set(from->diffuse[k]), color);
        to->specular[k] = vf_set(from->specular[k]);
        if (sampled >> BURNISH_TEXTURE_SPECULAR & 1) {
            to->specular[k] = vf_mul(to->specular[k], vf_load(scratch->specular[k] + i));
        }
    }
}

/* Normals that differ within a pixel widen its lobe (Toksvig 2005): n l / (l + n (1 - l)). A wide
 * lobe of metal's parameters is lower, which keeps the reflected energy constant, and at most 1, as
 * in glTF's reader for materials without textures. */
BURNISH_INLINE void texture_widen(const burnish_textured_material *material, size_t i,
                                  const burnish_texture_scratch *scratch,
                                  texture_coefficients *to) {
    const vf one = vf_set(1.0f), before = to->exponent;
    const int is_metallic = material->material.is_metallic;
    if (material->has_normals) {
        const vf l = vf_load(scratch->length + i), n = before;
        to->exponent = vf_max(vf_div(vf_mul(n, l), vf_add(l, vf_mul(n, vf_sub(one, l)))), one);
    }
    if (!is_metallic && !material->has_normals) {
        return;
    }
    const vf factor = is_metallic ? vf_mul(vf_add(to->exponent, vf_set(2.0f)), vf_set(0.125f))
                                  : vf_div(vf_add(to->exponent, one), vf_add(before, one));
    for (int k = 0; k < 3; ++k) {
        const vf specular = vf_mul(to->specular[k], factor);
        to->specular[k] = is_metallic ? vf_min(one, specular) : specular;
    }
}

/* Square root of x > 0. */
BURNISH_INLINE vf texture_root(vf x) {
    return vf_mul(x, vector_inverse_sqrt(x));
}

/* What light from many directions is reflected by (burnish/light.h), of coefficients that are not
 * widened, and of the exponent that is. Of metallic-roughness parameters without their textures only
 * the specular colour varies. */
BURNISH_INLINE void texture_reflectance(const burnish_material *material, unsigned sampled,
                                        const texture_coefficients *from, vf widened, size_t i,
                                        burnish_texture_scratch *scratch) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f);
    const int is_metallic = material->is_metallic, has_roughness = burnish_has_roughness(material);
    const vf factor =
        is_metallic ? one : vf_div(vf_set(8.0f), vf_add(from->exponent, vf_set(4.0f)));
    const vf alpha = texture_root(vf_div(two, vf_add(widened, two)));
    for (int k = 0; k < 3; ++k) {
        vf reflectance = vf_mul(from->specular[k], factor);
        if (has_roughness && !is_metallic) {
            const float metal = material->ambient[k] * material->metallic;
            reflectance = vf_set(material->reflectance[k] * (1 - material->metallic) + metal);
            if (sampled >> BURNISH_TEXTURE_SPECULAR & 1) {
                reflectance = vf_mul(reflectance, vf_load(scratch->specular[k] + i));
            }
        }
        vf_store(scratch->reflectance[k] + i, vf_min(reflectance, one));
    }
    vf_store(scratch->roughness + i, vf_max(from->roughness, texture_root(alpha)));
}

static void vary_points(const burnish_textured_material *material, unsigned sampled, size_t count,
                        burnish_texture_scratch *scratch) {
    const vf one = vf_set(1.0f);
    const vf strength = vf_set(material->material.textures[BURNISH_TEXTURE_OCCLUSION].strength);
    for (size_t i = 0; i < count; i += LANES) {
        texture_coefficients to;
        if (material->material.is_metallic) {
            texture_metal(&material->material, sampled, i, scratch, &to);
        } else {
            texture_phong(&material->material, sampled, i, scratch, &to);
        }
        const texture_coefficients before = to;
        texture_widen(material, i, scratch, &to);
        if (sampled >> BURNISH_TEXTURE_REFLECTANCE & 1) {
            texture_reflectance(&material->material, sampled, &before, to.exponent, i, scratch);
        }
        if (sampled >> BURNISH_TEXTURE_OCCLUSION & 1) { /* what of the ambient light arrives */
            const vf hidden = vf_mul(strength, vf_sub(vf_load(scratch->open + i), one));
            const vf open = vf_max(vf_add(one, hidden), vf_set(0.0f));
            for (int k = 0; k < 3; ++k) {
                to.ambient[k] = vf_mul(to.ambient[k], open);
            }
            vf_store(scratch->open + i, open);
        }
        for (int k = 0; k < 3; ++k) {
            vf_store(scratch->ambient[k] + i, to.ambient[k]);
            vf_store(scratch->diffuse[k] + i, to.diffuse[k]);
            vf_store(scratch->specular[k] + i, to.specular[k]);
        }
        vf_store(scratch->exponent + i, to.exponent);
    }
}

#endif
