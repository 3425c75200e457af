/* The side of a sandbox that opens files. It believes nothing that the worker says. */
#include "sandbox/sandbox.h"

#include "cli/options.h"

#if BURNISH_HAS_SECCOMP

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/limits.h"
#include "cli/write.h"
#include "import/folder.h"
#include "import/import.h"
#include "sandbox/channel.h"
#include "sandbox/worker.h"

#define DECODE_MAX ((uint64_t)4 << 30) /* bytes that a worker may have decoded */

typedef struct broker {
    const sandbox_plan *plan;
    int channel;
    int input;  /* open; -1: none */
    int folder; /* the input's; -1: it has none */
    int depth;  /* outputs that are being written: one, or the report of one */
    int broken; /* 1: the worker does not keep to the protocol, or is gone */
} broker;

static burnish_status serve(broker *b, burnish_error *error);

/* ---- Outputs ---- */

/* An output that is being written. */
typedef struct output {
    broker *b;
    int has_ended; /* 1: the worker has sent all of it */
} output;

/* Bytes of the output; 0 at their end, and when something is wrong. */
static size_t take_data(void *context, char *buffer, size_t size) {
    output *o = context;
    broker *b = o->b;
    message head;
    if (b->broken || o->has_ended) {
        return 0;
    }
    if (!channel_receive(b->channel, &head)) {
        b->broken = 1;
        return 0;
    }
    if (head.kind == MESSAGE_END) {
        o->has_ended = 1;
        return 0;
    }
    b->broken = head.kind != MESSAGE_DATA || head.size == 0 || head.size > size ||
                !channel_read(b->channel, buffer, (size_t)head.size);
    return b->broken ? 0 : (size_t)head.size;
}

/* The last step is the worker's: a report, which may be an output of its own. */
static burnish_status let_finish(void *context, burnish_error *error) {
    broker *b = ((const output *)context)->b;
    b->broken = b->broken || !channel_send(b->channel, MESSAGE_READY, 0, NULL, 0);
    return serve(b, error);
}

static int is_planned(const sandbox_plan *plan, const char *path) {
    for (size_t i = 0; i < plan->output_count; ++i) {
        if (strcmp(plan->outputs[i], path) == 0) {
            return 1;
        }
    }
    return 0;
}

static void tell(broker *b, burnish_status status, const burnish_error *error) {
    const char *text = status == BURNISH_STATUS_OK ? "" : error->text;
    b->broken =
        b->broken || !channel_send(b->channel, MESSAGE_DONE, (uint64_t)status, text, strlen(text));
}

static void write_output(broker *b, const char *path) {
    static char unread[MESSAGE_DATA_MAX];
    burnish_error error = {BURNISH_STATUS_OK, ""};
    output o = {b, 0};
    if (!is_planned(b->plan, path) || b->depth == 2) {
        b->broken = 1;
        return;
    }
    b->depth += 1;
    burnish_status status = burnish_file_write_stream_then(path, take_data, &o, let_finish, &error);
    b->depth -= 1;
    while (take_data(&o, unread, sizeof unread) > 0) { /* of an output that can't be written */
    }
    tell(b, status, &error);
}

/* ---- Files beside the input ---- */

static void send_file(broker *b, const char *name, uint64_t max_bytes) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    void *bytes = NULL;
    size_t size = 0;
    const burnish_status status = folder_load(b->folder, name, max_bytes, &bytes, &size, &error);
    if (b->plan->see_file) {
        b->plan->see_file(b->plan->context, name, status == BURNISH_STATUS_OK ? bytes : NULL, size);
    }
    if (status != BURNISH_STATUS_OK) {
        tell(b, status, &error);
    } else {
        b->broken = !channel_send(b->channel, MESSAGE_BYTES, 0, bytes, size);
    }
    free(bytes);
}

/* ---- Importers ---- */

static int send_piece(void *context, const void *bytes, size_t size) {
    broker *b = context;
    b->broken = b->broken || !channel_send(b->channel, MESSAGE_BYTES, 0, bytes, size);
    return !b->broken;
}

static void import(broker *b, uint64_t max_bytes) {
    char ending[IMPORT_ENDING_SIZE];
    const import_program *importer = import_choose(b->plan->input, b->plan->format, ending);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    if (!importer) {
        b->broken = 1;
        return;
    }
    tell(b,
         import_run_over(importer, ending, b->plan->input, b->input, max_bytes, send_piece, b,
                         &error),
         &error);
}

/* What the worker wants decoded goes into a file of memory. */
static void decode(broker *b, uint64_t size) {
    static char piece[MESSAGE_DATA_MAX];
    burnish_error error = {BURNISH_STATUS_OK, ""};
    const int file = import_unnamed_file();
    int is_kept = file >= 0 && size <= DECODE_MAX;
    message head;
    while (size > 0 && !b->broken) {
        b->broken = !channel_receive(b->channel, &head) || head.kind != MESSAGE_DATA ||
                    head.size > sizeof piece || head.size > size || head.size == 0 ||
                    !channel_read(b->channel, piece, (size_t)head.size);
        if (!b->broken) {
            size -= head.size;
            is_kept = is_kept && cli_write_all(file, piece, (size_t)head.size);
        }
    }
    if (!b->broken) {
        tell(b,
             is_kept ? import_decode(b->plan->input, file, send_piece, b, &error)
                     : cli_fail(&error, BURNISH_STATUS_MEMORY,
                                "%.200s: out of memory for what has to be decoded", b->plan->input),
             &error);
    }
    if (file >= 0) {
        close(file);
    }
}

/* ---- Messages ---- */

/* Answers the worker until it is gone, which is WRITE, or tells a status, which is returned. */
static burnish_status serve(broker *b, burnish_error *error) {
    message head;
    while (!b->broken && channel_receive(b->channel, &head)) {
        char name[MESSAGE_NAME_MAX + 1];
        if (head.size > MESSAGE_NAME_MAX || !channel_read(b->channel, name, (size_t)head.size)) {
            break;
        }
        name[head.size] = 0;
        if (head.kind == MESSAGE_WRITE && strlen(name) == head.size) {
            write_output(b, name);
        } else if (head.kind == MESSAGE_FILE && strlen(name) == head.size) {
            send_file(b, name, head.value);
        } else if (head.kind == MESSAGE_IMPORT && head.size == 0) {
            import(b, head.value);
        } else if (head.kind == MESSAGE_DECODE && head.size == 0) {
            decode(b, head.value);
        } else if (head.kind == MESSAGE_STATUS && b->depth > 0 &&
                   head.value < BURNISH_STATUS_COUNT) {
            return head.value == BURNISH_STATUS_OK
                       ? BURNISH_STATUS_OK
                       : cli_fail(error, (burnish_status)head.value, "%s", name);
        } else {
            break;
        }
    }
    b->broken = 1;
    return cli_fail(error, BURNISH_STATUS_WRITE, "the sandbox's other process has ended");
}

/* ---- Processes ---- */

/* The exit code of the worker; 1 where it did not end by itself. */
static int wait_for_worker(pid_t worker, burnish_error *ended) {
    burnish_error line;
    int state = 0;
    while (waitpid(worker, &state, 0) < 0 && errno == EINTR) {
    }
    const int code = sandbox_explain_end(state, &line);
    if (!WIFEXITED(state) && ended) {
        *ended = line;
    } else if (!WIFEXITED(state)) {
        fprintf(stderr, "burnish: %s\n", line.text);
    }
    return code;
}

static burnish_status open_input(const char *input, int *file, burnish_error *error) {
    *file = -1;
    if (*input == ':' || strcmp(input, "-") == 0) {
        return BURNISH_STATUS_OK;
    }
    *file = open(input, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    struct stat state;
    if (*file < 0) {
        return cli_fail(error, BURNISH_STATUS_READ, "%.300s: can't be opened: %s", input,
                        strerror(errno));
    }
    if (fstat(*file, &state) == 0 && S_ISDIR(state.st_mode)) {
        close(*file);
        return cli_fail(error, BURNISH_STATUS_READ, "%.300s: can't be read: Is a directory", input);
    }
    return BURNISH_STATUS_OK;
}

/* In the worker: nothing of the broker's stays open, and it does not outlive it. */
static void enter_worker(pid_t parent, int channel, int input) {
    const int first = STDERR_FILENO + 1;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(1);
    }
    /* the channel becomes 3, the input 4, whatever they are now */
    const int held = input >= 0 ? fcntl(input, F_DUPFD_CLOEXEC, first + 16) : -1;
    const int spoken = fcntl(channel, F_DUPFD_CLOEXEC, first + 16);
    dup2(spoken, first);
    if (held >= 0) {
        dup2(held, first + 1);
    }
    close_range((unsigned)first + (held >= 0 ? 2 : 1), ~0U, 0);
    sandbox_become_worker(first, held >= 0 ? first + 1 : -1);
}

burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error) {
    int input, ends[2];
    burnish_status status = open_input(plan->input, &input, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
        close(input);
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--sandbox: no socket: %s",
                        strerror(errno));
    }
    fflush(NULL);
    const pid_t self = getpid(), worker = fork();
    if (worker == 0) {
        enter_worker(self, ends[1], input);
        *code = -1;
        return BURNISH_STATUS_OK;
    }
    if (worker < 0) {
        status =
            cli_fail(error, BURNISH_STATUS_MEMORY, "--sandbox: no process: %s", strerror(errno));
    }
    close(ends[1]);
    if (worker > 0) {
        broker b = {plan, ends[0], input, folder_open(plan->input), 0, 0};
        cli_limit_child(worker);
        serve(&b, error);
        close(ends[0]); /* a worker that still speaks hears that nobody listens */
        *code = wait_for_worker(worker, plan->ended);
        cli_limit_child(0);
        if (b.folder >= 0) {
            close(b.folder);
        }
    } else {
        close(ends[0]);
    }
    if (input >= 0) {
        close(input);
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
