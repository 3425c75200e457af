/* Memory for a process that lives for milliseconds, where page faults cost more than writing the
 * pages: freed memory is reused instead of returned, and large pages are requested (figures:
 * bench/NOTES.md). These are hints to the C library; nothing depends on them. */
#include "cli/limits.h"

#include <stdint.h>
#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    ROOM = 28 << 20, /* needed to draw a common mesh; only touched pages count */
    KEPT = 32 << 20, /* the largest threshold that the library accepts */
    LARGE_PAGE = 1 << 21
};

void cli_prepare_memory(void) {
    if (!mallopt(M_MMAP_THRESHOLD, KEPT) || !mallopt(M_TRIM_THRESHOLD, 2 * KEPT) ||
        !mallopt(M_ARENA_MAX, 1)) {
        return;
    }
    /* The rest of the heap up to the next large page is allocated and never used, so all memory is
     * in large pages. */
    void *volatile skipped = malloc(LARGE_PAGE - (uintptr_t)sbrk(0) % LARGE_PAGE);
    char *room = malloc(ROOM);
    (void)skipped;
#ifdef MADV_HUGEPAGE
    if (room) {
        uintptr_t first = ((uintptr_t)room + LARGE_PAGE - 1) & ~(uintptr_t)(LARGE_PAGE - 1);
        uintptr_t end = ((uintptr_t)room + ROOM) & ~(uintptr_t)(LARGE_PAGE - 1);
        madvise((void *)first, end - first, MADV_HUGEPAGE); /* errors do not matter */
    }
#endif
    free(room); /* stays in the heap: below the trim threshold */
}
#else
void cli_prepare_memory(void) {}
#endif
