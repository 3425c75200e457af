/* Triangle lists per tile. */
#ifndef BURNISH_RASTER_BINS_H
#define BURNISH_RASTER_BINS_H

#include <string.h>

#include "raster/geometry.h"
#include "raster/tile_layout.h"

/* Tiles from one to the other, both inclusive. */
typedef struct burnish_tile_box {
    int column0, row0, column1, row1;
} burnish_tile_box;

/* The tiles that the bounds of triangle `lane` of a batch touch. */
static inline burnish_tile_box burnish_tile_box_of(const burnish_triangle_batch *batch,
                                                   unsigned lane) {
    const uint32_t first = batch->first[lane], last = batch->last[lane];
    return (burnish_tile_box){(int)(BURNISH_PACKED_X(first) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_Y(first) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_X(last) / BURNISH_HIZ_SIZE),
                              (int)(BURNISH_PACKED_Y(last) / BURNISH_HIZ_SIZE)};
}

/* Tile lists of a band of tile rows: two per tile, of the front-facing triangles, then of the
 * back-facing ones. Of two triangles at the same depth, the one drawn first remains visible. Lists
 * consist of chunks, so one pass over the triangles fills all lists. Each slice of the triangles
 * has lists of its own; a tile's follow one another. */
enum {
    BURNISH_CHUNK_ENTRIES = 16,
    BURNISH_LISTS_MAX = 1 << 21 /* of all slices: 16 MiB */
};

/* Triangles of a batch. */
typedef struct burnish_bin_entry {
    uint32_t batch;
    uint32_t mask; /* bit i: triangle i of it */
} burnish_bin_entry;

/* The first chunk (0: the list is empty), and where in the entries the next one goes. */
typedef struct burnish_tile_list {
    uint32_t first, next;
} burnish_tile_list;

typedef struct burnish_bin_slice {
    burnish_tile_list *lists;
    burnish_bin_entry *entries; /* chunk after chunk; batches ascend along a list */
    uint32_t *next_chunks;      /* of a list, after each of its chunks */
    size_t chunk_count;         /* with chunk 0, which is not used */
    size_t chunk_capacity;      /* that may be used */
    size_t list_capacity, entry_capacity, next_capacity; /* entry_capacity in chunks */
    int fits;                                            /* 0: the limit was reached */
    burnish_status status;
    burnish_error error;
} burnish_bin_slice;

typedef struct burnish_bins {
    const burnish_context *context;
    int columns, rows; /* tiles: of the image's width; of its height, down to the limit */
    int row_limit;     /* rows of tiles from it on are not drawn */
    int first_row, end_row;
    burnish_bin_slice *slices;
    size_t slice_count, slice_capacity;
    size_t entry_budget; /* entries that a band of several rows may hold */
} burnish_bins;

/* Bins before a frame's first band; all zero before the first frame. The context, which may be
 * NULL, is the same in every frame. To draw a part of the image set end_row to its first row of
 * tiles afterwards, and row_limit. */
void burnish_bins_begin(burnish_bins *bins, const burnish_context *context);

/* Fills bins with the next band, from bins->end_row on: as many tile rows as keep the entries
 * within the budget, at least one. The lists do not depend on threads or the instruction set.
 * Errors: MEMORY, LIMIT. */
burnish_status burnish_bin_tiles(burnish_bins *bins, const burnish_raster_ops *ops,
                                 const burnish_geometry *geometry, const burnish_raster_view *view,
                                 burnish_tasks *tasks, burnish_error *error);

void burnish_bins_destroy(burnish_bins *bins);

/* ---- Bands: as many rows of tiles as fit the budget. Frames and depth maps are drawn so. ---- */

/* Inputs for drawing a picture's tiles. */
typedef struct burnish_bands {
    burnish_bins *bins;
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    const burnish_raster_view *view;
    burnish_tasks *tasks;
    int threads;                    /* that draw at the same time, at most */
    const burnish_context *context; /* whose memory is used */
} burnish_bands;

/* Draws the tile (column, row), whose lists are in the bins; `thread` < threads. */
typedef void burnish_tile_function(void *context, int column, int row, int thread);

/* Draws every tile once. Errors: MEMORY, CANCELLED, LIMIT. */
burnish_status burnish_bands_draw(const burnish_bands *bands, burnish_tile_function *draw,
                                  void *context, burnish_error *error);

/* The same for the rows of tiles [first_row, end_row) alone. */
burnish_status burnish_bands_draw_rows(const burnish_bands *bands, int first_row, int end_row,
                                       burnish_tile_function *draw, void *context,
                                       burnish_error *error);

/* ---- Lists ---- */

/* Reads a list in order. */
typedef struct burnish_list_reader {
    const burnish_bins *bins;
    size_t list, slice;
    uint32_t chunk;
} burnish_list_reader;

static inline burnish_list_reader burnish_list_begin(const burnish_bins *bins, int column, int row,
                                                     int back) {
    const size_t tile = (size_t)(row - bins->first_row) * (size_t)bins->columns + (size_t)column;
    burnish_list_reader reader = {bins, 2 * tile + (size_t)back, 0, 0};
    reader.chunk = bins->slices[0].lists[reader.list].first;
    return reader;
}

/* Copies as many of the next entries as fit capacity >= BURNISH_CHUNK_ENTRIES; 0 at the end. */
static inline size_t burnish_list_read(burnish_list_reader *reader, burnish_bin_entry *entries,
                                       size_t capacity) {
    size_t count = 0;
    while (reader->slice < reader->bins->slice_count) {
        const burnish_bin_slice *slice = &reader->bins->slices[reader->slice];
        if (!reader->chunk) {
            if (++reader->slice < reader->bins->slice_count) {
                reader->chunk = slice[1].lists[reader->list].first;
            }
            continue;
        }
        const size_t first = (size_t)reader->chunk * BURNISH_CHUNK_ENTRIES;
        const size_t next = slice->lists[reader->list].next;
        const int is_last = next > first && next - first <= BURNISH_CHUNK_ENTRIES;
        const size_t size = is_last ? next - first : BURNISH_CHUNK_ENTRIES;
        if (count + size > capacity) {
            break;
        }
        memcpy(entries + count, slice->entries + first, size * sizeof *entries);
        count += size;
        reader->chunk = is_last ? 0 : slice->next_chunks[reader->chunk];
    }
    return count;
}

static inline int burnish_list_is_empty(burnish_list_reader reader) {
    for (size_t i = 0; i < reader.bins->slice_count; ++i) {
        if (reader.bins->slices[i].lists[reader.list].first) {
            return 0;
        }
    }
    return 1;
}

#endif
