/* Writing a whole output: a file that appears complete or not at all, or standard output. */
#ifndef BURNISH_CORE_OUTPUT_H
#define BURNISH_CORE_OUTPUT_H

#include <stddef.h>

#include "burnish/core.h"

/* Writes size bytes to path. "-" is standard output. A new or existing regular file is written to a
 * temporary in the same folder and renamed over it: on any error nothing is left and an existing
 * file is as it was; the same when the process is killed, where the file system has files without
 * names (O_TMPFILE). Links stay links (one to nothing is replaced); an existing file keeps its
 * permissions, a new one gets those of the umask. Something else that exists (a device, a pipe) is
 * written directly. bytes may be NULL when size is 0. A closed pipe is an error, provided the
 * program ignores SIGPIPE. Errors: ARGUMENT (path NULL or empty), WRITE. */
burnish_status burnish_write_file(const char *path, const void *bytes, size_t size,
                                  burnish_error *error);

#endif
