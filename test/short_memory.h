/* Memory that runs short on demand. Included by one file of a program; the linker leads the
 * library's calls of malloc and its kin here (see test/CMakeLists.txt). */
#ifndef BURNISH_TEST_SHORT_MEMORY_H
#define BURNISH_TEST_SHORT_MEMORY_H

#include <stdatomic.h>
#include <stdlib.h>

static atomic_long allocations_left = -1; /* before one fails; negative: none fails */
static atomic_long live;                  /* taken and not given back */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);
void __wrap_free(void *memory);

static int fails(void) {
    return atomic_load(&allocations_left) >= 0 && atomic_fetch_sub(&allocations_left, 1) == 0;
}

static void *count_one(void *memory) {
    atomic_fetch_add(&live, memory != NULL);
    return memory;
}

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : count_one(__real_malloc(size));
}
void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : count_one(__real_calloc(count, size));
}
void *__wrap_realloc(void *old, size_t size) {
    void *memory = fails() ? NULL : __real_realloc(old, size);
    return old ? memory : count_one(memory);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return fails() ? NULL : count_one(__real_aligned_alloc(alignment, size));
}
char *__wrap_strdup(const char *text) {
    return fails() ? NULL : count_one(__real_strdup(text));
}
void __wrap_free(void *memory) {
    atomic_fetch_sub(&live, memory != NULL);
    __real_free(memory);
}

#endif
