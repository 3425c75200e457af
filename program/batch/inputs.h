/* Operands, folders and lists of names become items. */
#ifndef TOOL_BATCH_INPUTS_H
#define TOOL_BATCH_INPUTS_H

#include "batch/types.h"

/* Adds the inputs from operands and --files-from. Errors: ARGUMENT, READ, MEMORY. */
burnish_status batch_collect(batch *b, const cli_call *call, burnish_error *error);

/* Prints what is not obvious about the inputs: folders that were not searched. */
void batch_warn_inputs(const batch *b);

#endif
