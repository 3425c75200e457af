/* Textures of materials. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_TEXTURES_H
#define BURNISH_MESH_READ_GLTF_GLTF_TEXTURES_H

#include "mesh/read/gltf/gltf.h"

/* Vertices have one set of texture coordinates: the set that most textures of a material use, or
 * the base colour's in a tie. 0 if there is no material. */
unsigned burnish_gltf_texture_set(const burnish_gltf *gltf, uint32_t material);

/* How a material uses the texture that `object` names under a key; all 0 if it names no texture, or
 * the texture can't be loaded.
 *   strength  the member that scales it; NULL: not scaled */
burnish_texture_use burnish_gltf_read_texture(burnish_gltf *gltf, uint32_t object, const char *key,
                                              int is_color, const char *strength);

/* The name of an image in messages. */
typedef struct burnish_gltf_name {
    char text[120];
} burnish_gltf_name;
burnish_gltf_name burnish_gltf_image_name(const burnish_gltf *gltf, uint32_t image);

/* Decodes the pictures of the materials ahead; the second function releases those not used. This
 * affects only the time. */
void burnish_gltf_decode_ahead(burnish_gltf *gltf);
void burnish_gltf_drop_ahead(burnish_gltf *gltf);

#endif
