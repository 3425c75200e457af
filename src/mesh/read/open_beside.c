/* Opening a file that an input names. */
#include "mesh/read/beside.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#ifndef _WIN32
#include <dirent.h>
#include <strings.h>
#endif
#if defined(__linux__) && defined(__has_include)
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif
#endif

#include "core/platform.h"

/* Companions are regular files; a pipe posing as one is not waited for. */
enum { BESIDE_FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_BINARY | O_NONBLOCK };

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
    const int descriptor = open(path, BESIDE_FLAGS);
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

/* One step down; name is a part of a path. Where there is no such file, one whose name differs in
 * the case of its letters only, the first of them by their bytes: files come from systems that tell
 * no case. */
static int open_part(int at, const char *name, int flags) {
    enum { ENTRIES_MAX = 100000 };
    int descriptor = openat(at, name, flags | O_NOFOLLOW);
    if (descriptor >= 0 || errno != ENOENT) {
        return descriptor;
    }
    const int copy = openat(at, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *entries = copy >= 0 ? fdopendir(copy) : NULL;
    char best[NAME_MAX + 1] = "";
    if (!entries) {
        close(copy);
        errno = ENOENT;
        return -1;
    }
    const struct dirent *entry;
    for (int i = 0; i < ENTRIES_MAX && (entry = readdir(entries)); ++i) {
        if (strlen(entry->d_name) < sizeof best && strcasecmp(entry->d_name, name) == 0 &&
            (!*best || strcmp(entry->d_name, best) < 0)) {
            strcpy(best, entry->d_name);
        }
    }
    closedir(entries);
    errno = ENOENT;
    return *best ? openat(at, best, flags | O_NOFOLLOW) : -1;
}

/* Part by part, so that no link leads out of the folder, also on systems that know no other way to
 * ask for that: none is followed. Returns -1 with errno set. */
static int open_parts(int at, const char *name) {
    char part[NAME_MAX + 1];
    at = dup(at);
    while (at >= 0) {
        const size_t size = strcspn(name, "/");
        const int is_last = name[size] == 0;
        if (size >= sizeof part) {
            close(at);
            errno = ENAMETOOLONG;
            return -1;
        }
        memcpy(part, name, size);
        part[size] = 0;
        const int next =
            size == 0
                ? dup(at)
                : open_part(at, part, is_last ? BESIDE_FLAGS : O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        const int code = errno;
        close(at);
        errno = code;
        at = next;
        if (is_last) {
            break;
        }
        name += size + 1;
    }
    return at;
}

int burnish_open_beside(const char *input, const char *name, burnish_memory *memory) {
    const int folder = open_folder(input, memory);
    if (folder < 0) {
        return -1;
    }
    int descriptor = -1;
#if defined(SYS_openat2) && defined(RESOLVE_BENEATH)
    struct open_how how = {.flags = BESIDE_FLAGS,
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    descriptor = (int)syscall(SYS_openat2, folder, name, &how, sizeof how);
    const int is_final = descriptor >= 0 || errno == EXDEV || errno == ELOOP;
#else
    const int is_final = 0;
#endif
    if (!is_final) { /* not there, or an older system */
        descriptor = open_parts(folder, name);
    }
    const int code = errno;
    close(folder);
    errno = code;
    return descriptor;
}
#endif
