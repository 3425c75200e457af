/* Appends triangles to tile lists with SIMD. */
#ifndef BURNISH_RASTER_BINS_SIMD_H
#define BURNISH_RASTER_BINS_SIMD_H

#include "raster/bins.h"
#include "raster/geometry_simd.h"

enum { ALL_OF_BATCH = (1 << BURNISH_BATCH_SIZE) - 1 };

/* Begins a chunk of a list that is empty or whose last chunk is full. Returns 0 if the slice is out
 * of chunks. */
static int append_chunk(burnish_bin_slice *slice, burnish_tile_list *list) {
    if (slice->chunk_count == slice->chunk_capacity) {
        return 0;
    }
    const uint32_t chunk = (uint32_t)slice->chunk_count++;
    if (list->first) {
        slice->next_chunks[list->next / BURNISH_CHUNK_ENTRIES - 1] = chunk;
    } else {
        list->first = chunk;
    }
    list->next = chunk * BURNISH_CHUNK_ENTRIES;
    return 1;
}

/* Appends triangles of a batch to a list. Returns 0 if the slice is out of chunks. It is
 * unpredictable whether the list's last entry is of the same batch, so this code has no branch. */
static inline int append_entry(burnish_bin_slice *slice, burnish_tile_list *list, size_t batch,
                               unsigned mask) {
    uint32_t next = list->next;
    const burnish_bin_entry last = slice->entries[next ? next - 1 : 0];
    const uint32_t is_same = (next > 0) & (last.batch == batch);
    if (next % BURNISH_CHUNK_ENTRIES == 0 && !is_same) { /* full, or not begun */
        if (!append_chunk(slice, list)) {
            return 0;
        }
        next = list->next;
    }
    slice->entries[next - is_same] =
        (burnish_bin_entry){(uint32_t)batch, mask | (last.mask & (0 - is_same))};
    list->next = next + 1 - is_same;
    return 1;
}

/* The edge functions of a triangle, each at the corner of a tile where it is greatest: all are >= 0
 * for every tile in which the triangle has a sample. */
typedef struct tile_edges {
    int64_t at[3], right[3], down[3]; /* at the tile that the box begins with; steps per tile */
} tile_edges;

static tile_edges find_tile_edges(const burnish_geometry *geometry, size_t index, unsigned back,
                                  int column, int row) {
    enum { SIZE = BURNISH_TILE_SIZE * BURNISH_SUBPIXELS };
    const burnish_primitive primitive = burnish_geometry_primitive(geometry, index, back);
    tile_edges edges;
    for (int i = 0; i < 3; ++i) {
        const burnish_screen_vertex *a =
            &geometry->vertices.items[primitive.vertices[i == 2 ? 0 : i + 1]];
        const burnish_screen_vertex *b =
            &geometry->vertices.items[primitive.vertices[i == 0 ? 2 : i - 1]];
        const int64_t dx = b->x - a->x, dy = b->y - a->y;
        edges.right[i] = -dy * SIZE;
        edges.down[i] = dx * SIZE;
        edges.at[i] = dx * ((int64_t)row * SIZE - a->y) - dy * ((int64_t)column * SIZE - a->x) +
                      (dx > 0 ? edges.down[i] : 0) + (dy < 0 ? edges.right[i] : 0);
    }
    return edges;
}

/* A triangle to the lists of the band's tiles that it touches, or nearly so; 0 when there is no
 * room. Rods are long and thin: of the tiles that their bounds touch they touch few. */
static int bin_triangle(const burnish_bins *bins, burnish_bin_slice *slice,
                        const burnish_geometry *geometry, size_t batch, unsigned lane,
                        unsigned back) {
    burnish_tile_box box = burnish_tile_box_of(&geometry->batches[batch], lane);
    box.row0 = box.row0 < bins->first_row ? bins->first_row : box.row0;
    box.row1 = box.row1 >= bins->end_row ? bins->end_row - 1 : box.row1;
    tile_edges edges = {{0}, {0}, {0}};
    if (geometry->indices && box.column1 > box.column0 && box.row1 > box.row0) {
        edges = find_tile_edges(geometry, batch * BURNISH_BATCH_SIZE + lane, back, box.column0,
                                box.row0);
    }
    for (int row = box.row0; row <= box.row1; ++row) {
        const int base = (row - bins->first_row) * bins->columns;
        int64_t at[3] = {edges.at[0], edges.at[1], edges.at[2]};
        for (int column = box.column0; column <= box.column1; ++column) {
            burnish_tile_list *lists = &slice->lists[2 * (size_t)(base + column)];
            if ((at[0] | at[1] | at[2]) >= 0 &&
                !append_entry(slice, &lists[back], batch, 1u << lane)) {
                return 0;
            }
            for (int i = 0; i < 3; ++i) {
                at[i] += edges.right[i];
            }
        }
        for (int i = 0; i < 3; ++i) {
            edges.at[i] += edges.down[i];
        }
    }
    return 1;
}

/* Appends triangles of a batch that touch one tile. Returns 0 if the slice is out of chunks. */
static inline int bin_to_tile(const burnish_bins *bins, burnish_bin_slice *slice, size_t batch,
                              const burnish_batch_header *header, uint32_t tile, unsigned mask) {
    const int column = (int)BURNISH_PACKED_X(tile), row = (int)BURNISH_PACKED_Y(tile);
    if (row < bins->first_row || row >= bins->end_row) {
        return 1;
    }
    const size_t number = (size_t)((row - bins->first_row) * bins->columns + column);
    burnish_tile_list *lists = &slice->lists[2 * number];
    const unsigned front = header->visible[0] & mask, back = header->visible[1] & mask;
    return (!front || append_entry(slice, lists, batch, front)) &&
           (!back || append_entry(slice, lists + 1, batch, back));
}

/* The triangles of a batch to the lists of all tiles of the band that they touch; 0 when there is
 * no room. */
static int bin_batch(const burnish_bins *bins, burnish_bin_slice *slice,
                     const burnish_geometry *geometry, size_t batch) {
    const burnish_triangle_batch *bounds = &geometry->batches[batch];
    const burnish_batch_header *header = &geometry->headers[batch];
    unsigned rest = header->visible[0] | header->visible[1];
    unsigned in_one_tile = rest & ~spans_tiles(bounds);
    rest &= ~in_one_tile;
    while (in_one_tile) {
        const uint32_t tile = bounds->first[__builtin_ctz(in_one_tile)] & BURNISH_HIZ_TILE_MASK;
        const unsigned mask = in_one_tile & ~begins_elsewhere(bounds, tile);
        if (!bin_to_tile(bins, slice, batch, header, tile / BURNISH_HIZ_SIZE, mask)) {
            return 0;
        }
        in_one_tile &= ~mask;
    }
    for (; rest; rest &= rest - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(rest);
        if (!bin_triangle(bins, slice, geometry, batch, lane, header->visible[1] >> lane & 1)) {
            return 0;
        }
    }
    return 1;
}

static size_t bin_batches(const burnish_bins *bins, burnish_bin_slice *slice,
                          const burnish_geometry *geometry, size_t first, size_t end) {
    for (size_t i = first; i < end; ++i) {
        const burnish_batch_header *header = &geometry->headers[i];
        const int has_room = header->tile != BURNISH_NO_TILE /* as small triangles mostly have */
                                 ? bin_to_tile(bins, slice, i, header, header->tile, ALL_OF_BATCH)
                                 : bin_batch(bins, slice, geometry, i);
        if (!has_room) {
            return i;
        }
    }
    return end;
}

#endif
