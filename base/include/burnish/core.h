/* burnish/core.h: version, status and error, context, instruction sets and files, which all other
 * headers use.
 *
 * A function that can fail returns a burnish_status. If the caller passes a burnish_error, the
 * function writes one line into it: the file or argument, the location in it, what was wrong, and
 * what would be right.
 *
 * A burnish_context supplies memory and threads, receives warnings and progress, and can cancel a
 * call. NULL is the default context: malloc and free, one thread pool per process, no output.
 *
 * Threads. A renderer, a drawing, a PNG stream or an image being written may be used by one thread
 * at a time. A mesh may be read and drawn by many threads at once, but not while
 * burnish_mesh_set_material() or burnish_mesh_clip() changes it. A context may be shared if its
 * functions allow it. Everything else may be called from any thread at any time.
 *
 * These are shared by the whole process, and safe to use from any thread:
 *   - the thread pool, which starts with the first call that needs it and keeps its threads
 *   - the list of the temporary files of burnish_file_write() and its variants
 *   - the counter that numbers meshes (burnish_mesh_view.serial)
 *   - the instruction sets that the processor was found to have
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_CORE_H
#define BURNISH_CORE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32) && defined(BURNISH_SHARED)
#ifdef BURNISH_BUILDING
#define BURNISH_API __declspec(dllexport)
#else
#define BURNISH_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define BURNISH_API __attribute__((visibility("default")))
#else
#define BURNISH_API
#endif

/* The version of these headers. burnish_version_number() returns the version of the library. */
#define BURNISH_VERSION_MAJOR 0
#define BURNISH_VERSION_MINOR 1
#define BURNISH_VERSION_PATCH 0
#define BURNISH_VERSION_NUMBER                                                                     \
    (BURNISH_VERSION_MAJOR * 10000 + BURNISH_VERSION_MINOR * 100 + BURNISH_VERSION_PATCH)

/* The version of the library: "0.1.0", and major * 10000 + minor * 100 + patch. */
BURNISH_API const char *burnish_version(void);
BURNISH_API int burnish_version_number(void);

/* ---- Status and error ---- */

/* All statuses: X(name, exit code of the program burnish, text). */
#define BURNISH_STATUS_LIST(X)                                                                     \
    X(OK, 0, "success")                                                                            \
    X(ARGUMENT, 2, "an argument is out of range or not initialised")                               \
    X(READ, 3, "an input can't be opened or read")                                                 \
    X(FORMAT, 4, "an input is malformed")                                                          \
    X(LIMIT, 5, "an input is larger than the limits allow")                                        \
    X(MEMORY, 6, "out of memory")                                                                  \
    X(WRITE, 7, "an output can't be written")                                                      \
    X(CANCELLED, 9, "the caller cancelled the call")

typedef enum burnish_status {
#define BURNISH_STATUS_ENUM(name, code, text) BURNISH_STATUS_##name,
    BURNISH_STATUS_LIST(BURNISH_STATUS_ENUM)
#undef BURNISH_STATUS_ENUM
        BURNISH_STATUS_COUNT
} burnish_status;

/* One line about a failure. The caller owns it, and burnish never allocates memory for it. */
typedef struct burnish_error {
    burnish_status status; /* what the function returned */
    char text[480];        /* UTF-8 without newline and control characters */
} burnish_error;

/* The meaning of a status; "unknown status" for a value outside the list. */
BURNISH_API const char *burnish_status_text(burnish_status status);

/* The exit code of the program burnish for a status; 1 for a value outside the list. */
BURNISH_API int burnish_status_exit_code(burnish_status status);

/* ---- Description structs ---- */

/* The layout of a struct as the caller was compiled: its size and the version of the headers.
 *
 * A ..._default() function returns a description struct with its default values and a cookie, so 0
 * in a member means 0. It is an inline function that passes the caller's layout to ..._init(). A
 * struct that was not initialised, or whose layout is not the library's, is refused with
 * ARGUMENT. */
#define BURNISH_LAYOUT(type) ((uint64_t)(BURNISH_VERSION_NUMBER / 100) << 32 | sizeof(type))

/* ---- Context ---- */

/* Allocates memory. Both functions are called from several threads at once.
 *   allocate   returns size > 0 bytes aligned to alignment, a power of two up to 64; or NULL
 *   release    releases memory from allocate; never called with NULL
 *   user_data  passed to both
 * The library takes all memory from it, with these exceptions: burnish_file_write() and its
 * variants use malloc for the name of a temporary file and a buffer of 64 KiB; the thread pool uses
 * memory of the system; decoders of PNG, JPEG, WebP, XML and compressed data use malloc as their
 * libraries do. */
typedef struct burnish_allocator {
    void *(*allocate)(void *user_data, size_t size, size_t alignment);
    void (*release)(void *user_data, void *memory);
    void *user_data;
} burnish_allocator;

/* Runs tasks in parallel.
 *   thread_count  the most calls of a task that run at once, [1, 1024]
 *   run           calls task(data, i) once for each i in [0, count), in any order and on any
 *                 thread, in parallel if possible, and returns after the last; count <=
 *                 thread_count
 *   user_data     passed to run */
typedef struct burnish_task_runner {
    int thread_count;
    void (*run)(void *user_data, int count, void (*task)(void *data, int index), void *data);
    void *user_data;
} burnish_task_runner;

/* The stages that progress reports. */
typedef enum burnish_stage {
    BURNISH_STAGE_READ,      /* bytes to attributes */
    BURNISH_STAGE_BUILD,     /* welding, normals, order */
    BURNISH_STAGE_TRANSFORM, /* projecting vertices, sorting triangles into tiles */
    BURNISH_STAGE_DRAW,      /* tiles to pixels */
    BURNISH_STAGE_ENCODE,    /* pixels to a file's bytes */
    BURNISH_STAGE_COUNT
} burnish_stage;

/* The options of a context. A function that is NULL is not used.
 *   tasks      run NULL: the thread pool of the process
 *   log        receives each warning as it occurs: one line of UTF-8 without a newline
 *   cancelled  called every few milliseconds; any value but 0 ends the call with CANCELLED
 *   progress   receives the progress of a stage in [0, 1], which never decreases */
typedef struct burnish_context_options {
    uint32_t cookie;             /* set by burnish_context_options_default() */
    burnish_allocator allocator; /* both functions or neither */
    burnish_task_runner tasks;
    void (*log)(void *user_data, const char *line);
    void *log_user_data;
    int (*cancelled)(void *user_data);
    void *cancelled_user_data;
    void (*progress)(void *user_data, burnish_stage stage, double fraction);
    void *progress_user_data;
} burnish_context_options;

BURNISH_API void burnish_context_options_init(burnish_context_options *options, uint64_t layout);
static inline burnish_context_options burnish_context_options_default(void) {
    burnish_context_options options;
    burnish_context_options_init(&options, BURNISH_LAYOUT(burnish_context_options));
    return options;
}

/* A context. Several threads may use it at once if its functions allow it. log, cancelled and
 * progress are called on the thread that called burnish, or on the thread that runs index 0 if the
 * context has a task runner. */
typedef struct burnish_context burnish_context;

/* Creates a context.
 *   options  copied
 *   context  receives the context, NULL on error. Destroy it after everything created with it
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_context_create(const burnish_context_options *options,
                                                  burnish_context **context, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_context_destroy(burnish_context *context);

/* Releases memory that the library returned.
 *   context  the context of the call that returned the memory
 *   memory   NULL is allowed */
BURNISH_API void burnish_release(const burnish_context *context, void *memory);

/* The number of processors that this process can use: its affinity mask, limited by the quota of
 * its control group (a container). At least 1. */
BURNISH_API int burnish_processor_count(void);

/* ---- Instruction sets ---- */

/* All instruction sets: X(name, word, floats per vector). A later one of the same processor family
 * is faster. avx512 requires F, DQ, BW and VL. */
#define BURNISH_ISA_LIST(X)                                                                        \
    X(SCALAR, scalar, 1)                                                                           \
    X(SSE2, sse2, 4)                                                                               \
    X(AVX2, avx2, 8)                                                                               \
    X(AVX512, avx512, 16)                                                                          \
    X(NEON, neon, 4)                                                                               \
    X(WASM, wasm, 4)

typedef enum burnish_isa {
#define BURNISH_ISA_ENUM(name, word, lanes) BURNISH_ISA_##name,
    BURNISH_ISA_LIST(BURNISH_ISA_ENUM)
#undef BURNISH_ISA_ENUM
        BURNISH_ISA_COUNT
} burnish_isa;

/* A set of instruction sets: the sum of 1 << burnish_isa. */
typedef uint32_t burnish_isa_flags;

/* The environment variable that burnish_isa_choose() reads. */
#define BURNISH_ISA_VARIABLE "BURNISH_ISA"

/* The word of an instruction set, such as "avx2"; "unknown" for a value outside the list. */
BURNISH_API const char *burnish_isa_name(burnish_isa isa);

/* The number of floats in a vector; 0 for a value outside the list. */
BURNISH_API int burnish_isa_lanes(burnish_isa isa);

/* The instruction sets that this build contains and this processor runs; SCALAR is always one. On
 * x86 the operating system must also save the registers (CPUID and XCR0). */
BURNISH_API burnish_isa_flags burnish_isa_available(void);

/* The fastest instruction set of a set; SCALAR if the set is empty. */
BURNISH_API burnish_isa burnish_isa_best(burnish_isa_flags available);

/* Chooses an instruction set by name.
 *   name   its word; NULL or "auto": the value of the environment variable BURNISH_ISA or, if that
 *          is unset, empty or "auto", the fastest available
 *   isa    receives the instruction set, SCALAR on error; not NULL
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT (an unknown word, or an instruction set that is not available). */
BURNISH_API burnish_status burnish_isa_choose(const char *name, burnish_isa *isa,
                                              burnish_error *error);

/* ---- Files ---- */

/* Writes a file, which appears completely or not at all. The bytes go to a temporary file in
 * the same folder, which then replaces the file. After an error, no new file exists and an existing
 * file is unchanged. On Linux this also holds if the process is killed, on most file systems;
 * elsewhere call burnish_file_remove_temporaries(). It does not hold after a power failure, since
 * the function does not wait for the disk (fsync).
 *
 * Symbolic links are followed; a link to a missing file is refused. An existing file keeps its
 * permissions; the umask applies to a new file. A device or pipe is written directly.
 *   path   the file; "-" is standard output
 *   bytes  the content; may be NULL if size is 0
 *   size   in bytes
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT (path is NULL or empty), MEMORY, WRITE. If the program ignores SIGPIPE and
 * SIGXFSZ, a closed pipe and a file above the size limit are also errors. */
BURNISH_API burnish_status burnish_file_write(const char *path, const void *bytes, size_t size,
                                              burnish_error *error);

/* The last check of an output, called after all bytes are written and before the file appears.
 *   user_data  from the call of burnish_file_write_checked()
 *   error      receives the message of a failure
 * Returns OK, or an error that discards the output. */
typedef burnish_status burnish_file_check(void *user_data, burnish_error *error);

/* burnish_file_write() with a last check. If the check fails, no file appears and an existing file
 * is unchanged; what was written directly, to a pipe or device, can not be taken back.
 *   path, bytes, size, error  as for burnish_file_write()
 *   check                     not NULL
 *   user_data                 passed to check
 * Errors: as for burnish_file_write(), or the error of check. */
BURNISH_API burnish_status burnish_file_write_checked(const char *path, const void *bytes,
                                                      size_t size, burnish_file_check *check,
                                                      void *user_data, burnish_error *error);

/* Supplies the next bytes of an output.
 *   user_data  from the call of burnish_file_write_stream()
 *   buffer     to fill
 *   size       of the buffer in bytes
 * Returns the number of bytes, at most size; 0 ends the output. */
typedef size_t burnish_file_source(void *user_data, char *buffer, size_t size);

/* burnish_file_write_checked() for an output that is generated while it is written, through one
 * buffer. A source that fails returns 0, and check returns its error; then no file appears.
 *   path       the file; "-" is standard output
 *   source     called until it returns 0; not NULL
 *   user_data  passed to source and check
 *   check      NULL: no check
 *   error      receives the message; may be NULL
 * Errors: as for burnish_file_write(), or the error of check. */
BURNISH_API burnish_status burnish_file_write_stream(const char *path, burnish_file_source *source,
                                                     void *user_data, burnish_file_check *check,
                                                     burnish_error *error);

/* Removes the temporary files that are being written at this moment. For a signal handler that ends
 * the process: async-signal-safe. Calls that are writing will fail. */
BURNISH_API void burnish_file_remove_temporaries(void);

#ifdef __cplusplus
}
#endif

#endif
