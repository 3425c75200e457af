/* Setup of large triangles with SIMD: edges over the tile, and planes, one triangle per lane.
 *
 * Coverage is exact. From one pixel's centre to the next, or from sample s of a pixel to sample s
 * of the next, an edge function changes by multiples of 256. So floor(E / 256) has the sign of E,
 * and its steps are whole numbers. An edge that crosses the tile stays below 63 (2^23 + 2^23) +
 * 2^23 < 2^30 all over it, for images of 16384 pixels and a guard band of 16000. E itself is below
 * 2^53: exact in double precision. */
#ifndef BURNISH_RASTER_LARGE_SETUP_SIMD_H
#define BURNISH_RASTER_LARGE_SETUP_SIMD_H

#include "raster/setup_simd.h"

enum { LARGE_NUMBERS = 1 + BURNISH_PLANE_COUNT }; /* depth and attributes */

/* Numbers of triangles that are not large are not used. */
typedef struct large_group {
    double value[3][LANES]; /* E at the centre of the tile's first pixel */
    /* floor((E + bias) / 256) there, its steps per pixel, and from a pixel's centre to its samples,
     * the greatest of these, and the least and greatest step from a cell's first pixel centre. All
     * are 0 for an edge that has the whole tile inside. */
    int32_t start[3][LANES], right[3][LANES], down[3][LANES];
    int32_t step[3][BURNISH_MAX_SAMPLES][LANES];
    int32_t most[3][LANES], low[3][LANES], high[3][LANES];
    /* weights of vertices 1 and 2 at the centre of the tile's first pixel; their steps per pixel */
    double weight[2][LANES], weight_right[2][LANES], weight_down[2][LANES];
    unsigned needles; /* narrower than 1/16 pixel: attributes may leave the range of the vertices */
    /* planes: at the centre of the tile's first pixel; steps per pixel */
    double base[LARGE_NUMBERS][LANES], across[LARGE_NUMBERS][LANES], below[LARGE_NUMBERS][LANES];
    float least[LARGE_NUMBERS][LANES], greatest[LARGE_NUMBERS][LANES]; /* of the vertices */
    /* steps of depth per cell, and from a cell's first pixel to bounds in the cell, which rounding
     * can't reach */
    float depth_right[LANES], depth_down[LANES], nearest[LANES], farthest[LANES];
    float sample_depth[BURNISH_MAX_SAMPLES][LANES]; /* from a pixel's centre to its samples */
} large_group;

/* Edge i. Returns lanes where the whole tile is outside. */
BURNISH_INLINE unsigned compute_large_edge(const triangle_setup *setup, int samples, int i,
                                           large_group *group) {
    enum { LAST = BURNISH_TILE_SIZE - 1, LAST_OF_CELL = BURNISH_HIZ_PIXELS - 1 };
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    const int a = i == 2 ? 0 : i + 1;
    for (int lane = 0; lane < LANES; ++lane) {
        const double limit = 0x1p30; /* beyond it whole tiles are outside, or inside */
        const double dx = setup->dx[i][lane], dy = setup->dy[i][lane];
        const double value =
            dx * (HALF_PIXEL - setup->y[a][lane]) - dy * (HALF_PIXEL - setup->x[a][lane]);
        const int32_t rest = setup->start[i][lane] & (BURNISH_SUBPIXELS - 1); /* at any centre */
        double start = (value + setup->bias[i][lane] - rest) * (1.0 / BURNISH_SUBPIXELS);
        start = start > limit ? limit : start;
        start = start < -limit ? -limit : start;
        group->value[i][lane] = value;
        group->start[i][lane] = (int32_t)start;
    }
    const vi zero = vi_set(0), dx = vi_load(setup->dx[i]), dy = vi_load(setup->dy[i]);
    const vi rest = vi_and(vi_load(setup->start[i]), vi_set(BURNISH_SUBPIXELS - 1));
    const vi start = vi_load(group->start[i]), right = vi_sub(zero, dy);
    const vi low = vi_add(vi_min(right, zero), vi_min(dx, zero));
    const vi high = vi_add(vi_max(right, zero), vi_max(dx, zero));
    vi least = zero, most = zero, step[BURNISH_MAX_SAMPLES];
    step[0] = zero;
    for (int s = 0; samples > 1 && s < samples; ++s) {
        const vi move =
            vi_add(vi_mul(dx, vi_set(offsets[s][1])), vi_mul(right, vi_set(offsets[s][0])));
        step[s] = vi_sar(vi_add(vi_sar(rest, BURNISH_SAMPLE_STEP_BITS), move),
                         BURNISH_SUBPIXEL_BITS - BURNISH_SAMPLE_STEP_BITS);
        least = s == 0 ? step[s] : vi_min(step[s], least);
        most = s == 0 ? step[s] : vi_max(step[s], most);
    }
    const vi end = vi_add(start, vi_add(vi_mul(high, vi_set(LAST)), most));
    const vi begin = vi_add(start, vi_add(vi_mul(low, vi_set(LAST)), least));
    const vm crosses = vm_not(vi_not_negative(begin));
    for (int s = 0; s < samples; ++s) {
        vi_store(group->step[i][s], vi_blend(crosses, step[s], zero));
    }
    const vi to_low = vi_add(vi_mul(low, vi_set(LAST_OF_CELL)), least);
    const vi to_high = vi_add(vi_mul(high, vi_set(LAST_OF_CELL)), most);
    vi_store(group->start[i], vi_blend(crosses, start, zero));
    vi_store(group->right[i], vi_blend(crosses, right, zero));
    vi_store(group->down[i], vi_blend(crosses, dx, zero));
    vi_store(group->most[i], vi_blend(crosses, most, zero));
    vi_store(group->low[i], vi_blend(crosses, to_low, zero));
    vi_store(group->high[i], vi_blend(crosses, to_high, zero));
    return vm_bits(vm_not(vi_not_negative(end)));
}

/* Barycentric weights; the edges are there. */
BURNISH_INLINE void compute_large_weights(const triangle_setup *setup, large_group *group) {
    float excess[LANES];
    for (int lane = 0; lane < LANES; ++lane) {
        const double dx1 = setup->dx[1][lane], dy1 = setup->dy[1][lane];
        const double dx2 = setup->dx[2][lane], dy2 = setup->dy[2][lane];
        const double inverse_area = 1.0 / (dx2 * setup->dy[0][lane] - dy2 * setup->dx[0][lane]);
        const double right1 = dy1 * -BURNISH_SUBPIXELS * inverse_area;
        const double right2 = dy2 * -BURNISH_SUBPIXELS * inverse_area;
        const double down1 = dx1 * BURNISH_SUBPIXELS * inverse_area;
        const double down2 = dx2 * BURNISH_SUBPIXELS * inverse_area;
        group->weight[0][lane] = group->value[1][lane] * inverse_area;
        group->weight[1][lane] = group->value[2][lane] * inverse_area;
        group->weight_right[0][lane] = right1;
        group->weight_right[1][lane] = right2;
        group->weight_down[0][lane] = down1;
        group->weight_down[1][lane] = down2;
        double steepest = right1 > -right1 ? right1 : -right1;
        steepest = right2 > steepest ? right2 : steepest;
        steepest = -right2 > steepest ? -right2 : steepest;
        steepest = down1 > steepest ? down1 : steepest;
        steepest = -down1 > steepest ? -down1 : steepest;
        steepest = down2 > steepest ? down2 : steepest;
        steepest = -down2 > steepest ? -down2 : steepest;
        excess[lane] = (float)(steepest - 16);
    }
    group->needles = vm_bits(vf_greater(vf_load(excess), vf_set(0.0f)));
}

/* The plane of depth, 0, or of attribute k - 1. Depth is that of vertex 0, and what is added to it
 * for vertices 1 and 2. */
BURNISH_INLINE void compute_plane(const triangle_setup *setup, int k, large_group *group) {
    const float *from[3];
    vf corner[3];
    for (int i = 0; i < 3; ++i) {
        from[i] = k == 0 ? setup->depth[i] : setup->attributes[i][k - 1];
        corner[i] = vf_load(from[i]);
    }
    if (k == 0) {
        corner[1] = vf_add(corner[1], corner[0]);
        corner[2] = vf_add(corner[2], corner[0]);
    }
    vf_store(group->least[k], vf_min(vf_min(corner[0], corner[1]), corner[2]));
    vf_store(group->greatest[k], vf_max(vf_max(corner[0], corner[1]), corner[2]));
    for (int lane = 0; lane < LANES; ++lane) {
        const double value = from[0][lane], base = k == 0 ? 0 : value;
        const double first = from[1][lane] - base, second = from[2][lane] - base;
        group->base[k][lane] =
            value + (first * group->weight[0][lane] + second * group->weight[1][lane]);
        group->across[k][lane] =
            first * group->weight_right[0][lane] + second * group->weight_right[1][lane];
        group->below[k][lane] =
            first * group->weight_down[0][lane] + second * group->weight_down[1][lane];
    }
}

/* Bounds of depth in a cell, farther and nearer than rounding can make them. */
BURNISH_INLINE void compute_depth_bounds(int samples, large_group *group) {
    enum { LAST_OF_CELL = BURNISH_HIZ_PIXELS - 1 };
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    for (int lane = 0; lane < LANES; ++lane) {
        const double base = group->base[0][lane];
        const double across = group->across[0][lane], down = group->below[0][lane];
        const double wide = across < 0 ? -across : across, high = down < 0 ? -down : down;
        const double margin =
            ((base < 0 ? -base : base) + BURNISH_TILE_SIZE * (wide + high)) * 0x1p-20;
        /* samples lie up to half a pixel from a pixel's centre */
        const double middle = 0.5 * LAST_OF_CELL * (across + down);
        const double reach = 0.5 * BURNISH_HIZ_PIXELS * (wide + high) + margin;
        group->depth_right[lane] = (float)(across * BURNISH_HIZ_PIXELS);
        group->depth_down[lane] = (float)(down * BURNISH_HIZ_PIXELS);
        group->nearest[lane] = (float)(middle + reach);
        group->farthest[lane] = (float)(middle - reach);
    }
    for (int s = 0; samples > 1 && s < samples; ++s) {
        for (int lane = 0; lane < LANES; ++lane) {
            group->sample_depth[s][lane] = (float)((group->across[0][lane] * offsets[s][0] +
                                                    group->below[0][lane] * offsets[s][1]) /
                                                   16);
        }
    }
}

/* Needles of `lanes` that cover no pixel's centre in the tile. A needle's longest edge reaches from
 * its first pixel to its last along one axis, u. So at each u its pixels begin at that edge: it has
 * one there if the first pixel v inside that edge is inside the others. From one u to the next,
 * this pixel moves by at most one, in the direction that v counts in. */
BURNISH_INLINE unsigned find_empty(const triangle_setup *setup, const large_group *group,
                                   unsigned lanes) {
    enum { LONGEST = 1 << 20 }; /* whose edges fit 32 bits a tile's size around it */
    const vi zero = vi_set(0), longest = vi_load(setup->longest);
    vi e[3], across[3], along[3]; /* of the long edge, then of the others; per step of u, of v */
    vm is_found = vi_greater(zero, zero), is_upright = is_found;
    for (int i = 0; i < 3; ++i) {
        is_upright = vm_or(is_upright, vi_equal(vi_magnitude(vi_load(setup->dy[i])), longest));
    }
    const vi x0 = vi_load(setup->x0), y0 = vi_load(setup->y0);
    vi count = vi_blend(is_upright, vi_sub(vi_load(setup->y1), y0), vi_sub(vi_load(setup->x1), x0));
    const vi first = vi_blend(is_upright, y0, x0);
    for (int i = 0; i < 3; ++i) {
        const vi right = vi_load(group->right[i]), down = vi_load(group->down[i]);
        e[i] = vi_load(group->start[i]);
        across[i] = vi_blend(is_upright, down, right);
        along[i] = vi_blend(is_upright, right, down);
        const vm is_long = vm_and_not(vi_equal(vi_magnitude(along[i]), longest), is_found);
        is_found = vm_or(is_found, is_long);
        if (i > 0) { /* exchange it with the first one */
            vi *const numbers[3] = {e, across, along};
            for (int k = 0; k < 3; ++k) {
                const vi own = numbers[k][i];
                numbers[k][i] = vi_blend(is_long, numbers[k][0], own);
                numbers[k][0] = vi_blend(is_long, own, numbers[k][0]);
            }
        }
    }
    lanes &= vm_bits(is_found) & ~vm_bits(vi_greater(longest, vi_set(LONGEST)));
    /* begin where the edge falls with u, and count v to where it rises */
    const vm falls = vi_greater(across[0], zero), turns = vi_greater(zero, along[0]);
    const vi u = vi_blend(falls, vi_add(first, count), first);
    for (int i = 0; i < 3; ++i) {
        e[i] = vi_add(e[i], vi_mul(across[i], u));
        across[i] = vi_blend(falls, vi_sub(zero, across[i]), across[i]);
        along[i] = vi_blend(turns, vi_sub(zero, along[i]), along[i]);
    }
    const vf quotient = vf_div(vf_from_int(vi_sub(zero, e[0])), vf_from_int(along[0]));
    const vi v =
        vi_sub(vi_truncate(vf_min(vf_max(quotient, vf_set(-256.0f)), vf_set(256.0f))), vi_set(1));
    for (int i = 0; i < 3; ++i) {
        e[i] = vi_add(e[i], vi_mul(along[i], v));
    }
    for (int turn = 0; turn < 3; ++turn) {
        const vi is_outside = vi_sar(e[0], 31);
        for (int i = 0; i < 3; ++i) {
            e[i] = vi_add(e[i], vi_and(along[i], is_outside));
        }
    }
    vi misses = vi_set(-1);
    int32_t counts[LANES], steps = 0;
    vi_store(counts, count);
    for (unsigned rest = lanes; rest; rest &= rest - 1) {
        const int32_t own = counts[__builtin_ctz(rest)];
        steps = own > steps ? own : steps;
    }
    for (int32_t step = 0; lanes && step <= steps; ++step) {
        misses = vi_and(misses, vi_or(vi_or(e[0], e[1]), e[2]));
        e[0] = vi_add(e[0], across[0]);
        const vi is_outside = vi_sar(e[0], 31);
        e[0] = vi_add(e[0], vi_and(along[0], is_outside));
        for (int i = 1; i < 3; ++i) {
            e[i] = vi_add(vi_add(e[i], across[i]), vi_and(along[i], is_outside));
        }
    }
    return lanes & ~vm_bits(vi_not_negative(misses));
}

/* Prepares the large triangles of a group. Those that cover nothing in the tile are not live any
 * more. */
static void prepare_large(int samples, int planes, triangle_setup *setup, large_group *group) {
    const unsigned large = setup->live & ~setup->small;
    unsigned empty = 0;
    for (int i = 0; i < 3; ++i) {
        empty |= compute_large_edge(setup, samples, i, group) & large;
    }
    compute_large_weights(setup, group);
    if (samples == 1 && (large & group->needles & ~empty)) {
        empty |= find_empty(setup, group, large & group->needles & ~empty);
    }
    setup->live &= ~empty;
    setup->large = group;
    if (empty == large) {
        return;
    }
    for (int k = 0; k <= planes; ++k) {
        compute_plane(setup, k, group);
    }
    compute_depth_bounds(samples, group);
}

#endif
