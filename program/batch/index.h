/* The page of all pictures. */
#ifndef TOOL_BATCH_INDEX_H
#define TOOL_BATCH_INDEX_H

#include "batch/types.h"

/* Before drawing: neither the report nor a file of somebody else is replaced by the page, unless
 * --overwrite was given. Errors: ARGUMENT, MEMORY. */
burnish_status batch_check_index(const batch *b, burnish_error *error);

/* Writes output_dir/index.html. Errors: WRITE, MEMORY. */
burnish_status batch_write_index(const batch *b, burnish_error *error);

#endif
