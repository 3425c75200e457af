/* `burnish batch`: a picture of each of many inputs.
 *
 *   inputs.c  operands, folders and lists -> items        names.c  -> an output for each item
 *   cost.c    largest first, and parts of a batch for tasks that know nothing of each other
 *   pool.c    hands items to runners, as many as there are cores and those that --runners brings
 *             from other machines, and keeps lines
 *   order.c   what a runner is told of an item, for it may be elsewhere
 *   runner.c  a process for each core: looks whether an item is unchanged, and else forks a locked
 *             worker for it (sandbox/), which draws as `burnish render` does
 *   report.c  a line of JSON per item: what it is, and what the next run asks to leave it
 *   index.c, sheet.c  a page and a sheet of all pictures
 *
 *   many.c    the door for `burnish render` with many inputs
 *
 * A file's worker is a process of its own; nothing that it writes is parsed by the others. */
#ifndef TOOL_BATCH_BATCH_H
#define TOOL_BATCH_BATCH_H

#include <stdio.h>

#include "cli/output.h"
#include "render/settings.h"

/* Part index, from 1 on, of count; 0 of 0: all. */
typedef struct batch_part {
    int index, count;
} batch_part;

typedef struct batch_settings {
    render_settings render; /* first: its flags are ours too */
    const char *output;     /* template of the pictures' names */
    const char *output_dir;
    const char *files_from; /* NULL: none */
    const char *report;     /* NULL: in output_dir */
    const char *sheet;      /* NULL: none */
    int recursive, jobs, force, index, no_sandbox, no_seconds;
    batch_part part;
    int runners;       /* sockets from descriptor 3 on that lead to runners elsewhere */
    int runner;        /* 1: this is such a runner */
    int has_no_report; /* 1: none is written */
} batch_settings;

/* A picture that is to be made. */
typedef struct batch_item {
    char *input;
    size_t tree;    /* from here on the input's folders are kept in the output's */
    int view;       /* index of the one view that is drawn; -1: all, on a sheet */
    int level;      /* how much of the input's name its output's has: batch_name_outputs */
    char *output;   /* with output_dir */
    uint64_t bytes; /* of the input */
    uint64_t id;    /* of input and output, in reports */
    char *line;     /* of the report; NULL: not done yet */
    int is_kept;    /* 1: unchanged since an earlier run */
    int has_failed;
    uint8_t held; /* by so many runners */
    uint8_t lost; /* so often with the machine that held it */
} batch_item;

typedef struct batch_items {
    batch_item *items;
    size_t count, capacity;
} batch_items;

/* Earlier reports. */
typedef struct batch_past {
    char **texts, **paths; /* text_count of each; paths NULL for the report itself */
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
    char *options;   /* the flags that say what is drawn, as they were typed */
    char *report;    /* the report's path; NULL: none */
    uint64_t drawer; /* of version and options: runners have the same */
    batch_past past;
    size_t done, kept, failed;
    size_t passed_over; /* files of folders that are no meshes, whatever their endings say */
    int is_stopped;     /* 1: by a signal */
} batch;

/* The whole command. Errors: ARGUMENT, READ, WRITE, MEMORY. */
burnish_status batch_draw(batch_settings *settings, cli_call *call, burnish_error *error);

/* Adds what the operands and --files-from name. Errors: ARGUMENT, READ, MEMORY. */
burnish_status batch_collect(batch *b, const cli_call *call, burnish_error *error);

/* Gives every item an output below output_dir that no other has, and drops items that are there
 * twice. Errors: ARGUMENT (a template or two inputs that allow none), MEMORY. */
burnish_status batch_name_outputs(batch *b, burnish_error *error);

/* What is behind the last slash of a path. */
const char *batch_base_name(const char *path);

/* The view of an item that has one. */
const char *batch_view_name(const batch *b, const batch_item *item);

/* Leaves the items of --shard in the list, as equal in cost as they can be. Errors: MEMORY. */
burnish_status batch_take_part(batch *b, burnish_error *error);

/* Indices of items, those with most bytes first; to be freed. NULL without memory. */
uint32_t *batch_order_by_cost(const batch_items *list);

/* Reads the report of an earlier run and, where --report does not say otherwise, those of parts,
 * oldest first; none is no error. Errors: READ, MEMORY. */
burnish_status batch_read_past(batch *b, burnish_error *error);
/* The last line of an item there, or NULL. */
const struct batch_past_line *batch_past_line(const batch_past *past, uint64_t id);
/* Removes the reports of parts that were read, whose lines the report has now. */
void batch_remove_past_parts(const batch *b);
void batch_release_past(batch_past *past);

/* The report's first line; to be freed. NULL without memory. */
char *batch_head_line(const batch *b);

/* Writes the whole report, in the order of the items. Errors: WRITE, MEMORY. */
burnish_status batch_write_report(const batch *b, burnish_error *error);

/* Makes all pictures that are not unchanged. Errors: MEMORY, WRITE (the report). */
burnish_status batch_run(batch *b, burnish_error *error);

/* A runner's whole life: takes orders from the channel, sends lines back. */
void batch_runner(const batch *b, int channel);

/* What a runner knows of an item. */
typedef struct batch_order {
    batch_item item; /* input, view, output, bytes, id; the texts are to be freed */
    uint32_t index;
    char *past;  /* the line of an earlier run that may still be true; NULL: none; to be freed */
    int is_ours; /* 1: an earlier run has drawn it */
} batch_order;

/* Sets the batch's drawer. */
void batch_hash_drawer(batch *b);

/* 0: the other side is gone or, of taking, not of this version or these flags. */
int batch_send_order(const batch *b, int channel, uint32_t index);
int batch_take_order(const batch *b, int channel, batch_order *order);
void batch_release_order(batch_order *order);

enum { BATCH_FAILED = 1, BATCH_LATE = 2 };

/* What a runner sends, before the line. */
typedef struct batch_answer {
    uint32_t index, size;
    int32_t is_kept, failed; /* BATCH_...; LATE: what is at the output is not of these bytes */
} batch_answer;

/* The line of an item that failed; to be freed, NULL without memory. */
char *batch_failed_line(const batch *b, const batch_item *item, int code, const char *message,
                        double seconds);
/* Adds the names of input and output; of those that are not UTF-8 their bytes too. */
void batch_add_names(const batch_item *item, cJSON *object, int *failed);
/* Adds the one number that differs from run to run, unless it is not wanted. */
void batch_add_seconds(const batch *b, cJSON *object, double seconds, int *failed);

/* Creates the folders of a path that are missing; 0: it can't, with errno. */
int batch_make_folders(const char *path);

/* The page, index.html in output_dir. Errors: WRITE, MEMORY. */
burnish_status batch_write_index(const batch *b, burnish_error *error);

/* The sheet, decoded and laid out in a locked process. Errors: ARGUMENT, FORMAT, WRITE, MEMORY. */
burnish_status batch_write_sheet(const batch *b, burnish_error *error);

#endif
