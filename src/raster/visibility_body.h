/* Drawing triangles into a tile by vectors over a row. Included by the tiers, which define
 * BURNISH_VECTOR_... and DRAW, the function's name.
 *
 * Edge functions are whole numbers and exact: 32-bit ones for triangles up to 96 pixels, doubles,
 * which hold all of them, for larger ones. What is computed from them is what tile.c computes, in
 * the same order. */
#include <string.h>

#include "kernels/vector.h"
#include "raster/visibility.h"

/* Longest edge, in 1/256 pixel along an axis, whose functions fit 32 bits all over a tile that the
 * triangle touches: 2 * 24576 * (24576 + 64 * 256) < 2^31. */
enum { SMALL_EDGE = 96 * BURNISH_SUBPIXELS, HALF_PIXEL = BURNISH_SUBPIXELS / 2 };

/* How many triangles ahead memory is asked for. */
enum { AHEAD = 8 };

/* One triangle, relative to the tile. */
typedef struct tile_edges {
    int32_t x[3], y[3];   /* vertices */
    int32_t dx[3], dy[3]; /* edge i runs from vertex i + 1 to vertex i + 2 */
    int32_t bias[3];      /* -1 where the top-left rule leaves the edge out */
    int x0, y0, x1, y1;   /* pixels of the tile that its bounds touch; x1, y1 exclusive */
    float inverse_area;
    float depth[3];
} tile_edges;

static int32_t least(int32_t a, int32_t b, int32_t c) {
    int32_t d = a < b ? a : b;
    return d < c ? d : c;
}

static int32_t most(int32_t a, int32_t b, int32_t c) {
    int32_t d = a > b ? a : b;
    return d > c ? d : c;
}

/* Vertices and bounds; returns 0 when no pixel of the tile can be touched. */
static int load_bounds(const burnish_visibility *tile, const burnish_geometry *geometry,
                       const uint32_t v[3], tile_edges *edges) {
    for (int i = 0; i < 3; ++i) {
        const burnish_screen_vertex *vertex = &geometry->vertices.items[v[i]];
        edges->x[i] = vertex->x - tile->x * BURNISH_SUBPIXELS;
        edges->y[i] = vertex->y - tile->y * BURNISH_SUBPIXELS;
        edges->depth[i] = vertex->depth;
    }
    /* with one sample, pixels whose centre lies within the bounds; otherwise all that they touch */
    const int low = tile->samples == 1 ? HALF_PIXEL - 1 : 0;
    const int high = tile->samples == 1 ? HALF_PIXEL : 0;
    const int32_t *x = edges->x, *y = edges->y;
    int x0 = (least(x[0], x[1], x[2]) + low) >> 8, x1 = (most(x[0], x[1], x[2]) - high) >> 8;
    int y0 = (least(y[0], y[1], y[2]) + low) >> 8, y1 = (most(y[0], y[1], y[2]) - high) >> 8;
    edges->x0 = x0 < 0 ? 0 : x0;
    edges->y0 = y0 < 0 ? 0 : y0;
    edges->x1 = x1 >= BURNISH_TILE_SIZE ? BURNISH_TILE_SIZE : x1 + 1;
    edges->y1 = y1 >= BURNISH_TILE_SIZE ? BURNISH_TILE_SIZE : y1 + 1;
    return edges->x0 < edges->x1 && edges->y0 < edges->y1;
}

/* Whether everything that the triangle touches is nearer. Interpolated depths may pass the nearest
 * vertex by rounding: the factor is far more than that. */
static int is_hidden(const burnish_visibility *tile, const tile_edges *edges) {
    float a = edges->depth[0], b = edges->depth[1], c = edges->depth[2];
    float nearest = a > b ? a : b;
    nearest = (nearest > c ? nearest : c) * 1.00001f;
    if (!(nearest > 0.0f)) {
        return 0;
    }
    const int x1 = (edges->x1 - 1) / BURNISH_TILE_BLOCK, y1 = (edges->y1 - 1) / BURNISH_TILE_BLOCK;
    for (int y = edges->y0 / BURNISH_TILE_BLOCK; y <= y1; ++y) {
        for (int x = edges->x0 / BURNISH_TILE_BLOCK; x <= x1; ++x) {
            if (nearest >= tile->coarse[y][x]) {
                return 0;
            }
        }
    }
    return 1;
}

/* The rest; returns 1 when the edge functions fit 32 bits. */
static int load_edges(tile_edges *edges) {
    int32_t longest = 0;
    for (int i = 0; i < 3; ++i) {
        int a = i == 2 ? 0 : i + 1, b = i == 0 ? 2 : i - 1;
        int32_t dx = edges->x[b] - edges->x[a], dy = edges->y[b] - edges->y[a];
        edges->dx[i] = dx;
        edges->dy[i] = dy;
        edges->bias[i] = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
        dx = dx < 0 ? -dx : dx;
        dy = dy < 0 ? -dy : dy;
        longest = dx > longest ? dx : longest;
        longest = dy > longest ? dy : longest;
    }
    int64_t area = (int64_t)edges->dx[2] * edges->dy[0] - (int64_t)edges->dy[2] * edges->dx[0];
    edges->inverse_area = 1.0f / (float)area;
    edges->depth[1] -= edges->depth[0];
    edges->depth[2] -= edges->depth[0];
    return longest <= SMALL_EDGE;
}

/* A vector of samples of a row, from `place` on: e_i are the edge functions with their bias. Keeps
 * the weights where a pixel has one sample. Returns 1 when one became the triangle's. */
BURNISH_INLINE int draw_vector(const burnish_visibility *tile, const tile_edges *edges,
                               const vi e[3], int32_t owner, int single, size_t place) {
    vm covered = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
    if (!vm_any(covered)) {
        return 0;
    }
    vf area = vf_set(edges->inverse_area);
    vf weight1 = vf_mul(vi_convert(vi_sub(e[1], vi_set(edges->bias[1]))), area);
    vf weight2 = vf_mul(vi_convert(vi_sub(e[2], vi_set(edges->bias[2]))), area);
    vf depth = vf_add(vf_add(vf_set(edges->depth[0]), vf_mul(weight1, vf_set(edges->depth[1]))),
                      vf_mul(weight2, vf_set(edges->depth[2])));
    vf before = vf_load(tile->depths + place);
    vm nearer = vm_and(covered, vf_greater(depth, before));
    if (!vm_any(nearer)) {
        return 0;
    }
    vf_store(tile->depths + place, vf_blend(nearer, depth, before));
    vi_save(tile->owners + place, vi_blend(nearer, vi_set(owner), vi_load(tile->owners + place)));
    if (single) {
        float *first = tile->weights[0] + place, *second = tile->weights[1] + place;
        vf_store(first, vf_blend(nearer, weight1, vf_load(first)));
        vf_store(second, vf_blend(nearer, weight2, vf_load(second)));
    }
    return 1;
}

/* A triangle of up to 96 pixels. */
BURNISH_INLINE int draw_small(const burnish_visibility *tile, const tile_edges *edges,
                              int32_t owner, int single, const int8_t (*offsets)[2]) {
    const int first = edges->x0 & ~(LANES - 1);
    int drawn = 0;
    vi ramp[3], next[3], down[3];
    for (int i = 0; i < 3; ++i) {
        int32_t step = -edges->dy[i] * BURNISH_SUBPIXELS;
        ramp[i] = vi_ramp(step);
        next[i] = vi_set(step * LANES);
        down[i] = vi_set(edges->dx[i] * BURNISH_SUBPIXELS);
    }
    for (int s = 0; s < (single ? 1 : tile->samples); ++s) {
        const int32_t x = first * BURNISH_SUBPIXELS + HALF_PIXEL + offsets[s][0] * 16;
        const int32_t y = edges->y0 * BURNISH_SUBPIXELS + HALF_PIXEL + offsets[s][1] * 16;
        size_t place = (size_t)s * BURNISH_TILE_PIXELS + (size_t)(edges->y0 * BURNISH_TILE_SIZE);
        vi row[3];
        for (int i = 0; i < 3; ++i) {
            int a = i == 2 ? 0 : i + 1;
            int32_t start = edges->dx[i] * (y - edges->y[a]) - edges->dy[i] * (x - edges->x[a]);
            row[i] = vi_add(vi_set(start + edges->bias[i]), ramp[i]);
        }
        for (int line = edges->y0; line < edges->y1; ++line, place += BURNISH_TILE_SIZE) {
            vi e[3] = {row[0], row[1], row[2]};
            for (int column = first; column < edges->x1; column += LANES) {
                drawn |= draw_vector(tile, edges, e, owner, single, place + (size_t)column);
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
static int draw_row(const burnish_visibility *tile, const tile_edges *edges, const double start[3],
                    const double step[3], int32_t owner, size_t place) {
    const double limit0 = -edges->bias[0], limit1 = -edges->bias[1], limit2 = -edges->bias[2];
    const double start0 = start[0], start1 = start[1], start2 = start[2];
    const double step0 = step[0], step1 = step[1], step2 = step[2];
    const float area = edges->inverse_area;
    const float depth0 = edges->depth[0], depth1 = edges->depth[1], depth2 = edges->depth[2];
    float weights[2][BURNISH_TILE_SIZE];
    int32_t nearer[BURNISH_TILE_SIZE];
    float *restrict depths = tile->depths + place;
    int32_t *restrict owners = tile->owners + place;
    int32_t drawn = 0;
    for (int x = edges->x0; x < edges->x1; ++x) {
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
        for (int x = edges->x0; x < edges->x1; ++x) {
            kept[x] = nearer[x] ? weights[k][x] : kept[x];
        }
    }
    return drawn;
}

/* A triangle of any size: its edge functions are below 2^49. */
static int draw_large(const burnish_visibility *tile, const tile_edges *edges, int32_t owner,
                      const int8_t (*offsets)[2]) {
    int drawn = 0;
    for (int s = 0; s < tile->samples; ++s) {
        const int64_t x = HALF_PIXEL + offsets[s][0] * 16;
        for (int line = edges->y0; line < edges->y1; ++line) {
            const int64_t y = line * BURNISH_SUBPIXELS + HALF_PIXEL + offsets[s][1] * 16;
            const size_t place =
                (size_t)s * BURNISH_TILE_PIXELS + (size_t)(line * BURNISH_TILE_SIZE);
            double start[3], step[3];
            int outside = 0;
            for (int i = 0; i < 3; ++i) {
                int a = i == 2 ? 0 : i + 1;
                int64_t e = edges->dx[i] * (y - edges->y[a]) - edges->dy[i] * (x - edges->x[a]);
                int64_t along = -(int64_t)edges->dy[i] * BURNISH_SUBPIXELS;
                int64_t at0 = e + along * edges->x0, at1 = e + along * (edges->x1 - 1);
                outside |= (at0 > at1 ? at0 : at1) + edges->bias[i] < 0;
                start[i] = (double)e;
                step[i] = (double)along;
            }
            if (!outside) {
                drawn |= draw_row(tile, edges, start, step, owner, place);
            }
        }
    }
    return drawn;
}

/* What the tile's points will need of a triangle that owns a sample. */
static void remember(burnish_visibility *tile, const tile_edges *edges,
                     const burnish_setup_triangle *triangle) {
    burnish_tile_triangle *made = &tile->triangles[tile->triangle_count++];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        made->dx[i] = edges->dx[i + 1];
        made->dy[i] = edges->dy[i + 1];
        made->constant[i] =
            (int64_t)edges->dy[i + 1] * edges->x[a] - (int64_t)edges->dx[i + 1] * edges->y[a];
    }
    made->inverse_area = edges->inverse_area;
    memcpy(made->depth, edges->depth, sizeof made->depth);
    memcpy(made->corners.vertices, triangle->vertices, sizeof made->corners.vertices);
    made->corners.source = triangle->source;
}

void DRAW(burnish_visibility *visibility, const burnish_geometry *geometry, const uint32_t *entries,
          size_t count, int covered) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(visibility->samples);
    for (size_t k = 0; k < count; ++k) {
        const burnish_setup_triangle *triangle = &geometry->triangles[entries[k]];
        tile_edges edges;
        if (k + 2 * AHEAD < count) { /* lists are in the mesh's order, not in that of memory */
            const uint32_t *near = geometry->triangles[entries[k + AHEAD]].vertices;
            __builtin_prefetch(&geometry->triangles[entries[k + 2 * AHEAD]]);
            __builtin_prefetch(&geometry->vertices.items[near[0]]);
            __builtin_prefetch(&geometry->vertices.items[near[1]]);
            __builtin_prefetch(&geometry->vertices.items[near[2]]);
        }
        if (!load_bounds(visibility, geometry, triangle->vertices, &edges) ||
            (covered && is_hidden(visibility, &edges))) {
            continue;
        }
        if (visibility->triangle_count == visibility->triangle_capacity) {
            burnish_visibility_compact(visibility);
        }
        int32_t owner = (int32_t)visibility->triangle_count;
        int drawn;
        if (!load_edges(&edges)) {
            drawn = draw_large(visibility, &edges, owner, offsets);
        } else if (visibility->samples == 1) {
            drawn = draw_small(visibility, &edges, owner, 1, offsets);
        } else {
            drawn = draw_small(visibility, &edges, owner, 0, offsets);
        }
        if (drawn) {
            remember(visibility, &edges, triangle);
        }
    }
}
