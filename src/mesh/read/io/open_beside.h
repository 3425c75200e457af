/* Opening a file that an input names. */
#ifndef BURNISH_MESH_READ_IO_OPEN_BESIDE_H
#define BURNISH_MESH_READ_IO_OPEN_BESIDE_H

#include "core/memory.h"

/* Opens a file to be read, without waiting for what is no file. Links are followed as long as they
 * stay in the folder, where the system can tell, else none is.
 *   input  the path of a file in the folder
 *   name   relative to it, with slashes, without ".."; the case of letters is ignored where no file
 *          has it
 * Returns a descriptor, or -1 with errno set: EXDEV or ELOOP where a link leads out. On shortage of
 * memory memory->status is set. */
int burnish_open_beside(const char *input, const char *name, burnish_memory *memory);

#endif
