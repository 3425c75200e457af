#include "sandbox/channel.h"

#ifndef _WIN32

#include <errno.h>
#include <unistd.h>

#include "cli/write.h"

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

#endif
