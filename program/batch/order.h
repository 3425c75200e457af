/* The message that describes an item to a runner. */
#ifndef TOOL_BATCH_ORDER_H
#define TOOL_BATCH_ORDER_H

#include "batch/types.h"

/* An item as a runner receives it. */
typedef struct batch_order {
    batch_item item; /* input, view, output, bytes and id are set; batch_release_order frees it */
    uint32_t index;
    char *past;  /* the line of an earlier run to compare with; NULL: none */
    int is_ours; /* 1: an earlier run has drawn it */
} batch_order;

/* Sets the batch's drawer. */
void batch_hash_drawer(batch *b);

/* Both return 0 when the peer is gone; batch_receive_order also if its version or flags differ. */
int batch_send_order(const batch *b, int channel, uint32_t index);
int batch_receive_order(const batch *b, int channel, batch_order *order);
void batch_release_order(batch_order *order);

#endif
