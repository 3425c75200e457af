/* The threads of the process, which calls share. A system without threads has another pool.c, whose
 * burnish_pool_run always returns 0. */
#ifndef BURNISH_CORE_POOL_H
#define BURNISH_CORE_POOL_H

/* A thread's part of a job: takes pieces of it until there are none. The caller is thread 0. */
typedef void burnish_pool_work(void *data, int thread);

/* Has up to `threads` threads, the caller among them, do the work at the same time, and returns 1
 * when all have returned; 0, with nothing done, while the threads work for somebody else. */
int burnish_pool_run(int threads, burnish_pool_work *work, void *data);

#endif
