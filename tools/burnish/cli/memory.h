/* How the program wants its memory. */
#ifndef BURNISH_TOOL_CLI_MEMORY_H
#define BURNISH_TOOL_CLI_MEMORY_H

/* For commands that draw: call it before the first large allocation, with one thread. */
void burnish_cli_prepare_memory(void);

#endif
