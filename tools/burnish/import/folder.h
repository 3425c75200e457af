/* Files beside the input, for those who may open them. */
#ifndef TOOL_IMPORT_FOLDER_H
#define TOOL_IMPORT_FOLDER_H

#include "burnish/mesh.h"

/* A descriptor of the input's folder; -1: it has none, or can't be opened. */
int folder_open(const char *input);

/* The whole file `name`, malloc'ed: not above the folder, also by a link, nor anything but a
 * regular file. Errors: READ, LIMIT, MEMORY. */
burnish_status folder_load(int folder, const char *name, uint64_t max_bytes, void **bytes,
                           size_t *size, burnish_error *error);

/* The same for load options; *folder has to stay. */
burnish_file_loader folder_loader(int *folder);

#endif
