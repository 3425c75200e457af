/* An operating system for wasi-libc without files, clock and environment, so the modules import
 * nothing. The first functions are from WASI preview 1, with its names of results. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <wasi/api.h>

/* A WASI call with its name in libc.a, whose parameters are not used. */
#pragma clang diagnostic ignored "-Wunused-parameter"
#define SYSTEM(name, result, ...)                                                                  \
    int32_t __imported_wasi_snapshot_preview1_##name(__VA_ARGS__);                                 \
    int32_t __imported_wasi_snapshot_preview1_##name(__VA_ARGS__) {                                \
        return result;                                                                             \
    }

SYSTEM(environ_get, __WASI_ERRNO_SUCCESS, int32_t a, int32_t b)
SYSTEM(fd_close, __WASI_ERRNO_BADF, int32_t a)
SYSTEM(fd_fdstat_get, __WASI_ERRNO_BADF, int32_t a, int32_t b)
SYSTEM(fd_filestat_get, __WASI_ERRNO_BADF, int32_t a, int32_t b)
SYSTEM(fd_prestat_get, __WASI_ERRNO_BADF, int32_t a, int32_t b)
SYSTEM(fd_prestat_dir_name, __WASI_ERRNO_BADF, int32_t a, int32_t b, int32_t c)
SYSTEM(fd_read, __WASI_ERRNO_BADF, int32_t a, int32_t b, int32_t c, int32_t d)
SYSTEM(fd_seek, __WASI_ERRNO_BADF, int32_t a, int64_t b, int32_t c, int32_t d)
SYSTEM(fd_write, __WASI_ERRNO_BADF, int32_t a, int32_t b, int32_t c, int32_t d)
SYSTEM(path_open, __WASI_ERRNO_NOENT, int32_t a, int32_t b, int32_t c, int32_t d, int32_t e,
       int64_t f, int64_t g, int32_t h, int32_t i)

int32_t __imported_wasi_snapshot_preview1_environ_sizes_get(uint32_t *count, uint32_t *size);
int32_t __imported_wasi_snapshot_preview1_environ_sizes_get(uint32_t *count, uint32_t *size) {
    *count = *size = 0;
    return __WASI_ERRNO_SUCCESS;
}

int32_t __imported_wasi_snapshot_preview1_clock_time_get(int32_t clock, int64_t precision,
                                                         uint64_t *time);
int32_t __imported_wasi_snapshot_preview1_clock_time_get(int32_t clock, int64_t precision,
                                                         uint64_t *time) {
    (void)clock, (void)precision;
    *time = 0;
    return __WASI_ERRNO_SUCCESS;
}

_Noreturn void __imported_wasi_snapshot_preview1_proc_exit(int32_t code);
void __imported_wasi_snapshot_preview1_proc_exit(int32_t code) {
    (void)code;
    __builtin_trap();
}

/* expat's salt against files with colliding names. Without imports there are no random numbers;
 * such a file slows down only its own instance. */
void arc4random_buf(void *bytes, size_t size);
void arc4random_buf(void *bytes, size_t size) {
    memset(bytes, 0x5a, size);
}

/* There are no files; libc's fopen would import WASI's. */
FILE *fopen(const char *restrict path, const char *restrict mode) {
    (void)path, (void)mode;
    return NULL;
}
