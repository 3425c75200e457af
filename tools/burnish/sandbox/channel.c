#include "sandbox/channel.h"

#if BURNISH_HAS_SECCOMP

#include <errno.h>
#include <unistd.h>

static int write_fully(int channel, const void *bytes, size_t size) {
    const char *next = bytes;
    while (size > 0) {
        const ssize_t count = write(channel, next, size);
        if (count < 0 && errno != EINTR) {
            return 0;
        }
        next += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 1;
}

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
    return write_fully(channel, &head, sizeof head) && write_fully(channel, bytes, size);
}

int channel_receive(int channel, message *head) {
    return channel_read(channel, head, sizeof *head);
}

#endif
