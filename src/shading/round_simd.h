/* Spheres as caps of directions: their diffuse light, and the contour integral of
 * polygon_edges_simd.h along a small circle.
 *
 * A cap has the unit vector d as its middle and the half angle b; the lobe's axis is at the angle a
 * from d, and the circle's point nearest to it at t = 0. With s = sin(t/2)
 *
 *   1 - c = 1 - cos(a - b) + 2 sin a sin b s^2
 *   dphi  = sin b (sin(b - a) + 2 cos b sin a s^2) / (1 - c^2) dt
 *
 * The horizon cuts the circle at two points at most; an edge between them closes the contour.
 *
 * Largest error of 84,000 random caps, as shares of the lobe: 1.4e-5 for zeta up to 200, 3.5e-5 up
 * to 20000; of diffuse light 8.1e-8 (test_round --trials 2000). */
#ifndef BURNISH_SHADING_ROUND_SIMD_H
#define BURNISH_SHADING_ROUND_SIMD_H

#include "shading/polygon_edges_simd.h"

/* Seen from a point. */
typedef struct round_cap {
    vf middle[3], sine, cosine; /* d; of b */
} round_cap;

/* 1/pi of the cosine's integral over the part of a cap above the horizon; facing = N.d. The cut
 * cap: Lagarde and de Rousiers, Moving Frostbite to Physically Based Rendering, 2014. */
BURNISH_INLINE vf round_diffuse(const round_cap *cap, vf facing) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), least = vf_set(0x1p-60f);
    const vf squared = vf_mul(cap->sine, cap->sine), whole = vf_mul(facing, squared);
    const vm is_cut = vf_greater(cap->sine, polygon_absolute(facing));
    if (!vm_any(is_cut)) {
        return vf_max(whole, zero);
    }
    const vf side = polygon_root(vf_max(vf_sub(one, vf_mul(facing, facing)), least));
    const vf ratio = vf_div(vf_mul(cap->cosine, facing), vf_mul(cap->sine, side));
    const vf y = vf_sub(zero, vf_max(vf_min(ratio, one), vf_set(-1.0f)));
    const vf root = polygon_root(vf_max(vf_sub(one, vf_mul(y, y)), least));
    const vf across = vf_mul(vf_mul(side, root), cap->sine);
    const vf above = vf_sub(vf_mul(whole, vector_atan2(root, y)), vf_mul(across, cap->cosine));
    const vf cut =
        vf_mul(vf_add(above, vector_atan2(across, cap->cosine)), vf_set(0.318309886183791f));
    return vf_max(vf_blend(is_cut, cut, whole), zero);
}

/* ---- Lobes ---- */

/* A cap in a lobe's frame. */
typedef struct round_circle {
    vf sine, cosine;           /* of b */
    vf axis_sine, axis_cosine; /* of a */
    vf across[2];              /* the x and y of d, as a unit vector */
    vf ahead;                  /* sin(a - b) */
    vf least, span;            /* 1 - c at t = 0; 2 sin a sin b */
    vf from[2], to[2];         /* the arcs above the horizon, in t/2 */
    int is_cut;                /* 0: the whole circle is, -pi/2 to pi/2, and only the first arc */
    vm faces;
} round_circle;

/* sin x for abs(x) <= pi/2, within 1e-7: Remez exchange to 5e-9. */
BURNISH_INLINE vf round_sine(vf x) {
    const vf z = vf_mul(x, x);
    vf p = vf_set(2.600054768065832e-6f);
    p = vf_sub(vf_mul(p, z), vf_set(1.980661520144002e-4f));
    p = vf_add(vf_mul(p, z), vf_set(0.00833301729156356f));
    p = vf_sub(vf_mul(p, z), vf_set(0.16666657096504758f));
    return vf_add(x, vf_mul(x, vf_mul(p, z)));
}

BURNISH_INLINE void round_circle_begin(const round_cap *cap, const vf middle[3],
                                       round_circle *circle) {
    const vf one = vf_set(1.0f), zero = vf_set(0.0f);
    const vf flat = vf_add(vf_mul(middle[0], middle[0]), vf_mul(middle[1], middle[1]));
    const vf inverse = vector_inverse_sqrt(vf_max(flat, vf_set(0x1p-80f)));
    const vm is_on_axis = vf_greater(vf_set(0x1p-60f), flat);
    circle->sine = cap->sine;
    circle->cosine = cap->cosine;
    circle->axis_sine = vf_and_mask(vm_not(is_on_axis), vf_mul(flat, inverse));
    circle->axis_cosine = middle[2];
    circle->across[0] = vf_blend(is_on_axis, one, vf_mul(middle[0], inverse));
    circle->across[1] = vf_and_mask(vm_not(is_on_axis), vf_mul(middle[1], inverse));
    circle->ahead = vf_sub(vf_mul(circle->axis_sine, circle->cosine),
                           vf_mul(circle->axis_cosine, circle->sine));
    const vf product = vf_mul(circle->axis_sine, circle->sine);
    const vf nearest = vf_add(vf_mul(circle->axis_cosine, circle->cosine), product);
    const vf small = vf_div(vf_mul(circle->ahead, circle->ahead), vf_add(one, nearest));
    circle->least = vf_blend(vf_greater(nearest, zero), small, vf_sub(one, nearest));
    circle->span = vf_add(product, product);
}

/* A point of the circle, from the cosine and sine of its t. */
BURNISH_INLINE void round_point(const round_circle *circle, vf cosine, vf sine, vf point[3]) {
    const vf out = vf_mul(circle->sine, cosine), side = vf_mul(circle->sine, sine);
    const vf x = vf_sub(vf_mul(circle->cosine, circle->axis_sine),
                        vf_mul(out, circle->axis_cosine)); /* toward d; -y is side */
    const vf *across = circle->across;
    point[0] = vf_add(vf_mul(x, across[0]), vf_mul(side, across[1]));
    point[1] = vf_sub(vf_mul(x, across[1]), vf_mul(side, across[0]));
    point[2] = vf_add(vf_mul(circle->cosine, circle->axis_cosine), vf_mul(out, circle->axis_sine));
    polygon_normalize(point);
    polygon_avoid_axis(point);
}

/* Finds the arcs above the horizon, and the edge along it. */
BURNISH_INLINE void round_cut(const vf normal[3], round_circle *circle, polygon_edge *horizon) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), half = vf_set(0.5f);
    const vf pi = vf_set(3.14159265358979f), quarter = vf_set(1.57079632679490f);
    const vf *across = circle->across;
    const vf x = vf_add(vf_mul(normal[0], across[0]), vf_mul(normal[1], across[1]));
    const vf first = vf_sub(vf_mul(circle->axis_sine, normal[2]), vf_mul(circle->axis_cosine, x));
    const vf second = vf_sub(vf_mul(normal[0], across[1]), vf_mul(normal[1], across[0]));
    const vf facing = vf_add(vf_mul(circle->axis_cosine, normal[2]), vf_mul(circle->axis_sine, x));
    const vf squared = vf_add(vf_mul(first, first), vf_mul(second, second));
    const vf inverse = vector_inverse_sqrt(vf_max(squared, vf_set(0x1p-80f)));
    const vf height = vf_mul(circle->cosine, facing);
    const vf reach = vf_mul(circle->sine, vf_mul(squared, inverse));
    const vm is_cut = vm_and(vf_greater(reach, polygon_absolute(height)), circle->faces);
    circle->faces = vm_and(circle->faces, vm_or(is_cut, vf_greater(height, zero)));
    circle->from[0] = vf_sub(zero, quarter);
    circle->to[0] = quarter;
    circle->from[1] = circle->to[1] = zero;
    horizon->exists = is_cut;
    circle->is_cut = vm_any(is_cut);
    if (!circle->is_cut) {
        return;
    }
    const vf c = vf_mul(first, inverse), s = vf_mul(second, inverse);
    const vf ratio = vf_div(vf_sub(zero, height), vf_max(reach, vf_set(0x1p-80f)));
    const vf k = vf_max(vf_min(ratio, one), vf_set(-1.0f));
    const vf q = polygon_root(vf_max(vf_sub(one, vf_mul(k, k)), vf_set(0x1p-60f)));
    const vf middle = vector_atan2(s, c), width = vector_atan2(q, k);
    const vf from = vf_mul(half, vf_sub(middle, width)), to = vf_mul(half, vf_add(middle, width));
    /* the other arc is the same one half a turn away */
    const vf shift = vf_blend(vf_greater(circle->from[0], from), pi, vf_sub(zero, pi));
    circle->from[0] = vf_blend(is_cut, from, circle->from[0]);
    circle->to[0] = vf_blend(is_cut, to, circle->to[0]);
    circle->from[1] = vf_and_mask(is_cut, vf_add(from, shift));
    circle->to[1] = vf_and_mask(is_cut, vf_add(to, shift));
    round_point(circle, vf_sub(vf_mul(c, k), vf_mul(s, q)), vf_add(vf_mul(s, k), vf_mul(c, q)),
                horizon->from);
    round_point(circle, vf_add(vf_mul(c, k), vf_mul(s, q)), vf_sub(vf_mul(s, k), vf_mul(c, q)),
                horizon->to);
    for (int i = 0; i < 3; ++i) {
        horizon->normal[i] = normal[i];
    }
}

/* (1 - u^(m+1)) dphi / (zeta sin b dt) */
BURNISH_INLINE vf round_at(const burnish_polygon_lobe *lobe, const round_circle *circle,
                           vf half_t) {
    const vf sine = round_sine(half_t), squared = vf_mul(sine, sine);
    const vf lambda = vf_add(circle->least, vf_mul(circle->span, squared));
    const vf u = vf_sub(vf_set(1.0f), vf_mul(vf_set(lobe->zeta), lambda));
    const vf turn = vf_mul(vf_mul(circle->cosine, circle->axis_sine), vf_add(squared, squared));
    const vf sum = polygon_sum(lobe, u);
    return vf_div(vf_mul(sum, vf_sub(turn, circle->ahead)), vf_sub(vf_set(2.0f), lambda));
}

/* The integral of round_at() from t = 0, over dt. It is odd in t, and round_at() even: one half of
 * Gauss's nodes is enough, or all of them for high orders. */
BURNISH_INLINE vf round_integral(const burnish_polygon_lobe *lobe, const round_circle *circle,
                                 vf half_t) {
    static const polygon_rule *const rules[6] = {&POLYGON_8,  &POLYGON_11, &POLYGON_15,
                                                 &POLYGON_16, &POLYGON_16, &POLYGON_16};
    const polygon_rule *rule = rules[lobe->squarings];
    const int is_half = lobe->squarings < 4;
    const vf width = is_half ? half_t : vf_mul(half_t, vf_set(0.5f));
    vf sum = vf_set(0.0f);
    if (rule->middle > 0.0f) {
        sum = vf_mul(round_at(lobe, circle, vf_set(0.0f)), vf_set(0.5f * rule->middle));
    }
    for (int i = 0; i < rule->pairs; ++i) {
        const vf step = vf_mul(width, vf_set(rule->node[i]));
        vf value = round_at(lobe, circle, is_half ? step : vf_add(width, step));
        if (!is_half) {
            value = vf_add(value, round_at(lobe, circle, vf_sub(width, step)));
        }
        sum = vf_add(sum, vf_mul(value, vf_set(rule->weight[i])));
    }
    return vf_mul(vf_mul(sum, width), vf_set(2.0f));
}

/* The azimuth around the lobe's axis, from t = 0. */
BURNISH_INLINE vf round_azimuth(const round_circle *circle, vf half_t) {
    const vf zero = vf_set(0.0f), two = vf_set(2.0f);
    const vf sine = round_sine(half_t), squared = vf_mul(sine, sine);
    const vf cosine = polygon_root(vf_max(vf_sub(vf_set(1.0f), squared), vf_set(0x1p-60f)));
    const vf doubled = vf_mul(two, vf_mul(circle->sine, circle->axis_cosine));
    const vf x = vf_add(circle->ahead, vf_mul(doubled, squared));
    const vf y = vf_mul(vf_mul(two, circle->sine), vf_mul(sine, cosine));
    const vm inside = vf_greater(zero, circle->ahead);
    const vf angle = vector_atan2(y, vf_blend(inside, vf_sub(zero, x), x));
    return vf_blend(inside, angle, vf_sub(zero, angle));
}

BURNISH_INLINE void round_add_lobe(const burnish_polygon_lobe *lobe, const round_circle *circle,
                                   polygon_share *share) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf zeta = vf_set(lobe->zeta), peak = vf_sub(one, vf_mul(zeta, circle->least));
    const vm reaches = vm_and(circle->faces, vf_greater(peak, zero));
    if (!vm_any(reaches)) {
        return;
    }
    /* sin^2(t/2) at the end of the lobe */
    const vf ratio = vf_div(peak, vf_max(vf_mul(zeta, circle->span), vf_set(0x1p-80f)));
    const vf squared = vf_max(vf_min(ratio, one), vf_set(0x1p-80f));
    const vf high = vector_atan2(polygon_root(squared),
                                 polygon_root(vf_max(vf_sub(one, squared), vf_set(0x1p-80f))));
    const vf low = vf_sub(zero, high);
    for (int i = 0; i < (circle->is_cut ? 2 : 1); ++i) {
        const vf from = vf_max(circle->from[i], low), to = vf_min(circle->to[i], high);
        const vm lit = vm_and(reaches, vf_greater(to, from));
        const vm partly = vm_and_not(lit, share->is_whole);
        if (!vm_any(lit)) {
            continue;
        }
        const vf end = round_integral(lobe, circle, to);
        const vf start = circle->is_cut ? round_integral(lobe, circle, from) : vf_sub(zero, end);
        const vf smooth = vf_mul(vf_mul(zeta, circle->sine), vf_sub(end, start));
        share->smooth = vf_add(share->smooth, vf_and_mask(lit, smooth));
        if (vm_any(partly)) {
            const vf last = round_azimuth(circle, to);
            const vf first = circle->is_cut ? round_azimuth(circle, from) : vf_sub(zero, last);
            share->azimuth = vf_add(share->azimuth, vf_and_mask(partly, vf_sub(last, first)));
        }
    }
}

#endif
