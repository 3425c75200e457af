#include "import/folder.h"

#include "cli/options.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/beneath.h"

enum { NAME_SIZE = 4096 };

int folder_open(const char *input) {
    char folder[NAME_SIZE];
    const char *slash = strrchr(input, '/');
    if (*input == ':' || strcmp(input, "-") == 0 ||
        (slash && (size_t)(slash - input) + 2 > sizeof folder)) {
        return -1;
    }
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - input) + 1 : 1,
             slash ? input : ".");
    return open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

/* Returns a descriptor, or -1 with errno. */
static int open_file(int folder, const char *name) {
    struct stat state;
    if (folder < 0) {
        errno = ENOENT;
        return -1;
    }
    const int file = burnish_open_beneath(folder, name);
    if (file >= 0 && (fstat(file, &state) != 0 || !S_ISREG(state.st_mode))) {
        close(file);
        errno = EACCES;
        return -1;
    }
    return file;
}

static burnish_status fail(burnish_error *error, burnish_status status, const char *name,
                           const char *why) {
    return cli_fail(error, status, "%.200s: can't be opened: %s", name, why);
}

burnish_status folder_load(int folder, const char *name, uint64_t max_bytes, void **bytes,
                           size_t *size, burnish_error *error) {
    const int file = open_file(folder, name);
    struct stat state;
    if (file < 0 || fstat(file, &state) != 0) {
        return fail(error, BURNISH_STATUS_READ, name, strerror(errno));
    }
    burnish_status status = BURNISH_STATUS_OK;
    const uint64_t stated = state.st_size > 0 ? (uint64_t)state.st_size : 0;
    char *copy = stated <= max_bytes && stated < SIZE_MAX ? malloc((size_t)stated + 1) : NULL;
    size_t got = 0;
    if (stated > max_bytes) {
        status = fail(error, BURNISH_STATUS_LIMIT, name, "it is larger than the limit of bytes");
    } else if (!copy) {
        status = fail(error, BURNISH_STATUS_MEMORY, name, "out of memory");
    } else {
        ssize_t count;
        while (got < stated && (count = read(file, copy + got, (size_t)stated - got)) > 0) {
            got += (size_t)count;
        }
    }
    close(file);
    *bytes = copy;
    *size = got;
    return status;
}

static burnish_status load(void *user_data, const char *name, uint64_t max_bytes,
                           const void **bytes, size_t *size, burnish_error *error) {
    void *copy = NULL;
    const burnish_status status =
        folder_load(*(const int *)user_data, name, max_bytes, &copy, size, error);
    *bytes = copy;
    return status;
}

static void release(void *user_data, const void *bytes, size_t size) {
    (void)user_data, (void)size;
    free((void *)(uintptr_t)bytes);
}

burnish_file_loader folder_loader(int *folder) {
    return (burnish_file_loader){load, release, folder};
}

#else

int folder_open(const char *input) {
    (void)input;
    return -1;
}

#endif
