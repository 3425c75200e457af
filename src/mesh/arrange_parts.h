/* Leaving out parts, and moving them apart, between reading and building. */
#ifndef BURNISH_MESH_ARRANGE_PARTS_H
#define BURNISH_MESH_ARRANGE_PARTS_H

#include "mesh/data/data.h"

/* Applies burnish_load_options.hidden_parts, only_parts and explode to a mesh with parts.
 *   name  of the file, for messages
 * Errors: ARGUMENT, LIMIT, MEMORY. */
burnish_status burnish_arrange_parts(burnish_mesh_data *mesh, const char *name,
                                     const burnish_load_options *options, burnish_error *error);

#endif
