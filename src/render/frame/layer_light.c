#include "render/frame/target.h"

#include <string.h>

#include "burnish/render.h"

_Static_assert((int)BURNISH_LAYERS_MAX *(int)BURNISH_LAYER_PASSES == BURNISH_TRANSPARENT_LAYERS_MAX,
               "what render.h says");

burnish_layer_light *burnish_layer_light_create(int samples, burnish_memory *memory) {
    const size_t size =
        sizeof(burnish_layer_light) + 3 * (size_t)samples * BURNISH_TILE_PIXELS * sizeof(float);
    return burnish_allocate(memory, size, 1, "layers");
}

void burnish_layer_light_clear(burnish_layer_light *layers, int samples, int has_channels) {
    const size_t count = (size_t)samples * BURNISH_TILE_PIXELS;
    layers->channel = has_channels ? count : 0;
    memset(layers->light, 0, sizeof layers->light);
    memset(layers->covered, 0, sizeof layers->covered);
    for (size_t i = 0; i < (has_channels ? 3 : 1) * count; ++i) {
        layers->through[i] = 1.0f;
    }
}

static float opacity_of(const burnish_surface *surface, const burnish_fragments *fragments, int i) {
    const burnish_primitive *primitive = &fragments->primitives[i];
    const size_t material = surface->triangle_materials
                                ? surface->triangle_materials[primitive->id_and_facing >> 1]
                                : 0;
    float opacity = surface->transparency->opacities[material];
    if (surface->transparency->has_alpha) {
        opacity *= burnish_fragment_alpha(surface->attributes, fragments, i);
    }
    return opacity < 0 ? 0 : opacity > 1 ? 1 : opacity;
}

/* Lays samples of opacity `opacity` times cover (NULL: 1) of fragment i after the layers so far in
 * channel k; returns what of its light is seen. */
static float lay_samples(burnish_layer_light *layers, const burnish_fragments *fragments, int i,
                         const burnish_layer_values *values, float opacity, int k) {
    const int pixel = fragments->pixels[i], samples = values->samples;
    const float blocked = values->passed ? 1.0f - values->passed[k][i] : 1.0f;
    const float left = 1.0f - opacity * blocked;
    float(*cover)[BURNISH_TEXTURE_BATCH] = values->cover;
    float *shares = layers->through + (size_t)k * layers->channel, seen = 0;
    for (unsigned rest = fragments->samples[i]; rest; rest &= rest - 1) {
        const int s = __builtin_ctz(rest);
        float *through = &shares[burnish_sample_index(samples, pixel, s)];
        if (cover) {
            const float covered = opacity * cover[s][i];
            seen += covered * *through;
            *through *= 1.0f - covered * blocked;
        } else {
            seen += *through;
            *through *= left;
        }
    }
    return cover ? seen : opacity * seen;
}

/* Whether a mask leaves some of fragment i. */
static int is_there(const burnish_fragments *fragments, int i,
                    float (*cover)[BURNISH_TEXTURE_BATCH]) {
    for (unsigned rest = cover ? fragments->samples[i] : 0; rest; rest &= rest - 1) {
        if (cover[__builtin_ctz(rest)][i] > 0) {
            return 1;
        }
    }
    return !cover;
}

void burnish_layer_light_add(burnish_layer_light *layers, const burnish_surface *surface,
                             const burnish_fragments *fragments,
                             const burnish_layer_values *values) {
    const float *const *rgb = values->rgb;
    for (int i = 0; i < fragments->count; ++i) {
        const int pixel = fragments->pixels[i];
        const float textured = values->alpha ? values->alpha[i] : 1.0f;
        const float opacity = opacity_of(surface, fragments, i) * textured;
        if (textured <= 0 || !is_there(fragments, i, values->cover)) {
            continue; /* nothing is there */
        }
        float seen = lay_samples(layers, fragments, i, values, opacity, 0);
        for (int k = 0; rgb && k < 3; ++k) {
            if (k > 0 && layers->channel) {
                seen = lay_samples(layers, fragments, i, values, opacity, k);
            }
            const float value = rgb[k][i];
            layers->light[k][pixel] += seen * (value < values->limit ? value : values->limit);
        }
        layers->covered[pixel / BURNISH_BLOCK_PIXELS] |=
            (uint16_t)(1u << pixel % BURNISH_BLOCK_PIXELS);
    }
}
