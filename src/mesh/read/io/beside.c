/* Opening a file that an input names. */
#include "mesh/read/io/beside.h"

#include <errno.h>
#include <string.h>

#include "base/beneath.h"
#include "base/platform.h"

#ifdef _WIN32
int burnish_open_beside(const char *input, const char *name, burnish_memory *memory) {
    const char *slash = strrchr(input, '/');
    const size_t length = slash ? (size_t)(slash - input) + 1 : 0, rest = strlen(name) + 1;
    char *path = burnish_allocate(memory, length + rest, 1, "path");
    if (!path) {
        return -1;
    }
    memcpy(path, input, length);
    memcpy(path + length, name, rest);
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_BINARY);
    burnish_release(memory->context, path);
    return descriptor;
}
#else
/* The folder, or -1 with errno set. */
static int open_folder(const char *input, burnish_memory *memory) {
    const char *slash = strrchr(input, '/');
    const size_t length = slash ? (size_t)(slash - input) + 1 : 0;
    char *path = burnish_allocate(memory, length + 2, 1, "path");
    if (!path) {
        return -1;
    }
    memcpy(path, input, length);
    memcpy(path + length, ".", 2);
    const int descriptor = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    burnish_release(memory->context, path);
    return descriptor;
}

int burnish_open_beside(const char *input, const char *name, burnish_memory *memory) {
    const int folder = open_folder(input, memory);
    if (folder < 0) {
        return -1;
    }
    const int descriptor = burnish_open_beneath(folder, name), code = errno;
    close(folder);
    errno = code;
    return descriptor;
}
#endif
