/* Orders describe an item to a runner. The runner may be on another machine, without the list of
 * items and with another version of the program. */
#include <stdlib.h>
#include <string.h>

#include "batch/order.h"
#include "batch/report.h"
#include "batch/types.h"

#ifndef _WIN32

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/cli/write.h"
#include "sandbox/channel.h"

enum { TEXT_MAX = 1 << 24 };

typedef struct head {
    uint64_t drawer; /* hash of version, flags and files of flags */
    uint64_t id, bytes;
    uint32_t index;
    int32_t view, is_ours;
    uint32_t input_size, output_size, past_size;
} head;

void batch_hash_drawer(batch *b) {
    char *line = batch_head_line(b);
    b->drawer = line ? XXH64(line, strlen(line), sizeof(head)) : 0;
    free(line);
}

int batch_send_order(const batch *b, int channel, uint32_t index) {
    const batch_item *item = &b->list.items[index];
    const struct batch_past_line *found = batch_past_line(&b->past, item->id);
    const char *past = found && found->is_same && !b->settings->force ? found->line : "";
    const size_t input_size = strlen(item->input), output_size = strlen(item->output);
    const size_t past_size = strlen(past);
    const head h = {.drawer = b->drawer,
                    .id = item->id,
                    .bytes = item->bytes,
                    .index = index,
                    .view = item->view,
                    .is_ours = found != NULL,
                    .input_size = (uint32_t)input_size,
                    .output_size = (uint32_t)output_size,
                    .past_size = (uint32_t)past_size};
    const size_t size = sizeof h + input_size + output_size + past_size;
    char *bytes = malloc(size);
    if (!bytes) {
        return 0;
    }
    memcpy(bytes, &h, sizeof h);
    memcpy(bytes + sizeof h, item->input, input_size);
    memcpy(bytes + sizeof h + input_size, item->output, output_size);
    memcpy(bytes + sizeof h + input_size + output_size, past, past_size);
    const int is_sent = cli_write_all(channel, bytes, size);
    free(bytes);
    return is_sent;
}

/* NULL where the other side is gone, and without memory. */
static char *receive_text(int channel, uint32_t size) {
    char *text = size <= TEXT_MAX ? malloc((size_t)size + 1) : NULL;
    if (text && !channel_read(channel, text, size)) {
        free(text);
        text = NULL;
    }
    if (text) {
        text[size] = 0;
    }
    return text;
}

int batch_receive_order(const batch *b, int channel, batch_order *order) {
    head h;
    *order = (batch_order){0};
    if (!channel_read(channel, &h, sizeof h)) {
        return 0;
    }
    if (h.drawer != b->drawer || h.view >= (int32_t)b->settings->render.picture.views.count) {
        fprintf(
            stderr,
            "burnish: --runner: burnish %s here is another version, or has other flags or other "
            "files of flags, than the batch; install the same everywhere\n",
            burnish_version());
        return 0;
    }
    order->index = h.index;
    order->is_ours = h.is_ours;
    order->item.id = h.id;
    order->item.bytes = h.bytes;
    order->item.view = h.view;
    order->item.input = receive_text(channel, h.input_size);
    order->item.output = order->item.input ? receive_text(channel, h.output_size) : NULL;
    order->past = order->item.output ? receive_text(channel, h.past_size) : NULL;
    if (!order->past) {
        batch_release_order(order);
        return 0;
    }
    if (h.past_size == 0) {
        free(order->past);
        order->past = NULL;
    }
    return 1;
}

void batch_release_order(batch_order *order) {
    free(order->item.input);
    free(order->item.output);
    free(order->past);
    *order = (batch_order){0};
}

#endif
