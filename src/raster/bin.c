/* Triangle lists per tile, made for as many tile rows at a time as fit a fixed memory budget. */
#include <string.h>

#include "base/memory.h"
#include "raster/raster.h"

/* Entries that a band of several tile rows may hold: 128 MiB. One row alone may need more. */
#define ENTRY_BUDGET ((size_t)1 << 25)

/* Entries that each tile row needs, for the rows from first_row on. */
static void count_rows(const burnish_geometry *geometry, int first_row, size_t *row_entries) {
    for (size_t i = 0; i < geometry->triangle_count; ++i) {
        const uint8_t *t = geometry->triangles[i].tiles;
        for (int row = t[1] < first_row ? first_row : t[1]; row <= t[3]; ++row) {
            row_entries[row] += (size_t)(t[2] - t[0] + 1);
        }
    }
}

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

/* For both lists of every tile of the band that the triangles [first, end) touch: with entries NULL
 * counts them, else writes them at the places that counts has become. */
static void walk(const burnish_bins *bins, const burnish_geometry *geometry, size_t first,
                 size_t end, size_t *counts, uint32_t *entries) {
    for (size_t i = first; i < end; ++i) {
        const uint8_t *t = geometry->triangles[i].tiles;
        size_t back = geometry->triangles[i].source & 1;
        int row0 = t[1] < bins->first_row ? bins->first_row : t[1];
        int row1 = t[3] >= bins->end_row ? bins->end_row - 1 : t[3];
        for (int row = row0; row <= row1; ++row) {
            size_t *line =
                counts + 2 * (size_t)(row - bins->first_row) * (size_t)bins->columns + back;
            for (int column = t[0]; column <= t[2]; ++column) {
                size_t place = line[2 * column]++;
                if (entries) {
                    entries[place] = (uint32_t)i;
                }
            }
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
    memset(bins, 0, sizeof *bins);
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
    size_t count = geometry->triangle_count, slices = (size_t)threads;
    memset(bins->counts, 0, lists * slices * sizeof *bins->counts);
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (size_t s = 0; s < slices; ++s) {
        walk(bins, geometry, count * s / slices, count * (s + 1) / slices, bins->counts + s * lists,
             NULL);
    }
    size_t total = place_entries(bins, lists, threads);
    status = burnish_grow((void **)&bins->entries, &bins->entry_capacity, total,
                          sizeof *bins->entries, "tile lists", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (size_t s = 0; s < slices; ++s) {
        walk(bins, geometry, count * s / slices, count * (s + 1) / slices, bins->counts + s * lists,
             bins->entries);
    }
    return BURNISH_STATUS_OK;
}

void burnish_bins_destroy(burnish_bins *bins) {
    free(bins->offsets);
    free(bins->entries);
    free(bins->counts);
    memset(bins, 0, sizeof *bins);
}
