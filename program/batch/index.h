/* The page of all pictures. */
#ifndef TOOL_BATCH_INDEX_H
#define TOOL_BATCH_INDEX_H

#include "batch/types.h"

/* Writes output_dir/index.html. Errors: WRITE, MEMORY. */
burnish_status batch_write_index(const batch *b, burnish_error *error);

#endif
