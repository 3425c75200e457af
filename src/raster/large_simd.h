/* Drawing large triangles cell by cell: cells that an edge or HiZ excludes are left out at once,
 * cells wholly inside need no edges, and depth and attributes are planes, one addition per vector.
 *
 * Planes count from the tile's first pixel in double precision up to a cell's first pixel, and
 * within the cell in single precision:
 *   value(x, y) = (float)((base + down Y) + across X) + ((float)across u + (float)down v),
 * X, Y the cell's first pixel, u, v the pixel in the cell. The error is about 2^-24 of the value
 * and 2^-23 of what the plane changes in seven pixels. */
#ifndef BURNISH_RASTER_LARGE_SIMD_H
#define BURNISH_RASTER_LARGE_SIMD_H

#include "raster/large_setup_simd.h"
#include "raster/samples_simd.h"

enum {
    /* cells that are classified at once */
    CELL_COLUMNS = (int)LANES < (int)BURNISH_HIZ_SIZE ? (int)LANES : (int)BURNISH_HIZ_SIZE,
    CELL_ROWS = (int)LANES / CELL_COLUMNS,
    CELL_BLOCKS = BURNISH_HIZ_PIXELS / BURNISH_BLOCK_SIZE, /* across and down */
    CELL_PIXELS = BURNISH_HIZ_PIXELS * BURNISH_HIZ_PIXELS,
    /* four numbers are one vector: depth and three of the first attribute, then the others */
    NUMBERS = (int)LARGE_NUMBERS,
    CELL_VECTORS = (int)CELL_PIXELS / (int)LANES,
    /* Of a cell with few vectors all are drawn: skipping some would cost more by wrong guesses of
     * branches. */
    SKIPS_VECTORS = CELL_VECTORS > 4,
    CELL_ROW = CELL_BLOCKS * (int)BURNISH_BLOCK_PIXELS, /* pixels of a row of a cell's blocks */
    CELL_NEXT_ROW = (int)BURNISH_BLOCK_ROW_PIXELS - CELL_ROW
};
_Static_assert(CELL_VECTORS <= 64, "bits of a cell's vectors fit 64");

typedef double double4 __attribute__((vector_size(32)));
typedef float float4 __attribute__((vector_size(16)));

/* Columns and rows of a block's pixels, and of cells that are classified at once. */
static const int32_t BLOCK_PIXEL_X[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
static const int32_t BLOCK_PIXEL_Y[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
static const int32_t CELL_X[16] = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
static const int32_t CELL_Y[16] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1};

/* An edge of one triangle, as in large_group. */
typedef struct large_edge {
    int32_t start, right, down, most, low, high;
    int32_t step[BURNISH_MAX_SAMPLES];
    int32_t pixels[CELL_PIXELS]; /* steps from a cell's first pixel to all of them */
    int32_t cells[LANES];        /* from the first of CELL_ROWS x CELL_COLUMNS cells */
} large_edge;

/* A large triangle in a tile. */
typedef struct large_triangle {
    large_edge edges[3];
    double4 base[2], across[2], down[2];     /* the planes of depth and attributes */
    float low[NUMBERS], high[NUMBERS];       /* of the vertices */
    int is_needle;                           /* attributes may leave these bounds by rounding */
    int32_t code;                            /* of the face, instead of attributes */
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

BURNISH_INLINE void load_edge(const large_group *group, size_t lane, int i, int samples,
                              large_edge *edge) {
    edge->start = group->start[i][lane];
    edge->right = group->right[i][lane];
    edge->down = group->down[i][lane];
    edge->most = group->most[i][lane];
    edge->low = group->low[i][lane];
    edge->high = group->high[i][lane];
    for (int s = 0; samples > 1 && s < samples; ++s) {
        edge->step[s] = group->step[i][s][lane];
    }
    step_edge(edge->right, edge->down, edge->pixels);
    const vi cells = vi_add(vi_mul(vi_set(edge->right), vi_load(CELL_X)),
                            vi_mul(vi_set(edge->down), vi_load(CELL_Y)));
    vi_store(edge->cells, vi_shl(cells, BURNISH_HIZ_BITS));
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

/* Four numbers of a lane: of depth and three attributes, or of the others. */
BURNISH_INLINE void load_numbers(const double (*numbers)[LANES], size_t lane, int planes, int g,
                                 double4 *to) {
    double4 four = {0};
    for (int k = 0; k < 4 && 4 * g + k <= planes; ++k) {
        four[k] = numbers[4 * g + k][lane];
    }
    *to = four;
}

/* One triangle of a group. */
BURNISH_INLINE void load_large(const large_group *group, size_t lane, int samples, int planes,
                               large_triangle *large) {
    for (int i = 0; i < 3; ++i) {
        load_edge(group, lane, i, samples, &large->edges[i]);
    }
    large->is_needle = (int)(group->needles >> lane & 1);
    for (int g = 0; g < (planes + 4) / 4; ++g) {
        load_numbers(group->base, lane, planes, g, &large->base[g]);
        load_numbers(group->across, lane, planes, g, &large->across[g]);
        load_numbers(group->below, lane, planes, g, &large->down[g]);
    }
    for (int k = 0; k <= planes; ++k) {
        large->low[k] = group->least[k][lane];
        large->high[k] = group->greatest[k][lane];
        step_plane((float)group->across[k][lane], (float)group->below[k][lane], large->pixels[k]);
    }
    for (int s = 0; samples > 1 && s < samples; ++s) {
        large->sample_depth[s] = group->sample_depth[s][lane];
    }
    large->depth = (float)group->base[0][lane];
    large->depth_right = group->depth_right[lane];
    large->depth_down = group->depth_down[lane];
    large->nearest = group->nearest[lane];
    large->farthest = group->farthest[lane];
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
 * cells that it covers entirely. HiZ learns of these unless the triangle becomes a layer, or may be
 * left out. */
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
    if (keep < KEEP_LAYER && *inside) {
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
    if (planes == 0) {
        numbers[0] = (float)((large->base[0][0] + large->down[0][0] * y) + large->across[0][0] * x);
        return;
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
        nearer = keep_chosen(tile, kind.keep, nearer, sample);
        *drawn |= vm_bits(nearer);
        if (kind.keep == KEEP_LAYER) {
            keep_layers(tile, nearer, after, vi_set(id), sample);
            simple = vm_and(simple, vm_not(simple));
            continue;
        }
        vf_store(tile->buffer.depths + sample, vf_blend(nearer, after, before));
        if (kind.keep > KEEP_DEPTH) {
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
    if (kind.keep == KEEP_CODE) {
        vf_store_where(simple, tile->buffer.planes[0] + pixel, vf_from_bits(vi_set(large->code)));
    }
    vf values[BURNISH_PLANE_COUNT];
    for (int p = 0; p < kind.planes; ++p) {
        values[p] = vf_add(vf_set(numbers[1 + p]), vf_load(large->pixels[1 + p] + k));
    }
    for (int p = 0; large->is_needle && p < kind.planes; ++p) {
        values[p] = clamp_number(large, 1 + p, values[p]);
    }
    for (int p = 0; p < kind.planes; ++p) {
        vf_store_where(simple, tile->buffer.planes[p] + pixel, values[p]);
    }
    return drawn != 0;
}

/* The tile's pixel that is a cell's pixel k: its blocks are neighbours in memory, row by row. */
BURNISH_INLINE int pixel_of_cell(int first, int k) {
    return first + k + k / CELL_ROW * CELL_NEXT_ROW;
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
    for (int row = 0; row < CELL_BLOCKS; ++row) { /* which makes compilers unroll the inner loop */
        for (int i = 0; i < CELL_ROW; i += LANES) {
            part.k = row * CELL_ROW + i;
            part.pixel = first_pixel + row * (int)BURNISH_BLOCK_ROW_PIXELS + i;
            if (!is_inside) {
                part.covered = find_edges(large, first, kind.samples, part.k, part.at);
            }
            const int drawn = draw_cell_part(tile, large, kind, id, &part, numbers);
            blocks |= (unsigned)drawn << part.k / BURNISH_BLOCK_PIXELS;
        }
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

/* The code of a large triangle, if its attributes have one direction; or 0. With the vertices' off by
 * 2^-21 + 2^-23 of the largest number, weighted means of them are too. Planes are off these means by
 * 2^-24 (2 |value| + 4 |what they change in seven pixels|), which is at most 18 2^-24 of the largest
 * number: together less than 2^-18.4. */
BURNISH_INLINE int32_t find_face_code(const burnish_tile *tile, const triangle_setup *setup,
                                      size_t lane) {
    const large_group *group = setup->large;
    float vector[3], size[3], least = 0x1p20f;
    int axis = 0;
    for (int k = 0; k < 3; ++k) {
        vector[k] = setup->attributes[0][k][lane];
        size[k] = __builtin_fabsf(vector[k]);
        axis = size[k] > size[axis] ? k : axis;
    }
    for (int i = 0; i < 3; ++i) {
        const float own = setup->attributes[i][axis][lane], product = own * vector[axis];
        const float length = __builtin_fabsf(own);
        for (int k = 0; k < 3; ++k) {
            const float off = setup->attributes[i][k][lane] * vector[axis] - vector[k] * own;
            if (!(__builtin_fabsf(off) <= product * 0x1p-21f)) {
                return 0;
            }
        }
        least = length < least ? length : least;
        if (!(length > 0x1p-20f && length < 0x1p20f)) {
            return 0;
        }
    }
    for (int k = 0; k < 3; ++k) {
        const double steps =
            __builtin_fabs(group->across[1 + k][lane]) + __builtin_fabs(group->below[1 + k][lane]);
        if (!(7 * steps <= 4 * (double)least)) {
            return 0;
        }
    }
    return group->needles >> lane & 1 ? 0 : tile->find_code(tile->coder, vector);
}

/* Draws a triangle of any size: the cells that it covers, then the ones that its edges cross, since
 * in turns they are unpredictable. */
BURNISH_INLINE void draw_large_kind(burnish_tile *tile, const triangle_setup *setup, size_t lane,
                                    draw_kind kind, int32_t id, int32_t code) {
    large_triangle large;
    load_large(setup->large, lane, kind.samples, kind.planes, &large);
    large.code = code;
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

static __attribute__((noinline)) void draw_coded(burnish_tile *tile, const triangle_setup *setup,
                                                 size_t lane, int32_t code) {
    draw_large_kind(tile, setup, lane, (draw_kind){1, 0, KEEP_CODE}, 0, code);
}

BURNISH_INLINE void draw_large(burnish_tile *tile, const triangle_setup *setup, size_t lane,
                               draw_kind kind, int32_t id) {
    if (kind.samples == 1 && kind.planes == 3 && !kind.keep && tile->options.has_codes) {
        const int32_t code = find_face_code(tile, setup, lane);
        if (code) {
            draw_coded(tile, setup, lane, code);
            return;
        }
    }
    draw_large_kind(tile, setup, lane, kind, id, 0);
}

#endif
