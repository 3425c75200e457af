/* Drawing triangles into a tile by vectors over a row. Included by the tiers, which define
 * BURNISH_VECTOR_... and DRAW, the function's name.
 *
 * Edge functions are whole numbers and exact: 32-bit ones for triangles up to 96 pixels, doubles,
 * which hold all of them, for larger ones. What is computed from them keeps one order of
 * operations, that of test/reference_tile.h. */
#include <string.h>

#include "kernels/vector.h"
#include "raster/visibility.h"

/* Longest edge, in 1/256 pixel along an axis, whose functions fit 32 bits all over a tile that the
 * triangle touches: 2 * 24576 * (24576 + 64 * 256) < 2^31. */
enum { SMALL_EDGE = 96 * BURNISH_SUBPIXELS, HALF_PIXEL = BURNISH_SUBPIXELS / 2 };

/* log2 of LANES. */
enum { LANE_BITS = LANES == 16 ? 4 : LANES == 8 ? 3 : LANES == 4 ? 2 : 0 };

/* As many triangles as a vector has lanes, relative to the tile. */
typedef struct setup_block {
    int32_t x[3][LANES], y[3][LANES];   /* vertices */
    int32_t dx[3][LANES], dy[3][LANES]; /* edge i runs from vertex i + 1 to vertex i + 2 */
    int32_t bias[3][LANES];             /* -1 where the top-left rule leaves the edge out */
    int32_t start[3][LANES];            /* edge functions with bias at the centre of (first, y0) */
    int32_t x0[LANES], y0[LANES], x1[LANES], y1[LANES]; /* pixels of the tile that the bounds touch;
                                                           x1, y1 inclusive */
    int32_t empty[LANES];                               /* < 0 where they touch none */
    int32_t longest[LANES];                             /* of an edge along an axis */
    float depth[3][LANES];                              /* of vertex 0; of 1 and 2 minus that */
    float nearest[LANES];
    float inverse_area[LANES]; /* of triangles whose edge functions fit 32 bits */
} setup_block;

/* Copies the corners of up to LANES triangles. */
static void load_corners(const burnish_visibility *tile, const burnish_geometry *geometry,
                         const uint32_t *entries, size_t count, setup_block *block) {
    const int32_t left = tile->x * BURNISH_SUBPIXELS, top = tile->y * BURNISH_SUBPIXELS;
    for (size_t lane = 0; lane < LANES; ++lane) {
        const uint32_t *v = geometry->triangles[entries[lane < count ? lane : 0]].vertices;
        for (int i = 0; i < 3; ++i) {
            const burnish_screen_vertex *vertex = &geometry->vertices.items[v[i]];
            block->x[i][lane] = vertex->x - left;
            block->y[i][lane] = vertex->y - top;
            block->depth[i][lane] = vertex->depth;
        }
    }
}

/* First and last pixel of the tile along one axis that [low, high] touches; with one sample those
 * whose centre lies in it. */
BURNISH_INLINE void find_pixels(const burnish_visibility *tile, const vi at[3], vi *first,
                                vi *last) {
    const int to_first = tile->samples == 1 ? HALF_PIXEL - 1 : 0;
    const int to_last = tile->samples == 1 ? HALF_PIXEL : 0;
    vi low = vi_min(vi_min(at[0], at[1]), at[2]), high = vi_max(vi_max(at[0], at[1]), at[2]);
    low = vi_right_signed(vi_add(low, vi_set(to_first)), 8);
    high = vi_right_signed(vi_sub(high, vi_set(to_last)), 8);
    *first = vi_max(low, vi_set(0));
    *last = vi_min(high, vi_set(BURNISH_TILE_SIZE - 1));
}

BURNISH_INLINE vi magnitude(vi x) {
    return vi_max(x, vi_sub(vi_set(0), x));
}

/* Bounds, edges and depth of a block. Numbers of triangles that are too large wrap round and are
 * not used. */
static void set_up_block(const burnish_visibility *tile, setup_block *block) {
    vi x[3], y[3], dx[3], dy[3], x0, y0, x1, y1, longest = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        x[i] = vi_load(block->x[i]);
        y[i] = vi_load(block->y[i]);
    }
    find_pixels(tile, x, &x0, &x1);
    find_pixels(tile, y, &y0, &y1);
    vi_save(block->x0, x0);
    vi_save(block->y0, y0);
    vi_save(block->x1, x1);
    vi_save(block->y1, y1);
    vi_save(block->empty, vi_or(vi_sub(x1, x0), vi_sub(y1, y0)));
    const vi first = vi_left(vi_right(x0, LANE_BITS), LANE_BITS);
    const vi at_x = vi_add(vi_left(first, 8), vi_set(HALF_PIXEL));
    const vi at_y = vi_add(vi_left(y0, 8), vi_set(HALF_PIXEL));
    for (int i = 0; i < 3; ++i) {
        const int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        dx[i] = vi_sub(x[b], x[a]);
        dy[i] = vi_sub(y[b], y[a]);
        longest = vi_max(longest, vi_max(magnitude(dx[i]), magnitude(dy[i])));
        /* top or left: dy < 0, or dy = 0 and dx > 0; as signs of whole numbers */
        vi left = vi_right_signed(dy[i], 31);
        vi level = vi_right_signed(vi_sub(magnitude(dy[i]), vi_set(1)), 31);
        vi right = vi_right_signed(vi_sub(vi_set(0), dx[i]), 31);
        vi bias = vi_sub(vi_set(-1), vi_or(left, vi_and(level, right)));
        vi start = vi_sub(vi_mul(dx[i], vi_sub(at_y, y[a])), vi_mul(dy[i], vi_sub(at_x, x[a])));
        vi_save(block->dx[i], dx[i]);
        vi_save(block->dy[i], dy[i]);
        vi_save(block->bias[i], bias);
        vi_save(block->start[i], vi_add(start, bias));
    }
    vi_save(block->longest, longest);
    vf area = vi_convert(vi_sub(vi_mul(dx[2], dy[0]), vi_mul(dy[2], dx[0])));
    vf_store(block->inverse_area, vf_div(vf_set(1.0f), area));
    vf depth0 = vf_load(block->depth[0]), depth1 = vf_load(block->depth[1]),
       depth2 = vf_load(block->depth[2]);
    vf_store(block->nearest, vf_max(vf_max(depth0, depth1), depth2));
    vf_store(block->depth[1], vf_sub(depth1, depth0));
    vf_store(block->depth[2], vf_sub(depth2, depth0));
}

/* Whether everything that the triangle touches is nearer. Interpolated depths may pass the nearest
 * vertex by rounding: the factor is far more than that. */
static int is_hidden(const burnish_visibility *tile, const setup_block *block, size_t lane) {
    const float nearest = block->nearest[lane] * 1.00001f;
    const int x0 = block->x0[lane] / BURNISH_TILE_BLOCK, x1 = block->x1[lane] / BURNISH_TILE_BLOCK;
    const int y0 = block->y0[lane] / BURNISH_TILE_BLOCK, y1 = block->y1[lane] / BURNISH_TILE_BLOCK;
    if (!(nearest > 0.0f)) {
        return 0;
    }
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            if (nearest >= tile->coarse[y][x]) {
                return 0;
            }
        }
    }
    return 1;
}

/* One triangle of a block in the form that its rows are drawn from. */
typedef struct row_constants {
    vf inverse_area, depth[3];
    vi bias[3], owner;
} row_constants;

/* A vector of samples of a row, from `place` on: e_i are the edge functions with their bias. Keeps
 * the weights where a pixel has one sample. Returns 1 when one became the triangle's. */
BURNISH_INLINE int draw_vector(const burnish_visibility *tile, const row_constants *constants,
                               const vi e[3], int single, size_t place) {
    vm covered = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
    if (!vm_any(covered)) {
        return 0;
    }
    vf weight1 = vf_mul(vi_convert(vi_sub(e[1], constants->bias[1])), constants->inverse_area);
    vf weight2 = vf_mul(vi_convert(vi_sub(e[2], constants->bias[2])), constants->inverse_area);
    vf depth = vf_add(vf_add(constants->depth[0], vf_mul(weight1, constants->depth[1])),
                      vf_mul(weight2, constants->depth[2]));
    vf before = vf_load(tile->depths + place);
    vm nearer = vm_and(covered, vf_greater(depth, before));
    if (!vm_any(nearer)) {
        return 0;
    }
    vf_store(tile->depths + place, vf_blend(nearer, depth, before));
    vi_save(tile->owners + place,
            vi_blend(nearer, constants->owner, vi_load(tile->owners + place)));
    if (single) {
        float *first = tile->weights[0] + place, *second = tile->weights[1] + place;
        vf_store(first, vf_blend(nearer, weight1, vf_load(first)));
        vf_store(second, vf_blend(nearer, weight2, vf_load(second)));
    }
    return 1;
}

/* A triangle of up to 96 pixels. */
BURNISH_INLINE int draw_small(const burnish_visibility *tile, const setup_block *block, size_t lane,
                              int32_t owner, int single, const int8_t (*offsets)[2]) {
    const int first = block->x0[lane] & ~(LANES - 1), last = block->x1[lane];
    const int y0 = block->y0[lane], y1 = block->y1[lane];
    int drawn = 0;
    row_constants constants;
    vi ramp[3], next[3], down[3];
    constants.inverse_area = vf_set(block->inverse_area[lane]);
    constants.owner = vi_set(owner);
    for (int i = 0; i < 3; ++i) {
        const int32_t step = -block->dy[i][lane] * BURNISH_SUBPIXELS;
        ramp[i] = vi_ramp(step);
        next[i] = vi_set(step * LANES);
        down[i] = vi_set(block->dx[i][lane] * BURNISH_SUBPIXELS);
        constants.depth[i] = vf_set(block->depth[i][lane]);
        constants.bias[i] = vi_set(block->bias[i][lane]);
    }
    for (int s = 0; s < (single ? 1 : tile->samples); ++s) {
        size_t place = (size_t)s * BURNISH_TILE_PIXELS + (size_t)(y0 * BURNISH_TILE_SIZE);
        vi row[3];
        for (int i = 0; i < 3; ++i) {
            int32_t start = block->start[i][lane];
            if (!single) {
                start +=
                    16 * (block->dx[i][lane] * offsets[s][1] - block->dy[i][lane] * offsets[s][0]);
            }
            row[i] = vi_add(vi_set(start), ramp[i]);
        }
        for (int line = y0; line <= y1; ++line, place += BURNISH_TILE_SIZE) {
            vi e[3] = {row[0], row[1], row[2]};
            for (int column = first; column <= last; column += LANES) {
                drawn |= draw_vector(tile, &constants, e, single, place + (size_t)column);
                for (int i = 0; i < 3; ++i) {
                    e[i] = vi_add(e[i], next[i]);
                }
            }
            for (int i = 0; i < 3; ++i) {
                row[i] = vi_add(row[i], down[i]);
            }
        }
    }
    return drawn;
}

/* One row of a large triangle from `place` on; start and step of each edge function are whole
 * numbers below 2^53. */
static int draw_row(const burnish_visibility *tile, const setup_block *block, size_t lane,
                    float area, const double start[3], const double step[3], int32_t owner,
                    size_t place) {
    const double limit0 = -block->bias[0][lane], limit1 = -block->bias[1][lane],
                 limit2 = -block->bias[2][lane];
    const double start0 = start[0], start1 = start[1], start2 = start[2];
    const double step0 = step[0], step1 = step[1], step2 = step[2];
    const float depth0 = block->depth[0][lane], depth1 = block->depth[1][lane],
                depth2 = block->depth[2][lane];
    const int x0 = block->x0[lane], x1 = block->x1[lane];
    float weights[2][BURNISH_TILE_SIZE];
    int32_t nearer[BURNISH_TILE_SIZE];
    float *restrict depths = tile->depths + place;
    int32_t *restrict owners = tile->owners + place;
    int32_t drawn = 0;
    for (int x = x0; x <= x1; ++x) {
        const double e0 = start0 + step0 * x, e1 = start1 + step1 * x, e2 = start2 + step2 * x;
        const float weight1 = (float)e1 * area, weight2 = (float)e2 * area;
        const float depth = (depth0 + weight1 * depth1) + weight2 * depth2;
        nearer[x] = (e0 >= limit0) & (e1 >= limit1) & (e2 >= limit2) & (depth > depths[x]);
        depths[x] = nearer[x] ? depth : depths[x];
        owners[x] = nearer[x] ? owner : owners[x];
        weights[0][x] = weight1;
        weights[1][x] = weight2;
        drawn |= nearer[x];
    }
    for (int k = 0; k < 2 && tile->weights[0] && drawn; ++k) {
        float *restrict kept = tile->weights[k] + place;
        for (int x = x0; x <= x1; ++x) {
            kept[x] = nearer[x] ? weights[k][x] : kept[x];
        }
    }
    return drawn;
}

/* A triangle of any size: its edge functions are below 2^49. */
static int draw_large(const burnish_visibility *tile, setup_block *block, size_t lane,
                      int32_t owner, const int8_t (*offsets)[2]) {
    const int64_t area = (int64_t)block->dx[2][lane] * block->dy[0][lane] -
                         (int64_t)block->dy[2][lane] * block->dx[0][lane];
    const float inverse_area = 1.0f / (float)area;
    int drawn = 0;
    block->inverse_area[lane] = inverse_area;
    for (int s = 0; s < tile->samples; ++s) {
        const int64_t x = HALF_PIXEL + offsets[s][0] * 16;
        for (int line = block->y0[lane]; line <= block->y1[lane]; ++line) {
            const int64_t y = line * BURNISH_SUBPIXELS + HALF_PIXEL + offsets[s][1] * 16;
            const size_t place =
                (size_t)s * BURNISH_TILE_PIXELS + (size_t)(line * BURNISH_TILE_SIZE);
            double start[3], step[3];
            int outside = 0;
            for (int i = 0; i < 3; ++i) {
                const int a = i == 2 ? 0 : i + 1;
                int64_t e = block->dx[i][lane] * (y - block->y[a][lane]) -
                            block->dy[i][lane] * (x - block->x[a][lane]);
                int64_t along = -(int64_t)block->dy[i][lane] * BURNISH_SUBPIXELS;
                int64_t at0 = e + along * block->x0[lane], at1 = e + along * block->x1[lane];
                outside |= (at0 > at1 ? at0 : at1) + block->bias[i][lane] < 0;
                start[i] = (double)e;
                step[i] = (double)along;
            }
            if (!outside) {
                drawn |= draw_row(tile, block, lane, inverse_area, start, step, owner, place);
            }
        }
    }
    return drawn;
}

/* What the tile's points will need of a triangle that owns a sample. */
static void remember(burnish_visibility *tile, const setup_block *block, size_t lane,
                     const burnish_setup_triangle *triangle) {
    burnish_tile_triangle *made = &tile->triangles[tile->triangle_count++];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        made->dx[i] = block->dx[i + 1][lane];
        made->dy[i] = block->dy[i + 1][lane];
        made->constant[i] =
            (int64_t)made->dy[i] * block->x[a][lane] - (int64_t)made->dx[i] * block->y[a][lane];
    }
    made->inverse_area = block->inverse_area[lane];
    for (int i = 0; i < 3; ++i) {
        made->depth[i] = block->depth[i][lane];
    }
    memcpy(made->corners.vertices, triangle->vertices, sizeof made->corners.vertices);
    made->corners.source = triangle->source;
}

/* Lists are in the mesh's order, not in that of memory: asks for what comes after the next block.
 */
static void look_ahead(const burnish_geometry *geometry, const uint32_t *entries, size_t from,
                       size_t count) {
    for (size_t k = from; k < from + LANES && k < count; ++k) {
        const uint32_t *v = geometry->triangles[entries[k]].vertices;
        __builtin_prefetch(&geometry->vertices.items[v[0]]);
        __builtin_prefetch(&geometry->vertices.items[v[1]]);
        __builtin_prefetch(&geometry->vertices.items[v[2]]);
        if (k + LANES < count) {
            __builtin_prefetch(&geometry->triangles[entries[k + LANES]]);
        }
    }
}

void DRAW(burnish_visibility *visibility, const burnish_geometry *geometry, const uint32_t *entries,
          size_t count, int covered) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(visibility->samples);
    setup_block block;
    for (size_t first = 0; first < count; first += LANES) {
        const size_t lanes = count - first < LANES ? count - first : LANES;
        look_ahead(geometry, entries, first + LANES, count);
        load_corners(visibility, geometry, entries + first, lanes, &block);
        set_up_block(visibility, &block);
        for (size_t lane = 0; lane < lanes; ++lane) {
            if (block.empty[lane] < 0 || (covered && is_hidden(visibility, &block, lane))) {
                continue;
            }
            if (visibility->triangle_count == visibility->triangle_capacity) {
                burnish_visibility_compact(visibility);
            }
            const int32_t owner = (int32_t)visibility->triangle_count;
            int drawn;
            if (block.longest[lane] > SMALL_EDGE) {
                drawn = draw_large(visibility, &block, lane, owner, offsets);
            } else if (visibility->samples == 1) {
                drawn = draw_small(visibility, &block, lane, owner, 1, offsets);
            } else {
                drawn = draw_small(visibility, &block, lane, owner, 0, offsets);
            }
            if (drawn) {
                remember(visibility, &block, lane, &geometry->triangles[entries[first + lane]]);
            }
        }
    }
}
