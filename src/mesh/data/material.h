/* Materials and textures: checks, and who owns their memory. */
#ifndef BURNISH_MESH_DATA_MATERIAL_H
#define BURNISH_MESH_DATA_MATERIAL_H

#include "mesh/data/data.h"

/* Releases textures with their names and pixels. */
void burnish_textures_release(const burnish_context *context, burnish_texture *textures,
                              size_t count);

/* Appends a texture. Takes ownership of `pixels`, 4 bytes per texel, also on failure.
 *   name  copied; may be NULL
 * Returns 1 + its number, 0 on failure: mesh->memory has the status. */
int burnish_mesh_data_add_texture(burnish_mesh_data *mesh, const char *name, int width, int height,
                                  uint8_t *pixels, int is_color);

/* Fails with ARGUMENT if a number of a material is out of range, or a texture is not one of
 * `texture_count`. The message starts with `name`. */
burnish_status burnish_check_material(const burnish_material *material, size_t texture_count,
                                      const char *name, burnish_error *error);

/* Whether a material uses any texture. */
static inline int burnish_material_has_textures(const burnish_material *material) {
    int any = 0;
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        any |= material->textures[slot].texture;
    }
    return any != 0;
}

/* Whether a material has directions along the surface. */
static inline int burnish_material_needs_tangents(const burnish_material *material) {
    const float x = material->anisotropy[0], y = material->anisotropy[1];
    return material->textures[BURNISH_TEXTURE_NORMAL].texture ||
           material->textures[BURNISH_TEXTURE_COAT_NORMAL].texture || x * x + y * y > 0;
}

#endif
