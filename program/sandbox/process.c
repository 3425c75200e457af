/* The two processes of a sandbox. */
#include "sandbox/process.h"

#include "base/cli/options.h"

#if BURNISH_HAS_SECCOMP

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/inputs.h"
#include "base/show_text.h"
#include "cli/limits.h"
#include "import/folder.h"
#include "sandbox/lock.h"
#include "sandbox/worker.h"

/* Descriptors of the worker, besides the standard streams. */
enum { WORKER_CHANNEL = 3, WORKER_INPUT = 4 };

/* Returns the exit code of a worker that has ended, and reports a worker that was killed. */
static int describe_end(broker_state reason, int state, burnish_error *ended) {
    burnish_error line;
    int code = sandbox_describe_end(state, &line), has_line = !WIFEXITED(state);
    if (reason == BROKER_VIOLATION && !cli_child_was_late()) {
        cli_fail(&line, BURNISH_STATUS_FORMAT,
                 "the sandbox ended the program: it requested what drawing does not need; report "
                 "the input");
        code = has_line = 1;
    }
    if (cli_child_was_late() == CLI_LATE_PROCESSOR) {
        code =
            burnish_status_exit_code(cli_fail_late(CLI_LATE_PROCESSOR, cli_seconds_given(), &line));
    }
    if (has_line && ended) {
        *ended = line;
    } else if (has_line) {
        fprintf(stderr, "burnish: %s\n", line.text);
    }
    return code;
}

static burnish_status open_input(const char *input, int *file, burnish_error *error) {
    *file = -1;
    if (*input == ':' || strcmp(input, "-") == 0) {
        return BURNISH_STATUS_OK;
    }
    *file = burnish_open_input(input, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    struct stat state;
    const burnish_shown_name shown = burnish_show_name(input);
    if (*file < 0) {
        return cli_fail(error, cli_errno_status(errno), "%s: can't be opened: %s", shown.text,
                        cli_open_reason(input, errno));
    }
    if (fstat(*file, &state) == 0 && S_ISDIR(state.st_mode)) {
        close(*file);
        return cli_fail(error, BURNISH_STATUS_READ, "%s: can't be read: Is a directory",
                        shown.text);
    }
    return BURNISH_STATUS_OK;
}

/* Serves the worker until it has ended. Returns the exit code. */
static int be_broker(const sandbox_plan *plan, pid_t worker, int channel, int input, int folder) {
    cli_limit_child(worker);
    const broker_state reason = broker_serve(plan, channel, input, folder);
    close(channel);
    kill(worker, SIGKILL); /* a compromised worker may still run; a sound one has already exited */
    const int state = cli_wait_child(worker);
    return describe_end(reason, state, plan->ended);
}

burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error) {
    static char path[BURNISH_INPUT_PATH]; /* in the worker, too */
    const char *below;
    int input, ends[2], folder;
    burnish_status status = open_input(plan->input, &input, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    status = folder_open(plan->input, plan->root, &folder, path, &below, error);
    if (status == BURNISH_STATUS_OK && !cli_channel(ends)) {
        status =
            cli_fail(error, BURNISH_STATUS_ARGUMENT, "--sandbox: no socket: %s", strerror(errno));
    } else if (status == BURNISH_STATUS_OK) {
        const pid_t worker =
            cli_fork(&(cli_plan){.kept = {CLI_SAME, CLI_SAME, CLI_SAME, ends[1], input},
                                 .count = input >= 0 ? WORKER_INPUT + 1 : WORKER_INPUT,
                                 .ended_by = SIGKILL});
        if (worker == 0) {
            cli_limit_worker(cli_seconds_given());
            sandbox_become_worker(WORKER_CHANNEL, input >= 0 ? WORKER_INPUT : -1, below);
            *code = -1;
            return BURNISH_STATUS_OK;
        }
        if (worker < 0) {
            status = cli_fail(error, BURNISH_STATUS_MEMORY, "--sandbox: no process: %s",
                              strerror(errno));
        }
        close(ends[1]);
        if (worker > 0) {
            *code = be_broker(plan, worker, ends[0], input, folder);
        } else {
            close(ends[0]);
        }
    }
    if (input >= 0) {
        close(input);
    }
    if (folder >= 0) {
        close(folder);
    }
    return status;
}

#else

burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error) {
    (void)plan;
    *code = -1;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--sandbox: this program was built without libseccomp; install libseccomp-dev "
                    "and build again, or use --no-sandbox");
}

#endif
