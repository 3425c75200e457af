/* The HiZ cells of a tile: a farthest depth each, by which triangles are left out. */
#ifndef BURNISH_RASTER_HIZ_SIMD_H
#define BURNISH_RASTER_HIZ_SIMD_H

#include "raster/large_simd.h"

/* ---- Cells from depths, and what they hide ---- */

/* Interpolated depths may pass the nearest vertex by rounding: the margin is far more than that. It
 * would make depths below 0 farther, so those are never hidden. */
#define HIZ_MARGIN 1.00001f

/* Whether all cells of a box are nearer than a triangle. */
static int hiz_test(const burnish_hiz *hiz, float nearest, int x0, int y0, int x1, int y1) {
    nearest *= HIZ_MARGIN;
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if (nearest >= hiz->cells[y * BURNISH_HIZ_SIZE + x]) {
                return 0;
            }
        }
    }
    return nearest > 0.0f;
}

/* The triangles `lanes` of a batch, from item `at` on, that may be seen. Most touch at most 2 x 2
 * cells. */
BURNISH_INLINE unsigned hiz_cull_vector(const burnish_tile *tile,
                                        const burnish_triangle_batch *batch, size_t at,
                                        unsigned lanes) {
    const vi last = vi_set(BURNISH_HIZ_SIZE - 1), zero = vi_set(0), low = vi_set(0xffff);
    const vi left = vi_set(tile->x / BURNISH_HIZ_PIXELS);
    const vi top = vi_set(tile->y / BURNISH_HIZ_PIXELS);
    const vi first = vi_load((const int32_t *)batch->first + at);
    const vi end = vi_load((const int32_t *)batch->last + at);
    vi x0 = vi_max(vi_sub(vi_and(first, low), left), zero);
    vi y0 = vi_max(vi_sub(vi_shr(first, 16), top), zero);
    vi x1 = vi_min(vi_sub(vi_and(end, low), left), last);
    vi y1 = vi_min(vi_sub(vi_shr(end, 16), top), last);
    /* cells of triangles that are not asked for may be anywhere */
    vi cell = vi_and(vi_or(vi_shl(y0, BURNISH_HIZ_BITS), x0),
                     vi_set(BURNISH_HIZ_SIZE * BURNISH_HIZ_SIZE - 1));
    vf farthest = vf_gather(tile->hiz.quads, cell);
    vf nearest = vf_mul(vf_load(batch->nearest + at), vf_set(HIZ_MARGIN));
    unsigned hidden =
        vm_bits(vm_and(vf_greater(farthest, nearest), vf_greater(nearest, vf_set(0.0f))));
    unsigned large = vm_bits(vi_greater(vi_max(vi_sub(x1, x0), vi_sub(y1, y0)), vi_set(1)));
    for (unsigned rest = large & lanes; rest; rest &= rest - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(rest);
        int32_t box[4][LANES];
        vi_store(box[0], x0);
        vi_store(box[1], y0);
        vi_store(box[2], x1);
        vi_store(box[3], y1);
        const int is_hidden = hiz_test(&tile->hiz, batch->nearest[at + lane], box[0][lane],
                                       box[1][lane], box[2][lane], box[3][lane]);
        hidden = (hidden & ~(1u << lane)) | (unsigned)is_hidden << lane;
    }
    return lanes & ~hidden;
}

/* Removes the triangles that HiZ hides wherever they touch the tile; returns how many entries are
 * left. */
static size_t hiz_cull(const burnish_tile *tile, const burnish_geometry *geometry,
                       burnish_bin_entry *entries, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_bin_entry entry = entries[i];
        const burnish_triangle_batch *batch = &geometry->batches[entry.batch];
        unsigned visible = 0;
        for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
            const unsigned lanes = entry.mask >> at & ALL_LANES;
            visible |= lanes ? hiz_cull_vector(tile, batch, at, lanes) << at : 0;
        }
        entries[kept] = (burnish_bin_entry){entry.batch, visible};
        kept += visible != 0;
    }
    return kept;
}

/* The least depth of a cell's four blocks, `depths` being the first one's: lane by lane, then over
 * the lanes. */
BURNISH_INLINE float hiz_reduce(const float *depths, int samples) {
    enum { PARTS = BURNISH_BLOCK_PIXELS / LANES, CELL = BURNISH_HIZ_PIXELS / BURNISH_BLOCK_SIZE };
    const int size = samples * BURNISH_BLOCK_PIXELS;
    vf min[PARTS];
    float lanes[BURNISH_BLOCK_PIXELS];
    for (int part = 0; part < PARTS; ++part) {
        min[part] = vf_load(depths + part * LANES);
    }
    for (int row = 0; row < CELL; ++row, depths += BURNISH_TILE_BLOCKS * size) {
        for (int i = 0; i < CELL * size; i += BURNISH_BLOCK_PIXELS) {
            for (int part = 0; part < PARTS; ++part) {
                min[part] = vf_min(vf_load(depths + i + part * LANES), min[part]);
            }
        }
    }
    for (int part = 0; part < PARTS; ++part) {
        vf_store(lanes + part * LANES, min[part]);
    }
    for (int half = BURNISH_BLOCK_PIXELS / 2; half > 0; half /= 2) {
        for (int i = 0; i < half; ++i) {
            lanes[i] = lanes[half + i] < lanes[i] ? lanes[half + i] : lanes[i];
        }
    }
    return lanes[0];
}

/* The least of each 2 x 2 cells. */
static void hiz_build_quads(burnish_hiz *hiz) {
    enum { SIZE = BURNISH_HIZ_SIZE };
    for (int y = 0; y < SIZE; ++y) {
        const float *row = hiz->cells + y * SIZE, *below = y < SIZE - 1 ? row + SIZE : row;
        for (int x = 0; x < SIZE; ++x) {
            const int next = x < SIZE - 1 ? x + 1 : x;
            const float first = row[x] < row[next] ? row[x] : row[next];
            const float second = below[x] < below[next] ? below[x] : below[next];
            hiz->quads[y * SIZE + x] = first < second ? first : second;
        }
    }
}

static void hiz_build(burnish_tile *tile) {
    enum { SIZE = BURNISH_HIZ_SIZE, CELL = BURNISH_HIZ_PIXELS / BURNISH_BLOCK_SIZE };
    const int samples = tile->options.samples, size = samples * BURNISH_BLOCK_PIXELS;
    float *cells = tile->hiz.cells;
    for (int y = 0; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x) {
            const int block = CELL * (y * BURNISH_TILE_BLOCKS + x);
            cells[y * SIZE + x] = hiz_reduce(tile->buffer.depths + block * size, samples);
        }
    }
    hiz_build_quads(&tile->hiz);
}

/* ---- Occluders ---- */

/* Large triangles that cover a whole tile hide others, in any order of its list. They enter HiZ
 * before any triangle is drawn, so most hidden triangles are culled.
 *
 * This changes no bit. HiZ's cells get a depth that is farther than the triangle by more than
 * rounding (compute_depth_bounds), and a triangle is left out only where it is farther than that:
 * it would be hidden once both are drawn. Equal depths, which the order in the list decides, are
 * never left out, but for a triangle that has the same vertices in the same order as one before it:
 * it has the same depth everywhere, and comes second. */
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

/* Looks for large triangles that hide others of the same part of a list; returns whether there are
 * some. */
static int hiz_fill(burnish_tile *tile, const burnish_geometry *geometry, unsigned back,
                    burnish_bin_entry *entries, size_t count) {
    occluders found;
    find_occluders(tile, geometry, back, entries, count, &found);
    if (found.count < OCCLUDERS_LEAST) {
        return 0;
    }
    fill_cells(tile, geometry, &found, back);
    hiz_build_quads(&tile->hiz);
    return 1;
}

#endif
