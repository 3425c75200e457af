/* Cameras and lights. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_SCENE_H
#define BURNISH_MESH_READ_GLTF_GLTF_SCENE_H

#include "mesh/read/gltf/gltf.h"

/* Fills the mesh's cameras, from the nodes that have one. */
void burnish_gltf_read_cameras(burnish_gltf *gltf);

/* Fills the mesh's lights, from the nodes that have one (KHR_lights_punctual). */
void burnish_gltf_read_lights(burnish_gltf *gltf);

#endif
