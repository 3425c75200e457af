/* Drawing large triangles cell by cell: cells that an edge or HiZ excludes are left out at once,
 * cells wholly inside need no edges, and depth and attributes are planes, one addition per vector.
 *
 * Coverage is exact. From one pixel's centre to the next, or from sample s of a pixel to sample s
 * of the next, an edge function changes by multiples of 256. So floor(E / 256) has the sign of E,
 * and its steps are whole numbers. An edge that crosses the tile stays below 63 (2^23 + 2^23) +
 * 2^23 < 2^31 all over it, for images of 16384 pixels and a guard band of 16000.
 *
 * Planes count from the tile's first pixel in double precision up to a cell's first pixel, and
 * within the cell in single precision:
 *   value(x, y) = (float)((base + down Y) + across X) + ((float)across u + (float)down v),
 * X, Y the cell's first pixel, u, v the pixel in the cell. The error is about 2^-24 of the value
 * and 2^-23 of what the plane changes in seven pixels. */
#ifndef BURNISH_RASTER_LARGE_SIMD_H
#define BURNISH_RASTER_LARGE_SIMD_H

#include "raster/stamps_simd.h"

enum {
    /* cells that are classified at once */
    CELL_COLUMNS = (int)LANES < (int)BURNISH_HIZ_SIZE ? (int)LANES : (int)BURNISH_HIZ_SIZE,
    CELL_ROWS = (int)LANES / CELL_COLUMNS,
    CELL_BLOCKS = BURNISH_HIZ_PIXELS / BURNISH_BLOCK_SIZE, /* across and down */
    CELL_PIXELS = BURNISH_HIZ_PIXELS * BURNISH_HIZ_PIXELS,
    /* four numbers are one vector: depth and three of the first attribute, then the others */
    NUMBERS = 2 * 4
};

typedef double double4 __attribute__((vector_size(32)));
typedef float float4 __attribute__((vector_size(16)));

/* Columns and rows of a cell's pixels, block after block, and of cells that are classified at
 * once. */
#define BLOCK_X(x)                                                                                 \
    x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3, x, x + 1, x + 2, x + 3
#define BLOCK_Y(y)                                                                                 \
    y, y, y, y, y + 1, y + 1, y + 1, y + 1, y + 2, y + 2, y + 2, y + 2, y + 3, y + 3, y + 3, y + 3
static const int32_t PIXEL_X[CELL_PIXELS] = {BLOCK_X(0), BLOCK_X(4), BLOCK_X(0), BLOCK_X(4)};
static const int32_t PIXEL_Y[CELL_PIXELS] = {BLOCK_Y(0), BLOCK_Y(0), BLOCK_Y(4), BLOCK_Y(4)};
#undef BLOCK_X
#undef BLOCK_Y
static const int32_t CELL_X[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
static const int32_t CELL_Y[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

/* floor((E + bias) / 256): an edge that crosses the tile; all zero for one that has all of it
 * inside. */
typedef struct large_edge {
    int64_t value;              /* E at the centre of the tile's first pixel, whatever it crosses */
    int32_t start, right, down; /* at the centre of the tile's first pixel; steps per pixel */
    int32_t step[BURNISH_MAX_SAMPLES]; /* from a pixel's centre to its samples */
    int32_t most;                      /* of these steps */
    int32_t low, high;           /* least and greatest step from a cell's first pixel centre */
    int32_t pixels[CELL_PIXELS]; /* steps from a cell's first pixel to all of them */
    int32_t cells[LANES];        /* from the first of CELL_ROWS x CELL_COLUMNS cells */
} large_edge;

/* A large triangle in a tile. */
typedef struct large_triangle {
    large_edge edges[3];
    double4 base[2], across[2], down[2];     /* the planes of depth and attributes */
    float low[NUMBERS], high[NUMBERS];       /* of the vertices */
    int is_needle;                           /* attributes may leave these bounds by rounding */
    float pixels[NUMBERS][CELL_PIXELS];      /* steps of the planes within a cell */
    float sample_depth[BURNISH_MAX_SAMPLES]; /* from a pixel's centre to its samples */
    float depth, depth_right, depth_down;    /* of the first cell's first pixel; steps per cell */
    float nearest, farthest;                 /* steps of a cell's bounds from there */
    float cell_depths[LANES];
} large_triangle;

/* Fills an edge; returns 0 when the whole tile is outside. */
BURNISH_INLINE int compute_large_edge(const triangle_setup *setup, size_t lane, int i, int samples,
                                      large_edge *edge) {
    enum { LAST = BURNISH_TILE_SIZE - 1, LAST_OF_CELL = BURNISH_HIZ_PIXELS - 1 };
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    const int a = i == 2 ? 0 : i + 1;
    const int64_t dx = setup->dx[i][lane], dy = setup->dy[i][lane];
    edge->value = dx * (HALF_PIXEL - setup->y[a][lane]) - dy * (HALF_PIXEL - setup->x[a][lane]);
    const int64_t e = edge->value + setup->bias[i][lane];
    const int64_t start = e >> BURNISH_SUBPIXEL_BITS;
    int32_t right = (int32_t)-dy, down = (int32_t)dx, least = INT32_MAX, most = INT32_MIN;
    for (int s = 0; s < samples; ++s) {
        const int64_t at = e + BURNISH_SAMPLE_STEP * (dx * offsets[s][1] - dy * offsets[s][0]);
        const int32_t step = (int32_t)((at >> BURNISH_SUBPIXEL_BITS) - start);
        edge->step[s] = step;
        least = step < least ? step : least;
        most = step > most ? step : most;
    }
    int32_t low = (right < 0 ? right : 0) + (down < 0 ? down : 0);
    int32_t high = (right > 0 ? right : 0) + (down > 0 ? down : 0);
    if (start + (int64_t)LAST * high + most < 0) {
        return 0;
    }
    const int is_inside = start + (int64_t)LAST * low + least >= 0;
    if (is_inside) {
        right = down = low = high = least = most = 0;
        memset(edge->step, 0, sizeof edge->step);
    }
    edge->start = is_inside ? 0 : (int32_t)start;
    edge->right = right;
    edge->down = down;
    edge->most = most;
    edge->low = LAST_OF_CELL * low + least;
    edge->high = LAST_OF_CELL * high + most;
    const vi across = vi_set(right), along = vi_set(down);
    for (int k = 0; k < CELL_PIXELS; k += LANES) {
        vi_store(edge->pixels + k,
                 vi_add(vi_mul(across, vi_load(PIXEL_X + k)), vi_mul(along, vi_load(PIXEL_Y + k))));
    }
    const vi cells = vi_add(vi_mul(across, vi_load(CELL_X)), vi_mul(along, vi_load(CELL_Y)));
    vi_store(edge->cells, vi_shl(cells, BURNISH_HIZ_BITS));
    return 1;
}

/* Whether a weight changes so fast that the triangle is narrower than 1/16 pixel. */
BURNISH_INLINE int is_steep(double step1, double step2) {
    return step1 > 16 || step1 < -16 || step2 > 16 || step2 < -16;
}

/* The least and greatest number of the vertices. */
BURNISH_INLINE void bound_number(large_triangle *large, int i, float a, float b, float c) {
    const float low = a < b ? a : b, high = a > b ? a : b;
    large->low[i] = low < c ? low : c;
    large->high[i] = high > c ? high : c;
}

/* The planes of depth and `planes` attributes; the edges are there. */
BURNISH_INLINE void compute_planes(const triangle_setup *setup, size_t lane, int planes,
                                   large_triangle *large) {
    const int64_t dx1 = setup->dx[1][lane], dy1 = setup->dy[1][lane];
    const int64_t dx2 = setup->dx[2][lane], dy2 = setup->dy[2][lane];
    const double inverse_area = 1.0 / (double)(dx2 * setup->dy[0][lane] - dy2 * setup->dx[0][lane]);
    const double weight1 = (double)large->edges[1].value * inverse_area;
    const double weight2 = (double)large->edges[2].value * inverse_area;
    const double right1 = (double)(-dy1 * BURNISH_SUBPIXELS) * inverse_area;
    const double right2 = (double)(-dy2 * BURNISH_SUBPIXELS) * inverse_area;
    const double down1 = (double)(dx1 * BURNISH_SUBPIXELS) * inverse_area;
    const double down2 = (double)(dx2 * BURNISH_SUBPIXELS) * inverse_area;
    large->is_needle = is_steep(right1, right2) || is_steep(down1, down2);
    for (int g = 0; g < (planes + 4) / 4; ++g) {
        double4 value = {0}, first = {0}, second = {0};
        for (int k = g == 0; k < 4 && 4 * g + k <= planes; ++k) {
            const int plane = 4 * g + k - 1;
            value[k] = (double)setup->attributes[0][plane][lane];
            first[k] = (double)setup->attributes[1][plane][lane] - value[k];
            second[k] = (double)setup->attributes[2][plane][lane] - value[k];
            bound_number(large, 4 * g + k, setup->attributes[0][plane][lane],
                         setup->attributes[1][plane][lane], setup->attributes[2][plane][lane]);
        }
        if (g == 0) {
            value[0] = (double)setup->depth[0][lane];
            first[0] = (double)setup->depth[1][lane];
            second[0] = (double)setup->depth[2][lane];
            bound_number(large, 0, setup->depth[0][lane],
                         setup->depth[0][lane] + setup->depth[1][lane],
                         setup->depth[0][lane] + setup->depth[2][lane]);
        }
        large->base[g] = value + (first * weight1 + second * weight2);
        large->across[g] = first * right1 + second * right2;
        large->down[g] = first * down1 + second * down2;
        const float4 across = __builtin_convertvector(large->across[g], float4);
        const float4 down = __builtin_convertvector(large->down[g], float4);
        for (int k = 0; k < 4 && 4 * g + k <= planes; ++k) {
            for (int p = 0; p < CELL_PIXELS; p += LANES) {
                vf_store(large->pixels[4 * g + k] + p,
                         vf_add(vf_mul(vf_set(across[k]), vf_from_int(vi_load(PIXEL_X + p))),
                                vf_mul(vf_set(down[k]), vf_from_int(vi_load(PIXEL_Y + p)))));
            }
        }
    }
}

/* Bounds of depth in a cell, farther and nearer than rounding can make them. */
BURNISH_INLINE void compute_depth_bounds(large_triangle *large, int samples) {
    enum { LAST_OF_CELL = BURNISH_HIZ_PIXELS - 1 };
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    const double base = large->base[0][0], across = large->across[0][0], down = large->down[0][0];
    const double wide = across < 0 ? -across : across, high = down < 0 ? -down : down;
    const double margin = ((base < 0 ? -base : base) + BURNISH_TILE_SIZE * (wide + high)) * 0x1p-20;
    /* samples lie up to half a pixel from a pixel's centre */
    const double middle = 0.5 * LAST_OF_CELL * (across + down);
    const double reach = 0.5 * BURNISH_HIZ_PIXELS * (wide + high) + margin;
    for (int s = 0; s < samples; ++s) {
        large->sample_depth[s] = (float)((across * offsets[s][0] + down * offsets[s][1]) / 16);
    }
    large->depth = (float)base;
    large->depth_right = (float)(across * BURNISH_HIZ_PIXELS);
    large->depth_down = (float)(down * BURNISH_HIZ_PIXELS);
    large->nearest = (float)(middle + reach);
    large->farthest = (float)(middle - reach);
    vf_store(large->cell_depths,
             vf_add(vf_mul(vf_set(large->depth_right), vf_from_int(vi_load(CELL_X))),
                    vf_mul(vf_set(large->depth_down), vf_from_int(vi_load(CELL_Y)))));
}

/* Classifies CELL_ROWS x CELL_COLUMNS cells from (x, y) on. Returns bits of the cells in which the
 * triangle may be visible; *inside receives bits of the cells that it covers entirely. HiZ
 * learns of these unless the triangle becomes a layer. */
BURNISH_INLINE unsigned classify_cells(burnish_tile *tile, const large_triangle *large, int keep,
                                       int x, int y, unsigned *inside) {
    vi outside = vi_set(0), partly = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        const large_edge *edge = &large->edges[i];
        const int32_t first = edge->start + BURNISH_HIZ_PIXELS * (x * edge->right + y * edge->down);
        const vi at = vi_add(vi_set(first), vi_load(edge->cells));
        outside = vi_or(outside, vi_add(at, vi_set(edge->high)));
        partly = vi_or(partly, vi_add(at, vi_set(edge->low)));
    }
    float *cells = tile->hiz.cells + y * BURNISH_HIZ_SIZE + x;
    const float first =
        large->depth + ((float)x * large->depth_right + (float)y * large->depth_down);
    const vf depth = vf_add(vf_set(first), vf_load(large->cell_depths));
    const vf before = vf_load(cells);
    const vm may_show =
        vm_and(vi_not_negative(outside), vf_greater(vf_add(depth, vf_set(large->nearest)), before));
    const vm full = vm_and(may_show, vi_not_negative(partly));
    if (keep != KEEP_LAYER) {
        vf_store(cells,
                 vf_blend(full, vf_max(vf_add(depth, vf_set(large->farthest)), before), before));
    }
    *inside = vm_bits(full);
    return vm_bits(may_show);
}

/* The planes at the tile's pixel (x, y). */
BURNISH_INLINE void start_planes(const large_triangle *large, int planes, int x, int y,
                                 float numbers[NUMBERS]) {
    for (int g = 0; g < (planes + 4) / 4; ++g) {
        const double4 sum =
            (large->base[g] + large->down[g] * (double)y) + large->across[g] * (double)x;
        const float4 rounded = __builtin_convertvector(sum, float4);
        memcpy(numbers + 4 * g, &rounded, sizeof rounded);
    }
}

/* Edges at the centres of LANES pixels of a cell, from pixel k on; `first` has the edges at the
 * cell's first pixel. Returns where the triangle is, or with several samples may be. */
BURNISH_INLINE vm find_edges(const large_triangle *large, const int32_t first[3], int samples,
                             int k, vi at[3]) {
    vi outside = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        at[i] = vi_add(vi_set(first[i]), vi_load(large->edges[i].pixels + k));
        outside =
            vi_or(outside, samples == 1 ? at[i] : vi_add(at[i], vi_set(large->edges[i].most)));
    }
    return vi_not_negative(outside);
}

/* Where a sample of LANES pixels is inside. */
BURNISH_INLINE vm cover_sample(const large_triangle *large, const vi at[3], int s) {
    vi outside = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        outside = vi_or(outside, vi_add(at[i], vi_set(large->edges[i].step[s])));
    }
    return vi_not_negative(outside);
}

/* Clamps a value of a plane to the range of the vertices: planes of needles are steep, and rounding
 * could exceed it. */
BURNISH_INLINE vf clamp_number(const large_triangle *large, int i, vf value) {
    return vf_min(vf_max(value, vf_set(large->low[i])), vf_set(large->high[i]));
}

/* LANES pixels of a cell. */
typedef struct cell_part {
    int is_inside; /* 1: the triangle covers the cell; a constant where it is compiled */
    int k, pixel;  /* the first one: its number in the cell, and in the tile */
    vi at[3];      /* edges at the centres; read unless is_inside */
    vm covered;    /* where the triangle is, or with several samples may be */
} cell_part;

/* Stores what of LANES pixels is nearer; returns the pixels whose samples all are. */
BURNISH_INLINE vm draw_part(const burnish_tile *tile, const large_triangle *large, draw_kind kind,
                            int32_t id, const cell_part *part, vf depth, unsigned *drawn) {
    vm simple = part->covered;
    int sample = burnish_sample_index(kind.samples, part->pixel, 0);
    for (int s = 0; s < kind.samples; ++s, sample += BURNISH_BLOCK_PIXELS) {
        const vf before = vf_load(tile->buffer.depths + sample);
        const vf at_sample =
            kind.samples == 1 ? depth : vf_add(depth, vf_set(large->sample_depth[s]));
        const vf after = clamp_number(large, 0, at_sample);
        vm nearer = vf_greater(after, before);
        if (!part->is_inside) {
            nearer = vm_and(nearer,
                            kind.samples == 1 ? part->covered : cover_sample(large, part->at, s));
        }
        *drawn |= vm_bits(nearer);
        if (kind.keep == KEEP_LAYER) {
            keep_layers(tile, nearer, after, vi_set(id), sample);
            simple = vm_and(simple, vm_not(simple));
            continue;
        }
        vf_store(tile->buffer.depths + sample, vf_blend(nearer, after, before));
        if (kind.keep) {
            vi_store_where(nearer, tile->buffer.ids + sample, vi_set(id));
        }
        simple = vm_and(simple, nearer);
    }
    return simple;
}

/* Draws LANES pixels of a cell; `numbers` are the planes at its first pixel. */
BURNISH_INLINE void draw_cell_part(burnish_tile *tile, const large_triangle *large, draw_kind kind,
                                   int32_t id, const cell_part *part,
                                   const float numbers[NUMBERS]) {
    const int k = part->k, pixel = part->pixel;
    unsigned drawn = 0;
    const vf depth = vf_add(vf_set(numbers[0]), vf_load(large->pixels[0] + k));
    const vm simple = draw_part(tile, large, kind, id, part, depth, &drawn);
    mark_dirty(tile, pixel, drawn != 0);
    if (!vm_any(simple)) {
        return;
    }
    if (kind.samples > 1 && tile->options.needs_position) {
        vf_store_where(simple, tile->buffer.center_depths + pixel, clamp_number(large, 0, depth));
    }
    for (int p = 0; p < kind.planes; ++p) {
        vf value = vf_add(vf_set(numbers[1 + p]), vf_load(large->pixels[1 + p] + k));
        if (large->is_needle) {
            value = clamp_number(large, 1 + p, value);
        }
        vf_store_where(simple, tile->buffer.planes[p] + pixel, value);
    }
}

/* The tile's pixel that is a cell's pixel k; (x, y) is the cell's first. */
BURNISH_INLINE int pixel_of_cell(int x, int y, int k) {
    const int block = k / BURNISH_BLOCK_PIXELS;
    return burnish_pixel_index(x + block % CELL_BLOCKS * BURNISH_BLOCK_SIZE,
                               y + block / CELL_BLOCKS * BURNISH_BLOCK_SIZE) +
           k % BURNISH_BLOCK_PIXELS;
}

/* Draws a cell that the triangle covers, whose first pixel is (x, y). */
BURNISH_INLINE void draw_whole_cell(burnish_tile *tile, const large_triangle *large, draw_kind kind,
                                    int32_t id, int x, int y) {
    cell_part part = {.is_inside = 1, .covered = vi_not_negative(vi_set(0))};
    float numbers[NUMBERS];
    start_planes(large, kind.planes, x, y, numbers);
    for (part.k = 0; part.k < CELL_PIXELS; part.k += LANES) {
        part.pixel = pixel_of_cell(x, y, part.k);
        draw_cell_part(tile, large, kind, id, &part, numbers);
    }
}

/* Draws a cell that the triangle may cover in part. Which pixels it covers is unpredictable, so
 * they are found first, without a branch. */
BURNISH_INLINE void draw_part_of_cell(burnish_tile *tile, const large_triangle *large,
                                      draw_kind kind, int32_t id, int x, int y) {
    int32_t first[3];
    vm covered[CELL_PIXELS / LANES];
    cell_part part = {.is_inside = 0};
    uint64_t hit = 0;
    for (int i = 0; i < 3; ++i) {
        const large_edge *edge = &large->edges[i];
        first[i] = edge->start + x * edge->right + y * edge->down;
    }
    for (int k = 0; k < CELL_PIXELS; k += LANES) {
        covered[k / LANES] = find_edges(large, first, kind.samples, k, part.at);
        hit |= (uint64_t)(vm_any(covered[k / LANES]) != 0) << k / LANES;
    }
    if (!hit) {
        return;
    }
    float numbers[NUMBERS];
    start_planes(large, kind.planes, x, y, numbers);
    for (; hit; hit &= hit - 1) {
        part.k = __builtin_ctzll(hit) * LANES;
        part.pixel = pixel_of_cell(x, y, part.k);
        part.covered = covered[part.k / LANES];
        find_edges(large, first, kind.samples, part.k, part.at);
        draw_cell_part(tile, large, kind, id, &part, numbers);
    }
}

/* Draws a triangle of any size. */
BURNISH_INLINE void draw_large(burnish_tile *tile, const triangle_setup *setup, size_t lane,
                               draw_kind kind, int32_t id) {
    large_triangle large;
    for (int i = 0; i < 3; ++i) {
        if (!compute_large_edge(setup, lane, i, kind.samples, &large.edges[i])) {
            return;
        }
    }
    compute_planes(setup, lane, kind.planes, &large);
    compute_depth_bounds(&large, kind.samples);
    const int x0 = setup->x0[lane] / BURNISH_HIZ_PIXELS, x1 = setup->x1[lane] / BURNISH_HIZ_PIXELS;
    const int y0 = setup->y0[lane] / BURNISH_HIZ_PIXELS, y1 = setup->y1[lane] / BURNISH_HIZ_PIXELS;
    for (int y = y0 & ~(CELL_ROWS - 1); y <= y1; y += CELL_ROWS) {
        for (int x = x0 & ~(CELL_COLUMNS - 1); x <= x1; x += CELL_COLUMNS) {
            unsigned inside;
            unsigned rest = classify_cells(tile, &large, kind.keep, x, y, &inside);
            for (; rest; rest &= rest - 1) {
                const int cell = __builtin_ctz(rest);
                const int column = x + cell % CELL_COLUMNS, row = y + cell / CELL_COLUMNS;
                if (column < x0 || column > x1 || row < y0 || row > y1) {
                    continue;
                }
                const int u = column * BURNISH_HIZ_PIXELS, v = row * BURNISH_HIZ_PIXELS;
                if (inside >> cell & 1) {
                    draw_whole_cell(tile, &large, kind, id, u, v);
                } else {
                    draw_part_of_cell(tile, &large, kind, id, u, v);
                }
            }
        }
    }
}

#endif
