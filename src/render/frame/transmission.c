/* Light that passes through layers: from straight behind, which the layers' order tells, and what
 * volumes and rough surfaces turn there from the maps of distant light. */
#include "render/frame/surface.h"

#include <string.h>

void burnish_pass_light(const burnish_shading *shading, const burnish_kernels_points *points,
                        int material, int count, burnish_fragment_scratch *scratch,
                        float *const rgb[3]) {
    const int is_group = points->normal[0] == scratch->group.normal[0];
    burnish_texture_scratch *textures = &scratch->texture;
    const burnish_textured_material *from = &shading->texturing->materials[material];
    const burnish_area *area = shading->area;
    const int has_maps = area && area->constants.diffuse &&
                         area->materials[material].reflecting.reflects; /* else no point has it */
    burnish_passing passing = {.material = from,
                               .shader = &shading->texturing->white,
                               .points = *points,
                               .facing = is_group ? scratch->group.facing : scratch->facing};
    const float *direction[3];
    float *seen[3];
    for (int k = 0; k < 3; ++k) {
        passing.points.normal[k] = from->has_normals ? textures->normal[k] : points->normal[k];
        direction[k] = textures->sample[k];
        seen[k] = textures->specular[k];
    }
    shading->ops->pass_points(&passing, (size_t)count, textures);
    if (!has_maps) {
        return; /* nothing but what is straight behind */
    }
    shading->kernels->see_environment(&area->constants, &area->materials[material].reflecting,
                                      direction, textures->roughness, (size_t)count, seen);
    const float *share = textures->sample[3];
    for (int k = 0; k < 3; ++k) {
        float *passed = textures->passed[k];
        for (int i = 0; i < count; ++i) {
            rgb[k][i] += passed[i] * (1.0f - share[i]) * seen[k][i];
            passed[i] *= share[i];
        }
    }
}

void burnish_keep_passed(const burnish_shading *shading, const int32_t *materials, int material,
                         int size, burnish_fragment_scratch *scratch) {
    burnish_texture_scratch *textures = &scratch->texture;
    const float *const from[3] = {textures->passed[0], textures->passed[1], textures->passed[2]};
    float *const to[3] = {textures->through[0], textures->through[1], textures->through[2]};
    if (!shading->texturing || !shading->texturing->materials[material].passes) {
        return;
    }
    if (materials) {
        shading->ops->scatter_material(material, materials, size, scratch->group.starts, from, to);
    } else {
        memcpy(textures->through, textures->passed, sizeof textures->through);
    }
}
