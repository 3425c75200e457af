/* The light of points whose material has textures. */
#include "render/texture/texture.h"

#include <string.h>

/* Whether both look up the same texels. */
static int same_taps(const burnish_texture_sampler *a, const burnish_texture_sampler *b) {
    return a->coordinates == b->coordinates && a->levels->width[0] == b->levels->width[0] &&
           a->levels->height[0] == b->levels->height[0] && a->wrap[0] == b->wrap[0] &&
           a->wrap[1] == b->wrap[1] && a->is_nearest == b->is_nearest &&
           a->has_transform == b->has_transform &&
           memcmp(a->transform, b->transform, sizeof a->transform) == 0;
}

/* Channels by their bits. */
enum { RED = 1, GREEN_BLUE = 6, COLOR = 7, ALL = 15 };

/* Samples a slot; may also write other channels. Returns 0 if the material has
 * no such texture. */
static int sample_into(const burnish_texture_batch *batch, int slot, unsigned channels,
                       float *const out[4]) {
    const burnish_texture_sampler *sampler = &batch->material->samplers[slot];
    burnish_texture_scratch *scratch = batch->scratch;
    const size_t count = (size_t)batch->count;
    if (!sampler->levels) {
        return 0;
    }
    if (!scratch->taps_of || !same_taps(sampler, scratch->taps_of)) {
        batch->ops->find_taps(sampler, batch->streams[sampler->coordinates], count, &scratch->taps);
        scratch->taps_of = sampler;
    }
    burnish_texture_levels_need(sampler->levels, &scratch->taps.box, scratch->taps.level[0].upper,
                                count);
    batch->ops->sample_texture(sampler->levels, &scratch->taps, channels, count, out);
    return 1;
}

/* The same into scratch->sample. */
static int sample_slot(const burnish_texture_batch *batch, int slot, unsigned channels) {
    float(*const to)[BURNISH_TEXTURE_BATCH] = batch->scratch->sample;
    return sample_into(batch, slot, channels, (float *const[]){to[0], to[1], to[2], to[3]});
}

/* The colour of points, vertex colours included, in scratch->diffuse; opacity as far as colour and
 * opacity textures say. */
static void find_color(const burnish_texture_batch *batch, const burnish_kernels_points *points) {
    burnish_texture_scratch *scratch = batch->scratch;
    const int count = batch->count;
    const int takes_alpha = batch->material->material.alpha_mode != BURNISH_ALPHA_IGNORE;
    float *const out[4] = {scratch->diffuse[0], scratch->diffuse[1], scratch->diffuse[2],
                           scratch->opacity};
    const int has_color = sample_into(batch, BURNISH_TEXTURE_COLOR, takes_alpha ? ALL : COLOR, out);
    burnish_masks_color(batch);
    for (int k = 0; k < 3; ++k) {
        if (!has_color) {
            burnish_texture_fill(scratch->diffuse[k], count, 1.0f);
        }
        for (int i = 0; points->diffuse[k] && i < count; ++i) {
            scratch->diffuse[k][i] *= points->diffuse[k][i];
        }
    }
    if (!has_color) {
        burnish_texture_fill(scratch->opacity, count, 1.0f);
    }
    if (takes_alpha && sample_slot(batch, BURNISH_TEXTURE_OPACITY, RED)) {
        for (int i = 0; i < count; ++i) {
            scratch->opacity[i] *= scratch->sample[0][i];
        }
    }
}

/* Normals as the texture turns them, in scratch->normal, and how much mean normals are shorter than
 * 1 in scratch->length. */
static void turn_normals(const burnish_texture_batch *batch, const burnish_kernels_points *points) {
    burnish_texture_scratch *scratch = batch->scratch;
    const float *const from[4] = {scratch->sample[0], scratch->sample[1], scratch->sample[2],
                                  scratch->sample[3]};
    float *const to[4] = {scratch->normal[0], scratch->normal[1], scratch->normal[2],
                          scratch->length};
    sample_slot(batch, BURNISH_TEXTURE_NORMAL, ALL);
    batch->ops->turn_normals(batch->material->material.textures[BURNISH_TEXTURE_NORMAL].strength,
                             points->normal, batch->streams[0] + BURNISH_TEXTURE_TANGENT, from,
                             (size_t)batch->count, to);
}

/* ---- Coefficients of each point ---- */

/* Samples what coefficients are made of; bit k: there is slot k. */
static unsigned sample_coefficients(const burnish_texture_batch *batch) {
    burnish_texture_scratch *scratch = batch->scratch;
    float(*const sample)[BURNISH_TEXTURE_BATCH] = scratch->sample;
    float(*const specular)[BURNISH_TEXTURE_BATCH] = scratch->specular;
    const struct {
        int slot;
        unsigned channels;
        float *out[4];
    } wanted[] = {
        {BURNISH_TEXTURE_OCCLUSION, RED, {scratch->open, sample[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_SPECULAR, COLOR, {specular[0], specular[1], specular[2], sample[3]}},
        {BURNISH_TEXTURE_SPECULAR_STRENGTH,
         RED,
         {scratch->edge_loss, sample[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_EXPONENT, RED, {scratch->exponent, sample[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_TRANSMISSION,
         RED,
         {scratch->transmission, sample[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_THICKNESS,
         GREEN_BLUE,
         {sample[0], scratch->thickness, sample[2], sample[3]}},
        {BURNISH_TEXTURE_IRIDESCENCE, RED, {scratch->film[0], sample[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_FILM, GREEN_BLUE, {sample[0], scratch->film[1], sample[2], sample[3]}},
        {BURNISH_TEXTURE_METALLIC_ROUGHNESS,
         GREEN_BLUE,
         {sample[0], sample[1], sample[2], sample[3]}}};
    unsigned sampled = 0;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; ++i) {
        const int is_metal = wanted[i].slot == BURNISH_TEXTURE_METALLIC_ROUGHNESS;
        const int is_phong = wanted[i].slot == BURNISH_TEXTURE_EXPONENT;
        if (!(batch->material->material.is_metallic ? is_phong : is_metal)) {
            sampled |=
                (unsigned)sample_into(batch, wanted[i].slot, wanted[i].channels, wanted[i].out)
                << wanted[i].slot;
        }
    }
    return sampled;
}

static void shade_varied(const burnish_texturing *texturing, const burnish_texture_batch *batch,
                         const burnish_kernels_points *points, float *const rgb[3]) {
    burnish_texture_scratch *scratch = batch->scratch;
    const int has_normals = batch->material->has_normals;
    burnish_kernels_points turned = *points;
    burnish_point_materials each = {.exponent = scratch->exponent,
                                    .slopes = texturing->slopes,
                                    .scales = texturing->scales,
                                    .least_exponent = texturing->least_exponent};
    if (has_normals) {
        turn_normals(batch, points);
    }
    for (int k = 0; k < 3; ++k) {
        turned.normal[k] = has_normals ? scratch->normal[k] : points->normal[k];
    }
    if (batch->material->material.iridescence > 0) {
        batch->ops->find_facing(&texturing->white, &turned, (size_t)batch->count, scratch->facing);
    }
    const unsigned wanted = (unsigned)(texturing->wants_reflectance | batch->material->passes)
                            << BURNISH_TEXTURE_REFLECTANCE;
    batch->ops->vary_points(batch->material, sample_coefficients(batch) | wanted,
                            (size_t)batch->count, scratch);
    for (int k = 0; k < 3; ++k) {
        each.ambient[k] = scratch->ambient[k];
        each.diffuse[k] = scratch->diffuse[k];
        each.specular[k] = scratch->specular[k];
    }
    if (texturing->wants_reflectance && batch->material->is_bent) {
        sample_slot(batch, BURNISH_TEXTURE_ANISOTROPY, ALL);
        batch->ops->bend_normals(&texturing->white, batch->material, &turned,
                                 batch->streams[0] + BURNISH_TEXTURE_TANGENT, (size_t)batch->count,
                                 scratch);
    }
    const int is_exact = texturing->lobe.by_material && batch->material->material.has_exponent;
    const int body = is_exact ? BURNISH_LOBE_BODY_POWER : texturing->white.lobe.body;
    texturing->kernels->shade_each[body](&texturing->white, &turned, &each, (size_t)batch->count,
                                         rgb);
}

static void add_emissive(const burnish_texture_batch *batch, int count, float *const rgb[3]) {
    const float *emissive = batch->material->material.emissive;
    if (!(emissive[0] > 0 || emissive[1] > 0 || emissive[2] > 0)) {
        return;
    }
    const int has_sample = sample_slot(batch, BURNISH_TEXTURE_EMISSIVE, COLOR);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            rgb[k][i] += emissive[k] * (has_sample ? batch->scratch->sample[k][i] : 1.0f);
        }
    }
}

void burnish_texture_shade(const burnish_texturing *texturing, const burnish_kernels_shader *shader,
                           const burnish_kernels_points *points, const burnish_texture_batch *given,
                           float *const rgb[3]) {
    burnish_texture_batch batch = *given;
    batch.count = burnish_texture_padded(given->count); /* arrays are readable up to there */
    batch.scratch->taps_of = NULL;
    find_color(&batch, points);
    if (batch.material->material.alpha_mode == BURNISH_ALPHA_MASK) {
        burnish_masks_apply(texturing, &batch);
    }
    if (!rgb) {
        return;
    }
    if (batch.material->is_varied) {
        shade_varied(texturing, &batch, points, rgb);
    } else {
        burnish_kernels_points colored = *points;
        for (int k = 0; k < 3; ++k) {
            colored.diffuse[k] = batch.scratch->diffuse[k];
        }
        texturing->kernels->shade[shader->lobe.body][shader->geometry][BURNISH_SHADE_FLOAT](
            shader, &colored, (size_t)given->count, NULL, rgb);
    }
    add_emissive(&batch, given->count, rgb);
    float(*const sheen)[BURNISH_TEXTURE_BATCH] = batch.scratch->sheen;
    float(*const other)[BURNISH_TEXTURE_BATCH] = batch.scratch->sample;
    sample_into(&batch, BURNISH_TEXTURE_SHEEN_COLOR, COLOR,
                (float *const[]){sheen[0], sheen[1], sheen[2], other[3]});
    sample_into(&batch, BURNISH_TEXTURE_SHEEN_ROUGHNESS, RED,
                (float *const[]){sheen[3], other[1], other[2], other[3]});
}
