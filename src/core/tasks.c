#include "core/tasks.h"

#include <pthread.h>
#include <signal.h>
#include <stdint.h>

#include "core/context.h"
#include "core/environment.h"
#include "core/error.h"

/* How often a thread looks before it sleeps: ten to a hundred microseconds, about what it takes to
 * wake one and more than there are between two pieces of work of a frame. None where threads
 * outnumber processors: there spinning takes the time of one that works. */
enum { SPINS = 2000 };

/* A job: indices that threads take `grain` at a time. */
typedef struct job {
    burnish_tasks *tasks;
    burnish_task *task;
    void *context;
    size_t count, grain;
    atomic_size_t next; /* index */
} job;

/* The process' threads: the only state that calls share. */
static struct {
    atomic_flag busy;          /* works for somebody */
    atomic_uint generation;    /* counts jobs */
    atomic_int active;         /* threads in the job besides the caller */
    atomic_int spins;          /* SPINS or 0 */
    pthread_mutex_t mutex;     /* over all below */
    pthread_cond_t wake, done; /* a job has come; the last thread has left it */
    job *job;
    int started, sleeping;        /* threads */
    int open, joined, max_joined; /* takes more threads, so many have come, and may come */
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

static void work(job *j, int thread) {
    for (;;) {
        const size_t first = atomic_fetch_add_explicit(&j->next, j->grain, memory_order_relaxed);
        if (first >= j->count) {
            return;
        }
        const size_t end = j->count - first < j->grain ? j->count : first + j->grain;
        for (size_t i = first; i < end; ++i) {
            j->task(j->context, i, thread);
        }
        if (thread == 0 ? burnish_tasks_cancelled(j->tasks)
                        : atomic_load_explicit(&j->tasks->cancelled, memory_order_relaxed)) {
            return;
        }
    }
}

/* Takes part in the open job, if there is one that takes more. The mutex is held. */
static void join_job(void) {
    if (!pool.open || pool.joined >= pool.max_joined) {
        return;
    }
    job *j = pool.job;
    const int thread = ++pool.joined;
    atomic_fetch_add(&pool.active, 1);
    pthread_mutex_unlock(&pool.mutex);
    work(j, thread);
    pthread_mutex_lock(&pool.mutex);
    if (atomic_fetch_sub(&pool.active, 1) == 1) {
        pthread_cond_signal(&pool.done);
    }
}

static void *run_thread(void *unused) {
    unsigned seen = 0;
    (void)unused;
    (void)burnish_environment_enter(); /* a thread inherits its creator's */
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

/* Starts what is missing to `wanted` threads besides the caller, as many as the system allows.
 * Signals are the host program's business: no thread of the pool takes any. */
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

static void open_job(job *j, int max_joined) {
    pthread_mutex_lock(&pool.mutex);
    pool.job = j;
    pool.max_joined = max_joined;
    pool.joined = 0;
    pool.open = 1;
    atomic_fetch_add(&pool.generation, 1);
    if (pool.sleeping > 0) {
        pthread_cond_broadcast(&pool.wake);
    }
    pthread_mutex_unlock(&pool.mutex);
}

/* Nobody joins any more; waits for those that are in a piece. */
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

static void run_in_pool(job *j, int threads) {
    start_threads(threads - 1);
    atomic_store(&pool.spins, threads <= burnish_processor_count() ? SPINS : 0);
    open_job(j, threads - 1);
    work(j, 0);
    close_job();
    atomic_flag_clear(&pool.busy);
}

static void run_as_index(void *data, int index) {
    const burnish_environment before = burnish_environment_enter();
    work(data, index);
    burnish_environment_leave(before);
}

void burnish_tasks_begin(burnish_tasks *tasks, const burnish_context *context, int threads) {
    const burnish_task_runner *runner =
        context && context->options.tasks.run ? &context->options.tasks : NULL;
    const int all = runner ? runner->thread_count
                           : (threads > 0 ? BURNISH_THREADS_MAX : burnish_processor_count());
    tasks->context = context;
    tasks->threads = threads > 0 && threads < all ? threads : all;
    atomic_init(&tasks->cancelled, 0);
}

int burnish_tasks_threads(const burnish_tasks *tasks) {
    return tasks ? tasks->threads : 1;
}

int burnish_tasks_cancelled(burnish_tasks *tasks) {
    const burnish_context *context = tasks ? tasks->context : NULL;
    if (!context || !context->options.cancelled) {
        return 0;
    }
    if (!atomic_load(&tasks->cancelled) &&
        context->options.cancelled(context->options.cancelled_user_data)) {
        atomic_store(&tasks->cancelled, 1);
    }
    return atomic_load(&tasks->cancelled);
}

burnish_status burnish_tasks_check(burnish_tasks *tasks, burnish_error *error) {
    return burnish_tasks_cancelled(tasks)
               ? burnish_fail(error, BURNISH_STATUS_CANCELLED, "cancelled by the caller")
               : BURNISH_STATUS_OK;
}

void burnish_tasks_progress(const burnish_tasks *tasks, burnish_stage stage, double fraction) {
    if (tasks && tasks->context && tasks->context->options.progress) {
        tasks->context->options.progress(tasks->context->options.progress_user_data, stage,
                                         fraction);
    }
}

void burnish_tasks_run(burnish_tasks *tasks, size_t count, size_t grain, int max_threads,
                       burnish_task *task, void *context) {
    burnish_tasks alone = {.threads = 1};
    job j = {tasks ? tasks : &alone, task, context, count, grain, 0};
    const int all = j.tasks->threads;
    int threads = max_threads > 0 && max_threads < all ? max_threads : all;
    if (atomic_load(&j.tasks->cancelled)) {
        return; /* what came before is incomplete: nothing may build on it */
    }
    threads = count / grain < (size_t)threads ? (int)(count / grain) : threads;
    if (threads <= 1) {
        work(&j, 0);
    } else if (j.tasks->context && j.tasks->context->options.tasks.run) {
        const burnish_task_runner *runner = &j.tasks->context->options.tasks;
        runner->run(runner->user_data, threads, run_as_index, &j);
    } else if (atomic_flag_test_and_set(&pool.busy)) {
        work(&j, 0);
    } else {
        run_in_pool(&j, threads);
    }
}

typedef struct range_context {
    burnish_range_task *task;
    void *context;
    size_t count, size;
} range_context;

static void run_range(void *context, size_t index, int thread) {
    const range_context *ranges = context;
    const size_t first = index * ranges->size, rest = ranges->count - first;
    (void)thread;
    ranges->task(ranges->context, first,
                 rest < ranges->size ? ranges->count : first + ranges->size);
}

static void run_ranges(burnish_tasks *tasks, int max_threads, range_context *ranges) {
    const size_t count = ranges->count / ranges->size + (ranges->count % ranges->size > 0);
    burnish_tasks_run(tasks, count, 1, max_threads, run_range, ranges);
}

void burnish_tasks_ranges(burnish_tasks *tasks, size_t count, size_t size, burnish_range_task *task,
                          void *context) {
    run_ranges(tasks, 0, &(range_context){task, context, count, size});
}

void burnish_tasks_in_order(burnish_tasks *tasks, size_t count, size_t size,
                            burnish_range_task *task, void *context) {
    run_ranges(tasks, 1, &(range_context){task, context, count, size});
}
