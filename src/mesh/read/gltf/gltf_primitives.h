/* Primitives: their accessors, and how many triangles they make. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_PRIMITIVES_H
#define BURNISH_MESH_READ_GLTF_GLTF_PRIMITIVES_H

#include "mesh/read/gltf/gltf.h"

/* The elements of a primitive. */
typedef enum burnish_gltf_kind {
    BURNISH_GLTF_POINTS,
    BURNISH_GLTF_LINES,
    BURNISH_GLTF_TRIANGLES
} burnish_gltf_kind;

/* Fills gltf->primitives, with the accessors that they name resolved. */
void burnish_gltf_read_primitives(burnish_gltf *gltf);

burnish_gltf_kind burnish_gltf_kind_of(const burnish_gltf_primitive *primitive);

/* Morph targets of a mesh: all its primitives have as many. */
size_t burnish_gltf_target_count(burnish_gltf *gltf, uint32_t mesh);

#endif
