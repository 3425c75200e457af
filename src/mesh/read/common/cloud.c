#include "mesh/read/common/cloud.h"

#include <stdlib.h>
#include <string.h>

#include "core/vec3.h"
#include "mesh/data/mesh.h"

enum {
    BOX_SAMPLES = 1 << 16,
    OUTLIERS_LEAST = 8,   /* points of which some may be outliers */
    OUTLIER_SHARE = 1000, /* one of so many at either end of an axis */
    STRAY_SHARE = 100,    /* strays are at most one of so many */
    SAMPLES = 1024,       /* points whose neighbours are searched */
    NEIGHBORS = 6,
    CELLS_MOST = 1 << 22, /* of the grid that finds them */
    PER_CELL = 2048       /* points of a cell that are examined: more are at one position */
};
#define DOMINATED 4.0
#define SPARSE 8.0
#define SMALLER 1.15
#define SPLAT_SHARE 50
#define SPLAT_MARGIN 0.15F

/* ---- Boxes ---- */

double burnish_cloud_diagonal(const burnish_box *box) {
    return burnish_vec3_length(
        burnish_vec3_sub(burnish_vec3_loadf(box->high), burnish_vec3_loadf(box->low)));
}

int burnish_compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The box of all points but the most extreme ones of each axis, one in `share` at either end, widened
 * on all sides by `wider` times its longest side. */
static burnish_status trim_box(const burnish_cloud *cloud, size_t share, float wider,
                               burnish_box *box, burnish_memory *memory) {
    const size_t step = cloud->count / BOX_SAMPLES + 1, count = (cloud->count - 1) / step + 1;
    const size_t rest = count / share > 0 ? count / share : 1;
    float *values = burnish_allocate(memory, count, sizeof *values, "a sample of points");
    if (!values) {
        return memory->status;
    }
    for (size_t k = 0; k < 3; ++k) {
        for (size_t i = 0; i < count; ++i) {
            values[i] = cloud->positions[3 * i * step + k];
        }
        qsort(values, count, sizeof *values, burnish_compare_floats);
        box->low[k] = values[rest];
        box->high[k] = values[count - 1 - rest];
    }
    burnish_release(memory->context, values);
    const float margin = wider * (float)burnish_box_longest_side(box);
    for (int k = 0; k < 3; ++k) {
        box->low[k] -= margin;
        box->high[k] += margin;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status find_inner(burnish_cloud *cloud, burnish_memory *memory) {
    burnish_box trimmed, inside;
    burnish_bound_positions(cloud->positions, cloud->count, cloud->inner.low, cloud->inner.high);
    cloud->outside = 0;
    if (cloud->count < OUTLIERS_LEAST) {
        return BURNISH_STATUS_OK;
    }
    const size_t share = cloud->are_splats ? SPLAT_SHARE : OUTLIER_SHARE;
    const float margin = cloud->are_splats ? SPLAT_MARGIN : 0.5F;
    const double dominated = cloud->are_splats ? SMALLER : DOMINATED;
    if (trim_box(cloud, share, margin, &trimmed, memory) != BURNISH_STATUS_OK) {
        return memory->status;
    }
    const double all = burnish_cloud_diagonal(&cloud->inner);
    if (all > dominated * burnish_cloud_diagonal(&trimmed) / 2) { /* at most: the box is wider */
        const size_t count =
            burnish_box_inside(cloud->positions, cloud->count, 1, &trimmed, &inside);
        const double diagonal = count > 0 ? burnish_cloud_diagonal(&inside) : 0;
        if (diagonal > 0 && all > dominated * diagonal) {
            cloud->inner = inside;
            cloud->outside = cloud->count - count;
        }
    }
    return BURNISH_STATUS_OK;
}

/* ---- Density ---- */

/* Points sorted by cell: cell c has order[first[c]] to order[first[c + 1]]. */
typedef struct grid {
    const burnish_cloud *cloud;
    size_t cells[3];
    double scale; /* cells per unit */
    uint32_t *first, *order;
} grid;

static size_t cell_along(const grid *g, size_t axis, double value) {
    const double at = (value - (double)g->cloud->inner.low[axis]) * g->scale;
    const size_t last = g->cells[axis] - 1;
    return at <= 0 ? 0 : at >= (double)last ? last : (size_t)at;
}

static size_t cell_of(const grid *g, const float *p) {
    return (cell_along(g, 2, (double)p[2]) * g->cells[1] + cell_along(g, 1, (double)p[1])) *
               g->cells[0] +
           cell_along(g, 0, (double)p[0]);
}

/* About as many cells as different positions, all cubes of one size. */
static void size_grid(grid *g, size_t count) {
    const burnish_box *box = &g->cloud->inner;
    const double most = count < CELLS_MOST ? (double)count : CELLS_MOST;
    const double longest = burnish_box_longest_side(box);
    double along = 1; /* cells along the longest side: doubled while there are few enough */
    for (;; along *= 2) {
        double cells = 1;
        for (int k = 0; k < 3; ++k) {
            const double n = ((double)box->high[k] - (double)box->low[k]) / longest * 2 * along;
            cells *= n < 1 ? 1 : n + 1;
        }
        if (!(cells <= 2 * most) || along > 1 << 20) {
            break;
        }
    }
    g->scale = along / longest;
    for (int k = 0; k < 3; ++k) {
        g->cells[k] = (size_t)(((double)box->high[k] - (double)box->low[k]) * g->scale) + 1;
    }
}

static burnish_status fill_grid(grid *g, burnish_memory *memory) {
    const size_t cells = g->cells[0] * g->cells[1] * g->cells[2], count = g->cloud->count;
    const float *positions = g->cloud->positions;
    g->first = burnish_allocate_zeroed(memory, cells + 2, sizeof *g->first, "a grid of points");
    g->order = burnish_allocate(memory, count, sizeof *g->order, "a grid of points");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    for (size_t i = 0; i < count; ++i) {
        ++g->first[cell_of(g, positions + 3 * i) + 2];
    }
    for (size_t c = 2; c < cells + 2; ++c) {
        g->first[c] += g->first[c - 1];
    }
    for (size_t i = 0; i < count; ++i) { /* moves each start to its end, which is the next one's */
        g->order[g->first[cell_of(g, positions + 3 * i) + 1]++] = (uint32_t)i;
    }
    return BURNISH_STATUS_OK;
}

static double square_distance(const float *a, const float *b) {
    const burnish_vec3 d = burnish_vec3_sub(burnish_vec3_loadf(a), burnish_vec3_loadf(b));
    return burnish_vec3_dot(d, d);
}

/* Squared distances to the nearest other positions, each counted once, ascending. */
typedef struct nearest {
    int count;
    size_t copies; /* points at the position itself */
    double squares[NEIGHBORS];
    const float *positions[NEIGHBORS];
} nearest;

static void add_neighbor(nearest *found, double square, const float *p) {
    found->copies += square == 0;
    if (square == 0 || (found->count == NEIGHBORS && square >= found->squares[NEIGHBORS - 1])) {
        return;
    }
    for (int i = 0; i < found->count; ++i) {
        if (found->squares[i] == square && memcmp(found->positions[i], p, 3 * sizeof *p) == 0) {
            return;
        }
    }
    int at = found->count < NEIGHBORS ? found->count++ : NEIGHBORS - 1;
    for (; at > 0 && found->squares[at - 1] > square; --at) {
        found->squares[at] = found->squares[at - 1];
        found->positions[at] = found->positions[at - 1];
    }
    found->squares[at] = square;
    found->positions[at] = p;
}

/* The nearest other positions in the 27 cells around a point. */
static nearest find_nearest(const grid *g, const float *p) {
    size_t low[3], high[3];
    nearest found = {0};
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = cell_along(g, k, (double)p[k]);
        low[k] = at > 0 ? at - 1 : 0;
        high[k] = at + 1 < g->cells[k] ? at + 1 : at;
    }
    for (size_t z = low[2]; z <= high[2]; ++z) {
        for (size_t y = low[1]; y <= high[1]; ++y) {
            for (size_t x = low[0]; x <= high[0]; ++x) {
                const size_t cell = (z * g->cells[1] + y) * g->cells[0] + x;
                const size_t end = g->first[cell + 1] - g->first[cell] < PER_CELL
                                       ? g->first[cell + 1]
                                       : g->first[cell] + PER_CELL;
                for (size_t i = g->first[cell]; i < end; ++i) {
                    const float *other = g->cloud->positions + 3 * (size_t)g->order[i];
                    add_neighbor(&found, square_distance(p, other), other);
                }
            }
        }
    }
    return found;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Whether hardly any point is near: SPARSE times farther than is usual. */
static int is_stray(const grid *g, const float *p) {
    const double limit = SPARSE * g->cloud->spacing;
    const nearest near = find_nearest(g, p);
    return near.count < NEIGHBORS || near.squares[NEIGHBORS - 1] > limit * limit;
}

/* Takes strays out of the inner box, if they are few and it becomes clearly smaller. Only points
 * near the ends of an axis are tested. */
static burnish_status drop_strays(burnish_cloud *cloud, const grid *g, burnish_memory *memory) {
    burnish_box core, rest = {.low = {0}};
    size_t strays = 0, kept = 0;
    if (cloud->count < STRAY_SHARE || !(cloud->spacing > 0) ||
        trim_box(cloud, STRAY_SHARE / 2, 0, &core, memory) != BURNISH_STATUS_OK) {
        return memory->status;
    }
    for (size_t i = 0; i < cloud->count && strays * STRAY_SHARE <= cloud->count; ++i) {
        const float *p = cloud->positions + 3 * i;
        if (!burnish_box_holds(&cloud->inner, p) ||
            (!burnish_box_holds(&core, p) && is_stray(g, p))) {
            ++strays;
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            rest.low[k] = kept == 0 || p[k] < rest.low[k] ? p[k] : rest.low[k];
            rest.high[k] = kept == 0 || p[k] > rest.high[k] ? p[k] : rest.high[k];
        }
        ++kept;
    }
    if (strays * STRAY_SHARE <= cloud->count &&
        burnish_cloud_diagonal(&cloud->inner) > SMALLER * burnish_cloud_diagonal(&rest)) {
        cloud->inner = rest;
        cloud->outside = strays;
    }
    return memory->status;
}

/* Measures the cloud by a sample of it. Returns of how many equal points a position consists. */
static size_t measure_sample(burnish_cloud *cloud, const grid *g) {
    const size_t step = cloud->count / SAMPLES + 1;
    double found[SAMPLES], copies[SAMPLES];
    size_t samples = 0, all = 0;
    for (size_t i = 0; i < cloud->count && all < SAMPLES; i += step) {
        const nearest near = find_nearest(g, cloud->positions + 3 * i);
        copies[all++] = (double)near.copies;
        if (near.count > 0) {
            found[samples++] = near.squares[near.count - 1];
        }
    }
    qsort(found, samples, sizeof *found, compare_doubles);
    qsort(copies, all, sizeof *copies, compare_doubles);
    cloud->spacing = samples > 0 ? __builtin_sqrt(found[samples / 2]) : 0;
    cloud->wide = samples > 0 ? __builtin_sqrt(found[samples * 3 / 4]) : 0;
    return (size_t)copies[all / 2];
}

burnish_status burnish_cloud_measure(burnish_cloud *cloud, burnish_memory *memory) {
    grid g = {.cloud = cloud};
    cloud->spacing = cloud->wide = 0;
    cloud->order = NULL;
    if (find_inner(cloud, memory) != BURNISH_STATUS_OK ||
        !(burnish_box_longest_side(&cloud->inner) > 0)) {
        return memory->status;
    }
    size_grid(&g, cloud->count);
    if (fill_grid(&g, memory) == BURNISH_STATUS_OK) {
        const size_t copies = measure_sample(cloud, &g);
        if (copies > 1) {
            burnish_release(memory->context, g.first);
            burnish_release(memory->context, g.order);
            size_grid(&g, cloud->count / copies + 1);
            if (fill_grid(&g, memory) == BURNISH_STATUS_OK) {
                measure_sample(cloud, &g);
            }
        }
    }
    if (memory->status == BURNISH_STATUS_OK) {
        drop_strays(cloud, &g, memory);
    }
    burnish_release(memory->context, g.first);
    cloud->order = g.order;
    return memory->status;
}
