/* A command in a sandbox: this process becomes the broker, which opens files, and a child does all
 * the rest.
 *
 *   broker: opens the input; waits           worker: opens fonts, locks itself in (lock.h)
 *           writes outputs of its list  <-   draws; its outputs go through a socket
 *           opens files of the input's  <-   asks for material libraries and textures
 *           folder, sends their bytes
 *           runs an importer, sends     <-   asks for it where the input's name says so
 *           what it writes
 *
 * The worker holds the input's descriptor, the socket and the standard streams. The broker parses
 * nothing that comes from the input; it checks lengths, names and that outputs are those of the
 * command line. */
#ifndef TOOL_SANDBOX_SANDBOX_H
#define TOOL_SANDBOX_SANDBOX_H

#include "burnish/mesh.h"
#include "sandbox/lock.h"

enum { SANDBOX_OUTPUTS_MAX = 32 };

typedef struct sandbox_plan {
    const char *input; /* a file, "-", or a built-in object */
    int format;        /* of the input, as --input-format says: which importer may be run */
    const char *outputs[SANDBOX_OUTPUTS_MAX];
    size_t output_count;
    uint64_t max_input_bytes; /* of the input and of each file that it names */
    uint64_t max_memory;      /* of the worker; 0: no limit */
    /* Receives each file that the worker asks for, open for reading, before it is sent; -1: the
     * worker can't have it. NULL: no function. */
    void (*see_file)(void *context, const char *name, int file);
    void *context;
    burnish_error *ended; /* receives the line about a worker that did not end by itself; NULL: goes
                             to standard error */
} sandbox_plan;

/* Forks. In the worker *code is -1, outputs go to the broker from now on, and sandbox_close is to
 * be called once fonts are open. In the broker the worker has ended, and *code is the exit code.
 * Errors: ARGUMENT, READ (the input), MEMORY. */
burnish_status sandbox_begin(const sandbox_plan *plan, int *code, burnish_error *error);

/* The exit code of a process that waitpid tells `state` of; where it did not end by itself, the
 * line about that and the code that goes with it. */
int sandbox_explain_end(int state, burnish_error *line);

/* Whether this is a worker. */
int sandbox_is_worker(void);

/* Locks the worker; nothing elsewhere. */
burnish_status sandbox_close(burnish_error *error);

/* import_load; in a worker by the descriptor that the broker has opened, the files that it hands
 * out and the importer that it runs. */
burnish_status sandbox_load(const char *input, const burnish_load_options *options,
                            burnish_mesh **mesh, burnish_error *error);

#endif
