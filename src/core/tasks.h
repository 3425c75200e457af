/* Work shared by threads. Results never depend on their number.
 *
 * The threads are one pool per process, started at the first use, or the context's task runner. The
 * caller also works and takes what no other thread has taken, so it waits only for threads in the
 * middle of a piece, not for threads without a processor. While the pool works for one caller,
 * others work alone. */
#ifndef BURNISH_CORE_TASKS_H
#define BURNISH_CORE_TASKS_H

#include <stdatomic.h>
#include <stddef.h>

#include "base/context.h"

/* One call's share of the threads, on its stack. */
typedef struct burnish_tasks {
    const burnish_context *context; /* may be NULL */
    int threads;                    /* most threads at a time, [1, BURNISH_THREADS_MAX] */
    atomic_int cancelled;           /* 1 once the context has cancelled */
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

/* The same in the caller alone, in order. For long serial loops, which then check for
 * cancelling. */
void burnish_tasks_in_order(burnish_tasks *tasks, size_t count, size_t size,
                            burnish_range_task *task, void *context);

/* Lowers *least to value where that is smaller: the first of what threads find, whoever finds it.
 */
static inline void burnish_lower_to(atomic_size_t *least, size_t value) {
    size_t seen = atomic_load(least);
    while (value < seen && !atomic_compare_exchange_weak(least, &seen, value)) {
    }
}

/* Checks whether the context cancels the call. Callers check this after running tasks. */
int burnish_tasks_cancelled(burnish_tasks *tasks);

/* Whether a task must return early; long tasks check this from time to time. In thread 0, the
 * caller, it calls the context. */
int burnish_tasks_should_end(burnish_tasks *tasks, int thread);

/* CANCELLED with its message if the context cancels the call, else OK. */
burnish_status burnish_tasks_check(burnish_tasks *tasks, burnish_error *error);

/* Reports the progress of a stage to the context. */
void burnish_tasks_progress(const burnish_tasks *tasks, burnish_stage stage, double fraction);

#endif
