/* Files that an input names: in its folder or below. Messages are those of the library, which opens
 * such files itself if there is no importer and no sandbox. */
#ifndef TOOL_IMPORT_FOLDER_H
#define TOOL_IMPORT_FOLDER_H

#include "burnish/mesh.h"
#include "import/import.h"

/* A descriptor of the input's folder; -1: it has none, or can't be opened. */
int folder_open(const char *input);

/* Opens the regular file `name`; neither ".." nor a link leads out of the folder.
 *   folder  -1: no file is found
 *   file    receives a descriptor, to be closed
 *   size    receives its size; the file may change
 * Errors: READ, LIMIT (more than max_bytes). */
burnish_status folder_open_file(int folder, const char *name, uint64_t max_bytes, int *file,
                                uint64_t *size, burnish_error *error);

/* Hands the bytes of an open file to `take`, piece by piece, from its start. Errors: READ, LIMIT
 * (the file has grown beyond max_bytes), MEMORY (take returned 0). */
burnish_status folder_read(int file, const char *name, uint64_t max_bytes, import_taker *take,
                           void *context, burnish_error *error);

/* The errors of a file that can't be opened, by its errno, and of one there is no memory for. */
burnish_status folder_fail(const char *name, int code, burnish_error *error);
burnish_status folder_fail_memory(const char *name, uint64_t bytes, burnish_error *error);

/* Both steps as a loader for load options; *folder has to stay. */
burnish_file_loader folder_loader(int *folder);

#endif
