/* How many threads a piece of work is worth. */
#include "base/threads.h"

#ifdef _OPENMP
#include <omp.h>
#endif

int burnish_thread_count(int wanted, size_t items, size_t share) {
#ifdef _OPENMP
    size_t most = items / (share > 0 ? share : 1);
    if (most <= 1 || wanted == 1) {
        return 1; /* before the runtime is asked: its first answer costs */
    }
    size_t count = (size_t)(wanted > 0 ? wanted : omp_get_num_procs());
    count = count < most ? count : most;
    return (int)(count < BURNISH_THREADS_MAX ? count : BURNISH_THREADS_MAX);
#else
    (void)wanted, (void)items, (void)share;
    return 1;
#endif
}

int burnish_thread_index(void) {
#ifdef _OPENMP
    return omp_get_thread_num();
#else
    return 0;
#endif
}
