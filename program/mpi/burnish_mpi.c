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
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "burnish/core.h"
#include "relay.h"

enum {
    SILENCE_DEFAULT = 60, /* seconds */
    START_SILENCES = 10,  /* until all ranks have to be there */
    FAREWELL_SECONDS = 10 /* for what has to do with the end */
};

/* What the command line and mpirun say. */
typedef struct run {
    relay relay;
    const char *status_file; /* NULL: none */
    int survives;            /* 1: mpirun goes on when a rank dies */
} run;

/* ---- The beginning ---- */

static const char usage[] =
    "burnish-mpi: a command of burnish on many machines\n\n"
    "Usage: mpirun --enable-recovery [-n RANKS ...] burnish-mpi [options] COMMAND ARGUMENTS...\n\n"
    "  COMMAND ARGUMENTS...  as of burnish: batch, or render of a PNG or a --turntable\n"
    "  --silence=SECONDS     after which a rank is lost (60)\n"
    "  --status=FILE         gets burnish's exit code; mpirun's is 0 with --enable-recovery\n"
    "  --help, --version\n\n"
    "Rank 0 draws too; files are on a file system that all ranks share (docs/scale.md).\n";

static int number_in(const char *name, int missing) {
    const char *text = getenv(name);
    return text && *text ? atoi(text) : missing;
}

/* Rank and size before MPI knows them: of mpirun, or of Slurm's srun where that speaks PMIx. Alone
 * without either. Returns 0 for tasks of srun that could not find each other, and would all draw
 * the same. */
static int find_rank(relay *r) {
    r->rank = number_in("OMPI_COMM_WORLD_RANK", 0);
    r->size = number_in("OMPI_COMM_WORLD_SIZE", 0);
    if (r->size > 0) {
        return 1;
    }
    const char *rank = getenv("PMIX_RANK");
    r->size = number_in("SLURM_STEP_NUM_TASKS", 1);
    r->rank = number_in("SLURM_PROCID", 0);
    if (r->size <= 1) {
        r->size = 1;
        r->rank = 0;
    } else if (!rank || atoi(rank) != r->rank) {
        fputs(r->rank == 0
                  ? "burnish-mpi: srun starts it without PMIx: use srun --mpi=pmix, or mpirun\n"
                  : "",
              stderr);
        return 0;
    }
    return 1;
}

/* Returns the index of the command; 0: there is nothing to do. */
static int read_options(int argc, char **argv, run *r, int *code) {
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
            r->relay.silence = strtod(argv[at] + 10, &end);
        }
        if (!end || *end || !(r->relay.silence >= 0.5 && r->relay.silence <= 1e6)) {
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
                "by Open MPI's mpirun, or srun --mpi=pmix\n",
                rank, size, r->rank, r->size);
        MPI_Abort(MPI_COMM_WORLD, 2);
    }
    relay_begin(r);
}

/* Links, and the child at their ends. */
static int begin(run *r, int argc, char **argv) {
    relay *to = &r->relay;
    if (!relay_create(to)) {
        return 0;
    }
    const child_command command = {to->rank, to->count, argc, argv};
    int *sockets = calloc((size_t)to->count + 1, sizeof *sockets);
    const int is_begun = sockets && child_start(&to->child, &command, sockets);
    for (int i = 0; is_begun && i < to->count; ++i) {
        to->links[i].socket = sockets[i];
    }
    free(sockets);
    return is_begun;
}

/* ---- The end ---- */

static int code_at_alarm;

static void leave(int number) {
    (void)number;
    _exit(code_at_alarm);
}

static void write_status(const run *r, int code) {
    FILE *file = r->status_file ? fopen(r->status_file, "w") : NULL;
    if (r->status_file && (!file || fprintf(file, "%d\n", code) < 0 || fclose(file) != 0)) {
        tell_failure(r->status_file);
    }
}

/* MPI_Finalize waits for all ranks, and one that is lost would never come. */
static int finish(run *r) {
    relay *to = &r->relay;
    int code = to->rank == 0 ? child_exit_code(&to->child) : 0;
    if (to->rank == 0) {
        write_status(r, code);
        code = r->survives ? 0 : code; /* which mpirun would call an error of its own, and drop */
    }
    const int is_whole = relay_end(to);
    if (to->rank > 0) {
        child_end(&to->child);
    }
    fflush(NULL);
    code_at_alarm = code;
    signal(SIGALRM, leave);
    alarm(FAREWELL_SECONDS);
    if (is_whole) {
        relay_cancel(to);
        MPI_Finalize();
    }
    _exit(code);
}

int main(int argc, char **argv) {
    run r = {.relay = {.silence = SILENCE_DEFAULT},
             .survives = number_in("OMPI_MCA_orte_enable_recovery", 0) > 0};
    int code;
    const int at = read_options(argc, argv, &r, &code);
    if (at == 0) {
        return code;
    }
    if (!find_rank(&r.relay)) {
        return 2;
    }
    signal(SIGPIPE, SIG_IGN);
    if (!begin(&r, argc - at, argv + at)) {
        return 1;
    }
    if (r.relay.rank == 0) {
        child_take_signals(&r.relay.child);
        if (r.relay.size > 1 && !r.survives) {
            fputs(
                "burnish-mpi: without mpirun --enable-recovery a rank that dies ends all; the same "
                "command then goes on\n",
                stderr);
        }
    }
    begin_mpi(&r.relay, argc, argv);
    relay_carry(&r.relay);
    return finish(&r);
}
