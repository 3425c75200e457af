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
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/limits.h"
#include "sandbox/channel.h"
#include "sandbox/worker.h"

typedef struct broker {
    const sandbox_plan *plan;
    int channel;
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
    if (!b->broken) {
        const char *text = status == BURNISH_STATUS_OK ? "" : error.text;
        b->broken = !channel_send(b->channel, MESSAGE_DONE, (uint64_t)status, text, strlen(text));
    }
}

/* ---- Files beside the input ---- */

/* Not above the folder, also by a link, nor anything but a regular file. Returns a descriptor, or
 * -1 with errno. */
static int open_beside(const broker *b, const char *name) {
    enum { FLAGS = O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK };
    struct {
        uint64_t flags, mode, resolve;
    } how = {FLAGS, 0, 0x08 | 0x02}; /* RESOLVE_BENEATH, RESOLVE_NO_MAGICLINKS */
    struct stat state;
    if (b->folder < 0) {
        errno = ENOENT;
        return -1;
    }
    int file = (int)syscall(437 /* openat2 */, b->folder, name, &how, sizeof how);
    if (file < 0 && errno == ENOSYS && !strchr(name, '/')) {
        file = openat(b->folder, name, FLAGS | O_NOFOLLOW);
    }
    if (file >= 0 && (fstat(file, &state) != 0 || !S_ISREG(state.st_mode))) {
        close(file);
        errno = EACCES;
        return -1;
    }
    return file;
}

static void refuse_file(broker *b, burnish_status status, const char *name, const char *why) {
    char text[MESSAGE_TEXT_MAX];
    snprintf(text, sizeof text, "%.200s: can't be opened: %s", name, why);
    b->broken = !channel_send(b->channel, MESSAGE_DONE, (uint64_t)status, text, strlen(text));
}

static void send_file(broker *b, const char *name, uint64_t max_bytes) {
    const int file = open_beside(b, name);
    struct stat state;
    if (file < 0 || fstat(file, &state) != 0) {
        refuse_file(b, BURNISH_STATUS_READ, name, strerror(errno));
        return;
    }
    const uint64_t size = state.st_size > 0 ? (uint64_t)state.st_size : 0;
    char *bytes = size <= max_bytes && size < SIZE_MAX ? malloc((size_t)size + 1) : NULL;
    if (size > max_bytes) {
        refuse_file(b, BURNISH_STATUS_LIMIT, name, "it is larger than the limit of bytes");
    } else if (!bytes) {
        refuse_file(b, BURNISH_STATUS_MEMORY, name, "out of memory");
    } else {
        size_t got = 0;
        ssize_t count;
        while (got < size && (count = read(file, bytes + got, (size_t)size - got)) > 0) {
            got += (size_t)count;
        }
        b->broken = !channel_send(b->channel, MESSAGE_BYTES, 0, bytes, got);
    }
    free(bytes);
    close(file);
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
static int wait_for_worker(pid_t worker) {
    int state = 0;
    while (waitpid(worker, &state, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(state)) {
        return WEXITSTATUS(state);
    }
    const int number = WTERMSIG(state);
    if (number == SIGSYS) {
        fprintf(stderr, "burnish: the sandbox ended the program: it asked the system for what "
                        "drawing does not need; report the input, or use --no-sandbox\n");
    } else if (number == SIGKILL) {
        fprintf(stderr, "burnish: out of memory: the system ended the program\n");
        return burnish_status_exit_code(BURNISH_STATUS_MEMORY);
    } else {
        fprintf(stderr,
                "burnish: the program ended in its sandbox by signal %d (%s); report the "
                "input\n",
                number, strsignal(number));
    }
    return 1;
}

static int open_folder(const char *input) {
    char folder[MESSAGE_NAME_MAX];
    const char *slash = strrchr(input, '/');
    if (*input == ':' || strcmp(input, "-") == 0 ||
        (slash && (size_t)(slash - input) + 2 > sizeof folder)) {
        return -1;
    }
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - input) + 1 : 1,
             slash ? input : ".");
    return open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
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
    if (input >= 0) {
        close(input);
    }
    if (worker > 0) {
        broker b = {plan, ends[0], open_folder(plan->input), 0, 0};
        cli_limit_child(worker);
        serve(&b, error);
        close(ends[0]); /* a worker that still speaks hears that nobody listens */
        *code = wait_for_worker(worker);
        cli_limit_child(0);
        if (b.folder >= 0) {
            close(b.folder);
        }
        return BURNISH_STATUS_OK;
    }
    close(ends[0]);
    return status;
}

#else

burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error) {
    (void)plan;
    *code = -1;
    return sandbox_lock(0, error);
}

#endif
