/* Draws triangles into pairs of depth maps with SIMD. Which texels triangles cover is found out for
 * as many triangles at once as a vector has lanes, texel by texel of their bounds, then depths of as
 * many covered texels at once. Wide triangles are drawn one after another, slivers of them by stamps,
 * others row by row, as large ones are. */
#ifndef BURNISH_RASTER_MAPS_SIMD_H
#define BURNISH_RASTER_MAPS_SIMD_H

#include "raster/maps_large_simd.h"
#include "raster/stamps_simd.h"

/* The vertices of LANES positions in one pair, of which column and row are packed. The view is a
 * parallel projection, in which w is 1. A mesh fits its maps; whatever rounding leaves outside is
 * moved to the edge. */
BURNISH_INLINE void project_to_map(const burnish_raster_view *view, const vf p[3], vi *at,
                                   vf *depth) {
    vf clip[3];
    for (int i = 0; i < 3; ++i) {
        const float *row = view->rows[i];
        const vf sum = vf_add(vf_mul(vf_set(row[0]), p[0]), vf_mul(vf_set(row[1]), p[1]));
        clip[i] = vf_add(vf_add(sum, vf_mul(vf_set(row[2]), p[2])), vf_set(row[3]));
    }
    const vi middle = vi_set(view->width * (BURNISH_SUBPIXELS / 2)), zero = vi_set(0);
    const vi most = vi_set(view->width * BURNISH_SUBPIXELS - 1);
    const vi x = vi_min(vi_max(vi_add(to_fixed(clip[0]), middle), zero), most);
    const vi y = vi_min(vi_max(vi_sub(middle, to_fixed(clip[1])), zero), most);
    *at = vi_or(x, vi_shl(y, 16));
    *depth = vf_min(vf_max(clip[2], vf_set(0.0f)), vf_set(1.0f));
}

static void project_to_maps(const burnish_raster_view *views, const float *positions, size_t count,
                            const burnish_maps *maps) {
    for (size_t i = 0; i < count; i += LANES) {
        float rest[3 * LANES];
        burnish_map_vertex some[LANES];
        const size_t lanes = count - i < LANES ? count - i : LANES;
        const float *from = positions + 3 * i;
        vf p[3], to[2 * BURNISH_MAPS];
        if (lanes < LANES) { /* the last ones, over and over */
            for (size_t k = 0; k < 3 * LANES; ++k) {
                rest[k] = from[k % (3 * lanes)];
            }
            from = rest;
        }
        for (int k = 0; k < 3; ++k) {
            p[k] = vf_sub(vf_gather(from + k, vi_ramp(3)), vf_set(views->origin[k]));
        }
        for (int m = 0; m < BURNISH_MAPS; ++m) {
            vi at;
            project_to_map(&views[m < maps->count ? m : 0], p, &at, &to[2 * m + 1]);
            to[2 * m] = vf_from_bits(at);
        }
        vf_store_aos4(lanes < LANES ? some : &maps->vertices[i], to[0], to[1], to[2], to[3]);
        if (lanes < LANES) {
            memcpy(&maps->vertices[i], some, lanes * sizeof *some);
        }
    }
}

/* Triangles of a pair that are still to be drawn. */
typedef struct map_queue {
    int count;
    int32_t at[3][2 * LANES], depth[3][2 * LANES]; /* of their vertices; depths as bits */
} map_queue;

/* LANES small triangles. Vertices 1 and 2 of a front-facing triangle are swapped, as in
 * burnish_geometry_primitive. For edge functions see setup_simd.h. */
typedef struct map_triangles {
    int32_t start[3][LANES];  /* E at the centre of the first texel of the bounds */
    int32_t weight[3][LANES]; /* E less its bias there */
    int32_t slope[3][LANES];  /* -dy, dx packed: E(x + u, y + v) = E(x, y) + 256 slope . (u, v) */
    int32_t wide[LANES], high[LANES]; /* texels past the first one */
    int32_t texel[LANES];             /* the first one */
    float inverse_area[LANES], depth[3][LANES];
} map_triangles;

/* First and last texel along one axis of three coordinates that are not negative. */
BURNISH_INLINE void bound_texels(const vi at[3], vi *first, vi *last) {
    const vi low = vi_min(vi_min(at[0], at[1]), at[2]), high = vi_max(vi_max(at[0], at[1]), at[2]);
    *first = vi_sar(vi_add(low, vi_set(BURNISH_SUBPIXELS / 2 - 1)), BURNISH_SUBPIXEL_BITS);
    *last = vi_sar(vi_sub(high, vi_set(BURNISH_SUBPIXELS / 2)), BURNISH_SUBPIXEL_BITS);
}

BURNISH_INLINE void set_up_map_triangles(const map_queue *queue, int size,
                                         map_triangles *triangles) {
    vi x[3], y[3], x1, y1, x0, y0;
    vf depth[3];
    for (int i = 0; i < 3; ++i) {
        const vi at = vi_load(queue->at[i]);
        x[i] = vi_and(at, vi_set(0xffff));
        y[i] = vi_shr(at, 16);
        depth[i] = vf_from_bits(vi_load(queue->depth[i]));
    }
    const vi swap = vi_sub(vi_mul(vi_sub(x[1], x[0]), vi_sub(y[2], y[0])),
                           vi_mul(vi_sub(y[1], y[0]), vi_sub(x[2], x[0])));
    const vm stays = vi_greater(swap, vi_set(0));
    const vi x2 = vi_blend(stays, x[2], x[1]), y2 = vi_blend(stays, y[2], y[1]);
    const vf depth2 = vf_blend(stays, depth[2], depth[1]);
    x[1] = vi_blend(stays, x[1], x[2]);
    y[1] = vi_blend(stays, y[1], y[2]);
    depth[1] = vf_blend(stays, depth[1], depth[2]);
    x[2] = x2;
    y[2] = y2;
    depth[2] = depth2;
    bound_texels(x, &x0, &x1);
    bound_texels(y, &y0, &y1);
    const vi at_x = vi_add(vi_shl(x0, BURNISH_SUBPIXEL_BITS), vi_set(BURNISH_SUBPIXELS / 2));
    const vi at_y = vi_add(vi_shl(y0, BURNISH_SUBPIXEL_BITS), vi_set(BURNISH_SUBPIXELS / 2));
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        const vi dx = vi_sub(x[b], x[a]), dy = vi_sub(y[b], y[a]), zero = vi_set(0);
        const vm top = vm_and(vi_equal(dy, zero), vi_greater(dx, zero));
        const vi bias = vi_blend(vm_or(vi_greater(zero, dy), top), zero, vi_set(-1));
        const vi weight = vi_sub(vi_mul(dx, vi_sub(at_y, y[a])), vi_mul(dy, vi_sub(at_x, x[a])));
        vi_store(triangles->weight[i], weight);
        vi_store(triangles->start[i], vi_add(weight, bias));
        vi_store(triangles->slope[i],
                 vi_or(vi_and(vi_sub(zero, dy), vi_set(0xffff)), vi_shl(dx, 16)));
    }
    vi_store(triangles->wide, vi_sub(x1, x0));
    vi_store(triangles->high, vi_sub(y1, y0));
    vi_store(triangles->texel, vi_add(vi_mul(y0, vi_set(size)), x0));
    vf_store(triangles->inverse_area, vf_div(vf_set(1.0f), vf_from_int(vi_magnitude(swap))));
    vf_store(triangles->depth[0], depth[0]);
    vf_store(triangles->depth[1], vf_sub(depth[1], depth[0]));
    vf_store(triangles->depth[2], vf_sub(depth[2], depth[0]));
}

enum {
    FEW_TEXELS =
        8, /* across and down: the bounds of triangles of which a vector is drawn at once */
    MOST_TEXELS = BURNISH_SMALL_EDGE / BURNISH_SUBPIXELS + 1, /* across and down of others */
    /* capacity for what a vector of narrow triangles, or a wide triangle after others, covers */
    COVERED_MOST = 8192,
    COVERED_FULL = COVERED_MOST - (MOST_TEXELS + 3) * (MOST_TEXELS + 3)
};
_Static_assert((int)COVERED_FULL >= LANES * FEW_TEXELS * FEW_TEXELS, "narrow triangles fit");

/* Texels that some triangles cover: x and y from the first one of the bounds, packed, and the
 * triangle's lane in bits 8 to 15. */
typedef struct map_texels {
    int count;
    int32_t items[COVERED_MOST + LANES];
} map_texels;

/* Finds the texels that triangles `lanes`, whose bounds are narrow, cover. */
BURNISH_INLINE void cover_narrow(const map_triangles *triangles, unsigned lanes,
                                 map_texels *texels) {
    const vi ramp = vi_ramp(256);
    const vi wide = vi_load(triangles->wide), high = vi_load(triangles->high);
    vi row[3], right[3], down[3];
    int columns = 1, count = texels->count;
    for (int i = 0; i < 3; ++i) {
        const vi slope = vi_load(triangles->slope[i]);
        row[i] = vi_load(triangles->start[i]);
        right[i] = vi_sar(vi_shl(slope, 16), 16 - BURNISH_SUBPIXEL_BITS);
        down[i] = vi_shl(vi_sar(slope, 16), BURNISH_SUBPIXEL_BITS);
    }
    while (lanes & vm_bits(vi_greater(wide, vi_set(columns - 1)))) {
        ++columns;
    }
    for (int y = 0; y == 0 || lanes & vm_bits(vi_greater(high, vi_set(y - 1))); ++y) {
        vi e[3] = {row[0], row[1], row[2]};
        for (int x = 0; x < columns; ++x) {
            const vm inside = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
            count += vi_compress(vm_bits(inside) & lanes, texels->items + count,
                                 vi_add(ramp, vi_set(x | y << 16)));
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_add(e[i], right[i]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], down[i]);
        }
    }
    texels->count = count;
}

/* Finds the texels that a triangle covers, stamp by stamp from the first texel of its bounds. */
BURNISH_INLINE void cover_wide(const map_triangles *triangles, int lane, map_texels *texels) {
    const int wide = triangles->wide[lane], high = triangles->high[lane];
    const vi stamp = vi_load(STAMP_PIXELS);
    int count = texels->count;
    vi row[3], right[3], down[3];
    vi at_row = vi_add(stamp, vi_set(lane << 8));
    for (int i = 0; i < 3; ++i) {
        const vi slope = vi_set(triangles->slope[i][lane]);
        row[i] = vi_add(vi_set(triangles->start[i][lane]),
                        vi_shl(vi_dot16(slope, stamp), BURNISH_SUBPIXEL_BITS));
        right[i] = vi_shl(vi_dot16(slope, vi_set(STAMP_WIDTH)), BURNISH_SUBPIXEL_BITS);
        down[i] = vi_shl(vi_dot16(slope, vi_set(STAMP_HEIGHT << 16)), BURNISH_SUBPIXEL_BITS);
    }
    for (int y = 0; y <= high; y += STAMP_HEIGHT) {
        vi e[3] = {row[0], row[1], row[2]}, at = at_row;
        for (int x = 0; x <= wide; x += STAMP_WIDTH) {
            const vm inside = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
            count += vi_compress(vm_bits(inside), texels->items + count, at);
            at = vi_add(at, vi_set(STAMP_WIDTH));
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_add(e[i], right[i]);
            }
        }
        at_row = vi_add(at_row, vi_set(STAMP_HEIGHT << 16));
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], down[i]);
        }
    }
    texels->count = count;
}

/* E of edge i less its bias, `steps` away from the first texel of triangles. */
BURNISH_INLINE vf map_weight(const map_triangles *triangles, int i, vi lane, vi steps) {
    const vi along = vi_dot16(vi_permute(vi_load(triangles->slope[i]), lane), steps);
    const vi start = vi_permute(vi_load(triangles->weight[i]), lane);
    return vf_from_int(vi_add(start, vi_shl(along, BURNISH_SUBPIXEL_BITS)));
}

BURNISH_INLINE vf map_permute(const float x[LANES], vi lane) {
    return vf_from_bits(vi_permute(vf_bits(vf_load(x)), lane));
}

BURNISH_INLINE vi code_of(vf depth) {
    return vi_truncate(vf_add(vf_mul(depth, vf_set((float)BURNISH_MAP_CODES)), vf_set(0.5f)));
}

/* LANES covered texels: their indices in the map, and their codes. */
BURNISH_INLINE void find_codes(const map_triangles *triangles, const int32_t *items, int size,
                               int32_t texel[LANES], int32_t code[LANES]) {
    const vi item = vi_load(items);
    const vi lane = vi_and(vi_shr(item, 8), vi_set(LANES - 1));
    const vi steps = vi_and(item, vi_set(0x00ff00ff));
    const vf inverse_area = map_permute(triangles->inverse_area, lane);
    const vf weight1 = vf_mul(map_weight(triangles, 1, lane, steps), inverse_area);
    const vf weight2 = vf_mul(map_weight(triangles, 2, lane, steps), inverse_area);
    const vf first = vf_add(map_permute(triangles->depth[0], lane),
                            vf_mul(weight1, map_permute(triangles->depth[1], lane)));
    const vf depth = vf_add(first, vf_mul(weight2, map_permute(triangles->depth[2], lane)));
    vi_store(code, code_of(depth));
    vi_store(texel, vi_add(vi_permute(vi_load(triangles->texel), lane),
                           vi_dot16(steps, vi_set(1 | size << 16))));
}

/* The same of one, where vectors have no permutation. */
BURNISH_INLINE void find_code(const map_triangles *triangles, int32_t item, int size,
                              int32_t *texel, int32_t *code) {
    const int u = item & 0xff, v = item >> 16, lane = item >> 8 & (LANES - 1);
    float weight[3];
    for (int i = 1; i < 3; ++i) {
        const int32_t slope = triangles->slope[i][lane];
        const int32_t along = (int16_t)(slope & 0xffff) * u + (slope >> 16) * v;
        weight[i] = (float)(triangles->weight[i][lane] + along * BURNISH_SUBPIXELS) *
                    triangles->inverse_area[lane];
    }
    const float depth = (triangles->depth[0][lane] + weight[1] * triangles->depth[1][lane]) +
                        weight[2] * triangles->depth[2][lane];
    *code = (int32_t)(depth * (float)BURNISH_MAP_CODES + 0.5f);
    *texel = triangles->texel[lane] + v * size + u;
}

/* Raises covered texels to the triangles' depths. */
BURNISH_INLINE void fill_texels(const map_triangles *triangles, map_texels *texels, int size,
                                uint16_t *const depths[2]) {
    enum { AT_ONCE = LANES >= 8 ? LANES : 1 };
    int32_t texel[LANES], code[LANES];
    for (int first = 0; first < texels->count; first += AT_ONCE) {
        const int rest = texels->count - first, some = rest < AT_ONCE ? rest : AT_ONCE;
        if (LANES >= 8) {
            find_codes(triangles, texels->items + first, size, texel, code);
        } else {
            find_code(triangles, texels->items[first], size, texel, code);
        }
        for (int i = 0; i < some; ++i) {
            raise_texel(depths, (size_t)texel[i], code[i]);
        }
    }
    texels->count = 0;
}

/* From two texels in a row on, of twice the area in 1/256 texel squared, vectors of rows are faster. */
#define IN_A_ROW 0x1p-18f

/* Draws a triangle row by row, a vector of texels at a time, with the arithmetic of find_codes. It
 * begins further left where vectors would reach beyond a row; texels outside of the bounds are outside
 * of an edge. */
BURNISH_INLINE void draw_wide(const map_triangles *triangles, int lane, int size,
                              uint16_t *const depths[2]) {
    const int wide = triangles->wide[lane], high = triangles->high[lane];
    const int end = triangles->texel[lane] % size + (wide / LANES + 1) * LANES;
    const int before = end > size ? end - size : 0;
    const vi ramp = vi_sub(vi_ramp(1), vi_set(before));
    const vf inverse_area = vf_set(triangles->inverse_area[lane]);
    size_t texel = (size_t)(triangles->texel[lane] - before);
    vi row[3], right[3], down[3], bias[3];
    for (int i = 0; i < 3; ++i) {
        const int32_t slope = triangles->slope[i][lane], start = triangles->start[i][lane];
        const int32_t across = (int16_t)(slope & 0xffff) * BURNISH_SUBPIXELS;
        row[i] = vi_add(vi_set(start), vi_mul(ramp, vi_set(across)));
        right[i] = vi_set(across * LANES);
        down[i] = vi_set((slope >> 16) * BURNISH_SUBPIXELS);
        bias[i] = vi_set(triangles->weight[i][lane] - start);
    }
    for (int y = 0; y <= high; ++y, texel += (size_t)size) {
        vi e[3] = {row[0], row[1], row[2]};
        for (int x = 0; x <= wide; x += LANES) {
            const vm inside = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
            if (vm_any(inside)) {
                vf depth = vf_set(triangles->depth[0][lane]);
                for (int i = 1; i < 3; ++i) {
                    const vf weight = vf_mul(vf_from_int(vi_add(e[i], bias[i])), inverse_area);
                    depth = vf_add(depth, vf_mul(weight, vf_set(triangles->depth[i][lane])));
                }
                raise_texels(depths, texel + (size_t)x, inside, code_of(depth));
            }
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_add(e[i], right[i]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], down[i]);
        }
    }
}

/* Draws the first `count` <= LANES triangles of a queue. */
BURNISH_INLINE void draw_queue(const map_queue *queue, int count, int are_wide, int size,
                               uint16_t *const depths[2], map_texels *texels) {
    map_triangles triangles;
    set_up_map_triangles(queue, size, &triangles);
    if (!are_wide) {
        cover_narrow(&triangles, (1u << count) - 1, texels);
    }
    for (int lane = 0; lane < count && are_wide; ++lane) {
        const float rows = (float)(triangles.high[lane] + 1);
        if (rows * triangles.inverse_area[lane] < IN_A_ROW) {
            draw_wide(&triangles, lane, size, depths);
            continue;
        }
        cover_wide(&triangles, lane, texels);
        if (texels->count > COVERED_FULL) {
            fill_texels(&triangles, texels, size, depths);
        }
    }
    fill_texels(&triangles, texels, size, depths);
}

/* Triangles on their way into the maps. */
typedef struct maps_work {
    map_queue narrow[BURNISH_MAPS], wide[BURNISH_MAPS];
    map_texels texels;
} maps_work;

/* Draws a queue where it has enough for a vector; the others move to the front. */
BURNISH_INLINE void draw_full_queue(map_queue *queue, int are_wide, int size,
                                    uint16_t *const depths[2], map_texels *texels) {
    if (queue->count < LANES) {
        return;
    }
    draw_queue(queue, LANES, are_wide, size, depths, texels);
    queue->count -= LANES;
    for (int i = 0; i < 3; ++i) {
        vi_store(queue->at[i], vi_load(queue->at[i] + LANES));
        vi_store(queue->depth[i], vi_load(queue->depth[i] + LANES));
    }
}

BURNISH_INLINE void append_triangles(map_queue *queue, unsigned lanes, const vi at[3],
                                     const vf depth[3]) {
    for (int i = 0; i < 3; ++i) {
        vi_compress(lanes, queue->at[i] + queue->count, at[i]);
        vi_compress(lanes, queue->depth[i] + queue->count, vf_bits(depth[i]));
    }
    queue->count += __builtin_popcount(lanes);
}

/* What triangles `lanes` that are not large add to burnish_geometry.cells: triangle_cells
 * (geometry.c). */
BURNISH_INLINE uint64_t map_cells(unsigned lanes, const vi x[3], const vi y[3], vi area,
                                  const vi bounds[4]) {
    enum { CELL_BITS = BURNISH_HIZ_BITS + BURNISH_SUBPIXEL_BITS };
    const vi wide =
        vi_sub(vi_sar(bounds[2], BURNISH_HIZ_BITS), vi_sar(bounds[0], BURNISH_HIZ_BITS));
    const vi high =
        vi_sub(vi_sar(bounds[3], BURNISH_HIZ_BITS), vi_sar(bounds[1], BURNISH_HIZ_BITS));
    const vi one = vi_set(1);
    int32_t cells[LANES];
    uint64_t sum = 0;
    lanes &= vm_bits(vi_greater(vi_max(wide, high), one));
    if (!lanes) {
        return 0;
    }
    vi touched = vi_sar(vi_magnitude(area), 1 + 2 * CELL_BITS);
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1;
        const vi length =
            vi_add(vi_magnitude(vi_sub(x[i], x[j])), vi_magnitude(vi_sub(y[i], y[j])));
        touched = vi_add(touched, vi_add(vi_sar(length, CELL_BITS), vi_set(2)));
    }
    vi_store(cells, vi_min(touched, vi_mul(vi_add(wide, one), vi_add(high, one))));
    for (; lanes; lanes &= lanes - 1) {
        sum += (uint64_t)cells[__builtin_ctz(lanes)];
    }
    return sum;
}

/* Queues those triangles `lanes` of pair m that have an area and touch a texel, or draws them. */
BURNISH_INLINE void queue_triangles(burnish_maps *maps, int m, const vi at[3], const vf depth[3],
                                    unsigned lanes, maps_work *work) {
    vi x[3], y[3], bounds[4];
    for (int i = 0; i < 3; ++i) {
        x[i] = vi_and(at[i], vi_set(0xffff));
        y[i] = vi_shr(at[i], 16);
    }
    bound_texels(x, &bounds[0], &bounds[2]);
    bound_texels(y, &bounds[1], &bounds[3]);
    const vi wide = vi_sub(bounds[2], bounds[0]), high = vi_sub(bounds[3], bounds[1]);
    const unsigned touching = lanes & vm_bits(vi_not_negative(vi_or(wide, high)));
    if (!touching) { /* triangles of large meshes */
        return;
    }
    const vi area = vi_sub(vi_mul(vi_sub(x[1], x[0]), vi_sub(y[2], y[0])),
                           vi_mul(vi_sub(y[1], y[0]), vi_sub(x[2], x[0])));
    const unsigned flat = vm_bits(vi_equal(area, vi_set(0)));
    const unsigned narrow =
        touching & ~vm_bits(vi_greater(vi_max(wide, high), vi_set(FEW_TEXELS - 1)));
    append_triangles(&work->narrow[m], narrow & ~flat, at, depth);
    draw_full_queue(&work->narrow[m], 0, maps->size, maps->depths[m], &work->texels);
    if (touching == narrow) {
        return;
    }
    vi longest = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1;
        longest = vi_max(
            longest, vi_max(vi_magnitude(vi_sub(x[i], x[j])), vi_magnitude(vi_sub(y[i], y[j]))));
    }
    const unsigned large = touching & vm_bits(vi_greater(longest, vi_set(BURNISH_SMALL_EDGE)));
    const unsigned others = touching & ~narrow & ~large & ~flat;
    append_triangles(&work->wide[m], others, at, depth);
    draw_full_queue(&work->wide[m], 1, maps->size, maps->depths[m], &work->texels);
    maps->cells[m] += map_cells(others, x, y, area, bounds);
    if (large) {
        draw_long_triangles(maps, m, at, depth, bounds, large);
    }
}

/* The corners of triangles from `first` on. */
BURNISH_INLINE void load_map_triangles(const burnish_maps *maps, size_t first, size_t count,
                                       vf corner[3][4]) {
    for (size_t i = 0; i < 3; ++i) {
        const void *from[LANES];
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t triangle = first + (lane < count ? lane : 0);
            from[lane] = &maps->vertices[maps->indices[3 * triangle + i]];
        }
        vf_load_aos4(from, corner[i]);
    }
}

static void draw_maps(burnish_maps *maps) {
    maps_work work;
    work.texels.count = 0;
    for (int m = 0; m < maps->count; ++m) {
        work.narrow[m].count = work.wide[m].count = 0;
    }
    for (size_t first = 0; first < maps->triangle_count; first += LANES) {
        const size_t rest = maps->triangle_count - first;
        const unsigned lanes = rest < LANES ? (1u << rest) - 1 : (unsigned)ALL_LANES;
        vf corner[3][4];
        load_map_triangles(maps, first, rest, corner);
        for (int m = 0; m < maps->count; ++m) {
            const vi packed[3] = {vf_bits(corner[0][2 * m]), vf_bits(corner[1][2 * m]),
                                  vf_bits(corner[2][2 * m])};
            const vf depth[3] = {corner[0][2 * m + 1], corner[1][2 * m + 1], corner[2][2 * m + 1]};
            queue_triangles(maps, m, packed, depth, lanes, &work);
        }
    }
    for (int m = 0; m < maps->count; ++m) {
        draw_queue(&work.narrow[m], work.narrow[m].count, 0, maps->size, maps->depths[m],
                   &work.texels);
        draw_queue(&work.wide[m], work.wide[m].count, 1, maps->size, maps->depths[m], &work.texels);
    }
}

#endif
