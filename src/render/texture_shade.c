/* The light of points whose material has textures. */
#include <string.h>

#include "render/texture.h"

static int padded_count(int count) {
    return (count + 15) / 16 * 16;
}

/* Whether points lie at the same texels in both. */
static int same_taps(const burnish_texture_sampler *a, const burnish_texture_sampler *b) {
    return a->levels->width[0] == b->levels->width[0] &&
           a->levels->height[0] == b->levels->height[0] && a->wrap[0] == b->wrap[0] &&
           a->wrap[1] == b->wrap[1] && a->is_nearest == b->is_nearest &&
           memcmp(a->transform, b->transform, sizeof a->transform) == 0;
}

/* Samples a slot into scratch->sample; returns 0 where the material has no such texture. */
static int sample(const burnish_textured_material *material, int slot, const burnish_isa_ops *ops,
                  const float *const *streams, int count, burnish_texture_scratch *scratch) {
    const burnish_texture_sampler *sampler = &material->samplers[slot];
    float *const out[4] = {scratch->sample[0], scratch->sample[1], scratch->sample[2],
                           scratch->sample[3]};
    if (!sampler->levels) {
        return 0;
    }
    if (!scratch->taps_of || !same_taps(sampler, scratch->taps_of)) {
        ops->find_taps(sampler, streams, (size_t)count, &scratch->taps);
        scratch->taps_of = sampler;
    }
    ops->sample_texture(sampler->levels, &scratch->taps, (size_t)count, out);
    return 1;
}

static void fill(float *to, int count, float value) {
    for (int i = 0; i < count; ++i) {
        to[i] = value;
    }
}

/* The colour of points, vertex colours included, in scratch->diffuse; opacity as far as colour and
 * opacity textures say. */
static void find_color(const burnish_textured_material *material, const burnish_isa_ops *ops,
                       const burnish_kernels_points *points, const float *const *streams, int count,
                       burnish_texture_scratch *scratch) {
    const int has_color = sample(material, BURNISH_TEXTURE_COLOR, ops, streams, count, scratch);
    const int takes_alpha = material->material.alpha_mode != BURNISH_ALPHA_IGNORE;
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            scratch->diffuse[k][i] = (has_color ? scratch->sample[k][i] : 1.0f) *
                                     (points->diffuse[k] ? points->diffuse[k][i] : 1.0f);
        }
    }
    for (int i = 0; i < count; ++i) {
        scratch->opacity[i] = has_color && takes_alpha ? scratch->sample[3][i] : 1.0f;
    }
    if (takes_alpha && sample(material, BURNISH_TEXTURE_OPACITY, ops, streams, count, scratch)) {
        for (int i = 0; i < count; ++i) {
            scratch->opacity[i] *= scratch->sample[0][i];
        }
    }
    const float solid = 1 - material->material.transparency;
    for (int i = 0; i < count && material->material.alpha_mode == BURNISH_ALPHA_MASK; ++i) {
        scratch->opacity[i] =
            solid * scratch->opacity[i] >= material->material.alpha_cutoff ? 1.0f : 0.0f;
    }
}

/* Normals as the texture turns them, in scratch->normal, and how much mean normals are shorter than
 * 1 in scratch->length. */
static void turn_normals(const burnish_textured_material *material, const burnish_isa_ops *ops,
                         const burnish_kernels_points *points, const float *const *streams,
                         int count, burnish_texture_scratch *scratch) {
    const float *const from[4] = {scratch->sample[0], scratch->sample[1], scratch->sample[2],
                                  scratch->sample[3]};
    float *const to[4] = {scratch->normal[0], scratch->normal[1], scratch->normal[2],
                          scratch->length};
    sample(material, BURNISH_TEXTURE_NORMAL, ops, streams, count, scratch);
    ops->turn_normals(material->material.textures[BURNISH_TEXTURE_NORMAL].strength, points->normal,
                      streams + BURNISH_TEXTURE_TANGENT, from, (size_t)count, to);
}

/* ---- Coefficients of each point ---- */

/* Metal's parameters become coefficients: shading.h has the formulas. */
static void set_metallic(const burnish_textured_material *material, const burnish_isa_ops *ops,
                         const float *const *streams, int count, burnish_texture_scratch *scratch) {
    const burnish_material *from = &material->material;
    const int has_sample =
        sample(material, BURNISH_TEXTURE_METALLIC_ROUGHNESS, ops, streams, count, scratch);
    for (int i = 0; i < count; ++i) {
        const float roughness = from->roughness * (has_sample ? scratch->sample[1][i] : 1.0f);
        const float metallic = from->metallic * (has_sample ? scratch->sample[2][i] : 1.0f);
        const float squared = roughness * roughness, alpha2 = squared * squared;
        const float wanted = 2.0f / (alpha2 > 0x1p-20f ? alpha2 : 0x1p-20f) - 2.0f;
        const float n = wanted > 1.0f ? wanted < 65536.0f ? wanted : 65536.0f : 1.0f;
        scratch->exponent[i] = n;
        for (int k = 0; k < 3; ++k) {
            const float base = from->diffuse[k] * scratch->diffuse[k][i];
            scratch->ambient[k][i] = base;
            scratch->specular[k][i] = from->reflectance[k] * (1.0f - metallic) + base * metallic;
            scratch->diffuse[k][i] = base * (1.0f - metallic);
        }
    }
}

/* Phong's coefficients times what textures say. */
static void set_phong(const burnish_textured_material *material, const burnish_isa_ops *ops,
                      const float *const *streams, int count, burnish_texture_scratch *scratch) {
    const burnish_material *from = &material->material;
    const int has_specular =
        sample(material, BURNISH_TEXTURE_SPECULAR, ops, streams, count, scratch);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            const float color = scratch->diffuse[k][i];
            scratch->ambient[k][i] = from->ambient[k] * color;
            scratch->diffuse[k][i] = from->diffuse[k] * color;
            scratch->specular[k][i] =
                from->specular[k] * (has_specular ? scratch->sample[k][i] : 1.0f);
        }
    }
    fill(scratch->exponent, count, from->exponent);
    if (sample(material, BURNISH_TEXTURE_EXPONENT, ops, streams, count, scratch)) {
        for (int i = 0; i < count; ++i) {
            const float n = from->exponent * scratch->sample[0][i];
            scratch->exponent[i] = n > 1.0f ? n : 1.0f;
        }
    }
}

/* Normals that differ within a pixel widen its lobe (Toksvig 2005): n l / (l + n (1 - l)). A wide
 * lobe of metal's parameters is lower, so that it reflects as much, and none higher than 1, as
 * glTF's reader has it for materials without textures. */
static void widen_lobes(const burnish_textured_material *material, int count,
                        burnish_texture_scratch *scratch) {
    for (int i = 0; i < count; ++i) {
        float n = scratch->exponent[i];
        if (material->has_normals) {
            const float l = scratch->length[i];
            n = n * l / (l + n * (1.0f - l));
            n = n > 1.0f ? n : 1.0f;
        }
        const float factor = material->material.is_metallic ? (n + 2.0f) * 0.125f
                             : material->has_normals ? (n + 1.0f) / (scratch->exponent[i] + 1.0f)
                                                     : 1.0f;
        scratch->exponent[i] = n;
        for (int k = 0; k < 3; ++k) {
            const float specular = scratch->specular[k][i] * factor;
            scratch->specular[k][i] =
                material->material.is_metallic && specular > 1.0f ? 1.0f : specular;
        }
    }
}

/* What of the ambient light arrives. */
static void occlude(const burnish_textured_material *material, const burnish_isa_ops *ops,
                    const float *const *streams, int count, burnish_texture_scratch *scratch) {
    const float strength = material->material.textures[BURNISH_TEXTURE_OCCLUSION].strength;
    if (!sample(material, BURNISH_TEXTURE_OCCLUSION, ops, streams, count, scratch)) {
        return;
    }
    for (int i = 0; i < count; ++i) {
        const float open = 1.0f + strength * (scratch->sample[0][i] - 1.0f);
        for (int k = 0; k < 3; ++k) {
            scratch->ambient[k][i] *= open > 0.0f ? open : 0.0f;
        }
    }
}

static void shade_varied(const burnish_texturing *texturing, const burnish_isa_ops *ops,
                         const burnish_textured_material *material,
                         const burnish_kernels_points *points, const float *const *streams,
                         int count, burnish_texture_scratch *scratch, float *const rgb[3]) {
    burnish_kernels_points turned = *points;
    burnish_point_materials each = {.exponent = scratch->exponent,
                                    .slopes = texturing->slopes,
                                    .scales = texturing->scales,
                                    .least_exponent = texturing->least_exponent};
    if (material->material.is_metallic) {
        set_metallic(material, ops, streams, count, scratch);
    } else {
        set_phong(material, ops, streams, count, scratch);
    }
    if (material->has_normals) {
        turn_normals(material, ops, points, streams, count, scratch);
    }
    widen_lobes(material, count, scratch);
    occlude(material, ops, streams, count, scratch);
    for (int k = 0; k < 3; ++k) {
        each.ambient[k] = scratch->ambient[k];
        each.diffuse[k] = scratch->diffuse[k];
        each.specular[k] = scratch->specular[k];
        turned.normal[k] = material->has_normals ? scratch->normal[k] : points->normal[k];
    }
    ops->shade_each[texturing->white.lobe.body](&texturing->white, &turned, &each, (size_t)count,
                                                rgb);
}

static void add_emissive(const burnish_textured_material *material, const burnish_isa_ops *ops,
                         const float *const *streams, int count, burnish_texture_scratch *scratch,
                         float *const rgb[3]) {
    const float *emissive = material->material.emissive;
    if (!(emissive[0] > 0 || emissive[1] > 0 || emissive[2] > 0)) {
        return;
    }
    const int has_sample = sample(material, BURNISH_TEXTURE_EMISSIVE, ops, streams, count, scratch);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            rgb[k][i] += emissive[k] * (has_sample ? scratch->sample[k][i] : 1.0f);
        }
    }
}

void burnish_texture_shade(const burnish_texturing *texturing, const burnish_isa_ops *ops,
                           const burnish_kernels_shader *shader, int number,
                           const burnish_kernels_points *points, const float *const *streams,
                           int count, burnish_texture_scratch *scratch, float *const rgb[3]) {
    const burnish_textured_material *material = &texturing->materials[number];
    const int all = padded_count(count); /* arrays are readable up to there */
    scratch->taps_of = NULL;
    find_color(material, ops, points, streams, all, scratch);
    if (!rgb) {
        return;
    }
    if (material->is_varied) {
        shade_varied(texturing, ops, material, points, streams, all, scratch, rgb);
    } else {
        burnish_kernels_points colored = *points;
        for (int k = 0; k < 3; ++k) {
            colored.diffuse[k] = scratch->diffuse[k];
        }
        ops->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_FLOAT](
            shader, &colored, (size_t)count, NULL, rgb);
    }
    add_emissive(material, ops, streams, count, scratch, rgb);
}
