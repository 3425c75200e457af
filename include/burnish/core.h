/* burnish/core.h: what every part of the library shares: version, status and error, context,
 * instruction sets, files.
 *
 * A function that can fail returns a burnish_status and, when the caller passes a burnish_error,
 * writes one clear line there: which file or argument, where in it, what was wrong, what to do.
 *
 * A burnish_context tells the library where to take memory from, where to run work, whom to tell
 * about warnings and progress, and when to stop. NULL stands for the default: malloc and free, one
 * pool of threads per process, silence.
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

/* The version of these headers; burnish_version_number() is that of the library that is linked. */
#define BURNISH_VERSION_MAJOR 0
#define BURNISH_VERSION_MINOR 1
#define BURNISH_VERSION_PATCH 0
#define BURNISH_VERSION_NUMBER                                                                     \
    (BURNISH_VERSION_MAJOR * 10000 + BURNISH_VERSION_MINOR * 100 + BURNISH_VERSION_PATCH)

/* The library's version as text, for example "0.1.0", and as major * 10000 + minor * 100 + patch.
 */
BURNISH_API const char *burnish_version(void);
BURNISH_API int burnish_version_number(void);

/* ---- Status and error ---- */

/* Every status of the library: X(name, exit code of the command line, text). */
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

/* One line about a failure. The caller owns it; burnish never allocates for an error. */
typedef struct burnish_error {
    burnish_status status; /* the status that the function returned */
    char text[480];        /* one line, UTF-8, without a newline, control characters replaced */
} burnish_error;

/* The general meaning of a status, "unknown status" for a value outside the list. */
BURNISH_API const char *burnish_status_text(burnish_status status);

/* The exit code that the command line gives a status: 0 for OK, 1 for a value outside the list. */
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

/* Where memory comes from. Both functions are called from any thread that runs burnish's work, also
 * at the same time.
 *   allocate  returns size > 0 bytes, aligned to alignment (a power of two, at most 64), or NULL
 *   release   takes back what allocate returned; never NULL */
typedef struct burnish_allocator {
    void *(*allocate)(void *user_data, size_t size, size_t alignment);
    void (*release)(void *user_data, void *memory);
    void *user_data;
} burnish_allocator;

/* Who runs work that can be shared by threads.
 *   thread_count  how many calls of a task may run at the same time, [1, 1024]
 *   run           calls task(data, i) once for each i in [0, count), at the same time where it can,
 *                 in any order and on any thread, and returns when all have returned; count is at
 *                 most thread_count */
typedef struct burnish_task_runner {
    int thread_count;
    void (*run)(void *user_data, int count, void (*task)(void *data, int index), void *data);
    void *user_data;
} burnish_task_runner;

/* The steps of a call that progress speaks of. */
typedef enum burnish_stage {
    BURNISH_STAGE_READ,      /* bytes to attributes */
    BURNISH_STAGE_BUILD,     /* welding, normals, order */
    BURNISH_STAGE_TRANSFORM, /* vertices to the screen, triangles to tiles */
    BURNISH_STAGE_DRAW,      /* tiles to pixels */
    BURNISH_STAGE_ENCODE,    /* pixels to a file's bytes */
    BURNISH_STAGE_COUNT
} burnish_stage;

/* How a context is made. Start from burnish_context_options_default(). NULL functions mean the
 * default. */
typedef struct burnish_context_options {
    uint32_t cookie;             /* set by burnish_context_options_default() */
    burnish_allocator allocator; /* both functions or neither */
    burnish_task_runner tasks;   /* run NULL: the process' pool of threads */
    /* A warning as it is found: one line of UTF-8 without a newline. */
    void (*log)(void *user_data, const char *line);
    void *log_user_data;
    /* Asked every few milliseconds; anything but 0 ends the call with CANCELLED. */
    int (*cancelled)(void *user_data);
    void *cancelled_user_data;
    /* How far a stage has come: [0, 1], not falling. */
    void (*progress)(void *user_data, burnish_stage stage, double fraction);
    void *progress_user_data;
} burnish_context_options;

BURNISH_API void burnish_context_options_init(burnish_context_options *options, uint64_t layout);
static inline burnish_context_options burnish_context_options_default(void) {
    burnish_context_options options;
    burnish_context_options_init(&options, BURNISH_LAYOUT(burnish_context_options));
    return options;
}

/* Options that calls share. May be used by several threads at the same time where its functions
 * allow that. log, cancelled and progress are called by the thread that called burnish or, with a
 * task runner of the caller's, by the one that runs index 0. */
typedef struct burnish_context burnish_context;

/* *context is NULL on error. Destroy it after everything that was made with it.
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_context_create(const burnish_context_options *options,
                                                  burnish_context **context, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_context_destroy(burnish_context *context);

/* Releases memory that the library handed over.
 *   context  the one that the call had which returned it; NULL for the default
 *   memory   NULL is allowed */
BURNISH_API void burnish_release(const burnish_context *context, void *memory);

/* Processors that this process may use: those of its affinity mask, fewer where its control group
 * (a container's quota) has less time than that. At least 1. */
BURNISH_API int burnish_processor_count(void);

/* ---- Instruction sets ---- */

/* X(name, word, lanes), the one list of them: lanes is the number of floats in a vector. Those of a
 * processor are ordered: a later one is faster. avx512 means F, DQ, BW and VL together. */
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

/* The environment variable that burnish_isa_choose reads. */
#define BURNISH_ISA_VARIABLE "BURNISH_ISA"

/* "avx2"; "unknown" for a value outside the list. */
BURNISH_API const char *burnish_isa_name(burnish_isa isa);

/* Floats in a vector of that instruction set, 0 for a value outside the list. */
BURNISH_API int burnish_isa_lanes(burnish_isa isa);

/* The instruction sets that this build has and this processor runs. SCALAR is always one of them. On x86 one counts only where the operating system saves
 * its registers (CPUID together with XCR0). Asks the processor each time, which takes microseconds
 * under a hypervisor: keep the answer. */
BURNISH_API burnish_isa_flags burnish_isa_available(void);

/* The fastest of a set of instruction sets; SCALAR for an empty one. Depends on nothing else. */
BURNISH_API burnish_isa burnish_isa_best(burnish_isa_flags available);

/* Chooses an instruction set by name.
 *   name  its word; NULL or "auto": what the environment variable BURNISH_ISA names, and where
 *         that is unset, empty or "auto" the best available
 *   isa   receives it, SCALAR on error; not NULL
 *   error receives the one line of an error; may be NULL
 * Errors: ARGUMENT for an unknown word, or one that this build or processor lacks. */
BURNISH_API burnish_status burnish_isa_choose(const char *name, burnish_isa *isa,
                                              burnish_error *error);

/* ---- Files ---- */

/* Writes bytes to a file. A new or existing regular file is written to a temporary in the same
 * folder, which then takes its name: on any error nothing is left and an existing file is as it
 * was. The same when the process is killed, where the system has files without names (Linux, most
 * file systems); elsewhere see burnish_file_remove_temporaries. Not when power fails: nothing waits
 * for the disk (fsync would cost more than most pictures). Links stay links, one to nothing is
 * refused; an existing file keeps its permissions, a new one gets those of the umask. Something
 * else that exists (a device, a pipe) is written directly.
 *   path   the file; "-" is standard output
 *   bytes  what to write; may be NULL when size is 0
 *   size   how many
 *   error  receives the one line of an error; may be NULL
 * Errors: ARGUMENT (path NULL or empty), MEMORY, WRITE. A closed pipe and the limit of file sizes
 * are errors, provided the program ignores SIGPIPE and SIGXFSZ. */
BURNISH_API burnish_status burnish_file_write(const char *path, const void *bytes, size_t size,
                                              burnish_error *error);

/* Called when all bytes of an output are written, before a regular file takes its name.
 *   user_data  as passed to burnish_file_write_checked
 * Returns OK, or an error that gives the output up. */
typedef burnish_status burnish_file_check(void *user_data, burnish_error *error);

/* burnish_file_write with a last step that can still fail, such as a report: where it does, no file
 * appears and an existing one is as it was. (What is written directly is written by then.)
 *   check    not NULL
 *   user_data  handed to check
 * Errors: as burnish_file_write, and those of check. */
BURNISH_API burnish_status burnish_file_write_checked(const char *path, const void *bytes,
                                                      size_t size, burnish_file_check *check,
                                                      void *user_data, burnish_error *error);

/* Fills buffer with the next bytes of an output.
 *   user_data  as passed to burnish_file_write_stream
 *   buffer   size bytes to fill
 * Returns how many were filled: at most size; 0 ends the output. */
typedef size_t burnish_file_source(void *user_data, char *buffer, size_t size);

/* The same for an output that is made while it is written, with no more memory than one buffer.
 *   path     the file; "-" is standard output
 *   source   called until it returns 0; not NULL
 *   user_data  handed to source
 *   error    receives the one line of an error; may be NULL
 * Errors: as burnish_file_write. */
BURNISH_API burnish_status burnish_file_write_stream(const char *path, burnish_file_source *source,
                                                     void *user_data, burnish_error *error);

/* The same with a last step, as burnish_file_write_checked has one. A source that can't go on returns
 * 0 and leaves its error to check, and no file appears.
 *   user_data  handed to source and to check
 *   check    NULL: none
 * Errors: as burnish_file_write, and those of check. */
BURNISH_API burnish_status burnish_file_write_stream_checked(const char *path,
                                                             burnish_file_source *source,
                                                             void *user_data,
                                                             burnish_file_check *check,
                                                             burnish_error *error);

/* Removes the temporaries of calls that are writing at this moment. For a handler of signals that
 * ends the process: async-signal-safe, and those calls fail if they go on. */
BURNISH_API void burnish_file_remove_temporaries(void);

#ifdef __cplusplus
}
#endif

#endif
