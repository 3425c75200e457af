/* A rank's burnish process, which draws. */
#ifndef MPI_CHILD_H
#define MPI_CHILD_H

#include <sys/types.h>

typedef struct child {
    pid_t id;  /* 0: it has ended */
    int state; /* wait status; valid after it has ended */
} child;

/* The command to run: rank 0 has a socket to each other rank, other ranks have one to rank 0. */
typedef struct child_command {
    int rank, count; /* sockets */
    int argc;
    char **argv;
} child_command;

/* Starts the child, before MPI_Init; `sockets` receives the other ends of its sockets. Returns 0 on
 * failure, after printing the reason. */
int child_start(child *c, const child_command *command, int *sockets);

/* Forwards signals that would end this process to the child. */
void child_take_signals(const child *c);

int child_is_gone(child *c);

/* Ends the child; kills it after a second. */
void child_end(child *c);

/* The exit code as in a shell, after the child has ended. */
int child_exit_code(const child *c);

/* ---- Shared helpers ---- */

double seconds_now(void);

/* Prints what failed, and errno's message. Returns 0. */
int report_failure(const char *what);

#endif
