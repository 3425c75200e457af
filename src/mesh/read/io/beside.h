/* Files that an input names: in its folder, or below. */
#ifndef BURNISH_MESH_READ_IO_BESIDE_H
#define BURNISH_MESH_READ_IO_BESIDE_H

#include <string.h>

#include "base/memory.h"

/* Whether a name stays in the folder: relative, without "..". Slashes separate its parts. */
static inline int burnish_stays_beside(const char *name) {
    if (*name == '/' || (*name && name[1] == ':')) {
        return 0;
    }
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == 0)) {
            return 0;
        }
    }
    return 1;
}

/* Opens a file for reading, and never waits for a pipe or device. Links are followed as long as
 * they stay in the folder, or not at all on systems that can't check that.
 *   input  the path of a file in the folder
 *   name   relative to it, with slashes, without ".."; the case of letters is ignored if no file
 *          matches exactly
 * Returns a descriptor, or -1 with errno set: EXDEV or ELOOP if a link leads out of the folder. On
 * shortage of memory memory->status is set. */
int burnish_open_beside(const char *input, const char *name, burnish_memory *memory);

#endif
