/* Material libraries. */
#ifndef BURNISH_MESH_READ_OBJ_MTL_H
#define BURNISH_MESH_READ_OBJ_MTL_H

#include "mesh/read/io/reader.h"

/* A texture that a material names. */
typedef struct burnish_mtl_map {
    char *file; /* NULL: none */
    float scale[2], offset[2], bump;
    int is_clamped;
    int is_height; /* 1: a height map, unless it looks like a normal map */
} burnish_mtl_map;

typedef struct burnish_mtl_entry {
    char *name;
    burnish_mtl_map maps[BURNISH_TEXTURE_SLOT_COUNT];
    float diffuse[3]; /* Kd as written: the factor of a texture */
    int is_invisible; /* 1: fully transparent in the file, and therefore opaque here */
    burnish_material material;
} burnish_mtl_entry;

typedef struct burnish_mtl {
    burnish_mtl_entry *entries;
    size_t count, capacity;
} burnish_mtl;

/* Appends the materials of a file to library. library_file: reads the MTL, its mesh takes the
 * warnings. Errors: MEMORY. */
burnish_status burnish_read_mtl(burnish_reader *library_file, burnish_mtl *library);

void burnish_mtl_destroy(const burnish_context *context, burnish_mtl *library);

#endif
