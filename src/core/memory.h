/* Allocation through checked arithmetic, and a growing array. */
#ifndef BURNISH_CORE_MEMORY_H
#define BURNISH_CORE_MEMORY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/error.h"

/* a * b in *product; returns 0 when it does not fit. */
static inline int burnish_size_multiply(size_t a, size_t b, size_t *product) {
    return !__builtin_mul_overflow(a, b, product);
}

/* count elements of size bytes, not cleared, aligned for any vector type (64 bytes). *pointer
 * becomes NULL on error, and also for count 0. Release with free(). `what` names the array in the
 * message. */
burnish_status burnish_allocate(void **pointer, size_t count, size_t size, const char *what,
                                burnish_error *error);

/* Makes room for at least `needed` elements in an array that malloc owns: doubles *capacity as
 * often as it must. The array is unchanged on error. */
burnish_status burnish_reserve(void **pointer, size_t *capacity, size_t needed, size_t size,
                               const char *what, burnish_error *error);

/* Makes room for at least `count` elements whose old contents are of no interest, aligned as by
 * burnish_allocate. A capacity counts elements of one size. *pointer is NULL and *capacity 0 on
 * error. */
burnish_status burnish_reserve_discard(void **pointer, size_t *capacity, size_t count, size_t size,
                                       const char *what, burnish_error *error);

#endif
