/* The thread pool of a module with shared memory: the caller and workers, each with its own
 * instance of the module and the same memory. Like src/core/pool.c it does not wait for threads
 * that have not started. */
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/wasm/module.h"
#include "core/pool.h"

#ifndef __wasm_atomics__

int burnish_pool_run(int threads, burnish_pool_work *work, void *data) {
    (void)threads, (void)work, (void)data;
    return 0;
}

int burnish_processor_count(void) {
    return 1;
}

#else

WASM_EXPORT(threads_add) void *threads_add(void);
WASM_EXPORT(thread_loop) _Noreturn void thread_loop(void);

enum {
    STACK_SIZE = 1 << 20,
    CLOSED = 1 << 30 /* of the gate: no more threads can start */
};

static int threads = 1; /* the caller's included */

static struct {
    atomic_int number; /* of the job: threads sleep on it */
    atomic_int gate;   /* number of threads at the job, and CLOSED */
    atomic_int taken;  /* numbers of threads */
    atomic_int busy;   /* 1 while there is a job */
    int wanted;
    burnish_pool_work *work;
    void *data;
} job = {.gate = CLOSED};

static void sleep_while(atomic_int *word, int value) {
    __builtin_wasm_memory_atomic_wait32((int *)word, value, -1);
}

static void wake(atomic_int *word) {
    __builtin_wasm_memory_atomic_notify((int *)word, UINT32_MAX);
}

int burnish_processor_count(void) {
    return threads;
}

int burnish_pool_run(int count, burnish_pool_work *work, void *data) {
    if (atomic_exchange(&job.busy, 1)) {
        return 0; /* work that runs work: only by its own thread */
    }
    job.work = work;
    job.data = data;
    job.wanted = count;
    atomic_store(&job.taken, 1);
    atomic_fetch_and(&job.gate, ~CLOSED);
    atomic_fetch_add(&job.number, 1);
    wake(&job.number);
    work(data, 0);
    atomic_fetch_or(&job.gate, CLOSED);
    for (int left; (left = atomic_load(&job.gate)) != CLOSED;) {
        sleep_while(&job.gate, left);
    }
    atomic_store(&job.busy, 0);
    return 1;
}

/* The endless loop of a worker, with its own stack in __stack_pointer. */
void thread_loop(void) {
    for (int seen = 0;;) {
        sleep_while(&job.number, seen);
        seen = atomic_load(&job.number);
        if (!(atomic_fetch_add(&job.gate, 1) & CLOSED)) {
            const int number = atomic_fetch_add(&job.taken, 1);
            if (number < job.wanted) {
                job.work(job.data, number);
            }
        }
        if (atomic_fetch_sub(&job.gate, 1) == (CLOSED | 1)) {
            wake(&job.gate);
        }
    }
}

/* Adds a thread and returns its stack; NULL without memory. Call it while no job runs. */
void *threads_add(void) {
    char *stack = malloc(STACK_SIZE);
    threads += stack != NULL;
    return stack ? (void *)(((uintptr_t)stack + STACK_SIZE) & ~(uintptr_t)15) : NULL;
}

/* ---- Memory: the linker replaces wasi-libc's allocator, which is not thread-safe, by these ---- */

static atomic_int lock;

static void enter(void) {
    while (atomic_exchange(&lock, 1)) {
        sleep_while(&lock, 1);
    }
}

static void leave(void) {
    atomic_store(&lock, 0);
    __builtin_wasm_memory_atomic_notify((int *)&lock, 1);
}

#define LOCKED(type, name, parameters, arguments)                                                  \
    type __real_##name parameters;                                                                 \
    type __wrap_##name parameters;                                                                 \
    type __wrap_##name parameters {                                                                \
        enter();                                                                                   \
        type result = __real_##name arguments;                                                     \
        leave();                                                                                   \
        return result;                                                                             \
    }
LOCKED(void *, malloc, (size_t size), (size))
LOCKED(void *, calloc, (size_t count, size_t size), (count, size))
LOCKED(void *, realloc, (void *memory, size_t size), (memory, size))
LOCKED(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
LOCKED(int, posix_memalign, (void **memory, size_t alignment, size_t size),
       (memory, alignment, size))

void __real_free(void *memory);
void __wrap_free(void *memory);
void __wrap_free(void *memory) {
    enter();
    __real_free(memory);
    leave();
}
#endif
