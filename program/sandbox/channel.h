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
    MESSAGE_END,       /* all of them were sent */
    MESSAGE_STATUS,    /* what the last step said: value is the status, text the error's line */
    MESSAGE_FILE,      /* a file beside the input is wanted: its name; value: the most bytes */
    MESSAGE_IMPORT,    /* an importer is to read the input; value: the most bytes of that */
    MESSAGE_DECODE,    /* an importer is to read `value` bytes, which follow by MESSAGE_DATA */
    /* broker to worker */
    MESSAGE_READY, /* the output is written but for its last step; of a file, value: its size */
    MESSAGE_DONE,  /* value: the status; text: the error's line */
    MESSAGE_BYTES  /* of the file or from the importer, as they come; then MESSAGE_DONE */
} message_kind;

typedef struct message {
    uint64_t value, size; /* size: of what follows */
    uint32_t kind, unused;
} message;

enum { MESSAGE_NAME_MAX = 4096, MESSAGE_DATA_MAX = 1 << 16, MESSAGE_TEXT_MAX = 479 };

/* All of these return 1, or 0 when the other side is gone. */
int channel_send(int channel, message_kind kind, uint64_t value, const void *bytes, size_t size);
int channel_receive(int channel, message *head);

/* All of the bytes. */
int channel_read(int channel, void *bytes, size_t size);

/* What a MESSAGE_DONE says: *status, and the error's line. */
int channel_take_status(int channel, const message *head, burnish_status *status,
                        burnish_error *error);

/* Any number of MESSAGE_BYTES, each handed to `keep`, whatever that returns, and MESSAGE_DONE. */
int channel_take_stream(int channel, int (*keep)(void *context, const void *bytes, size_t size),
                        void *context, burnish_status *status, burnish_error *error);

#endif
