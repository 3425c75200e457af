/* Work that threads share. Results never depend on how many there are.
 *
 * The threads are one pool per process, started when they are first needed, or the context's task
 * runner. The caller works too and takes whatever no other thread has taken: a thread that does not
 * get a processor in time is not waited for, only one that is in the midst of a piece. While the
 * pool works for one caller, others work alone. */
#ifndef BURNISH_CORE_TASKS_H
#define BURNISH_CORE_TASKS_H

#include <stdatomic.h>
#include <stddef.h>

#include "burnish/core.h"

/* The most threads of a call. */
#define BURNISH_THREADS_MAX 1024

/* One call's share of the threads, on its stack. */
typedef struct burnish_tasks {
    const burnish_context *context; /* may be NULL */
    int threads;                    /* [1, BURNISH_THREADS_MAX]: at most so many at a time */
    atomic_int cancelled;           /* 1 once the context said so */
} burnish_tasks;

/* threads: at most so many; 0 for one per processor, or the task runner's thread_count. */
void burnish_tasks_begin(burnish_tasks *tasks, const burnish_context *context, int threads);

/* The threads that may take part, the caller included; 1 for NULL. Thread numbers are below it. */
int burnish_tasks_threads(const burnish_tasks *tasks);

/* One piece of work; thread: [0, burnish_tasks_threads), the same for no two at a time. */
typedef void burnish_task(void *context, size_t index, int thread);

/* Runs the task for every index below count, each thread taking `grain` >= 1 of them at once, by at
 * most `max_threads` threads, whose numbers are below it; 0: as many as there are. tasks NULL: by
 * the caller alone. Returns when all are done, or early when cancelled. */
void burnish_tasks_run(burnish_tasks *tasks, size_t count, size_t grain, int max_threads,
                       burnish_task *task, void *context);

/* Runs the task for all items below count, `size` of them at a time, in any order. */
typedef void burnish_range_task(void *context, size_t first, size_t end);
void burnish_tasks_ranges(burnish_tasks *tasks, size_t count, size_t size, burnish_range_task *task,
                          void *context);

/* The same by the caller alone, one after the other from the first on: long loops that are serial
 * ask the context meanwhile. */
void burnish_tasks_in_order(burnish_tasks *tasks, size_t count, size_t size,
                            burnish_range_task *task, void *context);

/* Lowers *least to value where that is smaller: the first of what threads find, whoever finds it.
 */
static inline void burnish_lower_to(atomic_size_t *least, size_t value) {
    size_t seen = atomic_load(least);
    while (value < seen && !atomic_compare_exchange_weak(least, &seen, value)) {
    }
}

/* Whether the context wants the call to end; asks it. Everybody who ran tasks looks afterwards. */
int burnish_tasks_cancelled(burnish_tasks *tasks);

/* Whether a task that takes long is to return: asked by it from time to time, for its thread.
 * Thread 0, the caller's own, asks the context. */
int burnish_tasks_should_end(burnish_tasks *tasks, int thread);

/* CANCELLED with its line where the context wants the call to end, else OK. */
burnish_status burnish_tasks_check(burnish_tasks *tasks, burnish_error *error);

/* Tells the context how far a stage has come. */
void burnish_tasks_progress(const burnish_tasks *tasks, burnish_stage stage, double fraction);

#endif
