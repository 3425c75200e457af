#include "import/folder.h"

#include "base/cli/options.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/beneath.h"
#include "base/inputs.h"
#include "base/show_text.h"

enum { NAME_SIZE = 4096, PIECE_SIZE = 1 << 16 };

burnish_status folder_open(const char *input, const char *root, int *folder, char *path,
                           const char **below, burnish_error *error) {
    const char *slash = strrchr(input, '/');
    *folder = -1;
    *below = NULL;
    if (*input == ':' || strcmp(input, "-") == 0 || burnish_archive_member(input) ||
        (slash && (size_t)(slash - input) + 2 > BURNISH_INPUT_PATH)) {
        return BURNISH_STATUS_OK;
    }
    snprintf(path, BURNISH_INPUT_PATH, "%.*s", slash ? (int)(slash - input) + 1 : 1,
             slash ? input : ".");
    *folder = open(root ? root : path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const int code = root ? burnish_folder_below(root, input, path) : 0;
    *below = root ? path : NULL;
    return code == 0 ? BURNISH_STATUS_OK
                     : cli_fail(error, BURNISH_STATUS_ARGUMENT, "root: %s: %s",
                                burnish_show_name(root).text, burnish_root_fault(code));
}

burnish_status folder_fail(const char *name, int code, burnish_error *error) {
    const burnish_shown_name shown = burnish_show_name(name);
    return code == EXDEV || code == ELOOP
               ? cli_fail(error, BURNISH_STATUS_READ, "%s: leads out of the folder of the file",
                          shown.text)
               : cli_fail(error, cli_errno_status(code), "%s: can't be opened: %s", shown.text,
                          strerror(code));
}

burnish_status folder_fail_memory(const char *name, uint64_t bytes, burnish_error *error) {
    return cli_fail(
        error, BURNISH_STATUS_MEMORY,
        "out of memory: no %llu bytes for %s; raise --max-memory, free memory, or use a "
        "smaller input",
        (unsigned long long)bytes, burnish_show_name(name).text);
}

static burnish_status fail_size(const char *name, uint64_t max_bytes, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_LIMIT,
                    "%s: larger than the limit of %llu bytes; raise the limit or simplify the mesh",
                    burnish_show_name(name).text, (unsigned long long)max_bytes);
}

static burnish_status fail_read(const char *name, int code, burnish_error *error) {
    return cli_fail(error, cli_errno_status(code), "%s: can't be read: %s",
                    burnish_show_name(name).text, strerror(code));
}

burnish_status folder_open_file(int folder, const char *name, uint64_t max_bytes, int *file,
                                uint64_t *size, burnish_error *error) {
    struct stat state;
    burnish_status status = BURNISH_STATUS_OK;
    *size = 0;
    errno = ENOENT;
    *file = folder >= 0 ? burnish_open_beneath(folder, name) : -1;
    if (*file < 0) {
        return folder_fail(name, errno, error);
    }
    if (fstat(*file, &state) != 0) {
        status = fail_read(name, errno, error);
    } else if (S_ISDIR(state.st_mode)) {
        status = fail_read(name, EISDIR, error);
    } else if (!S_ISREG(state.st_mode)) {
        status = cli_fail(error, BURNISH_STATUS_READ, "%s: is not a regular file",
                          burnish_show_name(name).text);
    } else if (state.st_size > 0 && (uint64_t)state.st_size > max_bytes) {
        status = fail_size(name, max_bytes, error);
    }
    if (status != BURNISH_STATUS_OK) {
        close(*file);
        *file = -1;
        return status;
    }
    *size = state.st_size > 0 ? (uint64_t)state.st_size : 0;
    return status;
}

burnish_status folder_read(int file, const char *name, uint64_t max_bytes, import_taker *take,
                           void *context, burnish_error *error) {
    static char piece[PIECE_SIZE];
    uint64_t got = 0;
    for (;;) {
        const ssize_t count = pread(file, piece, sizeof piece, (off_t)got);
        if (count == 0) {
            return BURNISH_STATUS_OK;
        }
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            return fail_read(name, errno, error);
        }
        got += (uint64_t)count;
        if (got > max_bytes) {
            return fail_size(name, max_bytes, error);
        }
        if (!take(context, piece, (size_t)count)) {
            return folder_fail_memory(name, got, error);
        }
    }
}

static burnish_status folder_load(void *user_data, const char *name, uint64_t max_bytes,
                                  const void **bytes, size_t *size, burnish_error *error) {
    import_stream stream = {0};
    uint64_t stated;
    int file;
    burnish_status status =
        folder_open_file(*(const int *)user_data, name, max_bytes, &file, &stated, error);
    if (status == BURNISH_STATUS_OK) {
        status = import_expect(&stream, stated)
                     ? folder_read(file, name, max_bytes, import_keep, &stream, error)
                     : folder_fail_memory(name, stated, error);
        close(file);
    }
    if (status != BURNISH_STATUS_OK) {
        free(stream.bytes);
        return status;
    }
    *bytes = stream.bytes;
    *size = stream.size;
    return status;
}

void folder_release(void *user_data, const void *bytes, size_t size) {
    (void)user_data, (void)size;
    free((void *)(uintptr_t)bytes);
}

burnish_file_loader folder_loader(int *folder) {
    return (burnish_file_loader){folder_load, folder_release, folder};
}

#endif
