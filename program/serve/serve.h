/* `burnish serve-stdio`: reads requests from standard input and writes pictures to standard output.
 *
 *   server.c  frames and processes: passes each request to an idle worker and writes the worker's
 *             reply. It parses only the length of a request
 *   import.c  runs an importer for a worker, in a process that the server forks
 *   worker.c  a process for one request: enters the sandbox before it receives the request, then
 *             parses it, draws as `burnish render` does, and writes the reply
 *
 * A frame is {uint32 length, uint32 id}, little-endian, and `length` bytes: a line of
 * JSON, then data as described in docs/serve.md. */
#ifndef TOOL_SERVE_SERVE_H
#define TOOL_SERVE_SERVE_H

#include "render/settings/settings.h"

typedef struct serve_settings {
    render_settings render; /* first: the server accepts its flags, as defaults for every request */
    int jobs;               /* 0: as many as there are processors */
    int no_sandbox;
    uint64_t max_request_bytes;
} serve_settings;

/* Replies to requests until standard input ends. Errors: FORMAT (invalid frame), READ, WRITE,
 * MEMORY (no process), ARGUMENT (no sandbox). */
burnish_status serve_run(const serve_settings *settings, burnish_error *error);

enum { SERVE_HEAD_BYTES = 8, SERVE_LINE_MAX = 1 << 16 };

/* The flags that a request may contain: render's, except those reserved for the operator. */
extern const cli_command serve_request_command;

#endif
