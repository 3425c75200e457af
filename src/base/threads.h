/* How many threads a piece of work is worth. Results never depend on the answer. */
#ifndef BURNISH_BASE_THREADS_H
#define BURNISH_BASE_THREADS_H

#include <stddef.h>

/* No more threads than this, whatever is asked for. */
#define BURNISH_THREADS_MAX 1024

/* Threads for `items` pieces of work of which each thread should get `share` at least, so that
 * small work starts none. wanted: 0 for one a processor. At least 1; always 1 without OpenMP. */
int burnish_thread_count(int wanted, size_t items, size_t share);

/* Number of the calling thread in its team, from 0. */
int burnish_thread_index(void);

#endif
