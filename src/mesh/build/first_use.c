/* Triangles that are neighbours in memory are neighbours in space (order.c), but the positions of a
 * file can be in any order. Lists of corners and normals take a third less time if they are not. */
#include "mesh/build/first_use.h"

typedef struct renumberer {
    burnish_builder *b;
    burnish_renumbering *to;
    size_t next;
    float *positions;
} renumberer;

/* Which corners are new can't be predicted. */
static void number_corners(void *context, size_t first, size_t end) {
    renumberer *r = context;
    uint32_t *restrict corners = r->b->corner_positions, *restrict before = r->to->before;
    uint32_t *restrict numbers = r->to->numbers, next = (uint32_t)r->next;
    for (size_t i = 3 * first; i < 3 * end; ++i) {
        const uint32_t position = corners[i],
                       number = numbers[position] < next ? numbers[position] : next;
        before[next] = position;
        numbers[position] = corners[i] = number;
        next += number == next;
    }
    r->next = next;
}

static void move_positions(void *context, size_t first, size_t end) {
    const renumberer *r = context;
    const float *from = burnish_positions(r->b->data);
    for (size_t i = first; i < end; ++i) {
        memcpy(r->positions + 3 * i, from + 3 * (size_t)r->to->before[i], 3 * sizeof(float));
    }
}

burnish_status burnish_build_number_positions(burnish_builder *b,
                                              burnish_renumbering *renumbering) {
    burnish_stream *stream = &b->data->streams[BURNISH_POSITION];
    burnish_tasks *tasks = b->data->tasks;
    const size_t count = b->position_count;
    renumberer r = {.b = b, .to = renumbering};
    *renumbering = (burnish_renumbering){0};
    if (b->corner_positions == stream->corners) {
        return BURNISH_STATUS_OK;
    }
    renumbering->count = count;
    /* one more, for what comes after the last new one */
    renumbering->before =
        burnish_allocate(b->memory, count + 1, sizeof *renumbering->before, "vertices");
    renumbering->numbers =
        burnish_allocate(b->memory, count, sizeof *renumbering->numbers, "vertices");
    if (b->memory->status != BURNISH_STATUS_OK) {
        return b->memory->status;
    }
    memset(renumbering->numbers, 0xff, count * sizeof *renumbering->numbers);
    burnish_tasks_in_order(tasks, b->triangle_count, BURNISH_BUILD_STEP, number_corners, &r);
    burnish_status status = burnish_tasks_check(tasks, b->memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    r.positions = burnish_allocate(b->memory, r.next, 3 * sizeof(float), "vertices");
    if (!r.positions) {
        return b->memory->status;
    }
    burnish_tasks_ranges(tasks, r.next, BURNISH_BUILD_GRAIN, move_positions, &r);
    burnish_release(b->memory->context, stream->items);
    stream->items = r.positions;
    stream->capacity = stream->count = b->position_count = r.next;
    return burnish_tasks_check(tasks, b->memory->error);
}
