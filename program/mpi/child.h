/* The other process of a rank: burnish, which draws. */
#ifndef MPI_CHILD_H
#define MPI_CHILD_H

#include <sys/types.h>

typedef struct child {
    pid_t id;  /* 0: it is gone */
    int state; /* wait status; valid when it is gone */
} child;

/* What it is to do: the command and its arguments, on rank 0 with a socket to each other rank, on
 * those with one to rank 0. */
typedef struct child_command {
    int rank, count; /* sockets */
    int argc;
    char **argv;
} child_command;

/* Starts it, before MPI begins; sockets gets the other ends of its sockets. Returns 0, and tells
 * why, where that fails. */
int child_start(child *c, const child_command *command, int *sockets);

/* Signals that would end this process go to the child from now on. */
void child_take_signals(const child *c);

int child_is_gone(child *c);

/* Ends it, by force after a second. */
void child_end(child *c);

/* As a shell has it; of one that is gone. */
int child_exit_code(const child *c);

/* ---- What all parts use ---- */

double seconds_now(void);

/* Prints what failed and why, by errno. Returns 0. */
int tell_failure(const char *what);

#endif
