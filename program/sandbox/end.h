/* How a process ended. */
#ifndef TOOL_SANDBOX_END_H
#define TOOL_SANDBOX_END_H

#include "burnish/core.h"

/* The exit code for a wait status; if the process was killed, the message and its exit code. */
int sandbox_describe_end(int state, burnish_error *line);

#endif
