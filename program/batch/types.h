/* A batch: its settings, items and earlier reports. */
#ifndef TOOL_BATCH_TYPES_H
#define TOOL_BATCH_TYPES_H

#include <stdio.h>

#include "base/cli/output.h"
#include "render/settings/settings.h"

/* Units of length by the names of burnish_mesh_info.unit: symbols, and lengths in millimetres. The
 * first is unknown. */
typedef struct batch_unit {
    const char *name, *symbol;
    double millimeters;
} batch_unit;
enum { BATCH_UNITS = 7 };
extern const batch_unit batch_units[BATCH_UNITS];

/* Part `index` of `count`, counted from 1; 0 of 0 means all. */
typedef struct batch_part {
    int index, count;
    int is_rank; /* 1: taken from the environment that mpirun or srun sets */
} batch_part;

typedef struct batch_settings {
    render_settings render; /* first: its flags are ours too */
    const char *output;     /* template for output names */
    const char *output_dir;
    const char *files_from; /* NULL: none */
    const char *report;     /* NULL: in output_dir */
    const char *sheet;      /* NULL: none */
    const char *title;      /* of the page; NULL: the folder's name */
    int unit;               /* of files that state none, as a number of batch_units */
    int recursive, jobs, force, index, no_sandbox, no_seconds;
    batch_part part;
    int has_no_report; /* 1: no report is written */
    int is_render;     /* 1: the report has the lines of `burnish render --json`, and no others */
    cli_given given;   /* flags that render does not have */
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
    int is_in_part; /* 1: this part of the batch draws it */
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
    char *options;         /* the flags that affect pictures, as typed */
    uint64_t options_hash; /* of the files that these name, in order; 0: none */
    char *report;          /* the report's path; NULL: none */
    batch_past past;
    size_t done, kept, failed;
    size_t passed_over; /* files with a mesh extension that are not meshes */
    size_t folders;     /* INPUTs that are folders */
    size_t skipped;     /* folders in them that were not searched */
    unsigned unmet;     /* needs of flags that no drawn input meets, by number */
    int is_stopped;     /* 1: by a signal */
} batch;

#endif
