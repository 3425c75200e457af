/* Material libraries with a place for their warnings. */
#ifndef BURNISH_MESH_READ_MTL_H
#define BURNISH_MESH_READ_MTL_H

#include "mesh/read/reader.h"

/* burnish_read_mtl() that appends to library and leaves its warnings in source; NULL: nowhere. */
burnish_status burnish_read_mtl_into(const uint8_t *bytes, size_t size, const char *name,
                                     burnish_mtl *library, burnish_source *source,
                                     burnish_error *error);

#endif
