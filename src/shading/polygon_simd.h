/* The light of polygons, spheres and tubes over vectors of points: a point and its lobes in the
 * frame in which the edges are integrated. */
#ifndef BURNISH_SHADING_POLYGON_SIMD_H
#define BURNISH_SHADING_POLYGON_SIMD_H

#include "shading/polygon_edges_simd.h"
#include "shading/round_simd.h"

/* ---- Points ---- */

/* Makes a frame with the unit vector frame[2]. Source: Duff and others, Building an Orthonormal
 * Basis, Revisited, 2017. */
BURNISH_INLINE void polygon_frame(vf frame[3][3]) {
    const vf *z = frame[2], zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf sign = vf_blend(vf_greater(zero, z[2]), vf_set(-1.0f), one);
    const vf a = vf_div(vf_set(-1.0f), vf_add(sign, z[2])), b = vf_mul(vf_mul(z[0], z[1]), a);
    frame[0][0] = vf_add(one, vf_mul(vf_mul(sign, vf_mul(z[0], z[0])), a));
    frame[0][1] = vf_mul(sign, b);
    frame[0][2] = vf_sub(zero, vf_mul(sign, z[0]));
    frame[1][0] = b;
    frame[1][1] = vf_add(sign, vf_mul(vf_mul(z[1], z[1]), a));
    frame[1][2] = vf_sub(zero, z[1]);
}

/* Fills *faces with the points that the light shines on; returns those behind it. Points in the
 * plane of the light, within rounding, get nothing. */
BURNISH_INLINE vm polygon_side(const burnish_polygon_constants *polygon, const vf position[3], vf w,
                               vm *faces) {
    const vf offset = vf_mul(w, vf_set(polygon->offset));
    const vf distance = vf_sub(shade_dot_constant(position, polygon->normal), offset);
    vf noise = polygon_absolute(offset);
    for (int k = 0; k < 3; ++k) {
        noise = vf_add(noise, polygon_absolute(vf_mul(position[k], vf_set(polygon->normal[k]))));
    }
    noise = vf_mul(noise, vf_set(0x1p-21f));
    *faces = vf_greater(distance, noise);
    const vm behind = vf_greater(vf_sub(vf_set(0.0f), distance), noise);
    if (polygon->is_two_sided) {
        *faces = vm_or(*faces, behind);
    }
    return behind;
}

/* A vector of points and a polygon, relative to each point. */
typedef struct polygon_scene {
    vf normal[3], position[3], w;
    vm faces, behind;
    int turns; /* 1: some points are behind */
    /* spheres and tubes: c, u, v of polygon.h; a sphere's c and cap are of unit length */
    vf base[3][3];
    round_cap cap;
} polygon_scene;

/* Twice the radius at most, near the axis. */
BURNISH_INLINE void polygon_load_tube(const burnish_polygon_constants *polygon,
                                      polygon_scene *scene) {
    const vf *to = scene->base[0], one = vf_set(1.0f);
    vf *u = scene->base[1], *v = scene->base[2], foot[3];
    const vf along = shade_dot_constant(to, polygon->axis);
    const vf length = vf_mul(scene->w, vf_set(polygon->half_length));
    const vf radius = vf_mul(scene->w, vf_set(polygon->thickness));
    for (int k = 0; k < 3; ++k) {
        const vf axis = vf_set(polygon->axis[k]);
        foot[k] = vf_sub(to[k], vf_mul(along, axis));
        u[k] = vf_mul(length, axis);
    }
    const vf squared = shade_dot(foot, foot), least = vf_set(0x1p-80f);
    scene->faces = vf_greater(squared, vf_mul(shade_dot(to, to), vf_set(0x1p-40f)));
    const vf inverse = vector_inverse_sqrt(vf_max(squared, least));
    const vf ratio = vf_mul(radius, inverse), rest = vf_sub(one, vf_mul(ratio, ratio));
    const vf size = vf_mul(ratio, vector_inverse_sqrt(vf_max(rest, vf_set(0.25f))));
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        v[k] = vf_mul(size, vf_sub(vf_mul(foot[i], vf_set(polygon->axis[j])),
                                   vf_mul(foot[j], vf_set(polygon->axis[i]))));
    }
}

BURNISH_INLINE void polygon_load_sphere(const burnish_polygon_constants *polygon,
                                        polygon_scene *scene) {
    vf frame[3][3];
    const vf *to = scene->base[0];
    const vf inverse = vector_inverse_sqrt(vf_max(shade_dot(to, to), vf_set(0x1p-80f)));
    const vf radius = vf_mul(scene->w, vf_set(polygon->thickness));
    /* inside the sphere as on it, nearly */
    const vf sine = vf_min(vf_mul(radius, inverse), vf_set(0.99999f));
    const vf cosine = polygon_root(vf_sub(vf_set(1.0f), vf_mul(sine, sine)));
    for (int k = 0; k < 3; ++k) {
        frame[2][k] = scene->cap.middle[k] = vf_mul(to[k], inverse);
    }
    scene->cap.sine = sine;
    scene->cap.cosine = cosine;
    polygon_frame(frame);
    for (int k = 0; k < 3; ++k) {
        scene->base[0][k] = vf_mul(frame[2][k], cosine);
        scene->base[1][k] = vf_mul(frame[0][k], sine);
        scene->base[2][k] = vf_mul(frame[1][k], sine);
    }
}

BURNISH_INLINE void polygon_load_round(const burnish_polygon_constants *polygon,
                                       polygon_scene *scene) {
    for (int k = 0; k < 3; ++k) {
        scene->base[0][k] =
            vf_sub(vf_mul(scene->w, vf_set(polygon->center[k])), scene->position[k]);
    }
    scene->turns = 0;
    if (polygon->shape == BURNISH_POLYGON_TUBE) {
        polygon_load_tube(polygon, scene);
    } else {
        scene->faces = vm_not(vf_greater(vf_set(0.0f), vf_set(0.0f)));
        polygon_load_sphere(polygon, scene);
    }
}

BURNISH_INLINE void polygon_load(const burnish_polygon_constants *polygon,
                                 const burnish_kernels_points *points, size_t i,
                                 polygon_scene *scene) {
    scene->w = vf_set(1.0f);
    for (int k = 0; k < 3; ++k) {
        scene->normal[k] = points->normal[0] ? vf_load(points->normal[k] + i) : vf_set(0.0f);
        scene->position[k] = polygon->is_distant ? vf_set(0.0f) : vf_load(points->position[k] + i);
    }
    if (!polygon->is_distant && points->w) {
        scene->w = vf_load(points->w + i);
    }
    if (polygon->shape != BURNISH_POLYGON_FLAT) {
        polygon_load_round(polygon, scene);
        return;
    }
    scene->behind = polygon_side(polygon, scene->position, scene->w, &scene->faces);
    scene->turns = polygon->is_two_sided && vm_any(scene->behind);
}

/* From each point to a vertex, of any length. */
BURNISH_INLINE void polygon_to_vertex(const burnish_polygon_constants *polygon,
                                      const polygon_scene *scene, int v, vf to[3]) {
    const float *front = polygon->vertex[v];
    const float *back = polygon->vertex[polygon->vertex_count - 1 - v];
    if (polygon->shape != BURNISH_POLYGON_FLAT) {
        for (int k = 0; k < 3; ++k) {
            const vf across = vf_mul(scene->base[1][k], vf_set(front[0]));
            const vf up = vf_mul(scene->base[2][k], vf_set(front[1]));
            to[k] = vf_add(scene->base[0][k], vf_add(across, up));
        }
        return;
    }
    for (int k = 0; k < 3; ++k) {
        vf vertex = vf_set(front[k]);
        if (scene->turns) {
            vertex = vf_blend(scene->behind, vf_set(back[k]), vertex);
        }
        to[k] = vf_sub(vf_mul(scene->w, vertex), scene->position[k]);
    }
}

BURNISH_INLINE vf polygon_diffuse(const burnish_polygon_constants *polygon,
                                  const polygon_scene *scene) {
    const vf turn = vf_set(0.159154943091895f); /* 1 / (2 pi) */
    polygon_point at;
    polygon_sums sums;
    polygon_edge edge; /* one after the other */
    at.has_horizon = at.is_diffuse = 1;
    at.faces = scene->faces;
    sums.diffuse = vf_set(0.0f);
    for (int k = 0; k < 3; ++k) {
        at.normal[k] = scene->normal[k];
    }
    polygon_normalize(at.normal);
    if (polygon->shape == BURNISH_POLYGON_SPHERE) {
        return vector_saturate(round_diffuse(&scene->cap, shade_dot(at.normal, scene->cap.middle)));
    }
    for (int v = 0; v < polygon->vertex_count; ++v) {
        polygon_to_vertex(polygon, scene, v, at.vertex[v]);
        polygon_normalize(at.vertex[v]);
    }
    (void)polygon_edges(polygon->vertex_count, &at, &sums, &edge);
    return vector_saturate(vf_mul(sums.diffuse, turn));
}

/* The points whose lobes can reach the polygon: with d from the point to the polygon's centre and the
 * angles alpha of the widest lobe and beta of a sphere around the polygon, the angle between axis and
 * d is at most alpha + beta. */
BURNISH_INLINE vm polygon_touches(const burnish_polygon_constants *polygon,
                                  const polygon_scene *scene, const vf axis[3], const vf *stretch) {
    vf d[3], size = vf_mul(polygon_absolute(scene->w), vf_set(polygon->radius));
    if (polygon->reach_cosine < -2e-4f) {
        return scene->faces; /* alpha + beta may be more than half a turn */
    }
    for (int k = 0; k < 3; ++k) {
        d[k] = vf_sub(vf_mul(scene->w, vf_set(polygon->center[k])), scene->position[k]);
    }
    if (stretch) { /* no vector becomes longer by more than this factor */
        const vf factor = shade_dot(stretch, d);
        size = vf_mul(size, vf_add(vf_set(1.0f), shade_dot(stretch, stretch)));
        for (int k = 0; k < 3; ++k) {
            d[k] = vf_add(d[k], vf_mul(stretch[k], factor));
        }
    }
    const vf squared = shade_dot(d, d), rest = vf_sub(squared, vf_mul(size, size));
    const vf cosine = polygon_root(vf_max(rest, vf_set(0x1p-80f))); /* times abs(d) */
    const vf bound = vf_sub(vf_mul(vf_set(polygon->reach_cosine), cosine),
                            vf_mul(vf_set(polygon->reach_sine), size));
    const vm is_inside = vf_greater(vf_mul(squared, vf_set(1e-3f)), rest);
    return vm_and(scene->faces, vm_or(is_inside, vf_greater(shade_dot(axis, d), bound)));
}

/* The frame of each lobe: normal and vertices in it. */
BURNISH_INLINE void polygon_turn(const burnish_polygon_constants *polygon,
                                 const polygon_scene *scene, const vf *stretch, vf frame[3][3],
                                 polygon_point *at) {
    vf to[3];
    polygon_frame(frame);
    for (int k = 0; k < 3; ++k) {
        at->normal[k] = shade_dot(frame[k], scene->normal);
    }
    polygon_normalize(at->normal);
    at->lowest = vf_set(1.0f);
    if (polygon->shape == BURNISH_POLYGON_SPHERE && !stretch) {
        return;
    }
    for (int v = 0; v < polygon->vertex_count; ++v) {
        polygon_to_vertex(polygon, scene, v, to);
        if (stretch) {
            const vf factor = shade_dot(stretch, to);
            for (int k = 0; k < 3; ++k) {
                to[k] = vf_add(to[k], vf_mul(stretch[k], factor));
            }
        }
        for (int k = 0; k < 3; ++k) {
            at->vertex[v][k] = shade_dot(frame[k], to);
        }
        polygon_normalize(at->vertex[v]);
        polygon_avoid_axis(at->vertex[v]);
        at->lowest = vf_min(at->lowest, at->vertex[v][2]);
    }
}

BURNISH_INLINE void polygon_begin_sums(const burnish_polygon_constants *polygon,
                                       const polygon_point *at, polygon_sums *sums) {
    const vf zero = vf_set(0.0f);
    sums->exists = vf_greater(zero, zero);
    sums->inside = at->faces;
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const vm is_whole = vf_greater(at->lowest, vf_set(polygon->lobes[j].least_cosine));
        sums->lobes[j] = (polygon_share){zero, zero, is_whole};
    }
}

/* Adds the circle of a cap, and makes the edge where the horizon cuts it. Returns the number of
 * edges. */
BURNISH_INLINE int polygon_add_circle(const burnish_polygon_constants *polygon,
                                      const round_cap *cap, const vf frame[3][3], polygon_point *at,
                                      polygon_sums *sums, polygon_edge *edge) {
    round_circle circle;
    vf middle[3];
    for (int k = 0; k < 3; ++k) {
        middle[k] = shade_dot(frame[k], cap->middle);
    }
    round_circle_begin(cap, middle, &circle);
    circle.faces = at->faces;
    round_cut(at->has_horizon ? at->normal : middle, &circle, edge);
    at->lowest = vf_sub(vf_sub(vf_set(1.0f), circle.least), circle.span);
    polygon_begin_sums(polygon, at, sums);
    sums->exists = circle.faces;
    sums->inside = vm_and(circle.faces, vf_greater(vf_set(0.0f), circle.ahead));
    for (int j = 0; j < polygon->lobe_count; ++j) {
        round_add_lobe(&polygon->lobes[j], &circle, &sums->lobes[j]);
    }
    return circle.is_cut;
}

BURNISH_INLINE vf polygon_specular(const burnish_polygon_constants *polygon,
                                   const burnish_kernels_points *points,
                                   const burnish_kernels_axes *axes, const polygon_scene *scene,
                                   size_t i) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), turn = vf_set(0.159154943091895f);
    vf frame[3][3], wide[3], specular = zero;
    const vf *stretch = axes->stretch[0] ? wide : NULL;
    polygon_point at;
    polygon_sums sums;
    polygon_edge edges[BURNISH_POLYGON_VERTEX_MAX + 1];
    int count = 0;
    at.has_horizon = points->normal[0] != NULL;
    at.is_diffuse = 0;
    for (int k = 0; k < 3; ++k) {
        frame[2][k] = vf_load(axes->axis[k] + i);
        wide[k] = stretch ? vf_load(axes->stretch[k] + i) : zero;
    }
    at.faces = polygon_touches(polygon, scene, frame[2], stretch);
    if (!vm_any(at.faces)) {
        return zero;
    }
    polygon_turn(polygon, scene, stretch, frame, &at);
    if (polygon->shape == BURNISH_POLYGON_SPHERE && !stretch) {
        count = polygon_add_circle(polygon, &scene->cap, (const vf(*)[3])frame, &at, &sums, edges);
    } else {
        polygon_begin_sums(polygon, &at, &sums);
        count = polygon_edges(polygon->vertex_count, &at, &sums, edges);
    }
    for (int e = 0; e < count; ++e) {
        polygon_add_lobes(polygon, &edges[e], &sums);
    }
    const vf inside = vf_and_mask(vm_and(sums.inside, sums.exists), one);
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const polygon_share *lobe = &sums.lobes[j];
        const vf swept = vf_sub(inside, vf_mul(lobe->azimuth, turn));
        const vf share =
            vf_add(vf_and_mask(vm_not(lobe->is_whole), swept), vf_mul(lobe->smooth, turn));
        const vf weight = vf_set(polygon->lobes[j].weight);
        specular = vf_add(specular, vf_mul(weight, vector_saturate(share)));
    }
    return specular;
}

/* One vector of points. Not inlined: it is long, and called twice. */
static __attribute__((noinline)) void polygon_points(const burnish_polygon_constants *polygon,
                                                     const burnish_kernels_points *points,
                                                     const burnish_kernels_axes *axes, size_t i,
                                                     float *const light[2]) {
    vf diffuse = vf_set(0.0f), specular = vf_set(0.0f);
    polygon_scene scene;
    polygon_load(polygon, points, i, &scene);
    if (light[0]) {
        if (vm_any(scene.faces)) {
            diffuse = polygon_diffuse(polygon, &scene);
        }
        vf_store(light[0] + i, diffuse);
    }
    if (light[1]) {
        if (polygon->lobe_count > 0 && vm_any(scene.faces)) {
            specular = polygon_specular(polygon, points, axes, &scene, i);
        }
        vf_store(light[1] + i, specular);
    }
}

/* Fewer points than a vector has. */
BURNISH_INLINE void polygon_rest(const burnish_polygon_constants *polygon,
                                 const burnish_kernels_points *points,
                                 const burnish_kernels_axes *axes, size_t first, size_t count,
                                 float *const light[2]) {
    enum { ARRAYS = 13 };
    float block[ARRAYS][LANES];
    burnish_kernels_points padded = *points;
    burnish_kernels_axes turned = *axes;
    const float **to[ARRAYS] = {&padded.normal[0],   &padded.normal[1],   &padded.normal[2],
                                &padded.position[0], &padded.position[1], &padded.position[2],
                                &padded.w,           &turned.axis[0],     &turned.axis[1],
                                &turned.axis[2],     &turned.stretch[0],  &turned.stretch[1],
                                &turned.stretch[2]};
    float *const blocks[2] = {light[0] ? block[0] : NULL, light[1] ? block[1] : NULL};
    memset(block, 0, sizeof block);
    for (int k = 0; k < ARRAYS; ++k) {
        if (*to[k]) {
            memcpy(block[k], *to[k] + first, count * sizeof(float));
            *to[k] = block[k];
        }
    }
    polygon_points(polygon, &padded, &turned, 0, blocks);
    for (int k = 0; k < 2; ++k) {
        if (light[k]) {
            memcpy(light[k] + first, block[k], count * sizeof(float));
        }
    }
}

/* ---- The kernel ---- */

static void polygon_light(const burnish_polygon_constants *polygon,
                          const burnish_kernels_points *points, const burnish_kernels_axes *axes,
                          size_t count, float *const light[2]) {
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        polygon_points(polygon, points, axes, i, light);
    }
    if (i < count) {
        polygon_rest(polygon, points, axes, i, count - i, light);
    }
}

#endif
