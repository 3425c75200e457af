/* Materials of an OBJ file: its libraries, and which of its triangles have which material. */
#ifndef BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H
#define BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H

#include "mesh/read/obj/mtl.h"

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
    burnish_token libraries[BURNISH_OBJ_LIBRARIES]; /* names requested so far */
    size_t library_count;
    int library_missing;             /* already reported: no warning about the materials in it */
    int library_limit;               /* already reported: no more are read */
    burnish_warning_group missing;   /* materials that are in no library */
    burnish_warning_group elsewhere; /* libraries whose paths lead elsewhere */
} burnish_obj_materials;

void burnish_obj_materials_close(burnish_obj_materials *materials);

/* usemtl NAME */
void burnish_obj_use_material(burnish_obj_materials *materials, burnish_token name);

/* Call before a triangle: begins a run if the material has changed. Errors: MEMORY. */
burnish_status burnish_obj_begin_run(burnish_obj_materials *materials, size_t first_triangle);

/* mtllib FILE, where FILE may hold blanks, or mtllib FILE FILE ...; lexer: after the keyword.
 * Errors: MEMORY. */
burnish_status burnish_obj_read_libraries(burnish_obj_materials *materials, burnish_lexer *lexer);

/* At the end: sets the materials of the mesh and of its triangles. Errors: LIMIT, MEMORY. */
burnish_status burnish_obj_resolve_materials(burnish_obj_materials *materials);

#endif
