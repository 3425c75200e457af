/* Hands items to runners, which are forked from this process, and collects their report lines. */
#include <stdlib.h>
#include <string.h>

#include "batch/batch.h"
#include "batch/types.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/cli/run.h"
#include "base/clock.h"
#include "sandbox/channel.h"

enum { RUNNER_CHANNEL = 3 }; /* the descriptor of a runner */
enum { NOTHING = -1, LINE_MAX_BYTES = 1 << 24 };

typedef struct worker {
    pid_t process; /* 0: none */
    int channel;   /* NOTHING: closed */
    long item;     /* being drawn; or NOTHING */
    double start;
} worker;

typedef struct pool {
    batch *b;
    worker *workers;
    size_t count, next; /* next: index into order */
    uint32_t *order;
    FILE *report; /* receives each line as it arrives; NULL: none */
    double start, shown;
    int is_terminal;
} pool;

static volatile sig_atomic_t stopped; /* the number of a signal that ends the program */

static void note_signal(int number) {
    stopped = number;
}

static const int ending[] = {SIGHUP, SIGINT, SIGTERM};

/* ---- Runners ---- */

/* Runs in the forked process. */
static void become_runner(const pool *p) {
    for (size_t i = 0; i < sizeof ending / sizeof *ending; ++i) {
        struct sigaction before;
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler == note_signal) {
            signal(ending[i], SIG_DFL);
        }
    }
    cli_handle_signals();
    batch_runner(p->b, RUNNER_CHANNEL);
    _exit(0);
}

static int start_runner(pool *p, worker *w) {
    int ends[2];
    if (!cli_channel(ends)) {
        return 0;
    }
    w->process = cli_fork(&(cli_plan){.kept = {CLI_NOTHING, CLI_NOTHING, CLI_NOTHING, ends[1]},
                                      .count = RUNNER_CHANNEL + 1,
                                      .ended_by = SIGTERM});
    w->item = NOTHING;
    if (w->process == 0) {
        become_runner(p);
    }
    close(ends[1]);
    w->channel = ends[0];
    if (w->process < 0) {
        close(ends[0]);
        w->channel = NOTHING;
        w->process = 0;
    }
    return w->process > 0;
}

/* Ends a runner and returns its wait status. */
static int end_runner(worker *w, int number) {
    int state = 0;
    if (w->channel != NOTHING) {
        close(w->channel);
    }
    if (w->process > 0) {
        if (number) {
            kill(w->process, number);
        }
        state = cli_wait(w->process);
    }
    w->process = 0;
    w->channel = NOTHING;
    w->item = NOTHING;
    return state;
}

/* ---- Items ---- */

/* Stores the item's line and takes ownership of it. */
static void keep_line(pool *p, uint32_t index, char *line, const batch_reply *reply) {
    batch_item *item = &p->b->list.items[index];
    if (reply->failed == BATCH_LATE) {
        unlink(item->output);
    }
    item->line = line;
    item->is_kept = reply->is_kept;
    item->has_failed = reply->failed != 0 || !line;
    p->b->done += 1;
    p->b->kept += item->is_kept != 0;
    p->b->failed += item->has_failed != 0;
    p->b->unmet &= item->is_kept || item->has_failed ? ~0U : reply->unmet;
    if (p->report && line) {
        fprintf(p->report, "%s\n", line);
        fflush(p->report);
    }
}

/* Gives a runner the next item and starts the runner if there is none. */
static void hand_out(pool *p, worker *w) {
    if (stopped || p->next == p->b->list.count) {
        return;
    }
    const uint32_t index = p->order[p->next];
    w->start = burnish_seconds_now();
    if ((w->channel != NOTHING || start_runner(p, w)) &&
        cli_write_all(w->channel, &index, sizeof index)) {
        w->item = index;
        p->next += 1;
        return;
    }
    end_runner(w, 0);
}

/* Handles the death of a runner. */
static void lose_runner(pool *p, worker *w) {
    const long index = w->item;
    const double seconds = burnish_seconds_now() - w->start;
    const int state = end_runner(w, 0);
    if (index == NOTHING || stopped) {
        return;
    }
    char text[120];
    snprintf(text, sizeof text, "the process that drew it was ended by signal %d",
             WIFSIGNALED(state) ? WTERMSIG(state) : 0);
    keep_line(p, (uint32_t)index,
              batch_failed_line(p->b, &p->b->list.items[index], 1, text, seconds),
              &(batch_reply){.failed = BATCH_FAILED});
}

static void receive_reply(pool *p, worker *w) {
    batch_reply reply;
    char *line = NULL;
    int is_whole = channel_read(w->channel, &reply, sizeof reply) && w->item != NOTHING &&
                   reply.index == (uint32_t)w->item && reply.size <= LINE_MAX_BYTES;
    if (is_whole && reply.size > 0) {
        line = malloc((size_t)reply.size + 1);
        is_whole = line && channel_read(w->channel, line, reply.size);
    }
    if (!is_whole || !line) {
        free(line);
        lose_runner(p, w);
        return;
    }
    line[reply.size] = 0;
    w->item = NOTHING;
    keep_line(p, reply.index, line, &reply);
}

/* ---- Progress ---- */

static void show_progress(pool *p) {
    const double now = burnish_seconds_now(), passed = now - p->start;
    const size_t drawn = p->b->done - p->b->kept;
    if (!p->is_terminal || now - p->shown < 0.2 || p->b->done == 0) {
        return;
    }
    p->shown = now;
    const double left = passed / (double)p->b->done * (double)(p->b->list.count - p->b->done) + 0.5;
    char failed[40] = "";
    if (p->b->failed > 0) {
        snprintf(failed, sizeof failed, ", %zu failed", p->b->failed);
    }
    fprintf(stderr, "\rburnish: %zu of %zu, %.0f per second, %lu:%02lu left%s\033[K", p->b->done,
            p->b->list.count, (double)drawn / passed, (unsigned long)left / 60,
            (unsigned long)left % 60, failed);
}

/* ---- All ---- */

static burnish_status fail_runner(burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_MEMORY, "batch: no process to draw in: %s",
                    strerror(errno));
}

/* Hands items to idle runners. Returns the number of busy runners. */
static size_t lend_items(pool *p, struct pollfd *ready) {
    size_t active = 0;
    for (size_t i = 0; i < p->count; ++i) {
        worker *w = &p->workers[i];
        if (w->item == NOTHING) {
            hand_out(p, w);
        }
        active += w->item != NOTHING;
        ready[i] = (struct pollfd){w->item != NOTHING ? w->channel : NOTHING, POLLIN, 0};
    }
    return active;
}

static burnish_status pool_work(pool *p, struct pollfd *ready, burnish_error *error) {
    while (p->b->done < p->b->list.count && !stopped) {
        if (lend_items(p, ready) == 0 && !stopped) {
            return fail_runner(error);
        }
        const int count = poll(ready, (nfds_t)p->count, 500);
        for (size_t i = 0; i < p->count && count > 0; ++i) {
            if (ready[i].fd >= 0 && ready[i].revents) {
                receive_reply(p, &p->workers[i]);
            }
        }
        show_progress(p);
    }
    return BURNISH_STATUS_OK;
}

/* Starts a report that survives a crash: lines of earlier runs first, then each new line on arrival. */
static burnish_status open_report(pool *p, burnish_error *error) {
    const batch *b = p->b;
    if (!b->report || b->settings->is_render || strcmp(b->report, "-") == 0) {
        return BURNISH_STATUS_OK;
    }
    char *head = batch_head_line(b);
    p->report = head ? fopen(b->report, "wb") : NULL;
    if (p->report) {
        fcntl(fileno(p->report), F_SETFD, FD_CLOEXEC);
        fprintf(p->report, "%s\n", head);
        for (size_t i = 0; i < b->list.count; ++i) {
            const struct batch_past_line *past = batch_past_line(&b->past, b->list.items[i].id);
            if (past && past->is_same) {
                fprintf(p->report, "%s\n", past->line);
            }
        }
        fflush(p->report);
    }
    free(head);
    return p->report ? BURNISH_STATUS_OK
                     : cli_fail(error, BURNISH_STATUS_WRITE, "--report: %.300s: %s", b->report,
                                strerror(errno));
}

static void catch_signals(void) {
    for (size_t i = 0; i < sizeof ending / sizeof *ending; ++i) {
        struct sigaction before, action = {.sa_handler = note_signal};
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
            sigaction(ending[i], &action, NULL);
        }
    }
}

/* The number of pictures drawn at a time. */
static size_t count_jobs(const batch *b) {
    const size_t jobs =
        b->settings->jobs > 0 ? (size_t)b->settings->jobs : (size_t)burnish_processor_count();
    return jobs < b->list.count ? jobs : b->list.count;
}

static burnish_status pool_begin(pool *p, burnish_error *error) {
    const size_t jobs = count_jobs(p->b);
    p->workers = calloc(jobs + 1, sizeof *p->workers);
    p->order = batch_order_by_cost(&p->b->list);
    if (!p->workers || !p->order) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    }
    p->count = jobs;
    for (size_t i = 0; i < p->count; ++i) {
        p->workers[i].item = NOTHING;
        p->workers[i].channel = NOTHING;
    }
    catch_signals();
    return open_report(p, error);
}

burnish_status batch_run(batch *b, burnish_error *error) {
    pool p = {.b = b, .start = burnish_seconds_now()};
    p.is_terminal = !b->settings->render.job.quiet && isatty(STDERR_FILENO);
    burnish_status status = pool_begin(&p, error);
    struct pollfd *ready = calloc(p.count + 1, sizeof *ready);
    if (status == BURNISH_STATUS_OK) {
        status = ready ? pool_work(&p, ready, error)
                       : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    }
    if (p.is_terminal) {
        fprintf(stderr, "\r\033[K");
    }
    for (size_t i = 0; i < p.count; ++i) {
        end_runner(&p.workers[i], stopped || p.workers[i].item != NOTHING ? SIGTERM : 0);
    }
    if (p.report) {
        fclose(p.report);
    }
    b->is_stopped = stopped;
    free(ready);
    free(p.workers);
    free(p.order);
    return status;
}

#endif
