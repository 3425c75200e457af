/* Masks of materials: decided once a point, or for each sample of a pixel. */
#include <string.h>

#include "render/texture.h"

static void fill(float *to, int count, float value) {
    for (int i = 0; i < count; ++i) {
        to[i] = value;
    }
}

void burnish_masks_begin(const burnish_texturing *texturing, const uint16_t *samples, int count,
                         burnish_texture_scratch *scratch) {
    const float step = 1.0f / BURNISH_SUBPIXELS;
    float *right = scratch->points[BURNISH_TEXTURE_SHIFT_X];
    float *up = scratch->points[BURNISH_TEXTURE_SHIFT_Y];
    burnish_sample_mean mean = {0, 0, 0};
    unsigned bits = 0;
    scratch->has_shifts = samples && texturing->smooth_samples;
    if (!scratch->has_shifts) {
        return;
    }
    for (int i = 0; i < count; ++i) {
        if (samples[i] != bits) {
            bits = samples[i];
            mean = burnish_mean_of_samples(texturing->smooth_samples, bits);
        }
        right[i] = (float)mean.x * step;
        up[i] = (float)-mean.y * step;
    }
    for (int i = count; i < BURNISH_TEXTURE_BATCH; ++i) { /* whole vectors are read */
        right[i] = up[i] = 0;
    }
    for (int s = 0; s < texturing->smooth_samples; ++s) {
        fill(scratch->covers[s], count, 1.0f);
    }
}

void burnish_masks_color(const burnish_textured_material *material, const burnish_isa_ops *ops,
                         const float *const *streams, int count, burnish_texture_scratch *scratch) {
    enum { ALL = 15 };
    burnish_texture_sampler filtered = material->samplers[BURNISH_TEXTURE_COLOR];
    float *const out[4] = {scratch->sample[0], scratch->sample[1], scratch->sample[2],
                           scratch->sample[3]};
    int is_any = 0;
    if (!material->is_smooth || !scratch->has_shifts || !filtered.is_nearest) {
        return;
    }
    for (int i = 0; i < count; ++i) {
        is_any |= scratch->opacity[i] < material->mask_alpha;
    }
    if (!is_any) {
        return;
    }
    filtered.is_nearest = 0;
    ops->find_taps(&filtered, streams, (size_t)count, &scratch->taps);
    ops->sample_texture(filtered.levels, &scratch->taps, ALL, (size_t)count, out);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            scratch->diffuse[k][i] = scratch->opacity[i] < material->mask_alpha
                                         ? scratch->sample[k][i]
                                         : scratch->diffuse[k][i];
        }
    }
    ops->find_taps(&material->samplers[BURNISH_TEXTURE_COLOR], streams, (size_t)count,
                   &scratch->taps);
}

void burnish_masks_apply(const burnish_texturing *texturing,
                         const burnish_textured_material *material, const burnish_isa_ops *ops,
                         const float *const *streams, int count, burnish_texture_scratch *scratch) {
    const burnish_texture_sampler *sampler = &material->samplers[BURNISH_TEXTURE_COLOR];
    const burnish_mask mask = {1 - material->material.transparency, material->material.alpha_cutoff,
                               material->mask_alpha, texturing->smooth_samples};
    if (material->is_smooth && scratch->has_shifts) {
        ops->cover_samples(sampler, &mask, &scratch->taps, streams, (size_t)count, scratch->opacity,
                           scratch->cover);
        fill(scratch->opacity, count, 1.0f);
        return;
    }
    for (int i = 0; i < count; ++i) {
        scratch->opacity[i] = mask.solid * scratch->opacity[i] >= mask.cutoff ? 1.0f : 0.0f;
    }
}
