/* The cost of a picture is estimated by the size of its input file. */
#include <stdlib.h>

#include "batch/batch.h"
#include "batch/types.h"

typedef struct sized {
    uint64_t bytes;
    uint32_t index;
} sized;

static int compare_sizes(const void *a, const void *b) {
    const sized *x = a, *y = b;
    return x->bytes != y->bytes ? (x->bytes < y->bytes) - (x->bytes > y->bytes)
                                : (x->index > y->index) - (x->index < y->index);
}

uint32_t *batch_order_by_cost(const batch_items *list) {
    sized *items = calloc(list->count, sizeof *items);
    uint32_t *order = calloc(list->count, sizeof *order);
    for (size_t i = 0; items && i < list->count; ++i) {
        items[i] = (sized){list->items[i].bytes, (uint32_t)i};
    }
    if (items && order) {
        qsort(items, list->count, sizeof *items, compare_sizes);
        for (size_t i = 0; i < list->count; ++i) {
            order[i] = items[i].index;
        }
    } else {
        free(order);
        order = NULL;
    }
    free(items);
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
