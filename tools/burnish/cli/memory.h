/* How the program wants its memory. */
#ifndef TOOL_CLI_MEMORY_H
#define TOOL_CLI_MEMORY_H

/* For commands that draw: call it before the first large allocation, with one thread. */
void cli_prepare_memory(void);

#endif
