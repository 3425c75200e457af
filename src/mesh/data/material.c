/* Materials and textures of meshes: what they may be, and who owns their memory. */
#include <float.h>
#include <string.h>

#include "base/numbers.h"
#include "mesh/data/material.h"
#include "mesh/data/mesh.h"

/* ---- Textures ---- */

void burnish_textures_release(const burnish_context *context, burnish_texture *textures,
                              size_t count) {
    for (size_t i = 0; i < count; ++i) {
        burnish_release(context, (void *)(uintptr_t)textures[i].name);
        burnish_release(context, (void *)(uintptr_t)textures[i].pixels);
    }
    burnish_release(context, textures);
}

int burnish_mesh_data_add_texture(burnish_mesh_data *mesh, const char *name, int width, int height,
                                  uint8_t *pixels, int is_color) {
    burnish_memory *memory = &mesh->memory;
    char *copy = name ? burnish_allocate(memory, strlen(name) + 1, 1, "a name") : NULL;
    mesh->textures = burnish_reserve(memory, mesh->textures, &mesh->texture_capacity,
                                     mesh->texture_count + 1, sizeof *mesh->textures, "textures");
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, copy);
        burnish_release(memory->context, pixels);
        return 0;
    }
    if (copy) {
        strcpy(copy, name);
    }
    mesh->textures[mesh->texture_count++] =
        (burnish_texture){copy, width, height, pixels, is_color};
    return (int)mesh->texture_count;
}

size_t burnish_mesh_get_texture_count(const burnish_mesh *mesh) {
    return mesh ? mesh->texture_count : 0;
}

const burnish_texture *burnish_mesh_get_texture(const burnish_mesh *mesh, size_t index) {
    return mesh && index < mesh->texture_count ? &mesh->textures[index] : NULL;
}

/* ---- Checks ---- */

static const char *const slot_names[BURNISH_TEXTURE_SLOT_COUNT] = {"color",
                                                                   "specular",
                                                                   "exponent",
                                                                   "metallic_roughness",
                                                                   "normal",
                                                                   "emissive",
                                                                   "occlusion",
                                                                   "opacity",
                                                                   "transmission",
                                                                   "thickness",
                                                                   "sheen_color",
                                                                   "sheen_roughness",
                                                                   "specular_strength",
                                                                   "anisotropy",
                                                                   "iridescence",
                                                                   "film",
                                                                   "coat",
                                                                   "coat_roughness",
                                                                   "coat_normal"};

static burnish_status check_use(const burnish_texture_use *use, int slot, size_t texture_count,
                                const char *name, burnish_error *error) {
    int is_finite = burnish_is_finitef(use->strength);
    for (int i = 0; i < 6 && use->has_transform; ++i) {
        is_finite &= burnish_is_finitef(use->transform[i]);
    }
    if (use->texture < 0 || (size_t)use->texture > texture_count) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: textures[%s].texture is %d; expected 1 to %zu, or 0 for none",
                            name, slot_names[slot], use->texture, texture_count);
    }
    if ((unsigned)use->wrap[0] > BURNISH_WRAP_MIRROR ||
        (unsigned)use->wrap[1] > BURNISH_WRAP_MIRROR) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: textures[%s].wrap is %d, %d; expected 0 to %d", name,
                            slot_names[slot], use->wrap[0], use->wrap[1], BURNISH_WRAP_MIRROR);
    }
    const int has_tangents = slot == BURNISH_TEXTURE_NORMAL || slot == BURNISH_TEXTURE_COAT_NORMAL;
    if ((unsigned)use->coordinates > (has_tangents ? 0u : 1u)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: textures[%s].coordinates is %d; expected 0%s", name,
                            slot_names[slot], use->coordinates,
                            has_tangents ? ", as tangents belong to the first" : " or 1");
    }
    if (!is_finite) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: textures[%s]: transform and strength must be finite", name,
                            slot_names[slot]);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_check_material(const burnish_material *material, size_t texture_count,
                                      const char *name, burnish_error *error) {
    const struct {
        const char *word;
        const float *values;
    } colors[] = {
        {"ambient", material->ambient},   {"diffuse", material->diffuse},
        {"specular", material->specular}, {"reflectance", material->reflectance},
        {"sheen", material->sheen},       {"attenuation_color", material->attenuation_color}};
    const struct {
        const char *word;
        float value, least, most;
    } numbers[] = {{"emissive[0]", material->emissive[0], 0, 1e6f},
                   {"emissive[1]", material->emissive[1], 0, 1e6f},
                   {"emissive[2]", material->emissive[2], 0, 1e6f},
                   {"exponent", material->exponent, 1, 65536},
                   {"transparency", material->transparency, 0, 1},
                   {"metallic", material->metallic, 0, 1},
                   {"roughness", material->roughness, 0, 1},
                   {"edge_loss", material->edge_loss, 0, 1},
                   {"anisotropy[0]", material->anisotropy[0], -1, 1},
                   {"anisotropy[1]", material->anisotropy[1], -1, 1},
                   {"iridescence", material->iridescence, 0, 1},
                   {"film_index", material->film_index, 0, 1e30f},
                   {"film_thickness[0]", material->film_thickness[0], 0, 1e6f},
                   {"film_thickness[1]", material->film_thickness[1], 0, 1e6f},
                   {"sheen_roughness", material->sheen_roughness, 0, 1},
                   {"coat", material->coat, 0, 1},
                   {"coat_roughness", material->coat_roughness, 0, 1},
                   {"alpha_cutoff", material->alpha_cutoff, 0, 1},
                   {"transmission", material->transmission, 0, 1},
                   {"thickness", material->thickness, 0, 1e30f},
                   {"refractive_index", material->refractive_index, 0, 1e30f},
                   {"attenuation_distance", material->attenuation_distance, 0, 1e30f},
                   {"alpha_mode", (float)material->alpha_mode, 0, BURNISH_ALPHA_BLEND}};
    for (int i = 0; i < 15; ++i) {
        const float value = colors[i / 3].values[i % 3];
        if (!(value >= 0 && value <= 1)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: %s[%d] is %g, not in [0, 1]",
                                name, colors[i / 3].word, i % 3, (double)value);
        }
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        if (!(numbers[i].value >= numbers[i].least && numbers[i].value <= numbers[i].most)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: %s is %g, not in [%g, %.7g]",
                                name, numbers[i].word, (double)numbers[i].value,
                                (double)numbers[i].least, (double)numbers[i].most);
        }
    }
    burnish_status status = BURNISH_STATUS_OK;
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT && status == BURNISH_STATUS_OK; ++slot) {
        status = check_use(&material->textures[slot], slot, texture_count, name, error);
    }
    return status;
}
