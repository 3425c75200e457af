#include "base/cli/write.h"

#ifndef _WIN32

#include <errno.h>
#include <stdio.h>
#ifdef __linux__
#include <sys/mman.h>
#endif
#include <unistd.h>

int cli_write_all(int descriptor, const void *bytes, size_t size) {
    const char *next = bytes;
    while (size > 0) {
        const ssize_t count = write(descriptor, next, size);
        if (count < 0 && errno != EINTR) {
            return 0;
        }
        next += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 1;
}

int cli_unnamed_file(void) {
#ifdef __linux__
    return memfd_create("burnish", MFD_CLOEXEC | MFD_ALLOW_SEALING);
#else
    FILE *file = tmpfile(); /* its descriptor stays open until the process ends */
    return file ? dup(fileno(file)) : -1;
#endif
}

#endif
