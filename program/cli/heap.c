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

/* Allocates free pieces of the heap before an address, and never uses them: at most `most` of `size`
 * bytes and then half as many, down to `least`. */
static void take_pieces(uintptr_t end, size_t size, size_t least, int most) {
    for (int i = 0; i < most && size >= least; ++i) {
        void *const piece = malloc(size);
        if (!piece || (uintptr_t)piece >= end) {
            free(piece);
            size /= 2;
        }
    }
}

void cli_prepare_memory(void) {
    static int is_prepared;
    if (is_prepared || !mallopt(M_MMAP_THRESHOLD, KEPT) || !mallopt(M_TRIM_THRESHOLD, 2 * KEPT) ||
        !mallopt(M_ARENA_MAX, 1)) {
        return;
    }
    is_prepared = 1;
    /* a large page must be new: up to the heap's end, pages can be in use or inherited */
    const uintptr_t mask = ~(uintptr_t)(LARGE_PAGE - 1),
                    first = ((uintptr_t)sbrk(0) + LARGE_PAGE - 1) & mask;
    char *const room = malloc(ROOM);
    const uintptr_t start = (uintptr_t)room;
    if (!room || start > first || start + ROOM < first) { /* from elsewhere */
        free(room);
        return;
    }
#ifdef MADV_HUGEPAGE
    madvise((void *)first, ((start + ROOM) & mask) - first, MADV_HUGEPAGE); /* may fail */
#endif
    free(room); /* stays in the heap: below the trim threshold */
    take_pieces(first, first - start, 1 << 13, 64); /* they would fault page by page */
}

void cli_prepare_forks(void) {
    if (mallopt(M_MXFAST, 0)) { /* small pieces are merged here, not in each child */
        take_pieces((uintptr_t)sbrk(0), 1 << 16, 1, 1 << 14);
    }
}
#else
void cli_prepare_memory(void) {}
void cli_prepare_forks(void) {}
#endif
