/* Material libraries of an OBJ file, and which of its triangles have which material. */
#ifndef ORACLE_MESH_READ_OBJ_MATERIALS_H
#define ORACLE_MESH_READ_OBJ_MATERIALS_H

#include "oracle/mtl.h"
#include "oracle/text.h"

enum { ORACLE_OBJ_LIBRARIES = 64 /* that one file may name */ };

/* Triangles from first_triangle on have this material. */
typedef struct oracle_obj_run {
    oracle_token name; /* bytes of the input; empty: no usemtl yet */
    size_t first_triangle;
    const struct oracle_obj_run *head; /* the first run of this name */
    const oracle_mtl_entry *entry;     /* of a head; NULL: in no library */
    uint32_t material;
} oracle_obj_run;

/* Start from all zero but for input, source, error, and changed = 1. */
typedef struct oracle_obj_materials {
    const oracle_reader_input *input;
    oracle_source *source;
    burnish_error *error;

    oracle_obj_run *runs;
    size_t run_count, run_capacity;
    oracle_token name; /* of the last usemtl */
    int changed;       /* since the last run began */

    oracle_mtl library;
    oracle_token libraries[ORACLE_OBJ_LIBRARIES]; /* names already asked for */
    size_t library_count;
    int library_missing; /* said so already: no word about the materials in it */
    int warned_libraries;
} oracle_obj_materials;

void oracle_obj_materials_close(oracle_obj_materials *materials);

/* usemtl NAME */
void oracle_obj_use_material(oracle_obj_materials *materials, oracle_token name);

/* A triangle follows: begins a run where the material has changed. Errors: MEMORY. */
burnish_status oracle_obj_begin_run(oracle_obj_materials *materials, size_t first_triangle);

/* mtllib FILE, where FILE may hold blanks, or mtllib FILE FILE ...; text: behind the keyword.
 * Errors: those of a library's text, MEMORY. */
burnish_status oracle_obj_read_libraries(oracle_obj_materials *materials, oracle_text *text);

/* At the end: the source's materials and those of its triangles. Errors: LIMIT, MEMORY. */
burnish_status oracle_obj_resolve_materials(oracle_obj_materials *materials);

#endif
