/* Built-in objects. */
#ifndef BURNISH_MESH_BUILTIN_H
#define BURNISH_MESH_BUILTIN_H

#include "mesh/data/data.h"

/* name without the colon: "teapot", "sphere", "torus", "knot". */
burnish_status burnish_make_builtin(const char *name, const burnish_load_options *options,
                                    burnish_mesh_data *data, burnish_error *error);

#endif
