/* Primitives of nodes to triangles, lines or points. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_GEOMETRY_H
#define BURNISH_MESH_READ_GLTF_GLTF_GEOMETRY_H

#include "mesh/read/gltf/gltf.h"

/* Fills the mesh's streams from the nodes that are drawn. */
void burnish_gltf_read_geometry(burnish_gltf *gltf);

#endif
