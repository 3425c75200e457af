/* Memory for a process that lives for milliseconds: where the first touch of a page costs more than
 * what is written there, freed memory is used again instead of given back, and large pages are
 * asked for (bench/NOTES.md has the figures). A wish to the C library; nothing depends on it. */
#include "cli/run.h"

#include <stdint.h>
#include <stdlib.h>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

enum {
    ROOM = 24 << 20, /* what drawing a common mesh takes at once; only touched pages count */
    KEPT = 32 << 20, /* the largest threshold that the library takes */
    LARGE_PAGE = 1 << 21
};

void cli_prepare_memory(void) {
    if (!mallopt(M_MMAP_THRESHOLD, KEPT) || !mallopt(M_TRIM_THRESHOLD, 2 * KEPT) ||
        !mallopt(M_ARENA_MAX, 1)) {
        return;
    }
    /* What the heap has before its next large page is taken for good and never touched: memory
     * begins with large pages. */
    void *volatile skipped = malloc(LARGE_PAGE - (uintptr_t)sbrk(0) % LARGE_PAGE);
    char *room = malloc(ROOM);
    (void)skipped;
#ifdef MADV_HUGEPAGE
    if (room) {
        uintptr_t first = ((uintptr_t)room + LARGE_PAGE - 1) & ~(uintptr_t)(LARGE_PAGE - 1);
        uintptr_t end = ((uintptr_t)room + ROOM) & ~(uintptr_t)(LARGE_PAGE - 1);
        madvise((void *)first, end - first, MADV_HUGEPAGE); /* no error matters */
    }
#endif
    free(room); /* stays in the heap: below the trim threshold */
}
#else
void cli_prepare_memory(void) {}
#endif
