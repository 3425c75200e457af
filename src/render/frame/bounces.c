/* Ambient occlusion and light that bounces, of batches. */
#include "render/frame/surface.h"

/* A point that sees no sky keeps so much of its light, by which the first light is divided. */
#define LEAST_OPEN 0x1p-10f

/* The walls of negative volumes see so much of the sky, or more: depth maps have the whole solid
 * before them. */
#define HOLLOW_OPEN 0.7f

void burnish_occlude_batch(const burnish_shading *shading, const burnish_fragment_batch *batch,
                           const burnish_kernels_points *points,
                           burnish_fragment_scratch *scratch) {
    burnish_share_points shared = {.w = points->w,
                                   .pixels = batch->pixels,
                                   .first_pixel = batch->first_pixel,
                                   .shown = batch->shown};
    for (int k = 0; k < 3; ++k) {
        shared.position[k] = points->position[k];
        shared.normal[k] = points->normal[k];
    }
    burnish_occlude_points(shading->occlusion, shading->ops, &shared, batch->count,
                           &scratch->share);
    for (int i = 0; shading->hollow_from > 0 && i < 2 * batch->count; ++i) {
        float *const own = &scratch->share.open[i % 2][i / 2];
        const int is_hollow = scratch->texture.ids[i / 2] >> 1 >= shading->hollow_from;
        *own = is_hollow && *own < HOLLOW_OPEN ? HOLLOW_OPEN : *own;
    }
    float *const open = scratch->share.open[0];
    for (int i = 0; i < batch->count && points->first_light; ++i) {
        open[i] = open[i] > LEAST_OPEN ? open[i] : LEAST_OPEN;
        scratch->lit[i] /= open[i];
    }
}

void burnish_add_bounces(const burnish_shading *shading, const burnish_kernels_points *points,
                         int count, int material, float (*open)[BURNISH_SHADE_BATCH],
                         const burnish_texture_scratch *textures, float *const rgb[3]) {
    const burnish_textured_material *textured =
        shading->texturing ? &shading->texturing->materials[material] : NULL;
    const int is_varied = textured && textured->is_special && textured->is_varied;
    const float *factor[3];
    float albedo[3];
    for (int k = 0; k < 3; ++k) {
        albedo[k] = is_varied ? 1 : shading->shaders[material].albedo[k];
        factor[k] = textured && textured->is_special ? textures->diffuse[k] : points->diffuse[k];
        if (is_varied && burnish_has_roughness(&textured->material)) {
            factor[k] = textures->ambient[k];
        }
    }
    shading->ops->add_bounces(shading->occlusion, albedo, factor,
                              (const float *const[2]){open[0], open[1]}, (size_t)count, rgb);
}

void burnish_add_bounces_mixed(const burnish_shading *shading, const burnish_fragment_batch *batch,
                               burnish_fragment_scratch *scratch, float *const rgb[3]) {
    static const float white[3] = {1, 1, 1};
    const float *const albedo[3] = {scratch->albedo[0], scratch->albedo[1], scratch->albedo[2]};
    for (int i = 0; i < batch->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            scratch->albedo[k][i] = shading->shaders[batch->material[i]].albedo[k];
        }
    }
    shading->ops->add_bounces(
        shading->occlusion, white, albedo,
        (const float *const[2]){scratch->share.open[0], scratch->share.open[1]},
        (size_t)batch->count, rgb);
}
