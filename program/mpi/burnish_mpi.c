/* burnish-mpi: runs a burnish command on many machines, started by mpirun.
 *
 * Every rank has two processes. One is burnish, which draws and does not use MPI: on rank 0 with
 * --runners=N, on other ranks with --runner. The other is this program, which opens no files: it
 * relays bytes between the sockets of rank 0's burnish and the socket of each other rank. So a
 * crash or lack of memory does not hit an MPI process, and nothing is forked after MPI_Init.
 *
 * Ranks send heartbeats. A rank that is silent for too long is lost: its socket is closed, and
 * burnish hands its items to others. Nothing blocks on a rank, so a dead one can't delay the rest. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "burnish/core.h"
#include "relay.h"

enum {
    SILENCE_DEFAULT = 60, /* seconds */
    START_SILENCES = 10,  /* times the silence: limit for the start of all ranks */
    FAREWELL_SECONDS = 10 /* limit for the shutdown */
};

/* Settings from the command line and mpirun. */
typedef struct run {
    relay relay;
    const char *status_file; /* NULL: none */
    int survives;            /* 1: mpirun goes on when a rank dies */
} run;

/* ---- The beginning ---- */

static const char usage[] =
    "burnish-mpi: run a burnish command on many machines\n\n"
    "Usage: mpirun --enable-recovery [-n RANKS ...] burnish-mpi [options] COMMAND ARGUMENTS...\n\n"
    "  COMMAND ARGUMENTS...  as for burnish: batch, or render to a PNG or a --turntable\n"
    "  --silence=SECONDS     time without a heartbeat after which a rank is lost (60)\n"
    "  --status=FILE         write burnish's exit code; mpirun's is 0 with --enable-recovery\n"
    "  --help, --version\n\n"
    "Rank 0 also draws. All ranks must share a file system (docs/scale.md).\n";

static int number_in(const char *name, int missing) {
    const char *text = getenv(name);
    return text && *text ? atoi(text) : missing;
}

/* Reads rank and size before MPI_Init: from mpirun, or from Slurm's srun if it supports PMIx; else
 * the only rank. Returns 0 for tasks of an srun without PMIx, which would all draw the same. */
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
                  ? "burnish-mpi: started by srun without PMIx: use srun --mpi=pmix, or mpirun\n"
                  : "",
              stderr);
        return 0;
    }
    return 1;
}

/* Returns the index of the command; 0: nothing to do. */
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

static void report_missing(int number) {
    static const char text[] = "burnish-mpi: MPI_Init: not all ranks have started\n";
    (void)number;
    (void)!write(STDERR_FILENO, text, sizeof text - 1);
    _exit(1);
}

static void begin_mpi(relay *r, int argc, char **argv) {
    int rank, size;
    signal(SIGALRM, report_missing);
    alarm((unsigned)(START_SILENCES * r->silence) + 1);
    MPI_Init(&argc, &argv);
    alarm(0);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (rank != r->rank || size != r->size) {
        fprintf(stderr,
                "burnish-mpi: MPI reports rank %d of %d, the environment %d of %d: start it with "
                "Open MPI's mpirun or srun --mpi=pmix\n",
                rank, size, r->rank, r->size);
        MPI_Abort(MPI_COMM_WORLD, 2);
    }
    relay_begin(r);
}

/* Creates the links and starts the child. */
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
        report_failure(r->status_file);
    }
}

/* MPI_Finalize waits for all ranks and would block on a lost one. */
static int finish(run *r) {
    relay *to = &r->relay;
    int code = to->rank == 0 ? child_exit_code(&to->child) : 0;
    if (to->rank == 0) {
        write_status(r, code);
        code = r->survives ? 0 : code; /* since mpirun would report another error as its own */
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
            fputs("burnish-mpi: without mpirun --enable-recovery, a rank that dies ends all ranks; "
                  "run the same command again to continue\n",
                  stderr);
        }
    }
    begin_mpi(&r.relay, argc, argv);
    relay_carry(&r.relay);
    return finish(&r);
}
