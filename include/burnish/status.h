/* burnish/status.h: how every function of the library reports what went wrong.
 *
 * A function that can fail returns a burnish_status and, when the caller passes a burnish_error,
 * writes one clear line there: which file or argument, where in it, what was wrong, what to do.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_STATUS_H
#define BURNISH_STATUS_H

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

/* Every status of the library: X(name, exit code of the command line, text). */
#define BURNISH_STATUS_LIST(X)                                                                     \
    X(OK, 0, "success")                                                                            \
    X(ARGUMENT, 2, "an argument is out of range or not initialised")                               \
    X(READ, 3, "an input can't be opened or read")                                                 \
    X(FORMAT, 4, "an input is malformed")                                                          \
    X(LIMIT, 5, "an input is larger than the limits allow")                                        \
    X(MEMORY, 6, "out of memory")                                                                  \
    X(WRITE, 7, "an output can't be written")

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

/* The library's version, for example "0.1.0". */
BURNISH_API const char *burnish_version(void);

#ifdef __cplusplus
}
#endif

#endif
