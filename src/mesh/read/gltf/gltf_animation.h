/* Nodes and weights at a given time. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_ANIMATION_H
#define BURNISH_MESH_READ_GLTF_GLTF_ANIMATION_H

#include "mesh/read/gltf/gltf.h"

/* Fills gltf->poses and gltf->weights, if the options name a time or an animation. */
void burnish_gltf_animate(burnish_gltf *gltf);

#endif
