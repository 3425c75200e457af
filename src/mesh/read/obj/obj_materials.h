/* Materials of an OBJ file: its libraries, and which of its triangles have which material. */
#ifndef BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H
#define BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H

#include "mesh/read/io/reader.h"

/* ---- mtl.c: material libraries, with names for usemtl to find ---- */

/* A texture that a material names. */
typedef struct burnish_mtl_map {
    char *file; /* NULL: none */
    float scale[2], offset[2], bump;
    int is_clamped;
    int is_height; /* 1: a picture of heights, unless it looks like one of normals */
} burnish_mtl_map;

typedef struct burnish_mtl_entry {
    char *name;
    burnish_mtl_map maps[BURNISH_TEXTURE_SLOT_COUNT];
    float diffuse[3]; /* Kd as written: what it multiplies a texture by */
    int is_invisible; /* 1: wholly transparent in the file, and therefore opaque here */
    burnish_material material;
} burnish_mtl_entry;

typedef struct burnish_mtl {
    burnish_mtl_entry *entries;
    size_t count, capacity;
} burnish_mtl;

/* Appends the materials of a file to library. library_file: reads the MTL, its mesh takes the
 * warnings. Errors: MEMORY. */
burnish_status burnish_read_mtl(burnish_reader *library_file, burnish_mtl *library);

/* ---- mtl_maps.c: the textures of a library ---- */

/* Whether a statement names a texture. */
int burnish_mtl_is_map(burnish_token keyword);

/* Reads one; lexer: after the keyword. What is not drawn goes to `unsupported`. Errors: the mesh's
 * memory. */
void burnish_mtl_read_map(burnish_reader *reader, burnish_mtl_entry *entry, burnish_token keyword,
                          burnish_lexer *lexer, burnish_warning_group *unsupported);

/* The material of an entry with its textures, which are loaded. reader: the OBJ's. Errors: the
 * mesh's memory. */
burnish_material burnish_mtl_load_maps(burnish_reader *reader, const burnish_mtl_entry *entry);

void burnish_mtl_release_maps(const burnish_context *context, burnish_mtl_entry *entry);

void burnish_mtl_destroy(const burnish_context *context, burnish_mtl *library);

/* ---- obj_materials.c ---- */

enum { BURNISH_OBJ_LIBRARIES = 64 /* that one file may name */ };

/* Triangles from first_triangle on have this material. */
typedef struct burnish_obj_run {
    burnish_token name; /* bytes of the input; empty: no usemtl yet */
    size_t first_triangle;
    const struct burnish_obj_run *head; /* the first run of this name */
    const burnish_mtl_entry *entry;     /* of a head; NULL: in no library */
    uint32_t material;
} burnish_obj_run;

/* Start from all zero but for reader, and changed = 1. */
typedef struct burnish_obj_materials {
    burnish_reader *reader;

    burnish_obj_run *runs;
    size_t run_count, run_capacity;
    burnish_token name; /* of the last usemtl */
    int changed;        /* since the last run began */

    burnish_mtl library;
    burnish_token libraries[BURNISH_OBJ_LIBRARIES]; /* names already asked for */
    size_t library_count;
    int library_missing;             /* said so already: no word about the materials in it */
    int library_limit;               /* said so already: no further one is read */
    burnish_warning_group missing;   /* materials that are in no library */
    burnish_warning_group elsewhere; /* libraries whose paths lead elsewhere */
} burnish_obj_materials;

void burnish_obj_materials_close(burnish_obj_materials *materials);

/* usemtl NAME */
void burnish_obj_use_material(burnish_obj_materials *materials, burnish_token name);

/* A triangle follows: begins a run where the material has changed. Errors: MEMORY. */
burnish_status burnish_obj_begin_run(burnish_obj_materials *materials, size_t first_triangle);

/* mtllib FILE, where FILE may hold blanks, or mtllib FILE FILE ...; lexer: after the keyword.
 * Errors: MEMORY. */
burnish_status burnish_obj_read_libraries(burnish_obj_materials *materials, burnish_lexer *lexer);

/* At the end: the mesh's materials and those of its triangles. Errors: LIMIT, MEMORY. */
burnish_status burnish_obj_resolve_materials(burnish_obj_materials *materials);

#endif
