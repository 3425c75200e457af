/* A vertex has the number of first corners of vertices before its own, which are counted by bits. */
#include "mesh/build/vertices.h"

#include "mesh/build/builder.h"

enum { WORD = 64 };

typedef struct writer {
    const burnish_builder *b;
    const burnish_first_vertices *first;
    const burnish_later_vertices *list; /* to be written; NULL: first vertices */
    uint32_t *first_corners;            /* of each position; BURNISH_NONE: no triangle has it */
    uint64_t *bits;                     /* of each corner: 1 if it is the first one of its vertex */
    uint32_t *before;                   /* the bits before each word */
    uint32_t *numbers;                  /* of each position's vertex, BURNISH_NONE: several */
    uint32_t *indices;
} writer;

static uint32_t count_bits(uint64_t x) {
    x -= x >> 1 & 0x5555555555555555u;
    x = (x & 0x3333333333333333u) + (x >> 2 & 0x3333333333333333u);
    x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    return (uint32_t)(x * 0x0101010101010101u >> 56);
}

static uint32_t number_of(const writer *w, uint32_t corner) {
    const uint64_t below = ((uint64_t)1 << corner % WORD) - 1;
    return w->before[corner / WORD] + count_bits(w->bits[corner / WORD] & below);
}

static void mark_corner(const writer *w, uint32_t corner) {
    w->bits[corner / WORD] |= (uint64_t)1 << corner % WORD;
}

/* Finds the first corners of all vertices, those of positions where their lists' starts were.
 * Returns how many there are. */
static size_t mark_corners(const writer *w, const burnish_later_vertices *lists, size_t list_count,
                           size_t words) {
    uint32_t sum = 0;
    memset(w->bits, 0, words * sizeof *w->bits);
    for (size_t i = 0; i < w->b->position_count; ++i) { /* in place: each is read before */
        const uint32_t start = w->first_corners[i];
        w->first_corners[i] = BURNISH_NONE;
        if (start < w->first_corners[i + 1]) {
            w->first_corners[i] = w->b->corners[start];
            mark_corner(w, w->first_corners[i]);
        }
    }
    for (size_t k = 0; k < list_count; ++k) {
        for (size_t i = 0; i < lists[k].count; ++i) {
            mark_corner(w, lists[k].items[i].corner);
        }
    }
    for (size_t i = 0; i < words; ++i) {
        w->before[i] = sum;
        sum += count_bits(w->bits[i]);
    }
    return sum;
}

static void number_range(void *context, size_t first, size_t end) {
    const writer *w = context;
    for (size_t i = first; i < end; ++i) {
        const uint32_t corner = w->first->is_split[i] ? BURNISH_NONE : w->first_corners[i];
        w->numbers[i] = corner == BURNISH_NONE ? BURNISH_NONE : number_of(w, corner);
    }
}

static void index_range(void *context, size_t first, size_t end) {
    const writer *w = context;
    const uint32_t *positions = w->b->corner_positions, *heads = w->first->heads;
    for (size_t i = 3 * first; i < 3 * end; ++i) {
        const uint32_t number = w->numbers[positions[i]];
        w->indices[i] = number != BURNISH_NONE ? number : number_of(w, heads[i]);
    }
}

/* Numbers the vertices and writes the indices. */
static burnish_status number_vertices(burnish_builder *b, writer *w,
                                      const burnish_later_vertices *lists, size_t list_count) {
    burnish_tasks *tasks = b->data->tasks;
    const size_t words = 3 * b->triangle_count / WORD + 1;
    w->bits = burnish_allocate(b->memory, words, sizeof *w->bits, "vertices");
    w->before = burnish_allocate(b->memory, words, sizeof *w->before, "vertices");
    w->numbers = burnish_allocate(b->memory, b->position_count, sizeof *w->numbers, "vertices");
    if (b->memory->status == BURNISH_STATUS_OK) {
        b->vertex_count = mark_corners(w, lists, list_count, words);
        burnish_release(b->memory->context, b->corners);
        b->corners = NULL;
        burnish_tasks_ranges(tasks, b->position_count, BURNISH_BUILD_GRAIN, number_range, w);
        burnish_tasks_ranges(tasks, b->triangle_count, BURNISH_BUILD_GRAIN, index_range, w);
    }
    return b->memory->status == BURNISH_STATUS_OK ? burnish_tasks_check(tasks, b->memory->error)
                                                  : b->memory->status;
}

/* ---- arrays ---- */

static void write_vertex(const writer *w, size_t number, const float *position, const float *normal,
                         uint32_t corner) {
    const burnish_builder *b = w->b;
    void *const *attributes = b->mesh->attributes;
    float *positions = attributes[BURNISH_POSITION], *normals = attributes[BURNISH_NORMAL];
    memcpy(positions + 3 * number, position, 3 * sizeof(float));
    memcpy(normals + 3 * number, normal, 3 * sizeof(float));
    for (int i = 0; i < b->extra_count; ++i) {
        const burnish_attribute attribute = b->extras[i].attribute;
        uint8_t *to = attributes[attribute];
        burnish_copy_extra(&b->extras[i], b->extras[i].corners[corner],
                           to + burnish_attribute_size(attribute) * number);
    }
}

static void write_first(void *context, size_t first, size_t end) {
    const writer *w = context;
    const float *positions = burnish_positions(w->b->data), *normals = w->first->normals;
    for (size_t i = first; i < end; ++i) {
        const uint32_t corner = w->first_corners[i];
        if (corner != BURNISH_NONE) {
            const uint32_t number = w->numbers[i];
            write_vertex(w, number != BURNISH_NONE ? number : number_of(w, corner),
                         positions + 3 * i, normals + 3 * i, corner);
        }
    }
}

static void write_later(void *context, size_t first, size_t end) {
    const writer *w = context;
    const float *positions = burnish_positions(w->b->data);
    for (size_t i = first; i < end; ++i) {
        const burnish_later_vertex *vertex = &w->list->items[i];
        write_vertex(w, number_of(w, vertex->corner), positions + 3 * (size_t)vertex->position,
                     vertex->normal, vertex->corner);
    }
}

static burnish_status write_vertices(burnish_builder *b, writer *w,
                                     const burnish_later_vertices *lists, size_t list_count) {
    burnish_tasks *tasks = b->data->tasks;
    burnish_status status = burnish_build_allocate_vertices(b);
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(tasks, b->position_count, BURNISH_BUILD_GRAIN, write_first, w);
    }
    for (size_t i = 0; i < list_count && status == BURNISH_STATUS_OK; ++i) {
        w->list = &lists[i];
        burnish_tasks_ranges(tasks, lists[i].count, BURNISH_BUILD_GRAIN, write_later, w);
    }
    return status;
}

/* Corners of positions become indices in their memory, unless an attribute has the same corners. */
static void choose_indices(burnish_builder *b, burnish_first_vertices *first, writer *w) {
    if (b->corner_positions == b->data->streams[BURNISH_POSITION].corners) {
        w->indices = first->heads;
        return;
    }
    b->corner_positions = burnish_shrink(b->memory->context, b->corner_positions,
                                         &b->corner_capacity, b->triangle_count, BURNISH_TRIPLE);
    w->indices = b->corner_positions;
}

/* The mesh owns its indices, and what only corners have goes. */
static void take_indices(burnish_builder *b, burnish_first_vertices *first, const writer *w) {
    b->mesh->indices = w->indices;
    if (w->indices == b->corner_positions) {
        b->corner_positions = NULL;
        burnish_release(b->memory->context, first->heads);
    }
    first->heads = NULL;
    burnish_build_release_corners(b, b->has_extras);
}

burnish_status burnish_build_write_vertices(burnish_builder *b, burnish_first_vertices *first,
                                            const burnish_later_vertices *lists,
                                            size_t list_count) {
    writer w = {.b = b, .first = first, .first_corners = b->first_corner};
    b->first_corner = NULL;
    choose_indices(b, first, &w);
    burnish_status status = number_vertices(b, &w, lists, list_count);
    if (status == BURNISH_STATUS_OK) {
        take_indices(b, first, &w);
        status = write_vertices(b, &w, lists, list_count);
    }
    burnish_release(b->memory->context, w.bits);
    burnish_release(b->memory->context, w.before);
    burnish_release(b->memory->context, w.numbers);
    burnish_release(b->memory->context, w.first_corners);
    return status;
}
