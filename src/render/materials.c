#include "render/materials.h"

#include <string.h>

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

/* A lobe as it is drawn for an exponent: what the specular colour is multiplied by, and whether its
 * order is lower than the one asked for. */
typedef struct drawn_lobe {
    float exponent; /* 0: none yet */
    burnish_lobe_spec lobe;
    float scale;
    size_t fallbacks;
} drawn_lobe;

static drawn_lobe lobe_for(const burnish_lobe_spec *lobe, float exponent) {
    drawn_lobe drawn = {exponent, *lobe, 1.0f, 0};
    double scale = 1;
    if (lobe->kind == BURNISH_LOBE_LYON) {
        drawn.lobe.order = burnish_lobe_highest_order(lobe->order, exponent);
        drawn.fallbacks = drawn.lobe.order != lobe->order;
    } else if (lobe->kind == BURNISH_LOBE_FAMILY) {
        drawn.lobe = solved_lobe(lobe, (double)exponent, &scale, &drawn.fallbacks);
    }
    drawn.scale = (float)scale;
    return drawn;
}

/* Lobes that were solved in this frame, by exponent: a search takes up to 100 microseconds, and
 * materials mostly share a few exponents. */
enum { KNOWN_LOBES = 64 };

static const drawn_lobe *known_lobe(drawn_lobe known[KNOWN_LOBES], const burnish_lobe_spec *lobe,
                                    float exponent) {
    uint32_t bits;
    memcpy(&bits, &exponent, sizeof bits);
    drawn_lobe *entry = &known[(bits * 0x9e3779b1u) >> 26];
    if (entry->exponent != exponent) {
        *entry = lobe_for(lobe, exponent);
    }
    return entry;
}

/* Vertex colours take the place of burnish's grey, and multiply a colour that the file gave. */
static burnish_material with_colors(const burnish_material *material) {
    burnish_material white = *material;
    for (int k = 0; k < 3 && !material->has_diffuse; ++k) {
        white.diffuse[k] = white.ambient[k] = 1.0f;
    }
    return white;
}

burnish_status burnish_materials_update(burnish_materials *materials, const burnish_mesh *mesh,
                                        const burnish_render_options *options, size_t *fallbacks,
                                        burnish_memory *memory) {
    const size_t count = burnish_mesh_material_count(mesh);
    const int has_colors = burnish_mesh_get_view(mesh)->colors && !options->ignore_colors;
    drawn_lobe known[KNOWN_LOBES] = {{0}};
    materials->items = burnish_reserve_discard(memory, materials->items, &materials->capacity,
                                               count, sizeof *materials->items, "materials");
    *fallbacks = 0;
    for (size_t i = 0; i < count && materials->items; ++i) {
        const burnish_material *material = burnish_mesh_material(mesh, i);
        burnish_shade_material *made = &materials->items[i];
        const drawn_lobe *lobe = known_lobe(known, &options->lobe, material->exponent);
        made->material = has_colors ? with_colors(material) : *material;
        made->lobe = lobe->lobe;
        for (int k = 0; k < 3; ++k) {
            made->material.specular[k] *= lobe->scale;
        }
        *fallbacks += lobe->fallbacks;
    }
    return memory->status;
}
