/* `burnish batch`: draws a picture of each input.
 *
 *   inputs.c  operands, folders and lists -> items        names.c  -> an output for each item
 *   cost.c    largest first, and parts of a batch for independent tasks
 *   pool.c    hands items to runners, one per core and those on other machines (--runners), and
 *             collects their lines
 *   order.c   the message that describes an item to a runner, which may be on another machine
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

#include <stdio.h>

#include "cli/output.h"
#include "render/settings/settings.h"

/* Part `index` of `count`, counted from 1; 0 of 0 means all. */
typedef struct batch_part {
    int index, count;
} batch_part;

typedef struct batch_settings {
    render_settings render; /* first: its flags are ours too */
    const char *output;     /* template for output names */
    const char *output_dir;
    const char *files_from; /* NULL: none */
    const char *report;     /* NULL: in output_dir */
    const char *sheet;      /* NULL: none */
    int recursive, jobs, force, index, no_sandbox, no_seconds;
    batch_part part;
    int runners;       /* sockets to runners on other machines, from descriptor 3 on */
    int runner;        /* 1: this process is such a runner */
    int has_no_report; /* 1: no report is written */
} batch_settings;

/* A picture to draw. */
typedef struct batch_item {
    char *input;
    size_t tree;    /* offset in `input` of the folders that the output keeps */
    int view;       /* index of the view to draw; -1: all views, on one sheet */
    int level;      /* how much of the input's name is in the output's; see names.c */
    char *output;   /* path, including output_dir */
    uint64_t bytes; /* of the input */
    uint64_t id;    /* of input and output, in reports */
    char *line;     /* report line; NULL: not done yet */
    int is_kept;    /* 1: unchanged since an earlier run */
    int has_failed;
    uint8_t held; /* number of runners that have it */
    uint8_t lost; /* number of machines that were lost while drawing it */
} batch_item;

typedef struct batch_items {
    batch_item *items;
    size_t count, capacity;
} batch_items;

/* Earlier reports. */
typedef struct batch_past {
    char **texts, **paths; /* text_count entries each; the path is NULL for the report itself */
    size_t text_count;
    struct batch_past_line {
        uint64_t id;
        const char *line;
        uint32_t number; /* in the order of the reports */
        int is_same;     /* 1: drawn with the same flags by the same version */
    } * lines;           /* ascending by id, then number */
    size_t count, capacity;
} batch_past;

typedef struct batch {
    const batch_settings *settings;
    batch_items list;
    char *options;   /* the flags that affect pictures, as typed */
    char *report;    /* the report's path; NULL: none */
    uint64_t drawer; /* hash of version and options; a runner's must be equal */
    batch_past past;
    size_t done, kept, failed;
    size_t passed_over; /* files with a mesh extension that are not meshes */
    int is_stopped;     /* 1: by a signal */
} batch;

/* The whole command. Errors: ARGUMENT, READ, WRITE, MEMORY. */
burnish_status batch_draw(batch_settings *settings, cli_call *call, burnish_error *error);

/* Adds the inputs from operands and --files-from. Errors: ARGUMENT, READ, MEMORY. */
burnish_status batch_collect(batch *b, const cli_call *call, burnish_error *error);

/* Gives every item its own output below output_dir and drops duplicate inputs. Errors: ARGUMENT
 * (invalid template, or no distinct names), MEMORY. */
burnish_status batch_name_outputs(batch *b, burnish_error *error);

/* The part of a path after its last slash. */
const char *batch_base_name(const char *path);

/* The name of an item's view, which must not be -1. */
const char *batch_view_name(const batch *b, const batch_item *item);

/* Keeps only the items of --shard's part. Parts are balanced by cost. Errors: MEMORY. */
burnish_status batch_take_part(batch *b, burnish_error *error);

/* Indices of items, largest input first; release with free. NULL: out of memory. */
uint32_t *batch_order_by_cost(const batch_items *list);

/* Reads the report of an earlier run and, without --report, the reports of parts, oldest first.
 * Missing reports are not an error. Errors: READ, MEMORY. */
burnish_status batch_read_past(batch *b, burnish_error *error);
/* The item's most recent line, or NULL. */
const struct batch_past_line *batch_past_line(const batch_past *past, uint64_t id);
/* Removes the reports of parts after their lines were copied to the report. */
void batch_remove_past_parts(const batch *b);
void batch_release_past(batch_past *past);

/* The report's first line; release with free. NULL: out of memory. */
char *batch_head_line(const batch *b);

/* Writes the whole report, in the order of the items. Errors: WRITE, MEMORY. */
burnish_status batch_write_report(const batch *b, burnish_error *error);

/* Draws all pictures except unchanged ones. Errors: MEMORY, WRITE (the report). */
burnish_status batch_run(batch *b, burnish_error *error);

/* Runs a runner: receives orders from the channel and sends report lines back. */
void batch_runner(const batch *b, int channel);

/* An item as a runner receives it. */
typedef struct batch_order {
    batch_item item; /* input, view, output, bytes and id are set; batch_release_order frees it */
    uint32_t index;
    char *past;  /* the line of an earlier run to compare with; NULL: none */
    int is_ours; /* 1: an earlier run has drawn it */
} batch_order;

/* Sets the batch's drawer. */
void batch_hash_drawer(batch *b);

/* Both return 0 when the peer is gone; batch_receive_order also if its version or flags differ. */
int batch_send_order(const batch *b, int channel, uint32_t index);
int batch_receive_order(const batch *b, int channel, batch_order *order);
void batch_release_order(batch_order *order);

enum { BATCH_FAILED = 1, BATCH_LATE = 2 };

/* Header of a runner's reply; the line follows. */
typedef struct batch_answer {
    uint32_t index, size;
    int32_t is_kept, failed; /* failed: BATCH_FAILED or BATCH_LATE (the output is stale) */
} batch_answer;

/* The line of an item that failed; release with free. NULL: out of memory. */
char *batch_failed_line(const batch *b, const batch_item *item, int code, const char *message,
                        double seconds);
/* Adds the names of input and output, and the bytes of names that are not UTF-8. */
void batch_add_names(const batch_item *item, cJSON *object, int *failed);
/* Adds the elapsed time, which differs from run to run, unless --no-seconds is set. */
void batch_add_seconds(const batch *b, cJSON *object, double seconds, int *failed);

/* Creates the missing folders of a path. Returns 0 on failure, with errno set. */
int batch_make_folders(const char *path);

/* Writes output_dir/index.html. Errors: WRITE, MEMORY. */
burnish_status batch_write_index(const batch *b, burnish_error *error);

/* Writes the contact sheet; a sandboxed process decodes the pictures. Errors: ARGUMENT, FORMAT, WRITE, MEMORY. */
burnish_status batch_write_sheet(const batch *b, burnish_error *error);

#endif
