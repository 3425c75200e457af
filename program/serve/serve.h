/* `burnish serve-stdio`: pictures by request, from standard input to standard output.
 *
 *   server.c  frames and processes: hands each request to a worker that waits for it, and hands
 *             out what the worker leaves. It parses nothing of a request but its length
 *   import.c  how a worker has an importer run, by a process that the server forks for it
 *   worker.c  a process of one request: starts and locks itself in before there is one, then
 *             parses, draws as `burnish render` does, and leaves the answer
 *
 * A frame is {uint32 length, uint32 id}, little-endian, and `length` bytes: a line of JSON, and
 * what docs/serve.md says behind it. */
#ifndef TOOL_SERVE_SERVE_H
#define TOOL_SERVE_SERVE_H

#include "render/settings.h"

typedef struct serve_settings {
    render_settings render; /* first: its flags are ours too, and the defaults of every request */
    int jobs;               /* 0: as many as there are processors */
    int no_sandbox;
    uint64_t max_request_bytes;
} serve_settings;

enum { SERVE_HEAD_BYTES = 8, SERVE_LINE_MAX = 1 << 16 };

/* The flags that a request may have: render's, without those that an operator sets. */
extern const cli_command serve_request_command;

/* Answers requests until standard input ends. Errors: FORMAT (what is no frame), READ, WRITE,
 * MEMORY (no process), ARGUMENT (no sandbox). */
burnish_status serve_run(const serve_settings *settings, burnish_error *error);

/* A worker's descriptors, beside the standard streams, which are closed to it. */
enum {
    SERVE_CHANNEL = 3, /* gives a byte when the worker is ready, takes the size of the request */
    SERVE_REQUEST,     /* a file with the frame's bytes */
    SERVE_ANSWER,      /* an empty file for those of the answer, or for the line about why there
                          can be no worker */
    SERVE_DESCRIPTORS
};

/* What a worker may say while it has a request, once: an importer is to read some of its bytes. The
 * answer is that of a broker to MESSAGE_IMPORT (sandbox/channel.h). */
typedef struct serve_wish {
    uint64_t offset, size; /* of the mesh in the frame */
    int32_t format;        /* burnish_format or cli_foreign */
    char name[244];        /* the mesh's, or its end: for its ending and messages */
} serve_wish;

/* In the worker: import_load of such bytes, where import_choose has an importer. Textures come from
 * options->referenced_files. */
burnish_status serve_import(const char *input, uint64_t offset, uint64_t size,
                            const burnish_load_options *options, burnish_mesh **mesh,
                            burnish_error *error);

/* In the server: what a worker that has a request says, without waiting. */
enum { SERVE_NOTHING, SERVE_ENDED, SERVE_WISH, SERVE_NONSENSE };
int serve_hear_wish(int channel, serve_wish *wish);

/* The whole life of a process with a worker's channel and request, at the descriptors of a worker.
 */
__attribute__((noreturn)) void serve_run_importer(const serve_settings *settings,
                                                  const serve_wish *wish, uint64_t request_size);

/* The process's whole life. It ends with 0 when the answer is whole. */
__attribute__((noreturn)) void serve_work(const serve_settings *settings);

/* The line of a request that has failed, without a newline; to be freed, NULL without memory.
 *   report  a JSON object in one line, or NULL */
char *serve_failed_line(int code, const char *message, const char *report);

#endif
