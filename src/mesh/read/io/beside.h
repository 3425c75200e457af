/* Files that an input names: in its folder, or below. */
#ifndef BURNISH_MESH_READ_IO_BESIDE_H
#define BURNISH_MESH_READ_IO_BESIDE_H

#include "base/memory.h"

/* Opens a file for reading, and never waits for a pipe or device. Links are followed as long as
 * they stay in the folder, or not at all on systems that can't check that.
 *   input  the path of a file in the folder, or of the folder with "/" at its end
 *   name   relative to it, with slashes, without ".."; the case of letters is ignored if no file
 *          matches exactly
 * Returns a descriptor, or -1 with errno set: EXDEV or ELOOP if a link leads out of the folder. On
 * shortage of memory memory->status is set. */
int burnish_open_beside(const char *input, const char *name, burnish_memory *memory);

#endif
