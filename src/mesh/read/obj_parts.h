/* OBJ files by threads. */
#ifndef BURNISH_MESH_READ_OBJ_PARTS_H
#define BURNISH_MESH_READ_OBJ_PARTS_H

#include "mesh/read/obj_materials.h"

/* Reads the whole file with the threads of source->pool.
 *
 * done: 0: nothing was read, since that does not pay or since something is wrong or unusual, which
 *       reading statement by statement will tell; source and materials are as they were
 * Errors: those of material libraries, MEMORY for runs; all else makes it give up. */
burnish_status burnish_obj_read_parts(const burnish_reader_input *input, burnish_source *source,
                                      burnish_obj_materials *materials, int *done);

#endif
