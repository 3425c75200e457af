/* The contact sheet of all pictures. */
#ifndef TOOL_BATCH_SHEET_H
#define TOOL_BATCH_SHEET_H

#include "batch/types.h"

/* Writes the contact sheet; a sandboxed process decodes the pictures. Errors: ARGUMENT, FORMAT, WRITE, MEMORY. */
burnish_status batch_write_sheet(const batch *b, burnish_error *error);

#endif
