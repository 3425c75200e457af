/* Textures of materials. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_TEXTURES_H
#define BURNISH_MESH_READ_GLTF_GLTF_TEXTURES_H

#include "mesh/read/gltf/gltf.h"

/* The set of texture coordinates that most textures of a material use, of two sets that of the
 * base colour: vertices have one. 0 where the material is none. */
unsigned burnish_gltf_texture_set(const burnish_gltf *gltf, uint32_t material);

/* How a material uses the texture that `object` names under a key; all 0 where it names none, and
 * where the texture can't be had.
 *   strength  the member that scales it, NULL: none */
burnish_texture_use burnish_gltf_read_texture(burnish_gltf *gltf, uint32_t object, const char *key,
                                              int is_color, const char *strength);

/* What messages call an image. */
typedef struct burnish_gltf_name {
    char text[120];
} burnish_gltf_name;
burnish_gltf_name burnish_gltf_image_name(const burnish_gltf *gltf, uint32_t image);

/* Decodes the pictures that materials are going to ask for; the second function releases those that
 * none did. Nothing but the time depends on it. */
void burnish_gltf_decode_ahead(burnish_gltf *gltf);
void burnish_gltf_drop_ahead(burnish_gltf *gltf);

#endif
