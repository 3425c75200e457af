/* Limits of a run that the system keeps. */
#ifndef TOOL_CLI_LIMITS_H
#define TOOL_CLI_LIMITS_H

#include "burnish/core.h"

/* Ends the program after that many seconds by the clock, with one line, exit code 5 and no
 * temporary left; 0: never. Errors: ARGUMENT (this system has no timers). */
burnish_status cli_limit_seconds(double seconds, burnish_error *error);

/* What it was called with; 0: never. */
double cli_seconds_given(void);

/* Memory that the program may have at most, addresses included that it does not touch: what needs
 * more ends as where memory is short, with exit code 6. 0: no limit. Errors: ARGUMENT. */
burnish_status cli_limit_memory(uint64_t bytes, burnish_error *error);

/* Memory that a process may have which is begun for another one's sake, as an importer for the
 * worker of a batch; 0: no limit but its own. */
void cli_set_child_memory(uint64_t bytes);
uint64_t cli_child_memory(void);

/* A process that is ended with the program, or by cli_limit_child_seconds, until cli_wait_child. */
void cli_limit_child(long process);

/* Waits for that process and returns its state, as waitpid does. A timer that expires later has no
 * effect: it neither kills another process that the system gave the same number, nor calls this one
 * late. */
int cli_wait_child(long process);

/* Ends the process of the next cli_limit_child, and not the program, after so many seconds from
 * now; 0: no longer. */
void cli_limit_child_seconds(double seconds);

/* 1: the seconds of the last cli_limit_child_seconds above 0 were over before the process ended. */
int cli_child_was_late(void);

#endif
