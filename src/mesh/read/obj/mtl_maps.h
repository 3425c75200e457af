/* The textures of a material library. */
#ifndef BURNISH_MESH_READ_OBJ_MTL_MAPS_H
#define BURNISH_MESH_READ_OBJ_MTL_MAPS_H

#include "mesh/read/obj/mtl.h"

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
