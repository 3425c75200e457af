/* The cost of drawing items: their order, and parts of a batch for independent tasks. */
#ifndef TOOL_BATCH_COST_H
#define TOOL_BATCH_COST_H

#include "batch/types.h"

/* Keeps only the items of --shard's part. Parts are balanced by cost. Errors: MEMORY. */
burnish_status batch_take_part(batch *b, burnish_error *error);

/* Indices of items, largest input first; release with free. NULL: out of memory. */
uint32_t *batch_order_by_cost(const batch_items *list);

#endif
