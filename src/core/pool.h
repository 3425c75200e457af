/* The threads of the process, shared by all calls. A system without threads has another pool.c,
 * whose burnish_pool_run always returns 0. */
#ifndef BURNISH_CORE_POOL_H
#define BURNISH_CORE_POOL_H

/* A thread's part of a job: takes pieces of it until none are left. The caller is thread 0. */
typedef void burnish_pool_work(void *data, int thread);

/* Runs the work in up to `threads` threads at the same time, the caller included. Returns 1 when
 * all have returned, or 0 without doing anything if the pool is busy. */
int burnish_pool_run(int threads, burnish_pool_work *work, void *data);

#endif
