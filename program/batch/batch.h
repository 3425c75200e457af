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

/* ---- index.c ---- */

/* Before drawing: neither the report nor a file of somebody else is replaced by the page, unless
 * --overwrite was given. Errors: ARGUMENT, MEMORY. */
burnish_status batch_check_index(const batch *b, burnish_error *error);

/* Writes output_dir/index.html. Errors: WRITE, MEMORY. */
burnish_status batch_write_index(const batch *b, burnish_error *error);

/* ---- sheet.c ---- */

/* Writes the contact sheet; a sandboxed process decodes the pictures. Errors: ARGUMENT, FORMAT, WRITE, MEMORY. */
burnish_status batch_write_sheet(const batch *b, burnish_error *error);

/* ---- report.c ---- */

/* Reads the report of an earlier run and, without --report, the reports of parts, oldest first.
 * Missing reports are not an error. Errors: READ, MEMORY. */
burnish_status batch_read_past(batch *b, burnish_error *error);
/* A member of a line: "" or 0 if it has none. */
const char *batch_text(const cJSON *line, const char *key);
double batch_number(const cJSON *line, const char *key);
/* The item's most recent line, or NULL. */
const struct batch_past_line *batch_past_line(const batch_past *past, uint64_t id);
/* Removes the reports of parts after their lines were copied to the report. */
void batch_remove_past_parts(const batch *b);
void batch_release_past(batch_past *past);

/* The report's first line; release with free. NULL: out of memory. */
char *batch_head_line(const batch *b);

/* Writes the whole report, in the order of the items. Errors: WRITE, MEMORY. */
burnish_status batch_write_report(batch *b, burnish_error *error);

/* The line of an item that failed; release with free. NULL: out of memory. */
char *batch_failed_line(const batch *b, const batch_item *item, int code, const char *message,
                        double seconds);
/* Adds a hash as 16 hexadecimal digits. */
void batch_add_hash(cJSON *object, const char *key, uint64_t hash, int *failed);
/* Adds the names of input and output, and the bytes of names that are not UTF-8. */
void batch_add_names(const batch_item *item, cJSON *object, int *failed);
/* Adds the elapsed time, which differs from run to run, unless --no-seconds is set. */
void batch_add_seconds(const batch *b, cJSON *object, double seconds, int *failed);

/* ---- names.c ---- */

/* Gives every item its own output below output_dir and drops duplicate inputs. Errors: ARGUMENT
 * (invalid template, or no distinct names), MEMORY. */
burnish_status batch_name_outputs(batch *b, burnish_error *error);

/* The name of an item's view, which must not be -1. */
const char *batch_view_name(const batch *b, const batch_item *item);

/* ---- cost.c ---- */

/* Keeps only the items of --shard's part. Parts are balanced by cost. Errors: MEMORY. */
burnish_status batch_take_part(batch *b, burnish_error *error);

/* Indices of items, largest input first; release with free. NULL: out of memory. */
uint32_t *batch_order_by_cost(const batch_items *list);

/* ---- workers.c ---- */

/* Draws all pictures except unchanged ones. Errors: MEMORY, WRITE (the report). */
burnish_status batch_run(batch *b, burnish_error *error);

/* ---- runner.c ---- */

/* Runs a runner: receives indices of items from the channel and sends report lines back. */
void batch_runner(const batch *b, int channel);

enum { BATCH_FAILED = 1, BATCH_LATE = 2 };

/* Header of a runner's reply; the line follows. */
typedef struct batch_reply {
    uint32_t index, size, unmet; /* unmet: needs of the input, by number */
    int32_t is_kept, failed;     /* failed: BATCH_FAILED or BATCH_LATE (the output is stale) */
} batch_reply;

/* Hashes the bytes of a regular file. Returns 0 on failure, with errno set. */
int batch_hash_file(const char *path, uint64_t *hash, uint64_t seed);

/* Creates the missing folders of a path. Returns 0 on failure, with errno set. */
int batch_make_folders(const char *path);

/* The whole command. Errors: ARGUMENT, READ, WRITE, MEMORY. */
burnish_status batch_draw(batch_settings *settings, cli_call *call, burnish_error *error);

/* The same for inputs of `burnish render`, without a report unless --json asks for one. */
burnish_status batch_draw_inputs(const render_settings *settings, cli_call *call,
                                 burnish_error *error);

#endif
