/* Opening a file of a folder or below it. All is in the header: the library and the program, which
 * may have to do with different copies of it, open the same files. */
#ifndef BURNISH_CORE_BENEATH_H
#define BURNISH_CORE_BENEATH_H

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

/* What is named is a regular file; a pipe posing as one is not waited for. */
enum { BURNISH_BENEATH_FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK };

/* One step down; name is a part of a path. Where there is no such file, one whose name differs in
 * the case of its letters only, the first of them by their bytes: files come from systems that tell
 * no case. */
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

/* Part by part, so that no link leads out of the folder, also on systems that know no other way to
 * ask for that: none is followed. Returns -1 with errno set. */
static inline int burnish_open_parts(int at, const char *name) {
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
        const int next = size == 0
                             ? dup(at)
                             : burnish_open_part(at, part,
                                                 is_last ? BURNISH_BENEATH_FLAGS
                                                         : O_RDONLY | O_DIRECTORY | O_CLOEXEC);
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

/* Neither names that lead above the folder nor links do so. Returns -1 with errno set. */
static inline int burnish_open_beneath(int folder, const char *name) {
#if defined(SYS_openat2) && defined(RESOLVE_BENEATH)
    struct open_how how = {.flags = BURNISH_BENEATH_FLAGS,
                           .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    const int descriptor = (int)syscall(SYS_openat2, folder, name, &how, sizeof how);
    if (descriptor >= 0 || errno == EXDEV || errno == ELOOP) {
        return descriptor;
    } /* else not there, or an older system */
#endif
    return burnish_open_parts(folder, name);
}

#endif

#endif
