
#ifndef _WIN32

#include <string.h>
#include <unistd.h>

#include "base/beneath.h"
#include "base/cli/options.h"
#include "base/cli/process.h"
#include "import/folder.h"
#include "import/importers.h"
#include "import/load_input.h"
#include "import/run.h"
#include "picture/video.h"
#include "sandbox/channel.h"
#include "sandbox/process.h"

#define DECODE_MAX ((uint64_t)4 << 30) /* most bytes of a stream to decode */

typedef struct broker {
    const sandbox_plan *plan;
    int channel;
    int input;        /* open; -1: none */
    int folder;       /* the input's; -1: it has none */
    int depth;        /* outputs that are being written: one, or the report of one */
    int has_imported; /* 1: an importer has read the input, which is allowed once */
    broker_state state;
} broker;

static burnish_status broker_run(broker *b, burnish_error *error);

/* The first reason to end is kept. */
static void broker_end(broker *b, broker_state state) {
    b->state = b->state == BROKER_SERVES ? state : b->state;
}

/* ---- Messages ---- */

static int broker_reply(broker *b, message_kind kind, uint64_t value, const void *bytes,
                        size_t size) {
    if (b->state == BROKER_SERVES && !channel_send(b->channel, kind, value, bytes, size)) {
        broker_end(b, BROKER_GONE);
    }
    return b->state == BROKER_SERVES;
}

static void reply_status(broker *b, burnish_status status, const burnish_error *error) {
    const char *text = status == BURNISH_STATUS_OK ? "" : error->text;
    broker_reply(b, MESSAGE_DONE, (uint64_t)status, text, strlen(text));
}

static int reply_piece(void *context, const void *bytes, size_t size) {
    return broker_reply(context, MESSAGE_BYTES, 0, bytes, size);
}

static int broker_receive(broker *b, message *head) {
    if (b->state == BROKER_SERVES && !channel_receive(b->channel, head)) {
        broker_end(b, BROKER_GONE);
    }
    return b->state == BROKER_SERVES;
}

/* Receives the body of MESSAGE_DATA, 1 to `capacity` bytes. Returns the size; 0: invalid. */
static size_t receive_data(broker *b, const message *head, char *buffer, size_t capacity) {
    if (head->kind != MESSAGE_DATA || head->size == 0 || head->size > capacity) {
        broker_end(b, BROKER_VIOLATION);
    } else if (!channel_read(b->channel, buffer, (size_t)head->size)) {
        broker_end(b, BROKER_GONE);
    }
    return b->state == BROKER_SERVES ? (size_t)head->size : 0;
}

/* ---- Outputs ---- */

/* An output that is being written. */
typedef struct output {
    broker *b;
    int has_ended;         /* 1: the worker has sent all of it */
    uint64_t left;         /* bytes that it may still send */
    picture_frames frames; /* of a video; without, total is 0 */
} output;

/* Receives bytes of the output; 0 at the end and on errors. */
static size_t take_data(void *context, char *buffer, size_t size) {
    output *o = context;
    message head;
    if (o->has_ended || !broker_receive(o->b, &head)) {
        return 0;
    }
    o->has_ended = head.kind == MESSAGE_END && head.size == 0;
    const size_t count = o->has_ended ? 0 : receive_data(o->b, &head, buffer, size);
    if (count > o->left ||
        (o->frames.total > 0 && !picture_check_frames(&o->frames, buffer, count))) {
        broker_end(o->b, BROKER_VIOLATION);
        return 0;
    }
    o->left -= count;
    return count;
}

/* The worker does the last step: a report, which may be an output too. */
static burnish_status let_finish(void *context, burnish_error *error) {
    const output *o = context;
    broker_reply(o->b, MESSAGE_READY, 0, NULL, 0);
    const burnish_status status = broker_run(o->b, error);
    if (status == BURNISH_STATUS_OK && o->frames.next < o->frames.total) {
        broker_end(o->b, BROKER_VIOLATION);
        return cli_fail(error, BURNISH_STATUS_WRITE, "the last frame is incomplete");
    }
    return status;
}

static int is_planned(const sandbox_plan *plan, const char *path) {
    for (size_t i = 0; i < plan->output_count; ++i) {
        if (plan->outputs[i] && strcmp(plan->outputs[i], path) == 0) {
            return 1;
        }
    }
    return 0;
}

static void write_output(broker *b, const char *path) {
    static char unread[MESSAGE_DATA_MAX];
    burnish_error error = {BURNISH_STATUS_OK, ""};
    const uint64_t most = b->plan->max_memory;
    output o = {.b = b, .left = most > 0 && !b->plan->is_streamed ? most : UINT64_MAX};
    if (!is_planned(b->plan, path) || b->depth == 2) {
        broker_end(b, BROKER_VIOLATION);
        return;
    }
    b->depth += 1;
    const char *container = strcmp(path, b->plan->outputs[0]) == 0 ? b->plan->container : NULL;
    if (container) {
        o.frames = b->plan->frames;
    }
    burnish_status status =
        container ? picture_write_video(container, path, take_data, &o, let_finish, &error)
                  : burnish_file_write_stream(path, take_data, &o, let_finish, &error);
    b->depth -= 1;
    while (take_data(&o, unread, sizeof unread) >
           0) { /* discards an output that can't be written */
    }
    reply_status(b, status, &error);
}

/* ---- Files that the input names ---- */

/* The library never requests a name outside the folder, so such a request comes from a compromised
 * worker. */
static void send_file(broker *b, const char *name, uint64_t max_bytes) {
    const uint64_t own = b->plan->max_input_bytes, most = max_bytes < own ? max_bytes : own;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    uint64_t size;
    int file;
    if (burnish_check_beneath(name) == EXDEV) {
        broker_end(b, BROKER_VIOLATION);
        return;
    }
    burnish_status status = folder_open_file(b->folder, name, most, &file, &size, &error);
    if (b->plan->record_file) {
        b->plan->record_file(b->plan->context, name, file);
    }
    if (status == BURNISH_STATUS_OK) {
        broker_reply(b, MESSAGE_READY, size, NULL, 0);
        status = folder_read(file, name, most, reply_piece, b, &error);
        close(file);
    }
    reply_status(b, status, &error);
}

/* ---- Importers ---- */

static void broker_import(broker *b, uint64_t max_bytes) {
    const uint64_t own = b->plan->max_input_bytes;
    char extension[IMPORT_EXTENSION_SIZE];
    const import_program *importer = import_choose(b->plan->input, b->plan->format, extension);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    if (!importer || b->has_imported) {
        broker_end(b, BROKER_VIOLATION);
        return;
    }
    b->has_imported = 1;
    const burnish_status status =
        import_run_over(importer, extension, b->plan->input, b->input,
                        max_bytes < own ? max_bytes : own, (import_sink){reply_piece, b}, &error);
    reply_status(b, status, &error);
}

/* Neither the input nor the worker's memory can hold more. */
static uint64_t decode_limit(const sandbox_plan *plan) {
    uint64_t most = plan->max_input_bytes < DECODE_MAX ? plan->max_input_bytes : DECODE_MAX;
    return plan->max_memory > 0 && plan->max_memory < most ? plan->max_memory : most;
}

/* Copies the stream to decode into an in-memory file. */
static void broker_decode(broker *b, const char *form, uint64_t size) {
    static char piece[MESSAGE_DATA_MAX];
    burnish_error error = {BURNISH_STATUS_OK, ""};
    const int file = cli_unnamed_file();
    int is_kept = file >= 0 && size <= decode_limit(b->plan);
    message head;
    while (size > 0 && broker_receive(b, &head)) {
        const size_t most = size < sizeof piece ? (size_t)size : sizeof piece;
        const size_t count = receive_data(b, &head, piece, most);
        size -= count;
        is_kept = is_kept && cli_write_all(file, piece, count);
    }
    if (b->state == BROKER_SERVES) {
        const burnish_status status =
            is_kept ? import_decode_file(b->plan->input, form, file, (import_sink){reply_piece, b},
                                         &error)
                    : cli_fail(&error, BURNISH_STATUS_MEMORY,
                               "%.200s: out of memory for the stream to decode", b->plan->input);
        reply_status(b, status, &error);
    }
    if (file >= 0) {
        close(file);
    }
}

/* ---- The loop ---- */

/* Handles one message; an unexpected one is a violation. Returns 1 for the status of a last step. */
static int broker_handle(broker *b, const message *head, const char *text) {
    const int is_text = strlen(text) == head->size;
    if (head->kind == MESSAGE_WRITE && is_text) {
        write_output(b, text);
    } else if (head->kind == MESSAGE_FILE && is_text) {
        send_file(b, text, head->value);
    } else if (head->kind == MESSAGE_IMPORT && head->size == 0) {
        broker_import(b, head->value);
    } else if (head->kind == MESSAGE_DECODE && is_text && import_can_decode(text)) {
        broker_decode(b, text, head->value);
    } else if (head->kind == MESSAGE_STATUS && is_text && b->depth > 0 &&
               head->value < BURNISH_STATUS_COUNT) {
        return 1;
    } else {
        broker_end(b, BROKER_VIOLATION);
    }
    return 0;
}

/* Replies to the worker until it sends the status of a last step, which is returned. WRITE: the worker
 * is gone or has violated the protocol. */
static burnish_status broker_run(broker *b, burnish_error *error) {
    message head;
    while (broker_receive(b, &head)) {
        char text[MESSAGE_NAME_MAX + 1];
        if (head.size > MESSAGE_NAME_MAX) {
            broker_end(b, BROKER_VIOLATION);
        } else if (!channel_read(b->channel, text, (size_t)head.size)) {
            broker_end(b, BROKER_GONE);
        } else {
            text[head.size] = 0;
            if (broker_handle(b, &head, text)) {
                return head.value == BURNISH_STATUS_OK
                           ? BURNISH_STATUS_OK
                           : cli_fail(error, (burnish_status)head.value, "%s", text);
            }
        }
    }
    return cli_fail(error, BURNISH_STATUS_WRITE, "the sandbox's other process has ended");
}

broker_state broker_serve(const sandbox_plan *plan, int channel, int input, int folder) {
    broker b = {.plan = plan, .channel = channel, .input = input, .folder = folder};
    burnish_error error;
    broker_run(&b, &error);
    return b.state;
}

#endif
