/* Looking points up in a depth map. */
#ifndef BURNISH_RENDER_LIGHT_DEPTH_MAP_SIMD_H
#define BURNISH_RENDER_LIGHT_DEPTH_MAP_SIMD_H

#include "render/light/maps/depth_map.h"
#include "simd/vector_math.h"

/* Points in a map: texel coordinates, depth, and how the depth of their surface's plane changes
 * from texel to texel. */
typedef struct map_point {
    vf x, y, depth, slope_x, slope_y;
} map_point;

BURNISH_INLINE vf map_dot(const float row[3], const vf v[3]) {
    const vf sum = vf_add(vf_mul(vf_set(row[0]), v[0]), vf_mul(vf_set(row[1]), v[1]));
    return vf_add(sum, vf_mul(vf_set(row[2]), v[2]));
}

/* cosine: of normal and map's direction, > 0; plane: burnish_map_plane. */
BURNISH_INLINE map_point map_locate(const burnish_map_rows *rows, const vf p[3], const vf normal[3],
                                    vf cosine, float plane) {
    const vf factor = vf_div(vf_set(-plane), cosine);
    map_point point;
    point.x = vf_add(map_dot(rows->column, p), vf_set(rows->column[3]));
    point.y = vf_add(map_dot(rows->row, p), vf_set(rows->row[3]));
    /* above the code of nothing, however far below the map's range */
    point.depth = vf_max(vf_add(map_dot(rows->depth, p), vf_set(rows->depth[3])), vf_set(1.0f));
    point.slope_x = vf_mul(map_dot(rows->column, normal), factor);
    point.slope_y = vf_mul(map_dot(rows->row, normal), factor);
    return point;
}

BURNISH_INLINE vf map_magnitude(vf x) {
    return vf_from_bits(vi_and(vf_bits(x), vi_set(0x7fffffff)));
}

/* A whole number at most half a texel from x - 1/2, inside a map with its neighbour; NaN becomes
 * 0. */
BURNISH_INLINE vf texel_before(vf x, int size) {
    const vf rounder = vf_set(BURNISH_ROUNDER);
    vf at = vf_max(vf_sub(x, vf_set(0.5f)), vf_set(0.0f));
    at = vf_min(at, vf_set((float)(size - 2)));
    return vf_sub(vf_add(at, rounder), rounder);
}

/* Index of the texel (x, y) in a map; exact below 2^22. */
BURNISH_INLINE vi texel_index(vf x, vf y, int size) {
    const vf at = vf_add(vf_add(vf_mul(y, vf_set((float)size)), x), vf_set(BURNISH_ROUNDER));
    return vi_sub(vf_bits(at), vf_bits(vf_set(BURNISH_ROUNDER)));
}

/* How far a texel is above a depth, times factor, in [0, most]. */
BURNISH_INLINE vf texel_over(vi texel, vf depth, vf most, vf factor) {
    const vf over = vf_mul(vf_sub(vf_from_int(texel), depth), factor);
    return vf_min(vf_max(over, vf_set(0.0f)), most);
}

/* The same of two neighbouring texels, mixed. */
BURNISH_INLINE vf pair_over(const uint16_t *depths, vi index, vf depth, vf step, vf u, vf most,
                            vf factor) {
    const vi pair = vi_gather_pair(depths, index);
    const vf left = texel_over(vi_and(pair, vi_set(0xffff)), depth, most, factor);
    const vf right = texel_over(vi_shr(pair, 16), vf_add(depth, step), most, factor);
    return vf_add(left, vf_mul(vf_sub(right, left), u));
}

/* How far the map `shift` codes after `depths` is above the points' planes, bilinear over four
 * texels of min(most, max(0, texel - plane) factor). */
BURNISH_INLINE vf map_over(const uint16_t *depths, vi shift, int size, const map_point *point,
                           vf most, vf factor) {
    const vf x0 = texel_before(point->x, size), y0 = texel_before(point->y, size);
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf u = vf_sub(point->x, x0), v = vf_sub(point->y, y0);
    const vi index = vi_add(texel_index(x0, y0, size), shift);
    const vf depth =
        vf_sub(point->depth, vf_add(vf_mul(u, point->slope_x), vf_mul(v, point->slope_y)));
    const vf inside_u = vf_min(vf_max(u, zero), one), inside_v = vf_min(vf_max(v, zero), one);
    const vf upper = pair_over(depths, index, depth, point->slope_x, inside_u, most, factor);
    const vf lower = pair_over(depths + size, index, vf_add(depth, point->slope_y), point->slope_x,
                               inside_u, most, factor);
    return vf_add(upper, vf_mul(vf_sub(lower, upper), inside_v));
}

#endif
