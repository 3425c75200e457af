#include "cli/limits.h"

#include "base/cli/options.h"

enum { WALL_TIMES = 10 }; /* wall-clock time per processor time: a busy machine, a slow input */

static double given;
static uint64_t given_memory;

double cli_seconds_given(void) {
    return given;
}

double cli_wall_seconds(double seconds) {
    return WALL_TIMES * seconds;
}

burnish_status cli_fail_late(cli_lateness lateness, double seconds, burnish_error *error) {
    return lateness == CLI_LATE_PROCESSOR
               ? cli_fail(error, BURNISH_STATUS_LIMIT,
                          "not done after %g seconds of processor time (--max-seconds): raise the "
                          "limit or simplify the mesh",
                          seconds)
               : cli_fail(error, BURNISH_STATUS_LIMIT,
                          "not done after %g seconds, %d times --max-seconds: raise the limit, or "
                          "try again when the machine is less busy",
                          WALL_TIMES * seconds, WALL_TIMES);
}

void cli_set_child_memory(uint64_t bytes) {
    given_memory = bytes;
}

uint64_t cli_child_memory(void) {
    return given_memory;
}

#ifdef _WIN32

burnish_status cli_limit_seconds(double seconds, burnish_error *error) {
    return seconds == 0 ? BURNISH_STATUS_OK
                        : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                   "--max-seconds: not supported on this system; omit it");
}

burnish_status cli_limit_memory(uint64_t bytes, burnish_error *error) {
    return bytes == 0 ? BURNISH_STATUS_OK
                      : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                 "--max-memory: not supported on this system; omit it");
}

#else

#include <errno.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_BEGUN = 0, ENDED = -1 };
static atomic_long child;  /* its process, or one of these */
static atomic_int late;    /* the child: a cli_lateness */
static char lines[2][600]; /* for wall and processor time, written before the timers start */

static void end(int number) {
    const char *line = lines[number == SIGPROF];
    const long process = atomic_load(&child);
    if (process == ENDED) { /* all is done */
        return;
    }
    if (process > 0) {
        kill((pid_t)process, SIGKILL);
    }
    burnish_file_remove_temporaries();
    const ssize_t written = write(STDERR_FILENO, line, strlen(line));
    (void)written;
    _exit(burnish_status_exit_code(BURNISH_STATUS_LIMIT));
}

/* A timer of the process (ITIMER_...) whose signal has this handler. 0 seconds stop it. */
static int set_timer(int which, double seconds, void (*handler)(int)) {
    const struct sigaction action = {.sa_handler = handler, .sa_flags = SA_RESTART};
    struct itimerval timer = {.it_value = {(time_t)seconds, 0}};
    timer.it_value.tv_usec = (suseconds_t)((seconds - (double)timer.it_value.tv_sec) * 1e6);
    timer.it_interval.tv_usec = 100000; /* a process can start after the first signal */
    return (seconds == 0 ||
            sigaction(which == ITIMER_PROF ? SIGPROF : SIGALRM, &action, NULL) == 0) &&
           setitimer(which, &timer, NULL) == 0;
}

burnish_status cli_limit_seconds(double seconds, burnish_error *error) {
    given = seconds;
    if (seconds == 0) {
        return BURNISH_STATUS_OK;
    }
    for (int i = 0; i < 2; ++i) {
        cli_fail_late(i == 0 ? CLI_LATE_WALL : CLI_LATE_PROCESSOR, seconds, error);
        snprintf(lines[i], sizeof lines[i], "burnish: %s\n", error->text);
    }
    return set_timer(ITIMER_REAL, WALL_TIMES * seconds, end) && set_timer(ITIMER_PROF, seconds, end)
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_ARGUMENT, "--max-seconds: %s", strerror(errno));
}

void cli_limit_worker(double seconds) {
    given = seconds;
    set_timer(ITIMER_PROF, seconds, SIG_DFL);
}

burnish_status cli_limit_memory(uint64_t bytes, burnish_error *error) {
    struct rlimit limit;
    if (bytes == 0) {
        return BURNISH_STATUS_OK;
    }
    if (getrlimit(RLIMIT_AS, &limit) == 0) {
        limit.rlim_cur = (rlim_t)bytes < limit.rlim_max ? (rlim_t)bytes : limit.rlim_max;
        if (setrlimit(RLIMIT_AS, &limit) == 0) {
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--max-memory: %s", strerror(errno));
}

void cli_lower_limit(int what, uint64_t most) {
    struct rlimit limits;
    if (getrlimit(what, &limits) == 0) {
        const rlim_t highest = most < (uint64_t)RLIM_INFINITY ? (rlim_t)most : RLIM_INFINITY;
        limits.rlim_max = highest < limits.rlim_max ? highest : limits.rlim_max;
        limits.rlim_cur = limits.rlim_max < limits.rlim_cur ? limits.rlim_max : limits.rlim_cur;
        setrlimit(what, &limits);
    }
}

void cli_limit_child(long process) {
    atomic_store(&child, process);
}

/* Until it is reaped, the system does not reuse its number. */
int cli_wait_child(long process) {
    siginfo_t info;
    int state = 0;
    while (waitid(P_PID, (id_t)process, &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
    }
    atomic_store(&child, ENDED);
    while (waitpid((pid_t)process, &state, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(state) && WTERMSIG(state) == SIGPROF) {
        atomic_store(&late, CLI_LATE_PROCESSOR);
    } else if (!WIFSIGNALED(state) ||
               WTERMSIG(state) != SIGKILL) { /* it ended before the timer's signal */
        atomic_store(&late, CLI_NOT_LATE);
    }
    return state;
}

static void end_child(int number) {
    const long process = atomic_load(&child);
    (void)number;
    if (process != ENDED) {
        atomic_store(&late, CLI_LATE_WALL);
    }
    if (process > 0) {
        kill((pid_t)process, SIGKILL);
    }
}

void cli_limit_child_seconds(double seconds) {
    given = seconds;
    if (seconds > 0) {
        atomic_store(&late, CLI_NOT_LATE);
        atomic_store(&child, NOT_BEGUN);
    }
    set_timer(ITIMER_REAL, WALL_TIMES * seconds, end_child);
}

cli_lateness cli_child_was_late(void) {
    return (cli_lateness)atomic_load(&late);
}

#endif
