#include "render/materials.h"

#include "burnish/theory.h"
#include "core/memory.h"

/* The family's lobe for an exponent: the chosen order or the highest below it that the exponent
 * allows, and when none fits the chosen fit, energy at order 2, which exists for every exponent. */
static burnish_lobe family_lobe(const burnish_lobe_choice *choice, burnish_lobe_fit fit,
                                float exponent, size_t *fallbacks) {
    burnish_lobe lobe;
    for (int order = choice->order; order >= 2; order /= 2) {
        if (burnish_theory_lobe(&lobe, fit, order, exponent, choice->level) == BURNISH_LOBE_OK) {
            *fallbacks += order != choice->order;
            return lobe;
        }
    }
    *fallbacks += 1;
    burnish_lobe_create(&lobe, BURNISH_FIT_ENERGY, 2, exponent);
    return lobe;
}

static burnish_kernels_lobe batch_lobe(const burnish_lobe_choice *choice, float exponent,
                                       size_t *fallbacks) {
    burnish_kernels_lobe lobe = {BURNISH_KERNELS_FAMILY, {0, 2}, exponent};
    switch (choice->kind) {
    case BURNISH_LOBE_LYON:
        lobe.family = family_lobe(choice, BURNISH_FIT_TAYLOR, exponent, fallbacks);
        break;
    case BURNISH_LOBE_POWER:
        lobe.kind = BURNISH_KERNELS_POWER;
        break;
    case BURNISH_LOBE_SCHLICK:
        lobe.kind = BURNISH_KERNELS_SCHLICK;
        break;
    case BURNISH_LOBE_GAUSSIAN:
        lobe.kind = BURNISH_KERNELS_GAUSSIAN;
        break;
    case BURNISH_LOBE_GX:
        lobe.kind = BURNISH_KERNELS_GX;
        break;
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_KIND_COUNT:
        lobe.family = family_lobe(choice, choice->fit, exponent, fallbacks);
        break;
    }
    return lobe;
}

/* Vertex colours take the place of burnish's grey, and multiply a colour that the file gave. */
static void set_colors(const burnish_material *material, int has_colors,
                       const float ambient_light[3], burnish_shade_material *made) {
    int white = has_colors && !material->has_diffuse;
    for (int i = 0; i < 3; ++i) {
        made->diffuse[i] = white ? 1.0f : material->diffuse[i];
        made->ambient[i] = ambient_light[i] * (white ? 1.0f : material->ambient[i]);
        made->specular[i] = material->specular[i];
    }
}

burnish_status burnish_materials_create(const burnish_mesh *scene,
                                        const burnish_render_options *options,
                                        burnish_shade_material **materials, size_t *fallbacks,
                                        burnish_error *error) {
    size_t count = burnish_mesh_material_count(scene);
    int has_colors = burnish_mesh_get_view(scene)->colors && !options->ignore_colors;
    burnish_status status =
        burnish_legacy_allocate((void **)materials, count, sizeof **materials, "materials", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *fallbacks = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_material *material = burnish_mesh_material(scene, i);
        size_t lower = 0;
        set_colors(material, has_colors, options->ambient_light, &(*materials)[i]);
        (*materials)[i].lobe = batch_lobe(&options->lobe, material->exponent, &lower);
        *fallbacks += lower;
    }
    return BURNISH_STATUS_OK;
}
