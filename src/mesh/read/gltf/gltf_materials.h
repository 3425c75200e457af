/* Materials. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_MATERIALS_H
#define BURNISH_MESH_READ_GLTF_GLTF_MATERIALS_H

#include "mesh/read/gltf/gltf.h"

/* Fills the mesh's materials: one per item of MATERIALS, and one more if there are primitives
 * without a material. */
void burnish_gltf_read_materials(burnish_gltf *gltf);

#endif
