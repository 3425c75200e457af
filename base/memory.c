#include "base/memory.h"

#include <string.h>

#include "base/context.h"

enum { FIRST_CAPACITY = 64 };

/* Whether the context brings an allocator of its own. */
static const burnish_allocator *own_allocator(const burnish_context *context) {
    return context && context->options.allocator.allocate ? &context->options.allocator : NULL;
}

const burnish_context *burnish_memory_owner(const burnish_context *context) {
    return own_allocator(context) ? context : NULL;
}

#ifdef _WIN32
#include <malloc.h>

static void *default_allocate(size_t bytes) {
    return _aligned_malloc(bytes, BURNISH_ALIGNMENT);
}

static void *default_reallocate(void *items, size_t bytes) {
    return _aligned_realloc(items, bytes, BURNISH_ALIGNMENT);
}

static void default_release(void *items) {
    _aligned_free(items);
}
#else
#ifdef __GLIBC__
/* Large arrays take whole pages including glibc's header of 16 bytes. They are then adjacent
 * without gaps, and released neighbours merge. glibc's aligned_alloc() keeps the gaps between
 * arrays for small requests, which prevents merging. */
enum { LARGE = 1 << 16, PAGE = 1 << 12, HEADER = 16 };

static size_t round_size(size_t bytes) {
    return bytes < LARGE ? bytes : (bytes + HEADER + PAGE - 1) / PAGE * PAGE - HEADER;
}

static void *default_allocate(size_t bytes) {
    if (bytes < LARGE) {
        return aligned_alloc(BURNISH_ALIGNMENT, bytes);
    }
    void *items = malloc(round_size(bytes));
    if ((uintptr_t)items % BURNISH_ALIGNMENT != 0) {
        free(items);
        items = aligned_alloc(PAGE, round_size(bytes));
    }
    return items;
}
#else
static size_t round_size(size_t bytes) {
    return bytes;
}

static void *default_allocate(size_t bytes) {
    return aligned_alloc(BURNISH_ALIGNMENT, bytes);
}
#endif

/* Moves large arrays without copying them, but might not keep their alignment. */
static void *default_reallocate(void *items, size_t bytes) {
    return realloc(items, round_size(bytes));
}

static void default_release(void *items) {
    free(items);
}
#endif

static void *take(const burnish_context *context, size_t bytes) {
    const burnish_allocator *own = own_allocator(context);
    const size_t rounded = (bytes + BURNISH_ALIGNMENT - 1) / BURNISH_ALIGNMENT * BURNISH_ALIGNMENT;
    return own ? own->allocate(own->user_data, rounded, BURNISH_ALIGNMENT)
               : default_allocate(rounded);
}

void burnish_release(const burnish_context *context, void *items) {
    const burnish_allocator *own = own_allocator(context);
    if (!own) {
        default_release(items);
    } else if (items) {
        own->release(own->user_data, items);
    }
}

/* count * size in *bytes, or a failure. */
static int count_bytes(burnish_memory *memory, size_t count, size_t size, const char *what,
                       size_t *bytes) {
    if (memory->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (!burnish_size_multiply(count, size, bytes) || *bytes > PTRDIFF_MAX - BURNISH_ALIGNMENT) {
        memory->status = burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                                      "%s: %zu elements do not fit the address space", what, count);
        return 0;
    }
    return 1;
}

void *burnish_allocate(burnish_memory *memory, size_t count, size_t size, const char *what) {
    size_t bytes;
    if (count == 0 || !count_bytes(memory, count, size, what, &bytes)) {
        return NULL;
    }
    void *items = take(memory->context, bytes);
    if (!items) {
        memory->status = burnish_fail_memory(memory->error, what, bytes);
    }
    return items;
}

void *burnish_allocate_zeroed(burnish_memory *memory, size_t count, size_t size, const char *what) {
    void *items = burnish_allocate(memory, count, size, what);
    if (items) {
        memset(items, 0, count * size);
    }
    return items;
}

/* The next capacity that holds `needed`: doubled from the present one. */
static size_t next_capacity(size_t capacity, size_t needed) {
    size_t next = capacity < FIRST_CAPACITY ? FIRST_CAPACITY : capacity;
    while (next < needed) {
        if (next > SIZE_MAX / 2) {
            return needed;
        }
        next *= 2;
    }
    return next;
}

void *burnish_reserve(burnish_memory *memory, void *items, size_t *capacity, size_t needed,
                      size_t size, const char *what) {
    size_t bytes;
    if (needed <= *capacity) {
        return items;
    }
    const size_t next = next_capacity(*capacity, needed);
    if (!count_bytes(memory, next, size, what, &bytes)) {
        return items;
    }
    void *grown;
    if (own_allocator(memory->context)) {
        grown = take(memory->context, bytes);
        if (grown && items) {
            memcpy(grown, items, *capacity * size);
            burnish_release(memory->context, items);
        }
    } else {
        grown = default_reallocate(items, bytes);
    }
    if (!grown) {
        memory->status = burnish_fail_memory(memory->error, what, bytes);
        return items;
    }
    *capacity = next;
    return grown;
}

void *burnish_shrink(const burnish_context *context, void *items, size_t *capacity, size_t count,
                     size_t size) {
    const size_t bytes = count * size;
    void *moved;
    if (own_allocator(context)) {
        moved = take(context, bytes);
        if (moved) {
            memcpy(moved, items, bytes);
            burnish_release(context, items);
        }
    } else {
        moved = default_reallocate(items, bytes);
    }
    *capacity = moved ? count : *capacity;
    return moved ? moved : items;
}

void *burnish_reserve_discard(burnish_memory *memory, void *items, size_t *capacity, size_t count,
                              size_t size, const char *what) {
    if (count <= *capacity) {
        return items;
    }
    burnish_release(memory->context, items);
    items = burnish_allocate(memory, count, size, what);
    *capacity = items ? count : 0;
    return items;
}
