/* Samples to pixels, in linear light. */
#include <string.h>

#include "render/store.h"

void burnish_sums_add(burnish_tile_sums *sums, const burnish_fragments *fragments,
                      const float *const rgb[3], float limit) {
    for (int i = 0; i < fragments->count; ++i) {
        const int pixel = fragments->pixels[i];
        const float weight = (float)fragments->weight[i];
        for (int k = 0; k < 3; ++k) {
            const float value = rgb[k][i];
            sums->light[k][pixel] += weight * (value < limit ? value : limit);
        }
        sums->covered[pixel] = (uint8_t)(sums->covered[pixel] + fragments->weight[i]);
    }
}

/* a where simple >= 0, b elsewhere; without a branch, which would be unpredictable. */
static inline float pick(int32_t simple, float a, float b) {
    uint32_t none = (uint32_t)(simple >> 31), a_bits, b_bits;
    memcpy(&a_bits, &a, sizeof a_bits);
    memcpy(&b_bits, &b, sizeof b_bits);
    a_bits = (a_bits & ~none) | (b_bits & none);
    memcpy(&a, &a_bits, sizeof a);
    return a;
}

/* The background's code comes back from its linear value where nothing covers a pixel. */
void burnish_resolve_block_row(const burnish_output *output, const burnish_tile_sums *sums,
                               int number, burnish_row_light *row) {
    const int base = number * BURNISH_BLOCK_ROW_PIXELS, samples = output->samples;
    const int transparent = output->transparent;
    const uint8_t *covered = sums->covered + base;
    const float all = 1.0f / (float)samples; /* a power of two */
    const float limit = output->limit;
    for (int k = 0; k < 3; ++k) {
        const float background = output->background_light[k];
        const float *sum = sums->light[k] + base;
        float *light = row->rgb[k];
        for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
            const float missing = (float)(samples - covered[i]);
            float mixed = (sum[i] + missing * background) * all;
            if (transparent) {
                mixed = covered[i] ? sum[i] * (1.0f / (float)covered[i]) : 0.0f;
            }
            const float value = light[i] < limit ? light[i] : limit;
            light[i] = pick(row->pixels.simple[i], value, mixed);
        }
    }
}
