#include "core/pool.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

/* How often a thread looks before it sleeps: ten to a hundred microseconds, about what it takes to
 * wake one and more than there are between two pieces of work of a frame. */
enum { LOOKS = 2000 };

struct burnish_pool {
    int thread_count; /* the caller included */
    int started;      /* others that run */
    pthread_t *threads;
    pthread_mutex_t mutex; /* over all below that is not atomic */
    pthread_cond_t wake, done;
    int sleeping, stop;
    atomic_uint round; /* counts jobs */
    /* the job */
    burnish_task *task;
    void *context;
    size_t count, part;
    int open, joined, most; /* takes more threads, so many have come, and may come */
    atomic_size_t next;     /* index */
    atomic_int active;      /* threads in it besides the caller */
};

static inline void wait_a_moment(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

static void work(burnish_pool *pool, burnish_task *task, void *context, size_t count, size_t part,
                 int thread) {
    for (;;) {
        const size_t first = atomic_fetch_add_explicit(&pool->next, part, memory_order_relaxed);
        if (first >= count) {
            return;
        }
        const size_t end = count - first < part ? count : first + part;
        for (size_t i = first; i < end; ++i) {
            task(context, i, thread);
        }
    }
}

/* Takes part in the open job, if there is one that takes more. The mutex is held. */
static void join_job(burnish_pool *pool) {
    if (!pool->open || pool->joined >= pool->most) {
        return;
    }
    burnish_task *task = pool->task;
    void *context = pool->context;
    const size_t count = pool->count, part = pool->part;
    const int thread = ++pool->joined;
    atomic_fetch_add(&pool->active, 1);
    pthread_mutex_unlock(&pool->mutex);
    work(pool, task, context, count, part, thread);
    pthread_mutex_lock(&pool->mutex);
    if (atomic_fetch_sub(&pool->active, 1) == 1) {
        pthread_cond_signal(&pool->done);
    }
}

static void *run_thread(void *of) {
    burnish_pool *pool = of;
    unsigned seen = 0;
    for (;;) {
        for (int i = 0; i < LOOKS && atomic_load(&pool->round) == seen; ++i) {
            wait_a_moment();
        }
        pthread_mutex_lock(&pool->mutex);
        while (atomic_load(&pool->round) == seen && !pool->stop) {
            ++pool->sleeping;
            pthread_cond_wait(&pool->wake, &pool->mutex);
            --pool->sleeping;
        }
        if (pool->stop) {
            pthread_mutex_unlock(&pool->mutex);
            return NULL;
        }
        seen = atomic_load(&pool->round);
        join_job(pool);
        pthread_mutex_unlock(&pool->mutex);
    }
}

int burnish_processor_count(void) {
#ifdef CPU_COUNT
    cpu_set_t processors;
    if (sched_getaffinity(0, sizeof processors, &processors) == 0) {
        return CPU_COUNT(&processors);
    }
#endif
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online < BURNISH_THREADS_MAX ? (int)online : BURNISH_THREADS_MAX;
}

burnish_pool *burnish_pool_create(int threads) {
    if (threads <= 0) {
        threads = burnish_processor_count();
    }
    if (threads <= 1) {
        return NULL;
    }
    burnish_pool *pool = calloc(1, sizeof *pool);
    if (!pool) {
        return NULL;
    }
    pool->thread_count = threads < BURNISH_THREADS_MAX ? threads : BURNISH_THREADS_MAX;
    pool->threads = calloc((size_t)pool->thread_count, sizeof *pool->threads);
    if (!pool->threads || pthread_mutex_init(&pool->mutex, NULL) != 0) {
        free(pool->threads);
        free(pool);
        return NULL;
    }
    (void)pthread_cond_init(&pool->wake, NULL); /* never fails in glibc and musl */
    (void)pthread_cond_init(&pool->done, NULL);
    return pool;
}

void burnish_pool_destroy(burnish_pool *pool) {
    if (!pool) {
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    pool->stop = 1;
    atomic_fetch_add(&pool->round, 1);
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
    for (int i = 0; i < pool->started; ++i) {
        pthread_join(pool->threads[i], NULL);
    }
    pthread_cond_destroy(&pool->wake);
    pthread_cond_destroy(&pool->done);
    pthread_mutex_destroy(&pool->mutex);
    free(pool->threads);
    free(pool);
}

int burnish_pool_threads(const burnish_pool *pool) {
    return pool ? pool->thread_count : 1;
}

/* Starts what is missing to `wanted` threads besides the caller. */
static void start_threads(burnish_pool *pool, int wanted) {
    while (pool->started < wanted &&
           pthread_create(&pool->threads[pool->started], NULL, run_thread, pool) == 0) {
        ++pool->started;
    }
}

static void open_job(burnish_pool *pool, size_t count, size_t part, int most, burnish_task *task,
                     void *context) {
    pthread_mutex_lock(&pool->mutex);
    pool->task = task;
    pool->context = context;
    pool->count = count;
    pool->part = part;
    pool->most = most;
    pool->joined = 0;
    pool->open = 1;
    atomic_store(&pool->next, 0);
    atomic_fetch_add(&pool->round, 1);
    if (pool->sleeping > 0) {
        pthread_cond_broadcast(&pool->wake);
    }
    pthread_mutex_unlock(&pool->mutex);
}

/* Nobody joins any more; waits for those that are in a piece. */
static void close_job(burnish_pool *pool) {
    pthread_mutex_lock(&pool->mutex);
    pool->open = 0;
    pthread_mutex_unlock(&pool->mutex);
    for (int i = 0; i < LOOKS && atomic_load(&pool->active) > 0; ++i) {
        wait_a_moment();
    }
    pthread_mutex_lock(&pool->mutex);
    while (atomic_load(&pool->active) > 0) {
        pthread_cond_wait(&pool->done, &pool->mutex);
    }
    pthread_mutex_unlock(&pool->mutex);
}

void burnish_pool_run(burnish_pool *pool, size_t count, size_t part, int most, burnish_task *task,
                      void *context) {
    const int all = burnish_pool_threads(pool);
    int threads = most > 0 && most < all ? most : all;
    threads = count / part < (size_t)threads ? (int)(count / part) : threads;
    if (threads <= 1) {
        for (size_t i = 0; i < count; ++i) {
            task(context, i, 0);
        }
        return;
    }
    start_threads(pool, threads - 1);
    open_job(pool, count, part, threads - 1, task, context);
    work(pool, task, context, count, part, 0);
    close_job(pool);
}

typedef struct range_context {
    burnish_range_task *task;
    void *context;
    size_t count, size;
} range_context;

static void run_range(void *of, size_t index, int thread) {
    const range_context *ranges = of;
    const size_t first = index * ranges->size, rest = ranges->count - first;
    (void)thread;
    ranges->task(ranges->context, first,
                 rest < ranges->size ? ranges->count : first + ranges->size);
}

void burnish_pool_ranges(burnish_pool *pool, size_t count, size_t size, burnish_range_task *task,
                         void *context) {
    range_context ranges = {task, context, count, size};
    burnish_pool_run(pool, count / size + (count % size > 0), 1, 0, run_range, &ranges);
}
