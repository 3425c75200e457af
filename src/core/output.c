/* Outputs that appear whole or not at all. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "core/error.h"
#include "core/memory.h"

enum {
    TEMPORARY_ATTEMPTS = 1000,
    TEMPORARY_NAME_SIZE = 64, /* "/.burnish-", 16 + 8 hexadecimal digits, ".tmp" and room */
    PIECE = 1 << 16,          /* bytes that a source is asked for at a time */
    WRITE_STEP = 1 << 30      /* the kernel takes at most 2^31 - 4096 bytes at a time */
};

static burnish_status fail_write(burnish_error *error, const char *path, int code) {
    const char *advice = code == ENOSPC || code == EDQUOT ? "; free some space"
                         : code == EPIPE                  ? "; the reader closed the pipe"
                         : code == ENOENT                 ? "; create the folder first"
                                                          : "";
    char text[96];
    /* strerror_r in its GNU form: strerror shares a buffer between threads. */
    const char *reason = strerror_r(code, text, sizeof text);
    return burnish_fail(error, BURNISH_STATUS_WRITE, "%s: can't be written: %s%s",
                        burnish_show_name(path).text, reason, advice);
}

/* What is written: bytes as they are, or what a source gives in pieces. */
typedef struct content {
    const void *bytes;
    size_t size;
    burnish_file_source *source; /* NULL: the bytes */
    void *context;
    char *buffer; /* of the source's pieces: PIECE bytes */
} content;

/* Writes the bytes; returns 0 or an errno. */
static int write_bytes(int file, const void *bytes, size_t size) {
    const uint8_t *next = bytes;
    while (size > 0) {
        ssize_t written = write(file, next, size < WRITE_STEP ? size : WRITE_STEP);
        if (written > 0) {
            next += written;
            size -= (size_t)written;
        } else if (written == 0) {
            return ENOSPC;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            struct pollfd ready = {.fd = file, .events = POLLOUT};
            if (poll(&ready, 1, -1) < 0 && errno != EINTR) {
                return errno;
            }
        } else if (errno != EINTR) {
            return errno;
        }
    }
    return 0;
}

/* Writes everything; returns 0 or an errno. */
static int write_all(int file, const content *what) {
    size_t size;
    int code = 0;
    if (!what->source) {
        return write_bytes(file, what->bytes, what->size);
    }
    while (code == 0 && (size = what->source(what->context, what->buffer, PIECE)) > 0) {
        code = write_bytes(file, what->buffer, size);
    }
    return code;
}

static burnish_status write_directly(const char *path, const content *what, burnish_error *error) {
    int file = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file < 0) {
        return fail_write(error, path, errno);
    }
    int code = write_all(file, what);
    if (close(file) != 0 && code == 0) {
        code = errno;
    }
    return code == 0 ? BURNISH_STATUS_OK : fail_write(error, path, code);
}

static burnish_status write_standard_output(const content *what, burnish_error *error) {
    int code = fflush(stdout) == 0 ? 0 : errno;
    if (code == 0) {
        code = write_all(STDOUT_FILENO, what);
    }
    return code == 0 ? BURNISH_STATUS_OK : fail_write(error, "standard output", code);
}

/* A new file in target's folder that has no name yet, so that nothing is left of a process that is
 * killed; -1 where the file system has no such files. name is scratch. */
static int create_nameless(const char *target, char *name, size_t name_size) {
    const char *slash = strrchr(target, '/');
    int folder = slash ? (int)(slash - target) + 1 : 0;
    if (access("/proc/self/fd", X_OK) != 0) { /* name_temporary() goes through it */
        return -1;
    }
    snprintf(name, name_size, "%.*s.", folder, target);
    return open(name, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
}

/* Gives file a name beside target (at most strlen(target) + TEMPORARY_NAME_SIZE bytes, to name), or
 * creates one with such a name when file is -1; returns its descriptor or -1 with errno. Not
 * mkstemp, whose files are always private: the mode of an ordinary file needs the umask, which can
 * only be read by changing it for all threads. O_EXCL makes a guessed or taken name harmless. */
static int name_temporary(int file, const char *target, char *name, size_t name_size) {
    const char *slash = strrchr(target, '/');
    int folder = slash ? (int)(slash - target) + 1 : 0;
    char link[40];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    for (unsigned attempt = 0; attempt < TEMPORARY_ATTEMPTS; ++attempt) {
        struct timespec now = {0};
        clock_gettime(CLOCK_MONOTONIC, &now);
        uint64_t unique = ((uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec) ^
                          (uint64_t)(uintptr_t)&now << 20 ^ attempt;
        snprintf(name, name_size, "%.*s.burnish-%016llx-%08x.tmp", folder, target,
                 (unsigned long long)unique, (unsigned)getpid());
        int named = file < 0
                        ? open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666)
                    : linkat(AT_FDCWD, link, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0 ? file
                                                                                     : -1;
        if (named >= 0 || errno != EEXIST) {
            return named;
        }
    }
    errno = EEXIST;
    return -1;
}

/* existing: the target's state, or NULL for a new file. */
static burnish_status replace_file(const char *path, const char *target,
                                   const struct stat *existing, const content *what,
                                   burnish_error *error) {
    size_t name_size = strlen(target) + TEMPORARY_NAME_SIZE;
    burnish_memory memory = burnish_memory_of(NULL, error);
    char *name = burnish_allocate(&memory, name_size, 1, "temporary file name");
    if (!name) {
        return memory.status;
    }
    burnish_status status = BURNISH_STATUS_OK;
    int file = create_nameless(target, name, name_size);
    int named = file < 0;
    if (named) {
        file = name_temporary(-1, target, name, name_size);
    }
    if (file < 0) {
        status = fail_write(error, path, errno);
        burnish_release(NULL, name);
        return status;
    }
    int code = existing && fchmod(file, existing->st_mode & 0777) != 0 ? errno : 0;
    if (code == 0) {
        code = write_all(file, what);
    }
    if (code == 0 && !named) {
        named = name_temporary(file, target, name, name_size) >= 0;
        code = named ? 0 : errno;
    }
    if (close(file) != 0 && code == 0) {
        code = errno;
    }
    if (code == 0 && rename(name, target) != 0) {
        code = errno;
    }
    if (code != 0) {
        if (named) {
            unlink(name);
        }
        status = fail_write(error, path, code);
    }
    burnish_release(NULL, name);
    return status;
}

static burnish_status write_content(const char *path, const content *what, burnish_error *error) {
    if (!path || !*path) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "output: no file name; give one, or - for standard output");
    }
    if (strcmp(path, "-") == 0) {
        return write_standard_output(what, error);
    }
    struct stat state;
    if (stat(path, &state) != 0) {
        return errno == ENOENT ? replace_file(path, path, NULL, what, error)
                               : fail_write(error, path, errno);
    }
    if (S_ISDIR(state.st_mode)) {
        return burnish_fail(error, BURNISH_STATUS_WRITE,
                            "%s: can't be written: it is a folder; name a file in it",
                            burnish_show_name(path).text);
    }
    if (!S_ISREG(state.st_mode)) {
        return write_directly(path, what, error);
    }
    /* A rename needs no permission of the file itself, so a protected one is asked for it here. */
    if (faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) != 0) {
        return fail_write(error, path, errno);
    }
    char *target = realpath(path, NULL);
    if (!target) {
        return fail_write(error, path, errno);
    }
    burnish_status status = replace_file(path, target, &state, what, error);
    free(target);
    return status;
}

burnish_status burnish_file_write(const char *path, const void *bytes, size_t size,
                                  burnish_error *error) {
    content what = {.bytes = bytes, .size = size};
    return write_content(path, &what, error);
}

burnish_status burnish_file_write_stream(const char *path, burnish_file_source *source,
                                         void *context, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(NULL, error);
    char *buffer = burnish_allocate(&memory, PIECE, 1, "output buffer");
    if (!buffer) {
        return memory.status;
    }
    content what = {.source = source, .context = context, .buffer = buffer};
    burnish_status status = write_content(path, &what, error);
    burnish_release(NULL, buffer);
    return status;
}
