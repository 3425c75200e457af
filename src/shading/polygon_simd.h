/* The light of a polygon of constant radiance over vectors of points: Lambert's formula, and the
 * integral of lobes S(c) = max(0, 1 + zeta (c - 1))^m.
 *
 * In a frame with the lobe's axis as z, c is the z of a unit vector; phi is its azimuth and
 * u = 1 + zeta (c - 1). The share of the lobe in the polygon P is a contour integral:
 *
 *   (1/E) integral over P of S = inside - 1/(2 pi) sum over edges of integral of max(0, u)^(m+1) dphi
 *
 * with inside = 1 if P contains the axis. Only arcs in the cap u > 0 count, and there
 * u^(m+1) = 1 - zeta (1 - c) (1 + u + ... + u^m). The 1 gives the swept azimuth, one arctangent; the
 * rest has no pole and is integrated by Gauss's rule. If all vertices are in the cap, the azimuths
 * add up to `inside`. Both are left out then, because small lights would lose digits.
 *
 * An edge's great circle has a unit normal n, sin d = abs(n.z) and k = cos d. With t, the angle from
 * its point nearest to the axis: c = k cos t, dphi = sin d / (1 - c^2) dt. With s = 2 sin(t/2)
 *
 *   1 - c = (1 - k) + k s^2 / 2,  dt = ds / sqrt(1 - s^2 / 4)
 *
 * which keeps the digits of 1 - c for narrow lobes and needs no sine.
 *
 * Lanes never mix: what a lane does not need is exactly 0, whether its neighbours need it or not. */
#ifndef BURNISH_SHADING_POLYGON_SIMD_H
#define BURNISH_SHADING_POLYGON_SIMD_H

#include "shading/polygon.h"
#include "shading/shade_simd.h"

/* Gauss's rule by order: one half of its nodes. */
enum { POLYGON_PAIRS_MAX = 4 };
typedef struct polygon_rule {
    int pairs;
    float node[POLYGON_PAIRS_MAX], weight[POLYGON_PAIRS_MAX];
} polygon_rule;

static const polygon_rule POLYGON_RULES[BURNISH_POLYGON_ORDER_COUNT] = {
    {2, {0.861136312f, 0.339981044f}, {0.347854845f, 0.652145155f}},
    {3, {0.932469514f, 0.661209386f, 0.238619186f}, {0.171324492f, 0.360761573f, 0.467913935f}},
    {4,
     {0.960289856f, 0.796666477f, 0.52553241f, 0.183434642f},
     {0.101228536f, 0.222381034f, 0.313706646f, 0.362683783f}}};

/* Integrals of one lobe, times 2 pi. */
typedef struct polygon_lobe {
    vf zeta;
    vf smooth, azimuth;
    vm is_whole; /* the cap contains all vertices */
} polygon_lobe;

typedef struct polygon_sums {
    vf diffuse;
    vm inside, exists; /* the axis is on the polygon's side of all edges so far; there is one */
    polygon_lobe lobes[BURNISH_POLYGON_LOBE_MAX];
} polygon_sums;

/* An arc of a great circle, shorter than half of it, between unit vectors. */
typedef struct polygon_edge {
    vf from[3], to[3];
    vf normal[3]; /* of the circle, of any length; the polygon is on its side */
    vf cross[3];  /* from x to */
    vm exists;
} polygon_edge;

/* An end of an arc: its z, and sine and cosine of its t. */
typedef struct polygon_end {
    vf z, sine, cosine;
} polygon_end;

/* What all lobes need of an edge. */
typedef struct polygon_arc {
    vf sine, cosine;    /* sin d, k */
    vf one_less_cosine; /* 1 - k */
    polygon_end from, to;
    vm right; /* the axis is not on the polygon's side */
    vm exists;
} polygon_arc;

/* One vector of points, in the frame of each. */
typedef struct polygon_point {
    vf normal[3];                             /* unit vector */
    vf vertex[BURNISH_POLYGON_VERTEX_MAX][3]; /* unit vectors, in counterclockwise order */
    vm faces;                                 /* the light shines here */
    int has_horizon, has_diffuse;
} polygon_point;

BURNISH_INLINE vf polygon_absolute(vf x) {
    return vf_from_bits(vi_and(vf_bits(x), vi_set(0x7fffffff)));
}

BURNISH_INLINE vf polygon_root(vf x) {
    return vf_mul(x, vector_inverse_sqrt(x));
}

/* a x b for unit vectors: a x (b - a) keeps the digits of short edges. */
BURNISH_INLINE void polygon_cross(const vf a[3], const vf b[3], vf cross[3]) {
    vf d[3];
    for (int k = 0; k < 3; ++k) {
        d[k] = vf_sub(b[k], a[k]);
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cross[k] = vf_sub(vf_mul(a[i], d[j]), vf_mul(a[j], d[i]));
    }
}

BURNISH_INLINE void polygon_normalize(vf a[3]) {
    const vf scale = vector_inverse_sqrt(shade_dot(a, a));
    for (int k = 0; k < 3; ++k) {
        a[k] = vf_mul(a[k], scale);
    }
}

/* ---- Lobes ---- */

BURNISH_INLINE polygon_end polygon_end_of(const vf end[3], const vf n[3], vf inverse_flat,
                                          vf by_cosine) {
    const vf sine = vf_sub(vf_mul(end[0], n[1]), vf_mul(end[1], n[0]));
    return (polygon_end){end[2], vf_mul(sine, inverse_flat), vf_mul(end[2], by_cosine)};
}

BURNISH_INLINE polygon_arc polygon_arc_of(const polygon_edge *edge) {
    const vf *n = edge->normal;
    const vf flat = vf_max(vf_add(vf_mul(n[0], n[0]), vf_mul(n[1], n[1])), vf_set(0x1p-80f));
    const vf squared = vf_add(flat, vf_mul(n[2], n[2]));
    const vf inverse = vector_inverse_sqrt(squared), inverse_flat = vector_inverse_sqrt(flat);
    const vf by_cosine = vf_mul(vf_mul(squared, inverse), inverse_flat);
    polygon_arc arc = {.exists = edge->exists};
    arc.sine = vf_mul(polygon_absolute(n[2]), inverse);
    arc.cosine = vf_mul(vf_mul(flat, inverse_flat), inverse);
    arc.one_less_cosine = vf_div(vf_mul(arc.sine, arc.sine), vf_add(vf_set(1.0f), arc.cosine));
    arc.from = polygon_end_of(edge->from, n, inverse_flat, by_cosine);
    arc.to = polygon_end_of(edge->to, n, inverse_flat, by_cosine);
    arc.right = vf_greater(vf_set(0.0f), n[2]);
    return arc;
}

/* s = 2 sin(t/2) from the sine and a cosine that is not negative. */
BURNISH_INLINE vf polygon_chord(vf sine, vf cosine) {
    const vf half = vf_set(0.5f), c = vf_max(cosine, vf_set(0.0f));
    return vf_mul(sine, vector_inverse_sqrt(vf_add(half, vf_mul(half, c))));
}

/* 1 + u + ... + u^m */
BURNISH_INLINE vf polygon_powers(int order, vf u) {
    const vf one = vf_set(1.0f);
    vf power = u, sum = vf_add(one, u);
    for (int k = 0; k < order; ++k) {
        power = vf_mul(power, power);
        sum = vf_mul(sum, vf_add(one, power));
    }
    return vf_add(sum, vf_mul(power, power));
}

/* (1 + u + ... + u^m) (1 - c) dphi / (sin d ds) */
BURNISH_INLINE vf polygon_front(int order, const polygon_arc *arc, vf zeta, vf s) {
    const vf one = vf_set(1.0f), squared = vf_mul(s, s);
    const vf half_cosine = vf_mul(vf_set(0.5f), arc->cosine);
    const vf lambda = vf_add(arc->one_less_cosine, vf_mul(half_cosine, squared));
    const vf u = vf_sub(one, vf_mul(zeta, lambda)), one_and_c = vf_sub(vf_set(2.0f), lambda);
    const vf bend = vf_sub(one, vf_mul(vf_set(0.25f), squared));
    return vf_mul(vector_inverse_sqrt(vf_mul(bend, vf_mul(one_and_c, one_and_c))),
                  polygon_powers(order, u));
}

/* max(0, u)^(m+1) dphi / (sin d ds), with s from the point farthest from the axis. */
BURNISH_INLINE vf polygon_back(int order, const polygon_arc *arc, vf zeta, vf s) {
    const vf one = vf_set(1.0f), squared = vf_mul(s, s);
    const vf half_cosine = vf_mul(vf_set(0.5f), arc->cosine);
    const vf one_and_c =
        vf_max(vf_add(arc->one_less_cosine, vf_mul(half_cosine, squared)), vf_set(0x1p-30f));
    const vf lambda = vf_sub(vf_set(2.0f), one_and_c);
    const vf u = vf_max(vf_sub(one, vf_mul(zeta, lambda)), vf_set(0.0f));
    const vf bend = vf_sub(one, vf_mul(vf_set(0.25f), squared));
    vf power = u;
    for (int k = 0; k <= order; ++k) {
        power = vf_mul(power, power);
    }
    return vf_mul(vf_div(vf_mul(u, power), vf_mul(one_and_c, lambda)), vector_inverse_sqrt(bend));
}

/* sin d times the integral of polygon_front or polygon_back over [from, to]. */
BURNISH_INLINE vf polygon_integral(int order, int is_back, const polygon_arc *arc, vf zeta, vf from,
                                   vf to) {
    const polygon_rule *rule = &POLYGON_RULES[order];
    const vf half = vf_set(0.5f);
    const vf middle = vf_mul(half, vf_add(from, to)), width = vf_mul(half, vf_sub(to, from));
    vf sum = vf_set(0.0f);
    for (int i = 0; i < rule->pairs; ++i) {
        const vf step = vf_mul(width, vf_set(rule->node[i]));
        const vf a = vf_sub(middle, step), b = vf_add(middle, step);
        const vf pair =
            is_back
                ? vf_add(polygon_back(order, arc, zeta, a), polygon_back(order, arc, zeta, b))
                : vf_add(polygon_front(order, arc, zeta, a), polygon_front(order, arc, zeta, b));
        sum = vf_add(sum, vf_mul(pair, vf_set(rule->weight[i])));
    }
    return vf_mul(vf_mul(arc->sine, width), sum);
}

/* The azimuth swept from one s to another, both with z > 0. */
BURNISH_INLINE vf polygon_azimuth(const polygon_arc *arc, vf from, vf to) {
    const vf one = vf_set(1.0f), half = vf_set(0.5f), quarter = vf_set(0.25f);
    const vf a = vf_mul(from, from), b = vf_mul(to, to);
    const vf y_a = vf_mul(from, polygon_root(vf_sub(one, vf_mul(quarter, a))));
    const vf y_b = vf_mul(to, polygon_root(vf_sub(one, vf_mul(quarter, b))));
    const vf x_a = vf_mul(arc->sine, vf_sub(one, vf_mul(half, a)));
    const vf x_b = vf_mul(arc->sine, vf_sub(one, vf_mul(half, b)));
    return vector_atan2(vf_sub(vf_mul(y_b, x_a), vf_mul(y_a, x_b)),
                        vf_add(vf_mul(x_a, x_b), vf_mul(y_a, y_b)));
}

/* sum + x where the mask holds, x with the sign of the edge's direction around the axis. */
BURNISH_INLINE vf polygon_add_where(vm mask, const polygon_arc *arc, vf sum, vf x) {
    const vf with_sign = vf_blend(arc->right, vf_sub(vf_set(0.0f), x), x);
    return vf_add(sum, vf_and_mask(mask, with_sign));
}

/* The part of an arc with z > 0 in the cap. */
BURNISH_INLINE void polygon_add_front(int order, const polygon_arc *arc, polygon_lobe *lobe) {
    const vf zero = vf_set(0.0f), two = vf_set(2.0f), least = vf_set(0x1p-80f);
    const vf peak = vf_sub(vf_set(1.0f), vf_mul(lobe->zeta, arc->one_less_cosine));
    const vm reaches = vm_and(arc->exists, vf_greater(peak, zero));
    if (!vm_any(reaches)) {
        return;
    }
    /* at the bound, u = 0 or c = 0 */
    const vf slope = vf_max(vf_mul(lobe->zeta, arc->cosine), least);
    const vf squared = vf_max(vf_min(vf_div(vf_mul(two, peak), slope), two), least);
    const vf high = polygon_root(squared), low = vf_sub(zero, high);
    const vf start = polygon_chord(arc->from.sine, arc->from.cosine);
    const vf end = polygon_chord(arc->to.sine, arc->to.cosine);
    const vm starts = vf_greater(arc->from.z, zero), ends = vf_greater(arc->to.z, zero);
    const vf from = vf_blend(starts, vf_max(low, vf_min(start, high)), low);
    const vf to = vf_blend(ends, vf_max(low, vf_min(end, high)), high);
    const vm lit = vm_and(vm_and(reaches, vm_or(starts, ends)), vf_greater(to, from));
    if (!vm_any(lit)) {
        return;
    }
    const vf smooth = vf_mul(lobe->zeta, polygon_integral(order, 0, arc, lobe->zeta, from, to));
    lobe->smooth = polygon_add_where(lit, arc, lobe->smooth, smooth);
    const vm partly = vm_and_not(lit, lobe->is_whole);
    if (vm_any(partly)) {
        const vf azimuth = polygon_azimuth(arc, from, to);
        lobe->azimuth = polygon_add_where(partly, arc, lobe->azimuth, azimuth);
    }
}

/* The part with z < 0, in the cap if zeta < 1. */
BURNISH_INLINE void polygon_add_back(int order, const polygon_arc *arc, polygon_lobe *lobe) {
    const vf zero = vf_set(0.0f), high = vf_set(1.41421356237f), low = vf_sub(zero, high);
    const vm starts = vf_greater(zero, arc->from.z), ends = vf_greater(zero, arc->to.z);
    const vf start = polygon_chord(arc->from.sine, vf_sub(zero, arc->from.cosine));
    const vf end = polygon_chord(arc->to.sine, vf_sub(zero, arc->to.cosine));
    const vf from = vf_blend(starts, vf_sub(zero, start), low);
    const vf to = vf_blend(ends, vf_sub(zero, end), high);
    const vm lit = vm_and(vm_and(arc->exists, vm_or(starts, ends)), vf_greater(to, from));
    if (vm_any(lit)) {
        const vf back = polygon_integral(order, 1, arc, lobe->zeta, from, to);
        lobe->azimuth = polygon_add_where(lit, arc, lobe->azimuth, back);
    }
}

/* ---- Edges ---- */

/* x / sin x of an angle between unit vectors, from its cosine and its squared sine. The polynomial
 * is acos(c) / sqrt(1 - c^2) in 1 - c for c in [0, 1], by Remez exchange to 9e-8. */
BURNISH_INLINE vf polygon_angle_by_sine(vf cosine, vf squared_sine) {
    const vf one = vf_set(1.0f), y = vf_sub(one, polygon_absolute(cosine));
    vf p = vf_set(0.01813491797728138f);
    p = vf_sub(vf_mul(p, y), vf_set(0.045185550965919405f));
    p = vf_add(vf_mul(p, y), vf_set(0.06488806861618446f));
    p = vf_sub(vf_mul(p, y), vf_set(0.02877375023385257f));
    p = vf_add(vf_mul(p, y), vf_set(0.04086082761148253f));
    p = vf_add(vf_mul(p, y), vf_set(0.05387707692090266f));
    p = vf_add(vf_mul(p, y), vf_set(0.13367489520911488f));
    p = vf_add(vf_mul(p, y), vf_set(0.3333196618427506f));
    p = vf_add(vf_mul(p, y), one);
    const vm obtuse = vf_greater(vf_set(0.0f), cosine);
    if (!vm_any(obtuse)) {
        return p;
    }
    const vf root = vector_inverse_sqrt(vf_max(squared_sine, vf_set(0x1p-60f)));
    return vf_blend(obtuse, vf_sub(vf_mul(vf_set(3.14159265358979f), root), p), p);
}

BURNISH_INLINE void polygon_add_edge(int order, const burnish_polygon_constants *polygon,
                                     const polygon_edge *edge, const polygon_point *at,
                                     polygon_sums *sums) {
    if (at->has_diffuse) {
        const vf angle = polygon_angle_by_sine(shade_dot(edge->from, edge->to),
                                               shade_dot(edge->cross, edge->cross));
        const vf diffuse = vf_mul(shade_dot(at->normal, edge->cross), angle);
        sums->diffuse = vf_add(sums->diffuse, vf_and_mask(edge->exists, diffuse));
    }
    if (polygon->lobe_count == 0) {
        return;
    }
    const polygon_arc arc = polygon_arc_of(edge);
    sums->inside = vm_and_not(sums->inside, vm_and(edge->exists, arc.right));
    sums->exists = vm_or(sums->exists, edge->exists);
    for (int j = 0; j < polygon->lobe_count; ++j) {
        polygon_add_front(order, &arc, &sums->lobes[j]);
        if (polygon->zeta[j] < 1.0f) {
            polygon_add_back(order, &arc, &sums->lobes[j]);
        }
    }
}

/* Cuts an edge at the horizon, and remembers where. */
BURNISH_INLINE void polygon_cut(polygon_edge *edge, vf height_a, vf height_b,
                                polygon_edge *horizon) {
    const vf zero = vf_set(0.0f);
    const vm up_a = vf_greater(height_a, zero), up_b = vf_greater(height_b, zero);
    const vm leaves = vm_and(edge->exists, vm_and_not(up_a, up_b));
    const vm enters = vm_and(edge->exists, vm_and_not(up_b, up_a));
    const vm cuts = vm_or(leaves, enters);
    if (!vm_any(cuts)) {
        return;
    }
    vf cut[3];
    for (int k = 0; k < 3; ++k) {
        cut[k] = vf_add(vf_mul(edge->from[k], polygon_absolute(height_b)),
                        vf_mul(edge->to[k], polygon_absolute(height_a)));
    }
    polygon_normalize(cut);
    for (int k = 0; k < 3; ++k) {
        edge->from[k] = vf_blend(enters, cut[k], edge->from[k]);
        edge->to[k] = vf_blend(leaves, cut[k], edge->to[k]);
        horizon->from[k] = vf_blend(leaves, cut[k], horizon->from[k]);
        horizon->to[k] = vf_blend(enters, cut[k], horizon->to[k]);
    }
    horizon->exists = vm_or(horizon->exists, cuts);
    polygon_cross(edge->from, edge->to, edge->cross);
}

/* All edges; where the horizon cuts, one more along the horizon. */
BURNISH_INLINE void polygon_edges(int order, const burnish_polygon_constants *polygon,
                                  const polygon_point *at, polygon_sums *sums) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const int count = polygon->vertex_count;
    const vf *a = at->vertex[count - 1];
    vf height_a = at->has_horizon ? shade_dot(at->normal, a) : one;
    polygon_edge horizon = {.exists = vf_greater(zero, zero)};
    for (int k = 0; k < 3; ++k) {
        horizon.from[k] = horizon.to[k] = horizon.normal[k] = at->normal[k];
    }
    for (int v = 0; v < count; ++v) {
        const vf *b = at->vertex[v];
        const vf height_b = at->has_horizon ? shade_dot(at->normal, b) : one;
        polygon_edge edge;
        polygon_cross(a, b, edge.normal);
        edge.exists =
            vm_and(at->faces, vm_or(vf_greater(height_a, zero), vf_greater(height_b, zero)));
        for (int k = 0; k < 3; ++k) {
            edge.from[k] = a[k];
            edge.to[k] = b[k];
            edge.cross[k] = edge.normal[k];
        }
        if (vm_any(edge.exists)) {
            polygon_cut(&edge, height_a, height_b, &horizon);
            polygon_add_edge(order, polygon, &edge, at, sums);
        }
        a = b;
        height_a = height_b;
    }
    if (vm_any(horizon.exists)) {
        polygon_cross(horizon.from, horizon.to, horizon.cross);
        polygon_add_edge(order, polygon, &horizon, at, sums);
    }
}

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

/* Whether the light shines on a point, and the mask of points behind it. In the plane of the light,
 * as well as rounding can tell, there is no light. */
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

/* Vectors in the frame, of unit length. */
BURNISH_INLINE void polygon_turn(const vf frame[3][3], const vf from[3], vf to[3]) {
    for (int k = 0; k < 3; ++k) {
        to[k] = shade_dot(frame[k], from);
    }
    polygon_normalize(to);
}

BURNISH_INLINE void polygon_load(const burnish_polygon_constants *polygon,
                                 const burnish_kernels_points *points, const float *const axis[3],
                                 size_t i, polygon_point *at) {
    vf frame[3][3], position[3], normal[3], w = vf_set(1.0f);
    for (int k = 0; k < 3; ++k) {
        frame[2][k] = axis[0] ? vf_load(axis[k] + i) : vf_set(k == 2 ? 1.0f : 0.0f);
        normal[k] = at->has_horizon ? vf_load(points->normal[k] + i) : vf_set(0.0f);
        position[k] = polygon->is_distant ? vf_set(0.0f) : vf_load(points->position[k] + i);
    }
    if (!polygon->is_distant && points->w) {
        w = vf_load(points->w + i);
    }
    const vm behind = polygon_side(polygon, position, w, &at->faces);
    const int turns = polygon->is_two_sided && vm_any(behind);
    polygon_frame(frame);
    polygon_turn((const vf(*)[3])frame, normal, at->normal);
    for (int v = 0; v < polygon->vertex_count; ++v) {
        const float *front = polygon->vertex[v];
        const float *back = polygon->vertex[polygon->vertex_count - 1 - v];
        vf to_vertex[3];
        for (int k = 0; k < 3; ++k) {
            vf vertex = vf_set(front[k]);
            if (turns) {
                vertex = vf_blend(behind, vf_set(back[k]), vertex);
            }
            to_vertex[k] = vf_sub(vf_mul(w, vertex), position[k]);
        }
        polygon_turn((const vf(*)[3])frame, to_vertex, at->vertex[v]);
    }
}

BURNISH_INLINE void polygon_begin(const burnish_polygon_constants *polygon, const polygon_point *at,
                                  polygon_sums *sums) {
    const vf zero = vf_set(0.0f);
    vf lowest = at->vertex[0][2];
    for (int v = 1; v < polygon->vertex_count; ++v) {
        lowest = vf_min(lowest, at->vertex[v][2]);
    }
    sums->diffuse = zero;
    sums->exists = vf_greater(zero, zero);
    sums->inside = at->faces;
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const vf zeta = vf_set(polygon->zeta[j]);
        const vf u = vf_sub(vf_set(1.0f), vf_mul(zeta, vf_sub(vf_set(1.0f), lowest)));
        const vm is_whole = vm_and(vf_greater(u, zero), vf_greater(lowest, zero));
        sums->lobes[j] = (polygon_lobe){zeta, zero, zero, is_whole};
    }
}

/* One vector of points. */
BURNISH_INLINE void polygon_points(int order, const burnish_polygon_constants *polygon,
                                   const burnish_kernels_points *points, const float *const axis[3],
                                   size_t i, float *const light[2]) {
    const vf one = vf_set(1.0f), turn = vf_set(0.159154943091895f); /* 1 / (2 pi) */
    vf specular = vf_set(0.0f);
    polygon_point at = {.has_horizon = points->normal[0] != NULL, .has_diffuse = light[0] != NULL};
    polygon_sums sums;
    polygon_load(polygon, points, axis, i, &at);
    polygon_begin(polygon, &at, &sums);
    if (vm_any(at.faces)) {
        polygon_edges(order, polygon, &at, &sums);
    }
    if (light[0]) {
        vf_store(light[0] + i, vector_saturate(vf_mul(sums.diffuse, turn)));
    }
    const vf inside = vf_and_mask(vm_and(sums.inside, sums.exists), one);
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const polygon_lobe *lobe = &sums.lobes[j];
        const vf swept = vf_sub(inside, vf_mul(lobe->azimuth, turn));
        const vf share =
            vf_add(vf_and_mask(vm_not(lobe->is_whole), swept), vf_mul(lobe->smooth, turn));
        specular = vf_add(specular, vf_mul(vf_set(polygon->weight[j]), vector_saturate(share)));
    }
    if (light[1]) {
        vf_store(light[1] + i, specular);
    }
}

/* Fewer points than a vector has. */
BURNISH_INLINE void polygon_rest(int order, const burnish_polygon_constants *polygon,
                                 const burnish_kernels_points *points, const float *const axis[3],
                                 size_t first, size_t count, float *const light[2]) {
    enum { ARRAYS = 10 };
    float block[ARRAYS][LANES];
    burnish_kernels_points padded = *points;
    const float *axes[3] = {axis[0], axis[1], axis[2]};
    const float **to[ARRAYS] = {&padded.normal[0],
                                &padded.normal[1],
                                &padded.normal[2],
                                &padded.position[0],
                                &padded.position[1],
                                &padded.position[2],
                                &padded.w,
                                &axes[0],
                                &axes[1],
                                &axes[2]};
    float *const blocks[2] = {light[0] ? block[0] : NULL, light[1] ? block[1] : NULL};
    memset(block, 0, sizeof block);
    for (int k = 0; k < ARRAYS; ++k) {
        if (*to[k]) {
            memcpy(block[k], *to[k] + first, count * sizeof(float));
            *to[k] = block[k];
        }
    }
    polygon_points(order, polygon, &padded, axes, 0, blocks);
    for (int k = 0; k < 2; ++k) {
        if (light[k]) {
            memcpy(light[k] + first, block[k], count * sizeof(float));
        }
    }
}

BURNISH_INLINE void polygon_array(int order, const burnish_polygon_constants *polygon,
                                  const burnish_kernels_points *points, const float *const axis[3],
                                  size_t count, float *const light[2]) {
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        polygon_points(order, polygon, points, axis, i, light);
    }
    if (i < count) {
        polygon_rest(order, polygon, points, axis, i, count - i, light);
    }
}

/* ---- The kernels ---- */

#define POLYGON_FUNCTION(name, order)                                                              \
    static void polygon_##name(const burnish_polygon_constants *polygon,                           \
                               const burnish_kernels_points *points, const float *const axis[3],   \
                               size_t count, float *const light[2]) {                              \
        polygon_array(order, polygon, points, axis, count, light);                                 \
    }
POLYGON_FUNCTION(square, 0)
POLYGON_FUNCTION(fourth, 1)
POLYGON_FUNCTION(eighth, 2)
#undef POLYGON_FUNCTION

#endif
