/* The pool runs every piece once, by no more threads than it may, and can be used again and again.
 */
#include <stdatomic.h>
#include <string.h>

#include "core/pool.h"
#include "harness.h"

enum { MOST = 1000, THREADS = 5 };

typedef struct counts {
    atomic_int runs[MOST];
    atomic_int inside[THREADS]; /* pieces that a thread is in */
    atomic_int wrong;
    int most; /* threads allowed */
} counts;

static void count_piece(void *of, size_t index, int thread) {
    counts *c = of;
    if (thread < 0 || thread >= c->most) {
        atomic_fetch_add(&c->wrong, 1);
        return;
    }
    /* two pieces of one thread's number at a time would share its memory */
    if (atomic_fetch_add(&c->inside[thread], 1) != 0) {
        atomic_fetch_add(&c->wrong, 1);
    }
    atomic_fetch_add(&c->runs[index], 1);
    for (volatile int i = 0; i < (int)(index % 7) * 50; ++i) {
    }
    atomic_fetch_sub(&c->inside[thread], 1);
}

static void check_run(burnish_pool *pool, size_t count, size_t part, int most) {
    static counts c;
    memset(&c, 0, sizeof c);
    const int all = burnish_pool_threads(pool);
    c.most = most > 0 && most < all ? most : all;
    burnish_pool_run(pool, count, part, most, count_piece, &c);
    int wrong = atomic_load(&c.wrong);
    for (size_t i = 0; i < MOST; ++i) {
        wrong += atomic_load(&c.runs[i]) != (i < count);
    }
    CHECK(wrong == 0, "%zu pieces, %zu at once, %d of %d threads: %d wrong", count, part, most, all,
          wrong);
}

static void add_range(void *of, size_t first, size_t end) {
    atomic_size_t *sum = of;
    for (size_t i = first; i < end; ++i) {
        atomic_fetch_add(sum, i + 1);
    }
}

static void check_ranges(burnish_pool *pool) {
    for (size_t count = 0; count < 300; count += 13) {
        for (size_t size = 1; size < 100; size += 31) {
            atomic_size_t sum = 0;
            burnish_pool_ranges(pool, count, size, add_range, &sum);
            CHECK(atomic_load(&sum) == count * (count + 1) / 2, "%zu by %zu", count, size);
        }
    }
}

int main(void) {
    static const size_t counts_tried[] = {0, 1, 2, 3, 17, 100, MOST};
    CHECK(burnish_pool_threads(NULL) == 1, "no pool is the caller alone");
    CHECK(burnish_pool_create(1) == NULL, "one thread needs no pool");
    CHECK(burnish_processor_count() >= 1, "a processor");
    for (int threads = 1; threads <= THREADS; ++threads) {
        burnish_pool *pool = burnish_pool_create(threads);
        CHECK(burnish_pool_threads(pool) == threads, "%d threads", threads);
        for (int round = 0; round < 200; ++round) {
            check_run(pool, counts_tried[round % 7], (size_t)(1 + round % 9), round % 4);
        }
        check_ranges(pool);
        burnish_pool_destroy(pool);
    }
    for (int i = 0; i < 100; ++i) { /* pools that hardly live */
        burnish_pool *pool = burnish_pool_create(3);
        if (i % 2) {
            check_run(pool, 10, 1, 0);
        }
        burnish_pool_destroy(pool);
    }
    return test_end("pool");
}
