/* Light of near lights from a tile's cells. */
#ifndef BURNISH_RENDER_LIGHT_NEAR_CELLS_SIMD_H
#define BURNISH_RENDER_LIGHT_NEAR_CELLS_SIMD_H

#include "render/light/near_cells.h"
#include "simd/vector_math.h"

/* Points of a tile in a cell: u and v in it. */
BURNISH_INLINE vf near_quadratic(const float c[BURNISH_NEAR_TERMS], vf u, vf v) {
    const vf by_u = vf_add(vf_set(c[1]), vf_add(vf_mul(u, vf_set(c[3])), vf_mul(v, vf_set(c[4]))));
    const vf by_v = vf_add(vf_set(c[2]), vf_mul(v, vf_set(c[5])));
    return vf_add(vf_set(c[0]), vf_add(vf_mul(u, by_u), vf_mul(v, by_v)));
}

BURNISH_INLINE vf near_distance(const float (*c)[BURNISH_NEAR_TERMS], vf u, vf v, const vf p[3]) {
    vf sum = vf_set(0.0f);
    for (int k = 0; k < 3; ++k) {
        const vf d = vf_sub(p[k], near_quadratic(c[k], u, v));
        sum = vf_add(sum, vf_mul(d, d));
    }
    return sum;
}

/* Points in the raster's space. */
typedef struct near_points {
    vf normal[3], position[3], x, y;
} near_points;

BURNISH_INLINE near_points near_load(const burnish_kernels_points *points,
                                     const burnish_screen_points *screen, size_t i) {
    near_points at;
    at.x = vf_add(vf_set(screen->x), vf_load(screen->x_offset + i));
    at.y = vf_add(vf_set(screen->y), vf_load(screen->y_offset + i));
    const vf inverse_w = vf_div(vf_set(1.0f), vf_load(points->w + i));
    vf squared = vf_set(0.0f);
    for (int k = 0; k < 3; ++k) {
        at.normal[k] = vf_load(points->normal[k] + i);
        squared = vf_add(squared, vf_mul(at.normal[k], at.normal[k]));
        at.position[k] = vf_mul(vf_load(points->position[k] + i), inverse_w);
    }
    const vf inverse = vector_inverse_sqrt(squared);
    for (int k = 0; k < 3; ++k) {
        at.normal[k] = vf_mul(at.normal[k], inverse);
    }
    return at;
}

/* The number of each point's cell, or -1. */
BURNISH_INLINE vi near_find(const burnish_near_cells *cells, const near_points *at) {
    const vf zero = vf_set(0.0f), last = vf_set(BURNISH_NEAR_SIDE - 1);
    const vf scale = vf_set(1.0f / BURNISH_NEAR_CELL);
    const vf column = vf_mul(vf_sub(at->x, vf_set(cells->left)), scale);
    const vf row = vf_mul(vf_sub(vf_set(cells->top), at->y), scale);
    const vi x = vi_truncate(vf_min(vf_max(column, zero), last));
    const vi y = vi_truncate(vf_min(vf_max(row, zero), last));
    return vi_gather(cells->cell, vi_add(vi_shl(y, BURNISH_NEAR_SIDE_BITS), x));
}

/* Light where it holds, and which points it is done for. */
typedef struct near_light {
    vf values[BURNISH_NEAR_VALUES];
    vm done[BURNISH_NEAR_CELL_KINDS];
} near_light;

/* Adds a cell's light to the points that it holds for. */
BURNISH_INLINE void near_apply(const burnish_near_cell *cell, const near_points *at, vm here,
                               near_light *light) {
    const vf u = vf_mul(vf_sub(at->x, vf_set(cell->x)), vf_set(cell->scale));
    const vf v = vf_mul(vf_sub(at->y, vf_set(cell->y)), vf_set(cell->scale));
    const vf turned = near_distance(cell->normal, u, v, at->normal);
    const vf moved = near_distance(cell->position, u, v, at->position);
    for (int kind = 0; kind < BURNISH_NEAR_CELL_KINDS; ++kind) {
        const vm is_alike = vm_and(vf_greater(vf_set(cell->normal_limit[kind]), turned),
                                   vf_greater(vf_set(cell->position_limit[kind]), moved));
        const vm holds = vm_and(here, is_alike);
        const int values = cell->has_key ? 4 : 3; /* three colours and the key */
        vf value = vf_set(0.0f);
        for (int k = 0; k < values && vm_any(holds); ++k) {
            const int number = k < 3 ? 3 * kind + k : BURNISH_NEAR_KEY_DIFFUSE + kind;
            if (k == 0 || k == 3 || !cell->is_grey) {
                value = vf_max(near_quadratic(cell->light[number], u, v), vf_set(0.0f));
            }
            light->values[number] = vf_blend(holds, value, light->values[number]);
        }
        light->done[kind] = vm_or(light->done[kind], holds);
    }
}

/* Adds to *left the points from number i on that no cell has lit. */
BURNISH_INLINE void near_leave(const near_light *light, size_t i, size_t count,
                               burnish_near_left *left) {
    const vm diffuse = light->done[BURNISH_NEAR_CELL_DIFFUSE];
    const unsigned lit[2] = {vm_bits(diffuse),
                             vm_bits(light->done[BURNISH_NEAR_CELL_SPECULAR]) | ~vm_bits(diffuse)};
    const vi numbers = vi_add(vi_set((int32_t)i), vi_ramp(1));
    unsigned wanted = i + LANES <= count ? (1u << LANES) - 1 : (1u << (count - i)) - 1;
    if (left->shown) {
        wanted &= vm_bits(vi_not_negative(vi_load(left->shown + i)));
    }
    for (int k = 0; k < 2; ++k) {
        const unsigned lanes = wanted & ~lit[k];
        if (lanes) {
            left->count[k] += vi_compress(lanes, left->number[k] + left->count[k], numbers);
        }
    }
}

static void apply_near_cells(const burnish_near_cells *cells, int material,
                             const burnish_kernels_points *points,
                             const burnish_screen_points *screen, size_t count,
                             float (*light)[BURNISH_NEAR_BATCH], burnish_near_left *left) {
    left->count[0] = left->count[1] = 0;
    for (size_t i = 0; i < count; i += LANES) {
        const near_points at = near_load(points, screen, i);
        const vi number = near_find(cells, &at);
        near_light own;
        int32_t numbers[LANES];
        own.done[0] = own.done[1] = vf_greater(vf_set(0.0f), vf_set(0.0f));
        for (int k = 0; k < BURNISH_NEAR_VALUES; ++k) {
            own.values[k] = vf_set(0.0f);
        }
        vi_store(numbers, number);
        for (unsigned rest = vm_bits(vi_not_negative(number)); rest;) {
            const int32_t first = numbers[__builtin_ctz(rest)];
            const vm here = vi_equal(number, vi_set(first));
            const burnish_near_cell *cell = &cells->cells[first];
            rest &= ~vm_bits(here);
            if (cell->material == material) {
                near_apply(cell, &at, here, &own);
            }
        }
        for (int k = 0; k < BURNISH_NEAR_VALUES; ++k) {
            vf_store(light[k] + i, own.values[k]);
        }
        near_leave(&own, i, count, left);
    }
}

#endif
