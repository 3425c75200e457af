/* Messages between broker and worker. */
#ifndef TOOL_SANDBOX_CHANNEL_H
#define TOOL_SANDBOX_CHANNEL_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"

typedef enum message_kind {
    /* worker to broker */
    MESSAGE_WRITE = 1, /* an output begins: its name */
    MESSAGE_DATA,      /* bytes of it */
    MESSAGE_END,       /* the output is complete */
    MESSAGE_STATUS,    /* result of the last step; value: the status; text: the error message */
    MESSAGE_FILE,      /* request for a referenced file: its name; value: size limit */
    MESSAGE_IMPORT,    /* request to import the input; value: size limit */
    MESSAGE_DECODE,    /* request to decode `value` bytes, which follow as MESSAGE_DATA: the form */
    /* broker to worker */
    MESSAGE_READY, /* the output needs only its last step; for a file, value: its size */
    MESSAGE_DONE,  /* value: the status; text: the error message */
    MESSAGE_BYTES  /* a piece of a file or an importer's stream; MESSAGE_DONE follows the last */
} message_kind;

typedef struct message {
    uint64_t value, size; /* size: of the body that follows */
    uint32_t kind, unused;
} message;

enum { MESSAGE_NAME_MAX = 4096, MESSAGE_DATA_MAX = 1 << 16, MESSAGE_TEXT_MAX = 479 };

/* All functions return 1, or 0 when the peer is gone. */
int channel_send(int channel, message_kind kind, uint64_t value, const void *bytes, size_t size);
int channel_receive(int channel, message *head);

/* Reads exactly `size` bytes. */
int channel_read(int channel, void *bytes, size_t size);

/* Receives the body of a MESSAGE_DONE: *status and the error message. */
int channel_receive_status(int channel, const message *head, burnish_status *status,
                           burnish_error *error);

/* Receives MESSAGE_BYTES up to MESSAGE_DONE and passes each to `keep`, whose result is ignored. */
int channel_receive_stream(int channel, int (*keep)(void *context, const void *bytes, size_t size),
                           void *context, burnish_status *status, burnish_error *error);

#endif
