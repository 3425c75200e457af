/* Exposure and tone mapping: from scene light to the light of pixels. */
#ifndef BURNISH_RENDER_FRAME_TONES_SIMD_H
#define BURNISH_RENDER_FRAME_TONES_SIMD_H

#include "burnish/render.h"
#include "render/render_ops.h"
#include "simd/vector.h"

/* Light beyond it is as bright; it keeps squares finite. */
#define TONES_MOST 0x1p20f

/* Khronos PBR Neutral Tone Mapper, with the constants and the order of its specification (2024).
 * The least channel is the part of a highlight's Fresnel term, which the curve takes off. Below
 * START the division's result is not used. */
BURNISH_INLINE void map_neutral(int has_toe, vf rgb[3]) {
    const float START = 0.8f - 0.04f, REST = 1.0f - START;
    const vf start = vf_set(START);
    const vf zero = vf_set(0.0f), least = vf_min(rgb[0], vf_min(rgb[1], rgb[2]));
    const vf parabola = vf_sub(least, vf_mul(vf_set(6.25f), vf_mul(least, least)));
    const vf offset = vf_blend(vf_greater(vf_set(0.08f), least), parabola, vf_set(0.04f));
    for (int k = 0; k < 3; ++k) {
        rgb[k] = vf_sub(rgb[k], has_toe ? offset : zero);
    }
    const vf own = vf_max(rgb[0], vf_max(rgb[1], rgb[2])), peak = vf_max(own, start);
    const vf beyond = vf_add(vf_sub(peak, start), vf_set(REST));
    const vf mapped = vf_sub(vf_set(1.0f), vf_div(vf_set(REST * REST), beyond));
    const vf scale = vf_div(mapped, peak);
    const vf excess = vf_add(vf_mul(vf_set(0.15f), vf_sub(peak, mapped)), vf_set(1.0f));
    const vf colored = vf_div(vf_set(1.0f), excess); /* the share that does not become white */
    const vm is_dark = vf_greater(start, own);
    for (int k = 0; k < 3; ++k) {
        const vf whiter = vf_sub(vf_mul(rgb[k], scale), mapped);
        rgb[k] = vf_blend(is_dark, rgb[k], vf_add(mapped, vf_mul(whiter, colored)));
    }
}

/* K. Narkowicz, ACES Filmic Tone Mapping Curve (2016): x (2.51 x + 0.03) / (x (2.43 x + 0.59) +
 * 0.14). */
BURNISH_INLINE void map_filmic(vf rgb[3]) {
    for (int k = 0; k < 3; ++k) {
        const vf x = rgb[k];
        const vf above = vf_mul(x, vf_add(vf_mul(vf_set(2.51f), x), vf_set(0.03f)));
        const vf below =
            vf_add(vf_mul(x, vf_add(vf_mul(vf_set(2.43f), x), vf_set(0.59f))), vf_set(0.14f));
        rgb[k] = vf_div(above, below);
    }
}

static void map_tones(const burnish_tones *tones, size_t count, float *const rgb[3]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf light[3];
        for (int k = 0; k < 3; ++k) {
            const vf exposed = vf_mul(vf_load(rgb[k] + i), vf_set(tones->exposure));
            light[k] = vf_min(vf_max(exposed, vf_set(0.0f)), vf_set(TONES_MOST));
        }
        if (tones->curve == BURNISH_TONES_NEUTRAL || tones->curve == BURNISH_TONES_SOFT) {
            map_neutral(tones->curve == BURNISH_TONES_NEUTRAL, light);
        } else if (tones->curve == BURNISH_TONES_FILMIC) {
            map_filmic(light);
        }
        for (int k = 0; k < 3; ++k) {
            vf_store(rgb[k] + i, light[k]);
        }
    }
}

#endif
