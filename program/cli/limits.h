/* Limits of a run that the system enforces, and its memory. */
#ifndef TOOL_CLI_LIMITS_H
#define TOOL_CLI_LIMITS_H

#include "burnish/core.h"

typedef enum cli_lateness { CLI_NOT_LATE, CLI_LATE_WALL, CLI_LATE_PROCESSOR } cli_lateness;

/* Ends the program after that many seconds of processor time, of all its threads, or ten times that
 * in wall-clock time, with one line and exit code 5, and removes temporary files; 0: no limit.
 * Errors: ARGUMENT (this system has no timers). */
burnish_status cli_limit_seconds(double seconds, burnish_error *error);

/* Ends this process by SIGPROF after that many seconds of processor time; its parent waits for it and
 * limits wall-clock time. 0: no limit. On Windows neither this nor limits of children are defined. */
void cli_limit_worker(double seconds);

/* The limit in seconds of processor time; 0: none. */
double cli_seconds_given(void);

/* The limit of wall-clock time that goes with one of processor time. */
double cli_wall_seconds(double seconds);

/* The error of a process that was late, for a limit in seconds of processor time: LIMIT. */
burnish_status cli_fail_late(cli_lateness lateness, double seconds, burnish_error *error);

/* Limits the address space of the program, in bytes. A run that needs more ends with exit code 6,
 * as if memory were short. 0: no limit. Errors: ARGUMENT. */
burnish_status cli_limit_memory(uint64_t bytes, burnish_error *error);

/* Lowers a limit of the system (RLIMIT_...) for this process, for good; a lower one stays. Not on
 * Windows. */
void cli_lower_limit(int what, uint64_t most);

/* Limits the memory of processes that are started for another process, such as an importer for a
 * worker of a batch, in bytes; 0: no additional limit. */
void cli_set_child_memory(uint64_t bytes);
uint64_t cli_child_memory(void);

/* Registers a process that ends with the program or by cli_limit_child_seconds, until
 * cli_wait_child. */
void cli_limit_child(long process);

/* Waits for that process and returns its state, as waitpid does. A timer that expires later has no
 * effect: it does not kill another process with the same number, and this one does not count as
 * late. */
int cli_wait_child(long process);

/* Ends the process of the next cli_limit_child, not the program, ten times this many seconds from
 * now; the process calls cli_limit_worker. 0: cancels the limit. */
void cli_limit_child_seconds(double seconds);

/* Whether the last limit of cli_limit_child_seconds expired before the process ended. */
cli_lateness cli_child_was_late(void);

/* For commands that draw: makes memory cheap to allocate. Call it before the first large
 * allocation, with one thread. */
void cli_prepare_memory(void);

/* For processes that fork others again and again: takes all free pieces of memory, which would be
 * reused in each child, at the price of a copied page for each. */
void cli_prepare_forks(void);

#endif
