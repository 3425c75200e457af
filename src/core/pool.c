#include "core/pool.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>

#include "burnish/core.h"
#include "core/float_mode.h"

/* How often a thread checks for work before it sleeps: 10 to 100 microseconds. This is about the
 * time to wake a thread, and longer than the gap between two pieces of work of a frame. If threads
 * outnumber processors, they do not spin, since that would take time from working threads. */
enum { SPINS = 2000 };

/* The process' threads: the only state that calls share. */
static struct {
    atomic_flag busy;          /* a caller is using the pool */
    atomic_uint generation;    /* counts jobs */
    atomic_int active;         /* threads in the job besides the caller */
    atomic_int spins;          /* SPINS or 0 */
    pthread_mutex_t mutex;     /* protects the members below */
    pthread_cond_t wake, done; /* a job has come; the last thread has left it */
    burnish_pool_work *work;   /* of the job, with its data */
    void *data;
    int started, sleeping;        /* threads */
    int open, joined, max_joined; /* accepts workers; workers that joined; most workers allowed */
} pool = {.busy = ATOMIC_FLAG_INIT,
          .mutex = PTHREAD_MUTEX_INITIALIZER,
          .wake = PTHREAD_COND_INITIALIZER,
          .done = PTHREAD_COND_INITIALIZER};

static inline void cpu_relax(void) {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

/* Joins the open job if it accepts workers. The mutex is held. */
static void join_job(void) {
    if (!pool.open || pool.joined >= pool.max_joined) {
        return;
    }
    const int thread = ++pool.joined;
    burnish_pool_work *work = pool.work;
    void *data = pool.data;
    atomic_fetch_add(&pool.active, 1);
    pthread_mutex_unlock(&pool.mutex);
    work(data, thread);
    pthread_mutex_lock(&pool.mutex);
    if (atomic_fetch_sub(&pool.active, 1) == 1) {
        pthread_cond_signal(&pool.done);
    }
}

static void *run_thread(void *unused) {
    unsigned seen = 0;
    (void)unused;
    (void)burnish_float_mode_enter(); /* a thread inherits its creator's */
    for (;;) {
        const int spins = atomic_load(&pool.spins);
        for (int i = 0; i < spins && atomic_load(&pool.generation) == seen; ++i) {
            cpu_relax();
        }
        pthread_mutex_lock(&pool.mutex);
        while (atomic_load(&pool.generation) == seen) {
            ++pool.sleeping;
            pthread_cond_wait(&pool.wake, &pool.mutex);
            --pool.sleeping;
        }
        seen = atomic_load(&pool.generation);
        join_job();
        pthread_mutex_unlock(&pool.mutex);
    }
    return NULL;
}

#ifndef _WIN32
/* fork copies one thread: the child's pool starts anew. */
static void forget_threads(void) {
    pool.started = pool.sleeping = pool.open = 0;
    pool.mutex = (pthread_mutex_t)PTHREAD_MUTEX_INITIALIZER;
    pool.wake = (pthread_cond_t)PTHREAD_COND_INITIALIZER;
    pool.done = (pthread_cond_t)PTHREAD_COND_INITIALIZER;
    atomic_store(&pool.active, 0);
    atomic_flag_clear(&pool.busy);
}

static void watch_forks(void) {
    (void)pthread_atfork(NULL, NULL, forget_threads);
}
#endif

static void create_threads(int wanted) {
    pthread_t thread;
    while (pool.started < wanted && pthread_create(&thread, NULL, run_thread, NULL) == 0) {
        pthread_detach(thread);
        ++pool.started;
    }
}

/* Starts threads until there are `wanted` besides the caller, or as many as the system allows.
 * Signals belong to the host program: threads of the pool block them. */
static void start_threads(int wanted) {
    if (pool.started >= wanted) {
        return;
    }
#ifdef _WIN32
    create_threads(wanted);
#else
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    sigset_t all, before;
    pthread_once(&once, watch_forks);
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    create_threads(wanted);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
#endif
}

static void open_job(burnish_pool_work *work, void *data, int max_joined) {
    pthread_mutex_lock(&pool.mutex);
    pool.work = work;
    pool.data = data;
    pool.max_joined = max_joined;
    pool.joined = 0;
    pool.open = 1;
    atomic_fetch_add(&pool.generation, 1);
    if (pool.sleeping > 0) {
        pthread_cond_broadcast(&pool.wake);
    }
    pthread_mutex_unlock(&pool.mutex);
}

/* Closes the job to new threads and waits for the threads that work on a piece. */
static void close_job(void) {
    const int spins = atomic_load(&pool.spins);
    pthread_mutex_lock(&pool.mutex);
    pool.open = 0;
    pthread_mutex_unlock(&pool.mutex);
    for (int i = 0; i < spins && atomic_load(&pool.active) > 0; ++i) {
        cpu_relax();
    }
    pthread_mutex_lock(&pool.mutex);
    while (atomic_load(&pool.active) > 0) {
        pthread_cond_wait(&pool.done, &pool.mutex);
    }
    pthread_mutex_unlock(&pool.mutex);
}

int burnish_pool_run(int threads, burnish_pool_work *work, void *data) {
    if (atomic_flag_test_and_set(&pool.busy)) {
        return 0;
    }
    start_threads(threads - 1);
    atomic_store(&pool.spins, threads <= burnish_processor_count() ? SPINS : 0);
    open_job(work, data, threads - 1);
    work(data, 0);
    close_job();
    atomic_flag_clear(&pool.busy);
    return 1;
}
