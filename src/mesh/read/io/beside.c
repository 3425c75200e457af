/* Files that an input names: in its folder, or below. */
#include "mesh/read/io/beside.h"

#include <string.h>

int burnish_stays_beside(const char *name) {
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
