/* The worker's side of a sandbox. */
#ifndef TOOL_SANDBOX_WORKER_H
#define TOOL_SANDBOX_WORKER_H

#include "burnish/core.h"

/* Makes this process the worker: import_load uses the descriptor that the broker has opened, and
 * the broker opens referenced files and runs the importer. Affects the whole process, like the
 * sandbox.
 *   channel  to the broker
 *   input    the open input, or -1
 *   folder   of the input, below the one that the broker opens files in; NULL: the same */
void sandbox_become_worker(int channel, int input, const char *folder);

/* Whether this process is a worker. */
int sandbox_is_worker(void);

/* Sandboxes a worker; does nothing in other processes. */
burnish_status sandbox_close(burnish_error *error);

#endif
