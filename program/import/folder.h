/* Files that an input references, in its folder or below. Messages match the library's, which opens
 * such files itself without an importer or a sandbox. */
#ifndef TOOL_IMPORT_FOLDER_H
#define TOOL_IMPORT_FOLDER_H

#include "burnish/mesh.h"
#include "import/run.h"

/* Opens the root, or the input's folder if that is NULL, and finds the path from it to the input's
 * folder: "" or "a/b".
 *   folder  receives a descriptor; -1: no folder, or it can't be opened
 *   below   is `path`, with room for BURNISH_INPUT_PATH bytes, or NULL without a root
 * Errors: ARGUMENT (the root does not contain the input). */
burnish_status folder_open(const char *input, const char *root, int *folder, char *path,
                           const char **below, burnish_error *error);

/* Opens the regular file `name`; ".." and links can't lead out of the folder.
 *   folder  -1: no file is found
 *   file    receives a descriptor, to be closed
 *   size    receives its size; the file may change
 * Errors: READ, LIMIT (more than max_bytes). */
burnish_status folder_open_file(int folder, const char *name, uint64_t max_bytes, int *file,
                                uint64_t *size, burnish_error *error);

/* Passes the bytes of an open file to `take`, in pieces, from the start. Errors: READ, LIMIT
 * (the file has grown beyond max_bytes), MEMORY (take returned 0). */
burnish_status folder_read(int file, const char *name, uint64_t max_bytes, import_taker *take,
                           void *context, burnish_error *error);

/* Errors for a file that can't be opened, by errno, and for a file that does not fit in memory. */
burnish_status folder_fail(const char *name, int code, burnish_error *error);
burnish_status folder_fail_memory(const char *name, uint64_t bytes, burnish_error *error);

/* Both steps as a loader for load options; *folder must outlive it. */
burnish_file_loader folder_loader(int *folder);
void folder_release(void *user_data, const void *bytes, size_t size);

#endif
