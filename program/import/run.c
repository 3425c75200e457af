/* Runs an importer. */
#include "import/run.h"

#include "base/cli/options.h"
#include "cli/input.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/clock.h"
#include "cli/limits.h"
#include "import/importers.h"

enum {
    SECONDS = 300, /* of processor time, without --max-seconds */
    PIECE = 1 << 14,
    HEAD = 512,            /* bytes to inspect before an importer is started */
    MOST_FIXED = 64 << 20, /* limit of a stream: MOST_FIXED plus MOST_FACTOR per input byte */
    MOST_FACTOR = 256,
    MEMORY_FACTOR = 64
};
#define MEMORY_FIXED ((uint64_t)4 << 30)

/* A run of an importer. */
typedef struct run {
    const import_program *importer;
    const char *name, *extension;
    burnish_error *error;
    char path[4096];
    pid_t process;
    int pipe;            /* from it */
    double seconds, end; /* limits: processor time, clock */
    uint64_t most;       /* bytes that it may write */
} run;

static burnish_status importer_fail(const run *r, burnish_status status, const char *what) {
    const size_t size = strlen(r->name);
    return cli_fail(r->error, status, "%.200s: %s %s", size > 200 ? r->name + size - 200 : r->name,
                    r->importer->name, what);
}

/* ---- Where it is ---- */

static int is_there(run *r, const char *folder, const char *below) {
    const int size = snprintf(r->path, sizeof r->path, "%s%s/%s", folder, below, r->importer->name);
    return size > 0 && (size_t)size < sizeof r->path && access(r->path, X_OK) == 0;
}

/* Searches only BURNISH_IMPORTERS if that is set; else the installed folder and the program's own,
 * as in a build. */
static burnish_status find_program(run *r) {
    const char *given = getenv("BURNISH_IMPORTERS");
    char folder[4000];
    char message[300];
    if (given && *given) {
        if (is_there(r, given, "")) {
            return BURNISH_STATUS_OK;
        }
    } else if (cli_program_folder(folder, sizeof folder) &&
               (is_there(r, folder, "/" BURNISH_IMPORTERS_FOLDER) || is_there(r, folder, ""))) {
        return BURNISH_STATUS_OK;
    }
    snprintf(message, sizeof message,
             "reads such files and is not installed; install %s, name its folder in "
             "BURNISH_IMPORTERS, or %s",
             r->importer->from, r->importer->otherwise);
    return importer_fail(r, BURNISH_STATUS_FORMAT, message);
}

burnish_status import_check_installed(const import_program *importer, const char *name,
                                      burnish_error *error) {
    run r = {.importer = importer, .name = name, .error = error};
    return find_program(&r);
}

int import_is_installed(const import_program *importer) {
    burnish_error error;
    return import_check_installed(importer, "", &error) == BURNISH_STATUS_OK;
}

/* ---- The process ---- */

static burnish_status importer_start(run *r, int input, uint64_t memory) {
    const char *const arguments[] = {
        r->importer->name, r->importer->argument ? r->importer->argument : r->extension, NULL};
    int ends[2];
    if (pipe(ends) != 0) {
        return importer_fail(r, cli_errno_status(errno), strerror(errno));
    }
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    lseek(input, 0, SEEK_SET);
    r->process = cli_fork(
        &(cli_plan){.kept = {input, ends[1], CLI_NOTHING}, .count = 3, .ended_by = SIGKILL});
    if (r->process == 0) {
        setpgid(0, 0);
        cli_lower_limit(RLIMIT_AS, memory);
        cli_lower_limit(RLIMIT_CORE, 0);
        /* SIGXCPU at the first limit, SIGKILL, which looks like a lack of memory, at the second; if
         * it fails, there is a lower one already */
        const rlim_t seconds = (rlim_t)ceil(r->seconds);
        setrlimit(RLIMIT_CPU, &(struct rlimit){seconds, seconds + 1});
        cli_execute(r->path, arguments);
    }
    const int code = errno;
    close(ends[1]);
    r->pipe = ends[0];
    if (r->process < 0) {
        close(r->pipe);
        return importer_fail(r, BURNISH_STATUS_MEMORY, strerror(code));
    }
    return BURNISH_STATUS_OK;
}

/* ---- Its output ---- */

/* Also true after the deadline of the process that waits for the mesh, as in a batch. */
static int is_late(const run *r) {
    return cli_child_was_late() || burnish_seconds_now() > r->end;
}

static burnish_status fail_time(const run *r) {
    return importer_fail(r, BURNISH_STATUS_LIMIT,
                         "takes too long; raise --max-seconds or simplify the file");
}

/* The next piece of the stream: its size, 0 at the end, -1 after an error. */
static ssize_t read_piece(const run *r, unsigned char *piece, burnish_status *status) {
    for (;;) {
        const double left = is_late(r) ? 0 : r->end - burnish_seconds_now();
        struct pollfd ready = {r->pipe, POLLIN, 0};
        const int count = left > 0 ? poll(&ready, 1, (int)(fmin(left, 1e6) * 1000) + 1) : 0;
        if (count == 0) {
            *status = fail_time(r);
            return -1;
        }
        const ssize_t size = count > 0 ? read(r->pipe, piece, PIECE) : -1;
        if (size >= 0) {
            return size;
        }
        if (errno != EINTR) {
            *status = importer_fail(r, cli_errno_status(errno), strerror(errno));
            return -1;
        }
    }
}

static burnish_status read_stream(const run *r, import_sink sink) {
    unsigned char piece[PIECE]; /* several threads may load files */
    burnish_status status = BURNISH_STATUS_OK;
    uint64_t total = 0;
    ssize_t size;
    while ((size = read_piece(r, piece, &status)) > 0) {
        total += (uint64_t)size;
        if (total > r->most) {
            return importer_fail(
                r, BURNISH_STATUS_LIMIT,
                "makes a mesh of far more bytes than the file has; simplify the file");
        }
        if (!sink.take(sink.context, piece, (size_t)size)) {
            return importer_fail(r, BURNISH_STATUS_MEMORY,
                                 "makes a mesh for which there is no memory");
        }
    }
    return status;
}

/* Waits for the end of the importer within its time limit and checks its status. */
static burnish_status importer_end(const run *r, burnish_status status) {
    const struct timespec nap = {0, 500000};
    char what[160];
    int state = 0;
    pid_t ended = 0;
    while (status == BURNISH_STATUS_OK && (ended = waitpid(r->process, &state, WNOHANG)) == 0) {
        if (is_late(r)) {
            status = fail_time(r);
        }
        nanosleep(&nap, NULL);
    }
    if (ended == 0) {
        kill(-r->process, SIGKILL);
        kill(r->process, SIGKILL); /* in case it has no process group yet */
        state = cli_wait(r->process);
    }
    if (status != BURNISH_STATUS_OK || (WIFEXITED(state) && WEXITSTATUS(state) == 0)) {
        return status;
    }
    if (WIFEXITED(state)) {
        snprintf(what, sizeof what, "ended with exit code %d and no mesh%s", WEXITSTATUS(state),
                 WEXITSTATUS(state) == 127 ? ": a library is missing" : "");
        return importer_fail(r, BURNISH_STATUS_FORMAT, what);
    }
    const int number = WTERMSIG(state);
    if (number == SIGXCPU) {
        return fail_time(r);
    }
    if (number == SIGKILL) {
        return importer_fail(r, BURNISH_STATUS_MEMORY, "was ended by the system: out of memory");
    }
    snprintf(what, sizeof what,
             number == SIGSYS ? "made a system call that importing does not need, and was ended"
                              : "crashed by signal %d (%s); repair the file, or convert it",
             number, strsignal(number));
    return importer_fail(r, BURNISH_STATUS_FORMAT, what);
}

/* Rejects a file whose first bytes show that it is not a mesh. */
static burnish_status check_head(const run *r, int input) {
    unsigned char head[HEAD];
    const ssize_t size = pread(input, head, sizeof head, 0);
    const char *other = size < 0 ? NULL : import_describe_other(head, (size_t)size);
    return other ? cli_fail(r->error, BURNISH_STATUS_FORMAT, "%.300s: %s", r->name, other)
                 : BURNISH_STATUS_OK;
}

burnish_status import_run(const import_program *importer, const char *name, const char *extension,
                          int input, uint64_t max_bytes, import_sink sink, burnish_error *error) {
    struct stat state;
    const double seconds = cli_seconds_given() > 0 ? cli_seconds_given() : SECONDS;
    run r = {.importer = importer,
             .name = name,
             .extension = extension,
             .error = error,
             .seconds = seconds,
             .end = burnish_seconds_now() + cli_wall_seconds(seconds)};
    burnish_status status = check_head(&r, input);
    if (status == BURNISH_STATUS_OK) {
        status = find_program(&r);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const uint64_t size =
        fstat(input, &state) == 0 && state.st_size > 0 ? (uint64_t)state.st_size : (uint64_t)0;
    if (size > max_bytes) {
        return cli_fail(
            error, BURNISH_STATUS_LIMIT,
            "%.300s: larger than the limit of %llu bytes; raise the limit or simplify the mesh",
            name, (unsigned long long)max_bytes);
    }
    const uint64_t counted = size < UINT64_MAX / 1024 ? size : UINT64_MAX / 1024;
    r.most = MOST_FIXED + counted * MOST_FACTOR;
    const uint64_t own = MEMORY_FIXED + counted * MEMORY_FACTOR, allowed = cli_child_memory();
    status = importer_start(&r, input, allowed > 0 && allowed < own ? allowed : own);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    status = read_stream(&r, sink);
    status = importer_end(&r, status);
    close(r.pipe);
    return status;
}

#else

int import_is_installed(const import_program *importer) {
    (void)importer;
    return 0;
}

#endif
