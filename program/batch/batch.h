/* `burnish batch`: draws a picture of each input.
 *
 *   inputs.c  operands, folders and lists -> items        names.c  -> an output for each item
 *   cost.c    largest first, and parts of a batch for independent tasks
 *   workers.c hands items to runners, one per core, and collects their lines
 *   runner.c  one process per core: skips an unchanged item, else forks a sandboxed worker for it
 *             (sandbox/), which draws as `burnish render` does
 *   report.c  a line of JSON per item, from which the next run detects unchanged items
 *   index.c, sheet.c  a page and a contact sheet of all pictures
 *
 *   many.c    `burnish render` with many inputs
 *
 * Each file has its own worker process. No other process parses what a worker writes. */
#ifndef TOOL_BATCH_BATCH_H
#define TOOL_BATCH_BATCH_H

#include "batch/types.h"

/* The whole command. Errors: ARGUMENT, READ, WRITE, MEMORY. */
burnish_status batch_draw(batch_settings *settings, cli_call *call, burnish_error *error);

/* The same for inputs of `burnish render`, without a report unless --json asks for one. */
burnish_status batch_draw_inputs(const render_settings *settings, cli_call *call,
                                 burnish_error *error);

#endif
