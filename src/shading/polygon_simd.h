/* The light of polygons over vectors of points: a point and its lobes in the frame in which the edges
 * are integrated. */
#ifndef BURNISH_SHADING_POLYGON_SIMD_H
#define BURNISH_SHADING_POLYGON_SIMD_H

#include "shading/polygon_edges_simd.h"

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
} polygon_scene;

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
    scene->behind = polygon_side(polygon, scene->position, scene->w, &scene->faces);
    scene->turns = polygon->is_two_sided && vm_any(scene->behind);
}

/* From each point to a vertex, of any length. */
BURNISH_INLINE void polygon_to_vertex(const burnish_polygon_constants *polygon,
                                      const polygon_scene *scene, int v, vf to[3]) {
    const float *front = polygon->vertex[v];
    const float *back = polygon->vertex[polygon->vertex_count - 1 - v];
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
    sums.exists = vf_greater(zero, zero);
    sums.inside = at.faces;
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const vm is_whole = vf_greater(at.lowest, vf_set(polygon->lobes[j].least_cosine));
        sums.lobes[j] = (polygon_share){zero, zero, is_whole};
    }
    const int count = polygon_edges(polygon->vertex_count, &at, &sums, edges);
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
