/* Packed Gaussian splats in a PLY file. */
#ifndef BURNISH_MESH_READ_PLY_PLY_PACKED_H
#define BURNISH_MESH_READ_PLY_PLY_PACKED_H

#include "mesh/read/ply/ply_header.h"

int burnish_ply_is_packed(const burnish_ply_header *header);

/* Errors: FORMAT, LIMIT, MEMORY. */
burnish_status burnish_ply_read_packed(burnish_reader *reader, const burnish_ply_header *header);

#endif
