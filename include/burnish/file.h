/* burnish/file.h: outputs that appear whole or not at all.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_FILE_H
#define BURNISH_FILE_H

#include <stddef.h>

#include "burnish/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes bytes to a file. A new or existing regular file is written to a temporary in the same
 * folder and renamed over it: on any error nothing is left and an existing file is as it was. Links
 * stay links; an existing file keeps its permissions, a new one gets those of the umask. Something
 * else that exists (a device, a pipe) is written directly.
 *   path   the file; "-" is standard output
 *   bytes  what to write; may be NULL when size is 0
 *   size   how many
 *   error  receives the one line of an error; may be NULL
 * Errors: ARGUMENT (path NULL or empty), WRITE; a closed pipe is an error, provided the program
 * ignores SIGPIPE. */
BURNISH_API burnish_status burnish_file_write(const char *path, const void *bytes, size_t size,
                                              burnish_error *error);

/* Fills buffer with the next bytes of an output.
 *   context  as passed to burnish_file_write_stream
 *   buffer   size bytes to fill
 * Returns how many were filled: at most size; 0 ends the output. */
typedef size_t burnish_file_source(void *context, char *buffer, size_t size);

/* The same for an output that is made while it is written, with no more memory than one buffer.
 *   path     the file; "-" is standard output
 *   source   called until it returns 0; not NULL
 *   context  handed to source
 *   error    receives the one line of an error; may be NULL
 * Errors: as burnish_file_write, and MEMORY. */
BURNISH_API burnish_status burnish_file_write_stream(const char *path, burnish_file_source *source,
                                                     void *context, burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
