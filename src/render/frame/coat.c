/* Clear coats: each is a material of its own, which is shaded before its base and laid over it. */
#include "render/frame/surface.h"

/* At normal incidence: an index of refraction of 1.5. */
#define COAT_REFLECTANCE 0.04f

/* Black plastic of the coat's roughness. Its share is its opacity. */
static burnish_material coat_material(const burnish_material *base) {
    const burnish_texture_use *from = base->textures;
    const float alpha = base->coat_roughness * base->coat_roughness;
    const float n = 2 / (alpha * alpha > 0x1p-15f ? alpha * alpha : 0x1p-15f) - 2;
    burnish_material coat = {.has_diffuse = 1,
                             .exponent = n > 1 ? n : 1,
                             .roughness = base->coat_roughness,
                             .is_metallic = from[BURNISH_TEXTURE_COAT_ROUGHNESS].texture ||
                                            from[BURNISH_TEXTURE_COAT_NORMAL].texture};
    const float peak = COAT_REFLECTANCE * (coat.exponent + 2) / 8;
    for (int k = 0; k < 3; ++k) {
        coat.reflectance[k] = COAT_REFLECTANCE;
        coat.specular[k] = peak < 1 ? peak : 1;
    }
    coat.textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS] = from[BURNISH_TEXTURE_COAT_ROUGHNESS];
    coat.textures[BURNISH_TEXTURE_NORMAL] = from[BURNISH_TEXTURE_COAT_NORMAL];
    coat.textures[BURNISH_TEXTURE_OCCLUSION] = from[BURNISH_TEXTURE_OCCLUSION];
    coat.textures[BURNISH_TEXTURE_OPACITY] = from[BURNISH_TEXTURE_COAT];
    coat.alpha_mode =
        from[BURNISH_TEXTURE_COAT].texture ? BURNISH_ALPHA_BLEND : BURNISH_ALPHA_IGNORE;
    return coat;
}

burnish_status burnish_coats_update(burnish_coats *coats, burnish_drawn_mesh *mesh,
                                    burnish_shading *shading, burnish_memory *memory) {
    const size_t count = mesh->material_count;
    size_t coat_count = 0;
    for (size_t i = 0; i < count; ++i) {
        coat_count += burnish_mesh_get_material(mesh->mesh, i)->coat > 0;
    }
    shading->coats = NULL;
    if (coat_count == 0) {
        return BURNISH_STATUS_OK;
    }
    coats->items = burnish_reserve_discard(memory, coats->items, &coats->item_capacity, coat_count,
                                           sizeof *coats->items, "coats");
    coats->numbers = burnish_reserve_discard(memory, coats->numbers, &coats->number_capacity, count,
                                             sizeof *coats->numbers, "coats");
    coats->shares = burnish_reserve_discard(memory, coats->shares, &coats->share_capacity, count,
                                            sizeof *coats->shares, "coats");
    for (size_t i = 0; i < count && memory->status == BURNISH_STATUS_OK; ++i) {
        const burnish_material *base = burnish_mesh_get_material(mesh->mesh, i);
        coats->shares[i] = base->coat;
        coats->numbers[i] = -1;
        if (base->coat > 0) {
            coats->numbers[i] = (int32_t)(count + mesh->coat_count);
            coats->items[mesh->coat_count++] = (burnish_coat){coat_material(base), i};
        }
    }
    mesh->coats = coats->items;
    shading->coats = coats->numbers;
    shading->coat_shares = coats->shares;
    return memory->status;
}

void burnish_coats_destroy(burnish_coats *coats, const burnish_context *context) {
    burnish_release(context, coats->items);
    burnish_release(context, coats->numbers);
    burnish_release(context, coats->shares);
}

/* Toward the viewer from point i, of any length. */
static void find_viewer(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                        int i, float viewer[3]) {
    for (int k = 0; k < 3; ++k) {
        viewer[k] = shader->local_viewer ? shader->viewer[k] * points->w[i] - points->position[k][i]
                                         : shader->viewer[k];
    }
}

static float dot_of(const float a[3], const float b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

void burnish_coat_weigh(const burnish_shading *shading, const burnish_kernels_points *points,
                        int count, int base, burnish_fragment_scratch *scratch) {
    const burnish_kernels_shader *white = shading->white;
    const float *ambient = white->ambient[BURNISH_SHADE_FLOAT];
    const burnish_textured_material *textured =
        shading->texturing ? &shading->texturing->materials[shading->coats[base]] : NULL;
    const int has_normals = textured && textured->has_normals;
    const int has_share = textured && textured->samplers[BURNISH_TEXTURE_OPACITY].levels;
    const float *normal[3];
    for (int k = 0; k < 3; ++k) {
        normal[k] = has_normals ? scratch->texture.normal[k] : points->normal[k];
    }
    for (int i = 0; i < count; ++i) {
        const float n[3] = {normal[0][i], normal[1][i], normal[2][i]};
        float v[3];
        find_viewer(white, points, i, v);
        const float squares = dot_of(n, n) * dot_of(v, v), along = dot_of(n, v);
        const float cosine = along > 0 ? along / __builtin_sqrtf(squares) : 0;
        const float fall = cosine < 1 ? 1 - cosine : 0, squared = fall * fall;
        const float fresnel =
            COAT_REFLECTANCE + (1 - COAT_REFLECTANCE) * ((squared * squared) * fall);
        float share = shading->coat_shares[base];
        share *= has_share ? scratch->texture.opacity[i] : 1;
        scratch->below[i] = 1 - share * fresnel;
        for (int k = 0; k < 3; ++k) { /* the ambient light comes from everywhere */
            scratch->coat[k][i] = share * (scratch->coat[k][i] + fresnel * ambient[k]);
        }
    }
}
