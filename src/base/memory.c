#include "base/memory.h"

#include <sys/mman.h>

enum {
    ALIGNMENT = 64,
    LARGE_PAGE = 1 << 21,
    LARGE = 4 << 20 /* below this a large page would mostly be rounding */
};

void burnish_advise_large(void *memory, size_t bytes) {
#ifdef MADV_HUGEPAGE
    if (!memory || bytes < LARGE) {
        return;
    }
    uintptr_t first = ((uintptr_t)memory + LARGE_PAGE - 1) & ~(uintptr_t)(LARGE_PAGE - 1);
    uintptr_t end = ((uintptr_t)memory + bytes) & ~(uintptr_t)(LARGE_PAGE - 1);
    if (first < end) {
        madvise((void *)first, end - first, MADV_HUGEPAGE); /* a wish: no error matters */
    }
#else
    (void)memory, (void)bytes;
#endif
}

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
    burnish_advise_large(*pointer, bytes);
    return *pointer ? BURNISH_STATUS_OK : burnish_fail_memory(error, what, bytes);
}

burnish_status burnish_grow(void **pointer, size_t *capacity, size_t needed, size_t size,
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
    burnish_advise_large(grown, bytes);
    *pointer = grown;
    *capacity = next;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_renew(void **pointer, size_t *capacity, size_t count, size_t size,
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
