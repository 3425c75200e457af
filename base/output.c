/* Outputs that appear whole or not at all. */
#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/error.h"
#include "base/memory.h"
#include "base/platform.h"

#ifdef _WIN32
#include <windows.h>

burnish_wide_name burnish_widen(const char *name) {
    burnish_wide_name wide = {0};
    const int room = sizeof wide.text / sizeof *wide.text;
    if (!MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, name, -1, wide.text, room) &&
        !MultiByteToWideChar(CP_ACP, 0, name, -1, wide.text, room)) {
        *wide.text = 0;
    }
    return wide;
}
#else
#include <poll.h>
#endif

enum {
    TEMPORARY_ATTEMPTS = 1000,
    TEMPORARY_NAME_SIZE = 64, /* "/.burnish-", 16 + 8 hexadecimal digits, ".tmp" and room */
    PIECE = 1 << 16,          /* bytes that a source supplies per call, at most */
    WRITE_STEP = 1 << 30,     /* the kernel takes at most 2^31 - 4096 bytes at a time */
    TEMPORARIES = 64          /* that a signal handler can remove; further ones are not recorded */
};

static const char *advice_for(int code) {
    switch (code) {
    case ENOSPC:
#if EDQUOT != ENOSPC
    case EDQUOT:
#endif
        return "; free some space";
    case EPIPE:
        return "; the reader closed the pipe";
    case ENOENT:
        return "; create the folder first";
    case EFBIG:
        return "; raise the limit of file sizes (ulimit -f)";
    case EBUSY:
        return "; something is mounted on it, so it can't be replaced: name another file, or write "
               "to standard output";
    default:
        return "";
    }
}

static burnish_status fail_write(burnish_error *error, const char *path, int code) {
    return burnish_fail(error, BURNISH_STATUS_WRITE, "%s: can't be written: %s%s",
                        burnish_show_name(path).text, burnish_errno_reason(code).text,
                        advice_for(code));
}

/* A file in the target's folder that can't be made: the folder's fault, not the target's. */
static burnish_status fail_folder(burnish_error *error, const char *path, int code) {
    if (code != EACCES && code != EPERM && code != EROFS) {
        return fail_write(error, path, code);
    }
    return burnish_fail(error, BURNISH_STATUS_WRITE,
                        "%s: can't be written: no file can be made in its folder (%s); name one "
                        "elsewhere, or write to standard output",
                        burnish_show_name(path).text, burnish_errno_reason(code).text);
}

/* What is written: bytes, or the output of a source. */
typedef struct content {
    const void *bytes;
    size_t size;
    burnish_file_source *source; /* NULL: the bytes */
    void *user_data;
    char *buffer;              /* of the source's pieces: PIECE bytes */
    burnish_file_check *check; /* NULL: no last step */
    void *check_data;
} content;

/* The last step, after the bytes are written. */
static burnish_status run_check(const content *what, burnish_error *error) {
    return what->check ? what->check(what->check_data, error) : BURNISH_STATUS_OK;
}

/* For files that do not block; returns 0 or an errno. */
static int wait_until_writable(int file) {
#ifdef _WIN32
    (void)file;
    return EAGAIN;
#else
    struct pollfd ready = {.fd = file, .events = POLLOUT};
    return poll(&ready, 1, -1) < 0 && errno != EINTR ? errno : 0;
#endif
}

/* Writes the bytes; returns 0 or an errno. */
static int write_bytes(int file, const void *bytes, size_t size) {
    const uint8_t *next = bytes;
    while (size > 0) {
        const size_t step = size < WRITE_STEP ? size : WRITE_STEP;
        const ssize_t written = write(file, next, (unsigned)step);
        if (written > 0) {
            next += written;
            size -= (size_t)written;
        } else if (written == 0) {
            return ENOSPC;
        } else if (errno == EAGAIN) {
            int code = wait_until_writable(file);
            if (code != 0) {
                return code;
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
    while (code == 0 && (size = what->source(what->user_data, what->buffer, PIECE)) > 0) {
        code = write_bytes(file, what->buffer, size);
    }
    return code;
}

static burnish_status write_directly(const char *path, const content *what, burnish_error *error) {
    int file = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY | O_BINARY);
    if (file < 0) {
        return fail_write(error, path, errno);
    }
    int code = write_all(file, what);
    if (close(file) != 0 && code == 0) {
        code = errno;
    }
    return code == 0 ? run_check(what, error) : fail_write(error, path, code);
}

static burnish_status write_standard_output(const content *what, burnish_error *error) {
    int code = fflush(stdout) == 0 ? 0 : errno;
    burnish_set_binary(STDOUT_FILENO);
    if (code == 0) {
        code = write_all(STDOUT_FILENO, what);
    }
    return code == 0 ? run_check(what, error) : fail_write(error, "standard output", code);
}

/* ---- Temporaries ---- */

/* Names of temporaries that exist or are about to; NULL in free slots. Process-wide, because a
 * signal handler has no argument. */
static _Atomic(const char *) temporaries[TEMPORARIES];
static atomic_int handlers; /* that are reading them */

static void remember(const char *name) {
    for (int i = 0; i < TEMPORARIES; ++i) {
        const char *empty = NULL;
        if (atomic_compare_exchange_strong(&temporaries[i], &empty, name)) {
            return;
        }
    }
}

/* Returns 0 if a handler might be using the name: then it must stay in memory. */
static int forget(const char *name) {
    for (int i = 0; i < TEMPORARIES; ++i) {
        const char *expected = name;
        if (atomic_compare_exchange_strong(&temporaries[i], &expected, NULL)) {
            break;
        }
    }
    return atomic_load(&handlers) == 0;
}

void burnish_file_remove_temporaries(void) {
    const int code = errno;
    atomic_fetch_add(&handlers, 1);
    for (int i = 0; i < TEMPORARIES; ++i) {
        const char *name = atomic_load(&temporaries[i]);
        if (name) {
            unlink(name);
        }
    }
    atomic_fetch_sub(&handlers, 1);
    errno = code;
}

/* Length of the folder's part of a path, its last separator included. */
static int folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
#ifdef _WIN32
    const char *back = strrchr(path, '\\');
    slash = back && (!slash || back > slash) ? back : slash;
    slash = slash || !strchr(path, ':') ? slash : strchr(path, ':');
#endif
    return slash ? (int)(slash - path) + 1 : 0;
}

/* A file that is being written in the target's folder. */
typedef struct temporary {
    const char *target;
    char *name; /* room for strlen(target) + TEMPORARY_NAME_SIZE */
    size_t name_size;
    int file;     /* -1: not open */
    int is_named; /* it exists under its name, which is remembered */
} temporary;

/* A name that no file has, most likely. */
static void invent_name(temporary *t, unsigned attempt) {
    struct timespec now = {0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const uint64_t unique = ((uint64_t)now.tv_sec * 1000000000U + (uint64_t)now.tv_nsec) ^
                            (uint64_t)(uintptr_t)&now << 20 ^ attempt;
    snprintf(t->name, t->name_size, "%.*s.burnish-%016llx-%08x.tmp", folder_length(t->target),
             t->target, (unsigned long long)unique, (unsigned)getpid());
}

/* Gives the open file a name; returns 0 or an errno. */
static int link_file(const temporary *t, const char *name) {
#if BURNISH_HAS_NAMELESS_FILES
    char link[40];
    snprintf(link, sizeof link, "/proc/self/fd/%d", t->file);
    return linkat(AT_FDCWD, link, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
#else
    (void)t, (void)name;
    return ENOSYS;
#endif
}

/* Creates the file under its name; returns 0 or an errno. Not mkstemp, whose files are always
 * private: the mode of an ordinary file needs the umask, which can only be read by changing it for
 * all threads. O_EXCL makes a guessed or taken name harmless. */
static int create_file(temporary *t) {
    const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW | O_BINARY;
    t->file = open(t->name, flags, 0666);
    return t->file >= 0 ? 0 : errno;
}

/* Makes the temporary appear in its folder under a new name; returns 0 or an errno. */
static int name_temporary(temporary *t) {
    int code = EEXIST;
    for (unsigned attempt = 0; code == EEXIST && attempt < TEMPORARY_ATTEMPTS; ++attempt) {
        invent_name(t, attempt);
        remember(t->name);
        code = t->file < 0 ? create_file(t) : link_file(t, t->name);
        if (code != 0) {
            forget(t->name);
        }
    }
    t->is_named = code == 0;
    return code;
}

/* Opens a file without a name, which vanishes if the process is killed. On file systems without
 * such files, opens one with a name. Returns 0 or an errno. */
static int open_temporary(temporary *t) {
    t->file = -1;
#if BURNISH_HAS_NAMELESS_FILES
    if (access("/proc/self/fd", X_OK) == 0) { /* link_file goes through it */
        snprintf(t->name, t->name_size, "%.*s.", folder_length(t->target), t->target);
        t->file = open(t->name, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    }
#endif
    return t->file >= 0 ? 0 : name_temporary(t);
}

/* rename that replaces, also on Windows; returns 0 or an errno. */
static int replace(const char *name, const char *target) {
#ifdef _WIN32
    return MoveFileExW(burnish_widen(name).text, burnish_widen(target).text,
                       MOVEFILE_REPLACE_EXISTING)
               ? 0
               : EACCES;
#else
    return rename(name, target) == 0 ? 0 : errno;
#endif
}

/* Writes, closes and gives the target's name. */
static burnish_status finish_temporary(temporary *t, const char *path, int is_new,
                                       const content *what, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    int code = write_all(t->file, what);
    if (code == 0) {
        status = run_check(what, error);
    }
    if (code == 0 && status == BURNISH_STATUS_OK && !t->is_named) {
        /* a free name is linked directly, so the file never has another one */
        code = is_new ? link_file(t, t->target) : EEXIST;
        code = code == EEXIST ? name_temporary(t) : code;
    }
    if (close(t->file) != 0 && code == 0) {
        code = errno;
    }
    if (code == 0 && status == BURNISH_STATUS_OK && t->is_named) {
        code = replace(t->name, t->target);
    }
    if ((code != 0 || status != BURNISH_STATUS_OK) && t->is_named) {
        unlink(t->name);
    }
    return code == 0 ? status : fail_write(error, path, code);
}

/* existing: the target's state, or NULL for a new file. */
static burnish_status replace_file(const char *path, const char *target,
                                   const struct stat *existing, const content *what,
                                   burnish_error *error) {
    temporary t = {.target = target, .name_size = strlen(target) + TEMPORARY_NAME_SIZE};
    burnish_memory memory = burnish_memory_of(NULL, error);
    t.name = burnish_allocate(&memory, t.name_size, 1, "temporary file name");
    if (!t.name) {
        return memory.status;
    }
    int code = open_temporary(&t);
    burnish_status status = code == 0 ? BURNISH_STATUS_OK : fail_folder(error, path, code);
#ifndef _WIN32
    if (code == 0 && existing && fchmod(t.file, existing->st_mode & 0777) != 0) {
        code = errno;
        close(t.file);
        if (t.is_named) {
            unlink(t.name);
        }
        status = fail_write(error, path, code);
    }
#endif
    if (code == 0) {
        status = finish_temporary(&t, path, !existing, what, error);
    }
    if (!t.is_named || forget(t.name)) {
        burnish_release(NULL, t.name);
    }
    return status;
}

/* The path without links, to be freed; NULL with errno. */
static char *resolve(const char *path) {
#ifdef _WIN32
    return _strdup(path);
#else
    return realpath(path, NULL);
#endif
}

/* Whether the program may write to an existing file. A rename does not need permission for the file
 * itself, so this checks it. */
static int may_write(const char *path) {
#ifdef _WIN32
    return access(path, W_OK) == 0;
#else
    return faccessat(AT_FDCWD, path, W_OK, AT_EACCESS) == 0;
#endif
}

static burnish_status write_new(const char *path, const content *what, burnish_error *error) {
#ifndef _WIN32
    struct stat state = {0};
    if (lstat(path, &state) == 0) {
        return burnish_fail(error, BURNISH_STATUS_WRITE,
                            "%s: can't be written: it is a link to nothing; create what it names, "
                            "or remove it",
                            burnish_show_name(path).text);
    }
#endif
    return replace_file(path, path, NULL, what, error);
}

static burnish_status write_content(const char *path, const content *what, burnish_error *error) {
    if (!path || !*path) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "output: no file name; give one, or - for standard output");
    }
    if (strcmp(path, "-") == 0) {
        return write_standard_output(what, error);
    }
    struct stat state = {0};
    if (burnish_stat(path, &state) != 0) {
        return errno == ENOENT ? write_new(path, what, error) : fail_write(error, path, errno);
    }
    if (S_ISDIR(state.st_mode)) {
        return burnish_fail(error, BURNISH_STATUS_WRITE,
                            "%s: can't be written: it is a folder; name a file in it",
                            burnish_show_name(path).text);
    }
    if (!S_ISREG(state.st_mode)) {
        return write_directly(path, what, error);
    }
    char *target = may_write(path) ? resolve(path) : NULL;
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

burnish_status burnish_file_write_checked(const char *path, const void *bytes, size_t size,
                                          burnish_file_check *check, void *user_data,
                                          burnish_error *error) {
    content what = {.bytes = bytes, .size = size, .check = check, .check_data = user_data};
    return write_content(path, &what, error);
}

burnish_status burnish_file_write_stream(const char *path, burnish_file_source *source,
                                         void *user_data, burnish_file_check *check,
                                         burnish_error *error) {
    char *buffer = malloc(PIECE); /* if aligned, it would leave gaps in the heap */
    if (!buffer) {
        return burnish_fail_memory(error, "output buffer", PIECE);
    }
    content what = {.source = source,
                    .user_data = user_data,
                    .buffer = buffer,
                    .check = check,
                    .check_data = user_data};
    burnish_status status = write_content(path, &what, error);
    free(buffer);
    return status;
}
