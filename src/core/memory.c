#include "core/memory.h"

enum { ALIGNMENT = 64 };

burnish_status burnish_allocate(void **pointer, size_t count, size_t size, const char *what,
                                burnish_error *error) {
    size_t bytes;
    *pointer = NULL;
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    if (!burnish_size_multiply(count, size, &bytes) || bytes > PTRDIFF_MAX - ALIGNMENT) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "%s: %zu elements do not fit the address space", what, count);
    }
    *pointer = aligned_alloc(ALIGNMENT, (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
    return *pointer ? BURNISH_STATUS_OK : burnish_fail_memory(error, what, bytes);
}

burnish_status burnish_reserve(void **pointer, size_t *capacity, size_t needed, size_t size,
                               const char *what, burnish_error *error) {
    if (needed <= *capacity) {
        return BURNISH_STATUS_OK;
    }
    size_t next = *capacity < 64 ? 64 : *capacity;
    while (next < needed) {
        if (next > SIZE_MAX / 2) {
            next = needed;
            break;
        }
        next *= 2;
    }
    size_t bytes;
    if (!burnish_size_multiply(next, size, &bytes) || bytes > PTRDIFF_MAX) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "%s: %zu elements do not fit the address space", what, needed);
    }
    void *grown = realloc(*pointer, bytes);
    if (!grown) {
        return burnish_fail_memory(error, what, bytes);
    }
    *pointer = grown;
    *capacity = next;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_reserve_discard(void **pointer, size_t *capacity, size_t count, size_t size,
                                       const char *what, burnish_error *error) {
    if (count <= *capacity) {
        return BURNISH_STATUS_OK;
    }
    free(*pointer);
    *capacity = 0;
    burnish_status status = burnish_allocate(pointer, count, size, what, error);
    if (status == BURNISH_STATUS_OK) {
        *capacity = count;
    }
    return status;
}
