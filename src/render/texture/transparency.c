#include "render/texture/transparency.h"

#include <string.h>

/* ---- Triangles ---- */

/* What the tasks of find_range share. */
typedef struct find_context {
    const burnish_transparency *transparency;
    const burnish_mesh_view *mesh;
} find_context;

static int is_transparent_material(const burnish_transparency *transparency, size_t material) {
    return transparency->opacities[material] < 1 ||
           (transparency->texturing && (transparency->texturing->materials[material].is_alpha ||
                                        transparency->texturing->materials[material].passes));
}

static int is_transparent(const find_context *find, size_t triangle) {
    const burnish_mesh_view *mesh = find->mesh;
    const size_t material = mesh->triangle_materials ? mesh->triangle_materials[triangle] : 0;
    int alpha = 255;
    for (size_t k = 0; find->transparency->has_alpha && k < 3; ++k) {
        alpha &= mesh->colors[4 * (size_t)mesh->indices[3 * triangle + k] + 3];
    }
    return is_transparent_material(find->transparency, material) || alpha < 255;
}

/* The masks of some batches. */
static void find_range(void *context, size_t first, size_t end) {
    const find_context *find = context;
    const size_t count = find->mesh->triangle_count;
    for (size_t batch = first; batch < end; ++batch) {
        unsigned mask = 0;
        for (size_t i = 0; i < BURNISH_BATCH_SIZE && batch * BURNISH_BATCH_SIZE + i < count; ++i) {
            mask |= (unsigned)is_transparent(find, batch * BURNISH_BATCH_SIZE + i) << i;
        }
        find->transparency->masks[batch] = (uint16_t)mask;
    }
}

/* ---- Versions ---- */

/* All that decides where a material is opaque. Compared byte by byte: all 0 before it is filled. */
typedef struct burnish_opacity_rule {
    const burnish_texture_levels *levels[2]; /* MASK: of colour and opacity; NULL: none */
    float transform[2][6];
    int wrap[2][2];
    float level_cutoff, cutoff, transparency; /* MASK */
    int is_transparent, is_masked, refracts;
} burnish_opacity_rule;

static void fill_rule(const burnish_transparency *transparency, size_t i,
                      burnish_opacity_rule *rule) {
    static const int slots[2] = {BURNISH_TEXTURE_COLOR, BURNISH_TEXTURE_OPACITY};
    const burnish_texturing *texturing = transparency->texturing;
    const burnish_textured_material *material = texturing ? &texturing->materials[i] : NULL;
    memset(rule, 0, sizeof *rule);
    rule->refracts = material && material->refracts;
    rule->is_transparent = is_transparent_material(transparency, i);
    if (!rule->is_transparent || !material || material->passes ||
        material->material.alpha_mode != BURNISH_ALPHA_MASK) {
        return;
    }
    rule->is_masked = 1;
    rule->cutoff = material->material.alpha_cutoff;
    rule->transparency = material->material.transparency;
    for (int k = 0; k < 2; ++k) {
        const burnish_texture_sampler *sampler = &material->samplers[slots[k]];
        rule->levels[k] = sampler->levels;
        memcpy(rule->transform[k], sampler->transform, sizeof rule->transform[k]);
        memcpy(rule->wrap[k], sampler->wrap, sizeof rule->wrap[k]);
    }
    rule->level_cutoff = rule->levels[0] ? rule->levels[0]->cutoff : 0;
}

static void update_version(burnish_transparency *transparency, const burnish_mesh_view *mesh,
                           size_t materials, int had_alpha, burnish_memory *memory) {
    const size_t count = transparency->has_some ? materials : 0;
    int is_other = transparency->serial != mesh->serial || transparency->rule_count != count ||
                   transparency->has_alpha != had_alpha;
    transparency->serial = 0;
    transparency->rules =
        burnish_reserve_discard(memory, transparency->rules, &transparency->rule_capacity, count,
                                sizeof *transparency->rules, "opacities");
    if (memory->status != BURNISH_STATUS_OK) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_opacity_rule rule;
        fill_rule(transparency, i, &rule);
        is_other = is_other || memcmp(&rule, &transparency->rules[i], sizeof rule) != 0;
        memcpy(&transparency->rules[i], &rule, sizeof rule);
    }
    transparency->version += (uint64_t)is_other;
    transparency->rule_count = count;
    transparency->serial = mesh->serial;
}

/* ---- A frame ---- */

burnish_status burnish_transparency_update(burnish_transparency *transparency,
                                           const burnish_drawn_mesh *mesh,
                                           const burnish_texturing *texturing, burnish_tasks *tasks,
                                           burnish_memory *memory) {
    enum { GRAIN = 1024 /* batches */ };
    const burnish_mesh_view *view = mesh->view;
    const size_t materials = mesh->material_count;
    const size_t batches = (view->triangle_count + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    const int had_alpha = transparency->has_alpha;
    const int are_points = view->point_radius > 0; /* always opaque */
    transparency->has_alpha = view->has_transparent_colors && !mesh->ignore_colors && !are_points;
    transparency->has_some = transparency->has_alpha;
    transparency->texturing = texturing;
    transparency->opacities =
        burnish_reserve_discard(memory, transparency->opacities, &transparency->opacity_capacity,
                                materials, sizeof *transparency->opacities, "opacities");
    for (size_t i = 0; memory->status == BURNISH_STATUS_OK && i < materials; ++i) {
        const burnish_material *material = burnish_mesh_get_material(mesh->mesh, i);
        const int is_masked = material->alpha_mode == BURNISH_ALPHA_MASK; /* the mask says all */
        transparency->opacities[i] = is_masked ? 1 : 1 - material->transparency;
        transparency->has_some |= !are_points && is_transparent_material(transparency, i);
    }
    if (memory->status == BURNISH_STATUS_OK) {
        update_version(transparency, view, materials, had_alpha, memory);
    }
    if (memory->status != BURNISH_STATUS_OK || !transparency->has_some) {
        return memory->status;
    }
    transparency->masks =
        burnish_reserve_discard(memory, transparency->masks, &transparency->mask_capacity, batches,
                                sizeof *transparency->masks, "transparent triangles");
    if (transparency->masks) {
        find_context find = {transparency, view};
        burnish_tasks_ranges(tasks, batches, GRAIN, find_range, &find);
    }
    return memory->status;
}

burnish_status burnish_transparency_add_clipped(burnish_transparency *transparency,
                                                const burnish_geometry *geometry,
                                                burnish_memory *memory) {
    const size_t first = geometry->mesh_batches;
    if (!transparency->has_some || geometry->batch_count == first) {
        return BURNISH_STATUS_OK;
    }
    transparency->masks = burnish_reserve(memory, transparency->masks, &transparency->mask_capacity,
                                          geometry->batch_count, sizeof *transparency->masks,
                                          "transparent triangles");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    memset(transparency->masks + first, 0,
           (geometry->batch_count - first) * sizeof *transparency->masks);
    for (size_t i = 0; i < geometry->clipped_count; ++i) {
        const uint32_t id = geometry->clipped_ids[i];
        const unsigned bit =
            transparency->masks[id / BURNISH_BATCH_SIZE] >> id % BURNISH_BATCH_SIZE & 1;
        transparency->masks[first + i / BURNISH_BATCH_SIZE] |=
            (uint16_t)(bit << i % BURNISH_BATCH_SIZE);
    }
    return BURNISH_STATUS_OK;
}

void burnish_transparency_destroy(burnish_transparency *transparency,
                                  const burnish_context *context) {
    burnish_release(context, transparency->opacities);
    burnish_release(context, transparency->masks);
    burnish_release(context, transparency->rules);
    memset(transparency, 0, sizeof *transparency);
}
