/* Importers for requests. A worker can't start processes: it sends a request to the server,
 * which forks a process that runs the importer and passes the stream to the worker. Only the
 * importer parses the mesh, and only the worker parses the stream. */
#include "serve/serve.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "cli/limits.h"
#include "import/importers.h"
#include "import/run.h"
#include "sandbox/channel.h"

/* ---- The worker ---- */

burnish_status serve_import(const char *input, int format, uint64_t offset, uint64_t size,
                            import_stream *stream, burnish_error *error) {
    serve_import_request import = {.offset = offset, .size = size, .format = format};
    const size_t length = strlen(input), shown = sizeof import.name - 1;
    if (length > shown) { /* keep the end, with the extension */
        input += length - shown;
    }
    memcpy(import.name, input, strlen(input));
    burnish_status status;
    if (!cli_write_all(SERVE_CHANNEL, &import, sizeof import) ||
        !channel_receive_stream(SERVE_CHANNEL, import_keep, stream, &status, error)) {
        status = cli_fail(error, BURNISH_STATUS_READ, "the server's importer has ended");
    }
    return status;
}

/* ---- The server ---- */

int serve_receive_import(int channel, serve_import_request *import) {
    const ssize_t size = recv(channel, import, sizeof *import, MSG_DONTWAIT);
    import->name[sizeof import->name - 1] = 0;
    return size == 0                         ? SERVE_ENDED
           : size == (ssize_t)sizeof *import ? SERVE_IMPORT
           : size < 0 && errno == EAGAIN     ? SERVE_PENDING
           : size < 0 && errno == EINTR      ? SERVE_PENDING
                                             : SERVE_INVALID;
}

/* Copies the mesh's bytes to a file of their own. */
static int copy_mesh(const serve_import_request *import, uint64_t request_size, int request) {
    static char piece[MESSAGE_DATA_MAX];
    const int file = cli_unnamed_file();
    uint64_t left = import->size;
    off_t next = (off_t)import->offset;
    if (file < 0 || import->offset > request_size || import->size > request_size - import->offset) {
        return -1;
    }
    while (left > 0) {
        const size_t most = left < sizeof piece ? (size_t)left : sizeof piece;
        const ssize_t size = pread(request, piece, most, next);
        if (size <= 0 || !cli_write_all(file, piece, (size_t)size)) {
            return -1;
        }
        left -= (uint64_t)size;
        next += size;
    }
    return file;
}

static int send_piece(void *context, const void *bytes, size_t size) {
    (void)context;
    return channel_send(SERVE_CHANNEL, MESSAGE_BYTES, 0, bytes, size);
}

void serve_run_importer(const serve_settings *settings, const serve_import_request *import,
                        uint64_t request_size) {
    char extension[IMPORT_EXTENSION_SIZE];
    burnish_error error = {BURNISH_STATUS_OK, ""};
    const import_program *importer = import_choose(import->name, import->format, extension);
    const int file = importer ? copy_mesh(import, request_size, SERVE_REQUEST) : -1;
    cli_limit_worker(settings->render.job.max_seconds.value);
    cli_set_child_memory(settings->render.job.max_memory);
    const burnish_status status = file < 0
                                      ? cli_fail(&error, BURNISH_STATUS_MEMORY,
                                                 "%.200s: no room for an importer", import->name)
                                      : import_run(importer, import->name, extension, file,
                                                   settings->render.input.load.max_input_bytes,
                                                   (import_sink){send_piece, NULL}, &error);
    channel_send(SERVE_CHANNEL, MESSAGE_DONE, (uint64_t)status, error.text,
                 status == BURNISH_STATUS_OK ? 0 : strlen(error.text));
    _exit(0);
}

#endif
