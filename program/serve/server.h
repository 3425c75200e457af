/* The server: frames and processes. */
#ifndef TOOL_SERVE_SERVER_H
#define TOOL_SERVE_SERVER_H

#include "serve/serve.h"

/* Replies to requests until standard input ends. Errors: FORMAT (invalid frame), READ, WRITE,
 * MEMORY (no process), ARGUMENT (no sandbox). */
burnish_status serve_run(const serve_settings *settings, burnish_error *error);

#endif
