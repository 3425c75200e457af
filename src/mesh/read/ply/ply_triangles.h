/* Attributes of triangles that vertices lack. */
#ifndef BURNISH_MESH_READ_PLY_PLY_TRIANGLES_H
#define BURNISH_MESH_READ_PLY_PLY_TRIANGLES_H

#include "mesh/read/ply/ply_rows.h"

/* Starts to use texture n of the header at a triangle; BURNISH_PLY_TEXTURES_MAX: no texture. */
burnish_status burnish_ply_use_texture(burnish_ply_state *ply, size_t triangle, int texture);

/* After all triangles: gives them the colours and texture coordinates that were read for them, if
 * every triangle has them. */
burnish_status burnish_ply_settle_triangles(burnish_ply_state *ply);

/* Loads the header's textures, and makes the materials that show them. */
burnish_status burnish_ply_load_textures(burnish_ply_state *ply);

#endif
