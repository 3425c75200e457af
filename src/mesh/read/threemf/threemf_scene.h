/* Objects of the build. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_SCENE_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_SCENE_H

#include "mesh/read/threemf/threemf.h"

/* Writes the objects that are built to the mesh. Returns 0 on failure. */
int burnish_threemf_write_scene(burnish_threemf *threemf);

#endif
