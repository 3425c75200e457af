/* Large triangles that cover a whole tile hide others, in any order of its list. They enter HiZ
 * before any triangle is drawn, so most hidden triangles are culled.
 *
 * This changes no bit. HiZ's cells get a depth that is farther than the triangle by more than
 * rounding (compute_depth_bounds), and a triangle is left out only where it is farther than that:
 * it would be hidden once both are drawn. Equal depths, which the order in the list decides, are
 * never left out, but for a triangle that has the same vertices in the same order as one before it:
 * it has the same depth everywhere, and comes second. */
#ifndef BURNISH_RASTER_OCCLUDERS_SIMD_H
#define BURNISH_RASTER_OCCLUDERS_SIMD_H

#include "raster/large_simd.h"

enum {
    OCCLUDERS_LEAST = 16, /* fewer are drawn faster than looked at twice */
    OCCLUDERS_MOST = 512, /* of a part of a list */
    OCCLUDERS_RECENT = 64 /* whose vertices are remembered; a power of two */
};

/* Triangles whose bounds hold the tile, in the order of the list. */
typedef struct occluders {
    size_t count;
    uint32_t indices[OCCLUDERS_MOST];
    uint16_t recent[OCCLUDERS_RECENT]; /* 1 + position in indices, by a hash of the vertices */
} occluders;

/* Whether a triangle with these vertices is there; remembers it where it is not. */
static int is_repeated(occluders *found, const burnish_geometry *geometry, uint32_t index,
                       unsigned back) {
    const burnish_primitive new = burnish_geometry_primitive(geometry, index, back);
    const uint32_t hash =
        (new.vertices[0] + 0x9e3779b1u * new.vertices[1] + 0x85ebca6bu * new.vertices[2]) >> 8;
    uint16_t *recent = &found->recent[hash % OCCLUDERS_RECENT];
    if (*recent) {
        const burnish_primitive old =
            burnish_geometry_primitive(geometry, found->indices[*recent - 1], back);
        if (memcmp(old.vertices, new.vertices, sizeof new.vertices) == 0) {
            return 1;
        }
    }
    *recent = (uint16_t)(found->count + 1);
    return 0;
}

/* Finds them in entries, from which repeated ones are removed. */
static void find_occluders(const burnish_tile *tile, const burnish_geometry *geometry,
                           unsigned back, burnish_bin_entry *entries, size_t count,
                           occluders *found) {
    const uint32_t x0 = (uint32_t)tile->x / BURNISH_HIZ_PIXELS;
    const uint32_t y0 = (uint32_t)tile->y / BURNISH_HIZ_PIXELS;
    const uint32_t x1 = x0 + (uint32_t)(tile->width - 1) / BURNISH_HIZ_PIXELS;
    const uint32_t y1 = y0 + (uint32_t)(tile->height - 1) / BURNISH_HIZ_PIXELS;
    found->count = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t batch = entries[i].batch;
        if (geometry->headers[batch].tile != BURNISH_NO_TILE) {
            continue;
        }
        const burnish_triangle_batch *bounds = &geometry->batches[batch];
        for (unsigned rest = entries[i].mask; rest && found->count < OCCLUDERS_MOST;
             rest &= rest - 1) {
            const unsigned lane = (unsigned)__builtin_ctz(rest);
            const uint32_t first = bounds->first[lane], last = bounds->last[lane];
            if (BURNISH_PACKED_X(first) > x0 || BURNISH_PACKED_Y(first) > y0 ||
                BURNISH_PACKED_X(last) < x1 || BURNISH_PACKED_Y(last) < y1) {
                continue;
            }
            if (found->count == 0) {
                memset(found->recent, 0, sizeof found->recent);
            }
            const uint32_t index = batch * BURNISH_BATCH_SIZE + lane;
            if (is_repeated(found, geometry, index, back)) {
                entries[i].mask ^= 1u << lane;
            } else {
                found->indices[found->count++] = index;
            }
        }
    }
}

/* Tells HiZ's cells of them. */
static void fill_cells(burnish_tile *tile, const burnish_geometry *geometry, const occluders *found,
                       unsigned back) {
    const int samples = tile->options.samples;
    triangle_setup setup;
    large_group group;
    large_triangle large;
    for (size_t first = 0; first < found->count; first += LANES) {
        const size_t left = found->count - first, lanes = left < LANES ? left : LANES;
        vi x[3], y[3];
        vf depth[3];
        fetch_group(tile, geometry, found->indices + first, lanes, back, &setup.primitives);
        load_group(tile, geometry, &setup, x, y, depth);
        compute_setup(tile, lanes, x, y, depth, &setup);
        prepare_large(samples, 0, &setup, &group);
        for (unsigned rest = setup.live & ~setup.small; rest; rest &= rest - 1) {
            load_large(&group, (size_t)__builtin_ctz(rest), samples, 0, &large);
            for (int column = 0; column < BURNISH_HIZ_SIZE; column += CELL_COLUMNS) {
                edge_cells edges[3];
                start_edges(&large, column, 0, edges);
                for (int row = 0; row < BURNISH_HIZ_SIZE; row += CELL_ROWS) {
                    unsigned inside;
                    classify_cells(tile, &large, 0, column, row, edges, &inside);
                }
            }
        }
    }
}

#endif
