/* Tasks run every piece once, by no more threads than they may, again and again. */
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/processors.h"
#include "core/tasks.h"
#include "support.h"

enum { MOST = 1000, THREADS = 5 };

typedef struct counts {
    atomic_int runs[MOST];
    atomic_int inside[THREADS]; /* pieces that a thread is in */
    atomic_int wrong;
    int most; /* threads allowed */
} counts;

static void count_piece(void *of, size_t index, int thread) {
    counts *c = of;
    if (thread < 0 || thread >= c->most) {
        atomic_fetch_add(&c->wrong, 1);
        return;
    }
    /* two pieces of one thread's number at a time would share its memory */
    if (atomic_fetch_add(&c->inside[thread], 1) != 0) {
        atomic_fetch_add(&c->wrong, 1);
    }
    atomic_fetch_add(&c->runs[index], 1);
    for (volatile int i = 0; i < (int)(index % 7) * 50; ++i) {
    }
    atomic_fetch_sub(&c->inside[thread], 1);
}

static void check_run(burnish_tasks *tasks, size_t count, size_t part, int most) {
    static counts c;
    memset(&c, 0, sizeof c);
    const int all = burnish_tasks_threads(tasks);
    c.most = most > 0 && most < all ? most : all;
    burnish_tasks_run(tasks, count, part, most, count_piece, &c);
    int wrong = atomic_load(&c.wrong);
    for (size_t i = 0; i < MOST; ++i) {
        wrong += atomic_load(&c.runs[i]) != (i < count);
    }
    CHECK(wrong == 0, "%zu pieces, %zu at once, %d of %d threads: %d wrong", count, part, most, all,
          wrong);
}

static void add_range(void *of, size_t first, size_t end) {
    atomic_size_t *sum = of;
    for (size_t i = first; i < end; ++i) {
        atomic_fetch_add(sum, i + 1);
    }
}

static void check_ranges(burnish_tasks *tasks) {
    for (size_t count = 0; count < 300; count += 13) {
        for (size_t size = 1; size < 100; size += 31) {
            atomic_size_t sum = 0;
            burnish_tasks_ranges(tasks, count, size, add_range, &sum);
            CHECK(atomic_load(&sum) == count * (count + 1) / 2, "%zu by %zu", count, size);
        }
    }
}

/* A task runner of the caller's: one call after another, the last first. */
static void run_backwards(void *user_data, int count, void (*task)(void *data, int index),
                          void *data) {
    ++*(int *)user_data;
    for (int i = count; i-- > 0;) {
        task(data, i);
    }
}

static int cancel_after(void *user_data) {
    int *left = user_data;
    return --*left < 0;
}

static void count_index(void *context, size_t index, int thread) {
    (void)index;
    (void)thread;
    atomic_fetch_add((atomic_int *)context, 1);
}

static void check_runner(void) {
    int runs = 0;
    burnish_error error;
    burnish_context *context;
    burnish_context_options options = burnish_context_options_default();
    options.tasks = (burnish_task_runner){3, run_backwards, &runs};
    CHECK(burnish_context_create(&options, &context, &error) == BURNISH_STATUS_OK, "a context");
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, context, 0);
    CHECK(burnish_tasks_threads(&tasks) == 3, "the runner's threads");
    check_run(&tasks, MOST, 7, 0);
    check_run(&tasks, MOST, 7, 2);
    CHECK(runs == 2, "the runner ran %d times", runs);
    burnish_context_destroy(context);
}

static void check_cancel(void) {
    int left = 10;
    burnish_error error;
    burnish_context *context;
    burnish_context_options options = burnish_context_options_default();
    options.cancelled = cancel_after;
    options.cancelled_user_data = &left;
    CHECK(burnish_context_create(&options, &context, &error) == BURNISH_STATUS_OK, "a context");
    burnish_tasks tasks;
    atomic_int ran = 0;
    burnish_tasks_begin(&tasks, context, 1);
    burnish_tasks_run(&tasks, MOST, 1, 0, count_index, &ran);
    CHECK(atomic_load(&ran) == 11, "%d pieces ran until cancelled", atomic_load(&ran));
    burnish_tasks_run(&tasks, MOST, 1, 0, count_index, &ran);
    CHECK(atomic_load(&ran) == 11, "nothing builds on what is incomplete");
    CHECK(burnish_tasks_check(&tasks, &error) == BURNISH_STATUS_CANCELLED, "cancelled");
    burnish_context_destroy(context);
}

/* Work from inside work and from several threads at a time runs all the same. */
static void run_nested(void *context, size_t index, int thread) {
    burnish_tasks tasks;
    (void)index;
    (void)thread;
    burnish_tasks_begin(&tasks, NULL, 4);
    burnish_tasks_run(&tasks, 100, 1, 0, count_index, context);
}

static void check_nested(void) {
    burnish_tasks tasks;
    atomic_int ran = 0;
    burnish_tasks_begin(&tasks, NULL, 4);
    burnish_tasks_run(&tasks, 50, 1, 0, run_nested, &ran);
    CHECK(atomic_load(&ran) == 5000, "%d nested pieces", atomic_load(&ran));
}

/* A child has none of its parent's threads and starts its own. */
static void check_fork(void) {
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
    return; /* it refuses threads in a child */
#endif
#endif
    const pid_t child = fork();
    if (child == 0) {
        burnish_tasks tasks;
        atomic_int ran = 0;
        burnish_tasks_begin(&tasks, NULL, 4);
        burnish_tasks_run(&tasks, MOST, 1, 0, count_index, &ran);
        _exit(atomic_load(&ran) == MOST ? 0 : 1);
    }
    int state = -1;
    CHECK(child > 0 && waitpid(child, &state, 0) == child && state == 0, "a child's work: %d",
          state);
}

static void check_signals(void *context, size_t index, int thread) {
    sigset_t mask;
    (void)index;
    pthread_sigmask(SIG_SETMASK, NULL, &mask);
    if (thread > 0 && !sigismember(&mask, SIGUSR1)) {
        atomic_fetch_add((atomic_int *)context, 1);
    }
    for (volatile int i = 0; i < 10000; ++i) {
    }
}

static void check_quota(void) {
    static const struct {
        const char *text;
        int processors;
    } CASES[] = {{"max 100000\n", 0},     {"200000 100000\n", 2}, {"150000 100000", 2},
                 {"50000 100000\n", 1},   {"-1 100000", 0},       {"", 0},
                 {"100000000 1000", 1024}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; ++i) {
        const int found = burnish_quota_processors(CASES[i].text);
        CHECK(found == CASES[i].processors, "quota \"%s\": %d", CASES[i].text, found);
    }
}

static void check_runs(int threads) {
    static const size_t COUNTS[] = {0, 1, 2, 3, 17, 100, MOST};
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, threads);
    CHECK(burnish_tasks_threads(&tasks) == threads, "%d threads", threads);
    for (int round = 0; round < 200; ++round) {
        check_run(&tasks, COUNTS[round % 7], (size_t)(1 + round % 9), round % 4);
    }
    check_ranges(&tasks);
}

static void check_alone(void) {
    CHECK(burnish_tasks_threads(NULL) == 1, "no tasks: the caller alone");
    CHECK(burnish_processor_count() >= 1, "a processor");
    check_run(NULL, MOST, 3, 0);
}

static void check_signal_masks(void) {
    burnish_tasks tasks;
    atomic_int open_to_signals = 0;
    burnish_tasks_begin(&tasks, NULL, THREADS);
    burnish_tasks_run(&tasks, MOST, 1, 0, check_signals, &open_to_signals);
    CHECK(atomic_load(&open_to_signals) == 0, "threads of the pool take no signals");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_alone());
    for (int threads = 1; threads <= THREADS; ++threads) {
        RUN(check_runs(threads));
    }
    RUN(check_signal_masks());
    RUN(check_runner());
    RUN(check_cancel());
    RUN(check_nested());
    RUN(check_fork());
    RUN(check_quota());
    return test_end("tasks");
}
