/* burnish-mpi: a command of burnish on many machines, started by mpirun.
 *
 * Every rank is two processes. One is burnish, which draws and knows nothing of MPI: on rank 0 the
 * command with --runners=N, on each other rank the same command with --runner. The other is this
 * one, which opens no file: it carries bytes between the sockets of rank 0's burnish and the one
 * socket of each other rank's. What crashes or runs out of memory is not a process of MPI, and
 * nothing is forked once MPI has begun.
 *
 * Ranks are heard of all the time. A rank that has been silent for too long is lost: its socket is
 * closed, and burnish hands to others what it held. Nothing waits for a rank, so that one that is
 * dead can't hold up the others. */
#include <errno.h>
#include <fcntl.h>
#include <mpi.h>
#include <poll.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "burnish/core.h"

enum {
    CHANNEL = 3,            /* the child's first socket */
    BUFFER_BYTES = 1 << 18, /* of each direction of a link */
    SILENCE_DEFAULT = 60,   /* seconds */
    BEATS = 8,              /* in that time */
    START_SILENCES = 10,    /* until all ranks have to be there */
    FAREWELL_SECONDS = 10   /* for what has to do with the end */
};

/* Tags: bytes; the link's end; nothing but a sign of life. */
enum { TAG_BYTES = 1, TAG_END, TAG_BEAT };

/* A socket of the child here, and the rank that its bytes come from and go to. */
typedef struct link {
    int peer, socket; /* -1: closed */
    char *in, *out;
    size_t in_size, in_taken; /* received, written to the socket */
    int has_ended;            /* 1: TAG_END was received */
    int is_ending;            /* 1: TAG_END was sent */
    int is_lost;
    double heard; /* when, the last time */
    MPI_Request beat;
} link_state;

typedef struct relay {
    int rank, size;
    pid_t child;
    int state; /* wait status; valid when child is 0 */
    link_state *links;
    int count;
    MPI_Request *requests; /* of each link: receive, send */
    int *done;
    MPI_Status *statuses;
    struct pollfd *ready;
    double silence, next_beat;
    const char *status_file; /* NULL: none */
    int survives;            /* 1: mpirun goes on when a rank dies */
    int expects_child;       /* 1: what comes next comes from the child, most likely */
    int has_losses;
} relay;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ---- The child ---- */

static volatile sig_atomic_t child_to_stop; /* gets the signals that end rank 0 */

static void pass_on(int number) {
    if (child_to_stop > 0) {
        kill((pid_t)child_to_stop, number);
    }
}

/* The program beside this one, or where BURNISH or PATH say. */
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

/* Descriptors up from CHANNEL become the sockets; they are moved out of the way first. */
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

/* In the new process. argv: the command and its arguments. A runner waits for work first, so that
 * a command line that is wrong is told once. */
static void become_burnish(int rank, int *sockets, int count, int argc, char **argv, pid_t parent) {
    char path[4096], runners[32];
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
    fprintf(stderr, "burnish-mpi: %s: %s; set BURNISH to where it is\n", path, strerror(errno));
    _exit(126);
}

static int fail(const char *what) {
    fprintf(stderr, "burnish-mpi: %s: %s\n", what, strerror(errno));
    return 0;
}

/* Before MPI begins. */
static int start_child(relay *r, int argc, char **argv) {
    int *theirs = calloc((size_t)r->count + 1, sizeof *theirs);
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < 4U * (unsigned)r->count + 64) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
    }
    for (int i = 0; theirs && i < r->count; ++i) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
            return fail("no socket for each rank");
        }
        fcntl(ends[0], F_SETFD, FD_CLOEXEC);
        fcntl(ends[0], F_SETFL, O_NONBLOCK);
        r->links[i].socket = ends[0];
        theirs[i] = ends[1];
    }
    const pid_t self = getpid();
    r->child = theirs ? fork() : -1;
    if (r->child == 0) {
        become_burnish(r->rank, theirs, r->count, argc, argv, self);
    }
    for (int i = 0; theirs && i < r->count; ++i) {
        close(theirs[i]);
    }
    free(theirs);
    return r->child > 0 ? 1 : fail("no process for burnish");
}

/* 1: it is gone. */
static int child_is_gone(relay *r) {
    if (r->child > 0 && waitpid(r->child, &r->state, WNOHANG) == r->child) {
        r->child = 0;
        child_to_stop = 0;
    }
    return r->child == 0;
}

static void end_child(relay *r) {
    const double start = now();
    if (r->child > 0) {
        kill(r->child, SIGTERM);
    }
    while (!child_is_gone(r)) {
        if (now() - start > 1) {
            kill(r->child, SIGKILL);
        }
        usleep(10000);
    }
}

/* ---- Links ---- */

static MPI_Request *receive_of(relay *r, const link_state *l) {
    return &r->requests[2 * (l - r->links)];
}

static MPI_Request *send_of(relay *r, const link_state *l) {
    return &r->requests[2 * (l - r->links) + 1];
}

static void close_socket(link_state *l) {
    if (l->socket >= 0) {
        close(l->socket);
    }
    l->socket = -1;
}

/* Its requests are left as they are: nothing that waits for them can be trusted to return. */
static void lose(relay *r, link_state *l, const char *why) {
    if (r->rank == 0 && !l->has_ended) {
        fprintf(stderr, "burnish-mpi: rank %d %s; what it held goes to others\n", l->peer, why);
    }
    *receive_of(r, l) = MPI_REQUEST_NULL;
    *send_of(r, l) = MPI_REQUEST_NULL;
    l->is_lost = 1;
    r->has_losses = 1;
    close_socket(l);
}

static void expect(relay *r, link_state *l) {
    if (MPI_Irecv(l->in, BUFFER_BYTES, MPI_BYTE, l->peer, MPI_ANY_TAG, MPI_COMM_WORLD,
                  receive_of(r, l)) != MPI_SUCCESS) {
        lose(r, l, "can't be heard");
    }
}

static void post(relay *r, link_state *l, size_t size, int tag) {
    if (MPI_Isend(l->out, (int)size, MPI_BYTE, l->peer, tag, MPI_COMM_WORLD, send_of(r, l)) !=
        MPI_SUCCESS) {
        lose(r, l, "can't be reached");
    }
}

static void end_link(relay *r, link_state *l) {
    close_socket(l);
    if (!l->is_ending && !l->is_lost && *send_of(r, l) == MPI_REQUEST_NULL) {
        l->is_ending = 1;
        post(r, l, 0, TAG_END);
    }
}

/* What was received goes to the child as far as it takes it; then the next may come. */
static int write_socket(relay *r, link_state *l) {
    if (l->in_taken == l->in_size || l->is_lost) {
        return 0;
    }
    ssize_t count = l->socket >= 0 ? write(l->socket, l->in + l->in_taken, l->in_size - l->in_taken)
                                   : (ssize_t)(l->in_size - l->in_taken);
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
        count = (ssize_t)(l->in_size - l->in_taken); /* it wants no more */
    }
    l->in_taken += count > 0 ? (size_t)count : 0;
    r->expects_child |= count > 0;
    if (l->in_taken == l->in_size) {
        expect(r, l);
    }
    return count > 0;
}

static int read_socket(relay *r, link_state *l) {
    if (l->socket < 0 || l->is_lost || *send_of(r, l) != MPI_REQUEST_NULL) {
        return 0;
    }
    const ssize_t count = read(l->socket, l->out, BUFFER_BYTES);
    if (count > 0) {
        r->expects_child = 0;
        post(r, l, (size_t)count, TAG_BYTES);
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        /* rank 0's burnish has its report to write yet, and the others wait for that */
        r->rank == 0 ? close_socket(l) : end_link(r, l);
    }
    return count > 0;
}

static void take_message(relay *r, link_state *l, const MPI_Status *status) {
    int size = 0;
    l->heard = now();
    if (status->MPI_TAG == TAG_BYTES) {
        MPI_Get_count(status, MPI_BYTE, &size);
        l->in_size = (size_t)size;
        l->in_taken = 0;
        write_socket(r, l);
        return;
    }
    if (status->MPI_TAG == TAG_END) {
        l->has_ended = 1;
        close_socket(l);
    }
    expect(r, l);
}

/* Messages that have come or gone. Returns how many. */
static int move_messages(relay *r) {
    int count = 0;
    const int code = MPI_Testsome(2 * r->count, r->requests, &count, r->done, r->statuses);
    if (count == MPI_UNDEFINED || (code != MPI_SUCCESS && code != MPI_ERR_IN_STATUS)) {
        return 0;
    }
    for (int i = 0; i < count; ++i) {
        link_state *l = &r->links[r->done[i] / 2];
        if (code == MPI_ERR_IN_STATUS && r->statuses[i].MPI_ERROR != MPI_SUCCESS &&
            r->statuses[i].MPI_ERROR != MPI_ERR_PENDING) {
            lose(r, l, "is gone");
        } else if (r->done[i] % 2 == 0) {
            take_message(r, l, &r->statuses[i]);
        }
    }
    return count;
}

/* Signs of life, and who has given none. */
static void beat(relay *r) {
    const double time = now();
    if (time < r->next_beat) {
        return;
    }
    r->next_beat = time + r->silence / BEATS;
    for (int i = 0; i < r->count; ++i) {
        link_state *l = &r->links[i];
        int is_sent = 1;
        if (l->is_lost || l->is_ending) {
            continue;
        }
        if (l->in_taken < l->in_size) {
            l->heard = time; /* nothing is received until the child has taken what is there */
        }
        if (l->beat != MPI_REQUEST_NULL) {
            MPI_Test(&l->beat, &is_sent, MPI_STATUS_IGNORE);
        }
        if (is_sent) {
            MPI_Isend(NULL, 0, MPI_BYTE, l->peer, TAG_BEAT, MPI_COMM_WORLD, &l->beat);
        }
        if (time - l->heard > r->silence) {
            lose(r, l, "is silent");
        }
    }
}

/* Waits for the child; for MPI, which has nothing to wait with, by sleeping for a while that grows
 * with the time in which nothing happened. */
static void rest(relay *r, int idle) {
    const long longest = r->rank > 0 && r->expects_child ? 10000000 : 1000000;
    const long least = 20000, nanoseconds = least << (idle < 10 ? idle : 10);
    const struct timespec time = {0, nanoseconds < longest ? nanoseconds : longest};
    int count = 0;
    for (int i = 0; i < r->count; ++i) {
        const link_state *l = &r->links[i];
        short events = *send_of(r, l) == MPI_REQUEST_NULL ? POLLIN : 0;
        events |= l->in_taken < l->in_size ? POLLOUT : 0;
        if (l->socket >= 0 && events) {
            r->ready[count++] = (struct pollfd){l->socket, events, 0};
        }
    }
    ppoll(r->ready, (nfds_t)count, &time, NULL);
}

/* 1: this rank has nothing more to do. */
static int is_over(relay *r) {
    return r->rank == 0 ? child_is_gone(r) : r->links[0].has_ended || r->links[0].is_lost;
}

static void carry(relay *r) {
    for (int idle = 0; !is_over(r); ++idle) {
        int moved = move_messages(r);
        for (int i = 0; i < r->count; ++i) {
            moved += write_socket(r, &r->links[i]);
            moved += read_socket(r, &r->links[i]);
        }
        beat(r);
        if (moved > 0) {
            idle = -1;
        } else {
            rest(r, idle);
        }
    }
}

/* ---- The end ---- */

static int exit_code_of(int state) {
    return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
}

/* Tells all ranks that it is over; 1: all know. */
static int say_farewell(relay *r) {
    const double start = now();
    for (int left = 1; left > 0 && now() - start < FAREWELL_SECONDS;) {
        left = 0;
        move_messages(r);
        for (int i = 0; i < r->count; ++i) {
            link_state *l = &r->links[i];
            end_link(r, l);
            left += !l->is_lost && (!l->is_ending || *send_of(r, l) != MPI_REQUEST_NULL ||
                                    (r->rank == 0 && !l->has_ended));
        }
        usleep(1000);
    }
    for (int i = 0; i < r->count; ++i) {
        r->has_losses |= !r->links[i].is_ending;
    }
    return !r->has_losses;
}

static int code_at_alarm;

static void leave(int number) {
    (void)number;
    _exit(code_at_alarm);
}

static void write_status(const relay *r, int code) {
    FILE *file = r->status_file ? fopen(r->status_file, "w") : NULL;
    if (r->status_file && (!file || fprintf(file, "%d\n", code) < 0 || fclose(file) != 0)) {
        fail(r->status_file);
    }
}

/* MPI_Finalize waits for all ranks, and one that is lost would never come. */
static int finish(relay *r) {
    int code = r->rank == 0 ? exit_code_of(r->state) : 0;
    if (r->rank == 0) {
        write_status(r, code);
        code = r->survives ? 0 : code; /* which mpirun would call an error of its own, and drop */
    }
    const int is_whole = say_farewell(r);
    if (r->rank > 0) {
        end_child(r);
    }
    fflush(NULL);
    code_at_alarm = code;
    signal(SIGALRM, leave);
    alarm(FAREWELL_SECONDS);
    if (is_whole) {
        for (int i = 0; i < r->count; ++i) {
            if (*receive_of(r, &r->links[i]) != MPI_REQUEST_NULL) {
                MPI_Cancel(receive_of(r, &r->links[i]));
                MPI_Request_free(receive_of(r, &r->links[i]));
            }
        }
        MPI_Finalize();
    }
    _exit(code);
}

/* ---- The beginning ---- */

static const char usage[] =
    "burnish-mpi: a command of burnish on many machines\n\n"
    "Usage: mpirun --enable-recovery [-n RANKS ...] burnish-mpi [options] COMMAND ARGUMENTS...\n\n"
    "  COMMAND ARGUMENTS...  as of burnish: batch, or render --turntable\n"
    "  --silence=SECONDS     after which a rank is lost (60)\n"
    "  --status=FILE         gets burnish's exit code; mpirun's is 0 with --enable-recovery\n"
    "  --help, --version\n\n"
    "Rank 0 draws too; files are on a file system that all ranks share (docs/scale.md).\n";

/* The rank before MPI knows it; -1: mpirun has not started this process. */
static int number_in(const char *name, int missing) {
    const char *text = getenv(name);
    return text && *text ? atoi(text) : missing;
}

/* Returns the index of the command; 0: there is nothing to do. */
static int read_options(int argc, char **argv, relay *r, int *code) {
    int at = 1;
    *code = 0;
    for (; at < argc && argv[at][0] == '-'; ++at) {
        char *end = NULL;
        if (strcmp(argv[at], "--help") == 0 || strcmp(argv[at], "-h") == 0) {
            fputs(usage, stdout);
            return 0;
        }
        if (strcmp(argv[at], "--version") == 0 || strcmp(argv[at], "-V") == 0) {
            printf("burnish-mpi %s\n", burnish_version());
            return 0;
        }
        if (strncmp(argv[at], "--status=", 9) == 0 && argv[at][9]) {
            r->status_file = argv[at] + 9;
            continue;
        }
        if (strncmp(argv[at], "--silence=", 10) == 0) {
            r->silence = strtod(argv[at] + 10, &end);
        }
        if (!end || *end || !(r->silence >= 0.5 && r->silence <= 1e6)) {
            fprintf(stderr,
                    "burnish-mpi: %.60s: expected --silence=SECONDS, at least 0.5, or "
                    "--status=FILE; see burnish-mpi --help\n",
                    argv[at]);
            *code = 2;
            return 0;
        }
    }
    if (at == argc) {
        fputs("burnish-mpi: no command, as in \"mpirun -n 4 burnish-mpi batch FOLDER -d OUT\"; see "
              "burnish-mpi --help\n",
              stderr);
        *code = 2;
        return 0;
    }
    return at;
}

static int make_links(relay *r) {
    const size_t count = (size_t)(r->count = r->rank == 0 ? r->size - 1 : 1);
    r->links = calloc(count + 1, sizeof *r->links);
    r->requests = calloc(2 * count + 1, sizeof *r->requests);
    r->done = calloc(2 * count + 1, sizeof *r->done);
    r->statuses = calloc(2 * count + 1, sizeof *r->statuses);
    r->ready = calloc(count + 1, sizeof *r->ready);
    int is_made = r->links && r->requests && r->done && r->statuses && r->ready;
    for (size_t i = 0; i < count && is_made; ++i) {
        r->links[i] = (link_state){.peer = r->rank == 0 ? (int)i + 1 : 0,
                                   .socket = -1,
                                   .in = malloc(BUFFER_BYTES),
                                   .out = malloc(BUFFER_BYTES),
                                   .beat = MPI_REQUEST_NULL};
        is_made = r->links[i].in && r->links[i].out;
        r->requests[2 * i] = r->requests[2 * i + 1] = MPI_REQUEST_NULL;
    }
    return is_made ? 1 : fail("out of memory");
}

static void tell_missing(int number) {
    static const char text[] = "burnish-mpi: MPI_Init: not all ranks have come\n";
    (void)number;
    (void)!write(STDERR_FILENO, text, sizeof text - 1);
    _exit(1);
}

static void begin_mpi(relay *r, int argc, char **argv) {
    int rank, size;
    signal(SIGALRM, tell_missing);
    alarm((unsigned)(START_SILENCES * r->silence) + 1);
    MPI_Init(&argc, &argv);
    alarm(0);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (rank != r->rank || size != r->size) {
        fprintf(stderr,
                "burnish-mpi: MPI says rank %d of %d, the environment %d of %d: start it "
                "by Open MPI's mpirun\n",
                rank, size, r->rank, r->size);
        MPI_Abort(MPI_COMM_WORLD, 2);
    }
    for (int i = 0; i < r->count; ++i) {
        r->links[i].heard = now();
        expect(r, &r->links[i]);
    }
}

int main(int argc, char **argv) {
    relay r = {.rank = number_in("OMPI_COMM_WORLD_RANK", 0),
               .size = number_in("OMPI_COMM_WORLD_SIZE", 1),
               .silence = SILENCE_DEFAULT,
               .survives = number_in("OMPI_MCA_orte_enable_recovery", 0) > 0};
    int code;
    const int at = read_options(argc, argv, &r, &code);
    if (at == 0) {
        return code;
    }
    signal(SIGPIPE, SIG_IGN);
    if (!make_links(&r) || !start_child(&r, argc - at, argv + at)) {
        return 1;
    }
    if (r.rank == 0) {
        child_to_stop = (sig_atomic_t)r.child;
        signal(SIGINT, pass_on);
        signal(SIGTERM, pass_on);
        if (r.size > 1 && !r.survives) {
            fputs(
                "burnish-mpi: without mpirun --enable-recovery a rank that dies ends all; the same "
                "command then goes on\n",
                stderr);
        }
    }
    begin_mpi(&r, argc, argv);
    carry(&r);
    return finish(&r);
}
