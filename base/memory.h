/* Memory through checked arithmetic and the context's allocator.
 *
 * Functions return the pointer. The burnish_memory keeps the first failure, after which all further
 * allocations fail, so a function can allocate all it needs and check once:
 *
 *     burnish_memory memory = burnish_memory_of(context, error);
 *     float *depths = burnish_allocate(&memory, count, sizeof *depths, "depths");
 *     uint32_t *ids = burnish_allocate(&memory, count, sizeof *ids, "triangle ids");
 *     if (memory.status != BURNISH_STATUS_OK) { ... burnish_release() what is there ... }
 */
#ifndef BURNISH_BASE_MEMORY_H
#define BURNISH_BASE_MEMORY_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/error.h"

/* The alignment of new arrays: enough for any vector type. */
#define BURNISH_ALIGNMENT 64

/* a * b in *product; returns 0 if it does not fit. */
static inline int burnish_size_multiply(size_t a, size_t b, size_t *product) {
    return !__builtin_mul_overflow(a, b, product);
}

/* A source of memory, and its first failure. One thread at a time may use it. */
typedef struct burnish_memory {
    const burnish_context *context; /* NULL: malloc and free */
    burnish_status status;          /* OK, or the status of the first failure: MEMORY or LIMIT */
    burnish_error *error;           /* receives the message of the first failure; may be NULL */
} burnish_memory;

static inline burnish_memory burnish_memory_of(const burnish_context *context,
                                               burnish_error *error) {
    return (burnish_memory){context, BURNISH_STATUS_OK, error};
}

/* Copies a failure of a thread's own memory, unless this has failed before. */
static inline void burnish_memory_join(burnish_memory *memory, const burnish_memory *thread) {
    if (memory->status == BURNISH_STATUS_OK && thread->status != BURNISH_STATUS_OK) {
        memory->status = thread->status;
        if (memory->error && thread->error) {
            *memory->error = *thread->error;
        }
    }
}

/* The context if it has an allocator, else NULL. An object that stores this instead of the context
 * can outlive a context without an allocator. */
const burnish_context *burnish_memory_owner(const burnish_context *context);

/* count elements of size bytes, not cleared, aligned to BURNISH_ALIGNMENT. NULL on failure and for
 * count 0. `what` names the array in the message. */
void *burnish_allocate(burnish_memory *memory, size_t count, size_t size, const char *what);

/* The same, all bytes 0. */
void *burnish_allocate_zeroed(burnish_memory *memory, size_t count, size_t size, const char *what);

/* items with room for at least `needed` elements, contents kept: doubles *capacity as often as
 * needed. Returns their new address, aligned as malloc aligns; on failure items, unchanged. */
void *burnish_reserve(burnish_memory *memory, void *items, size_t *capacity, size_t needed,
                      size_t size, const char *what);

/* Releases the memory beyond the first `count` elements, at least 1. Returns their new address,
 * aligned as malloc aligns; on failure items, with *capacity unchanged. */
void *burnish_shrink(const burnish_context *context, void *items, size_t *capacity, size_t count,
                     size_t size);

/* Room for at least `count` elements, without keeping old contents; *capacity counts elements of
 * one size. NULL and *capacity 0 on failure. */
void *burnish_reserve_discard(burnish_memory *memory, void *items, size_t *capacity, size_t count,
                              size_t size, const char *what);

#endif
