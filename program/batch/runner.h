/* A process that draws items, each in a sandboxed worker. */
#ifndef TOOL_BATCH_RUNNER_H
#define TOOL_BATCH_RUNNER_H

#include "batch/types.h"

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

#endif
