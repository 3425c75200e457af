/* Primitives that a separate decoder unpacks. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_DRACO_H
#define BURNISH_MESH_READ_GLTF_GLTF_DRACO_H

#include "mesh/read/gltf/gltf.h"

/* The first bytes of a decoder's answer. */
#define BURNISH_DRACO_MAGIC                                                                        \
    "\x89"                                                                                         \
    "BDA\r\n\x1a\n"

/* Gives the accessors of compressed primitives their values; the second function releases them. */
void burnish_gltf_decode_draco(burnish_gltf *gltf);
void burnish_gltf_release_draco(burnish_gltf *gltf);

/* The extension of a primitive that must be unpacked; NONE: it is not compressed. */
uint32_t burnish_gltf_draco(burnish_gltf *gltf, uint32_t primitive);

#endif
