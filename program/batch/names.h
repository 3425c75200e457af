/* The names of outputs. */
#ifndef TOOL_BATCH_NAMES_H
#define TOOL_BATCH_NAMES_H

#include "batch/types.h"

/* Gives every item its own output below output_dir and drops duplicate inputs. Errors: ARGUMENT
 * (invalid template, or no distinct names), MEMORY. */
burnish_status batch_name_outputs(batch *b, burnish_error *error);

/* The name of an item's view, which must not be -1. */
const char *batch_view_name(const batch *b, const batch_item *item);

#endif
