/* Layers over materials: sheen, and clear coats. A coat is a material of its own, which is shaded
 * before its base and laid over it. */
#include <string.h>

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

static int has_sheen(const burnish_material *base) {
    return base->sheen[0] > 0 || base->sheen[1] > 0 || base->sheen[2] > 0;
}

burnish_status burnish_layering_update(burnish_layering *layering, burnish_drawn_mesh *mesh,
                                       burnish_shading *shading, burnish_memory *memory) {
    const size_t count = mesh->material_count;
    size_t coat_count = 0, sheen_count = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_material *base = burnish_mesh_get_material(mesh->mesh, i);
        coat_count += base->coat > 0;
        sheen_count += has_sheen(base);
    }
    shading->layers = NULL;
    if (coat_count + sheen_count == 0) {
        return BURNISH_STATUS_OK;
    }
    layering->coats = burnish_reserve_discard(memory, layering->coats, &layering->coat_capacity,
                                              coat_count, sizeof *layering->coats, "coats");
    layering->layers = burnish_reserve_discard(memory, layering->layers, &layering->layer_capacity,
                                               count, sizeof *layering->layers, "layers");
    for (size_t i = 0; i < count && memory->status == BURNISH_STATUS_OK; ++i) {
        const burnish_material *base = burnish_mesh_get_material(mesh->mesh, i);
        layering->layers[i] = (burnish_layers){base, -1, has_sheen(base)};
        if (base->coat > 0) {
            layering->layers[i].coat = (int)(count + mesh->coat_count);
            layering->coats[mesh->coat_count++] = (burnish_coat){coat_material(base), i};
        }
    }
    mesh->coats = layering->coats;
    shading->layers = layering->layers;
    return memory->status;
}

void burnish_layering_destroy(burnish_layering *layering, const burnish_context *context) {
    burnish_release(context, layering->coats);
    burnish_release(context, layering->layers);
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

/* What a coat that was just shaded reflects becomes what is seen of it, times its share, and
 * scratch->below what it leaves of the light below it. */
static void weigh_coat(const burnish_shading *shading, const burnish_kernels_points *points,
                       int count, const burnish_layers *layers, burnish_fragment_scratch *scratch) {
    const burnish_kernels_shader *white = shading->white;
    const float *ambient = white->ambient[BURNISH_SHADE_FLOAT];
    const burnish_textured_material *textured =
        shading->texturing ? &shading->texturing->materials[layers->coat] : NULL;
    const int has_normals = textured && textured->has_normals;
    const int has_share = textured && textured->samplers[BURNISH_TEXTURE_OPACITY].levels;
    const float *normal[3];
    for (int k = 0; k < 3; ++k) {
        normal[k] = has_normals ? scratch->texture->normal[k] : points->normal[k];
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
        float share = layers->material->coat;
        share *= has_share ? scratch->texture->opacity[i] : 1;
        scratch->below[i] = 1 - share * fresnel;
        for (int k = 0; k < 3; ++k) { /* the ambient light comes from everywhere */
            scratch->coat[k][i] = share * (scratch->coat[k][i] + fresnel * ambient[k]);
        }
    }
}

/* Sheen scatters back: its light comes from around a direction that leans from N to the viewer by
 * 0.5 / roughness - 0.3 (fitted to sums under windows). */
static void lean_normals(const burnish_shading *shading, const burnish_kernels_points *points,
                         int count, const burnish_sheen_points *sheen,
                         float (*leaned)[BURNISH_SHADE_BATCH]) {
    for (int i = 0; i < count; ++i) {
        const float n[3] = {points->normal[0][i], points->normal[1][i], points->normal[2][i]};
        const float own = sheen->roughness * (sheen->each[3] ? sheen->each[3][i] : 1);
        const float lean = 0.5f / (own > 0.1f ? own : 0.1f) - 0.3f;
        float v[3];
        find_viewer(shading->white, points, i, v);
        const float squares = dot_of(n, n), along = dot_of(n, v) / squares;
        const float scale = lean * __builtin_sqrtf(squares / dot_of(v, v));
        for (int k = 0; k < 3; ++k) {
            leaned[k][i] = n[k] + scale * (v[k] - along * n[k]);
        }
    }
}

/* What arrives of light from many directions. */
static void find_wide(const burnish_shading *shading, const burnish_kernels_points *points,
                      int count, burnish_fragment_scratch *scratch, burnish_sheen_points *sheen) {
    float *const wide[3] = {scratch->wide[0], scratch->wide[1], scratch->wide[2]};
    burnish_kernels_points leaned = *points;
    lean_normals(shading, points, count, sheen, scratch->leaned);
    for (int k = 0; k < 3; ++k) {
        leaned.normal[k] = scratch->leaned[k];
        sheen->wide[k] = wide[k];
        memset(wide[k], 0, sizeof scratch->wide[k]);
    }
    burnish_area_add_white(shading->area, shading->kernels, &leaned, count, wide);
}

/* Lays sheen over a material that was just shaded. */
static void add_sheen(const burnish_shading *shading, const burnish_kernels_points *given,
                      int count, int material, burnish_fragment_scratch *scratch,
                      float *const rgb[3]) {
    const burnish_layers *layers = &shading->layers[material];
    const burnish_texture_scratch *textures = scratch->texture;
    const burnish_textured_material *textured =
        shading->texturing ? &shading->texturing->materials[material] : NULL;
    burnish_kernels_points points = *given;
    burnish_sheen_points sheen = {.roughness = layers->material->sheen_roughness};
    memcpy(sheen.color, layers->material->sheen, sizeof sheen.color);
    if (textured && textured->is_special) {
        const burnish_texture_sampler *samplers = textured->samplers;
        for (int k = 0; k < 3; ++k) {
            points.normal[k] = textured->has_normals && textured->is_varied ? textures->normal[k]
                                                                            : points.normal[k];
            sheen.each[k] =
                samplers[BURNISH_TEXTURE_SHEEN_COLOR].levels ? textures->sheen[k] : NULL;
        }
        sheen.each[3] =
            samplers[BURNISH_TEXTURE_SHEEN_ROUGHNESS].levels ? textures->sheen[3] : NULL;
        sheen.open = samplers[BURNISH_TEXTURE_OCCLUSION].levels ? textures->open : NULL;
    }
    if (shading->area) {
        find_wide(shading, &points, count, scratch, &sheen);
    }
    shading->kernels->lay_sheen(shading->white, &sheen, &points, (size_t)count, rgb);
}

void burnish_shade_layers(const burnish_shading *shading, const burnish_fragment_batch *batch,
                          const burnish_kernels_points *points,
                          float (*streams)[BURNISH_SHADE_BATCH], int material,
                          burnish_fragment_scratch *scratch, float *const rgb[3]) {
    const burnish_layers *layers = shading->layers ? &shading->layers[material] : NULL;
    const int has_coat = layers && layers->coat >= 0;
    if (has_coat) {
        float *const light[3] = {scratch->coat[0], scratch->coat[1], scratch->coat[2]};
        burnish_shade_material(shading, batch, points, streams, layers->coat, scratch, light);
        weigh_coat(shading, points, batch->count, layers, scratch);
    }
    burnish_shade_material(shading, batch, points, streams, material, scratch, rgb);
    if (layers && layers->has_sheen) {
        add_sheen(shading, points, batch->count, material, scratch, rgb);
    }
    for (int i = 0; has_coat && i < 3 * batch->count; ++i) {
        const int k = i % 3, at = i / 3;
        rgb[k][at] = rgb[k][at] * scratch->below[at] + scratch->coat[k][at];
    }
}
