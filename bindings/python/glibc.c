/* Old versions of the C library's functions, so one wheel works with every glibc since 2.17. The linker replaces calls of NAME by
 * __wrap_NAME (--wrap), in the static libraries too. Newer glibc gave these functions new versions, with the same results: pow and
 * its like without SVID's error handling, threads moved from libpthread, stat64 as a function of its own. */
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>

#if defined(__x86_64__)
#define FIRST "GLIBC_2.2.5"
#define STAT_VERSION 1
#elif defined(__aarch64__)
#define FIRST "GLIBC_2.17"
#define STAT_VERSION 0
#else
#error "add the first version of glibc for this processor, and _STAT_VER of its bits/stat.h"
#endif

/* The function RESULT NAME(PARAMETERS) of the first version, which is called with ARGUMENTS. */
#define OLD(result, name, parameters, arguments)                                                   \
    result old_##name parameters;                                                                  \
    __asm__(".symver old_" #name "," #name "@" FIRST);                                             \
    result __wrap_##name parameters;                                                               \
    result __wrap_##name parameters {                                                              \
        return old_##name arguments;                                                               \
    }

OLD(double, exp, (double x), (x))
OLD(double, exp2, (double x), (x))
OLD(double, log, (double x), (x))
OLD(double, pow, (double x, double y), (x, y))
OLD(int, pthread_create,
    (pthread_t * thread, const pthread_attr_t *attributes, void *(*start)(void *), void *data),
    (thread, attributes, start, data))
OLD(int, pthread_detach, (pthread_t thread), (thread))
OLD(int, pthread_join, (pthread_t thread, void **result), (thread, result))
OLD(int, pthread_once, (pthread_once_t * control, void (*start)(void)), (control, start))
OLD(int, pthread_sigmask, (int how, const sigset_t *set, sigset_t *old), (how, set, old))

/* Before 2.33, these functions had other names and took the version of struct stat. */
#define OLD_STAT(name, old, of)                                                                    \
    int old_##name(int version, of, struct stat64 *status);                                        \
    __asm__(".symver old_" #name "," #old "@" FIRST);                                              \
    int __wrap_##name(of, struct stat64 *status);                                                  \
    int __wrap_##name(of, struct stat64 *status) {                                                 \
        return old_##name(STAT_VERSION, file, status);                                             \
    }

OLD_STAT(stat64, __xstat64, const char *file)
OLD_STAT(lstat64, __lxstat64, const char *file)
OLD_STAT(fstat64, __fxstat64, int file)

/* Before 2.28; the argument that most commands have is in a register. */
int old_fcntl(int file, int command, ...);
__asm__(".symver old_fcntl,fcntl@" FIRST);
int __wrap_fcntl64(int file, int command, long argument);
int __wrap_fcntl64(int file, int command, long argument) {
    return old_fcntl(file, command, argument);
}
