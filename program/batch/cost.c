/* The cost of a picture is estimated by the size of its input file. */
#include <stdlib.h>

#include "batch/batch.h"
#include "batch/types.h"

static const batch_item *items; /* of the list that is being sorted */

static int compare_sizes(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    const uint64_t of_x = items[x].bytes, of_y = items[y].bytes;
    return of_x != of_y ? (of_x < of_y) - (of_x > of_y) : (x > y) - (x < y);
}

uint32_t *batch_order_by_cost(const batch_items *list) {
    uint32_t *order = calloc(list->count, sizeof *order);
    for (uint32_t i = 0; order && i < list->count; ++i) {
        order[i] = i;
    }
    items = list->items;
    if (order) {
        qsort(order, list->count, sizeof *order, compare_sizes);
    }
    return order;
}

/* Items are dealt in snake order: parts take turns, and each round reverses the order. */
static int is_dealt(const batch_part *part, size_t at) {
    const size_t count = (size_t)part->count, seat = at % count;
    return (at / count % 2 ? count - 1 - seat : seat) == (size_t)part->index - 1;
}

burnish_status batch_take_part(batch *b, burnish_error *error) {
    const batch_part *part = &b->settings->part;
    batch_items *list = &b->list;
    size_t kept = 0;
    if (part->count == 0) {
        return BURNISH_STATUS_OK;
    }
    uint32_t *order = batch_order_by_cost(list);
    if (!order) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the list of inputs");
    }
    for (size_t at = 0; at < list->count; ++at) {
        list->items[order[at]].is_in_part = is_dealt(part, at);
    }
    for (size_t i = 0; i < list->count; ++i) {
        batch_item item = list->items[i];
        if (item.is_in_part) {
            list->items[kept++] = item;
        } else {
            free(item.input);
            free(item.output);
        }
    }
    list->count = kept;
    free(order);
    return BURNISH_STATUS_OK;
}
