/* Materials of an OBJ file: its libraries, and which of its triangles have which material. */
#ifndef BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H
#define BURNISH_MESH_READ_OBJ_OBJ_MATERIALS_H

#include "mesh/read/io/parallel_text.h"
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

/* ---- obj_statements.c ---- */

/* The events of a chunk. */
enum {
    BURNISH_OBJ_MATERIAL, /* located after usemtl */
    BURNISH_OBJ_LIBRARY,  /* and mtllib */
    BURNISH_OBJ_OBJECT,   /* located after o */
    BURNISH_OBJ_GROUP,    /* and g */
    BURNISH_OBJ_ELEMENT,  /* l or p */
    BURNISH_OBJ_FEW_CORNERS,
    BURNISH_OBJ_COLOR,  /* an invalid colour follows a vertex */
    BURNISH_OBJ_NORMAL, /* an invalid normal follows vn */
    BURNISH_OBJ_FREE_FORM,
    BURNISH_OBJ_PAINT, /* located after #MRGB */
    BURNISH_OBJ_OTHER
};

/* The range of a colour is known only at the end of the file. Until then alpha records what the
 * colour's numbers counted to; a vertex without a colour has 255. */
enum { BURNISH_OBJ_COUNTS_TO_1 = 1, BURNISH_OBJ_COUNTS_TO_255 = 2 };

/* Reads statements from chunk->first on until one ends at chunk->end or after it.
 *   origin  subtracted from positions */
void burnish_obj_parse(burnish_chunk *chunk, int with_texcoords, const double origin[3]);

/* Removes and returns the part of a corner before the next '/'. */
burnish_token burnish_obj_cut_part(burnish_token *token);

#endif
