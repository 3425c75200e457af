/* From mesh data to a mesh. */
#ifndef BURNISH_MESH_BUILD_BUILD_H
#define BURNISH_MESH_BUILD_BUILD_H

#include "mesh/data/mesh.h"

/* Welds positions, turns and orders triangles, drops those without area, generates normals. Takes
 * arrays out of the data, which the caller still destroys. *mesh is NULL on error.
 *   name     of the input, for messages, which go to the data's memory.error
 *   options  checked
 *   format   determines the up axis and the crease angle
 * Errors: FORMAT, MEMORY, CANCELLED. */
burnish_status burnish_mesh_build(burnish_mesh_data *data, const char *name,
                                  const burnish_load_options *options, burnish_format format,
                                  burnish_mesh **mesh);

#endif
