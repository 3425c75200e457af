/* A map is the sum of a dome, an environment and polygons. The light of both through each lobe is computed
 * in a smaller map, because it costs the most time. */
#include "environment/map_fill.h"

#include <stddef.h>
#include <string.h>

/* The diffuse map is off by 3 % of the peak at the terminator of a tiny light and 0.3 % for softboxes;
 * spherical harmonics of order 2 are off by 9 %, of order 4 by 6 %. */
enum { LARGEST_SIZE = BURNISH_LIGHT_MAP_LARGEST, LEAST_SIZE = 24, DIFFUSE_SIZE = 32 };

/* Texels per side of a map, and of a lobe's own map, if the lobe's radius is 1. */
#define MAP_TEXELS 12.0f
#define LOBE_TEXELS 6.0f

/* Rows and columns around the texels of a map, and of a lobe's own map, where each is needed. */
enum { BORDER = 1, WIDE_BORDER = 3 };

/* Rows and columns of a cell, of a lobe's map too: a group of neighbours. */
enum { BITS = BURNISH_LIGHT_CELL_BITS, SIDE = 1 << BITS };
_Static_assert(SIDE == 4 && SIDE * SIDE == BURNISH_MAP_GROUP, "a row of a cell is a vector");

/* The most cells at once: cells of a map are made ready by four, and four read at most 12 x 12 texels of
 * a lobe's map. */
enum { CELLS_MAX = 16 };

/* Red, green, blue and 0; maps are aligned. */
typedef float texel __attribute__((vector_size(16), may_alias));

/* Numbers of four columns. */
typedef float quad __attribute__((vector_size(16), aligned(4), may_alias));
typedef int int_quad __attribute__((vector_size(16), aligned(4), may_alias));

/* Catmull and Rom's cubic through four texels, its weights four times each. */
typedef struct cubic {
    texel weights[4];
    int first;
} cubic;

/* A map, or light through one lobe. */
typedef struct grid {
    int size, border, stride; /* texels per side, around them, and per row */
    int across;               /* cells per row of cells */
    texel *texels;
    atomic_uint *states;
    float *coordinates; /* p of the columns, q of the rows of a half; up to a multiple of 4 */
    cubic *cubics;      /* of a lobe: for the rows and the columns of the map that it is added to */
    burnish_map_light light,
        direct; /* direct: of a map, through lobes without a map of their own */
} grid;

struct burnish_map_cells {
    grid map, lobes[BURNISH_LIGHT_LOBES_MAX];
    int lobe_count;
};

/* ---- Directions ---- */

/* The columns of a row of a half that look-ups need, [*first, *last]: within a texel's diagonal of the disc
 * that a half of the sphere is mapped to. size: of the map, which has a border. */
static void find_columns(int size, int row, int *first, int *last) {
    const float half = (float)size / 2, middle = (float)(size + 1) / 2;
    const float limit = 1 + 3 / (float)size, q = ((float)row - middle) / half;
    const float room = limit * limit - q * q;
    const int reach = room > 0 ? (int)(__builtin_sqrtf(room) * half + 0.5f) : 0;
    *last = size / 2 + reach < size + 1 ? size / 2 + reach : size + 1;
    *first = size + 1 - *last;
}

/* Rows and columns [top, bottom) and [left, right) of a cell. */
typedef struct area {
    int top, bottom, left, right;
} area;

static area area_of(const grid *s, int cell) {
    const int top = cell / s->across * SIDE, left = cell % s->across * SIDE;
    const int bottom = top + SIDE < 2 * s->stride ? top + SIDE : 2 * s->stride;
    const int right = left + SIDE < s->stride ? left + SIDE : s->stride;
    return (area){top, bottom, left, right};
}

/* Adds the needed texels of a cell, and their directions, to the first `count`; the others become 0.
 * Returns the new count. */
static int add_texels(const grid *s, int cell, int count, int *numbers, float *const w[3]) {
    const area a = area_of(s, cell);
    for (int row = a.top; row < a.bottom; ++row) {
        const int from = row * s->stride, in_half = row < s->stride ? row : row - s->stride;
        const float q = s->coordinates[in_half], side = row < s->stride ? 1 : -1;
        const quad p = *(const quad *)(s->coordinates + a.left), squared = p * p + q * q;
        const quad scale = 1 / (1 + squared);
        const quad v[3] = {2 * p * scale, 2 * q * scale, side * ((1 - squared) * scale)};
        int first = a.left, last = a.right - 1;
        if (s->border == BORDER) {
            find_columns(s->size, in_half, &first, &last);
        }
        if (first <= a.left && last >= a.left + SIDE - 1) {
            for (int k = 0; k < 3; ++k) {
                *(quad *)(w[k] + count) = v[k];
            }
            *(int_quad *)(numbers + count) = from + a.left + (int_quad){0, 1, 2, 3};
            count += SIDE;
            continue;
        }
        for (int column = a.left; column < a.right; ++column) {
            if (column < first || column > last) {
                s->texels[from + column] = (texel){0, 0, 0, 0};
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                w[k][count] = v[k][column - a.left];
            }
            numbers[count++] = from + column;
        }
    }
    return count;
}

/* ---- Cells ---- */

/* Computes the grid's own light in some cells. */
static void light_cells(grid *s, const int *cells, int cell_count) {
    float vectors[3][BURNISH_MAP_POINTS], colors[3][BURNISH_MAP_POINTS];
    float *const to[3] = {vectors[0], vectors[1], vectors[2]};
    const float *const w[3] = {vectors[0], vectors[1], vectors[2]};
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    int numbers[BURNISH_MAP_POINTS], count = 0;
    for (int i = 0; i < cell_count; ++i) {
        count = add_texels(s, cells[i], count, numbers, to);
    }
    for (int c = 0; c < 3; ++c) {
        memset(rgb[c], 0, (size_t)count * sizeof *rgb[c]);
    }
    burnish_map_light_add(&s->light, w, count, rgb);
    if (s->direct.lobes.count > 0) {
        burnish_map_light_add(&s->direct, w, count, rgb);
    }
    for (int i = 0; i < count; ++i) {
        s->texels[numbers[i]] = (texel){rgb[0][i], rgb[1][i], rgb[2][i], 0};
    }
}

/* Takes the cells of a grid that have some rows and columns, the last ones included, and are empty.
 * Returns how many. */
static int take_cells(grid *s, area a, int *cells) {
    int count = 0;
    for (int y = a.top >> BITS; y <= a.bottom >> BITS; ++y) {
        for (int x = a.left >> BITS; x <= a.right >> BITS; ++x) {
            const int cell = y * s->across + x;
            unsigned empty = BURNISH_LIGHT_EMPTY;
            if (atomic_load_explicit(&s->states[cell], memory_order_relaxed) == empty &&
                atomic_compare_exchange_strong(&s->states[cell], &empty, BURNISH_LIGHT_BUSY)) {
                cells[count++] = cell;
            }
        }
    }
    return count;
}

/* Marks cells that were taken, and waits for those that other threads have taken: they wait for
 * nothing, or only for such cells of a lobe. */
static void finish_cells(grid *s, area a, const int *cells, int count) {
    for (int i = 0; i < count; ++i) {
        atomic_store_explicit(&s->states[cells[i]], BURNISH_LIGHT_FILLED, memory_order_release);
    }
    for (int y = a.top >> BITS; y <= a.bottom >> BITS; ++y) {
        for (int x = a.left >> BITS; x <= a.right >> BITS; ++x) {
            const int cell = y * s->across + x;
            while (atomic_load_explicit(&s->states[cell], memory_order_acquire) <
                   BURNISH_LIGHT_FILLED) {
            }
        }
    }
}

/* ---- Lobes ---- */

static cubic find_cubic(int at, int size, int smaller) {
    const float middle = (float)(size + 1) / 2, scale = (float)smaller / (float)size;
    const float x = ((float)at - middle) * scale + (float)(smaller - 1) / 2 + WIDE_BORDER;
    const int before = (int)x; /* x is at least 2 */
    const float f = x - (float)before, f2 = f * f, f3 = f2 * f;
    const float weights[4] = {f2 - 0.5f * (f + f3), 1 - 2.5f * f2 + 1.5f * f3,
                              0.5f * f + 2 * f2 - 1.5f * f3, 0.5f * (f3 - f2)};
    cubic c = {.first = before - 1};
    for (int i = 0; i < 4; ++i) {
        c.weights[i] = (texel){weights[i], weights[i], weights[i], weights[i]};
    }
    return c;
}

/* Fills the texels of a lobe that rows and columns of a half of the map read; the last ones are included. */
static void need_lobe(const grid *map, grid *lobe, area a) {
    const int half = a.top >= map->stride, above = half * lobe->stride;
    int cells[CELLS_MAX];
    const area needed = {above + lobe->cubics[a.top - half * map->stride].first,
                         above + lobe->cubics[a.bottom - half * map->stride].first + 3,
                         lobe->cubics[a.left].first, lobe->cubics[a.right].first + 3};
    const int count = take_cells(lobe, needed, cells);
    if (count > 0) {
        light_cells(lobe, cells, count);
    }
    finish_cells(lobe, needed, cells, count);
}

/* Adds a lobe to rows and columns of a half of the map; the last ones are included. */
static void add_lobe(grid *map, const grid *lobe, area a) {
    const int half = a.top >= map->stride, less = lobe->stride;
    const int left = lobe->cubics[a.left].first, right = lobe->cubics[a.right].first + 3;
    texel line[LARGEST_SIZE + 2 * WIDE_BORDER];
    for (int row = a.top; row <= a.bottom; ++row) {
        const cubic *c = &lobe->cubics[row - half * map->stride];
        const texel *rows = lobe->texels + (ptrdiff_t)less * (half * less + c->first);
        texel *to = map->texels + (ptrdiff_t)row * map->stride;
        int first, last;
        find_columns(map->size, row - half * map->stride, &first, &last);
        first = first > a.left ? first : a.left;
        last = last < a.right ? last : a.right;
        for (int i = left; i <= right; ++i) {
            line[i] = rows[i] * c->weights[0] + rows[i + less] * c->weights[1] +
                      rows[i + 2 * less] * c->weights[2] + rows[i + 3 * less] * c->weights[3];
        }
        for (int i = first; i <= last; ++i) {
            const texel *t = line + lobe->cubics[i].first;
            const texel *w = lobe->cubics[i].weights;
            to[i] += t[0] * w[0] + t[1] * w[1] + t[2] * w[2] + t[3] * w[3];
        }
    }
}

/* ---- Maps ---- */

/* The rows and columns of cells that were taken, if they are a rectangle; else of the first one, and *count
 * becomes 1. */
static area join_cells(const grid *s, const int *cells, int *count) {
    area all = area_of(s, cells[0]);
    for (int i = 1; i < *count; ++i) {
        const area a = area_of(s, cells[i]);
        all.left = a.left < all.left ? a.left : all.left;
        all.right = a.right > all.right ? a.right : all.right;
        all.bottom = a.bottom;
    }
    const int wide = (all.right - all.left - 1) >> BITS, high = (all.bottom - all.top - 1) >> BITS;
    if ((wide + 1) * (high + 1) == *count) {
        return all;
    }
    *count = 1;
    return area_of(s, cells[0]);
}

/* Fills at most four neighbouring cells of the map. */
static void fill_cells(burnish_map_cells *cells, const int *taken, int count) {
    grid *map = &cells->map;
    light_cells(map, taken, count);
    for (int done = 0, some = count; cells->lobe_count > 0 && done < count; done += some) {
        some = count - done;
        const area a = join_cells(map, taken + done, &some);
        for (int top = a.top, end; top < a.bottom; top = end) {
            end = top < map->stride && a.bottom > map->stride ? map->stride
                                                              : a.bottom; /* of a half */
            const area part = {top, end - 1, a.left, a.right - 1};
            for (int j = 0; j < cells->lobe_count; ++j) {
                need_lobe(map, &cells->lobes[j], part);
                add_lobe(map, &cells->lobes[j], part);
            }
        }
    }
}

static void make_ready(void *context, int number) {
    burnish_map_cells *cells = context;
    grid *map = &cells->map;
    area a = area_of(map, number);
    int taken[CELLS_MAX];
    a.bottom -= a.bottom == 2 * map->stride;
    a.right -= a.right == map->stride;
    const int count = take_cells(map, a, taken);
    if (count > 0) {
        fill_cells(cells, taken, count);
    }
    finish_cells(map, a, taken, count);
    atomic_store_explicit(&map->states[number], BURNISH_LIGHT_READY, memory_order_release);
}

/* Texels per side: a texel of a map has at most a third of the radius of a lobe. Then a bilinear
 * look-up across the edge of a light is at most 0.7 % of its radiance off. Above the usual size, half of
 * the radius must do. Maps of lobes have fewer texels, because they are read by cubics. */
static int size_for(const burnish_map_filler *filler, const burnish_light_lobe *lobe,
                    float texels) {
    const int fine = (int)(texels / burnish_map_lobe_radius(lobe) + 1) / 2 * 2,
              coarse = fine / 3 * 2;
    const int size = coarse > BURNISH_LIGHT_MAP_USUAL ? coarse
                     : fine < BURNISH_LIGHT_MAP_USUAL ? fine
                                                      : BURNISH_LIGHT_MAP_USUAL;
    const int least = texels < MAP_TEXELS ? LEAST_SIZE / 3 : LEAST_SIZE;
    const int most = filler->sources.largest;
    return size < least ? least : size > most ? most : size;
}

static void allocate_grid(grid *s, burnish_memory *memory) {
    const size_t rows = (size_t)s->size + 2 * (size_t)s->border, across = (rows + SIDE - 1) / SIDE;
    s->stride = (int)rows;
    s->across = (int)across;
    s->texels = burnish_allocate(memory, 2 * rows * rows, sizeof *s->texels, "a map of light");
    s->states = burnish_allocate_zeroed(memory, across * ((2 * rows + SIDE - 1) / SIDE),
                                        sizeof *s->states, "a map of light");
    s->coordinates =
        burnish_allocate(memory, SIDE * across, sizeof *s->coordinates, "a map of light");
    for (int i = 0; s->coordinates && i < SIDE * s->across; ++i) {
        const float half = (float)s->size / 2, middle = (float)(s->stride - 1) / 2;
        s->coordinates[i] = ((float)i - middle) / half;
    }
}

static void make_cubics(const grid *map, grid *lobe, burnish_memory *memory) {
    lobe->cubics =
        burnish_allocate(memory, (size_t)map->stride, sizeof *lobe->cubics, "a map of light");
    for (int i = 0; i < map->stride && lobe->cubics; ++i) {
        lobe->cubics[i] = find_cubic(i, map->size, lobe->size);
    }
}

static void prepare_lobe(const grid *map, grid *lobe, const burnish_light_lobe *own, int size,
                         burnish_memory *memory) {
    lobe->light.lobes = (burnish_light_lobes){1, {*own}};
    lobe->light.filler = map->light.filler;
    lobe->light.has_environment = 1;
    lobe->size = size;
    lobe->border = WIDE_BORDER;
    burnish_map_light_add_polygons(&lobe->light);
    allocate_grid(lobe, memory);
    make_cubics(map, lobe, memory);
}

/* The map, and a grid for each lobe that needs fewer texels, if more than a dome shines. */
static void prepare_grids(burnish_map_cells *cells, const burnish_map_filler *filler, float alpha,
                          burnish_memory *memory) {
    grid *map = &cells->map;
    map->size = alpha > 0 ? LEAST_SIZE : DIFFUSE_SIZE;
    map->border = BORDER;
    map->light.filler = filler;
    map->light.has_dome = 1;
    map->light.has_environment = alpha <= 0;
    map->light.lobes = alpha > 0 ? burnish_light_lobes_for(alpha) : (burnish_light_lobes){0};
    for (int j = 0; j < map->light.lobes.count; ++j) {
        const int own = size_for(filler, &map->light.lobes.lobe[j], MAP_TEXELS);
        map->size = own > map->size ? own : map->size;
    }
    allocate_grid(map, memory);
    if (alpha <= 0) {
        burnish_map_light_add_polygons(&map->light);
        return;
    }
    const int count = map->light.lobes.count;
    const int has_lights = filler->sources.distant_count > 0 || filler->sources.environment;
    for (int j = 0; has_lights && j < count && memory->status == BURNISH_STATUS_OK; ++j) {
        const burnish_light_lobe *own = &map->light.lobes.lobe[j];
        const int size = size_for(filler, own, LOBE_TEXELS);
        if (size < map->size) {
            prepare_lobe(map, &cells->lobes[cells->lobe_count++], own, size, memory);
        } else {
            map->direct.lobes.lobe[map->direct.lobes.count++] = *own;
        }
    }
    map->direct.filler = filler;
    map->direct.has_environment = 1;
    burnish_map_light_add_polygons(&map->direct);
}

burnish_status burnish_map_cells_create(const burnish_map_filler *filler, float alpha,
                                        burnish_memory *memory, burnish_map_cells **cells) {
    *cells = burnish_allocate_zeroed(memory, 1, sizeof **cells, "a map of light");
    if (*cells) {
        prepare_grids(*cells, filler, alpha, memory);
    }
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_map_cells_destroy(*cells, memory->context);
        *cells = NULL;
    }
    return memory->status;
}

static void release_grid(grid *s, const burnish_context *context) {
    burnish_release(context, s->texels);
    burnish_release(context, s->states);
    burnish_release(context, s->coordinates);
    burnish_release(context, s->cubics);
}

void burnish_map_cells_destroy(burnish_map_cells *cells, const burnish_context *context) {
    if (cells) {
        release_grid(&cells->map, context);
        for (int j = 0; j < cells->lobe_count; ++j) {
            release_grid(&cells->lobes[j], context);
        }
        burnish_release(context, cells);
    }
}

burnish_light_map burnish_map_cells_map(burnish_map_cells *cells) {
    return (burnish_light_map){.size = cells->map.size,
                               .texels = (const float *)cells->map.texels,
                               .states = cells->map.states,
                               .fill = make_ready,
                               .cells = cells};
}
