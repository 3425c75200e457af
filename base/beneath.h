/* Opens a file in a folder or below it. This is a header because the program links another copy of
 * the library, and both must open the same files. */
#ifndef BURNISH_BASE_BENEATH_H
#define BURNISH_BASE_BENEATH_H

#ifndef _WIN32

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>
#if defined(__linux__) && defined(__has_include)
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#include <sys/syscall.h>
#endif
#endif

/* A pipe is opened without waiting for its writer; callers refuse what is not a regular file. */
enum { BURNISH_BENEATH_FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK };

/* One step down: opens `name`, a single part of a path. Without such a file, it opens the first one
 * in byte order whose name differs only in case: many files come from systems that ignore case. */
static inline int burnish_open_part(int at, const char *name, int flags) {
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

/* Returns 0 if `name` can be a file in a folder or below it. Otherwise EXDEV for an absolute name
 * and for "..", ENAMETOOLONG, ENOENT for an empty name, or EISDIR for a name that only a folder can
 * have, with "/" or "." at its end. Other empty parts and "." ("./a.bin") are allowed. */
static inline int burnish_check_beneath(const char *name) {
    enum { PATH_SIZE = 4096 }; /* on all systems */
    if (!*name || *name == '/') {
        return *name ? EXDEV : ENOENT;
    }
    int code = strlen(name) < PATH_SIZE ? 0 : ENAMETOOLONG;
    for (size_t size; code == 0; name += size + 1) {
        size = strcspn(name, "/");
        const int is_last = name[size] == 0, is_dot = size == 1 && *name == '.';
        if (size == 2 && name[0] == '.' && name[1] == '.') {
            code = EXDEV;
        } else if (size > NAME_MAX) {
            code = ENAMETOOLONG;
        } else if (is_last) {
            return size == 0 || is_dot ? EISDIR : 0;
        }
    }
    return code;
}

/* Follows a name that burnish_check_beneath allows part by part, and no link on the way, so it
 * stays in the folder on any system. Returns -1 with errno set. */
static inline int burnish_open_parts(int at, const char *name) {
    char part[NAME_MAX + 1];
    at = dup(at);
    for (int is_last = 0; at >= 0 && !is_last;) {
        const size_t size = strcspn(name, "/");
        is_last = name[size] == 0;
        memcpy(part, name, size);
        part[size] = 0;
        name += size + 1;
        if (size == 0 || strcmp(part, ".") == 0) {
            continue;
        }
        const int flags = is_last ? BURNISH_BENEATH_FLAGS : O_RDONLY | O_DIRECTORY | O_CLOEXEC;
        const int next = burnish_open_part(at, part, flags), code = errno;
        close(at);
        errno = code;
        at = next;
    }
    return at;
}

/* Opens a file of the folder or below it: neither its name nor a link may lead elsewhere. Returns
 * -1 with errno set: EXDEV or ELOOP if one does. */
static inline int burnish_open_beneath(int folder, const char *name) {
    const int code = burnish_check_beneath(name);
    if (code != 0) {
        errno = code;
        return -1;
    }
#if defined(SYS_openat2) && defined(RESOLVE_BENEATH)
    struct open_how how = {.flags = BURNISH_BENEATH_FLAGS,
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    const int descriptor = (int)syscall(SYS_openat2, folder, name, &how, sizeof how);
    if (descriptor >= 0 || errno == EXDEV || errno == ELOOP) {
        return descriptor;
    } /* else the case of its letters differs, or an older kernel lacks openat2 */
#endif
    return burnish_open_parts(folder, name);
}

#endif

#endif
