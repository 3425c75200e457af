/* Masks of materials: decided once a point, or for each sample of a pixel. */
#include "render/texture/texture.h"

#include <string.h>

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
        burnish_texture_fill(scratch->covers[s], count, 1.0f);
    }
}

void burnish_masks_color(const burnish_texture_batch *batch) {
    const burnish_textured_material *material = batch->material;
    burnish_texture_scratch *scratch = batch->scratch;
    const int count = batch->count;
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
    const float *const *streams = batch->streams[filtered.coordinates];
    batch->ops->find_taps(&filtered, streams, (size_t)count, &scratch->taps);
    batch->ops->sample_texture(filtered.levels, &scratch->taps, ALL, (size_t)count, out);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < count; ++i) {
            scratch->diffuse[k][i] = scratch->opacity[i] < material->mask_alpha
                                         ? scratch->sample[k][i]
                                         : scratch->diffuse[k][i];
        }
    }
    batch->ops->find_taps(&material->samplers[BURNISH_TEXTURE_COLOR], streams, (size_t)count,
                          &scratch->taps);
}

/* ---- Pixels larger than texels ---- */

/* A quarter of a pixel: its samples and their mean, 1/16 pixel. */
typedef struct quarter {
    int count;
    uint8_t samples[BURNISH_MAX_SAMPLES / 4];
    int8_t offsets[BURNISH_MAX_SAMPLES / 4][2];
    float x, y;
} quarter;

/* Each holds a quarter of every pattern (raster/raster_view.h). */
static quarter quarter_of(int samples, int number) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    quarter q = {0};
    int x = 0, y = 0;
    for (int s = 0; s < samples && q.count < BURNISH_MAX_SAMPLES / 4; ++s) {
        if ((offsets[s][0] < 0) + 2 * (offsets[s][1] < 0) == number) {
            q.samples[q.count] = (uint8_t)s;
            memcpy(q.offsets[q.count++], offsets[s], sizeof *q.offsets);
            x += offsets[s][0];
            y += offsets[s][1];
        }
    }
    q.x = (float)x / (float)(q.count * BURNISH_SAMPLE_STEP);
    q.y = (float)-y / (float)(q.count * BURNISH_SAMPLE_STEP);
    return q;
}

/* Points whose pixels are larger than texels and in part covered; returns how many. */
static int find_mixed(const burnish_texture_levels *levels, const burnish_texture_scratch *scratch,
                      int count, uint8_t *points) {
    const int32_t end = levels->count > 1 ? levels->offset[1] : INT32_MAX;
    int mixed = 0;
    for (int i = 0; i < count; ++i) {
        const int is_small = scratch->taps.share[i] > 0 || scratch->taps.level[0].upper[i] >= end;
        points[mixed] = (uint8_t)i;
        mixed += is_small && scratch->opacity[i] > 0 && scratch->opacity[i] < 1;
    }
    return mixed;
}

/* What the quarters of points need of them, one point after another; the rest of a vector is 0. */
static void collect_mixed(const float *const *streams, const uint8_t *points, int count,
                          float (*to)[BURNISH_TEXTURE_BATCH]) {
    const int all = burnish_texture_padded(count);
    for (int k = 0; k < BURNISH_TEXTURE_SECOND; ++k) {
        if (k < BURNISH_TEXTURE_TANGENT || k >= BURNISH_TEXTURE_SHIFT_X) {
            for (int j = 0; j < count; ++j) {
                to[k][j] = streams[k][points[j]];
            }
            memset(to[k] + count, 0, (size_t)(all - count) * sizeof *to[k]);
        }
    }
}

/* Texture coordinates of the quarters of pixels, whose sides are half as long. */
static void locate_quarters(const quarter *q, float (*from)[BURNISH_TEXTURE_BATCH], int count,
                            float (*to)[BURNISH_TEXTURE_BATCH]) {
    for (int k = 0; k < 2; ++k) {
        const float *along_x = from[BURNISH_TEXTURE_U_X + k],
                    *along_y = from[BURNISH_TEXTURE_U_Y + k];
        for (int j = 0; j < count; ++j) {
            const float right = q->x - from[BURNISH_TEXTURE_SHIFT_X][j];
            const float up = q->y - from[BURNISH_TEXTURE_SHIFT_Y][j];
            to[k][j] = from[k][j] + (right * along_x[j] + up * along_y[j]);
            to[BURNISH_TEXTURE_U_X + k][j] = 0.5f * along_x[j];
            to[BURNISH_TEXTURE_U_Y + k][j] = 0.5f * along_y[j];
        }
    }
    for (int j = 0; j < count; ++j) {
        to[BURNISH_TEXTURE_SHIFT_X][j] = q->x;
        to[BURNISH_TEXTURE_SHIFT_Y][j] = q->y;
    }
}

/* Each quarter of a pixel looks into its own level. It is the larger one of the two between which
 * the quarter lies: four of them make up for the smaller one. */
static void cover_quarters(const burnish_texture_batch *batch, const burnish_mask *of_pixel) {
    const burnish_texture_sampler *sampler = &batch->material->samplers[BURNISH_TEXTURE_COLOR];
    const burnish_render_ops *ops = batch->ops;
    burnish_texture_scratch *scratch = batch->scratch;
    enum { ALPHA = 8 };
    uint8_t points[BURNISH_TEXTURE_BATCH + 1];
    burnish_texture_sampler single = *sampler;
    float *const out[4] = {scratch->sample[0], scratch->sample[1], scratch->sample[2],
                           scratch->sample[3]};
    const float *at[BURNISH_TEXTURE_SECOND];
    const int mixed = find_mixed(sampler->levels, scratch, batch->count, points);
    for (int k = 0; k < BURNISH_TEXTURE_SECOND; ++k) {
        at[k] = scratch->at[k];
    }
    single.is_single = 1;
    collect_mixed(batch->streams[sampler->coordinates], points, mixed, scratch->mixed);
    for (int number = 0; mixed && number < 4; ++number) {
        const quarter q = quarter_of(of_pixel->samples, number);
        burnish_mask mask = *of_pixel;
        mask.samples = q.count;
        mask.offsets = q.offsets;
        mask.spread = 0.5f;
        locate_quarters(&q, scratch->mixed, burnish_texture_padded(mixed), scratch->at);
        ops->find_taps(&single, at, (size_t)mixed, &scratch->taps);
        ops->sample_texture(single.levels, &scratch->taps, ALPHA, (size_t)mixed, out);
        ops->cover_samples(&single, &mask, &scratch->taps, at, (size_t)mixed, scratch->sample[3],
                           scratch->part);
        for (int s = 0; s < q.count; ++s) {
            for (int j = 0; j < mixed; ++j) {
                scratch->cover[q.samples[s]][points[j]] = scratch->part[s][j];
            }
        }
        scratch->taps_of = NULL;
    }
}

/* ---- Points ---- */

void burnish_masks_apply(const burnish_texturing *texturing, const burnish_texture_batch *batch) {
    const burnish_textured_material *material = batch->material;
    burnish_texture_scratch *scratch = batch->scratch;
    const int count = batch->count;
    const burnish_texture_sampler *sampler = &material->samplers[BURNISH_TEXTURE_COLOR];
    const burnish_mask mask = {1 - material->material.transparency,
                               material->material.alpha_cutoff,
                               material->mask_alpha,
                               texturing->smooth_samples,
                               burnish_sample_offsets(texturing->smooth_samples),
                               1};
    if (material->is_smooth && scratch->has_shifts) {
        batch->ops->cover_samples(sampler, &mask, &scratch->taps,
                                  batch->streams[sampler->coordinates], (size_t)count,
                                  scratch->opacity, scratch->cover);
        cover_quarters(batch, &mask);
        burnish_texture_fill(scratch->opacity, count, 1.0f);
        return;
    }
    for (int i = 0; i < count; ++i) {
        scratch->opacity[i] = mask.solid * scratch->opacity[i] >= mask.cutoff ? 1.0f : 0.0f;
    }
}
