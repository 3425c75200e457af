/* Material libraries. */
#ifndef BURNISH_MESH_READ_OBJ_MTL_H
#define BURNISH_MESH_READ_OBJ_MTL_H

#include "mesh/read/io/reader.h"

/* A texture that a material names. */
typedef struct burnish_mtl_map {
    char *file; /* NULL: none */
    float scale[2], offset[2], bump;
    int is_clamped;
    int is_ambient; /* 1: of map_Ka, which map_Kd replaces */
    int is_height;  /* 1: a height map, unless it looks like a normal map */
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

/* ---- mtl_maps.c ---- */

/* Whether a statement names a texture. */
int burnish_mtl_is_map(burnish_token keyword);

/* Reads one; lexer: after the keyword. Unsupported maps go to `unsupported`. Errors: the mesh's
 * memory. */
void burnish_mtl_read_map(burnish_reader *reader, burnish_mtl_entry *entry, burnish_token keyword,
                          burnish_lexer *lexer, burnish_warning_group *unsupported);

/* The material of an entry with its textures, which are loaded. reader: the OBJ's. Errors: the
 * mesh's memory. */
burnish_material burnish_mtl_load_maps(burnish_reader *reader, const burnish_mtl_entry *entry);

void burnish_mtl_release_maps(const burnish_context *context, burnish_mtl_entry *entry);

#endif
