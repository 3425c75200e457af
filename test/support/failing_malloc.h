/* For tests whose malloc and its kin call these: allocations that fail one after another. */
#ifndef BURNISH_TEST_FAILING_MALLOC_H
#define BURNISH_TEST_FAILING_MALLOC_H

#include <stdatomic.h>

#include "burnish/core.h"
#include "support.h"

static atomic_long allocations_left = -1; /* before one fails; negative: none fails */
static atomic_long live;                  /* taken and not given back */

static inline int fails(void) {
    return atomic_load(&allocations_left) >= 0 && atomic_fetch_sub(&allocations_left, 1) == 0;
}

static inline void *count_one(void *memory) {
    atomic_fetch_add(&live, memory != NULL);
    return memory;
}

/* *hash: of what was made; 0 on failure. */
typedef burnish_status failing_job(const void *data, uint64_t *hash, burnish_error *error);

/* The k-th allocation fails, for every k until all are there: the call says so, or makes the same;
 * nothing is lost. */
static inline void fail_each(const char *name, failing_job *run, const void *data, int least) {
    enum { MOST = 4000 };
    burnish_error error = {0};
    uint64_t expected = 0, hash;
    int k = 0, failed = 0;
    for (int warm = 0; warm < 2; ++warm) { /* what libraries and pools of threads keep for good */
        CHECK(run(data, &expected, &error) == BURNISH_STATUS_OK, "%s: %s", name, error.text);
    }
    const long before = atomic_load(&live);
    for (int ran_short = 1; ran_short && k < MOST; ++k) {
        error = (burnish_error){0};
        atomic_store(&allocations_left, k);
        const burnish_status status = run(data, &hash, &error);
        ran_short = atomic_exchange(&allocations_left, -1) < 0;
        failed += status != BURNISH_STATUS_OK;
        CHECK(status == BURNISH_STATUS_OK
                  ? hash == expected
                  : status == BURNISH_STATUS_MEMORY && strstr(error.text, "memory"),
              "%s, allocation %d: status %d, hash %#llx, \"%s\"", name, k, (int)status,
              (unsigned long long)hash, error.text);
        CHECK(atomic_load(&live) == before, "%s, allocation %d: %ld blocks lost", name, k,
              atomic_load(&live) - before);
    }
    printf("%s: %d of %d failed\n", name, failed, k);
    CHECK(failed >= least && k < MOST, "%s: %d of %d failed", name, failed, k);
}

#endif
