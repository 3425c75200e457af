#include "core/tasks.h"

#include "base/context.h"
#include "base/error.h"
#include "core/float_mode.h"
#include "core/pool.h"

/* A job: indices that threads take `grain` at a time. */
typedef struct job {
    burnish_tasks *tasks;
    burnish_task *task;
    void *context;
    size_t count, grain;
    atomic_size_t next; /* index */
} job;

static void work(void *data, int thread) {
    job *j = data;
    for (;;) {
        const size_t first = atomic_fetch_add_explicit(&j->next, j->grain, memory_order_relaxed);
        if (first >= j->count) {
            return;
        }
        const size_t end = j->count - first < j->grain ? j->count : first + j->grain;
        for (size_t i = first; i < end; ++i) {
            j->task(j->context, i, thread);
        }
        if (burnish_tasks_should_end(j->tasks, thread)) {
            return;
        }
    }
}

static void run_as_index(void *data, int index) {
    const burnish_float_mode before = burnish_float_mode_enter();
    work(data, index);
    burnish_float_mode_leave(before);
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

int burnish_tasks_should_end(burnish_tasks *tasks, int thread) {
    return thread == 0 ? burnish_tasks_cancelled(tasks)
                       : atomic_load_explicit(&tasks->cancelled, memory_order_relaxed);
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
    } else if (!burnish_pool_run(threads, work, &j)) {
        work(&j, 0);
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
