/* The mesh of a frame. */
#ifndef BURNISH_RENDER_DRAWN_MESH_H
#define BURNISH_RENDER_DRAWN_MESH_H

#include "burnish/mesh.h"

typedef struct burnish_drawn_mesh {
    const burnish_mesh *mesh;      /* for its materials and textures */
    const burnish_mesh_view *view; /* of the mesh */
    size_t material_count;
    int ignore_colors; /* 1: as if its vertices had no colours */
} burnish_drawn_mesh;

#endif
