/* Material libraries with a place for their warnings. */
#ifndef ORACLE_MESH_READ_MTL_H
#define ORACLE_MESH_READ_MTL_H

#include "oracle/reader.h"

/* oracle_read_mtl() that appends to library and leaves its warnings in source; NULL: nowhere. */
burnish_status oracle_read_mtl_into(const uint8_t *bytes, size_t size, const char *name,
                                    oracle_mtl *library, oracle_source *source,
                                    burnish_error *error);

#endif
