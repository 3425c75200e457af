/* Triangle lists per tile, made for as many tile rows at a time as fit a fixed memory budget. */
#include <string.h>

#include "core/memory.h"
#include "raster/tier.h"

/* Entries that a band of several tile rows may hold: 128 MiB. One row alone may need more. */
#define ENTRY_BUDGET ((size_t)1 << 24)

enum {
    SLICES_A_THREAD = 4, /* so many that the last of them to finish is not waited for long */
    LEAST_BLOCKS = 8     /* that are worth a slice */
};

/* Entries that each tile row needs at most, for the rows from first_row on. */
static void count_rows(const burnish_geometry *geometry, int first_row, size_t *row_entries) {
    for (size_t i = 0; i < geometry->batch_count; ++i) {
        const burnish_batch_header *head = &geometry->headers[i];
        for (unsigned rest = head->lanes[0] | head->lanes[1]; rest; rest &= rest - 1) {
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

/* Makes room for the entries of a piece and those before it. */
static burnish_status reserve_entries(burnish_bin_slice *slice, size_t piece) {
    return burnish_legacy_reserve((void **)&slice->entries, &slice->entry_capacity,
                                  (piece + 1) * BURNISH_CHUNK_ENTRIES, sizeof *slice->entries,
                                  "tile lists", &slice->error);
}

burnish_status burnish_list_start_piece(burnish_bin_slice *slice, burnish_tile_list *chain) {
    const size_t piece = ++slice->piece_count;
    if (piece >= UINT32_MAX / BURNISH_CHUNK_ENTRIES) {
        return burnish_fail(&slice->error, BURNISH_STATUS_LIMIT,
                            "tile lists: more than 2^32 entries; draw a part of the mesh");
    }
    burnish_status status = reserve_entries(slice, piece);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve((void **)&slice->links, &slice->link_capacity, piece + 1,
                                        sizeof *slice->links, "tile lists", &slice->error);
    }
    if (status == BURNISH_STATUS_OK) {
        if (chain->first) {
            slice->links[chain->next / BURNISH_CHUNK_ENTRIES - 1] = (uint32_t)piece;
        } else {
            chain->first = (uint32_t)piece;
        }
        chain->next = (uint32_t)(piece * BURNISH_CHUNK_ENTRIES);
    }
    return status;
}

/* Fills the lists of a slice of the blocks. Stops early where that is more pieces than the limit.
 */
static void fill_slice(const burnish_bins *bins, const burnish_raster_tier *tier,
                       const burnish_geometry *geometry, size_t number, size_t limit) {
    burnish_bin_slice *slice = &bins->slices[number];
    const size_t lists = 2 * (size_t)bins->columns * (size_t)(bins->end_row - bins->first_row);
    slice->piece_count = 0;
    slice->status =
        burnish_legacy_reserve_discard((void **)&slice->chains, &slice->chain_capacity, lists,
                                       sizeof *slice->chains, "tile lists", &slice->error);
    if (slice->status != BURNISH_STATUS_OK) {
        return;
    }
    memset(slice->chains, 0, lists * sizeof *slice->chains);
    slice->status = reserve_entries(slice, 0);
    if (slice->status != BURNISH_STATUS_OK) {
        return;
    }
    const size_t end = geometry->batch_count * (number + 1) / bins->slice_count;
    tier->list(bins, slice, geometry, geometry->batch_count * number / bins->slice_count, end,
               limit);
}

/* What the tasks of a band share. */
typedef struct fill_context {
    const burnish_bins *bins;
    const burnish_raster_tier *tier;
    const burnish_geometry *geometry;
    size_t limit; /* pieces a slice */
} fill_context;

static void fill_task(void *of, size_t index, int thread) {
    const fill_context *context = of;
    (void)thread;
    fill_slice(context->bins, context->tier, context->geometry, index, context->limit);
}

/* Fills the band; *fits becomes 0 where the slices had to stop. */
static burnish_status fill(burnish_bins *bins, const burnish_raster_tier *tier,
                           const burnish_geometry *geometry, size_t limit, burnish_tasks *pool,
                           int *fits, burnish_error *error) {
    fill_context context = {bins, tier, geometry, limit / bins->slice_count};
    burnish_tasks_run(pool, bins->slice_count, 1, 0, fill_task, &context);
    *fits = 1;
    for (size_t i = 0; i < bins->slice_count; ++i) {
        const burnish_bin_slice *slice = &bins->slices[i];
        if (slice->status != BURNISH_STATUS_OK) {
            if (error) {
                *error = slice->error;
            }
            return slice->status;
        }
        *fits &= slice->piece_count <= context.limit;
    }
    return BURNISH_STATUS_OK;
}

void burnish_bins_begin(burnish_bins *bins) {
    bins->first_row = bins->end_row = 0;
    bins->entry_budget = ENTRY_BUDGET;
}

static burnish_status make_slices(burnish_bins *bins, const burnish_geometry *geometry, int threads,
                                  burnish_error *error) {
    size_t wanted = threads > 1 ? SLICES_A_THREAD * (size_t)threads : 1;
    const size_t most = geometry->batch_count / LEAST_BLOCKS + 1;
    wanted = wanted > most ? most : wanted;
    const size_t before = bins->slice_capacity;
    bins->slice_count = wanted;
    burnish_status status =
        burnish_legacy_reserve((void **)&bins->slices, &bins->slice_capacity, wanted,
                               sizeof *bins->slices, "tile lists", error);
    if (status == BURNISH_STATUS_OK && bins->slice_capacity > before) {
        memset(bins->slices + before, 0, (bins->slice_capacity - before) * sizeof *bins->slices);
    }
    return status;
}

burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_raster_tier *tier,
                                 const burnish_geometry *geometry, const burnish_raster_view *view,
                                 burnish_tasks *pool, burnish_error *error) {
    bins->columns = (view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->rows = (view->height + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->first_row = bins->end_row;
    burnish_status status = make_slices(bins, geometry, burnish_tasks_threads(pool), error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* all rows that are left, if they fit; then as many as do for certain */
    int fits;
    bins->end_row = bins->rows;
    status =
        fill(bins, tier, geometry, bins->entry_budget / BURNISH_CHUNK_ENTRIES, pool, &fits, error);
    if (status == BURNISH_STATUS_OK && !fits) {
        bins->end_row = choose_end_row(bins, geometry);
        status = fill(bins, tier, geometry, SIZE_MAX, pool, &fits, error);
    }
    return status;
}

burnish_list_reader burnish_list_begin(const burnish_bins *bins, int column, int row, int back) {
    const size_t tile = (size_t)(row - bins->first_row) * (size_t)bins->columns + (size_t)column;
    burnish_list_reader reader = {bins, 2 * tile + (size_t)back, 0, 0};
    reader.piece = bins->slices[0].chains[reader.list].first;
    return reader;
}

size_t burnish_list_read(burnish_list_reader *reader, burnish_bin_entry *entries, size_t capacity) {
    size_t count = 0;
    while (reader->slice < reader->bins->slice_count) {
        const burnish_bin_slice *slice = &reader->bins->slices[reader->slice];
        if (!reader->piece) {
            if (++reader->slice < reader->bins->slice_count) {
                reader->piece = slice[1].chains[reader->list].first;
            }
            continue;
        }
        const size_t first = (size_t)reader->piece * BURNISH_CHUNK_ENTRIES;
        const size_t next = slice->chains[reader->list].next;
        const int is_last = next > first && next - first <= BURNISH_CHUNK_ENTRIES;
        const size_t size = is_last ? next - first : BURNISH_CHUNK_ENTRIES;
        if (count + size > capacity) {
            break;
        }
        memcpy(entries + count, slice->entries + first, size * sizeof *entries);
        count += size;
        reader->piece = is_last ? 0 : slice->links[reader->piece];
    }
    return count;
}

int burnish_list_is_empty(burnish_list_reader reader) {
    for (size_t i = 0; i < reader.bins->slice_count; ++i) {
        if (reader.bins->slices[i].chains[reader.list].first) {
            return 0;
        }
    }
    return 1;
}

void burnish_bins_destroy(burnish_bins *bins) {
    for (size_t i = 0; i < bins->slice_capacity; ++i) {
        free(bins->slices[i].chains);
        free(bins->slices[i].entries);
        free(bins->slices[i].links);
    }
    free(bins->slices);
    memset(bins, 0, sizeof *bins);
}
