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
    NUMBERS = 2 * 4,
    CELL_VECTORS = (int)CELL_PIXELS / (int)LANES,
    /* Of a cell with few vectors all are drawn: skipping some would cost more by wrong guesses of
     * branches. */
    SKIPS_VECTORS = CELL_VECTORS > 4,
    CELL_NEXT_ROW = (int)BURNISH_BLOCK_ROW_PIXELS - CELL_BLOCKS * (int)BURNISH_BLOCK_PIXELS
};
_Static_assert(CELL_VECTORS <= 64, "bits of a cell's vectors fit 64");

typedef double double4 __attribute__((vector_size(32)));
typedef float float4 __attribute__((vector_size(16)));
typedef int32_t int4 __attribute__((vector_size(16)));

/* Columns and rows of a block's pixels, and of cells that are classified at once. */
static const int32_t BLOCK_PIXEL_X[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const int32_t BLOCK_PIXEL_Y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
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

/* Steps of an edge from a cell's first pixel to all of them. */
BURNISH_INLINE void step_edge(int32_t right, int32_t down, int32_t pixels[CELL_PIXELS]) {
    const vi across = vi_set(right), along = vi_set(down);
    const vi to_right = vi_set(right * BURNISH_BLOCK_SIZE);
    const vi to_below = vi_set(down * BURNISH_BLOCK_SIZE);
    for (int k = 0; k < BURNISH_BLOCK_PIXELS; k += LANES) {
        const vi step = vi_add(vi_mul(across, vi_load(BLOCK_PIXEL_X + k)),
                               vi_mul(along, vi_load(BLOCK_PIXEL_Y + k)));
        const vi below = vi_add(step, to_below);
        vi_store(pixels + k, step);
        vi_store(pixels + k + BURNISH_BLOCK_PIXELS, vi_add(step, to_right));
        vi_store(pixels + k + 2 * BURNISH_BLOCK_PIXELS, below);
        vi_store(pixels + k + 3 * BURNISH_BLOCK_PIXELS, vi_add(below, to_right));
    }
}

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
        const int32_t step = samples == 1 ? 0 : (int32_t)((at >> BURNISH_SUBPIXEL_BITS) - start);
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
        memset(edge->step, 0, (size_t)samples * sizeof *edge->step);
    }
    edge->start = is_inside ? 0 : (int32_t)start;
    edge->right = right;
    edge->down = down;
    edge->most = most;
    edge->low = LAST_OF_CELL * low + least;
    edge->high = LAST_OF_CELL * high + most;
    step_edge(right, down, edge->pixels);
    const vi cells =
        vi_add(vi_mul(vi_set(right), vi_load(CELL_X)), vi_mul(vi_set(down), vi_load(CELL_Y)));
    vi_store(edge->cells, vi_shl(cells, BURNISH_HIZ_BITS));
    return 1;
}

/* Whether a weight changes so fast that the triangle is narrower than 1/16 pixel. */
BURNISH_INLINE int is_steep(double step1, double step2) {
    return step1 > 16 || step1 < -16 || step2 > 16 || step2 < -16;
}

/* Steps of a plane from a cell's first pixel to all of them. */
BURNISH_INLINE void step_plane(float across, float down, float pixels[CELL_PIXELS]) {
    const vf right = vf_set(across), below = vf_set(down);
    const vi size = vi_set(BURNISH_BLOCK_SIZE);
    for (int k = 0; k < BURNISH_BLOCK_PIXELS; k += LANES) {
        const vi x = vi_load(BLOCK_PIXEL_X + k), y = vi_load(BLOCK_PIXEL_Y + k);
        const vf u[2] = {vf_mul(right, vf_from_int(x)),
                         vf_mul(right, vf_from_int(vi_add(x, size)))};
        const vf v[2] = {vf_mul(below, vf_from_int(y)),
                         vf_mul(below, vf_from_int(vi_add(y, size)))};
        for (int block = 0; block < CELL_BLOCKS * CELL_BLOCKS; ++block) {
            vf_store(pixels + block * BURNISH_BLOCK_PIXELS + k,
                     vf_add(u[block % CELL_BLOCKS], v[block / CELL_BLOCKS]));
        }
    }
}

/* Four numbers of vertex i: depth and three of the first attribute, or the others. Depth is that
 * of vertex 0, and what is added to it for vertices 1 and 2. */
BURNISH_INLINE float4 load_numbers(const triangle_setup *setup, size_t lane, int planes, int g,
                                   int i) {
    float4 numbers = {0};
    for (int k = 0; k < 4 && 4 * g + k <= planes; ++k) {
        numbers[k] =
            4 * g + k == 0 ? setup->depth[i][lane] : setup->attributes[i][4 * g + k - 1][lane];
    }
    return numbers;
}

/* a where the mask holds, b elsewhere. */
BURNISH_INLINE float4 pick4(int4 mask, float4 a, float4 b) {
    return (float4)(((int4)a & mask) | ((int4)b & ~mask));
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
        float4 corner[3];
        for (int i = 0; i < 3; ++i) {
            corner[i] = load_numbers(setup, lane, planes, g, i);
        }
        const double4 value = __builtin_convertvector(corner[0], double4);
        double4 base = value, first = __builtin_convertvector(corner[1], double4);
        double4 second = __builtin_convertvector(corner[2], double4);
        if (g == 0) { /* depth is a difference already */
            base[0] = 0;
            corner[1][0] += corner[0][0];
            corner[2][0] += corner[0][0];
        }
        first -= base;
        second -= base;
        float4 low = pick4(corner[0] < corner[1], corner[0], corner[1]);
        float4 high = pick4(corner[0] > corner[1], corner[0], corner[1]);
        low = pick4(low < corner[2], low, corner[2]);
        high = pick4(high > corner[2], high, corner[2]);
        memcpy(large->low + 4 * g, &low, sizeof low);
        memcpy(large->high + 4 * g, &high, sizeof high);
        large->base[g] = value + (first * weight1 + second * weight2);
        large->across[g] = first * right1 + second * right2;
        large->down[g] = first * down1 + second * down2;
        const float4 across = __builtin_convertvector(large->across[g], float4);
        const float4 down = __builtin_convertvector(large->down[g], float4);
        for (int k = 0; k < 4 && 4 * g + k <= planes; ++k) {
            step_plane(across[k], down[k], large->pixels[4 * g + k]);
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

/* Edges over cells that are classified at once. */
typedef struct edge_cells {
    vi high, to_low, down; /* the greatest value; from there to the least; to the next rows */
} edge_cells;

/* The edges over the cells from (x, y) on. */
BURNISH_INLINE void start_edges(const large_triangle *large, int x, int y, edge_cells edges[3]) {
    for (int i = 0; i < 3; ++i) {
        const large_edge *edge = &large->edges[i];
        const int32_t first = edge->start + BURNISH_HIZ_PIXELS * (x * edge->right + y * edge->down);
        edges[i].high = vi_add(vi_set(first + edge->high), vi_load(edge->cells));
        edges[i].to_low = vi_set(edge->low - edge->high);
        edges[i].down = vi_set(BURNISH_HIZ_PIXELS * CELL_ROWS * edge->down);
    }
}

/* Classifies CELL_ROWS x CELL_COLUMNS cells from (x, y) on, and moves the edges to the next rows.
 * Returns bits of the cells in which the triangle may be visible; *inside receives bits of the
 * cells that it covers entirely. HiZ learns of these unless the triangle becomes a layer. */
BURNISH_INLINE unsigned classify_cells(burnish_tile *tile, const large_triangle *large, int keep,
                                       int x, int y, edge_cells edges[3], unsigned *inside) {
    vi outside = vi_set(0), partly = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        outside = vi_or(outside, edges[i].high);
        partly = vi_or(partly, vi_add(edges[i].high, edges[i].to_low));
        edges[i].high = vi_add(edges[i].high, edges[i].down);
    }
    float *cells = tile->hiz.cells + y * BURNISH_HIZ_SIZE + x;
    const float first =
        large->depth + ((float)x * large->depth_right + (float)y * large->depth_down);
    const vf depth = vf_add(vf_set(first), vf_load(large->cell_depths));
    const vf before = vf_load(cells);
    const vm may_show =
        vm_and(vi_not_negative(outside), vf_greater(vf_add(depth, vf_set(large->nearest)), before));
    const vm full = vm_and(may_show, vi_not_negative(partly));
    *inside = vm_bits(full);
    if (keep != KEEP_LAYER && *inside) {
        vf_store(cells,
                 vf_blend(full, vf_max(vf_add(depth, vf_set(large->farthest)), before), before));
    }
    return vm_bits(may_show);
}

/* The edges and planes at the tile's pixel (x, y), a cell's first. */
BURNISH_INLINE void start_cell(const large_triangle *large, int planes, int x, int y, vi first[3],
                               float numbers[NUMBERS]) {
    for (int i = 0; i < 3; ++i) {
        const large_edge *edge = &large->edges[i];
        first[i] = vi_set(edge->start + x * edge->right + y * edge->down);
    }
    for (int g = 0; g < (planes + 4) / 4; ++g) {
        const double4 sum =
            (large->base[g] + large->down[g] * (double)y) + large->across[g] * (double)x;
        const float4 rounded = __builtin_convertvector(sum, float4);
        memcpy(numbers + 4 * g, &rounded, sizeof rounded);
    }
}

/* Edges at the centres of LANES pixels of a cell, from pixel k on; `first` has the edges at the
 * cell's first pixel. Returns where the triangle is, or with several samples may be. */
BURNISH_INLINE vm find_edges(const large_triangle *large, const vi first[3], int samples, int k,
                             vi at[3]) {
    vi outside = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        at[i] = vi_add(first[i], vi_load(large->edges[i].pixels + k));
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
    vi at[3];      /* edges at the centres; read with several samples unless is_inside */
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
        simple = kind.samples == 1 ? nearer : vm_and(simple, nearer);
    }
    return simple;
}

/* Draws LANES pixels of a cell; `numbers` are the planes at its first pixel. Returns whether a
 * sample was nearer. */
BURNISH_INLINE int draw_cell_part(burnish_tile *tile, const large_triangle *large, draw_kind kind,
                                  int32_t id, const cell_part *part, const float numbers[NUMBERS]) {
    const int k = part->k, pixel = part->pixel;
    unsigned drawn = 0;
    const vf depth = vf_add(vf_set(numbers[0]), vf_load(large->pixels[0] + k));
    const vm simple = draw_part(tile, large, kind, id, part, depth, &drawn);
    if ((SKIPS_VECTORS || kind.samples > 1) && !vm_any(simple)) {
        return drawn != 0;
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
    return drawn != 0;
}

/* The tile's pixel that is a cell's pixel k: its blocks are neighbours in memory, row by row. */
BURNISH_INLINE int pixel_of_cell(int first, int k) {
    return first + k + k / (CELL_BLOCKS * BURNISH_BLOCK_PIXELS) * CELL_NEXT_ROW;
}

/* Marks the blocks of a cell, bits of their numbers, as written. */
BURNISH_INLINE void mark_cell(burnish_tile *tile, int x, int y, unsigned blocks) {
    uint16_t *dirty = tile->buffer.dirty_blocks + y / BURNISH_BLOCK_SIZE;
    for (int row = 0; row < CELL_BLOCKS; ++row) {
        const unsigned columns = blocks >> row * CELL_BLOCKS & ((1u << CELL_BLOCKS) - 1);
        dirty[row] |= (uint16_t)(columns << x / BURNISH_BLOCK_SIZE);
    }
}

/* Draws all vectors of a cell whose first pixel is (x, y). */
BURNISH_INLINE void draw_whole_cell(burnish_tile *tile, const large_triangle *large, draw_kind kind,
                                    int32_t id, int x, int y, int is_inside) {
    const int first_pixel = burnish_pixel_index(x, y);
    vi first[3];
    cell_part part;
    float numbers[NUMBERS];
    unsigned blocks = 0;
    start_cell(large, kind.planes, x, y, first, numbers);
    part.is_inside = is_inside;
    part.covered = vi_not_negative(vi_set(0));
    for (int k = 0; k < CELL_PIXELS; k += LANES) {
        part.k = k;
        part.pixel = pixel_of_cell(first_pixel, k);
        if (!is_inside) {
            part.covered = find_edges(large, first, kind.samples, k, part.at);
        }
        const int drawn = draw_cell_part(tile, large, kind, id, &part, numbers);
        blocks |= (unsigned)drawn << k / BURNISH_BLOCK_PIXELS;
    }
    mark_cell(tile, x, y, blocks);
}

/* Draws a cell that the triangle may cover in part. Which pixels it covers is unpredictable, so
 * they are found first, without a branch. */
BURNISH_INLINE void draw_part_of_cell(burnish_tile *tile, const large_triangle *large,
                                      draw_kind kind, int32_t id, int x, int y) {
    const int first_pixel = burnish_pixel_index(x, y);
    vi first[3];
    vm covered[CELL_VECTORS];
    cell_part part;
    float numbers[NUMBERS];
    uint64_t hit = 0; /* bits of pixels */
    unsigned blocks = 0;
    start_cell(large, kind.planes, x, y, first, numbers);
    part.is_inside = 0;
    for (int v = 0; v < CELL_VECTORS; ++v) {
        covered[v] = find_edges(large, first, kind.samples, v * LANES, part.at);
        hit |= (uint64_t)vm_bits(covered[v]) << v * LANES;
    }
    while (hit) {
        const int v = __builtin_ctzll(hit) / (int)LANES;
        hit &= ~((uint64_t)ALL_LANES << v * LANES);
        part.k = v * LANES;
        part.pixel = pixel_of_cell(first_pixel, part.k);
        part.covered = covered[v];
        if (kind.samples > 1) {
            find_edges(large, first, kind.samples, part.k, part.at);
        }
        const int drawn = draw_cell_part(tile, large, kind, id, &part, numbers);
        blocks |= (unsigned)drawn << part.k / BURNISH_BLOCK_PIXELS;
    }
    mark_cell(tile, x, y, blocks);
}

/* Bits of HiZ's cells, row after row, that a triangle's bounds touch. */
BURNISH_INLINE uint64_t cells_of_bounds(int x0, int y0, int x1, int y1) {
    enum { LAST = BURNISH_HIZ_SIZE - 1 };
    const uint64_t columns = (2ull << x1) - (1ull << x0);
    const uint64_t rows =
        (~0ull << BURNISH_HIZ_SIZE * y0) & (~0ull >> BURNISH_HIZ_SIZE * (LAST - y1));
    return columns * 0x0101010101010101ull & rows;
}
_Static_assert((int)BURNISH_HIZ_SIZE == 8, "a row of cells is a byte");

/* Draws some cells of a tile. */
BURNISH_INLINE void draw_cells(burnish_tile *tile, const large_triangle *large, draw_kind kind,
                               int32_t id, uint64_t cells, int are_inside) {
    for (; cells; cells &= cells - 1) {
        const int cell = __builtin_ctzll(cells);
        const int x = cell % BURNISH_HIZ_SIZE * BURNISH_HIZ_PIXELS;
        const int y = cell / BURNISH_HIZ_SIZE * BURNISH_HIZ_PIXELS;
        if (are_inside || (!SKIPS_VECTORS && kind.samples == 1)) {
            draw_whole_cell(tile, large, kind, id, x, y, are_inside);
        } else {
            draw_part_of_cell(tile, large, kind, id, x, y);
        }
    }
}

/* Draws a triangle of any size: the cells that it covers, then the ones that its edges cross, since
 * in turns they are unpredictable. */
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
    const int first_row = y0 & ~(CELL_ROWS - 1);
    uint64_t visible = 0, inside = 0;
    for (int x = x0 & ~(CELL_COLUMNS - 1); x <= x1; x += CELL_COLUMNS) {
        edge_cells edges[3];
        start_edges(&large, x, first_row, edges);
        for (int y = first_row; y <= y1; y += CELL_ROWS) {
            unsigned full;
            const uint64_t seen = classify_cells(tile, &large, kind.keep, x, y, edges, &full);
            visible |= seen << (y * BURNISH_HIZ_SIZE + x);
            inside |= (uint64_t)full << (y * BURNISH_HIZ_SIZE + x);
        }
    }
    visible &= cells_of_bounds(x0, y0, x1, y1);
    draw_cells(tile, &large, kind, id, visible & inside, 1);
    draw_cells(tile, &large, kind, id, visible & ~inside, 0);
}

#endif
