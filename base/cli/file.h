/* Where the program's outputs go: to files or, in a sandbox, to the process that writes them. */
#ifndef BASE_CLI_FILE_H
#define BASE_CLI_FILE_H

#include "burnish/core.h"

/* As burnish_file_write_stream. */
typedef burnish_status cli_file_writer(const char *path, burnish_file_source *source, void *context,
                                       burnish_file_check *ready, burnish_error *error);

/* Sets the writer that the functions below use from now on, for the whole process. NULL: files. */
void cli_file_set_writer(cli_file_writer *writer);

/* As burnish_file_write, burnish_file_write_checked and burnish_file_write_stream. */
burnish_status cli_file_write(const char *path, const void *bytes, size_t size,
                              burnish_error *error);
burnish_status cli_file_write_checked(const char *path, const void *bytes, size_t size,
                                      burnish_file_check *ready, void *context,
                                      burnish_error *error);
burnish_status cli_file_write_stream(const char *path, burnish_file_source *source, void *context,
                                     burnish_file_check *ready, burnish_error *error);

#endif
