/* Triangle lists per tile, made for as many tile rows at a time as fit a fixed memory budget. */
#include "raster/bins.h"

#include <string.h>

#include "base/memory.h"
#include "raster/raster_ops.h"

/* A band of several tile rows takes at most about 128 MiB: BURNISH_LISTS_MAX lists of 8 bytes
 * (16 MiB), and so many entries of 8 bytes with a link of 4 bytes per chunk. One row alone may need
 * more. */
#define ENTRY_BUDGET ((size_t)13 << 20)

enum {
    SLICES_PER_THREAD = 4, /* so many that the last of them to finish is not waited for long */
    MIN_BATCHES = 8        /* that are worth a slice */
};

/* Entries that each tile row needs at most, for the rows from first_row on. */
static void count_rows(const burnish_geometry *geometry, int first_row, size_t *row_entries) {
    for (size_t i = 0; i < geometry->batch_count; ++i) {
        const burnish_batch_header *header = &geometry->headers[i];
        for (unsigned rest = header->visible[0] | header->visible[1]; rest; rest &= rest - 1) {
            const burnish_tile_box box =
                burnish_tile_box_of(&geometry->batches[i], (unsigned)__builtin_ctz(rest));
            for (int row = box.row0 < first_row ? first_row : box.row0; row <= box.row1; ++row) {
                row_entries[row] += (size_t)(box.column1 - box.column0 + 1);
            }
        }
    }
}

/* As many rows as fit for certain. */
static int choose_end_row(const burnish_bins *bins, const burnish_geometry *geometry) {
    size_t row_entries[BURNISH_MAX_TILES] = {0};
    count_rows(geometry, bins->first_row, row_entries);
    size_t total = row_entries[bins->first_row];
    int row = bins->first_row + 1;
    while (row < bins->rows && total + row_entries[row] <= bins->entry_budget) {
        total += row_entries[row++];
    }
    return row;
}

/* Room for at least `count` chunks, fewer where the limit is less. */
static burnish_status reserve_chunks(const burnish_bins *bins, burnish_bin_slice *slice,
                                     size_t count, size_t limit) {
    burnish_memory memory = burnish_memory_of(bins->context, &slice->error);
    if (count >= UINT32_MAX / BURNISH_CHUNK_ENTRIES) {
        return burnish_fail(&slice->error, BURNISH_STATUS_LIMIT,
                            "tile lists: more than 2^32 entries; draw a part of the mesh");
    }
    slice->entries = burnish_reserve(&memory, slice->entries, &slice->entry_capacity, count,
                                     BURNISH_CHUNK_ENTRIES * sizeof *slice->entries, "tile lists");
    slice->next_chunks = burnish_reserve(&memory, slice->next_chunks, &slice->next_capacity, count,
                                         sizeof *slice->next_chunks, "tile lists");
    if (memory.status == BURNISH_STATUS_OK) {
        const size_t capacity = slice->entry_capacity < slice->next_capacity ? slice->entry_capacity
                                                                             : slice->next_capacity;
        slice->chunk_capacity = capacity < limit ? capacity : limit;
    }
    return memory.status;
}

/* What the tasks of a band share. */
typedef struct fill_context {
    burnish_bins *bins;
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    size_t chunk_limit; /* per slice, with chunk 0 */
} fill_context;

/* Fills the lists of a slice of the batches; slice->fits becomes 0 where the limit does not
 * suffice. */
static burnish_status fill_slice(const fill_context *fill, size_t number) {
    const burnish_bins *bins = fill->bins;
    burnish_bin_slice *slice = &bins->slices[number];
    burnish_memory memory = burnish_memory_of(bins->context, &slice->error);
    const size_t lists = 2 * (size_t)bins->columns * (size_t)(bins->end_row - bins->first_row);
    slice->lists = burnish_reserve_discard(&memory, slice->lists, &slice->list_capacity, lists,
                                           sizeof *slice->lists, "tile lists");
    if (memory.status != BURNISH_STATUS_OK) {
        return memory.status;
    }
    memset(slice->lists, 0, lists * sizeof *slice->lists);
    const size_t batches = fill->geometry->batch_count;
    const size_t end = batches * (number + 1) / bins->slice_count;
    size_t at = batches * number / bins->slice_count, needed = 1;
    slice->chunk_count = 1; /* number 0 means none */
    do {
        burnish_status status = reserve_chunks(bins, slice, needed, fill->chunk_limit);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        slice->entries[0] = (burnish_bin_entry){0, 0};
        at = fill->ops->bin_batches(bins, slice, fill->geometry, at, end);
        needed = slice->chunk_capacity + 1;
    } while (at < end && needed <= fill->chunk_limit);
    slice->fits = at == end;
    return BURNISH_STATUS_OK;
}

static void fill_task(void *context, size_t index, int thread) {
    const fill_context *fill = context;
    (void)thread;
    fill->bins->slices[index].status = fill_slice(fill, index);
}

/* Fills the band; *fits becomes 0 where more chunks than `limit` would be needed. */
static burnish_status fill_band(burnish_bins *bins, const burnish_raster_ops *ops,
                                const burnish_geometry *geometry, size_t limit,
                                burnish_tasks *tasks, int *fits, burnish_error *error) {
    fill_context fill = {bins, ops, geometry, limit / bins->slice_count};
    fill.chunk_limit += fill.chunk_limit < SIZE_MAX;
    burnish_tasks_run(tasks, bins->slice_count, 1, 0, fill_task, &fill);
    *fits = 1;
    for (size_t i = 0; i < bins->slice_count; ++i) {
        const burnish_bin_slice *slice = &bins->slices[i];
        if (slice->status != BURNISH_STATUS_OK) {
            if (error) {
                *error = slice->error;
            }
            return slice->status;
        }
        *fits &= slice->fits;
    }
    return BURNISH_STATUS_OK;
}

void burnish_bins_begin(burnish_bins *bins, const burnish_context *context) {
    bins->context = context;
    bins->first_row = bins->end_row = 0;
    bins->row_limit = BURNISH_MAX_TILES;
    bins->entry_budget = ENTRY_BUDGET;
}

/* As many slices as keep the threads busy, and their lists below BURNISH_LISTS_MAX. */
static burnish_status make_slices(burnish_bins *bins, const burnish_geometry *geometry, int threads,
                                  burnish_error *error) {
    const size_t lists = 2 * (size_t)bins->columns * (size_t)(bins->rows - bins->first_row);
    size_t count = threads > 1 ? SLICES_PER_THREAD * (size_t)threads : 1;
    size_t max = geometry->batch_count / MIN_BATCHES + 1;
    max = max * lists > BURNISH_LISTS_MAX ? BURNISH_LISTS_MAX / lists : max;
    count = count > max ? max : count;
    const size_t before = bins->slice_capacity;
    burnish_memory memory = burnish_memory_of(bins->context, error);
    bins->slices = burnish_reserve(&memory, bins->slices, &bins->slice_capacity, count,
                                   sizeof *bins->slices, "tile lists");
    if (bins->slice_capacity > before) {
        memset(bins->slices + before, 0, (bins->slice_capacity - before) * sizeof *bins->slices);
    }
    bins->slice_count = count;
    return memory.status;
}

burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_raster_ops *ops,
                                 const burnish_geometry *geometry, const burnish_raster_view *view,
                                 burnish_tasks *tasks, burnish_error *error) {
    bins->columns = (view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->rows = (view->height + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->rows = bins->rows < bins->row_limit ? bins->rows : bins->row_limit;
    bins->first_row = bins->end_row;
    burnish_status status = make_slices(bins, geometry, burnish_tasks_threads(tasks), error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* all rows that are left, if they fit; then as many as do for certain */
    int fits;
    bins->end_row = bins->rows;
    status = fill_band(bins, ops, geometry, bins->entry_budget / BURNISH_CHUNK_ENTRIES, tasks,
                       &fits, error);
    if (status == BURNISH_STATUS_OK && !fits) {
        bins->end_row = choose_end_row(bins, geometry);
        status = fill_band(bins, ops, geometry, SIZE_MAX, tasks, &fits, error);
    }
    return status;
}

void burnish_bins_destroy(burnish_bins *bins) {
    for (size_t i = 0; i < bins->slice_capacity; ++i) {
        burnish_release(bins->context, bins->slices[i].lists);
        burnish_release(bins->context, bins->slices[i].entries);
        burnish_release(bins->context, bins->slices[i].next_chunks);
    }
    burnish_release(bins->context, bins->slices);
    memset(bins, 0, sizeof *bins);
}

/* ---- Bands ---- */

typedef struct band_context {
    const burnish_bins *bins;
    burnish_tile_function *draw;
    void *context;
} band_context;

static void draw_binned_tile(void *context, size_t index, int thread) {
    const band_context *band = context;
    const burnish_bins *bins = band->bins;
    band->draw(band->context, (int)index % bins->columns,
               bins->first_row + (int)index / bins->columns, thread);
}

/* Neighbouring tiles share cache lines of the target, so a thread takes some of them at once; but
 * so few that the last ones are not waited for. */
static size_t tile_grain(int count, int threads) {
    enum { MAX_GRAIN = 8, TURNS = 32 };
    const int grain = count / (threads * TURNS);
    return (size_t)(grain < 1 ? 1 : grain > MAX_GRAIN ? MAX_GRAIN : grain);
}

burnish_status burnish_bands_draw(const burnish_bands *bands, burnish_tile_function *draw,
                                  void *context, burnish_error *error) {
    return burnish_bands_draw_rows(bands, 0, BURNISH_MAX_TILES, draw, context, error);
}

burnish_status burnish_bands_draw_rows(const burnish_bands *bands, int first_row, int end_row,
                                       burnish_tile_function *draw, void *context,
                                       burnish_error *error) {
    burnish_bins *bins = bands->bins;
    burnish_status status = BURNISH_STATUS_OK;
    band_context band = {bins, draw, context};
    burnish_bins_begin(bins, bands->context);
    bins->end_row = first_row;
    bins->row_limit = end_row;
    do {
        status =
            burnish_bin_tiles(bins, bands->ops, bands->geometry, bands->view, bands->tasks, error);
        if (status == BURNISH_STATUS_OK) {
            const int count = bins->columns * (bins->end_row - bins->first_row);
            burnish_tasks_run(bands->tasks, (size_t)count, tile_grain(count, bands->threads),
                              bands->threads, draw_binned_tile, &band);
            status = burnish_tasks_check(bands->tasks, error);
        }
    } while (status == BURNISH_STATUS_OK && bins->end_row < bins->rows);
    return status;
}
