#include "sandbox/channel.h"

#ifndef _WIN32

#include <errno.h>
#include <unistd.h>

#include "base/cli/options.h"
#include "base/cli/process.h"

int channel_read(int channel, void *bytes, size_t size) {
    char *next = bytes;
    while (size > 0) {
        const ssize_t count = read(channel, next, size);
        if (count == 0 || (count < 0 && errno != EINTR)) {
            return 0;
        }
        next += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 1;
}

int channel_send(int channel, message_kind kind, uint64_t value, const void *bytes, size_t size) {
    const message head = {.value = value, .size = size, .kind = (uint32_t)kind};
    return cli_write_all(channel, &head, sizeof head) && cli_write_all(channel, bytes, size);
}

int channel_receive(int channel, message *head) {
    return channel_read(channel, head, sizeof *head);
}

int channel_receive_status(int channel, const message *head, burnish_status *status,
                           burnish_error *error) {
    char text[MESSAGE_TEXT_MAX + 1] = "";
    if (head->size > MESSAGE_TEXT_MAX || !channel_read(channel, text, (size_t)head->size)) {
        return 0;
    }
    *status = head->value == BURNISH_STATUS_OK
                  ? BURNISH_STATUS_OK
                  : cli_fail(error, (burnish_status)head->value, "%s", text);
    return 1;
}

int channel_receive_stream(int channel, int (*keep)(void *context, const void *bytes, size_t size),
                           void *context, burnish_status *status, burnish_error *error) {
    static char piece[MESSAGE_DATA_MAX];
    message head = {.kind = 0};
    while (channel_receive(channel, &head) && head.kind == MESSAGE_BYTES) {
        if (head.size > sizeof piece || !channel_read(channel, piece, (size_t)head.size)) {
            return 0;
        }
        keep(context, piece, (size_t)head.size);
    }
    return head.kind == MESSAGE_DONE && channel_receive_status(channel, &head, status, error);
}

#endif
