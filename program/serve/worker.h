/* A process for one request. */
#ifndef TOOL_SERVE_WORKER_H
#define TOOL_SERVE_WORKER_H

#include "serve/serve.h"

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
