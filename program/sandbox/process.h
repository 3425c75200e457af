/* Runs a command in a sandbox: this process becomes the broker, which opens files, and a child does
 * the rest.
 *
 *   broker: opens the input; waits           worker: opens fonts, enters the sandbox (lock.h)
 *           writes outputs of its list  <-   draws; its outputs go through a socket
 *           opens files of the input's  <-   requests material libraries and textures
 *           folder, sends their bytes
 *           runs an importer, sends     <-   requests it if the file extension needs one
 *           what it writes
 *
 * The worker holds the input's descriptor, the socket and the standard streams. The broker parses
 * nothing from the input; it checks lengths and names, that outputs were on the command line and
 * are not larger than the worker's memory, and that ffmpeg gets only frames. */
#ifndef TOOL_SANDBOX_PROCESS_H
#define TOOL_SANDBOX_PROCESS_H

#include "burnish/core.h"
#include "burnish/mesh.h"
#include "picture/video.h"

enum { SANDBOX_OUTPUTS_MAX = 32 };

typedef struct sandbox_plan {
    const char *input; /* a file, "-", or a built-in object */
    const char *root;  /* the folder of files that the input refers to; NULL: the input's */
    int format;        /* the value of --input-format, which selects the importer */
    const char *outputs[SANDBOX_OUTPUTS_MAX];
    size_t output_count;
    const char *container;    /* of the video that the first output becomes; NULL: no video */
    picture_frames frames;    /* of the video */
    uint64_t max_input_bytes; /* of the input and of each file that it names */
    uint64_t max_memory;      /* of the worker; 0: no limit */
    int is_streamed;          /* 0: outputs are complete in the worker's memory before they come */
    /* Called with each file that the worker requests, open for reading, before it is sent; -1: the
     * file is not available. NULL: no callback. */
    void (*record_file)(void *context, const char *name, int file);
    void *context;
    burnish_error
        *ended; /* receives the message about a worker that was killed; NULL: standard error */
} sandbox_plan;

/* Forks. In the worker, *code is -1 and outputs go to the broker; call sandbox_close after fonts are
 * open. In the broker, the worker has ended and *code is the exit code.
 * Errors: ARGUMENT, READ (the input), MEMORY. */
burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error);

/* ---- end.c ---- */

/* The exit code for a wait status; if the process was killed, the message and its exit code. */
int sandbox_describe_end(int state, burnish_error *line);

/* ---- broker.c ---- */

typedef enum broker_state {
    BROKER_SERVES,
    BROKER_GONE, /* the worker has closed the channel */
    BROKER_VIOLATION /* the worker has broken the protocol, or requested what a sound worker never does */
} broker_state;

/* Replies to a worker's messages (channel.h) until it is gone or violates the protocol; returns which.
 * The broker needs 256 KiB whatever the worker sends, and memory for streams to decode within the
 * plan's limits.
 *   channel  a stream socket
 *   input    the open input, for importers; -1: none
 *   folder   the input's folder; -1: none */
broker_state broker_serve(const sandbox_plan *plan, int channel, int input, int folder);

#endif
