#include "render/materials.h"

#include "core/memory.h"

/* A lobe of the family for an exponent, solved, its value at the peak in *scale: the order asked
 * for or the highest below it that the exponent allows, and when none suits the fit, energy at
 * order 2, which exists for every exponent. */
static burnish_lobe_spec solved_lobe(const burnish_lobe_spec *lobe, double exponent, double *scale,
                                     size_t *fallbacks) {
    burnish_lobe_spec solved = *lobe;
    solved.fit = BURNISH_FIT_GIVEN;
    for (burnish_lobe_spec lower = *lobe; lower.order >= 2; lower.order /= 2) {
        if (burnish_lobe_solve(&lower, exponent, &solved.parameter, scale) == BURNISH_LOBE_OK) {
            *fallbacks += lower.order != lobe->order;
            solved.order = lower.order;
            return solved;
        }
    }
    *fallbacks += 1;
    solved.fit = BURNISH_FIT_ENERGY;
    solved.order = 2;
    *scale = 1;
    return solved;
}

/* A material with the lobe that its exponent allows, whose peak goes into the specular colour. */
static void set_lobe(const burnish_lobe_spec *lobe, burnish_shade_material *made,
                     size_t *fallbacks) {
    double scale = 1;
    made->lobe = *lobe;
    if (lobe->kind == BURNISH_LOBE_LYON) {
        made->lobe.order = burnish_lobe_highest_order(lobe->order, made->material.exponent);
        *fallbacks += made->lobe.order != lobe->order;
    } else if (lobe->kind == BURNISH_LOBE_FAMILY) {
        made->lobe = solved_lobe(lobe, (double)made->material.exponent, &scale, fallbacks);
    }
    for (int k = 0; k < 3; ++k) {
        made->material.specular[k] *= (float)scale;
    }
}

/* Vertex colours take the place of burnish's grey, and multiply a colour that the file gave. */
static burnish_material with_colors(const burnish_material *material) {
    burnish_material white = *material;
    for (int k = 0; k < 3 && !material->has_diffuse; ++k) {
        white.diffuse[k] = white.ambient[k] = 1.0f;
    }
    return white;
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
        (*materials)[i].material = has_colors ? with_colors(material) : *material;
        set_lobe(&options->lobe, &(*materials)[i], fallbacks);
    }
    return BURNISH_STATUS_OK;
}
