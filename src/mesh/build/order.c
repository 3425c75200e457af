#include "mesh/build/order.h"

#include <string.h>

#include "core/memory.h"

enum {
    MOST_BITS = 6,          /* of a cell's place along an axis */
    TRIANGLES_A_CELL = 512, /* on a surface of 4^bits cells */
    SLICES = 8,             /* that are counted apart, whatever the number of threads */
    SLICE_LEAST = 1 << 17   /* triangles that are worth slices */
};

typedef struct sorter {
    const float *positions;
    const uint32_t *corners;
    size_t count, slice_size;
    double origin[3], cells_a_unit;
    int bits;
    uint32_t spread[1 << MOST_BITS]; /* a number's bits, three places apart */
    uint32_t *cells;                 /* a triangle each */
    uint32_t *places; /* a cell each, a slice after another: where its next triangle goes */
    uint32_t *order;
} sorter;

static size_t cell_count(const sorter *s) {
    return (size_t)1 << 3 * s->bits;
}

static void find_cells(sorter *s, size_t position_count) {
    float low[3], high[3];
    double extent = 0;
    memcpy(low, s->positions, sizeof low);
    memcpy(high, s->positions, sizeof high);
    for (size_t i = 0; i < position_count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            const float value = s->positions[3 * i + k];
            low[k] = value < low[k] ? value : low[k];
            high[k] = value > high[k] ? value : high[k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        const double size = (double)high[k] - (double)low[k];
        s->origin[k] = low[k];
        extent = size > extent ? size : extent;
    }
    s->bits = 1;
    while (s->bits < MOST_BITS && s->count >> 2 * s->bits > TRIANGLES_A_CELL) {
        ++s->bits;
    }
    s->cells_a_unit = extent > 0 ? (double)(1 << s->bits) / extent : 0;
    for (uint32_t i = 0; i < 1u << MOST_BITS; ++i) {
        s->spread[i] = 0;
        for (int bit = 0; bit < MOST_BITS; ++bit) {
            s->spread[i] |= (i >> bit & 1) << 3 * bit;
        }
    }
}

static uint32_t cell_of(const sorter *s, const uint32_t *corners) {
    uint32_t least = corners[0] < corners[1] ? corners[0] : corners[1], cell = 0;
    least = corners[2] < least ? corners[2] : least;
    const float *position = s->positions + 3 * (size_t)least;
    const int last = (1 << s->bits) - 1;
    for (int k = 0; k < 3; ++k) {
        const int place = (int)(((double)position[k] - s->origin[k]) * s->cells_a_unit);
        cell |= s->spread[place < last ? place : last] << k;
    }
    return cell;
}

static size_t slice_end(const sorter *s, size_t first) {
    return s->count - first < s->slice_size ? s->count : first + s->slice_size;
}

static void count_slice(void *of, size_t slice, int thread) {
    sorter *s = of;
    uint32_t *counts = s->places + slice * cell_count(s);
    const size_t first = slice * s->slice_size, end = slice_end(s, first);
    (void)thread;
    memset(counts, 0, cell_count(s) * sizeof *counts);
    for (size_t i = first; i < end; ++i) {
        const uint32_t cell = cell_of(s, s->corners + 3 * i);
        s->cells[i] = cell;
        ++counts[cell];
    }
}

static void place_slice(void *of, size_t slice, int thread) {
    sorter *s = of;
    uint32_t *places = s->places + slice * cell_count(s);
    const size_t first = slice * s->slice_size, end = slice_end(s, first);
    (void)thread;
    for (size_t i = first; i < end; ++i) {
        s->order[places[s->cells[i]]++] = (uint32_t)i;
    }
}

/* Counts become places: cell by cell, and in a cell slice by slice. */
static void add_up(sorter *s, size_t slices) {
    uint32_t next = 0;
    for (size_t cell = 0; cell < cell_count(s); ++cell) {
        for (size_t slice = 0; slice < slices; ++slice) {
            uint32_t *place = &s->places[slice * cell_count(s) + cell];
            const uint32_t count = *place;
            *place = next;
            next += count;
        }
    }
}

burnish_status burnish_order_triangles(const float *positions, size_t position_count,
                                       const uint32_t *corners, size_t count, burnish_tasks *pool,
                                       uint32_t *order, burnish_error *error) {
    const size_t slices = count < SLICE_LEAST ? 1 : SLICES;
    sorter s = {.positions = positions,
                .corners = corners,
                .count = count,
                .slice_size = (count + slices - 1) / slices,
                .order = order};
    find_cells(&s, position_count);
    burnish_status status =
        burnish_legacy_allocate((void **)&s.cells, count, sizeof *s.cells, "ordering", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&s.places, slices * cell_count(&s),
                                         sizeof *s.places, "ordering", error);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_run(pool, slices, 1, 0, count_slice, &s);
        add_up(&s, slices);
        burnish_tasks_run(pool, slices, 1, 0, place_slice, &s);
    }
    free(s.cells);
    free(s.places);
    return status;
}
