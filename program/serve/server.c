/* Frames and processes. One thread, which blocks only in poll: it reads requests while a worker is
 * free and writes replies as fast as the client reads them. */
#include "serve/serve.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/clock.h"
#include "cli/limits.h"
#include "sandbox/channel.h"
#include "sandbox/process.h"

enum {
    START_TRIES = 3, /* that fail in a row end the server */
    BUFFER = 1 << 16,
    PIECE = 4096 /* PIPE_BUF: a pipe that poll reports as writable accepts so many bytes */
};

typedef enum slot_state {
    SLOT_EMPTY,    /* no process */
    SLOT_STARTING, /* getting ready */
    SLOT_IDLE,     /* waiting for a request */
    SLOT_FILLING,  /* its request is being read */
    SLOT_WORKING,
    SLOT_REPLIED, /* the reply is complete, but not written */
} slot_state;

/* A worker and its request. */
typedef struct slot {
    slot_state state;
    pid_t process;  /* 0: it has ended */
    pid_t importer; /* a process that runs or ran an importer for it; 0: none */
    int channel, request, reply;
    uint32_t id, left;   /* left: bytes of the request still to read */
    uint64_t size;       /* of the whole request */
    double deadline;     /* as burnish_seconds_now */
    int is_late;         /* 1: the deadline has passed */
    char *line;          /* the reply if the worker wrote none; NULL: it is in the file */
    size_t reply_size;   /* without the frame's head */
    uint64_t reply_next; /* next byte to write, counted from the frame's head */
} slot;

typedef struct server {
    const serve_settings *settings;
    slot *slots;
    struct pollfd *ready; /* standard input and output, then one per slot */
    size_t count;
    slot *filling; /* NULL: between requests */
    slot *writing; /* NULL: no reply is being written */
    uint8_t head[SERVE_HEAD_BYTES];
    size_t head_size;  /* bytes of it that were read */
    uint64_t requests; /* read so far */
    int failed_starts; /* since a worker was last ready */
    int has_ended;     /* 1: no more requests */
    burnish_error end; /* the reason, unless its status is OK */
} server;

/* ---- Workers ---- */

static void close_files(slot *s) {
    const int files[] = {s->channel, s->request, s->reply};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        if (files[i] >= 0) {
            close(files[i]);
        }
    }
    s->channel = s->request = s->reply = -1;
}

/* Forks a worker or an importer of it, with the descriptors of serve.h. 0 in the new process. */
static pid_t fork_worker(const slot *s, int channel) {
    _Static_assert(SERVE_CHANNEL == 3 && SERVE_REQUEST == 4 && SERVE_REPLY == 5, "the order below");
    const pid_t process = cli_fork(
        &(cli_plan){.kept = {CLI_NOTHING, CLI_NOTHING, CLI_NOTHING, channel, s->request, s->reply},
                    .count = SERVE_DESCRIPTORS,
                    .ended_by = SIGKILL});
    if (process == 0) {
        signal(SIGINT, SIG_IGN); /* Control-C ends the server, which ends its workers */
    }
    return process;
}

/* Most bytes of a reply: it can't need more memory than the worker has. */
static uint64_t reply_limit(const server *v) {
    const uint64_t most = v->settings->render.job.max_memory;
    return most < UINT32_MAX ? most : UINT32_MAX;
}

/* Memory files do not count as address space, so a compromised worker could fill the memory of the
 * machine through its reply. */
__attribute__((noreturn)) static void become_worker(server *v) {
    cli_lower_limit(RLIMIT_FSIZE, reply_limit(v));
    cli_limit_worker(v->settings->render.job.max_seconds.value);
    serve_work(v->settings);
}

static burnish_status start_worker(server *v, slot *s, burnish_error *error) {
    int ends[2] = {-1, -1};
    *s = (slot){.channel = -1, .request = cli_unnamed_file(), .reply = cli_unnamed_file()};
    if (s->request < 0 || s->reply < 0 || !cli_channel(ends)) {
        const int reason = errno;
        close_files(s);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "serve-stdio: no files for a worker: %s",
                        strerror(reason));
    }
    s->process = fork_worker(s, ends[1]);
    if (s->process == 0) {
        become_worker(v);
    }
    close(ends[1]);
    s->channel = ends[0];
    s->state = SLOT_STARTING;
    if (s->process < 0) {
        s->process = 0;
        close_files(s);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "serve-stdio: no process: %s",
                        strerror(errno));
    }
    return BURNISH_STATUS_OK;
}

/* Waits for the worker. Returns its wait status. */
static int wait_for(slot *s) {
    const int state = cli_wait(s->process);
    s->process = 0;
    return state;
}

/* ---- Importers ---- */

/* A second or an invalid request ends the worker. */
static void start_importer(server *v, slot *s, const serve_import_request *import) {
    static const char text[] = "serve-stdio: no process for an importer";
    if (s->importer > 0) {
        kill(s->process, SIGKILL);
        return;
    }
    s->importer = fork_worker(s, s->channel);
    if (s->importer == 0) {
        serve_run_importer(v->settings, import, s->size);
    }
    if (s->importer < 0) {
        s->importer = 0;
        channel_send(s->channel, MESSAGE_DONE, BURNISH_STATUS_MEMORY, text, strlen(text));
    }
}

/* Ends the importer's process and the importer that it runs. */
static void end_importer(slot *s) {
    if (s->importer > 0) {
        kill(s->importer, SIGKILL);
        cli_wait(s->importer);
        s->importer = 0;
    }
}

/* ---- Replies ---- */

static void reply_failure(slot *s, int code, const char *text) {
    if (!s->line) {
        s->line = serve_failed_line(code, text, NULL);
    }
}

/* Finishes a request that was read and whose worker has ended or did not receive it. */
static void finish_request(const server *v, slot *s) {
    struct stat state;
    s->state = SLOT_REPLIED;
    s->reply_next = 0;
    if (!s->line && (fstat(s->reply, &state) != 0 || state.st_size <= 0 ||
                     (uint64_t)state.st_size > reply_limit(v))) {
        reply_failure(s, burnish_status_exit_code(BURNISH_STATUS_MEMORY),
                      "out of memory for the reply");
    }
    s->reply_size = s->line ? strlen(s->line) + 1 : (size_t)state.st_size;
}

/* Writes the error reply for a worker that ended during its request. */
static void describe_end(const server *v, slot *s, int state) {
    burnish_error line = {BURNISH_STATUS_MEMORY, "the program that draws ended before its reply"};
    int code = sandbox_describe_end(state, &line);
    if (s->is_late || (WIFSIGNALED(state) && WTERMSIG(state) == SIGPROF)) {
        code = burnish_status_exit_code(
            cli_fail_late(s->is_late ? CLI_LATE_WALL : CLI_LATE_PROCESSOR,
                          v->settings->render.job.max_seconds.value, &line));
    }
    if (code != 0 || !WIFEXITED(state)) {
        reply_failure(s, code, line.text);
    }
}

/* Reads no more requests; those that were read get their replies. The first reason is kept. */
static void end_server(server *v, const burnish_error *reason) {
    if (!v->has_ended) {
        v->has_ended = 1;
        v->end = *reason;
    }
    if (v->filling) {
        v->filling->state = SLOT_IDLE; /* its request is incomplete */
        v->filling = NULL;
    }
}

/* Starts a worker in place of one that has ended. */
static void replace_worker(server *v, slot *s) {
    burnish_error error;
    close_files(s);
    s->state = SLOT_EMPTY;
    if (!v->has_ended && start_worker(v, s, &error) != BURNISH_STATUS_OK) {
        s->state = SLOT_EMPTY;
        end_server(v, &error);
    }
}

/* Handles a worker that could not start; its reply file has the reason, unless it was killed. */
static void fail_start(server *v, slot *s, int state) {
    burnish_error line = {BURNISH_STATUS_MEMORY, "serve-stdio: a worker could not start"};
    char text[sizeof line.text] = "";
    sandbox_describe_end(state, &line);
    if (pread(s->reply, text, sizeof text - 1, 0) > 0) {
        cli_fail(&line, BURNISH_STATUS_ARGUMENT, "%s", text);
    }
    if (++v->failed_starts == START_TRIES) {
        end_server(v, &line);
    }
    replace_worker(v, s);
}

/* Handles a worker that became ready, requested an importer or ended. */
static void receive_from_worker(server *v, slot *s) {
    char byte;
    serve_import_request import;
    const int kind =
        s->state == SLOT_WORKING ? serve_receive_import(s->channel, &import) : SERVE_ENDED;
    if (kind == SERVE_IMPORT) {
        start_importer(v, s, &import);
    } else if (kind == SERVE_INVALID) {
        kill(s->process, SIGKILL);
    }
    if (kind != SERVE_ENDED) {
        return;
    }
    if (s->state != SLOT_WORKING && read(s->channel, &byte, 1) == 1) {
        if (s->state == SLOT_STARTING) {
            s->state = SLOT_IDLE;
            v->failed_starts = 0;
        }
        return;
    }
    end_importer(s);
    const int state = wait_for(s);
    if (s->state == SLOT_STARTING) {
        fail_start(v, s, state);
    } else if (s->state == SLOT_IDLE) { /* it was killed while idle */
        replace_worker(v, s);
    } else {
        describe_end(v, s, state);
    }
    if (s->state == SLOT_WORKING) {
        finish_request(v, s);
    }
}

static void put_u32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

static uint32_t get_u32(const uint8_t *from) {
    return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 |
           (uint32_t)from[3] << 24;
}

/* Copies head and reply from reply_next on. Returns the byte count; -1: the file can't be read. */
static ssize_t reply_bytes(const slot *s, char piece[PIECE]) {
    size_t used = 0;
    uint64_t next = s->reply_next;
    if (next < SERVE_HEAD_BYTES) {
        uint8_t head[SERVE_HEAD_BYTES];
        put_u32(head, (uint32_t)s->reply_size);
        put_u32(head + 4, s->id);
        used = SERVE_HEAD_BYTES - (size_t)next;
        memcpy(piece, head + next, used);
        next = SERVE_HEAD_BYTES;
    }
    next -= SERVE_HEAD_BYTES;
    const size_t room = PIECE - used, left = s->reply_size - (size_t)next;
    const size_t count = left < room ? left : room;
    if (!s->line) {
        const ssize_t taken = pread(s->reply, piece + used, count, (off_t)next);
        return taken < 0 || (taken == 0 && count > 0) ? -1 : (ssize_t)used + taken;
    }
    memcpy(piece + used, s->line + next, count);
    if (next + count == s->reply_size) {
        piece[used + count - 1] = '\n'; /* replaces the line's 0 */
    }
    return (ssize_t)(used + count);
}

/* Writes as much as standard output accepts without blocking. A worker is replaced after its reply
 * was written, unless it did not receive the request. */
static burnish_status write_reply(server *v, burnish_error *error) {
    char piece[PIECE];
    slot *s = v->writing;
    const ssize_t count = reply_bytes(s, piece);
    const ssize_t written = count > 0 ? write(STDOUT_FILENO, piece, (size_t)count) : -1;
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) {
        return BURNISH_STATUS_OK;
    }
    if (written < 0) {
        return cli_fail(error, BURNISH_STATUS_WRITE, "standard output: %s", strerror(errno));
    }
    s->reply_next += (uint64_t)written;
    if (s->reply_next < SERVE_HEAD_BYTES + (uint64_t)s->reply_size) {
        return BURNISH_STATUS_OK;
    }
    v->writing = NULL;
    free(s->line);
    s->line = NULL;
    if (s->process > 0) {
        s->state = SLOT_IDLE;
        return ftruncate(s->request, 0) == 0 && lseek(s->request, 0, SEEK_SET) == 0
                   ? BURNISH_STATUS_OK
                   : cli_fail(error, BURNISH_STATUS_WRITE, "serve-stdio: %s", strerror(errno));
    }
    replace_worker(v, s);
    return BURNISH_STATUS_OK;
}

/* ---- Requests ---- */

static slot *find_slot(const server *v, slot_state state) {
    for (size_t i = 0; i < v->count; ++i) {
        if (v->slots[i].state == state) {
            return &v->slots[i];
        }
    }
    return NULL;
}

static void end_input(server *v, burnish_status status, const char *what) {
    burnish_error line = {BURNISH_STATUS_OK, ""};
    if (status != BURNISH_STATUS_OK) {
        cli_fail(&line, status, "standard input: request %llu: %s",
                 (unsigned long long)v->requests + (v->head_size > 0), what);
    }
    end_server(v, &line);
}

/* Handles a complete head. */
static void begin_request(server *v) {
    const uint32_t length = get_u32(v->head);
    slot *s = find_slot(v, SLOT_IDLE);
    if (length == 0) {
        end_input(v, BURNISH_STATUS_FORMAT, "is empty; see docs/serve.md");
        return;
    }
    s->id = get_u32(v->head + 4);
    s->size = s->left = length;
    s->state = SLOT_FILLING;
    s->is_late = 0;
    v->filling = s;
    if (length > v->settings->max_request_bytes) {
        burnish_error line;
        cli_fail(&line, BURNISH_STATUS_LIMIT,
                 "request: %lu bytes; the limit is %llu (--max-request-bytes)",
                 (unsigned long)length, (unsigned long long)v->settings->max_request_bytes);
        reply_failure(s, burnish_status_exit_code(line.status), line.text);
    }
}

/* From now on nobody changes the file: the worker that parses it has a descriptor that can write. */
static void seal_request(int request) {
#ifdef F_ADD_SEALS
    fcntl(request, F_ADD_SEALS, F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE);
#else
    (void)request;
#endif
}

/* Handles a complete request. */
static void end_request(server *v) {
    slot *s = v->filling;
    const double seconds = cli_wall_seconds(v->settings->render.job.max_seconds.value);
    v->filling = NULL;
    v->head_size = 0;
    ++v->requests;
    s->deadline = seconds > 0 ? burnish_seconds_now() + seconds : INFINITY;
    if (s->line) {
        finish_request(v, s);
        return;
    }
    seal_request(s->request);
    cli_write_all(s->channel, &s->size, sizeof s->size); /* poll finds a worker that is gone */
    s->state = SLOT_WORKING;
}

static void keep_bytes(server *v, const char *bytes, size_t size) {
    slot *s = v->filling;
    if (s->left == s->size && *bytes != '{') {
        end_input(v, BURNISH_STATUS_FORMAT, "does not begin with a JSON object; see docs/serve.md");
        return;
    }
    if (!s->line && !cli_write_all(s->request, bytes, size)) {
        reply_failure(s, burnish_status_exit_code(BURNISH_STATUS_MEMORY),
                      "out of memory for the request");
    }
    s->left -= (uint32_t)size;
    if (s->left == 0) {
        end_request(v);
    }
}

/* Reads available bytes of one head or one request. */
static void read_input(server *v) {
    static char buffer[BUFFER];
    slot *s = v->filling;
    const size_t most = s ? (s->left < BUFFER ? s->left : BUFFER) : sizeof v->head - v->head_size;
    const ssize_t count = read(STDIN_FILENO, s ? (void *)buffer : v->head + v->head_size, most);
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) {
        return;
    }
    if (count < 0) {
        end_input(v, BURNISH_STATUS_READ, strerror(errno));
    } else if (count == 0) {
        end_input(v, s || v->head_size > 0 ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK,
                  "incomplete");
    } else if (s) {
        keep_bytes(v, buffer, (size_t)count);
        memset(buffer, 0, (size_t)count); /* forked workers must not see earlier requests */
    } else {
        v->head_size += (size_t)count;
        if (v->head_size == sizeof v->head) {
            begin_request(v);
        }
    }
}

/* ---- The loop ---- */

/* Ends workers past their deadline. Returns milliseconds until the next deadline; -1: none. */
static int look_at_clock(server *v) {
    double next = INFINITY;
    for (size_t i = 0; i < v->count; ++i) {
        slot *s = &v->slots[i];
        if (s->state == SLOT_WORKING && s->deadline < INFINITY) {
            const double left = s->deadline - burnish_seconds_now();
            if (left <= 0 && !s->is_late) {
                s->is_late = 1;
                kill(s->process, SIGKILL);
            } else if (!s->is_late) {
                next = left < next ? left : next;
            }
        }
    }
    return next < INT_MAX / 1000 ? (int)(next * 1000) + 1 : -1;
}

static int may_read(const server *v) {
    return !v->has_ended && (v->filling || find_slot(v, SLOT_IDLE));
}

static void choose_descriptors(server *v) {
    v->writing = v->writing ? v->writing : find_slot(v, SLOT_REPLIED);
    v->ready[0] = (struct pollfd){may_read(v) ? STDIN_FILENO : -1, POLLIN, 0};
    v->ready[1] = (struct pollfd){v->writing ? STDOUT_FILENO : -1, POLLOUT, 0};
    for (size_t i = 0; i < v->count; ++i) {
        const slot *s = &v->slots[i];
        v->ready[2 + i] = (struct pollfd){s->process > 0 ? s->channel : -1, POLLIN, 0};
    }
}

static burnish_status server_turn(server *v, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    const int wait = look_at_clock(v);
    choose_descriptors(v);
    if (poll(v->ready, (nfds_t)v->count + 2, wait) <= 0) {
        return status;
    }
    for (size_t i = 0; i < v->count; ++i) {
        if (v->ready[2 + i].revents) {
            receive_from_worker(v, &v->slots[i]);
        }
    }
    if (v->ready[1].revents) {
        status = write_reply(v, error);
    }
    if (status == BURNISH_STATUS_OK && v->ready[0].revents && may_read(v)) {
        read_input(v);
    }
    return status;
}

static int has_work(const server *v) {
    return !v->has_ended || v->writing || find_slot(v, SLOT_WORKING) || find_slot(v, SLOT_REPLIED);
}

/* Closing the channels ends the idle workers. */
static void end_workers(server *v) {
    for (size_t i = 0; v->slots && i < v->count; ++i) {
        slot *s = &v->slots[i];
        end_importer(s);
        if (s->process > 0) {
            kill(s->process, SIGKILL);
            wait_for(s);
        }
        close_files(s);
        free(s->line);
    }
}

burnish_status serve_run(const serve_settings *settings, burnish_error *error) {
    server v = {.settings = settings,
                .count = settings->jobs > 0 ? (size_t)settings->jobs
                                            : (size_t)burnish_processor_count()};
    v.slots = calloc(v.count, sizeof *v.slots);
    v.ready = calloc(v.count + 2, sizeof *v.ready);
    burnish_status status = v.slots && v.ready
                                ? BURNISH_STATUS_OK
                                : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    for (size_t i = 0; v.slots && i < v.count; ++i) {
        v.slots[i] = (slot){.channel = -1, .request = -1, .reply = -1};
    }
    for (size_t i = 0; i < v.count && status == BURNISH_STATUS_OK; ++i) {
        status = start_worker(&v, &v.slots[i], error);
    }
    while (status == BURNISH_STATUS_OK && has_work(&v)) {
        status = server_turn(&v, error);
    }
    end_workers(&v);
    free(v.slots);
    free(v.ready);
    if (status == BURNISH_STATUS_OK && v.end.status != BURNISH_STATUS_OK) {
        *error = v.end;
        status = v.end.status;
    }
    return status;
}

#endif
