/* A line of JSON per item, from which the next run detects unchanged items. */
#ifndef TOOL_BATCH_REPORT_H
#define TOOL_BATCH_REPORT_H

#include "batch/types.h"

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

#endif
