/* Large triangles into a pair of depth maps, row by row. */
#ifndef BURNISH_RASTER_MAPS_LARGE_SIMD_H
#define BURNISH_RASTER_MAPS_LARGE_SIMD_H

#include "raster/geometry_simd.h"
#include "raster/maps.h"

/* Sets a texel to a code, and to what it is against the direction, where these are greater. */
BURNISH_INLINE void raise_texel(uint16_t *const depths[2], size_t texel, int32_t code) {
    const uint16_t along = (uint16_t)code, against = (uint16_t)~code;
    uint16_t *const to = depths[0] + texel, *const back = depths[1] + texel;
    const uint16_t old = *to, old_back = *back;
    *to = along > old ? along : old;
    *back = against > old_back ? against : old_back;
}

/* The same for those of LANES texels in a row that are covered. */
BURNISH_INLINE void raise_texels(uint16_t *const depths[2], size_t texel, vm covered, vi codes) {
    const vi zero = vi_set(0), most = vi_set(0xffff), code = vi_and(codes, most);
    int32_t along[LANES], against[LANES];
    uint16_t *const to = depths[0] + texel, *const back = depths[1] + texel;
    vi_store(along, vi_blend(covered, code, zero));
    vi_store(against, vi_blend(covered, vi_sub(most, code), zero));
#pragma GCC unroll 1 /* loops that become vectors */
    for (int i = 0; i < LANES; ++i) {
        to[i] = (uint16_t)along[i] > to[i] ? (uint16_t)along[i] : to[i];
    }
#pragma GCC unroll 1
    for (int i = 0; i < LANES; ++i) {
        back[i] = (uint16_t)against[i] > back[i] ? (uint16_t)against[i] : back[i];
    }
}

/* E needs more than 32 bits. Vertices 1 and 2 of a front-facing triangle are swapped, as for other
 * triangles. */
typedef struct long_triangle {
    int64_t x[3], y[3], area; /* twice the area, 1/256 texel squared, > 0 */
    double depth[3];
    int first_x, first_y, last_x, last_y; /* texels */
} long_triangle;

/* The texels that a row of texel centres has inside all edges: [*first, *last].
 *   e        floor(E / 256) at the centre of column 0, and its step to the next column
 *   columns  -1 / step: a quotient is whole or 2^-16 from it, so that EPSILON decides */
BURNISH_INLINE void clip_row(const int32_t e[3], const int32_t step[3], const double columns[3],
                             int *first, int *last) {
    const double epsilon = 0x1p-20;
    for (int i = 0; i < 3; ++i) {
        const double column = (double)e[i] * columns[i];
        if (step[i] > 0) {
            const int from = e[i] >= 0 ? 0 : (int)(column + (1 - epsilon));
            *first = from > *first ? from : *first;
        } else {
            const int to = e[i] < 0 ? -1 : step[i] == 0 ? *last : (int)(column + epsilon);
            *last = to < *last ? to : *last;
        }
    }
}

enum { FEW_IN_A_ROW = 3 };

/* Raises `count` texels in a row to codes that are linear along the row, clamped to the range of
 * the vertices. */
BURNISH_INLINE void raise_row(uint16_t *const depths[2], size_t texel, int count, float code,
                              float step, const float limits[2]) {
    for (int x = 0; x < count && count <= FEW_IN_A_ROW; ++x) { /* as a vector does */
        const float exact = code + (float)x * step, most = limits[1];
        const float limited = exact > limits[0] ? exact : limits[0];
        raise_texel(depths, texel + (size_t)x, (int32_t)(limited < most ? limited : most));
    }
    for (int x = 0; x < count && count > FEW_IN_A_ROW; x += LANES) {
        int32_t codes[LANES];
        const int some = count - x < LANES ? count - x : LANES;
        const vf along = vf_from_int(vi_add(vi_ramp(1), vi_set(x)));
        const vf exact = vf_add(vf_set(code), vf_mul(along, vf_set(step)));
        vi_store(codes, vi_truncate(vf_min(vf_max(exact, vf_set(limits[0])), vf_set(limits[1]))));
        for (int i = 0; i < some; ++i) {
            raise_texel(depths, texel + (size_t)(x + i), codes[i]);
        }
    }
}

/* Row by row: divisions give the texels between the edges, a plane gives the depths. */
BURNISH_INLINE void draw_long(const long_triangle *t, int size, uint16_t *const depths[2]) {
    const double codes = BURNISH_MAP_CODES, scale = codes / (double)t->area;
    const double step1 = (t->depth[1] - t->depth[0]) * scale;
    const double step2 = (t->depth[2] - t->depth[0]) * scale;
    float limits[2] = {(float)(t->depth[0] * codes + 0.5), (float)(t->depth[0] * codes + 0.5)};
    int64_t start[3], dx[3], dy[3];
    int32_t e[3], right[3];
    double columns[3];
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        const float limit = (float)(t->depth[i] * codes + 0.5);
        dx[i] = t->x[b] - t->x[a];
        dy[i] = t->y[b] - t->y[a];
        start[i] =
            dx[i] * ((int64_t)t->first_y * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2 - t->y[a]) -
            dy[i] * ((int64_t)t->first_x * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2 - t->x[a]);
        const int is_top_or_left = dy[i] < 0 || (dy[i] == 0 && dx[i] > 0);
        e[i] = (int32_t)((start[i] - !is_top_or_left) >> BURNISH_SUBPIXEL_BITS);
        right[i] = (int32_t)-dy[i];
        columns[i] = dy[i] ? 1 / (double)dy[i] : 0;
        limits[0] = limit < limits[0] ? limit : limits[0];
        limits[1] = limit > limits[1] ? limit : limits[1];
    }
    const double code =
        t->depth[0] * codes + 0.5 + ((double)start[1] * step1 + (double)start[2] * step2);
    const double per_x = -BURNISH_SUBPIXELS * ((double)dy[1] * step1 + (double)dy[2] * step2);
    const double per_y = BURNISH_SUBPIXELS * ((double)dx[1] * step1 + (double)dx[2] * step2);
    const int rows = t->last_y - t->first_y, wide = t->last_x - t->first_x;
    size_t texel = (size_t)t->first_y * (size_t)size + (size_t)t->first_x;
    for (int y = 0; y <= rows; ++y, texel += (size_t)size) {
        int first = 0, last = wide;
        clip_row(e, right, columns, &first, &last);
        if (first <= last) {
            raise_row(depths, texel + (size_t)first, last - first + 1,
                      (float)(code + y * per_y + first * per_x), (float)per_x, limits);
        }
        for (int i = 0; i < 3; ++i) {
            e[i] += (int32_t)dx[i];
        }
    }
}

/* What one adds to burnish_geometry.cells. */
BURNISH_INLINE uint64_t long_cells(const long_triangle *t) {
    enum { CELL_BITS = BURNISH_HIZ_BITS + BURNISH_SUBPIXEL_BITS };
    const int64_t wide = (t->last_x >> BURNISH_HIZ_BITS) - (t->first_x >> BURNISH_HIZ_BITS);
    const int64_t high = (t->last_y >> BURNISH_HIZ_BITS) - (t->first_y >> BURNISH_HIZ_BITS);
    int64_t touched = t->area >> (1 + 2 * CELL_BITS);
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1;
        const int64_t dx = t->x[i] - t->x[j], dy = t->y[i] - t->y[j];
        touched += (((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy)) >> CELL_BITS) + 2;
    }
    const int64_t box = (wide + 1) * (high + 1);
    return wide > 1 || high > 1 ? (uint64_t)(touched < box ? touched : box) : 0;
}

/* Draws those triangles `lanes` of pair m that have an area. */
BURNISH_INLINE void draw_long_triangles(burnish_maps *maps, int m, const vi at[3],
                                        const vf depth[3], const vi bounds[4], unsigned lanes) {
    int32_t packed[3][LANES], bound[4][LANES];
    float depths[3][LANES];
    for (int i = 0; i < 3; ++i) {
        vi_store(packed[i], at[i]);
        vf_store(depths[i], depth[i]);
    }
    for (int i = 0; i < 4; ++i) {
        vi_store(bound[i], bounds[i]);
    }
    for (; lanes; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        long_triangle t = {.first_x = bound[0][lane],
                           .first_y = bound[1][lane],
                           .last_x = bound[2][lane],
                           .last_y = bound[3][lane]};
        for (int i = 0; i < 3; ++i) {
            t.x[i] = packed[i][lane] & 0xffff;
            t.y[i] = (uint32_t)packed[i][lane] >> 16;
            t.depth[i] = (double)depths[i][lane];
        }
        const int64_t area =
            (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.y[1] - t.y[0]) * (t.x[2] - t.x[0]);
        t.area = area < 0 ? -area : area;
        if (area < 0) {
            const int64_t x = t.x[1], y = t.y[1];
            const double first = t.depth[1];
            t.x[1] = t.x[2];
            t.y[1] = t.y[2];
            t.depth[1] = t.depth[2];
            t.x[2] = x;
            t.y[2] = y;
            t.depth[2] = first;
        }
        if (area) {
            maps->cells[m] += long_cells(&t);
            draw_long(&t, maps->size, maps->depths[m]);
        }
    }
}

#endif
