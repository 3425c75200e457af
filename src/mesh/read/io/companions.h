/* Files that an input names: from its spelling of a name to the one that the loader takes. */
#ifndef BURNISH_MESH_READ_IO_COMPANIONS_H
#define BURNISH_MESH_READ_IO_COMPANIONS_H

#include "mesh/read/io/reader.h"

enum { BURNISH_COMPANION_SIZE = 4096 };

/* Writes a name relative to the folder that the loader reads from: without "..", if the name has it
 * or the input is in a folder below. Slashes separate parts. Returns 0 for a name that is absolute,
 * leads out of that folder, or is too long. */
int burnish_companion_path(const burnish_reader_input *input, const char *name,
                           char path[BURNISH_COMPANION_SIZE]);

/* The error for a name that leads out, with the root in which it could be. READ. */
burnish_status burnish_companion_outside(const burnish_reader_input *input, const char *name,
                                         burnish_error *error);

/* Adds to the error about a file that does not exist the root in which it could be. */
void burnish_companion_missing(const burnish_reader_input *input, burnish_error *error);

#endif
