/* Closes descriptors before another program starts, or before a sandbox. This is a header because the
 * program links another copy of the library, and importers none. */
#ifndef BURNISH_BASE_CLOSE_DESCRIPTORS_H
#define BURNISH_BASE_CLOSE_DESCRIPTORS_H

#ifndef _WIN32

#include <errno.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif

/* Closes all descriptors from `first` on. Returns 0 or an errno. */
static inline int burnish_close_descriptors(int first) {
    enum { DESCRIPTORS_MAX = 1 << 20 }; /* Linux's default limit */
    struct rlimit limit;
#ifdef SYS_close_range
    if (syscall(SYS_close_range, (unsigned)first, ~0U, 0) == 0) {
        return 0;
    }
#endif
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) { /* before Linux 5.9: one by one */
        return errno;
    }
    for (int i = first; i < DESCRIPTORS_MAX && (rlim_t)i < limit.rlim_max; ++i) {
        close(i);
    }
    return 0;
}

#endif

#endif
