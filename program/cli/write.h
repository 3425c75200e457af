/* Writing to descriptors. */
#ifndef TOOL_CLI_WRITE_H
#define TOOL_CLI_WRITE_H

#include <stddef.h>

/* All of the bytes, whatever interrupts. Returns 1, or 0 when the other side takes no more. */
int cli_write_all(int descriptor, const void *bytes, size_t size);

#endif
