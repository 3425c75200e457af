/* Writing to descriptors. */
#ifndef BASE_CLI_WRITE_H
#define BASE_CLI_WRITE_H

#include <stddef.h>

/* Writes all bytes, also after interrupted calls. Returns 1, or 0 if writing fails. */
int cli_write_all(int descriptor, const void *bytes, size_t size);

/* A descriptor of an empty unnamed file; -1: failed. */
int cli_unnamed_file(void);

#endif
