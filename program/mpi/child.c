#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { CHANNEL = 3 /* the child's first socket */ };

double seconds_now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int report_failure(const char *what) {
    fprintf(stderr, "burnish-mpi: %s: %s\n", what, strerror(errno));
    return 0;
}

static volatile sig_atomic_t child_to_stop; /* receives the signals that end rank 0 */

static void pass_on(int number) {
    if (child_to_stop > 0) {
        kill((pid_t)child_to_stop, number);
    }
}

/* Finds burnish: by BURNISH, in this program's folder, or in PATH. */
static void find_program(char *path, size_t size) {
    const char *named = getenv("BURNISH");
    const ssize_t length = readlink("/proc/self/exe", path, size - 16);
    if (named && *named) {
        snprintf(path, size, "%s", named);
        return;
    }
    path[length > 0 ? length : 0] = 0;
    char *slash = strrchr(path, '/');
    if (slash) {
        memcpy(slash, "/burnish", 9);
    }
    if (!slash || access(path, X_OK) != 0) {
        snprintf(path, size, "burnish");
    }
}

/* Moves the sockets to descriptors from CHANNEL on, after moving them out of the way. */
static void place_sockets(int *sockets, int count) {
    for (int i = 0; i < count; ++i) {
        const int high = fcntl(sockets[i], F_DUPFD, CHANNEL + count);
        if (high < 0) {
            _exit(126);
        }
        close(sockets[i]);
        sockets[i] = high;
    }
    for (int i = 0; i < count; ++i) {
        dup2(sockets[i], CHANNEL + i);
        close(sockets[i]);
    }
}

/* Runs in the forked process. Runners first wait for work, so a wrong command line is reported only
 * once. */
static void become_burnish(const child_command *command, int *sockets, pid_t parent) {
    const int rank = command->rank, count = command->count, argc = command->argc;
    char **argv = command->argv, path[4096], runners[32];
    char **all = calloc((size_t)argc + 3, sizeof *all);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (!all || getppid() != parent) {
        _exit(126);
    }
    if (rank > 0) {
        struct pollfd ready = {sockets[0], POLLIN, 0};
        const int nothing = open("/dev/null", O_RDWR);
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        while (poll(&ready, 1, -1) < 0 && errno == EINTR) {
        }
    }
    place_sockets(sockets, count);
    snprintf(runners, sizeof runners, "--runners=%d", count);
    int at = 0;
    find_program(path, sizeof path);
    all[at++] = path;
    all[at++] = argv[0];
    if (count > 0) {
        all[at++] = rank > 0 ? (char *)"--runner" : runners;
    }
    memcpy(all + at, argv + 1, sizeof *all * (size_t)(argc - 1));
    execvp(path, all);
    fprintf(stderr, "burnish-mpi: %s: %s; set BURNISH to its path\n", path, strerror(errno));
    _exit(126);
}

int child_start(child *c, const child_command *command, int *sockets) {
    const int count = command->count;
    int *theirs = calloc((size_t)count + 1, sizeof *theirs);
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < 4U * (unsigned)count + 64) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
    }
    for (int i = 0; theirs && i < count; ++i) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
            return report_failure("no socket for each rank");
        }
        fcntl(ends[0], F_SETFD, FD_CLOEXEC);
        fcntl(ends[0], F_SETFL, O_NONBLOCK);
        sockets[i] = ends[0];
        theirs[i] = ends[1];
    }
    const pid_t self = getpid();
    c->id = theirs ? fork() : -1;
    if (c->id == 0) {
        become_burnish(command, theirs, self);
    }
    for (int i = 0; theirs && i < count; ++i) {
        close(theirs[i]);
    }
    free(theirs);
    return c->id > 0 ? 1 : report_failure("no process for burnish");
}

void child_take_signals(const child *c) {
    child_to_stop = (sig_atomic_t)c->id;
    signal(SIGINT, pass_on);
    signal(SIGTERM, pass_on);
}

int child_is_gone(child *c) {
    if (c->id > 0 && waitpid(c->id, &c->state, WNOHANG) == c->id) {
        c->id = 0;
        child_to_stop = 0;
    }
    return c->id == 0;
}

void child_end(child *c) {
    const double start = seconds_now();
    if (c->id > 0) {
        kill(c->id, SIGTERM);
    }
    while (!child_is_gone(c)) {
        if (seconds_now() - start > 1) {
            kill(c->id, SIGKILL);
        }
        usleep(10000);
    }
}

int child_exit_code(const child *c) {
    return WIFEXITED(c->state) ? WEXITSTATUS(c->state) : 128 + WTERMSIG(c->state);
}
