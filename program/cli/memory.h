/* Memory of commands that draw. */
#ifndef TOOL_CLI_MEMORY_H
#define TOOL_CLI_MEMORY_H

/* For commands that draw: makes memory cheap to allocate. Call it before the first large
 * allocation, with one thread. */
void cli_prepare_memory(void);

#endif
