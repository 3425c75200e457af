/* The statements of OBJ: parsing a chunk, and its events. */
#ifndef BURNISH_MESH_READ_OBJ_OBJ_STATEMENTS_H
#define BURNISH_MESH_READ_OBJ_OBJ_STATEMENTS_H

#include "mesh/read/io/chunks.h"

/* The events of a chunk. */
enum {
    BURNISH_OBJ_MATERIAL, /* located after usemtl */
    BURNISH_OBJ_LIBRARY,  /* and mtllib */
    BURNISH_OBJ_ELEMENT,  /* l or p */
    BURNISH_OBJ_FEW_CORNERS,
    BURNISH_OBJ_COLOR,  /* an invalid colour follows a vertex */
    BURNISH_OBJ_NORMAL, /* an invalid normal follows vn */
    BURNISH_OBJ_FREE_FORM,
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
