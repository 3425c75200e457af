/* Importers for workers: the worker requests one, the server runs it. */
#ifndef TOOL_SERVE_IMPORT_H
#define TOOL_SERVE_IMPORT_H

#include "import/importers.h"
#include "serve/serve.h"

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

/* Runs an importer in a forked process, with the descriptors of a worker.
 */
__attribute__((noreturn)) void serve_run_importer(const serve_settings *settings,
                                                  const serve_import_request *import,
                                                  uint64_t request_size);

#endif
