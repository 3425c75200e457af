/* Rays through the tree, one per lane. A lane meets the boxes and triangles that its own ray hits,
 * whatever its neighbours do, and a hit is a hit in any order: so results do not depend on LANES. The
 * nearest is found in one order for all. */
#ifndef BURNISH_RAYS_RAYS_SIMD_H
#define BURNISH_RAYS_RAYS_SIMD_H

#include "rays/ray_axes_simd.h"
#include "rays/rays.h"

/* Boxes are left this much later than rounding says: three roundings of 2^-24 for each side. */
#define BOX_SLACK (1.0f + 0x1p-21f)

/* Components of directions are at least this large, so that their inverses are finite. */
#define LEAST_COMPONENT 0x1p-60f

typedef struct ray_lanes {
    vf origin[3], inverse[3], axis[3][3], reach; /* axis[2]: the direction; the others across */
    int turn[3]; /* along each axis 0: all go up; 1: all go down; -1: neither */
} ray_lanes;

BURNISH_INLINE ray_lanes load_rays(const burnish_ray_batch *rays, size_t i) {
    const vf zero = vf_set(0.0f), least = vf_set(LEAST_COMPONENT);
    ray_lanes ray;
    for (int k = 0; k < 3; ++k) {
        const vf d = vf_load(rays->direction[k] + i);
        const vm is_negative = vf_greater(zero, d);
        const vf size = vf_max(vf_blend(is_negative, vf_sub(zero, d), d), least);
        ray.origin[k] = vf_load(rays->origin[k] + i);
        ray.axis[2][k] = d;
        ray.inverse[k] = vf_div(vf_blend(is_negative, vf_set(-1.0f), vf_set(1.0f)), size);
        ray.turn[k] = !vm_any(is_negative) ? 0 : vm_any(vm_not(is_negative)) ? -1 : 1;
    }
    find_across(ray.axis[2], ray.axis[0], ray.axis[1]);
    ray.reach = vf_load(rays->reach + i);
    return ray;
}

BURNISH_INLINE vm hits_box(const ray_lanes *ray, const float low[3], const float high[3],
                           vf *entry) {
    vf enter = vf_set(0.0f), leave = ray->reach;
    for (int k = 0; k < 3; ++k) {
        const vf a = vf_mul(vf_sub(vf_set(low[k]), ray->origin[k]), ray->inverse[k]);
        const vf b = vf_mul(vf_sub(vf_set(high[k]), ray->origin[k]), ray->inverse[k]);
        if (ray->turn[k] == 0) {
            enter = vf_max(a, enter);
            leave = vf_min(b, leave);
        } else if (ray->turn[k] > 0) {
            enter = vf_max(b, enter);
            leave = vf_min(a, leave);
        } else {
            enter = vf_max(vf_min(a, b), enter);
            leave = vf_min(vf_max(a, b), leave);
        }
    }
    *entry = enter;
    return vm_not(vf_greater(enter, vf_mul(leave, vf_set(BOX_SLACK))));
}

/* Which side of the ray an edge passes, seen along it. Rounding is monotonic, so the sign is right or
 * the result 0, and with the corners exchanged it is the opposite. */
BURNISH_INLINE vf edge_side(const vf from[3], const vf to[3]) {
    return vf_sub(vf_mul(from[0], to[1]), vf_mul(from[1], to[0]));
}

/* A triangle is hit where no two of its edges pass on different sides: 0 is on both. So no ray passes
 * between triangles, whose common corners are where they are for both (Woop et al., Watertight
 * Ray/Triangle Intersection, 2013). One that is seen from its edge, or has no area, is not hit.
 *   at  how far away it is hit; NULL: not wanted */
BURNISH_INLINE vm hits_triangle(const ray_lanes *ray, const float corners[9], vf *at) {
    const vf zero = vf_set(0.0f);
    vf p[3][3]; /* corners in the axes of the ray */
    for (int c = 0; c < 3; ++c) {
        vf from[3];
        for (int k = 0; k < 3; ++k) {
            from[k] = vf_sub(vf_set(corners[3 * c + k]), ray->origin[k]);
        }
        p[c][0] = ray_dot(ray->axis[0], from);
        p[c][1] = ray_dot(ray->axis[1], from);
        p[c][2] = ray_dot(ray->axis[2], from);
    }
    const vf a = edge_side(p[1], p[2]), b = edge_side(p[2], p[0]), c = edge_side(p[0], p[1]);
    const vf least = vf_min(vf_min(a, b), c), most = vf_max(vf_max(a, b), c);
    const vm inside = vm_not(vm_and(vf_greater(zero, least), vf_greater(most, zero)));
    if (!vm_any(inside)) {
        return inside;
    }
    const vf area = vf_add(vf_add(a, b), c);
    const vf depth = vf_add(vf_add(vf_mul(a, p[0][2]), vf_mul(b, p[1][2])), vf_mul(c, p[2][2]));
    const vm is_turned = vf_greater(zero, area);
    const vf size = vf_blend(is_turned, vf_sub(zero, area), area);
    const vf distance = vf_blend(is_turned, vf_sub(zero, depth), depth);
    if (at) {
        *at = vf_div(distance, vf_max(size, vf_set(0x1p-126f)));
    }
    return vm_and(vm_and(inside, vf_greater(distance, zero)),
                  vf_greater(vf_mul(ray->reach, size), distance));
}

/* A part of the tree, and the lanes that have hit its box, and where. */
typedef struct waiting_part {
    uint32_t child, count;
    vm lanes;
    vf entry;
} waiting_part;

/* Which lanes hit something.
 *   nearest  NULL: anything; otherwise the reach becomes the distance of what is nearest */
BURNISH_INLINE vm find_lanes(const burnish_ray_tree *tree, ray_lanes *ray, vm lanes, vi *nearest) {
    waiting_part stack[BURNISH_RAY_DEPTH + 2];
    const vm all = lanes;
    vm alive = lanes; /* that have hit nothing yet */
    int depth = 1;
    stack[0] = (waiting_part){0, 0, lanes, vf_set(0.0f)};
    while (depth > 0) {
        const waiting_part part = stack[--depth];
        const vf leave = vf_mul(ray->reach, vf_set(BOX_SLACK));
        const vm present = nearest ? vm_and_not(part.lanes, vf_greater(part.entry, leave))
                                   : vm_and(part.lanes, alive);
        if (!vm_any(present)) {
            continue;
        }
        if (part.count > 0) {
            for (uint32_t i = 0; i < part.count; ++i) {
                const float *corners = tree->triangles[part.child + i];
                vf at = ray->reach;
                const vm hit = vm_and(present, hits_triangle(ray, corners, nearest ? &at : NULL));
                alive = vm_and_not(alive, hit);
                if (nearest) {
                    ray->reach = vf_blend(hit, at, ray->reach);
                    *nearest = vi_blend(hit, vi_set((int32_t)(part.child + i)), *nearest);
                }
            }
            if (!nearest && !vm_any(alive)) {
                break;
            }
            continue;
        }
        const burnish_ray_node *node = &tree->nodes[part.child];
        for (int i = 1; i >= 0; --i) {
            vf entry;
            const vm met = vm_and(present, hits_box(ray, node->low[i], node->high[i], &entry));
            if (vm_any(met)) {
                stack[depth++] = (waiting_part){node->child[i], node->count[i], met, entry};
            }
        }
    }
    return vm_and_not(all, alive);
}

static void find_hits(const burnish_ray_tree *tree, const burnish_ray_batch *rays, float *hits,
                      float *distances, int32_t *places) {
    for (size_t i = 0; i < rays->count; i += LANES) {
        vm hit = vf_greater(vf_set(0.0f), vf_set(1.0f));
        if (tree->triangle_count > 0) {
            ray_lanes ray = load_rays(rays, i);
            const vm is_cast = vf_greater(ray.reach, vf_set(0.0f));
            vi nearest = vi_set(0);
            if (distances) {
                hit = find_lanes(tree, &ray, is_cast, &nearest);
                vf_store(distances + i, ray.reach);
                vi_store(places + i, nearest);
            } else {
                hit = find_lanes(tree, &ray, is_cast, NULL);
            }
        }
        vf_store(hits + i, vf_and_mask(hit, vf_set(1.0f)));
    }
}

#endif
