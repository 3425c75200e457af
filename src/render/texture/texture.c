#include "render/texture/texture.h"

#include <string.h>

/* Through rougher volumes, edges are blurred. */
#define REFRACTING_ROUGHNESS 0.1f

/* ---- Levels of textures ---- */

static void release_levels(burnish_texturing *texturing, const burnish_context *context) {
    for (size_t i = 0; i < texturing->levels_count; ++i) {
        burnish_texture_levels_destroy(&texturing->levels[i], context);
    }
    burnish_release(context, texturing->levels);
    texturing->levels = NULL;
    texturing->levels_count = 0;
    texturing->serial = 0;
}

/* Whether a material's mask is decided sample by sample. Alpha of two images is not: they need not
 * have texels of the same size. */
static int is_smooth_mask(const burnish_texturing *texturing, const burnish_material *material) {
    return texturing->samples > 1 && material->alpha_mode == BURNISH_ALPHA_MASK &&
           material->textures[BURNISH_TEXTURE_COLOR].texture &&
           !material->textures[BURNISH_TEXTURE_OPACITY].texture;
}

/* The alpha from which on a mask leaves something. */
static float mask_alpha(const burnish_material *material) {
    const float solid = 1 - material->transparency;
    return solid > 0 ? material->alpha_cutoff / solid : material->alpha_cutoff > 0 ? 2.0f : 0.0f;
}

/* How texels are averaged for such a use of a texture. */
static burnish_texture_kind kind_of(const burnish_material *material, int slot, int smooth,
                                    const burnish_texture *texture) {
    if (slot == BURNISH_TEXTURE_NORMAL) {
        return BURNISH_TEXTURE_NORMALS;
    }
    if (!texture->is_color) {
        return BURNISH_TEXTURE_NUMBERS;
    }
    if (slot != BURNISH_TEXTURE_COLOR || material->alpha_mode == BURNISH_ALPHA_IGNORE) {
        return BURNISH_TEXTURE_COLORS;
    }
    return smooth ? BURNISH_TEXTURE_MASKED : BURNISH_TEXTURE_WEIGHTED;
}

/* Levels of kind MASKED are built for the first cutoff that the frame's materials need; levels of
 * an earlier frame's cutoff are dropped. Returns 0 if another material has taken them. */
static int take_cutoff(burnish_texture_levels *levels, float cutoff, const burnish_memory *memory) {
    const int is_other = levels->cutoff < cutoff || levels->cutoff > cutoff;
    if (is_other && levels->is_taken) {
        return 0;
    }
    if (is_other) {
        burnish_texture_levels_destroy(levels, memory->context);
    }
    levels->cutoff = cutoff;
    levels->is_taken = 1;
    return 1;
}

/* The levels that a use samples, built where they are not there yet; NULL: no memory. */
static const burnish_texture_levels *levels_for(burnish_texturing *texturing,
                                                const burnish_mesh *mesh,
                                                const burnish_material *material, int slot,
                                                burnish_tasks *tasks, burnish_memory *memory) {
    const size_t number = (size_t)material->textures[slot].texture - 1;
    const burnish_texture *texture = burnish_mesh_get_texture(mesh, number);
    const float cutoff = mask_alpha(material);
    burnish_texture_levels *of_texture = &texturing->levels[number * BURNISH_TEXTURE_KIND_COUNT];
    burnish_texture_kind kind =
        kind_of(material, slot, is_smooth_mask(texturing, material), texture);
    if (kind == BURNISH_TEXTURE_MASKED && !take_cutoff(&of_texture[kind], cutoff, memory)) {
        kind = BURNISH_TEXTURE_WEIGHTED; /* a second cutoff: means of alpha will do */
    }
    burnish_texture_levels *levels = &of_texture[kind];
    if (!levels->texels && !levels->codes &&
        burnish_texture_levels_create(levels, texture, kind, tasks, memory) != BURNISH_STATUS_OK) {
        burnish_texture_levels_destroy(levels, memory->context);
        return NULL;
    }
    /* What a frame needed a part of, the next one has whole. Of masks, masks.c and casters.c read
     * what they like. */
    if (burnish_texture_levels_has_some(levels) ||
        (material->alpha_mode == BURNISH_ALPHA_MASK &&
         (slot == BURNISH_TEXTURE_COLOR || slot == BURNISH_TEXTURE_OPACITY))) {
        burnish_texture_levels_need_all(levels, tasks);
    }
    return levels;
}

/* ---- Materials ---- */

static void set_sampler(const burnish_texture_use *use, const burnish_texture_levels *levels,
                        burnish_texture_sampler *sampler) {
    static const float identity[6] = {1, 0, 0, 0, 1, 0};
    sampler->levels = levels;
    sampler->wrap[0] = use->wrap[0];
    sampler->wrap[1] = use->wrap[1];
    sampler->is_nearest = use->is_nearest;
    sampler->coordinates = use->coordinates;
    sampler->has_transform = use->has_transform;
    memcpy(sampler->transform, use->has_transform ? use->transform : identity, sizeof identity);
}

/* Whether alpha, as the material's mode has it, is below 1 somewhere. */
static int has_alpha(const burnish_textured_material *material) {
    const burnish_texture_levels *color = material->samplers[BURNISH_TEXTURE_COLOR].levels;
    const burnish_texture_levels *opacity = material->samplers[BURNISH_TEXTURE_OPACITY].levels;
    return material->material.alpha_mode != BURNISH_ALPHA_IGNORE &&
           ((color && color->least[3] < 255) || (opacity && opacity->least[0] < 255) ||
            (material->material.alpha_mode == BURNISH_ALPHA_MASK &&
             material->material.transparency > 0));
}

static burnish_status set_material(burnish_texturing *texturing, const burnish_mesh *mesh,
                                   const burnish_material *from, burnish_tasks *tasks,
                                   burnish_memory *memory, burnish_textured_material *to) {
    *to = (burnish_textured_material){.material = *from, .is_varied = from->is_metallic};
    for (int slot = 0; slot < BURNISH_TEXTURE_COAT; ++slot) { /* its coat has the others */
        const burnish_texture_use *use = &from->textures[slot];
        if (use->texture == 0) {
            continue;
        }
        const burnish_texture_levels *levels =
            levels_for(texturing, mesh, from, slot, tasks, memory);
        if (!levels) {
            return memory->status != BURNISH_STATUS_OK ? memory->status
                                                       : burnish_tasks_check(tasks, memory->error);
        }
        set_sampler(use, levels, &to->samplers[slot]);
        to->has_textures = 1;
        texturing->needs_second |= use->coordinates;
        to->is_varied |= slot != BURNISH_TEXTURE_COLOR && slot != BURNISH_TEXTURE_EMISSIVE &&
                         slot < BURNISH_TEXTURE_OPACITY;
    }
    to->has_normals = to->samplers[BURNISH_TEXTURE_NORMAL].levels != NULL;
    const float *along = from->anisotropy;
    to->is_bent =
        from->is_metallic && !from->is_unlit && along[0] * along[0] + along[1] * along[1] > 0;
    to->has_textures |= to->is_bent;
    to->has_edge = from->is_metallic &&
                   (from->edge_loss > 0 || to->samplers[BURNISH_TEXTURE_SPECULAR_STRENGTH].levels);
    to->is_varied &= !from->is_unlit;
    to->is_alpha = has_alpha(to);
    to->passes = from->is_metallic && !from->is_unlit && from->transmission > 0 &&
                 !(texturing->mesh->point_radius > 0) &&
                 !burnish_mesh_get_negatives(mesh); /* what is carved is opaque */
    to->refracts = to->passes && from->thickness > 0 && !to->is_alpha &&
                   from->roughness < REFRACTING_ROUGHNESS;
    to->material.transmission = to->passes ? from->transmission : 0;
    to->is_smooth = to->is_alpha && is_smooth_mask(texturing, from);
    to->mask_alpha = mask_alpha(from);
    to->is_special = to->has_textures || to->is_varied || to->is_alpha || from->emissive[0] > 0 ||
                     from->emissive[1] > 0 || from->emissive[2] > 0;
    return BURNISH_STATUS_OK;
}

static int is_special(const burnish_material *material) {
    int special = material->is_metallic || material->alpha_mode == BURNISH_ALPHA_MASK;
    for (int k = 0; k < 3; ++k) {
        special |= material->emissive[k] > 0;
    }
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        special |= material->textures[slot].texture;
    }
    return special != 0;
}

/* Room for the levels of a mesh that is another one than the last. */
static burnish_status prepare_levels(burnish_texturing *texturing, const burnish_mesh *mesh,
                                     burnish_memory *memory) {
    const size_t count = burnish_mesh_get_texture_count(mesh) * BURNISH_TEXTURE_KIND_COUNT;
    if (texturing->serial != burnish_mesh_get_view(mesh)->serial) {
        release_levels(texturing, memory->context);
        texturing->levels =
            burnish_allocate_zeroed(memory, count, sizeof *texturing->levels, "textures");
        texturing->levels_count = texturing->levels ? count : 0;
        texturing->serial =
            memory->status == BURNISH_STATUS_OK ? burnish_mesh_get_view(mesh)->serial : 0;
    }
    return memory->status;
}

/* Vertex colours replace a colour that the file lacks. */
static void make_white(burnish_material *material) {
    for (int k = 0; k < 3; ++k) {
        material->diffuse[k] = material->ambient[k] = 1;
    }
}

burnish_status burnish_texturing_update(burnish_texturing *texturing,
                                        const burnish_drawn_mesh *drawn, int samples,
                                        burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_mesh *mesh = drawn->mesh;
    const int has_colors = drawn->view->colors && !drawn->ignore_colors;
    const size_t count = drawn->material_count + drawn->coat_count;
    texturing->has_some = texturing->needs_points = texturing->has_alpha = 0;
    texturing->needs_tangents = texturing->needs_second = texturing->smooth_samples = 0;
    texturing->has_passing = 0;
    texturing->samples = samples;
    for (size_t i = 0; i < drawn->material_count && !texturing->has_some; ++i) {
        texturing->has_some = is_special(burnish_mesh_get_material(mesh, i));
    }
    if (!texturing->has_some) {
        return BURNISH_STATUS_OK;
    }
    texturing->mesh = drawn->view;
    texturing->materials =
        burnish_reserve_discard(memory, texturing->materials, &texturing->material_capacity, count,
                                sizeof *texturing->materials, "materials");
    burnish_status status =
        texturing->materials ? prepare_levels(texturing, mesh, memory) : memory->status;
    for (size_t i = 0; i < texturing->levels_count; ++i) {
        texturing->levels[i].is_taken = 0;
    }
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_textured_material *material = &texturing->materials[i];
        status = set_material(texturing, mesh, burnish_drawn_material(drawn, i), tasks, memory,
                              material);
        if (i >= drawn->material_count) { /* its opacity is another layer's */
            material->is_alpha = 0;
            texturing->materials[drawn->coats[i - drawn->material_count].base].has_textures |=
                material->has_textures;
        }
        if (has_colors && !material->material.has_diffuse) {
            make_white(&material->material);
        }
        texturing->needs_points |= material->has_textures;
        texturing->needs_tangents |= material->has_normals | material->is_bent;
        texturing->has_alpha |= material->is_alpha;
        texturing->has_passing |= material->passes;
        texturing->smooth_samples = material->is_smooth ? samples : texturing->smooth_samples;
    }
    return status;
}

void burnish_texturing_destroy(burnish_texturing *texturing, const burnish_context *context) {
    release_levels(texturing, context);
    burnish_release(context, texturing->materials);
    memset(texturing, 0, sizeof *texturing);
}

/* ---- Lobes ---- */

/* 2^(i / BURNISH_EACH_STEPS). */
static double exponent_at(int i) {
    static const double steps[BURNISH_EACH_STEPS] = {1, 1.189207115002721, 1.4142135623730951,
                                                     1.681792830507429};
    return steps[i % BURNISH_EACH_STEPS] * (double)(1u << i / BURNISH_EACH_STEPS);
}

/* The slope is a smooth function of the logarithm of n when it is divided by n. */
static void solve_lobes(burnish_texturing *texturing, const burnish_lobe_spec *lobe) {
    const int is_family = lobe->kind == BURNISH_LOBE_FAMILY || lobe->kind == BURNISH_LOBE_LYON;
    const int needs_order = is_family && lobe->order > 2;
    texturing->least_exponent = needs_order ? (float)lobe->order : 1.0f;
    if (is_family && (lobe->fit == BURNISH_FIT_PROJECTED || lobe->fit == BURNISH_FIT_AFFINE)) {
        texturing->least_exponent = (float)lobe->order;
    }
    for (int i = 0; i < BURNISH_EACH_TABLE; ++i) {
        const double least = (double)texturing->least_exponent, wanted = exponent_at(i);
        const double n = wanted < least ? least : wanted > 65536 ? 65536 : wanted;
        double zeta = 0, scale = 1;
        if (!is_family || burnish_lobe_solve(lobe, n, &zeta, &scale) != BURNISH_LOBE_OK) {
            zeta = (n + 1) / (lobe->order + 1); /* energy */
            scale = 1;
        }
        texturing->slopes[i] = (float)(zeta / n);
        texturing->scales[i] = (float)scale;
    }
    texturing->lobe = *lobe;
}

static int same_lobe(const burnish_lobe_spec *a, const burnish_lobe_spec *b) {
    return a->kind == b->kind && a->fit == b->fit && a->aim == b->aim && a->order == b->order &&
           a->by_material == b->by_material && !(a->parameter < b->parameter) &&
           !(a->parameter > b->parameter);
}

burnish_status burnish_texturing_view(burnish_texturing *texturing,
                                      const burnish_kernels_lighting *lighting,
                                      const burnish_lobe_spec *lobe, burnish_error *error) {
    static const burnish_material white = {
        .ambient = {1, 1, 1}, .diffuse = {1, 1, 1}, .specular = {1, 1, 1}, .exponent = 64};
    burnish_lobe_spec folded = *lobe;
    if (!same_lobe(&texturing->lobe, lobe)) {
        solve_lobes(texturing, lobe);
    }
    if (lobe->kind == BURNISH_LOBE_FAMILY) { /* slopes are the table's */
        folded.fit = BURNISH_FIT_TAYLOR;
    }
    burnish_status status =
        burnish_shader_fold(lighting, &white, &folded, texturing->lights, &texturing->white, error);
    texturing->white.lyon = 0;
    return status;
}
