/* Threads that wait for work and share it: one renderer's, one loader's. Results never depend on
 * their number.
 *
 * The caller works too and takes whatever no other thread has taken: a thread that does not get a
 * processor in time is not waited for, only one that is in the midst of a piece. */
#ifndef BURNISH_CORE_POOL_H
#define BURNISH_CORE_POOL_H

#include <stddef.h>

/* No more threads than this, whatever is asked for. */
#define BURNISH_THREADS_MAX 1024

/* Processors that this process may use. */
int burnish_processor_count(void);

typedef struct burnish_pool burnish_pool;

/* A pool for up to `threads` threads, the caller included; 0 for one a processor. NULL, which is a
 * pool of the caller alone, for one thread or when there is no memory for more. Threads are started
 * when they are first needed; fewer than wanted where the system refuses. */
burnish_pool *burnish_pool_create(int threads);
void burnish_pool_destroy(burnish_pool *pool);

/* Threads of the pool, the caller included: numbers of threads are below it. */
int burnish_pool_threads(const burnish_pool *pool);

/* One piece of work; thread: [0, burnish_pool_threads), the same for no two at a time. */
typedef void burnish_task(void *context, size_t index, int thread);

/* Runs the task for every index below count, each thread taking `part` >= 1 of them at once, by at
 * most `most` threads, whose numbers are below it; 0: as many as there are. Returns when all are
 * done. Not from a task. */
void burnish_pool_run(burnish_pool *pool, size_t count, size_t part, int most, burnish_task *task,
                      void *context);

/* Runs the task for all items below count, `size` of them at a time, in any order. */
typedef void burnish_range_task(void *context, size_t first, size_t end);
void burnish_pool_ranges(burnish_pool *pool, size_t count, size_t size, burnish_range_task *task,
                         void *context);

#endif
