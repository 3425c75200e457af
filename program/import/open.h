/* Opens inputs for importers. */
#ifndef TOOL_IMPORT_OPEN_H
#define TOOL_IMPORT_OPEN_H

#include "burnish/core.h"

/* Opens an input for import_run. Standard input ("-") is copied to an unnamed file if it is not a
 * file or was partly read. At most max_bytes and 1 GiB are copied, since a stream may be endless. Errors: READ, LIMIT, MEMORY. */
burnish_status import_open(const char *path, uint64_t max_bytes, int *input, burnish_error *error);

#endif
