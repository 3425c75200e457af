/* Light that passes through layers: from straight behind, which the layers' order tells, and what
 * volumes and rough surfaces turn there from the maps of distant light. */
#include "render/frame/surface.h"

#include <string.h>

/* Adds to colours of fronts what paths through volumes see, and multiplies what passes by how much of
 * what is straight behind they do.
 *   seen  scratch for what is seen of the environment; NULL: there is none */
static void trace_light(const burnish_shading *shading, const burnish_passing *passing,
                        int material, int count, float *const *seen,
                        burnish_fragment_scratch *scratch, float *const rgb[3]) {
    const burnish_area *area = shading->area;
    burnish_texture_scratch *textures = scratch->texture;
    burnish_refracted refracted;
    const float *const to[3] = {refracted.to[0], refracted.to[1], refracted.to[2]};
    float straight[3][BURNISH_SHADE_BATCH] = {{0}}, sums[3][BURNISH_SHADE_BATCH] = {{0}};
    for (int path = 0; path < BURNISH_RAY_PATHS; ++path) {
        burnish_ray_refract(scratch->rays, shading->ray_light, shading->ops, passing, (size_t)count,
                            path, &refracted);
        if (seen) {
            shading->kernels->see_environment(&area->constants,
                                              &area->materials[material].reflecting, to,
                                              textures->roughness, (size_t)count, seen);
        }
        for (int i = 0; i < 3 * count; ++i) {
            const int k = i % 3, at = i / 3;
            const float share = refracted.has_met[at] ? 0 : seen ? refracted.straight[at] : 1;
            const float arriving = refracted.has_met[at] ? refracted.light[k][at]
                                   : seen                ? (1 - share) * seen[k][at]
                                                         : 0;
            sums[k][at] += refracted.left[k][at] * arriving;
            straight[k][at] += refracted.left[k][at] * share;
        }
    }
    for (int i = 0; i < 3 * count; ++i) {
        const int k = i % 3, at = i / 3;
        float *const passed = &textures->passed[k][at];
        if (passing->facing[at] > 1) {
            rgb[k][at] += *passed * (sums[k][at] / BURNISH_RAY_PATHS);
            *passed *= straight[k][at] / BURNISH_RAY_PATHS;
        }
    }
}

void burnish_find_first_volumes(const burnish_surface *surface, const burnish_fragments *fragments,
                                burnish_fragment_scratch *scratch) {
    const burnish_shading *shading = surface->shading;
    const int has_volumes = shading->ray_light && shading->ray_light->volumes;
    for (int i = 0; has_volumes && i < fragments->count; ++i) {
        uint16_t *before = &scratch->rays->refracted[fragments->pixels[i]];
        const int32_t material = surface->triangle_materials ? scratch->material[i] : 0;
        if (scratch->facing[i] > 0 && shading->texturing->materials[material].refracts) {
            scratch->facing[i] = fragments->samples[i] & ~*before ? 2 : 1;
            *before |= fragments->samples[i];
        }
    }
}

void burnish_pass_light(const burnish_shading *shading, const burnish_kernels_points *points,
                        int material, int count, burnish_fragment_scratch *scratch,
                        float *const rgb[3]) {
    const int is_group = points->normal[0] == scratch->group.normal[0];
    burnish_texture_scratch *textures = scratch->texture;
    const burnish_textured_material *from = &shading->texturing->materials[material];
    const burnish_area *area = shading->area;
    const int has_maps = area && area->constants.diffuse &&
                         area->materials[material].reflecting.reflects; /* else no point has it */
    burnish_passing passing = {.material = from,
                               .shader = &shading->texturing->white,
                               .points = *points,
                               .facing = is_group ? scratch->group.facing : scratch->facing};
    passing.is_traced = shading->ray_light && shading->ray_light->volumes && from->refracts;
    int has_paths = 0;
    for (int i = 0; i < count && passing.is_traced; ++i) {
        has_paths |= passing.facing[i] > 1;
        for (int k = 0; k < 3 && passing.facing[i] == 1; ++k) { /* the paths lose that light */
            textures->passed[k][i] = 1;
        }
    }
    const float *direction[3];
    float *seen[3];
    for (int k = 0; k < 3; ++k) {
        passing.points.normal[k] = from->has_normals ? textures->normal[k] : points->normal[k];
        direction[k] = textures->sample[k];
        seen[k] = textures->specular[k];
    }
    shading->ops->pass_points(&passing, (size_t)count, textures);
    if (has_maps) { /* else nothing but what is straight behind */
        shading->kernels->see_environment(&area->constants, &area->materials[material].reflecting,
                                          direction, textures->roughness, (size_t)count, seen);
    }
    const float *share = textures->sample[3];
    for (int k = 0; k < 3 && has_maps; ++k) {
        float *passed = textures->passed[k];
        for (int i = 0; i < count; ++i) {
            const float own = passing.is_traced && passing.facing[i] > 0 ? 1.0f : share[i];
            rgb[k][i] += passed[i] * (1.0f - own) * seen[k][i];
            passed[i] *= own;
        }
    }
    if (has_paths) {
        trace_light(shading, &passing, material, count, has_maps ? seen : NULL, scratch, rgb);
    }
}

void burnish_keep_passed(const burnish_shading *shading, const int32_t *materials, int material,
                         int size, burnish_fragment_scratch *scratch) {
    burnish_texture_scratch *textures = scratch->texture;
    if (!shading->texturing || !shading->texturing->materials[material].passes) {
        return;
    }
    const float *const from[3] = {textures->passed[0], textures->passed[1], textures->passed[2]};
    float *const to[3] = {textures->through[0], textures->through[1], textures->through[2]};
    if (materials) {
        shading->ops->scatter_material(material, materials, size, scratch->group.starts, from, to);
    } else {
        memcpy(textures->through, textures->passed, sizeof textures->through);
    }
}
