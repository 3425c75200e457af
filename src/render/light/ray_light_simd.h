/* The rays of points: where they go, and what light they stand for. */
#ifndef BURNISH_RENDER_LIGHT_RAY_LIGHT_SIMD_H
#define BURNISH_RENDER_LIGHT_RAY_LIGHT_SIMD_H

#include "rays/ray_axes_simd.h"
#include "render/light/maps/depth_map_simd.h"
#include "render/light/ray_light.h"

/* Longer than the mesh is wide, from anywhere near it. */
#define RAY_REACH 64.0f

/* Half the side of a square as large as a disc. */
#define ROUND_EDGE 0.8862269f

/* Half the width of what a surface mirrors, for alpha 1 one unit away. */
#define SPREAD 2.6f

/* A table's light from a direction, bilinear. */
BURNISH_INLINE vf light_from(const float *table, const vf d[3]) {
    enum { EDGE = BURNISH_RAY_LIGHT_EDGE };
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), half = vf_set(0.5f * (EDGE - 1));
    vf at[2], size[2], share[2];
    vf sum = map_magnitude(d[2]);
    for (int k = 0; k < 2; ++k) {
        sum = vf_add(sum, map_magnitude(d[k]));
    }
    const vm is_below = vf_greater(zero, d[2]);
    for (int k = 0; k < 2; ++k) {
        at[k] = vf_div(d[k], sum);
        size[k] = map_magnitude(at[k]);
    }
    vi index = vi_set(0);
    for (int k = 1; k >= 0; --k) {
        const vf folded = vf_sub(one, size[1 - k]);
        const vf turned = vf_blend(vf_greater(zero, at[k]), vf_sub(zero, folded), folded);
        const vf place = vf_mul(vf_add(vf_blend(is_below, turned, at[k]), one), half);
        const vf inside = vf_min(vf_max(place, zero), vf_set(EDGE - 1.001f));
        const vi cell = vi_truncate(inside);
        share[k] = vf_sub(inside, vf_from_int(cell));
        index = k == 1 ? vi_mul(cell, vi_set(EDGE)) : vi_add(index, cell);
    }
    vf row[2];
    for (int k = 0; k < 2; ++k) {
        const vf left = vf_gather(table + k * EDGE, index);
        const vf right = vf_gather(table + k * EDGE + 1, index);
        row[k] = vf_add(left, vf_mul(vf_sub(right, left), share[0]));
    }
    return vf_add(row[0], vf_mul(vf_sub(row[1], row[0]), share[1]));
}

static void start_rays(const burnish_ray_light *light, const burnish_ray_points *points,
                       burnish_started_rays *rays, float *const sums[3]) {
    rays->batch = (burnish_ray_batch){.reach = rays->reach, .count = points->count};
    for (int k = 0; k < 3; ++k) {
        rays->batch.origin[k] = rays->origin[k];
        rays->batch.direction[k] = rays->direction[k];
    }
    for (size_t i = 0; i < points->count; i += LANES) {
        for (int k = 0; k < 3; ++k) {
            const vf off = vf_mul(vf_load(points->face[k] + i), vf_set(light->offset));
            const vf p = vf_add(vf_load(points->position[k] + i), vf_set(light->eye[k]));
            vf_store(rays->origin[k] + i, vf_add(p, off));
        }
        for (int s = 0; s < 3; ++s) {
            vf_store(sums[s] + i, vf_set(0.0f));
        }
    }
}

/* Sets the rays from point i on: toward d, which brings `light`. None goes below its triangle, from
 * which a smooth normal leans away, or it would hide them from the light along it. */
BURNISH_INLINE void set_rays(const burnish_ray_points *points, size_t i, const vf d[3], vf light,
                             vf reach, burnish_started_rays *rays) {
    vf face[3];
    for (int k = 0; k < 3; ++k) {
        face[k] = vf_load(points->face[k] + i);
    }
    const vf rise = vf_mul(vf_set(2.0f), vf_min(ray_dot(d, face), vf_set(0.0f)));
    for (int k = 0; k < 3; ++k) {
        vf_store(rays->direction[k] + i, vf_sub(d[k], vf_mul(rise, face[k])));
    }
    vf_store(rays->light + i, light);
    vf_store(rays->reach + i, vf_and_mask(vf_greater(light, vf_set(0.0f)), reach));
}

/* Adds how many rays are hidden, or bring light, their light, and what is hidden of it. */
static void add_rays(const burnish_ray_light *light, burnish_started_rays *rays, int is_lamp,
                     int is_nearest, float *const sums[3]) {
    light->ops->find_hits(light->tree, &rays->batch, rays->hits, is_nearest ? rays->distance : NULL,
                          rays->place);
    for (size_t i = 0; i < rays->batch.count; i += LANES) {
        const vf all = vf_load(rays->light + i), hit = vf_load(rays->hits + i);
        const vf lights = vf_and_mask(vf_greater(all, vf_set(0.0f)), vf_set(1.0f));
        const vf terms[3] = {is_lamp ? lights : hit, all, vf_mul(all, hit)};
        for (int s = 0; s < 3; ++s) {
            vf_store(sums[s] + i, vf_add(vf_load(sums[s] + i), terms[s]));
        }
    }
}

/* ---- Lamps ---- */

BURNISH_INLINE void cross_vectors(const vf a[3], const vf b[3], vf out[3]) {
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        out[k] = vf_sub(vf_mul(a[next], b[last]), vf_mul(a[last], b[next]));
    }
}

/* Half sides of what is seen of a lamp in direction `toward`: of a sphere the disc that its tangents
 * meet in its centre's plane, of a tube the rectangle along its axis. */
BURNISH_INLINE void find_sides(const burnish_ray_lamp *lamp, const vf toward[3], vf side[2][3]) {
    const vf radius = vf_set(lamp->radius), least = vf_set(0x1p-40f);
    for (int k = 0; k < 3; ++k) {
        side[0][k] = vf_set(lamp->half[0][k]);
        side[1][k] = vf_set(lamp->half[1][k]);
    }
    if (lamp->shape == BURNISH_AREA_SPHERE) {
        const vf squared = vf_max(ray_dot(toward, toward), least);
        const vf unit = vector_inverse_sqrt(squared);
        const vf beyond = vf_max(vf_sub(squared, vf_mul(radius, radius)), least);
        const vf size = vf_div(vf_mul(radius, vector_inverse_sqrt(beyond)), unit);
        vf axis[3];
        for (int k = 0; k < 3; ++k) {
            axis[k] = vf_mul(toward[k], unit);
        }
        find_across(axis, side[0], side[1]);
        for (int k = 0; k < 3; ++k) {
            side[0][k] = vf_mul(side[0][k], size);
            side[1][k] = vf_mul(side[1][k], size);
        }
    } else if (lamp->shape == BURNISH_AREA_LINE) {
        cross_vectors(side[0], toward, side[1]);
        const vf scale =
            vf_mul(radius, vector_inverse_sqrt(vf_max(ray_dot(side[1], side[1]), least)));
        for (int k = 0; k < 3; ++k) {
            side[1][k] = vf_mul(side[1][k], scale);
        }
    }
}

/* Some lamps' light that arrives along d, spread by a surface of this alpha that mirrors it: a square around
 * where d meets a lamp's plane, of which a part is the lamp's. */
BURNISH_INLINE vf lamps_from(const burnish_ray_light *light, int lamps, const vf origin[3],
                             const vf d[3], vf alpha) {
    const vf zero = vf_set(0.0f), tiny = vf_set(0x1p-40f);
    vf sum = zero;
    for (int number = 0; number < lamps; ++number) {
        const burnish_ray_lamp *lamp = &light->lamps[number];
        const int is_round = lamp->shape == BURNISH_AREA_DISC || lamp->shape == BURNISH_AREA_SPHERE;
        const vf edge = vf_set(is_round ? ROUND_EDGE : 1);
        vf w[3], side[2][3], normal[3], q[3], product[3], share = vf_set(is_round ? 1 : 0.785398f);
        for (int k = 0; k < 3; ++k) {
            w[k] = vf_set(lamp->center[k]);
            w[k] = lamp->is_distant ? w[k] : vf_sub(w[k], origin[k]);
        }
        find_sides(lamp, w, side);
        cross_vectors(side[0], side[1], normal);
        const vf facing = vf_sub(zero, ray_dot(normal, d)),
                 ahead = vf_sub(zero, ray_dot(normal, w));
        const vf one_side = lamp->is_two_sided ? vf_mul(facing, facing) : facing;
        const vm is_seen =
            vm_and(vf_greater(one_side, zero), vf_greater(vf_mul(ahead, facing), zero));
        const vf way = vf_div(ahead, vf_blend(is_seen, facing, vf_set(1.0f)));
        for (int k = 0; k < 3; ++k) {
            q[k] = vf_sub(vf_mul(d[k], way), w[k]);
        }
        const vf area = vf_div(vf_set(1.0f), vf_max(ray_dot(normal, normal), vf_set(0x1p-120f)));
        for (int axis = 0; axis < 2; ++axis) {
            const vf *const other = side[1 - axis];
            cross_vectors(axis ? other : q, axis ? q : other, product);
            const vf at = vf_mul(ray_dot(product, normal), area);
            const vf unit = vector_inverse_sqrt(vf_max(ray_dot(side[axis], side[axis]), tiny));
            const vf wide =
                vf_add(vf_mul(vf_mul(vf_mul(alpha, vf_set(SPREAD)), way), unit), vf_set(0x1p-6f));
            const vf from = vf_max(vf_sub(at, wide), vf_sub(zero, edge));
            const vf inside = vf_max(vf_sub(vf_min(vf_add(at, wide), edge), from), zero);
            share = vf_mul(share, vf_div(inside, vf_add(wide, wide)));
        }
        sum = vf_add(sum, vf_and_mask(is_seen, vf_mul(share, vf_set(lamp->strength))));
    }
    return sum;
}

typedef struct ray_start {
    vf origin[3], normal[3];
} ray_start;

/* Turns the directions of glossy points, and their light: mirrored at one of GGX's normals. */
BURNISH_INLINE void mirror_rays(const burnish_ray_light *light, const burnish_ray_points *points,
                                size_t i, const float lobe[2], const ray_start *from, vf d[3],
                                vf *arriving) {
    const vf alpha = vf_load(points->gloss + i), zero = vf_set(0.0f);
    const vm is_matt = vf_greater(zero, alpha);
    const vf *const n = from->normal;
    vf across[2][3], back[3], h[3], mirrored[3], straight[3];
    find_across(n, across[0], across[1]);
    for (int k = 0; k < 3; ++k) {
        const vf side =
            vf_add(vf_mul(across[0][k], vf_set(lobe[0])), vf_mul(across[1][k], vf_set(lobe[1])));
        back[k] = vf_load(points->back[k] + i); /* of any length */
        h[k] = vf_add(n[k], vf_mul(alpha, side));
    }
    const vf squared = vf_max(ray_dot(h, h), vf_set(0x1p-40f));
    const vf twice = vf_div(vf_mul(vf_set(2.0f), ray_dot(back, h)), squared);
    for (int k = 0; k < 3; ++k) {
        mirrored[k] = vf_sub(vf_mul(twice, h[k]), back[k]);
    }
    const vf unit = vector_inverse_sqrt(vf_max(ray_dot(mirrored, mirrored), vf_set(0x1p-40f)));
    for (int k = 0; k < 3; ++k) {
        mirrored[k] = vf_mul(mirrored[k], unit);
        d[k] = vf_blend(is_matt, d[k], mirrored[k]);
    }
    const vf along = vf_mul(vf_set(2.0f), ray_dot(back, n));
    for (int k = 0; k < 3; ++k) {
        straight[k] = vf_sub(vf_mul(along, n[k]), back[k]);
    }
    const vf of_lamps =
        lamps_from(light, points->lamps, from->origin, straight, vf_max(alpha, zero));
    const vf light_along = vf_add(light_from(light->sky, mirrored), of_lamps);
    /* what is dark is mirrored, too */
    *arriving = vf_blend(is_matt, *arriving, vf_max(light_along, vf_set(0x1p-30f)));
}

static void sample_sky(const burnish_ray_light *light, const burnish_ray_points *points, int first,
                       int count, burnish_started_rays *met, float *const sums[3]) {
    burnish_started_rays own, *const rays = met ? met : &own;
    start_rays(light, points, rays, sums);
    for (int sample = first; sample < first + count; ++sample) {
        const float *const local = light->directions[sample];
        for (size_t i = 0; i < points->count; i += LANES) {
            ray_start from;
            vf *const n = from.normal, across[2][3], d[3], squared = vf_set(0.0f);
            for (int k = 0; k < 3; ++k) {
                n[k] = vf_load(points->normal[k] + i);
                squared = vf_add(squared, vf_mul(n[k], n[k]));
            }
            find_across(n, across[0], across[1]);
            for (int k = 0; k < 3; ++k) {
                d[k] = vf_add(vf_add(vf_mul(across[0][k], vf_set(local[0])),
                                     vf_mul(across[1][k], vf_set(local[1]))),
                              vf_mul(n[k], vf_set(local[2])));
            }
            const vm has_normal = vf_greater(squared, vf_set(0.5f)); /* without: open */
            vf arriving = light_from(light->light, d);
            if (points->gloss) {
                for (int k = 0; k < 3; ++k) {
                    from.origin[k] = vf_load(rays->origin[k] + i);
                }
                mirror_rays(light, points, i, light->lobe[sample], &from, d, &arriving);
            }
            set_rays(points, i, d, arriving, vf_and_mask(has_normal, vf_set(RAY_REACH)), rays);
        }
        add_rays(light, rays, 0, met != NULL, sums);
    }
}

static void sample_lamp(const burnish_ray_light *light, int number,
                        const burnish_ray_points *points, int first, int count,
                        float *const sums[3]) {
    const burnish_ray_lamp *lamp = &light->lamps[number];
    const int is_round = lamp->shape == BURNISH_AREA_DISC || lamp->shape == BURNISH_AREA_SPHERE;
    const vf zero = vf_set(0.0f), tiny = vf_set(0x1p-40f);
    burnish_started_rays rays;
    start_rays(light, points, &rays, sums);
    for (int sample = first; sample < first + count; ++sample) {
        const float *const place = light->places[is_round][sample];
        for (size_t i = 0; i < points->count; i += LANES) {
            vf n[3], w[3], d[3], side[2][3], normal[3];
            for (int k = 0; k < 3; ++k) {
                n[k] = vf_load(points->normal[k] + i);
                w[k] = vf_set(lamp->center[k]);
                if (!lamp->is_distant) {
                    w[k] = vf_sub(w[k], vf_load(rays.origin[k] + i));
                }
            }
            find_sides(lamp, w, side);
            cross_vectors(side[0], side[1], normal);
            for (int k = 0; k < 3; ++k) {
                w[k] = vf_add(w[k], vf_add(vf_mul(side[0][k], vf_set(place[0])),
                                           vf_mul(side[1][k], vf_set(place[1]))));
            }
            const vf squared = vf_max(ray_dot(w, w), tiny), inverse = vector_inverse_sqrt(squared);
            for (int k = 0; k < 3; ++k) {
                d[k] = vf_mul(w[k], inverse);
            }
            const vf front = vf_sub(zero, ray_dot(normal, d));
            const vf facing = lamp->is_two_sided ? map_magnitude(front) : vf_max(front, zero);
            const vf part =
                vf_mul(vf_mul(vf_max(ray_dot(n, d), zero), facing), vf_mul(inverse, inverse));
            const vf reach = lamp->is_distant ? vf_set(RAY_REACH) : vf_mul(squared, inverse);
            set_rays(points, i, d, vf_mul(part, vf_set(lamp->strength)), reach, &rays);
        }
        add_rays(light, &rays, 1, 0, sums);
    }
}

#endif
