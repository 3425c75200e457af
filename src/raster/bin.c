/* Triangle lists per tile, made for as many tile rows at a time as fit a fixed memory budget. */
#include <string.h>

#include "base/memory.h"
#include "raster/raster.h"

/* Entries that a band of several tile rows may hold: 128 MiB. One row alone may need more. */
#define ENTRY_BUDGET ((size_t)1 << 25)

/* log2 of coarse blocks along a tile's edge. */
enum { BLOCK_BITS = 3 };
_Static_assert(BURNISH_COARSE_BLOCK << BLOCK_BITS == BURNISH_TILE_SIZE, "blocks fill a tile");

/* A run of slots in use. */
typedef struct slot_run {
    const burnish_setup_triangle *triangles;
    size_t first, count;
} slot_run;

/* Runs are the chunks, then the pieces. */
static slot_run run_at(const burnish_geometry *geometry, size_t i) {
    size_t first = i < geometry->chunk_count ? i * BURNISH_CHUNK : geometry->whole_slots;
    size_t count = i < geometry->chunk_count ? geometry->chunk_counts[i] : geometry->piece_count;
    return (slot_run){geometry->triangles + first, first, count};
}

/* Entries that each tile row needs, for the rows from first_row on. */
static void count_rows(const burnish_geometry *geometry, int first_row, size_t *row_entries) {
    for (size_t i = 0; i <= geometry->chunk_count; ++i) {
        const slot_run run = run_at(geometry, i);
        for (size_t k = 0; k < run.count; ++k) {
            const uint16_t *b = run.triangles[k].blocks;
            const int row0 = b[1] >> BLOCK_BITS, row1 = b[3] >> BLOCK_BITS;
            for (int row = row0 < first_row ? first_row : row0; row <= row1; ++row) {
                row_entries[row] += (size_t)((b[2] >> BLOCK_BITS) - (b[0] >> BLOCK_BITS) + 1);
            }
        }
    }
}

static int choose_end_row(const burnish_bins *bins, const burnish_geometry *geometry) {
    size_t row_entries[BURNISH_MAX_TILES] = {0};
    if (geometry->tile_entries <= bins->entry_budget) {
        return bins->rows; /* all fit */
    }
    count_rows(geometry, bins->first_row, row_entries);
    size_t total = row_entries[bins->first_row];
    int row = bins->first_row + 1;
    while (row < bins->rows && total + row_entries[row] <= bins->entry_budget) {
        total += row_entries[row++];
    }
    return row;
}

/* Counts an entry, or writes it where the count says. */
static inline void add_entry(size_t *place, size_t slot, uint32_t *entries) {
    if (entries) {
        entries[*place] = (uint32_t)slot;
    }
    ++*place;
}

/* For both lists of every tile of the band that the triangles of a run touch: with entries NULL
 * counts them, else writes them at the places that counts has become. */
static inline void walk_run(const burnish_bins *bins, slot_run run, size_t *counts,
                            uint32_t *entries) {
    const size_t columns = (size_t)bins->columns;
    for (size_t i = 0; i < run.count; ++i) {
        const uint16_t *b = run.triangles[i].blocks;
        size_t *lists = counts + (run.triangles[i].source & 1);
        int column0 = b[0] >> BLOCK_BITS, column1 = b[2] >> BLOCK_BITS;
        int row0 = b[1] >> BLOCK_BITS, row1 = b[3] >> BLOCK_BITS;
        row0 = row0 < bins->first_row ? bins->first_row : row0;
        row1 = row1 >= bins->end_row ? bins->end_row - 1 : row1;
        for (int row = row0; row <= row1; ++row) {
            size_t *line = lists + 2 * (size_t)(row - bins->first_row) * columns;
            for (int column = column0; column <= column1; ++column) {
                add_entry(&line[2 * column], run.first + i, entries);
            }
        }
    }
}

/* A slice of the runs. */
static void walk(const burnish_bins *bins, const burnish_geometry *geometry, size_t slice,
                 size_t slices, size_t *counts, uint32_t *entries) {
    const size_t runs = geometry->chunk_count + 1;
    for (size_t i = runs * slice / slices; i < runs * (slice + 1) / slices; ++i) {
        if (entries) {
            walk_run(bins, run_at(geometry, i), counts, entries);
        } else {
            walk_run(bins, run_at(geometry, i), counts, NULL);
        }
    }
}

/* Turns the slices' counts into the places where each slice writes, tile after tile, slice after
 * slice within a tile: the order that one slice alone would give. Returns the number of entries. */
static size_t place_entries(burnish_bins *bins, size_t lists, int slices) {
    size_t total = 0;
    for (size_t list = 0; list < lists; ++list) {
        bins->offsets[list] = total;
        for (int slice = 0; slice < slices; ++slice) {
            size_t *count = &bins->counts[(size_t)slice * lists + list];
            size_t entries = *count;
            *count = total;
            total += entries;
        }
    }
    bins->offsets[lists] = total;
    return total;
}

void burnish_bins_begin(burnish_bins *bins) {
    bins->first_row = bins->end_row = 0;
    bins->entry_budget = ENTRY_BUDGET;
}

burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_geometry *geometry,
                                 const burnish_raster_view *view, int threads,
                                 burnish_error *error) {
    bins->columns = (view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->rows = (view->height + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    bins->first_row = bins->end_row;
    bins->end_row = choose_end_row(bins, geometry);
    size_t lists = 2 * (size_t)bins->columns * (size_t)(bins->end_row - bins->first_row);
    burnish_status status = burnish_grow((void **)&bins->offsets, &bins->offset_capacity, lists + 1,
                                         sizeof *bins->offsets, "tile lists", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_grow((void **)&bins->counts, &bins->count_capacity,
                              lists * (size_t)threads, sizeof *bins->counts, "tile lists", error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t slices = (size_t)threads;
    memset(bins->counts, 0, lists * slices * sizeof *bins->counts);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (size_t s = 0; s < slices; ++s) {
        walk(bins, geometry, s, slices, bins->counts + s * lists, NULL);
    }
    size_t total = place_entries(bins, lists, threads);
    status = burnish_renew((void **)&bins->entries, &bins->entry_capacity, total,
                           sizeof *bins->entries, "tile lists", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (size_t s = 0; s < slices; ++s) {
        walk(bins, geometry, s, slices, bins->counts + s * lists, bins->entries);
    }
    return BURNISH_STATUS_OK;
}

void burnish_bins_destroy(burnish_bins *bins) {
    free(bins->offsets);
    free(bins->entries);
    free(bins->counts);
    memset(bins, 0, sizeof *bins);
}
