/* Textures, texture coordinates and tangents. */
#ifndef BURNISH_MESH_BUILD_TEXTURES_H
#define BURNISH_MESH_BUILD_TEXTURES_H

#include "mesh/build/builder.h"

/* Drops textures, coordinates and tangents that the mesh does not need, before it is built. */
void burnish_build_prepare_textures(burnish_builder *b, const burnish_load_options *options);

/* Generates tangents that are needed but missing from the file. Makes them unit vectors at right
 * angles to the normals. Mirrored triangles may get separate vertices. Errors: MEMORY, LIMIT,
 * CANCELLED. */
burnish_status burnish_build_tangents(burnish_builder *b);

#endif
