/* For tests: a context that counts the bytes it has handed out. */
#ifndef BURNISH_TEST_USED_BYTES_H
#define BURNISH_TEST_USED_BYTES_H

#include <stdatomic.h>

#include "burnish/core.h"
#include "support.h"

/* Bytes that a context has handed out, and the most at any time. */
typedef struct used_bytes {
    atomic_size_t now, most;
    size_t refused; /* an array of this size fails; 0: none does */
} used_bytes;

/* In front of each array: its size and where malloc's begins. */
typedef struct array_start {
    size_t size;
    void *memory;
} array_start;

static inline void *allocate_counted(void *user_data, size_t size, size_t alignment) {
    used_bytes *used = user_data;
    const int is_refused =
        used->refused && size == (used->refused + alignment - 1) / alignment * alignment;
    char *memory = is_refused ? NULL : malloc(size + alignment + sizeof(array_start));
    if (!memory) {
        return NULL;
    }
    const size_t first = sizeof(array_start);
    char *array =
        memory + first + (alignment - (uintptr_t)(memory + first) % alignment) % alignment;
    memcpy(array - first, &(array_start){size, memory}, first);
    const size_t now = atomic_fetch_add(&used->now, size) + size;
    for (size_t most = atomic_load(&used->most);
         now > most && !atomic_compare_exchange_weak(&used->most, &most, now);) {
    }
    return array;
}

static inline void release_counted(void *user_data, void *array) {
    array_start start;
    memcpy(&start, (char *)array - sizeof start, sizeof start);
    atomic_fetch_sub(&((used_bytes *)user_data)->now, start.size);
    free(start.memory);
}

static inline burnish_context *make_counted(used_bytes *used) {
    burnish_context_options options = burnish_context_options_default();
    burnish_context *context = NULL;
    *used = (used_bytes){0};
    options.allocator = (burnish_allocator){allocate_counted, release_counted, used};
    CHECK1(burnish_context_create(&options, &context, NULL) == BURNISH_STATUS_OK);
    return context;
}

#endif
