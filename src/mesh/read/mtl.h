/* Material libraries, with names for usemtl to find. */
#ifndef BURNISH_MESH_READ_MTL_H
#define BURNISH_MESH_READ_MTL_H

#include "mesh/read/reader.h"

typedef struct burnish_mtl_entry {
    char *name;
    char *texture; /* the file of its first map, which is not drawn; NULL: none */
    int is_transparent;
    burnish_material material;
} burnish_mtl_entry;

typedef struct burnish_mtl {
    burnish_mtl_entry *entries;
    size_t count, capacity;
} burnish_mtl;

/* Appends the materials of a file to library. library_file: reads the MTL, its mesh takes the
 * warnings. Errors: FORMAT, MEMORY. */
burnish_status burnish_read_mtl(burnish_reader *library_file, burnish_mtl *library);

void burnish_mtl_destroy(const burnish_context *context, burnish_mtl *library);

#endif
