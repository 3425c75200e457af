/* Time limits of a child process: a timer that expires after its end neither kills anything nor
 * makes it late. The test sends the signal at the worst moment instead of waiting for it. */
#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/limits.h"
#include "support.h"

enum { LONG = 1000, CODE = 3, REAPED = 7 }; /* seconds of processor time; exit codes */

static int signals_after_reaping; /* 1: the timer expires when waitpid has returned */
static pid_t reaped;              /* the last result of waitpid */
static int kills_of_reaped;

pid_t __real_waitpid(pid_t process, int *state, int options);
pid_t __wrap_waitpid(pid_t process, int *state, int options);
int __real_kill(pid_t process, int number);
int __wrap_kill(pid_t process, int number);

pid_t __wrap_waitpid(pid_t process, int *state, int options) {
    const pid_t ended = __real_waitpid(process, state, options);
    if (ended > 0) {
        reaped = ended;
        if (signals_after_reaping) {
            raise(SIGALRM);
        }
    }
    return ended;
}

/* Only counts if the process is gone: the system can reuse its number. */
int __wrap_kill(pid_t process, int number) {
    if (process == reaped) {
        ++kills_of_reaped;
        return 0;
    }
    return __real_kill(process, number);
}

/* A process that exits, or waits to be ended. */
static pid_t start(int ends) {
    reaped = 0;
    kills_of_reaped = 0;
    fflush(NULL);
    const pid_t process = fork();
    while (process == 0) {
        if (ends) {
            _exit(CODE);
        }
        pause();
    }
    CHECK1(process > 0);
    cli_limit_child(process);
    return process;
}

/* It has ended and was not reaped. */
static void wait_until_ended(pid_t process) {
    siginfo_t info;
    CHECK1(waitid(P_PID, (id_t)process, &info, WEXITED | WNOWAIT) == 0);
}

static void test_done(void) {
    signals_after_reaping = 1;
    cli_limit_child_seconds(LONG);
    const int state = cli_wait_child(start(1));
    CHECK(WIFEXITED(state) && WEXITSTATUS(state) == CODE, "state %x", (unsigned)state);
    CHECK(kills_of_reaped == 0, "%d signals to a number that may be another process's",
          kills_of_reaped);
    raise(SIGALRM);
    CHECK1(!cli_child_was_late());
    CHECK1(kills_of_reaped == 0);
    signals_after_reaping = 0;
    cli_limit_child_seconds(0);
}

/* The timer expires when the process has ended, but before waiting for it. */
static void test_just_done(void) {
    cli_limit_child_seconds(LONG);
    const pid_t process = start(1);
    wait_until_ended(process);
    raise(SIGALRM);
    const int state = cli_wait_child(process);
    CHECK(WIFEXITED(state) && WEXITSTATUS(state) == CODE, "state %x", (unsigned)state);
    CHECK1(!cli_child_was_late());
    cli_limit_child_seconds(0);
}

/* A worker that computes for ever ends by its own timer; one that waits has ten times as long. */
static void test_processor(void) {
    struct itimerval wall;
    cli_limit_child_seconds(LONG);
    CHECK1(getitimer(ITIMER_REAL, &wall) == 0 && wall.it_value.tv_sec > 9 * LONG);
    fflush(NULL);
    const pid_t process = fork();
    if (process == 0) {
        cli_limit_worker(0.01);
        for (volatile unsigned n = 0;; ++n) {
        }
    }
    cli_limit_child(process);
    const int state = cli_wait_child(process);
    CHECK(WIFSIGNALED(state) && WTERMSIG(state) == SIGPROF, "state %x", (unsigned)state);
    CHECK1(cli_child_was_late() == CLI_LATE_PROCESSOR);
    cli_limit_child_seconds(0);
}

static void test_late(void) {
    for (int before = 0; before < 2; ++before) {
        cli_limit_child_seconds(LONG);
        if (before) { /* the time before the process counts too */
            raise(SIGALRM);
            CHECK1(cli_child_was_late());
        }
        const pid_t process = start(0);
        raise(SIGALRM);
        const int state = cli_wait_child(process);
        CHECK(WIFSIGNALED(state) && WTERMSIG(state) == SIGKILL, "state %x", (unsigned)state);
        CHECK1(cli_child_was_late());
        cli_limit_child_seconds(0);
    }
}

/* The timer that ends the whole program, before and after the worker process has ended. Runs in a
 * separate process and returns its exit code. */
static int program_ends_with(int is_done) {
    int state = -1;
    fflush(NULL);
    const pid_t program = fork();
    if (program == 0) {
        burnish_error error;
        signals_after_reaping = is_done;
        if (!freopen("/dev/null", "w", stderr) ||
            cli_limit_seconds(LONG, &error) != BURNISH_STATUS_OK) {
            _exit(1);
        }
        const pid_t process = start(is_done);
        if (!is_done) {
            raise(SIGALRM);
        }
        cli_wait_child(process);
        raise(SIGALRM);
        _exit(kills_of_reaped == 0 ? REAPED : 1);
    }
    __real_waitpid(program, &state, 0);
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_done());
    RUN(test_just_done());
    RUN(test_late());
    RUN(test_processor());
    RUN(CHECK1(program_ends_with(0) == burnish_status_exit_code(BURNISH_STATUS_LIMIT)));
    RUN(CHECK1(program_ends_with(1) == REAPED));
    return test_end("limits");
}
