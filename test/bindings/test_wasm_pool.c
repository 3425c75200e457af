/* bindings/wasm/threads.c, the pool of modules with threads, on threads of this system: every
 * thread number once, and work that runs work. Futexes replace the wait and wake instructions. */
#include <linux/futex.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "support.h"

static int wait32(int *word, int value, int64_t nanoseconds) {
    (void)nanoseconds;
    return (int)syscall(SYS_futex, word, FUTEX_WAIT_PRIVATE, value, NULL, NULL, 0);
}

static int notify(int *word, uint32_t count) {
    return (int)syscall(SYS_futex, word, FUTEX_WAKE_PRIVATE, count & INT32_MAX, NULL, NULL, 0);
}

#define __wasm_atomics__
#define __builtin_wasm_memory_atomic_wait32 wait32
#define __builtin_wasm_memory_atomic_notify notify
#define burnish_pool_run wasm_pool_run
#define burnish_processor_count wasm_processor_count
int wasm_processor_count(void);
#define WASM_MODULE_H
#define WASM_EXPORT(name) extern
#include "../bindings/wasm/threads.c"

enum { THREADS = 4, ROUNDS = 2000 };

static void *enter_loop(void *unused) {
    (void)unused;
    thread_loop();
}

typedef struct counts {
    atomic_int calls[THREADS], inner_calls, inner_runs, refused;
} counts;

static void inner(void *data, int thread) {
    (void)thread;
    atomic_fetch_add(&((counts *)data)->inner_calls, 1);
}

static void outer(void *data, int thread) {
    counts *c = data;
    atomic_fetch_add(&c->calls[thread], 1);
    if (burnish_pool_run(THREADS, inner, c)) {
        atomic_fetch_add(&c->inner_runs, 1);
    } else {
        atomic_fetch_add(&c->refused, 1);
    }
}

int main(int count, char **arguments) {
    static char *stacks[THREADS]; /* pointers into each stack, which are never freed and not leaks
                                     */
    test_begin(count, arguments, NULL);
    for (int i = 1; i < THREADS; ++i) {
        pthread_t thread;
        char *end = threads_add();
        if (CHECK1(end && (uintptr_t)end % 16 == 0)) {
            stacks[i] = end - 1;
            CHECK1(stacks[i] != stacks[i - 1]);
        }
        CHECK1(pthread_create(&thread, NULL, enter_loop, NULL) == 0 && pthread_detach(thread) == 0);
    }
    CHECK1(burnish_processor_count() == THREADS);
    for (int round = 0; round < ROUNDS; ++round) {
        counts c = {0};
        int calls = 0;
        CHECK1(burnish_pool_run(THREADS, outer, &c) == 1);
        CHECK(c.calls[0] == 1, "the caller's part: %d times", (int)c.calls[0]);
        for (int i = 0; i < THREADS; ++i) {
            calls += c.calls[i];
            CHECK(c.calls[i] <= 1, "thread %d: %d times", i, (int)c.calls[i]);
        }
        CHECK(c.inner_runs == 0 && c.inner_calls == 0 && c.refused == calls,
              "work that runs work: %d runs, %d calls, %d refused of %d", (int)c.inner_runs,
              (int)c.inner_calls, (int)c.refused, calls);
    }
    return test_end("wasm_pool");
}
