/* Looking points up in the depth maps of ambient occlusion. */
#ifndef BURNISH_RENDER_OCCLUSION_SIMD_H
#define BURNISH_RENDER_OCCLUSION_SIMD_H

#include "render/depth_map_simd.h"
#include "render/occlusion.h"

/* Hidden shares are means of four taps at these places, in radii: a square that is turned, so that
 * no edge of a map's silhouettes meets two of them at once. */
static const float TAPS[4][2] = {
    {0.35f, 0.94f}, {-0.94f, 0.35f}, {-0.35f, -0.94f}, {0.94f, -0.35f}};

BURNISH_INLINE vf map_magnitude(vf x) {
    return vf_from_bits(vi_and(vf_bits(x), vi_set(0x7fffffff)));
}

/* How far above a point the blockers around it reach, in codes: the coarse map's maxima, bilinear,
 * less what the point's own plane rises in a cell. Most have none there, which one look-up says.
 * Lanes that do not face the direction get anything. */
BURNISH_INLINE vf blocker_distance(const burnish_occlusion_lookup *lookup,
                                   const burnish_occlusion_direction *direction,
                                   const map_point *point, vm facing) {
    const int size = lookup->size / BURNISH_OCCLUSION_CELL;
    const vf scale = vf_set(1.0f / BURNISH_OCCLUSION_CELL);
    const vf middle = vf_set(0.5f / BURNISH_OCCLUSION_CELL - 0.5f);
    map_point coarse = *point;
    coarse.x = vf_add(vf_mul(point->x, scale), middle);
    coarse.y = vf_add(vf_mul(point->y, scale), middle);
    coarse.depth = vf_add(
        point->depth, vf_mul(vf_add(map_magnitude(point->slope_x), map_magnitude(point->slope_y)),
                             vf_set(BURNISH_OCCLUSION_CELL)));
    coarse.slope_x = coarse.slope_y = vf_set(0.0f);
    const vi cell = texel_index(texel_before(coarse.x, size), texel_before(coarse.y, size), size);
    const vi greatest =
        vi_and(vi_gather_pair(direction->blockers + size * size, cell), vi_set(0xffff));
    if (!vm_any(vm_and(facing, vf_greater(vf_from_int(greatest), coarse.depth)))) {
        return vf_set(0.0f);
    }
    return map_over(direction->blockers, size, &coarse, vf_set(0x1p17f), vf_set(1.0f));
}

BURNISH_INLINE vf look_up_wide(const burnish_occlusion_lookup *lookup,
                               const burnish_occlusion_direction *direction, const map_point *point,
                               vf radius) {
    const vf one = vf_set(1.0f), factor = vf_set(lookup->slope);
    vf hidden = vf_set(0.0f);
    for (int i = 0; i < 4; ++i) {
        const vf dx = vf_mul(radius, vf_set(TAPS[i][0])), dy = vf_mul(radius, vf_set(TAPS[i][1]));
        const vf rise = vf_add(vf_mul(dx, point->slope_x), vf_mul(dy, point->slope_y));
        map_point tap = *point;
        tap.x = vf_add(point->x, dx);
        tap.y = vf_add(point->y, dy);
        tap.depth = vf_add(point->depth, rise);
        hidden = vf_add(hidden, map_over(direction->depths, lookup->size, &tap, one, factor));
    }
    return vf_mul(hidden, vf_set(0.25f));
}

/* The share of a direction's sky that is hidden from points that face it; others get anything. A
 * direction stands for a cone, whose width where the blockers are is the radius of the filter. */
BURNISH_INLINE vf look_up(const burnish_occlusion_lookup *lookup,
                          const burnish_occlusion_direction *direction, const map_point *point,
                          vm facing) {
    const vf one = vf_set(1.0f), factor = vf_set(lookup->slope);
    const vf least = vf_set(lookup->least_radius), most = vf_set(lookup->most_radius);
    const vf radius =
        vf_mul(blocker_distance(lookup, direction, point, facing), vf_set(lookup->cone));
    const vm wide = vf_greater(radius, least);
    vf hidden = vf_set(0.0f);
    if (vm_any(vm_and(facing, wide))) {
        hidden = look_up_wide(lookup, direction, point, vf_min(radius, most));
    }
    if (vm_any(vm_and_not(facing, wide))) {
        hidden =
            vf_blend(wide, hidden, map_over(direction->depths, lookup->size, point, one, factor));
    }
    return hidden;
}

static void occlude(const burnish_occlusion_lookup *lookup, const float *const position[3],
                    const float *const normal[3], size_t count, float *open) {
    for (size_t i = 0; i < count; i += LANES) {
        vf n[3], p[3], hidden = vf_set(0.0f);
        vf sky = vf_set(0x1p-20f); /* a point without a normal is not occluded */
        for (int k = 0; k < 3; ++k) {
            n[k] = vf_load(normal[k] + i);
            p[k] = vf_add(vf_load(position[k] + i), vf_mul(n[k], vf_set(lookup->offset)));
        }
        for (int d = 0; d < lookup->count; ++d) {
            const burnish_occlusion_direction *direction = &lookup->directions[d];
            const vf cosine = map_dot(direction->toward, n);
            const vm facing = vf_greater(cosine, vf_set(0.0f));
            if (!vm_any(facing)) {
                continue;
            }
            const map_point point =
                map_locate(&direction->map, p, n, vf_max(cosine, vf_set(0.125f)), lookup->plane);
            const vf weight = vf_mul(vf_max(cosine, vf_set(0.0f)), vf_set(direction->weight));
            sky = vf_add(sky, weight);
            hidden = vf_add(hidden, vf_mul(weight, look_up(lookup, direction, &point, facing)));
        }
        const vf lost = vf_mul(vf_set(lookup->strength), vf_div(hidden, sky));
        vf_store(open + i, vf_sub(vf_set(1.0f), lost));
    }
}

#endif
