/* Inputs of importers: descriptors of files. */
#include "import/open.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/cli/options.h"
#include "base/cli/process.h"

enum { PIECE = 1 << 16 };
#define STREAM_MOST ((uint64_t)1 << 30)

static burnish_status open_path(const char *path, int *input, burnish_error *error) {
    struct stat state;
    *input = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (*input < 0) {
        return cli_fail(error, cli_errno_status(errno), "%.300s: can't be opened: %s", path,
                        strerror(errno));
    }
    if (fstat(*input, &state) != 0 || S_ISDIR(state.st_mode)) {
        close(*input);
        return cli_fail(error, BURNISH_STATUS_READ, "%.300s: can't be read: Is a directory", path);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status copy_stream(int from, int to, uint64_t most, burnish_error *error) {
    static char piece[PIECE];
    uint64_t total = 0;
    ssize_t size;
    while ((size = read(from, piece, sizeof piece)) != 0) {
        if (size < 0 && errno != EINTR) {
            return cli_fail(error, cli_errno_status(errno), "standard input: can't be read: %s",
                            strerror(errno));
        }
        total += size > 0 ? (uint64_t)size : 0;
        if (total > most) {
            return cli_fail(error, BURNISH_STATUS_LIMIT,
                            "standard input: larger than the limit of %llu bytes; %s",
                            (unsigned long long)most,
                            most < STREAM_MOST ? "raise the limit or simplify the mesh"
                                               : "give the file by its name");
        }
        if (size > 0 && !cli_write_all(to, piece, (size_t)size)) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "standard input: no room for it: %s",
                            strerror(errno));
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status open_standard(uint64_t max_bytes, int *input, burnish_error *error) {
    struct stat state;
    if (fstat(STDIN_FILENO, &state) == 0 && S_ISREG(state.st_mode) &&
        lseek(STDIN_FILENO, 0, SEEK_CUR) == 0) {
        *input = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        if (*input >= 0) {
            return BURNISH_STATUS_OK;
        }
    }
    *input = cli_unnamed_file();
    if (*input < 0) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "standard input: no room for it: %s",
                        strerror(errno));
    }
    const burnish_status status =
        copy_stream(STDIN_FILENO, *input, max_bytes < STREAM_MOST ? max_bytes : STREAM_MOST, error);
    if (status != BURNISH_STATUS_OK) {
        close(*input);
    }
    return status;
}

burnish_status import_open(const char *path, uint64_t max_bytes, int *input, burnish_error *error) {
    return strcmp(path, "-") == 0 ? open_standard(max_bytes, input, error)
                                  : open_path(path, input, error);
}

#endif
