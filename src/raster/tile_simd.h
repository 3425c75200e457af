/* Drawing triangles into a tile by vectors.
 *
 * Edge functions are whole numbers and exact: 32-bit ones for triangles up to 96 pixels, doubles,
 * which hold all of them, for larger ones. What is computed from them keeps one order of
 * operations, that of test/reference_tile.h.
 *
 * As many triangles as a vector has lanes are set up at once. Then each is drawn by units, the part
 * of a block of pixels that is one vector; or, where several are small, their pixels are found for
 * all of them at once. */

#ifndef BURNISH_RASTER_TILE_SIMD_H
#define BURNISH_RASTER_TILE_SIMD_H

#include "raster/geometry_simd.h"
#include "raster/tile.h"

enum { HALF_PIXEL = BURNISH_SUBPIXELS / 2 };

/* Pixels of a unit: 4 x 4, 4 x 2, 4 x 1 or one. */
enum {
    UNIT_WIDTH = LANES >= 4 ? 4 : 1,
    UNIT_HEIGHT = LANES / UNIT_WIDTH,
    UNIT_HEIGHT_BITS = UNIT_HEIGHT == 4   ? 2
                       : UNIT_HEIGHT == 2 ? 1
                                          : 0,
    UNIT_SIDE = 4 /* units across and down of triangles whose units are listed, at most */
};

/* Corners of as many triangles as a vector has lanes. */
typedef struct primitive_group {
    uint32_t vertices[3][LANES], id_and_facing[LANES];
} primitive_group;

/* As many triangles as a vector has lanes, relative to the tile. */
typedef struct setup_block {
    int32_t x[3][LANES], y[3][LANES];   /* vertices */
    int32_t dx[3][LANES], dy[3][LANES]; /* edge i runs from vertex i + 1 to vertex i + 2 */
    int32_t bias[3][LANES];             /* -1 where the top-left rule leaves the edge out */
    int32_t start[3][LANES];            /* edge functions with bias at the centre of (x0, y0) */
    int32_t unit[3][LANES];             /* the same at the first pixel of its unit */
    int32_t slope[3][LANES];            /* -dy in the lower half, dx in the upper one */
    int32_t x0[LANES], y0[LANES], x1[LANES], y1[LANES]; /* pixels of the tile that the bounds touch;
                                                           x1, y1 inclusive */
    float depth[3][LANES];                              /* of vertex 0; of 1 and 2 minus that */
    int32_t longest[LANES];                             /* edge, along an axis */
    float inverse_area[LANES]; /* of triangles whose edge functions fit 32 bits */
    float attributes[3][BURNISH_PLANE_COUNT][LANES];
    primitive_group corners;
    unsigned live, small, tiny, wide; /* bits: touch a pixel; have 32-bit edge functions; have at
                                         most 2 x 2 pixels; are too large to have their units
                                         listed */
} setup_block;

/* Finds the corners of some slots, `count` <= LANES, and asks for what will be loaded of them:
 * lists are in the mesh's order, not in that of memory. */
BURNISH_INLINE void find_corners(const burnish_tile *tile, const burnish_geometry *geometry,
                                 const uint32_t *slots, size_t count, unsigned back,
                                 primitive_group *corners) {
    for (size_t lane = 0; lane < LANES && count > 0; ++lane) {
        const burnish_primitive found =
            burnish_geometry_primitive(geometry, slots[lane < count ? lane : 0], back);
        corners->id_and_facing[lane] = found.id_and_facing;
        for (int i = 0; i < 3; ++i) {
            const size_t vertex = found.vertices[i];
            corners->vertices[i][lane] = found.vertices[i];
            __builtin_prefetch(&geometry->vertices.items[vertex]);
            __builtin_prefetch(&tile->attributes[0][vertex]);
        }
    }
}

/* Loads corners and attributes of a block. */
BURNISH_INLINE void load_block(const burnish_tile *tile, const burnish_geometry *geometry,
                               setup_block *block, vi x[3], vi y[3], vf depth[3]) {
    const primitive_group *corners = &block->corners;
    /* 1 for triangles seen from their front, -1 from their back: exact */
    const vi sign = vi_shl(vi_load((const int32_t *)corners->id_and_facing), 31);
    const vf turn = vf_from_bits(vi_or(sign, vi_set(0x3f800000)));
    for (int i = 0; i < 3; ++i) {
        const void *from[LANES];
        vf at[4];
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &geometry->vertices.items[corners->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        x[i] = vi_sub(vf_bits(at[0]), vi_set(tile->x * BURNISH_SUBPIXELS));
        y[i] = vi_sub(vf_bits(at[1]), vi_set(tile->y * BURNISH_SUBPIXELS));
        depth[i] = at[2];
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &tile->attributes[0][corners->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        for (int k = 0; k < 3; ++k) {
            vf_store(block->attributes[i][k], vf_mul(at[k], turn));
        }
        vf_store(block->attributes[i][BURNISH_PLANE_W], at[3]);
        if (tile->options.planes <= BURNISH_PLANE_R) {
            continue;
        }
        for (int lane = 0; lane < LANES; ++lane) {
            from[lane] = &tile->attributes[1][corners->vertices[i][lane]];
        }
        vf_load_aos4(from, at);
        for (int k = 0; k < 3; ++k) {
            vf_store(block->attributes[i][BURNISH_PLANE_R + k], at[k]);
        }
    }
}

/* Bounds, edges and depth of a block. Numbers of triangles that are too large wrap round and are
 * not used. */
BURNISH_INLINE void set_up_block(const burnish_tile *tile, size_t count, const vi x[3],
                                 const vi y[3], const vf depth[3], setup_block *block) {
    const int samples = tile->options.samples;
    vi dx[3], dy[3], x0, y0, x1, y1, longest = vi_set(0);
    find_pixels(samples, x, tile->width, &x0, &x1);
    find_pixels(samples, y, tile->height, &y0, &y1);
    vi_store(block->x0, x0);
    vi_store(block->y0, y0);
    vi_store(block->x1, x1);
    vi_store(block->y1, y1);
    const vi wide = vi_sub(x1, x0), high = vi_sub(y1, y0);
    const vi at_x = vi_add(vi_shl(x0, 8), vi_set(HALF_PIXEL));
    const vi at_y = vi_add(vi_shl(y0, 8), vi_set(HALF_PIXEL));
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        dx[i] = vi_sub(x[b], x[a]);
        dy[i] = vi_sub(y[b], y[a]);
        longest = vi_max(longest, vi_max(magnitude(dx[i]), magnitude(dy[i])));
        const vi zero = vi_set(0);
        vm left = vi_greater(zero, dy[i]);
        vm top = vm_and(vi_equal(dy[i], zero), vi_greater(dx[i], zero));
        vi bias = vi_blend(vm_or(left, top), zero, vi_set(-1));
        vi start = vi_sub(vi_mul(dx[i], vi_sub(at_y, y[a])), vi_mul(dy[i], vi_sub(at_x, x[a])));
        vi_store(block->x[i], x[i]);
        vi_store(block->y[i], y[i]);
        vi_store(block->dx[i], dx[i]);
        vi_store(block->dy[i], dy[i]);
        vi_store(block->bias[i], bias);
        start = vi_add(start, bias);
        vi_store(block->start[i], start);
        start = vi_add(start, vi_shl(vi_mul(dy[i], vi_and(x0, vi_set(UNIT_WIDTH - 1))), 8));
        start = vi_sub(start, vi_shl(vi_mul(dx[i], vi_and(y0, vi_set(UNIT_HEIGHT - 1))), 8));
        vi_store(block->unit[i], start);
        vi minus = vi_and(vi_sub(vi_set(0), dy[i]), vi_set(0xffff));
        vi_store(block->slope[i], vi_or(minus, vi_shl(dx[i], 16)));
    }
    vf area = vf_from_int(vi_sub(vi_mul(dx[2], dy[0]), vi_mul(dy[2], dx[0])));
    vf_store(block->inverse_area, vf_div(vf_set(1.0f), area));
    vi_store(block->longest, longest);
    vf_store(block->depth[0], depth[0]);
    vf_store(block->depth[1], vf_sub(depth[1], depth[0]));
    vf_store(block->depth[2], vf_sub(depth[2], depth[0]));
    const unsigned real = (unsigned)((1ull << count) - 1);
    block->live = vm_bits(vi_not_negative(vi_or(wide, high))) & real;
    block->small = vm_bits(vm_not(vi_greater(longest, vi_set(BURNISH_SMALL_EDGE))));
    block->tiny = block->live & block->small & vm_bits(vi_greater(vi_set(2), vi_max(wide, high)));
    const vi columns = vi_sub(vi_sar(x1, 2), vi_sar(x0, 2));
    const vi rows = vi_sub(vi_sar(y1, UNIT_HEIGHT_BITS), vi_sar(y0, UNIT_HEIGHT_BITS));
    block->wide = block->live &
                  ~(block->small & vm_bits(vi_greater(vi_set(UNIT_SIDE), vi_max(columns, rows))));
}

/* One triangle of a block in the form that its units are drawn from. */
typedef struct unit_constants {
    vf inverse_area, depth[3];
    vi bias[3], id;
    vf attributes[3][BURNISH_PLANE_COUNT];
} unit_constants;

BURNISH_INLINE void load_constants(const setup_block *block, size_t lane, int planes, int32_t id,
                                   unit_constants *constants) {
    constants->inverse_area = vf_set(block->inverse_area[lane]);
    constants->id = vi_set(id);
    for (int i = 0; i < 3; ++i) {
        constants->depth[i] = vf_set(block->depth[i][lane]);
        constants->bias[i] = vi_set(block->bias[i][lane]);
        for (int k = 0; k < planes; ++k) {
            constants->attributes[i][k] = vf_set(block->attributes[i][k][lane]);
        }
    }
}

BURNISH_INLINE vf depth_from(const vf depth[3], vf weight1, vf weight2) {
    return vf_add(vf_add(depth[0], vf_mul(weight1, depth[1])), vf_mul(weight2, depth[2]));
}

/* Weights of vertices 1 and 2 from edge functions with their bias. */
BURNISH_INLINE vf weight_from(const unit_constants *constants, const vi e[3], int i) {
    return vf_mul(vf_from_int(vi_sub(e[i], constants->bias[i])), constants->inverse_area);
}

/* Attributes of the pixels of a unit from `place` on that `mask` holds. */
BURNISH_INLINE void interpolate_unit(const burnish_tile *tile, const unit_constants *constants,
                                     int planes, vm mask, vf weight1, vf weight2, int place) {
    vf weight0 = vf_sub(vf_sub(vf_set(1.0f), weight1), weight2);
    for (int k = 0; k < planes; ++k) {
        vf sum = vf_add(vf_mul(constants->attributes[0][k], weight0),
                        vf_mul(constants->attributes[1][k], weight1));
        sum = vf_add(sum, vf_mul(constants->attributes[2][k], weight2));
        vf_store_where(mask, tile->planes[k] + place, sum);
    }
}

/* Steps of a block's small triangles' edge functions from a pixel's centre to its samples. */
typedef struct sample_steps {
    int32_t step[3][BURNISH_MAX_SAMPLES][LANES];
    int32_t farthest[3][LANES]; /* no sample is farther inside an edge than this */
} sample_steps;

BURNISH_INLINE void find_steps(const setup_block *block, int samples, sample_steps *steps) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    for (int i = 0; i < 3; ++i) {
        const vi slope = vi_load(block->slope[i]);
        vi farthest = vi_set(INT32_MIN);
        for (int s = 0; s < samples; ++s) {
            const vi offset = vi_set((offsets[s][0] & 0xffff) | offsets[s][1] * 0x10000);
            const vi step = vi_shl(vi_dot16(slope, offset), 4);
            farthest = vi_max(farthest, step);
            vi_store(steps->step[i][s], step);
        }
        vi_store(steps->farthest[i], farthest);
    }
}

/* A unit with several samples a pixel; e are the edge functions at the pixels' centres. */
BURNISH_INLINE int draw_samples(const burnish_tile *tile, const unit_constants *constants,
                                int samples, int planes, const vi e[3], const sample_steps *steps,
                                size_t lane, int place) {
    vm whole = vi_not_negative(vi_set(0));
    unsigned drawn = 0;
    int sample = burnish_sample_index(samples, place, 0);
    for (int s = 0; s < samples; ++s, sample += BURNISH_BLOCK_PIXELS) {
        vi at[3];
        for (int i = 0; i < 3; ++i) {
            at[i] = vi_add(e[i], vi_set(steps->step[i][s][lane]));
        }
        vm covered = vi_not_negative(vi_or(vi_or(at[0], at[1]), at[2]));
        vf depth = depth_from(constants->depth, weight_from(constants, at, 1),
                              weight_from(constants, at, 2));
        vm nearer = vm_and(covered, vf_greater(depth, vf_load(tile->depths + sample)));
        whole = vm_and(whole, nearer);
        vf_store_where(nearer, tile->depths + sample, depth);
        vi_store_where(nearer, tile->ids + sample, constants->id);
        drawn |= vm_bits(nearer);
    }
    if (vm_any(whole)) {
        vf weight1 = weight_from(constants, e, 1), weight2 = weight_from(constants, e, 2);
        if (tile->options.needs_position) {
            vf_store_where(whole, tile->center_depths + place,
                           depth_from(constants->depth, weight1, weight2));
        }
        interpolate_unit(tile, constants, planes, whole, weight1, weight2, place);
    }
    return drawn != 0;
}

/* Where the pixels of a unit lie in it: x, and y in the upper half. */
#define AT(x, y) ((x) | (y) << 16)
static const int32_t UNIT_PLACES[16] = {AT(0, 0), AT(1, 0), AT(2, 0), AT(3, 0), AT(0, 1), AT(1, 1),
                                        AT(2, 1), AT(3, 1), AT(0, 2), AT(1, 2), AT(2, 2), AT(3, 2),
                                        AT(0, 3), AT(1, 3), AT(2, 3), AT(3, 3)};
#undef AT

/* Edge function i of a triangle over the first unit, and its steps to the next ones. Slopes fit 16
 * bits. */
BURNISH_INLINE vi edge_of_unit(const setup_block *block, size_t lane, int i, vi *across, vi *down) {
    *across = vi_set(block->dy[i][lane] * (-BURNISH_SUBPIXELS * UNIT_WIDTH));
    *down = vi_set(block->dx[i][lane] * (BURNISH_SUBPIXELS * UNIT_HEIGHT));
    vi along = vi_dot16(vi_set(block->slope[i][lane]), vi_load(UNIT_PLACES));
    return vi_add(vi_set(block->unit[i][lane]), vi_shl(along, 8));
}

/* Marks the block of a place that shows a triangle. */
BURNISH_INLINE void touch(burnish_tile *tile, int place, int hit) {
    tile->dirty_blocks[place / BURNISH_BLOCK_ROW_PIXELS] |=
        (uint16_t)(hit << (place / BURNISH_BLOCK_PIXELS) % BURNISH_TILE_BLOCKS);
}

/* Draws a unit, one sample a pixel, where `covered` holds. Whether it is nearer is too hard to
 * foresee for a branch. */
BURNISH_INLINE void draw_unit(burnish_tile *tile, const unit_constants *constants, int planes,
                              int ids, vm covered, const vi e[3], int place) {
    vf weight1 = weight_from(constants, e, 1), weight2 = weight_from(constants, e, 2);
    vf depth = depth_from(constants->depth, weight1, weight2);
    vf before = vf_load(tile->depths + place);
    vm nearer = vm_and(covered, vf_greater(depth, before));
    vf_store(tile->depths + place, vf_blend(nearer, depth, before));
    if (ids) {
        vi_store_where(nearer, tile->ids + place, constants->id);
    }
    interpolate_unit(tile, constants, planes, nearer, weight1, weight2, place);
    touch(tile, place, vm_any(nearer));
}

/* The units that a block of triangles may cover, triangle after triangle: with so many triangles of
 * so few units each, loops over one triangle's units end where no processor foresees it. */
enum { MOST_UNITS = UNIT_SIDE * UNIT_SIDE, UNIT_LIST = LANES * MOST_UNITS };
typedef struct unit_list {
    int32_t along[3][LANES][LANES]; /* edge functions of a triangle over its first unit, less
                                       those at the unit's first pixel, ... */
    int32_t start[3][UNIT_LIST + MOST_UNITS]; /* ... which are here, a unit each */
    int32_t place[UNIT_LIST + MOST_UNITS];    /* and the lane times BURNISH_TILE_PIXELS */
    int32_t covering[UNIT_LIST];              /* units that cover a pixel */
    vm covered[UNIT_LIST];
} unit_list;

/* First pixels of the units of boxes of 1 to UNIT_SIDE units by as many, row after row: x, and y in
 * the upper half. */
#define AT(x, y) ((x)*UNIT_WIDTH | (y)*UNIT_HEIGHT << 16)
#define ROW1(y) AT(0, y)
#define ROW2(y) AT(0, y), AT(1, y)
#define ROW3(y) AT(0, y), AT(1, y), AT(2, y)
#define ROW4(y) AT(0, y), AT(1, y), AT(2, y), AT(3, y)
static const int32_t BOX_UNITS[UNIT_SIDE][MOST_UNITS] = {
    {ROW1(0), ROW1(1), ROW1(2), ROW1(3)},
    {ROW2(0), ROW2(1), ROW2(2), ROW2(3)},
    {ROW3(0), ROW3(1), ROW3(2), ROW3(3)},
    {ROW4(0), ROW4(1), ROW4(2), ROW4(3)},
};
#undef ROW4
#undef ROW3
#undef ROW2
#undef ROW1
#undef AT

/* burnish_pixel_index of first pixels of units: x, and y in the upper half. */
BURNISH_INLINE vi places_of(vi pixel) {
    const vi x = vi_and(pixel, vi_set(0xffff)), y = vi_shr(pixel, 16);
    const vi strip = vi_shl(vi_and(y, vi_set(~3)), 6), row = vi_shl(vi_and(y, vi_set(3)), 2);
    return vi_or(vi_or(strip, row), vi_shl(x, 2));
}

/* Lists the units of the triangles `lanes`; returns how many. */
BURNISH_INLINE int list_units(const setup_block *block, unsigned lanes, unit_list *list) {
    int count = 0;
    for (; lanes; lanes &= lanes - 1) {
        const size_t lane = (size_t)__builtin_ctz(lanes);
        const int x0 = block->x0[lane] & ~(UNIT_WIDTH - 1);
        const int y0 = block->y0[lane] & ~(UNIT_HEIGHT - 1);
        const int wide = (block->x1[lane] - x0) / UNIT_WIDTH + 1;
        const int high = (block->y1[lane] - y0) / UNIT_HEIGHT + 1;
        const int32_t *box = BOX_UNITS[wide - 1];
        vi slope[3];
        for (int i = 0; i < 3; ++i) {
            slope[i] = vi_set(block->slope[i][lane]);
            vi along = vi_dot16(slope[i], vi_load(UNIT_PLACES));
            vi_store(list->along[i][lane], vi_shl(along, 8));
        }
        for (int k = 0; k < MOST_UNITS; k += LANES) { /* behind the last one is room */
            const vi unit = vi_load(box + k);
            for (int i = 0; i < 3; ++i) {
                vi start =
                    vi_add(vi_set(block->unit[i][lane]), vi_shl(vi_dot16(slope[i], unit), 8));
                vi_store(list->start[i] + count + k, start);
            }
            const vi place = places_of(vi_add(unit, vi_set(x0 | y0 << 16)));
            vi_store(list->place + count + k,
                     vi_or(place, vi_set((int32_t)lane * BURNISH_TILE_PIXELS)));
        }
        count += wide * high;
    }
    return count;
}

/* Edge functions of a listed unit. */
BURNISH_INLINE vi edge_of_listed(const unit_list *list, size_t lane, int unit, int i) {
    return vi_add(vi_load(list->along[i][lane]), vi_set(list->start[i][unit]));
}

/* Units whose samples a triangle may cover: bits of their pixels. */
BURNISH_INLINE int may_cover(const sample_steps *steps, size_t lane, const vi e[3]) {
    vi inside = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        inside = vi_or(inside, vi_add(e[i], vi_set(steps->farthest[i][lane])));
    }
    return vm_any(vi_not_negative(inside));
}

/* A triangle of up to 96 pixels; ids: they are wanted; steps: with several samples. */
BURNISH_INLINE void draw_small(burnish_tile *tile, const setup_block *block,
                               const sample_steps *steps, size_t lane, int samples, int planes,
                               int ids, int32_t id) {
    const int x0 = block->x0[lane] & ~(UNIT_WIDTH - 1), x1 = block->x1[lane];
    const int y0 = block->y0[lane] & ~(UNIT_HEIGHT - 1), y1 = block->y1[lane];
    unit_constants constants;
    vi row[3], across[3], down[3];
    load_constants(block, lane, planes, id, &constants);
    for (int i = 0; i < 3; ++i) {
        row[i] = edge_of_unit(block, lane, i, &across[i], &down[i]);
    }
    for (int y = y0; y <= y1; y += UNIT_HEIGHT) {
        vi e[3] = {row[0], row[1], row[2]};
        for (int x = x0; x <= x1; x += UNIT_WIDTH) {
            const int place = burnish_pixel_index(x, y);
            if (samples == 1) {
                const vm covered = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
                if (vm_any(covered)) {
                    draw_unit(tile, &constants, planes, ids, covered, e, place);
                }
            } else if (may_cover(steps, lane, e)) {
                touch(tile, place,
                      draw_samples(tile, &constants, samples, planes, e, steps, lane, place));
            }
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_add(e[i], across[i]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], down[i]);
        }
    }
}

/* Finds which of the listed units a triangle covers, or with several samples may cover; returns how
 * many. */
BURNISH_INLINE int find_covering(const sample_steps *steps, int samples, int count,
                                 unit_list *list) {
    int covering = 0;
    for (int unit = 0; unit < count; ++unit) {
        const size_t lane = (size_t)list->place[unit] / BURNISH_TILE_PIXELS;
        vi e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = edge_of_listed(list, lane, unit, i);
        }
        list->covering[covering] = unit;
        if (samples == 1) {
            list->covered[covering] = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
            covering += vm_any(list->covered[covering]);
        } else {
            covering += may_cover(steps, lane, e);
        }
    }
    return covering;
}

/* Draws the triangles `lanes` of a block: none has more than UNIT_SIDE units across or down.
 * ids: a triangle's in each lane, where they are wanted; steps: with several samples. */
BURNISH_INLINE void draw_listed(burnish_tile *tile, const setup_block *block,
                                const sample_steps *steps, unsigned lanes, int samples, int planes,
                                const int32_t *ids, unit_list *list) {
    const int covering = find_covering(steps, samples, list_units(block, lanes, list), list);
    for (int i = 0; i < covering; ++i) {
        const int unit = list->covering[i], place = list->place[unit] % BURNISH_TILE_PIXELS;
        const size_t lane = (size_t)list->place[unit] / BURNISH_TILE_PIXELS;
        unit_constants constants;
        vi e[3];
        load_constants(block, lane, planes, ids ? ids[lane] : 0, &constants);
        for (int k = 0; k < 3; ++k) {
            e[k] = edge_of_listed(list, lane, unit, k);
        }
        if (samples == 1) {
            draw_unit(tile, &constants, planes, ids != NULL, list->covered[i], e, place);
        } else {
            touch(tile, place,
                  draw_samples(tile, &constants, samples, planes, e, steps, lane, place));
        }
    }
}

/* The four pixels that triangles of at most 2 x 2 may cover. */
typedef struct tiny_pixels {
    unsigned covered[4];
    float depth[4][LANES];
    float planes[4][BURNISH_PLANE_COUNT][LANES];
} tiny_pixels;

/* Coverage, depth and attributes of the pixels of all tiny triangles of a block, which are right
 * for those only. */
BURNISH_INLINE void find_tiny(const setup_block *block, int planes, tiny_pixels *pixels) {
    const vi wide = vi_sub(vi_load(block->x1), vi_load(block->x0));
    const vi high = vi_sub(vi_load(block->y1), vi_load(block->y0));
    const vf inverse_area = vf_load(block->inverse_area);
    vi start[3], right[3], down[3];
    for (int i = 0; i < 3; ++i) {
        start[i] = vi_load(block->start[i]);
        right[i] = vi_sub(vi_set(0), vi_shl(vi_load(block->dy[i]), 8));
        down[i] = vi_shl(vi_load(block->dx[i]), 8);
    }
    for (int c = 0; c < 4; ++c) {
        vi e[3], inside = vi_set(0);
        for (int i = 0; i < 3; ++i) {
            e[i] = c & 1 ? vi_add(start[i], right[i]) : start[i];
            e[i] = c & 2 ? vi_add(e[i], down[i]) : e[i];
            inside = vi_or(inside, e[i]);
        }
        inside = c & 1 ? vi_or(inside, vi_sub(wide, vi_set(1))) : inside;
        inside = c & 2 ? vi_or(inside, vi_sub(high, vi_set(1))) : inside;
        pixels->covered[c] = vm_bits(vi_not_negative(inside)) & block->tiny;
        if (!pixels->covered[c]) {
            continue;
        }
        const vf depth[3] = {vf_load(block->depth[0]), vf_load(block->depth[1]),
                             vf_load(block->depth[2])};
        vf weight1 = vf_mul(vf_from_int(vi_sub(e[1], vi_load(block->bias[1]))), inverse_area);
        vf weight2 = vf_mul(vf_from_int(vi_sub(e[2], vi_load(block->bias[2]))), inverse_area);
        vf weight0 = vf_sub(vf_sub(vf_set(1.0f), weight1), weight2);
        vf_store(pixels->depth[c], depth_from(depth, weight1, weight2));
        for (int k = 0; k < planes; ++k) {
            vf sum = vf_add(vf_mul(vf_load(block->attributes[0][k]), weight0),
                            vf_mul(vf_load(block->attributes[1][k]), weight1));
            sum = vf_add(sum, vf_mul(vf_load(block->attributes[2][k]), weight2));
            vf_store(pixels->planes[c][k], sum);
        }
    }
}

/* Bit i to bit 4 i. */
BURNISH_INLINE uint64_t spread(unsigned bits) {
    uint64_t x = bits;
    x = (x | x << 24) & 0x000000ff000000ffull;
    x = (x | x << 12) & 0x000f000f000f000full;
    x = (x | x << 6) & 0x0303030303030303ull;
    return (x | x << 3) & 0x1111111111111111ull;
}

/* Draws covered pixels: bit 4 lane + c of `hits`. */
BURNISH_INLINE void draw_tiny(burnish_tile *tile, const setup_block *block,
                              const tiny_pixels *pixels, uint64_t hits, int planes, int ids) {
    for (; hits; hits &= hits - 1) {
        const int hit = __builtin_ctzll(hits), lane = hit >> 2, c = hit & 3;
        const int x = block->x0[lane] + (c & 1), y = block->y0[lane] + (c >> 1);
        const int place = burnish_pixel_index(x, y);
        if (!(pixels->depth[c][lane] > tile->depths[place])) {
            continue;
        }
        tile->depths[place] = pixels->depth[c][lane];
        for (int k = 0; k < planes; ++k) {
            tile->planes[k][place] = pixels->planes[c][k][lane];
        }
        if (ids) {
            tile->ids[place] = (int32_t)block->corners.id_and_facing[lane];
        }
        touch(tile, place, 1);
    }
}

/* A row of a tile while a large triangle is drawn. */
typedef struct large_row {
    int x0, x1;
    double start[3], step[3], limit[3]; /* edge functions at the tile's left edge; covered where
                                           they reach their limits */
    int32_t nearer[BURNISH_TILE_SIZE], whole[BURNISH_TILE_SIZE];
    float before[BURNISH_TILE_SIZE], values[BURNISH_TILE_SIZE];
    float weight1[BURNISH_TILE_SIZE], weight2[BURNISH_TILE_SIZE];
} large_row;

/* Edge functions of row `line` at x and y in 1/256 pixel from a pixel's corner. Returns 0 when the
 * row is outside. */
static int start_row(const setup_block *block, size_t lane, int line, int64_t x, int64_t y,
                     large_row *row) {
    y += line * BURNISH_SUBPIXELS;
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1;
        int64_t e = block->dx[i][lane] * (y - block->y[a][lane]) -
                    block->dy[i][lane] * (x - block->x[a][lane]);
        int64_t along = -(int64_t)block->dy[i][lane] * BURNISH_SUBPIXELS;
        int64_t at0 = e + along * row->x0, at1 = e + along * row->x1;
        if ((at0 > at1 ? at0 : at1) + block->bias[i][lane] < 0) {
            return 0;
        }
        row->start[i] = (double)e;
        row->step[i] = (double)along;
        row->limit[i] = -block->bias[i][lane];
    }
    return 1;
}

static void find_weights(large_row *row, float inverse_area) {
    const double start1 = row->start[1], start2 = row->start[2];
    const double step1 = row->step[1], step2 = row->step[2];
    for (int x = row->x0; x <= row->x1; ++x) {
        row->weight1[x] = (float)(start1 + step1 * x) * inverse_area;
        row->weight2[x] = (float)(start2 + step2 * x) * inverse_area;
    }
}

/* Copies a row of the tile out of blocks `apart` numbers from one another, and back where mask
 * holds. */
static void take_row(const float *from, int apart, int x0, int x1, float *to) {
    for (int block = x0 / 4; block <= x1 / 4; ++block) {
        memcpy(to + 4 * block, from + block * apart, 4 * sizeof *to);
    }
}

static void put_row(const float *from, const int32_t *mask, int apart, int x0, int x1, float *to) {
    for (int x = x0; x <= x1; ++x) {
        float *kept = to + x / 4 * apart + x % 4;
        if (x % 4 == 0 && x + 3 <= x1 && (mask[x] & mask[x + 1] & mask[x + 2] & mask[x + 3])) {
            memcpy(kept, from + x, 4 * sizeof *kept); /* most are */
            x += 3;
        } else {
            *kept = mask[x] ? from[x] : *kept;
        }
    }
}

/* One sample of a row's pixels; `place` is the sample's of the row's first pixel. */
static int draw_row(const burnish_tile *tile, const setup_block *block, size_t lane, int ids,
                    int32_t id, int place, large_row *row) {
    const double start0 = row->start[0], step0 = row->step[0];
    const double start1 = row->start[1], step1 = row->step[1];
    const double start2 = row->start[2], step2 = row->step[2];
    const float depth0 = block->depth[0][lane], depth1 = block->depth[1][lane],
                depth2 = block->depth[2][lane];
    const int apart = BURNISH_BLOCK_PIXELS * tile->options.samples;
    int32_t drawn = 0;
    find_weights(row, block->inverse_area[lane]);
    take_row(tile->depths + place, apart, row->x0, row->x1, row->before);
    for (int x = row->x0; x <= row->x1; ++x) {
        const float depth = (depth0 + row->weight1[x] * depth1) + row->weight2[x] * depth2;
        row->nearer[x] = (start0 + step0 * x >= row->limit[0]) &
                         (start1 + step1 * x >= row->limit[1]) &
                         (start2 + step2 * x >= row->limit[2]) & (depth > row->before[x]);
        row->values[x] = depth;
        row->whole[x] &= row->nearer[x];
        drawn |= row->nearer[x];
    }
    if (drawn) {
        put_row(row->values, row->nearer, apart, row->x0, row->x1, tile->depths + place);
        for (int x = row->x0; x <= row->x1 && ids; ++x) {
            int32_t *kept = tile->ids + place + x / 4 * apart + x % 4;
            *kept = row->nearer[x] ? id : *kept;
        }
    }
    return drawn;
}

/* Attributes of a row's whole pixels. */
static void interpolate_row(const burnish_tile *tile, const setup_block *block, size_t lane,
                            int place, large_row *row) {
    const int samples = tile->options.samples;
    if (samples > 1 && tile->options.needs_position) {
        for (int x = row->x0; x <= row->x1; ++x) {
            row->values[x] = (block->depth[0][lane] + row->weight1[x] * block->depth[1][lane]) +
                             row->weight2[x] * block->depth[2][lane];
        }
        put_row(row->values, row->whole, BURNISH_BLOCK_PIXELS, row->x0, row->x1,
                tile->center_depths + place);
    }
    for (int k = 0; k < tile->options.planes; ++k) {
        const float a = block->attributes[0][k][lane], b = block->attributes[1][k][lane],
                    c = block->attributes[2][k][lane];
        for (int x = row->x0; x <= row->x1; ++x) {
            const float weight0 = (1.0f - row->weight1[x]) - row->weight2[x];
            row->values[x] = (a * weight0 + b * row->weight1[x]) + c * row->weight2[x];
        }
        put_row(row->values, row->whole, BURNISH_BLOCK_PIXELS, row->x0, row->x1,
                tile->planes[k] + place);
    }
}

static void touch_row(burnish_tile *tile, const large_row *row, int line) {
    unsigned dirty_blocks = 0;
    for (int x = row->x0; x <= row->x1; ++x) {
        dirty_blocks |= (unsigned)(row->nearer[x] != 0) << x / BURNISH_BLOCK_SIZE;
    }
    tile->dirty_blocks[line / BURNISH_BLOCK_SIZE] |= (uint16_t)dirty_blocks;
}

/* A triangle of any size: its edge functions are below 2^49. */
static int draw_large(burnish_tile *tile, setup_block *block, size_t lane, int ids, int32_t id,
                      const int8_t (*offsets)[2]) {
    const int64_t area = (int64_t)block->dx[2][lane] * block->dy[0][lane] -
                         (int64_t)block->dy[2][lane] * block->dx[0][lane];
    const int samples = tile->options.samples;
    int drawn = 0;
    large_row row = {.x0 = block->x0[lane], .x1 = block->x1[lane]};
    block->inverse_area[lane] = 1.0f / (float)area;
    for (int line = block->y0[lane]; line <= block->y1[lane]; ++line) {
        const int place = burnish_pixel_index(0, line);
        int whole = 1;
        memset(row.whole, 0xff, sizeof row.whole);
        for (int s = 0; s < samples; ++s) {
            if (!start_row(block, lane, line, HALF_PIXEL + offsets[s][0] * 16,
                           HALF_PIXEL + offsets[s][1] * 16, &row)) {
                whole = 0;
                continue;
            }
            const int hit =
                draw_row(tile, block, lane, ids, id, burnish_sample_index(samples, place, s), &row);
            if (hit) {
                touch_row(tile, &row, line);
            }
            whole &= hit;
            drawn |= hit;
        }
        if (whole) {
            if (samples > 1) {
                start_row(block, lane, line, HALF_PIXEL, HALF_PIXEL, &row);
                find_weights(&row, block->inverse_area[lane]);
            }
            interpolate_row(tile, block, lane, place, &row);
        }
    }
    return drawn;
}

/* What the points of shared pixels will need of a block's triangles: behind the last one, a lane
 * each. */
BURNISH_INLINE void remember(burnish_tile_primitives *triangles, const setup_block *block) {
    const size_t at = triangles->count;
    const vi large = vi_blend(vi_greater(vi_load(block->longest), vi_set(BURNISH_SMALL_EDGE)),
                              vi_set(1), vi_set(0));
    vi constant[2], dx[2], dy[2];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        dx[i] = vi_load(block->dx[i + 1]);
        dy[i] = vi_load(block->dy[i + 1]);
        constant[i] =
            vi_sub(vi_mul(dy[i], vi_load(block->x[a])), vi_mul(dx[i], vi_load(block->y[a])));
    }
    vf_store_aos4(&triangles->edges[at], vf_from_bits(constant[0]), vf_from_bits(constant[1]),
                  vf_from_bits(dx[0]), vf_from_bits(dx[1]));
    vf_store_aos4(&triangles->weights[at], vf_from_bits(dy[0]), vf_from_bits(dy[1]),
                  vf_load(block->inverse_area), vf_from_bits(large));
    vf_store_aos4(&triangles->depths[at], vf_load(block->depth[0]), vf_load(block->depth[1]),
                  vf_load(block->depth[2]), vf_set(0.0f));
    vf_store_aos4(&triangles->primitives[at],
                  vf_from_bits(vi_load((const int32_t *)block->corners.vertices[0])),
                  vf_from_bits(vi_load((const int32_t *)block->corners.vertices[1])),
                  vf_from_bits(vi_load((const int32_t *)block->corners.vertices[2])),
                  vf_from_bits(vi_load((const int32_t *)block->corners.id_and_facing)));
}

/* The rest of it for a large triangle, drawn before. */
static void remember_large(burnish_tile_primitives *triangles, size_t at, const setup_block *block,
                           size_t lane) {
    triangles->weights[at].inverse_area = block->inverse_area[lane];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        triangles->constants[at][i] = (int64_t)block->dy[i + 1][lane] * block->x[a][lane] -
                                      (int64_t)block->dx[i + 1][lane] * block->y[a][lane];
    }
}

/* Whether the units of a block's triangles are listed: with vectors of fewer lanes it does not pay.
 */
BURNISH_INLINE int is_listed(const setup_block *block) {
    return LANES >= 8 && !block->wide;
}

/* The triangles of a block, one sample a pixel. */
BURNISH_INLINE void draw_single(burnish_tile *tile, setup_block *block, tiny_pixels *pixels,
                                int planes, int ids, unit_list *list) {
    static const int8_t CENTER[1][2] = {{0, 0}};
    unsigned others = block->live;
    uint64_t hits = 0;
    const int tiny = __builtin_popcount(block->tiny);
    if (is_listed(block) &&
        2 * tiny < LANES) { /* else the pixels of all tiny ones are found at once */
        const int32_t *sources = (const int32_t *)block->corners.id_and_facing;
        draw_listed(tile, block, NULL, others, 1, planes, ids ? sources : NULL, list);
        return;
    }
    if (tiny > 1) {
        find_tiny(block, planes, pixels);
        others &= ~block->tiny;
        hits = spread(pixels->covered[0]) | spread(pixels->covered[1]) << 1 |
               spread(pixels->covered[2]) << 2 | spread(pixels->covered[3]) << 3;
    }
    for (; others; others &= others - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(others);
        const int32_t id = (int32_t)block->corners.id_and_facing[lane];
        const uint64_t before = hits & ((1ull << 4 * lane) - 1);
        draw_tiny(tile, block, pixels, before, planes, ids);
        hits ^= before;
        if (block->small >> lane & 1) {
            draw_small(tile, block, NULL, lane, 1, planes, ids, id);
        } else {
            draw_large(tile, block, lane, ids, id, CENTER);
        }
    }
    draw_tiny(tile, block, pixels, hits, planes, ids);
}

/* The triangles of a block, several samples a pixel. */
BURNISH_INLINE void draw_multiple(burnish_tile *tile, setup_block *block, int samples, int planes,
                                  unit_list *list) {
    burnish_tile_primitives *triangles = &tile->primitives;
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    sample_steps steps;
    const size_t first = triangles->count;
    int32_t ids[LANES];
    remember(triangles, block);
    triangles->count = first + LANES;
    vi_store(ids, vi_add(vi_set((int32_t)first), vi_ramp(1)));
    find_steps(block, samples, &steps);
    if (is_listed(block)) {
        draw_listed(tile, block, &steps, block->live, samples, planes, ids, list);
        return;
    }
    for (unsigned rest = block->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        if (block->small >> lane & 1) {
            draw_small(tile, block, &steps, lane, samples, planes, 1, ids[lane]);
        } else {
            draw_large(tile, block, lane, 1, ids[lane], offsets);
            remember_large(triangles, first + lane, block, lane);
        }
    }
}

static void draw_primitives(burnish_tile *tile, const burnish_geometry *geometry,
                            const uint32_t *slots, size_t count, unsigned back) {
    const burnish_tile_options *options = &tile->options;
    setup_block block;
    tiny_pixels pixels = {0};
    unit_list list;
    primitive_group next;
    find_corners(tile, geometry, slots, count < LANES ? count : LANES, back, &next);
    for (size_t first = 0; first < count; first += LANES) {
        const size_t lanes = count - first < LANES ? count - first : LANES;
        const size_t after = first + lanes, ahead = count - after < LANES ? count - after : LANES;
        vi x[3], y[3];
        vf depth[3];
        block.corners = next;
        find_corners(tile, geometry, slots + after, ahead, back, &next);
        load_block(tile, geometry, &block, x, y, depth);
        set_up_block(tile, lanes, x, y, depth, &block);
        if (options->samples == 4 && options->planes == 3) {
            draw_multiple(tile, &block, 4, 3, &list);
        } else if (options->samples > 1) {
            draw_multiple(tile, &block, options->samples, options->planes, &list);
        } else if (options->planes == 3 && !options->keep_ids) {
            draw_single(tile, &block, &pixels, 3, 0, &list);
        } else {
            draw_single(tile, &block, &pixels, options->planes, options->keep_ids, &list);
        }
    }
}

/* Interpolated depths may pass the nearest vertex by rounding: the factor is far more than that. It
 * would make depths below 0 farther, so those are always seen. */
static int is_hidden(const burnish_tile *tile, float nearest, int x0, int y0, int x1, int y1) {
    nearest *= 1.00001f;
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if (nearest >= tile->coarse[0][y][x]) {
                return 0;
            }
        }
    }
    return nearest > 0.0f;
}

/* LANES triangles of a block, from item `at` on: bits of those that may be seen. All but large ones
 * touch at most 2 x 2 coarse blocks. */
BURNISH_INLINE unsigned find_seen_vector(const burnish_tile *tile,
                                         const burnish_triangle_batch *block, size_t at,
                                         unsigned lanes) {
    const vi last = vi_set(BURNISH_HIZ_SIZE - 1), zero = vi_set(0), low = vi_set(0xffff);
    const vi left = vi_set(tile->x / BURNISH_HIZ_PIXELS);
    const vi top = vi_set(tile->y / BURNISH_HIZ_PIXELS);
    const vi first = vi_load((const int32_t *)block->first + at);
    const vi end = vi_load((const int32_t *)block->last + at);
    vi x0 = vi_max(vi_sub(vi_and(first, low), left), zero);
    vi y0 = vi_max(vi_sub(vi_shr(first, 16), top), zero);
    vi x1 = vi_min(vi_sub(vi_and(end, low), left), last);
    vi y1 = vi_min(vi_sub(vi_shr(end, 16), top), last);
    /* places of triangles that are not asked for may be anywhere */
    vi place = vi_and(vi_or(vi_shl(y0, 3), x0), vi_set(63));
    vf coarse = vf_gather(tile->coarse[1][0], place);
    vf nearest = vf_mul(vf_load(block->nearest + at), vf_set(1.00001f));
    unsigned hidden =
        vm_bits(vm_and(vf_greater(coarse, nearest), vf_greater(nearest, vf_set(0.0f))));
    unsigned large = vm_bits(vi_greater(vi_max(vi_sub(x1, x0), vi_sub(y1, y0)), vi_set(1)));
    for (unsigned rest = large & lanes; rest; rest &= rest - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(rest);
        int32_t box[4][LANES];
        vi_store(box[0], x0);
        vi_store(box[1], y0);
        vi_store(box[2], x1);
        vi_store(box[3], y1);
        const int is = is_hidden(tile, block->nearest[at + lane], box[0][lane], box[1][lane],
                                 box[2][lane], box[3][lane]);
        hidden = (hidden & ~(1u << lane)) | (unsigned)is << lane;
    }
    return lanes & ~hidden;
}

static size_t hiz_cull(const burnish_tile *tile, const burnish_geometry *geometry,
                       burnish_bin_entry *entries, size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_bin_entry entry = entries[i];
        const burnish_triangle_batch *block = &geometry->batches[entry.batch];
        unsigned seen = 0;
        for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
            const unsigned lanes = entry.mask >> at & ALL_LANES;
            seen |= lanes ? find_seen_vector(tile, block, at, lanes) << at : 0;
        }
        entries[kept] = (burnish_bin_entry){entry.batch, seen};
        kept += seen != 0;
    }
    return kept;
}

/* A coarse block is four blocks of pixels: lane by lane, then over the lanes. */
static void hiz_reduce(burnish_tile *tile) {
    enum { PARTS = BURNISH_BLOCK_PIXELS / LANES };
    const int samples = tile->options.samples, size = samples * BURNISH_BLOCK_PIXELS;
    for (int y = 0; y < BURNISH_HIZ_SIZE; ++y) {
        for (int x = 0; x < BURNISH_HIZ_SIZE; ++x) {
            const float *depths = tile->depths + (2 * y * BURNISH_TILE_BLOCKS + 2 * x) * size;
            vf least[PARTS];
            float lanes[BURNISH_BLOCK_PIXELS];
            for (int part = 0; part < PARTS; ++part) {
                least[part] = vf_load(depths + part * LANES);
            }
            for (int row = 0; row < 2; ++row, depths += BURNISH_TILE_BLOCKS * size) {
                for (int i = 0; i < 2 * size; i += BURNISH_BLOCK_PIXELS) {
                    for (int part = 0; part < PARTS; ++part) {
                        least[part] = vf_min(vf_load(depths + i + part * LANES), least[part]);
                    }
                }
            }
            for (int part = 0; part < PARTS; ++part) {
                vf_store(lanes + part * LANES, least[part]);
            }
            for (int half = BURNISH_BLOCK_PIXELS / 2; half > 0; half /= 2) {
                for (int i = 0; i < half; ++i) {
                    lanes[i] = lanes[half + i] < lanes[i] ? lanes[half + i] : lanes[i];
                }
            }
            tile->coarse[0][y][x] = lanes[0];
        }
    }
}

/* The least depth of each cell, and of each 2 x 2 cells. */
static void hiz_build(burnish_tile *tile) {
    enum { LAST = BURNISH_HIZ_SIZE - 1 };
    hiz_reduce(tile);
    for (int y = 0; y <= LAST; ++y) {
        const float *row = tile->coarse[0][y], *below = tile->coarse[0][y < LAST ? y + 1 : y];
        for (int x = 0; x <= LAST; ++x) {
            const int next = x < LAST ? x + 1 : x;
            const float first = row[x] < row[next] ? row[x] : row[next];
            const float second = below[x] < below[next] ? below[x] : below[next];
            tile->coarse[1][y][x] = first < second ? first : second;
        }
    }
}

/* The vectors of a block: bits where a sample shows a triangle. */
BURNISH_INLINE unsigned find_block(const burnish_tile *tile, int block, int32_t *whole) {
    const int samples = tile->options.samples, size = samples * BURNISH_BLOCK_PIXELS;
    const vf farthest = vf_set(BURNISH_FARTHEST);
    unsigned shown = 0;
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; i += LANES) {
        if (samples == 1) {
            vm mask = vf_greater(vf_load(tile->depths + block * size + i), farthest);
            vi_store(whole + i, vi_blend(mask, vi_set(0), vi_set(-1)));
            shown |= vm_bits(mask) << i;
            continue;
        }
        const int32_t *ids = tile->ids + block * size + i;
        vi first = vi_load(ids), all = first;
        vm same = vi_equal(first, first);
        for (int s = 1; s < samples; ++s) {
            vi id = vi_load(ids + s * BURNISH_BLOCK_PIXELS);
            all = vi_and(all, id); /* -1, none, only where all are */
            same = vm_and(same, vi_equal(id, first));
        }
        vi_store(whole + i, vi_blend(same, first, vi_set(-1)));
        shown |= vm_bits(vi_not_negative(all)) << i;
    }
    return shown;
}

/* The samples of LANES pixels of a block, from pixel `first` on: bit t of group[s] is set where
 * sample t shows the same triangle as sample s. */
BURNISH_INLINE void find_points(const burnish_tile *tile, int samples, int block, int first,
                                burnish_complex_pixels *points) {
    const int32_t *ids = tile->ids + block * samples * BURNISH_BLOCK_PIXELS + first;
    const vi none = vi_set(0);
    vi id[BURNISH_MAX_SAMPLES], group[BURNISH_MAX_SAMPLES], different = none;
    for (int s = 0; s < samples; ++s) {
        id[s] = vi_load(ids + s * BURNISH_BLOCK_PIXELS);
        group[s] = vi_set(1 << s);
        different = vi_or(different, vi_xor(id[s], id[0]));
    }
    const vm shared = is_nonzero(different);
    if (!vm_any(shared)) {
        return;
    }
    for (int s = 0; s < samples; ++s) {
        for (int t = s + 1; t < samples; ++t) {
            const vm same = vi_equal(id[s], id[t]);
            group[s] = vi_or(group[s], vi_blend(same, vi_set(1 << t), none));
            group[t] = vi_or(group[t], vi_blend(same, vi_set(1 << s), none));
        }
    }
    for (int s = 0; s < samples; ++s) { /* the first sample of a group stands for it */
        int32_t groups[LANES];
        const vm is_first = vi_equal(vi_and(group[s], vi_set((1 << s) - 1)), none);
        unsigned rest = vm_bits(vm_and(vm_and(is_first, shared), vi_not_negative(id[s])));
        vi_store(groups, group[s]);
        for (; rest; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest), i = points->count++;
            points->pixel[i] = (uint8_t)(first + lane);
            points->samples[i] = (uint16_t)groups[lane];
            points->id[i] = ids[s * BURNISH_BLOCK_PIXELS + lane];
        }
    }
}

static void group_samples(const burnish_tile *tile, int block, burnish_complex_pixels *points) {
    points->count = 0;
    for (int first = 0; first < BURNISH_BLOCK_PIXELS; first += LANES) {
        if (tile->options.samples == 4) {
            find_points(tile, 4, block, first, points);
        } else {
            find_points(tile, tile->options.samples, block, first, points);
        }
    }
}

/* The weights of a point of a large triangle. */
static void place_large(const burnish_tile_primitives *triangles, size_t id, int64_t x, int64_t y,
                        float *weight1, float *weight2) {
    const burnish_primitive_edges *edges = &triangles->edges[id];
    const burnish_primitive_weights *weights = &triangles->weights[id];
    const int64_t *constants = triangles->constants[id];
    const int64_t edge1 = edges->dx[0] * y - weights->dy[0] * x + constants[0];
    const int64_t edge2 = edges->dx[1] * y - weights->dy[1] * x + constants[1];
    *weight1 = (float)edge1 * weights->inverse_area;
    *weight2 = (float)edge2 * weights->inverse_area;
}

/* LANES points from `first` on. */
BURNISH_INLINE void place_vector(const burnish_tile *tile, const burnish_raster_view *view,
                                 const burnish_sample_points *points, int first,
                                 burnish_fragments *fragments) {
    const burnish_tile_primitives *triangles = &tile->primitives;
    const void *edges[LANES], *weights[LANES], *depths[LANES];
    vf edge[4], weight[4], depth[4];
    for (int lane = 0; lane < LANES; ++lane) {
        const int at = first + lane < points->count ? first + lane : first;
        const int32_t id = points->id[at];
        edges[lane] = &triangles->edges[id];
        weights[lane] = &triangles->weights[id];
        depths[lane] = &triangles->depths[id];
    }
    vf_load_aos4(edges, edge);
    vf_load_aos4(weights, weight);
    vf_load_aos4(depths, depth);
    const vi x = vi_load(points->x + first), y = vi_load(points->y + first);
    float *to[2] = {fragments->weight1 + first, fragments->weight2 + first};
    for (int i = 0; i < 2; ++i) {
        vi e = vi_sub(vi_mul(vf_bits(edge[2 + i]), y), vi_mul(vf_bits(weight[i]), x));
        e = vi_add(e, vf_bits(edge[i]));
        vf_store(to[i], vf_mul(vf_from_int(e), weight[2]));
    }
    for (unsigned large = vm_bits(is_nonzero(vf_bits(weight[3]))); large; large &= large - 1) {
        const int at = first + __builtin_ctz(large);
        if (at < points->count) {
            place_large(triangles, (size_t)points->id[at], points->x[at], points->y[at],
                        &fragments->weight1[at], &fragments->weight2[at]);
        }
    }
    if (tile->options.needs_position) {
        const int half = BURNISH_SUBPIXELS / 2;
        const vf step = vf_set(1.0f / BURNISH_SUBPIXELS);
        const vi left = vi_set(tile->x * BURNISH_SUBPIXELS - view->width * half);
        const vi below = vi_set(view->height * half - tile->y * BURNISH_SUBPIXELS);
        vf_store(fragments->x + first, vf_mul(vf_from_int(vi_add(x, left)), step));
        vf_store(fragments->y + first, vf_mul(vf_from_int(vi_sub(below, y)), step));
        vf_store(fragments->depth + first, depth_from(depth, vf_load(to[0]), vf_load(to[1])));
    }
}

static void compute_fragments(const burnish_tile *tile, const burnish_raster_view *view,
                              const burnish_sample_points *points, burnish_fragments *fragments) {
    for (int first = 0; first < points->count; first += LANES) {
        place_vector(tile, view, points, first, fragments);
    }
}

static void classify_block_row(const burnish_tile *tile, int strip, burnish_block_row *pixels) {
    for (int x = 0; x < BURNISH_TILE_BLOCKS; ++x) {
        int32_t *whole = pixels->simple + x * BURNISH_BLOCK_PIXELS;
        if (tile->dirty_blocks[strip] >> x & 1) {
            pixels->covered[x] = (uint16_t)find_block(tile, strip * BURNISH_TILE_BLOCKS + x, whole);
        } else {
            memset(whole, 0xff, BURNISH_BLOCK_PIXELS * sizeof *whole);
            pixels->covered[x] = 0;
        }
    }
}

/* Neighbours mostly show the same triangle: only where the id changes there is something to do.
 */
static void mark_block(const burnish_tile *tile, int first, uint8_t *drawn) {
    const int count = tile->options.samples * BURNISH_BLOCK_PIXELS;
    int32_t ids[1 + BURNISH_MAX_SAMPLES * BURNISH_BLOCK_PIXELS];
    ids[0] = ~tile->ids[first]; /* another one */
    memcpy(ids + 1, tile->ids + first, (size_t)count * sizeof *ids);
    for (int i = 0; i < count; i += LANES) {
        vm same = vi_equal(vi_load(ids + 1 + i), vi_load(ids + i));
        vm shown = vf_greater(vf_load(tile->depths + first + i), vf_set(BURNISH_FARTHEST));
        for (unsigned rest = vm_bits(vm_and_not(shown, same)); rest; rest &= rest - 1) {
            const int32_t id = ids[1 + i + __builtin_ctz(rest)];
            const uint32_t source = tile->options.samples == 1
                                        ? (uint32_t)id
                                        : tile->primitives.primitives[id].id_and_facing;
            __atomic_store_n(&drawn[source >> 1], 1, __ATOMIC_RELAXED);
        }
    }
}

static void mark_drawn(const burnish_tile *tile, uint8_t *drawn) {
    const int size = tile->options.samples * BURNISH_BLOCK_PIXELS;
    for (int strip = 0; strip < BURNISH_TILE_BLOCKS; ++strip) {
        for (unsigned rest = tile->dirty_blocks[strip]; rest; rest &= rest - 1) {
            const int block = strip * BURNISH_TILE_BLOCKS + __builtin_ctz(rest);
            mark_block(tile, block * size, drawn);
        }
    }
}

#endif
