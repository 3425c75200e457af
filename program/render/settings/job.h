/* How a run is carried out: inputs, processes, threads, limits and messages. */
#ifndef TOOL_RENDER_SETTINGS_JOB_H
#define TOOL_RENDER_SETTINGS_JOB_H

#include "base/cli/values.h"

struct render_result;

typedef struct render_job_settings {
    const char *files_from; /* NULL: all inputs are operands */
    int recursive;          /* 1: includes folders in folders */
    int threads;            /* 0: all */
    const char *isa_name;   /* as the flag says */
    burnish_isa isa;
    int sandbox;
    cli_real max_overdraw, max_seconds;
    uint64_t max_memory; /* 0: no limit */
    int timing, quiet;
    int is_one_of_many; /* 1: a batch warns about flags itself */

    /* Receives the result once the picture is drawn, before the file is in place; NULL: none. */
    void (*on_result)(void *user_data, const struct render_result *result);
    void *user_data;
} render_job_settings;

#endif
