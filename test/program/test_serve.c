/* The server with workers that lie or are killed: its memory stays within the limits, and requests that were read get their
 * replies. */
#include "../program/serve/import.c"
#include "../program/serve/server.c"

#include <stdatomic.h>
#include <sys/mman.h>

#include "support.h"

enum { MOST = 1 << 20, REPLIES_MAX = 2 * MOST };

/* What the processes share. */
static struct shared {
    int killed_from, killed_to; /* these starts, counted from 1, end by SIGKILL */
    int is_unlocked;            /* 1: workers can't start, and write why */
    atomic_int starts, killed;
    _Atomic pid_t last_killed;
    size_t reply_bytes, request_bytes; /* that a lying worker could write */
    burnish_status status;
    burnish_error error;
} * shared;

char *serve_failed_line(int code, const char *text, const char *report) {
    char line[600];
    (void)report;
    snprintf(line, sizeof line, "{\"code\":%d,\"error\":\"%s\"}", code, text);
    return strdup(line);
}

static size_t fill(int file) {
    static char piece[4096];
    size_t sum = 0;
    for (ssize_t count; sum < 4 * MOST && (count = write(file, piece, sizeof piece)) > 0;) {
        sum += (size_t)count;
    }
    return sum;
}

/* 1 once the server has waited for the last process that was killed. */
static int have_starts_failed(void) {
    return shared->killed > shared->killed_to - shared->killed_from &&
           kill(shared->last_killed, 0) != 0;
}

/* A worker that does what its request says: {fill}, {wait} until all starts failed, or {}. */
void serve_work(const serve_settings *settings) {
    const int start = ++shared->starts;
    uint64_t size = 0;
    char request[8] = "";
    (void)settings;
    if (start >= shared->killed_from && start <= shared->killed_to) {
        shared->last_killed = getpid();
        ++shared->killed;
        raise(SIGKILL);
    }
    if (shared->is_unlocked) {
        cli_write_all(SERVE_REPLY, "no sandbox", 10);
        _exit(2);
    }
    if (!cli_write_all(SERVE_CHANNEL, "", 1) || !channel_read(SERVE_CHANNEL, &size, sizeof size) ||
        pread(SERVE_REQUEST, request, sizeof request - 1, 0) < 0) {
        _exit(0);
    }
    if (strncmp(request, "{fill}", 6) == 0) {
        shared->request_bytes = fill(SERVE_REQUEST);
        shared->reply_bytes = fill(SERVE_REPLY);
        _exit(0);
    }
    while (strncmp(request, "{wait}", 6) == 0 && !have_starts_failed()) {
        usleep(1000);
    }
    _exit(cli_write_all(SERVE_REPLY, "{\"code\":0}\n", 11) ? 0 : 6);
}

/* Runs a server over requests of 7 bytes each; its input ends after all starts that fail. Returns the replies' bytes; count receives how many whole frames they are. */
static size_t serve(int jobs, const char *requests, size_t *count) {
    static uint8_t replies[REPLIES_MAX];
    static const serve_settings defaults = {.max_request_bytes = MOST};
    int in[2], out[2];
    size_t size = 0;
    ssize_t got;
    CHECK1(pipe(in) == 0 && pipe(out) == 0);
    fflush(stdout); /* failures that were reported must not reach the server's output */
    const pid_t process = fork();
    if (process == 0) {
        serve_settings settings = defaults;
        settings.jobs = jobs;
        settings.render.job.max_memory = MOST;
        dup2(in[0], STDIN_FILENO);
        dup2(out[1], STDOUT_FILENO);
        close(in[1]);
        close(out[0]);
        shared->status = serve_run(&settings, &shared->error);
        _exit(0);
    }
    close(in[0]);
    close(out[1]);
    for (uint8_t id = 0; *requests; requests += 7, ++id) {
        const uint8_t head[SERVE_HEAD_BYTES] = {7, 0, 0, 0, id};
        CHECK1(cli_write_all(in[1], head, sizeof head) && cli_write_all(in[1], requests, 7));
    }
    for (int k = 0; k < 10000 && shared->killed <= shared->killed_to - shared->killed_from; ++k) {
        usleep(1000); /* at the end of its input the server starts no more workers */
    }
    close(in[1]);
    while (size < sizeof replies &&
           (got = read(out[0], replies + size, sizeof replies - size)) > 0) {
        size += (size_t)got;
    }
    close(out[0]);
    CHECK1(waitpid(process, NULL, 0) == process);
    size_t at = 0;
    for (*count = 0; at + SERVE_HEAD_BYTES <= size; ++*count) {
        at += SERVE_HEAD_BYTES + get_u32(replies + at);
    }
    CHECK(at == size, "a frame is not whole");
    return size;
}

static void begin(struct shared state) {
    *shared = state;
}

static void test_limits(void) {
    size_t count;
    begin((struct shared){.killed_from = 1});
    const size_t size = serve(1, "{fill}\n{    }\n", &count);
    CHECK(shared->reply_bytes == MOST, "a reply of %zu bytes", shared->reply_bytes);
#ifdef __linux__
    CHECK(shared->request_bytes == 0, "%zu bytes in the request's file", shared->request_bytes);
#endif
    CHECK(count == 2 && size == MOST + 11 + 2 * SERVE_HEAD_BYTES, "%zu replies of %zu bytes", count,
          size);
    CHECK1(shared->status == BURNISH_STATUS_OK);
}

static void test_starts(void) {
    size_t count;
    begin((struct shared){.killed_from = 2, .killed_to = 3});
    serve(1, "{    }\n{    }\n", &count);
    CHECK(count == 2 && shared->status == BURNISH_STATUS_OK, "%zu replies: %s", count,
          shared->error.text);
    begin((struct shared){.killed_from = 1, .killed_to = 2});
    serve(1, "{    }\n", &count);
    CHECK(count == 1 && shared->status == BURNISH_STATUS_OK, "%zu replies: %s", count,
          shared->error.text);
    begin((struct shared){.killed_from = 3, .killed_to = 5});
    serve(2, "{wait}\n{    }\n", &count);
    CHECK(count == 2, "%zu replies", count);
    CHECK1(shared->killed == 3 && shared->status == BURNISH_STATUS_MEMORY);
    CHECK_TEXT(shared->error.text, "out of memory: the system ended the program");
    begin((struct shared){.is_unlocked = 1, .killed_from = 1});
    serve(1, "", &count);
    CHECK1(count == 0 && shared->status == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(shared->error.text, "no sandbox");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) {
        return 1;
    }
    signal(SIGPIPE, SIG_IGN); /* as the program does */
    signal(SIGXFSZ, SIG_IGN);
    RUN(test_limits());
    RUN(test_starts());
    return test_end("serve");
}
