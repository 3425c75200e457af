/* Writes the one line of a burnish_error. */
#ifndef BURNISH_BASE_ERROR_H
#define BURNISH_BASE_ERROR_H

#include <stddef.h>

#include "base/arithmetic.h"
#include "base/show_text.h"
#include "burnish/core.h"

/* Fills *error (may be NULL), cleaned, and returns status, so callers can
 * `return burnish_fail(...)`. */
__attribute__((format(printf, 3, 4))) burnish_status
burnish_fail(burnish_error *error, burnish_status status, const char *format, ...);

/* A failed allocation of `bytes` for `what`, which may be a file's name. */
burnish_status burnish_fail_memory(burnish_error *error, const char *what, size_t bytes);

/* The meaning of an errno. Unlike strerror's, the string is in the caller's buffer. */
typedef struct burnish_reason {
    char text[96];
} burnish_reason;
burnish_reason burnish_errno_reason(int code);

#endif
