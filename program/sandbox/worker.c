#include "sandbox/worker.h"

#include "import/load_input.h"
#include "import/run.h"

#if BURNISH_HAS_SECCOMP

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/file.h"
#include "base/cli/options.h"
#include "import/folder.h"
#include "sandbox/channel.h"
#include "sandbox/lock.h"

static int broker = -1, input_file = -1;

static burnish_status fail_broker(burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_WRITE, "the sandbox's other process has ended");
}

/* ---- Outputs ---- */

static burnish_status take_status(const message *head, burnish_error *error) {
    burnish_status status;
    return channel_receive_status(broker, head, &status, error) ? status : fail_broker(error);
}

static int send_status(burnish_status status, const burnish_error *error) {
    const char *text = status == BURNISH_STATUS_OK ? "" : error->text;
    return channel_send(broker, MESSAGE_STATUS, (uint64_t)status, text, strlen(text));
}

static burnish_status write_by_broker(const char *path, burnish_file_source *source, void *context,
                                      burnish_file_check *ready, burnish_error *error) {
    char *const buffer = malloc(MESSAGE_DATA_MAX); /* static memory faults page by page */
    message head;
    size_t size;
    if (!buffer) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the output");
    }
    int is_there = channel_send(broker, MESSAGE_WRITE, 0, path, strlen(path));
    while (is_there && (size = source(context, buffer, MESSAGE_DATA_MAX)) > 0) {
        is_there = channel_send(broker, MESSAGE_DATA, 0, buffer, size);
    }
    free(buffer);
    is_there =
        is_there && channel_send(broker, MESSAGE_END, 0, NULL, 0) && channel_receive(broker, &head);
    if (is_there && head.kind == MESSAGE_READY) {
        burnish_error reason = {BURNISH_STATUS_OK, ""};
        const burnish_status status = ready ? ready(context, &reason) : BURNISH_STATUS_OK;
        is_there = send_status(status, &reason) && channel_receive(broker, &head);
    }
    return is_there && head.kind == MESSAGE_DONE ? take_status(&head, error) : fail_broker(error);
}

/* ---- Files that the input names ---- */

static burnish_status load_by_broker(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    import_stream stream = {0};
    burnish_status status;
    message head;
    (void)user_data;
    if (strlen(name) > MESSAGE_NAME_MAX) {
        return folder_fail(name, ENAMETOOLONG, error);
    }
    if (!channel_send(broker, MESSAGE_FILE, max_bytes, name, strlen(name)) ||
        !channel_receive(broker, &head)) {
        return fail_broker(error);
    }
    if (head.kind != MESSAGE_READY) {
        return take_status(&head, error);
    }
    import_expect(&stream, head.value);
    if (!channel_receive_stream(broker, import_keep, &stream, &status, error)) {
        status = fail_broker(error);
    } else if (status == BURNISH_STATUS_OK && stream.is_short) {
        status = folder_fail_memory(name, head.value, error);
    }
    if (status != BURNISH_STATUS_OK) {
        free(stream.bytes);
        return status;
    }
    *bytes = stream.bytes;
    *size = stream.size;
    return status;
}

/* ---- The worker ---- */

int sandbox_is_worker(void) {
    return broker >= 0;
}

burnish_status sandbox_close(burnish_error *error) {
    static char buffer[1 << 16]; /* stdio would call fstat on standard output */
    if (!sandbox_is_worker()) {
        return BURNISH_STATUS_OK;
    }
    burnish_processor_count(); /* reads files, once */
    setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    const char *wall;
    const int code = sandbox_lock((broker > input_file ? broker : input_file) + 1, 0, &wall);
    return code == 0
               ? BURNISH_STATUS_OK
               : cli_fail(
                     error, BURNISH_STATUS_ARGUMENT,
                     "--sandbox: this system can't create a sandbox (%s: %s); use --no-sandbox",
                     wall, strerror(code));
}

/* Receives the importer's stream from the broker. */
static burnish_status take_stream(import_stream *stream, burnish_error *error) {
    burnish_status status;
    return channel_receive_stream(broker, import_keep, stream, &status, error) ? status
                                                                               : fail_broker(error);
}

static burnish_status decode_by_broker(const char *name, const char *form, const void *bytes,
                                       size_t size, import_stream *stream, burnish_error *error) {
    const char *next = bytes;
    (void)name;
    int is_there = channel_send(broker, MESSAGE_DECODE, size, form, strlen(form));
    while (is_there && size > 0) {
        const size_t part = size < MESSAGE_DATA_MAX ? size : MESSAGE_DATA_MAX;
        is_there = channel_send(broker, MESSAGE_DATA, 0, next, part);
        next += part;
        size -= part;
    }
    return is_there ? take_stream(stream, error) : fail_broker(error);
}

static burnish_status import_by_broker(const import_program *importer, const char *extension,
                                       const char *input, uint64_t max_bytes, import_stream *stream,
                                       burnish_error *error) {
    (void)importer, (void)extension, (void)input; /* the broker has chosen them, too */
    return channel_send(broker, MESSAGE_IMPORT, max_bytes, NULL, 0) ? take_stream(stream, error)
                                                                    : fail_broker(error);
}

/* Reads the descriptor that the broker has opened; there is none of standard input. */
static burnish_status load_input(const char *input, const burnish_load_options *options,
                                 burnish_mesh **mesh, burnish_error *error) {
    return input_file < 0 ? burnish_mesh_load(input, options, mesh, error)
                          : burnish_mesh_load_descriptor(input_file, input, options, mesh, error);
}

static burnish_file_loader list_files(const char *input) {
    return strcmp(input, "-") == 0 ? (burnish_file_loader){0}
                                   : (burnish_file_loader){load_by_broker, folder_release, NULL};
}

void sandbox_become_worker(int channel, int input, const char *folder) {
    static import_source source = {load_input, import_by_broker, list_files, decode_by_broker,
                                   NULL};
    source.folder = folder;
    broker = channel;
    input_file = input;
    cli_file_set_writer(write_by_broker);
    import_set_source(&source);
}

#else

int sandbox_is_worker(void) {
    return 0;
}

burnish_status sandbox_close(burnish_error *error) {
    (void)error;
    return BURNISH_STATUS_OK;
}

#endif
