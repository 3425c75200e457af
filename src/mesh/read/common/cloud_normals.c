/* Normals of a point cloud from the cells of a grid: planes through a cell's points and its
 * neighbours', blended at each point. */
#include "mesh/read/common/cloud.h"

#include <string.h>

#include "core/vec3.h"

/* Cells are so many spacings long: the 27 around a point hold about 45 points of a surface. Smaller
 * ones follow for thin objects of few points, larger ones for scans whose noise is as large as their
 * spacing. */
enum { SCALES = 3 };
static const double cell_spacings[SCALES] = {1.7, 1, 6};

enum {
    GRAIN = 1 << 10,
    KEY_BITS = 21,
    KEY_OFFSET = 1 << 20, /* of cell numbers, which can be negative */
    FIRST_SLOTS = 1 << 16,
    PLANE_POINTS = 6 /* that a plane goes through, at least */
};

/* Sums over the points of an occupied cell, which count from its middle in units of its side. */
typedef struct moments {
    float count, first[3], second[6]; /* xx, yy, zz, xy, yz, zx */
} moments;

typedef struct voxel {
    uint64_t key;
    moments sums;
    float normal[3]; /* 0, 0, 0: not like a surface */
} voxel;

/* The numbers of the voxels of 2 x 2 x 2 cells, + 1; 0: not there. Neighbours are in at most eight
 * blocks; larger ones would take too much memory where points are far apart. */
typedef struct block {
    uint64_t key; /* of its first cell */
    uint32_t voxels[8];
} block;

typedef struct voxels {
    const burnish_cloud *cloud;
    double scale; /* cells per unit */
    voxel *items;
    size_t count, capacity;
    block *blocks;
    size_t block_count, block_capacity;
    uint32_t *slots; /* hash table: number of a block + 1; 0: free */
    size_t slot_count;
    float *normals;
} voxels;

/* The cell of a point, and where in the cell it is, in [-0.5, 0.5]; returns 0 if it is too far
 * away. */
static int locate_in_cell(const voxels *v, const float *p, int64_t cell[3], double offset[3]) {
    for (int k = 0; k < 3; ++k) {
        const double at = ((double)p[k] - (double)v->cloud->inner.low[k]) * v->scale;
        if (!(at > -KEY_OFFSET + 2 && at < KEY_OFFSET - 2)) {
            return 0;
        }
        cell[k] = (int64_t)(at + KEY_OFFSET) - KEY_OFFSET; /* rounded down */
        offset[k] = at - (double)cell[k] - 0.5;
    }
    return 1;
}

static uint64_t key_of(int64_t x, int64_t y, int64_t z) {
    return (uint64_t)(x + KEY_OFFSET) << 2 * KEY_BITS | (uint64_t)(y + KEY_OFFSET) << KEY_BITS |
           (uint64_t)(z + KEY_OFFSET);
}

static size_t slot_of(const voxels *v, uint64_t key) {
    const uint64_t mixed = (key ^ key >> 29) * 0x9e3779b97f4a7c15ull;
    size_t slot = (size_t)(mixed >> 20) & (v->slot_count - 1);
    while (v->slots[slot] && v->blocks[v->slots[slot] - 1].key != key) {
        slot = (slot + 1) & (v->slot_count - 1);
    }
    return slot;
}

static uint64_t block_key(const int64_t cell[3]) {
    return key_of(cell[0] & ~1, cell[1] & ~1, cell[2] & ~1);
}

static size_t in_block(const int64_t cell[3]) {
    return (size_t)((cell[0] & 1) | (cell[1] & 1) << 1 | (cell[2] & 1) << 2);
}

/* The blocks around a cell, found as they are needed. */
typedef struct around {
    uint64_t key; /* 0: none yet */
    const block *found;
} around;

static const voxel *find_voxel(const voxels *v, const int64_t cell[3], around last[8]) {
    const uint64_t key = block_key(cell);
    around *at = &last[(cell[0] >> 1 & 1) | (cell[1] & 2) | (cell[2] & 2) << 1];
    if (at->key != key) {
        const uint32_t number = v->slots[slot_of(v, key)];
        *at = (around){key, number ? &v->blocks[number - 1] : NULL};
    }
    const uint32_t number = at->found ? at->found->voxels[in_block(cell)] : 0;
    return number ? &v->items[number - 1] : NULL;
}

/* Keeps half of the table free. */
static burnish_status grow_table(voxels *v, burnish_memory *memory) {
    const size_t count = v->slot_count ? 2 * v->slot_count : FIRST_SLOTS;
    burnish_release(memory->context, v->slots);
    v->slots = burnish_allocate_zeroed(memory, count, sizeof *v->slots, "cells of points");
    v->slot_count = count;
    for (size_t i = 0; i < v->block_count && v->slots; ++i) {
        v->slots[slot_of(v, v->blocks[i].key)] = (uint32_t)i + 1;
    }
    return memory->status;
}

/* Returns NULL if memory is out. */
static block *add_block(voxels *v, uint64_t key, burnish_memory *memory) {
    if (2 * v->block_count >= v->slot_count && grow_table(v, memory) != BURNISH_STATUS_OK) {
        return NULL;
    }
    const size_t slot = slot_of(v, key);
    if (!v->slots[slot]) {
        v->blocks = burnish_reserve(memory, v->blocks, &v->block_capacity, v->block_count + 1,
                                    sizeof *v->blocks, "cells of points");
        if (memory->status != BURNISH_STATUS_OK) {
            return NULL;
        }
        v->blocks[v->block_count++] = (block){.key = key};
        v->slots[slot] = (uint32_t)v->block_count;
    }
    return &v->blocks[v->slots[slot] - 1];
}

/* Returns NULL if memory is out. */
static voxel *add_voxel(voxels *v, const int64_t cell[3], burnish_memory *memory) {
    block *at = add_block(v, block_key(cell), memory);
    if (!at) {
        return NULL;
    }
    uint32_t *number = &at->voxels[in_block(cell)];
    if (*number == 0) {
        v->items = burnish_reserve(memory, v->items, &v->capacity, v->count + 1, sizeof *v->items,
                                   "cells of points");
        if (memory->status != BURNISH_STATUS_OK) {
            return NULL;
        }
        v->items[v->count++] = (voxel){.key = key_of(cell[0], cell[1], cell[2])};
        *number = (uint32_t)v->count;
    }
    return &v->items[*number - 1];
}

/* Points in cell order are anywhere in memory, so what is needed soon is fetched. */
enum { AHEAD = 24 };

static const float *fetch_position(const burnish_cloud *cloud, size_t i) {
    if (i + AHEAD < cloud->count) {
        __builtin_prefetch(cloud->positions + 3 * (size_t)cloud->order[i + AHEAD]);
    }
    return cloud->positions + 3 * (size_t)cloud->order[i];
}

static burnish_status fill_voxels(voxels *v, burnish_tasks *tasks, burnish_memory *memory) {
    for (size_t i = 0; i < v->cloud->count; ++i) {
        int64_t cell[3];
        double d[3];
        if (i % (1 << 20) == 0 && burnish_tasks_check(tasks, memory->error) != BURNISH_STATUS_OK) {
            return BURNISH_STATUS_CANCELLED;
        }
        if (!locate_in_cell(v, fetch_position(v->cloud, i), cell, d)) {
            continue;
        }
        voxel *at = add_voxel(v, cell, memory);
        if (!at) {
            return memory->status;
        }
        at->sums.count += 1;
        for (int k = 0; k < 3; ++k) {
            at->sums.first[k] += (float)d[k];
            at->sums.second[k] += (float)(d[k] * d[k]);
            at->sums.second[3 + k] += (float)(d[k] * d[(k + 1) % 3]);
        }
    }
    return BURNISH_STATUS_OK;
}

/* Adds the moments of a cell whose middle is at o. */
static void add_moments(double sums[10], const moments *m, const double o[3]) {
    const double n = (double)m->count;
    sums[0] += n;
    for (int k = 0; k < 3; ++k) {
        const int j = (k + 1) % 3;
        const double a = (double)m->first[k], b = (double)m->first[j];
        sums[1 + k] += a + n * o[k];
        sums[4 + k] += (double)m->second[k] + 2 * o[k] * a + n * o[k] * o[k];
        sums[7 + k] += (double)m->second[3 + k] + o[k] * b + o[j] * a + n * o[k] * o[j];
    }
}

/* A symmetric matrix: xx, yy, zz, xy, yz, zx. */
typedef struct symmetric {
    double m[6];
} symmetric;

/* The adjugate, divided by the square of the trace; its largest eigenvalue is that of the smallest
 * eigenvalue of a. */
static symmetric adjugate(const symmetric *a, double trace) {
    const double *m = a->m, s = 1 / (trace * trace);
    return (symmetric){{(m[1] * m[2] - m[4] * m[4]) * s, (m[0] * m[2] - m[5] * m[5]) * s,
                        (m[0] * m[1] - m[3] * m[3]) * s, (m[4] * m[5] - m[3] * m[2]) * s,
                        (m[3] * m[5] - m[4] * m[0]) * s, (m[3] * m[4] - m[5] * m[1]) * s}};
}

static symmetric square_of(const symmetric *a) {
    const double *m = a->m, trace = m[0] + m[1] + m[2], s = 1 / (trace * trace);
    return (symmetric){{(m[0] * m[0] + m[3] * m[3] + m[5] * m[5]) * s,
                        (m[3] * m[3] + m[1] * m[1] + m[4] * m[4]) * s,
                        (m[5] * m[5] + m[4] * m[4] + m[2] * m[2]) * s,
                        (m[0] * m[3] + m[3] * m[1] + m[5] * m[4]) * s,
                        (m[3] * m[5] + m[1] * m[4] + m[4] * m[2]) * s,
                        (m[0] * m[5] + m[3] * m[4] + m[5] * m[2]) * s}};
}

static burnish_vec3 multiply_vector(const symmetric *a, burnish_vec3 v) {
    const double *m = a->m;
    return (burnish_vec3){m[0] * v.x + m[3] * v.y + m[5] * v.z,
                          m[3] * v.x + m[1] * v.y + m[4] * v.z,
                          m[5] * v.x + m[4] * v.y + m[2] * v.z};
}

/* The direction of the least variance: squaring the adjugate multiplies its powers. 0, 0, 0 unless
 * the points are flat, and spread in two directions. */
static burnish_vec3 plane_normal(const symmetric *covariance) {
    const burnish_vec3 none = {0, 0, 0};
    const double *c = covariance->m, trace = c[0] + c[1] + c[2];
    if (!(trace > 0)) {
        return none;
    }
    symmetric power = adjugate(covariance, trace);
    const double minors = power.m[0] + power.m[1] + power.m[2]; /* sum of products of eigenvalues */
    if (!(minors > 0.03)) {
        return none;
    }
    for (int i = 0; i < 5; ++i) {
        power = square_of(&power);
    }
    const double *m = power.m;
    const burnish_vec3 columns[3] = {{m[0], m[3], m[5]}, {m[3], m[1], m[4]}, {m[5], m[4], m[2]}};
    const int largest = m[0] >= m[1] && m[0] >= m[2] ? 0 : m[1] >= m[2] ? 1 : 2;
    const burnish_vec3 normal = burnish_vec3_normalize(columns[largest]);
    const double least = burnish_vec3_dot(normal, multiply_vector(covariance, normal));
    return least < 0.06 * trace ? normal : none;
}

static void cell_of_key(uint64_t key, int64_t cell[3]) {
    const uint64_t mask = (1 << KEY_BITS) - 1;
    cell[0] = (int64_t)(key >> 2 * KEY_BITS) - KEY_OFFSET;
    cell[1] = (int64_t)(key >> KEY_BITS & mask) - KEY_OFFSET;
    cell[2] = (int64_t)(key & mask) - KEY_OFFSET;
}

static void fit_voxels(void *context, size_t first, size_t end) {
    const voxels *v = context;
    around last[8] = {{0, NULL}};
    for (size_t i = first; i < end; ++i) {
        int64_t cell[3];
        double s[10] = {0};
        cell_of_key(v->items[i].key, cell);
        for (int n = 0; n < 27; ++n) {
            const int at[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            const int64_t next[3] = {cell[0] + at[0], cell[1] + at[1], cell[2] + at[2]};
            const voxel *near = find_voxel(v, next, last);
            if (near) {
                add_moments(s, &near->sums, (const double[3]){at[0], at[1], at[2]});
            }
        }
        if (s[0] < PLANE_POINTS) {
            continue;
        }
        symmetric c;
        for (int k = 0; k < 3; ++k) {
            const int j = (k + 1) % 3;
            c.m[k] = s[4 + k] / s[0] - s[1 + k] / s[0] * (s[1 + k] / s[0]);
            c.m[3 + k] = s[7 + k] / s[0] - s[1 + k] / s[0] * (s[1 + j] / s[0]);
        }
        const burnish_vec3 normal = plane_normal(&c);
        v->items[i].normal[0] = (float)normal.x;
        v->items[i].normal[1] = (float)normal.y;
        v->items[i].normal[2] = (float)normal.z;
    }
}

/* The normals of the eight cells around a point, turned to the side of its own. */
static burnish_vec3 blend_normals(const voxels *v, const int64_t cell[3], const double d[3],
                                  burnish_vec3 own, around last[8]) {
    burnish_vec3 sum = {0, 0, 0};
    for (int n = 0; n < 8; ++n) {
        int64_t at[3];
        double weight = 1;
        for (int k = 0; k < 3; ++k) {
            const double share = d[k] < 0 ? -d[k] : d[k];
            const int is_next = n >> k & 1;
            at[k] = cell[k] + (is_next ? d[k] < 0 ? -1 : 1 : 0);
            weight *= is_next ? share : 1 - share;
        }
        const voxel *near = find_voxel(v, at, last);
        if (near) {
            const burnish_vec3 normal = burnish_vec3_loadf(near->normal);
            const double side = burnish_vec3_dot(normal, own) < 0 ? -weight : weight;
            sum = burnish_vec3_add(sum, burnish_vec3_scale(normal, side));
        }
    }
    return burnish_vec3_normalize(sum);
}

static void fill_normals(void *context, size_t first, size_t end) {
    const voxels *v = context;
    around last[8] = {{0, NULL}};
    for (size_t at = first; at < end; ++at) {
        const size_t i = v->cloud->order[at];
        int64_t cell[3];
        double d[3];
        burnish_vec3 normal = {0, 0, 0};
        if (at + AHEAD < end) {
            __builtin_prefetch(v->normals + 3 * (size_t)v->cloud->order[at + AHEAD], 1);
        }
        if (locate_in_cell(v, fetch_position(v->cloud, at), cell, d)) {
            normal = burnish_vec3_loadf(find_voxel(v, cell, last)->normal);
            if (burnish_vec3_dot(normal, normal) > 0) {
                normal = blend_normals(v, cell, d, normal, last);
            }
        }
        v->normals[3 * i] = (float)normal.x;
        v->normals[3 * i + 1] = (float)normal.y;
        v->normals[3 * i + 2] = (float)normal.z;
    }
}

/* Points in cells that are not like a surface. */
static size_t count_loose(const voxels *v) {
    double loose = 0;
    for (size_t i = 0; i < v->count; ++i) {
        const float *n = v->items[i].normal;
        loose += n[0] == 0 && n[1] == 0 && n[2] == 0 ? (double)v->items[i].sums.count : 0;
    }
    return (size_t)loose;
}

/* Fits planes at a scale; *are_surface: most points are like one. */
static burnish_status fit_at(voxels *v, double cell, int *are_surface, burnish_tasks *tasks,
                             burnish_memory *memory) {
    v->scale = 1 / cell;
    burnish_status status = fill_voxels(v, tasks, memory);
    if (status == BURNISH_STATUS_OK && v->count > 0) {
        burnish_tasks_ranges(tasks, v->count, GRAIN, fit_voxels, v);
        *are_surface = 2 * count_loose(v) < v->cloud->count;
        if (*are_surface) {
            burnish_tasks_ranges(tasks, v->cloud->count, GRAIN, fill_normals, v);
        }
        status = burnish_tasks_check(tasks, memory->error);
    }
    burnish_release(memory->context, v->items);
    burnish_release(memory->context, v->blocks);
    burnish_release(memory->context, v->slots);
    return status;
}

burnish_status burnish_cloud_normals(const burnish_cloud *cloud, float *normals, int *are_surface,
                                     burnish_tasks *tasks, burnish_memory *memory) {
    burnish_status status = BURNISH_STATUS_OK;
    memset(normals, 0, 3 * cloud->count * sizeof *normals);
    *are_surface = 0;
    for (int i = 0; i < SCALES && !*are_surface && status == BURNISH_STATUS_OK; ++i) {
        voxels v = {.cloud = cloud, .normals = normals};
        status = cloud->spacing > 0
                     ? fit_at(&v, cell_spacings[i] * cloud->spacing, are_surface, tasks, memory)
                     : BURNISH_STATUS_OK;
    }
    return status;
}
