/* Orders triangles so neighbours in space are neighbours in memory: sixteen neighbours then mostly
 *        fall into one tile and share vertices. They are sorted by cells of space, which
 * follow one another along a Z-order curve (G. M. Morton, "A computer oriented geodetic data base",
 * IBM, 1966); within a cell they keep their order. O(n). Most files are in such an order already,
 * because modellers, meshers and scanners go over a surface. They are not reordered.
 *
 * meshoptimizer's vertex cache order is not used on purpose. It helps hardware that transforms a
 * vertex once per use, while burnish transforms each vertex once. Its cost is quadratic in the
 * faces around a vertex (a fan of 80,000 takes 5 s, version 0.18). */
#include "mesh/build/builder.h"

enum {
    ORDERED_MIN = 4096,  /* triangles: fewer keep the order of the file */
    MAX_BITS = 6,        /* of a cell's number along an axis */
    CELL_TARGET = 512,   /* triangles per cell, on a surface of 4^bits cells */
    SLICES_MAX = 8,      /* counted separately: a megabyte each for large meshes */
    SLICE_MIN = 1 << 14, /* triangles that are worth one */
    GROUP = 16,          /* triangles that are drawn together */
    GROUPS_SEEN = 512    /* of the file, at even distances */
};

/* Sorted groups are about as wide as a cell. Files whose groups span at most this many cells on
 * average draw as fast as sorted ones (bench/NOTES.md). */
static const double WIDEST = 1.5;

typedef struct sorter {
    const float *positions;
    const uint32_t *corners;
    size_t count, slice_size;
    double origin[3], cells_per_unit;
    int bits;
    uint32_t spread[1 << MAX_BITS]; /* a number's bits, three apart */
    uint32_t *cells;                /* one per triangle */
    uint32_t *offsets; /* one per cell, slice after slice: where its next triangle goes */
    uint32_t *order;
} sorter;

static size_t cell_count(const sorter *s) {
    return (size_t)1 << 3 * s->bits;
}

static void make_grid(sorter *s, size_t position_count) {
    float low[3], high[3];
    double extent = 0;
    burnish_bound_positions(s->positions, position_count, low, high);
    for (int k = 0; k < 3; ++k) {
        const double size = (double)high[k] - (double)low[k];
        s->origin[k] = low[k];
        extent = size > extent ? size : extent;
    }
    s->bits = 1;
    while (s->bits < MAX_BITS && s->count >> 2 * s->bits > CELL_TARGET) {
        ++s->bits;
    }
    s->cells_per_unit = extent > 0 ? (double)(1 << s->bits) / extent : 0;
    for (uint32_t i = 0; i < 1u << MAX_BITS; ++i) {
        s->spread[i] = 0;
        for (int bit = 0; bit < MAX_BITS; ++bit) {
            s->spread[i] |= (i >> bit & 1) << 3 * bit;
        }
    }
}

/* A triangle is in the cell of its least corner, so equal triangles are in one cell. */
static uint32_t cell_of(const sorter *s, const uint32_t *corners) {
    uint32_t least = corners[0] < corners[1] ? corners[0] : corners[1], cell = 0;
    least = corners[2] < least ? corners[2] : least;
    const float *position = s->positions + 3 * (size_t)least;
    const int last = (1 << s->bits) - 1;
    for (int k = 0; k < 3; ++k) {
        const int number = (int)(((double)position[k] - s->origin[k]) * s->cells_per_unit);
        cell |= s->spread[number < last ? number : last] << k;
    }
    return cell;
}

static size_t slice_end(const sorter *s, size_t first) {
    return s->count - first < s->slice_size ? s->count : first + s->slice_size;
}

static void count_slice(void *context, size_t slice, int thread) {
    sorter *s = context;
    uint32_t *counts = s->offsets + slice * cell_count(s);
    const size_t first = slice * s->slice_size, end = slice_end(s, first);
    (void)thread;
    memset(counts, 0, cell_count(s) * sizeof *counts);
    for (size_t i = first; i < end; ++i) {
        const uint32_t cell = cell_of(s, s->corners + 3 * i);
        s->cells[i] = cell;
        ++counts[cell];
    }
}

static void scatter_slice(void *context, size_t slice, int thread) {
    sorter *s = context;
    uint32_t *offsets = s->offsets + slice * cell_count(s);
    const size_t first = slice * s->slice_size, end = slice_end(s, first);
    (void)thread;
    for (size_t i = first; i < end; ++i) {
        s->order[offsets[s->cells[i]]++] = (uint32_t)i;
    }
}

/* Counts become offsets: cell by cell, and in a cell slice by slice. */
static void sum_counts(sorter *s, size_t slices) {
    uint32_t next = 0;
    for (size_t cell = 0; cell < cell_count(s); ++cell) {
        for (size_t slice = 0; slice < slices; ++slice) {
            uint32_t *offset = &s->offsets[slice * cell_count(s) + cell];
            const uint32_t count = *offset;
            *offset = next;
            next += count;
        }
    }
}

/* Two per thread; the order does not depend on it. */
static size_t count_slices(size_t count, const burnish_tasks *tasks) {
    const size_t threads = (size_t)burnish_tasks_threads(tasks), worth = count / SLICE_MIN;
    const size_t most = 2 * threads < SLICES_MAX ? 2 * threads : SLICES_MAX;
    return threads == 1 || worth <= 1 ? 1 : worth < most ? worth : most;
}

/* The longest side of the box around a group. */
static double group_width(const sorter *s, size_t first) {
    float low[3], high[3];
    double width = 0;
    memcpy(low, s->positions + 3 * (size_t)s->corners[3 * first], sizeof low);
    memcpy(high, low, sizeof high);
    for (size_t i = 3 * first + 1; i < 3 * (first + GROUP); ++i) {
        const float *position = s->positions + 3 * (size_t)s->corners[i];
        for (size_t k = 0; k < 3; ++k) {
            low[k] = position[k] < low[k] ? position[k] : low[k];
            high[k] = position[k] > high[k] ? position[k] : high[k];
        }
    }
    for (size_t k = 0; k < 3; ++k) {
        const double side = (double)high[k] - (double)low[k];
        width = side > width ? side : width;
    }
    return width;
}

/* Whether the file's order is good enough. This depends on the mesh alone, because at equal depth
 * the first triangle wins. */
static int is_ordered(const sorter *s) {
    const size_t groups = s->count / GROUP, step = groups / GROUPS_SEEN + 1;
    double sum = 0;
    size_t seen = 0;
    for (size_t group = 0; group < groups; group += step, ++seen) {
        sum += group_width(s, group * GROUP);
    }
    return sum * s->cells_per_unit <= WIDEST * (double)seen;
}

/* Writes the numbers of the triangles in their order. */
static burnish_status find_order(burnish_builder *b, sorter *s) {
    burnish_tasks *tasks = b->data->tasks;
    burnish_memory *memory = b->memory;
    const size_t slices = count_slices(s->count, tasks);
    s->slice_size = (s->count + slices - 1) / slices;
    s->cells = burnish_allocate(memory, s->count, sizeof *s->cells, "ordering");
    s->offsets = burnish_allocate(memory, slices * cell_count(s), sizeof *s->offsets, "ordering");
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_run(tasks, slices, 1, 0, count_slice, s);
        status = burnish_tasks_check(tasks, memory->error);
    }
    if (status == BURNISH_STATUS_OK) { /* offsets are sums of what every slice counted */
        sum_counts(s, slices);
        burnish_tasks_run(tasks, slices, 1, 0, scatter_slice, s);
        status = burnish_tasks_check(tasks, memory->error);
    }
    burnish_release(memory->context, s->cells);
    burnish_release(memory->context, s->offsets);
    return status;
}

burnish_status burnish_build_order(burnish_builder *b) {
    const size_t count = b->triangle_count;
    if (count < ORDERED_MIN) {
        return BURNISH_STATUS_OK;
    }
    sorter s = {
        .positions = burnish_positions(b->data), .corners = b->corner_positions, .count = count};
    make_grid(&s, b->position_count);
    if (is_ordered(&s)) {
        return BURNISH_STATUS_OK;
    }
    b->order = s.order = burnish_allocate(b->memory, count, sizeof *b->order, "ordering");
    return b->order ? find_order(b, &s) : b->memory->status;
}

/* ---- Moving ---- */

/* Items of one size, one per triangle, on their way to a new order. */
typedef struct move_context {
    const uint32_t *order;
    const uint8_t *from;
    uint8_t *to;
} move_context;

static void move_triples(void *context, size_t first, size_t end) {
    const move_context *c = context;
    for (size_t i = first; i < end; ++i) {
        memcpy(c->to + BURNISH_TRIPLE * i, c->from + BURNISH_TRIPLE * (size_t)c->order[i],
               BURNISH_TRIPLE);
    }
}

static void move_materials(void *context, size_t first, size_t end) {
    const move_context *c = context;
    enum { SIZE = sizeof(uint16_t) };
    for (size_t i = first; i < end; ++i) {
        memcpy(c->to + SIZE * i, c->from + SIZE * (size_t)c->order[i], SIZE);
    }
}

/* An array with one item of `size` bytes per triangle in that order; NULL stays. Returns its new
 * address; on failure the old one. */
static void *permute_array(burnish_builder *b, void *array, size_t size, burnish_range_task *task) {
    void *made = array ? burnish_allocate(b->memory, b->triangle_count, size, "ordering") : NULL;
    if (!made) {
        return array;
    }
    move_context context = {b->order, array, made};
    burnish_tasks_ranges(b->data->tasks, b->triangle_count, BURNISH_BUILD_GRAIN, task, &context);
    burnish_release(b->memory->context, array);
    return made;
}

burnish_status burnish_build_move(burnish_builder *b, int corners) {
    burnish_mesh_data *data = b->data;
    if (!b->order) {
        return BURNISH_STATUS_OK;
    }
    if (corners) {
        if (b->corner_positions != data->streams[BURNISH_POSITION].corners) {
            b->corner_positions =
                permute_array(b, b->corner_positions, BURNISH_TRIPLE, move_triples);
            b->corner_capacity = b->triangle_count;
        }
        for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
            burnish_stream *stream = &data->streams[i];
            const int is_shared = stream->corners && stream->corners == b->corner_positions;
            stream->corners = permute_array(b, stream->corners, BURNISH_TRIPLE, move_triples);
            stream->corner_capacity = stream->corners ? b->triangle_count : 0;
            b->corner_positions = is_shared ? stream->corners : b->corner_positions;
        }
    }
    data->triangle_materials =
        permute_array(b, data->triangle_materials, sizeof(uint16_t), move_materials);
    data->triangle_material_capacity = data->triangle_materials ? b->triangle_count : 0;
    data->triangle_parts = permute_array(b, data->triangle_parts, sizeof(uint16_t), move_materials);
    data->triangle_part_capacity = data->triangle_parts ? b->triangle_count : 0;
    burnish_release(b->memory->context, b->order);
    b->order = NULL;
    return b->memory->status == BURNISH_STATUS_OK
               ? burnish_tasks_check(data->tasks, b->memory->error)
               : b->memory->status;
}
