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

#include "import/importers.h"
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

/* ---- import.c ---- */

/* A worker's request, at most once, to run an importer on part of the frame. The reply has the form
 * of the broker's reply to MESSAGE_IMPORT (sandbox/channel.h). */
typedef struct serve_import_request {
    uint64_t offset, size; /* of the mesh in the frame */
    int32_t format;        /* burnish_format or cli_foreign */
    char name[244];        /* of the mesh, or the end of a long name */
} serve_import_request;

/* In the worker: receives the stream of a mesh for which import_choose found an importer. */
burnish_status serve_import(const char *input, int format, uint64_t offset, uint64_t size,
                            import_stream *stream, burnish_error *error);

/* In the server: receives an import request without blocking. PENDING: nothing yet; ENDED: the
 * worker has closed the channel; INVALID: anything else. */
enum { SERVE_PENDING, SERVE_ENDED, SERVE_IMPORT, SERVE_INVALID };
int serve_receive_import(int channel, serve_import_request *import);

/* Runs an importer in a forked process, with the descriptors of a worker. */
__attribute__((noreturn)) void serve_run_importer(const serve_settings *settings,
                                                  const serve_import_request *import,
                                                  uint64_t request_size);

/* ---- worker.c ---- */

/* A worker's descriptors. Its standard streams are /dev/null. */
enum {
    SERVE_CHANNEL = 3, /* the worker sends a byte when ready and receives the request's size */
    SERVE_REQUEST,     /* a file with the frame's bytes */
    SERVE_REPLY,       /* a file for the reply, or for the reason why the worker could not start */
    SERVE_DESCRIPTORS
};

/* Runs a worker. The process exits with 0 when the reply is complete. */
__attribute__((noreturn)) void serve_work(const serve_settings *settings);

/* The line of a failed request, without a newline; release with free. NULL: out of memory.
 *   report  a JSON object in one line, or NULL */
char *serve_failed_line(int code, const char *message, const char *report);

#endif
