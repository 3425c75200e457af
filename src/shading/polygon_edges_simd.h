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
 * add up to `inside`. Both are then omitted, because small lights would lose digits.
 *
 * An edge's great circle has a unit normal n, sin d = abs(n.z) and k = cos d. With t, the angle from
 * its point nearest to the axis: c = k cos t, dphi = sin d / (1 - c^2) dt. With s = 2 sin(t/2)
 *
 *   1 - c = (1 - k) + k s^2 / 2,  dt = ds / sqrt(1 - s^2 / 4)
 *
 * which keeps the digits of 1 - c for narrow lobes and needs no sine.
 *
 * Lanes never mix. Work that no lane needs is skipped; for a lane that does not need it, its result is
 * exactly 0 anyway. */
#ifndef BURNISH_SHADING_POLYGON_EDGES_SIMD_H
#define BURNISH_SHADING_POLYGON_EDGES_SIMD_H

#include "shading/polygon.h"
#include "shading/shade_simd.h"

/* Gauss's rule: one half of its nodes, and the weight of the middle, 0 for even numbers of nodes. */
enum { POLYGON_PAIRS_MAX = 8 };
typedef struct polygon_rule {
    int pairs;
    float middle;
    float node[POLYGON_PAIRS_MAX], weight[POLYGON_PAIRS_MAX];
} polygon_rule;

static const polygon_rule POLYGON_3 = {1, 0.888888889f, {0.774596669f}, {0.555555556f}};
static const polygon_rule POLYGON_4 = {
    2, 0.0f, {0.861136312f, 0.339981044f}, {0.347854845f, 0.652145155f}};
static const polygon_rule POLYGON_5 = {
    2, 0.568888889f, {0.906179846f, 0.53846931f}, {0.236926885f, 0.47862867f}};
static const polygon_rule POLYGON_8 = {4,
                                       0.0f,
                                       {0.960289856f, 0.796666477f, 0.52553241f, 0.183434642f},
                                       {0.101228536f, 0.222381034f, 0.313706646f, 0.362683783f}};
static const polygon_rule POLYGON_11 = {
    5,
    0.272925087f,
    {0.978228658f, 0.8870626f, 0.730152006f, 0.519096129f, 0.269543156f},
    {0.0556685671f, 0.125580369f, 0.186290211f, 0.233193765f, 0.262804545f}};
static const polygon_rule POLYGON_15 = {7,
                                        0.202578242f,
                                        {0.987992518f, 0.937273392f, 0.848206583f, 0.724417731f,
                                         0.570972173f, 0.394151347f, 0.201194094f},
                                        {0.030753242f, 0.0703660475f, 0.10715922f, 0.139570678f,
                                         0.166269206f, 0.186161f, 0.198431485f}};
static const polygon_rule POLYGON_16 = {8,
                                        0.0f,
                                        {0.989400935f, 0.944575023f, 0.865631202f, 0.755404408f,
                                         0.617876244f, 0.458016778f, 0.281603551f, 0.0950125098f},
                                        {0.0271524594f, 0.0622535239f, 0.0951585117f, 0.124628971f,
                                         0.149595989f, 0.169156519f, 0.182603415f, 0.18945061f}};

/* For wide and narrow lobes, by order. */
static const polygon_rule *const POLYGON_RULES[2][6] = {
    {&POLYGON_5, &POLYGON_5, &POLYGON_5, &POLYGON_8, &POLYGON_11, &POLYGON_16},
    {&POLYGON_3, &POLYGON_4, &POLYGON_5, &POLYGON_8, &POLYGON_11, &POLYGON_15}};

/* Integrals of one lobe, times 2 pi. */
typedef struct polygon_share {
    vf smooth, azimuth;
    vm is_whole; /* the cap contains all vertices */
} polygon_share;

typedef struct polygon_sums {
    vf diffuse;
    vm inside, exists; /* the axis is on the polygon's side of all edges so far; there is one */
    polygon_share lobes[BURNISH_POLYGON_LOBE_MAX];
} polygon_sums;

/* An arc of a great circle, shorter than half of it, between unit vectors. */
typedef struct polygon_edge {
    vf from[3], to[3];
    vf normal[3]; /* of the circle, of any length; the polygon is on its side */
    vm exists;
} polygon_edge;

/* An end of an arc: its z, sine and cosine of its t, and s if z > 0. */
typedef struct polygon_end {
    vf z, sine, cosine, s;
} polygon_end;

/* What all lobes need of an edge. */
typedef struct polygon_arc {
    vf sine, cosine;    /* sin d, k */
    vf one_less_cosine; /* 1 - k */
    vf flat, squared;   /* of the normal: x^2 + y^2, and z^2 more */
    vf bend[3];         /* coefficients of a quadratic in s^2 near s = 0: dt / ((1 + c) ds) */
    polygon_end from, to;
    vm passes; /* the arc contains t = 0 */
    vm right;  /* the axis is not on the polygon's side */
    vm exists;
} polygon_arc;

/* One vector of points, for diffuse light in the axes of the scene, for lobes in their frames. */
typedef struct polygon_point {
    vf normal[3];                             /* unit vector */
    vf vertex[BURNISH_POLYGON_VERTEX_MAX][3]; /* unit vectors, in counterclockwise order */
    vf lowest;                                /* z of the vertices */
    vm faces;                                 /* the light shines here */
    int has_horizon, is_diffuse;
} polygon_point;

BURNISH_INLINE vf polygon_absolute(vf x) {
    return vf_from_bits(vi_and(vf_bits(x), vi_set(0x7fffffff)));
}

BURNISH_INLINE vf polygon_root(vf x) {
    return vf_mul(x, vector_inverse_sqrt(x));
}

/* a x b = a x (b - a) = b x (b - a) keeps the digits of short edges. With the end nearer to the axis
 * in front, its z is exact relative to the distance of that end from the axis: a corner that an axis
 * meets is then at the same azimuth for both of its edges. */
BURNISH_INLINE void polygon_cross(const vf a[3], const vf b[3], vf cross[3]) {
    const vm a_is_nearer = vf_greater(a[2], b[2]);
    vf d[3], nearer[3];
    for (int k = 0; k < 3; ++k) {
        d[k] = vf_sub(b[k], a[k]);
        nearer[k] = vf_blend(a_is_nearer, a[k], b[k]);
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cross[k] = vf_sub(vf_mul(nearer[i], d[j]), vf_mul(nearer[j], d[i]));
    }
}

BURNISH_INLINE void polygon_normalize(vf a[3]) {
    const vf scale = vector_inverse_sqrt(shade_dot(a, a));
    for (int k = 0; k < 3; ++k) {
        a[k] = vf_mul(a[k], scale);
    }
}

/* ---- Lobes ---- */

/* s = 2 sin(t/2) from the sine and a cosine that is not negative. */
BURNISH_INLINE vf polygon_chord(vf sine, vf cosine) {
    const vf half = vf_set(0.5f), c = vf_max(cosine, vf_set(0.0f));
    return vf_mul(sine, vector_inverse_sqrt(vf_add(half, vf_mul(half, c))));
}

/* The sine of an end's t, times the length of (n.x, n.y). */
BURNISH_INLINE vf polygon_along(const vf end[3], const vf n[3]) {
    return vf_sub(vf_mul(end[0], n[1]), vf_mul(end[1], n[0]));
}

/* The part of an arc that polygon_reaches() reads. */
BURNISH_INLINE polygon_arc polygon_arc_begin(const polygon_edge *edge) {
    const vf *n = edge->normal, zero = vf_set(0.0f);
    polygon_arc arc = {.exists = edge->exists, .right = vf_greater(zero, n[2])};
    arc.flat = vf_max(vf_add(vf_mul(n[0], n[0]), vf_mul(n[1], n[1])), vf_set(0x1p-80f));
    arc.squared = vf_add(arc.flat, vf_mul(n[2], n[2]));
    arc.from = (polygon_end){.z = edge->from[2], .sine = polygon_along(edge->from, n)};
    arc.to = (polygon_end){.z = edge->to[2], .sine = polygon_along(edge->to, n)};
    arc.passes = vm_and(vf_greater(zero, arc.from.sine), vf_greater(arc.to.sine, zero));
    return arc;
}

/* Whether an arc has a part with z > 0 in the cap. */
BURNISH_INLINE vm polygon_reaches(const burnish_polygon_lobe *lobe, const polygon_arc *arc) {
    const vf least = vf_set(lobe->least_cosine), bound = vf_set(lobe->least_cosine_squared);
    const vm ends = vm_or(vf_greater(arc->from.z, least), vf_greater(arc->to.z, least));
    const vm circle = vf_greater(arc->flat, vf_mul(bound, arc->squared));
    return vm_and(vm_and(arc->exists, circle), vm_or(ends, arc->passes));
}

BURNISH_INLINE void polygon_end_finish(polygon_end *end, vf inverse_flat, vf by_cosine) {
    end->sine = vf_mul(end->sine, inverse_flat);
    end->cosine = vf_mul(end->z, by_cosine);
    end->s = polygon_chord(end->sine, end->cosine);
}

BURNISH_INLINE void polygon_arc_finish(polygon_arc *arc, vf normal_z) {
    const vf one = vf_set(1.0f);
    const vf inverse = vector_inverse_sqrt(arc->squared);
    const vf inverse_flat = vector_inverse_sqrt(arc->flat);
    const vf by_cosine = vf_mul(vf_mul(arc->squared, inverse), inverse_flat);
    arc->sine = vf_mul(polygon_absolute(normal_z), inverse);
    arc->cosine = vf_mul(vf_mul(arc->flat, inverse_flat), inverse);
    const vf first = vf_div(one, vf_add(one, arc->cosine));
    arc->one_less_cosine = vf_mul(vf_mul(arc->sine, arc->sine), first);
    /* 1 / ((1 + c) cos(t/2)) with c = k - k s^2 / 2, to the second order */
    const vf slope = vf_mul(vf_mul(vf_set(0.5f), arc->cosine), first);
    arc->bend[0] = first;
    arc->bend[1] = vf_mul(first, vf_add(vf_set(0.125f), slope));
    arc->bend[2] =
        vf_mul(first, vf_add(vf_set(0.0234375f), vf_mul(slope, vf_add(vf_set(0.125f), slope))));
    polygon_end_finish(&arc->from, inverse_flat, by_cosine);
    polygon_end_finish(&arc->to, inverse_flat, by_cosine);
}

/* 1 + u + ... + u^m, and u^m. */
BURNISH_INLINE vf polygon_powers(int squarings, vf u, vf *power) {
    const vf one = vf_set(1.0f);
    vf sum = one;
    *power = u;
    for (int k = 0; k < squarings; ++k) {
        sum = vf_mul(sum, vf_add(one, *power));
        *power = vf_mul(*power, *power);
    }
    return vf_add(sum, *power);
}

/* 1 + u + ... + u^m. A composite is a sum of even powers, with weights by their energies: so is
 * this. */
BURNISH_INLINE vf polygon_sum(const burnish_polygon_lobe *lobe, vf u) {
    const vf w = vf_mul(u, u);
    vf sum;
    if (lobe->terms == 0) {
        return polygon_powers(lobe->squarings, u, &sum);
    }
    sum = vf_set(lobe->term[lobe->terms - 1]);
    for (int i = lobe->terms - 2; i >= 0; --i) {
        sum = vf_add(vf_mul(sum, w), vf_set(lobe->term[i]));
    }
    return vf_add(vf_set(1.0f), vf_mul(vf_add(u, w), sum));
}

/* (1 + u + ... + u^m) (1 - c) dphi / (sin d ds) */
BURNISH_INLINE vf polygon_front(const burnish_polygon_lobe *lobe, const polygon_arc *arc, vf s) {
    const vf one = vf_set(1.0f), squared = vf_mul(s, s);
    const vf half_cosine = vf_mul(vf_set(0.5f), arc->cosine);
    const vf lambda = vf_add(arc->one_less_cosine, vf_mul(half_cosine, squared));
    vf bend;
    const vf sum = polygon_sum(lobe, vf_sub(one, vf_mul(vf_set(lobe->zeta), lambda)));
    if (lobe->is_narrow) {
        bend = vf_add(vf_mul(arc->bend[2], squared), arc->bend[1]);
        return vf_mul(sum, vf_add(vf_mul(bend, squared), arc->bend[0]));
    }
    const vf one_and_c = vf_sub(vf_set(2.0f), lambda);
    bend = vf_sub(one, vf_mul(vf_set(0.25f), squared));
    return vf_mul(sum, vector_inverse_sqrt(vf_mul(bend, vf_mul(one_and_c, one_and_c))));
}

/* max(0, u)^(m+1) dphi / (sin d ds), with s from the point farthest from the axis. */
BURNISH_INLINE vf polygon_back(const burnish_polygon_lobe *lobe, const polygon_arc *arc, vf s) {
    const vf one = vf_set(1.0f), squared = vf_mul(s, s);
    const vf half_cosine = vf_mul(vf_set(0.5f), arc->cosine);
    const vf one_and_c =
        vf_max(vf_add(arc->one_less_cosine, vf_mul(half_cosine, squared)), vf_set(0x1p-30f));
    const vf lambda = vf_sub(vf_set(2.0f), one_and_c);
    const vf u = vf_max(vf_sub(one, vf_mul(vf_set(lobe->zeta), lambda)), vf_set(0.0f));
    const vf bend = vf_sub(one, vf_mul(vf_set(0.25f), squared));
    vf power;
    (void)polygon_powers(lobe->squarings, u, &power);
    return vf_mul(vf_div(vf_mul(u, power), vf_mul(one_and_c, lambda)), vector_inverse_sqrt(bend));
}

BURNISH_INLINE vf polygon_at(const burnish_polygon_lobe *lobe, int is_back, const polygon_arc *arc,
                             vf s) {
    return is_back ? polygon_back(lobe, arc, s) : polygon_front(lobe, arc, s);
}

/* sin d times the integral of polygon_front or polygon_back over [from, to]. */
BURNISH_INLINE vf polygon_integral(const burnish_polygon_lobe *lobe, int is_back,
                                   const polygon_arc *arc, vf from, vf to) {
    const polygon_rule *rule = POLYGON_RULES[lobe->is_narrow][lobe->squarings];
    const vf half = vf_set(0.5f);
    const vf middle = vf_mul(half, vf_add(from, to)), width = vf_mul(half, vf_sub(to, from));
    vf sum = vf_set(0.0f);
    if (rule->middle > 0.0f) {
        sum = vf_mul(polygon_at(lobe, is_back, arc, middle), vf_set(rule->middle));
    }
    for (int i = 0; i < rule->pairs; ++i) {
        const vf step = vf_mul(width, vf_set(rule->node[i]));
        const vf before = polygon_at(lobe, is_back, arc, vf_sub(middle, step));
        const vf after = polygon_at(lobe, is_back, arc, vf_add(middle, step));
        sum = vf_add(sum, vf_mul(vf_add(before, after), vf_set(rule->weight[i])));
    }
    return vf_mul(vf_mul(arc->sine, width), sum);
}

/* sum + x where the mask holds, x with the sign of the edge's direction around the axis. */
BURNISH_INLINE vf polygon_add_where(vm mask, const polygon_arc *arc, vf sum, vf x) {
    const vf with_sign = vf_blend(arc->right, vf_sub(vf_set(0.0f), x), x);
    return vf_add(sum, vf_and_mask(mask, with_sign));
}

/* The part of an arc with z > 0 in the cap. */
BURNISH_INLINE void polygon_add_front(const burnish_polygon_lobe *lobe, const polygon_arc *arc,
                                      vm reaches, polygon_share *share) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), two = vf_set(2.0f), least = vf_set(0x1p-80f);
    if (!vm_any(reaches)) {
        return;
    }
    /* at the bound, u = 0 or c = 0 */
    const vf zeta = vf_set(lobe->zeta), peak = vf_sub(one, vf_mul(zeta, arc->one_less_cosine));
    const vf ratio = vf_div(vf_mul(two, peak), vf_max(vf_mul(zeta, arc->cosine), least));
    const vf squared = vf_max(vf_min(ratio, two), least);
    const vf high = polygon_root(squared), low = vf_sub(zero, high);
    const vm starts = vf_greater(arc->from.z, zero), ends = vf_greater(arc->to.z, zero);
    const vf from = vf_blend(starts, vf_max(low, vf_min(arc->from.s, high)), low);
    const vf to = vf_blend(ends, vf_max(low, vf_min(arc->to.s, high)), high);
    const vm lit = vm_and(reaches, vf_greater(to, from));
    if (!vm_any(lit)) {
        return;
    }
    const vf smooth = vf_mul(zeta, polygon_integral(lobe, 0, arc, from, to));
    share->smooth = polygon_add_where(lit, arc, share->smooth, smooth);
    const vm partly = vm_and_not(lit, share->is_whole);
    if (!vm_any(partly)) {
        return;
    }
    const vf quarter = vf_mul(vf_set(0.25f), squared);
    const vf high_cosine = vf_sub(one, vf_add(quarter, quarter));
    const vf high_sine = vf_mul(high, polygon_root(vf_sub(one, quarter)));
    const vf low_sine = vf_sub(zero, high_sine);
    const vf y_from =
        vf_blend(starts, vf_max(low_sine, vf_min(arc->from.sine, high_sine)), low_sine);
    const vf y_to = vf_blend(ends, vf_max(low_sine, vf_min(arc->to.sine, high_sine)), high_sine);
    const vf x_from = vf_mul(arc->sine, vf_max(arc->from.cosine, high_cosine));
    const vf x_to = vf_mul(arc->sine, vf_max(arc->to.cosine, high_cosine));
    const vf azimuth = vector_atan2(vf_sub(vf_mul(y_to, x_from), vf_mul(y_from, x_to)),
                                    vf_add(vf_mul(x_from, x_to), vf_mul(y_from, y_to)));
    share->azimuth = polygon_add_where(partly, arc, share->azimuth, azimuth);
}

/* The part with z < 0, in the cap if zeta < 1. */
BURNISH_INLINE void polygon_add_back(const burnish_polygon_lobe *lobe, const polygon_arc *arc,
                                     polygon_share *share) {
    const vf zero = vf_set(0.0f), high = vf_set(1.41421356237f), low = vf_sub(zero, high);
    const vm starts = vf_greater(zero, arc->from.z), ends = vf_greater(zero, arc->to.z);
    const vf start = polygon_chord(arc->from.sine, vf_sub(zero, arc->from.cosine));
    const vf end = polygon_chord(arc->to.sine, vf_sub(zero, arc->to.cosine));
    const vf from = vf_blend(starts, vf_sub(zero, start), low);
    const vf to = vf_blend(ends, vf_sub(zero, end), high);
    const vm lit = vm_and(vm_and(arc->exists, vm_or(starts, ends)), vf_greater(to, from));
    if (vm_any(lit)) {
        const vf back = polygon_integral(lobe, 1, arc, from, to);
        share->azimuth = polygon_add_where(lit, arc, share->azimuth, back);
    }
}

BURNISH_INLINE void polygon_add_lobes(const burnish_polygon_constants *polygon,
                                      const polygon_edge *edge, polygon_sums *sums) {
    polygon_arc arc = polygon_arc_begin(edge);
    sums->inside = vm_and_not(sums->inside, vm_and(edge->exists, arc.right));
    sums->exists = vm_or(sums->exists, edge->exists);
    vm reaches = vf_greater(vf_set(0.0f), vf_set(0.0f)), each[BURNISH_POLYGON_LOBE_MAX];
    for (int j = 0; j < polygon->lobe_count; ++j) {
        each[j] = polygon_reaches(&polygon->lobes[j], &arc);
        reaches = vm_or(reaches, each[j]);
        if (polygon->lobes[j].zeta < 1.0f) {
            reaches = vm_or(reaches, edge->exists);
        }
    }
    if (!vm_any(reaches)) {
        return;
    }
    polygon_arc_finish(&arc, edge->normal[2]);
    for (int j = 0; j < polygon->lobe_count; ++j) {
        polygon_add_front(&polygon->lobes[j], &arc, each[j], &sums->lobes[j]);
        if (polygon->lobes[j].zeta < 1.0f) {
            polygon_add_back(&polygon->lobes[j], &arc, &sums->lobes[j]);
        }
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

/* Lambert's formula for an arc. */
BURNISH_INLINE void polygon_add_diffuse(const polygon_edge *edge, const polygon_point *at,
                                        polygon_sums *sums) {
    vf cross[3], d[3];
    for (int k = 0; k < 3; ++k) {
        d[k] = vf_sub(edge->to[k], edge->from[k]);
    }
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cross[k] = vf_sub(vf_mul(edge->from[i], d[j]), vf_mul(edge->from[j], d[i]));
    }
    const vf angle =
        polygon_angle_by_sine(shade_dot(edge->from, edge->to), shade_dot(cross, cross));
    const vf diffuse = vf_mul(shade_dot(at->normal, cross), angle);
    sums->diffuse = vf_add(sums->diffuse, vf_and_mask(edge->exists, diffuse));
}

/* A corner on the axis has no azimuth: it is moved by less than a vector in floats is exact. */
BURNISH_INLINE void polygon_avoid_axis(vf vertex[3]) {
    const vf distance = vf_add(polygon_absolute(vertex[0]), polygon_absolute(vertex[1]));
    vertex[0] = vf_blend(vf_greater(vf_set(0x1p-24f), distance), vf_set(0x1p-24f), vertex[0]);
}

/* Cuts an edge at the horizon, and remembers where. */
BURNISH_INLINE void polygon_cut(polygon_edge *edge, vm leaves, vm enters, vf height_a, vf height_b,
                                polygon_edge *horizon) {
    vf cut[3];
    for (int k = 0; k < 3; ++k) {
        cut[k] = vf_add(vf_mul(edge->from[k], polygon_absolute(height_b)),
                        vf_mul(edge->to[k], polygon_absolute(height_a)));
    }
    polygon_normalize(cut);
    polygon_avoid_axis(cut);
    for (int k = 0; k < 3; ++k) {
        edge->from[k] = vf_blend(enters, cut[k], edge->from[k]);
        edge->to[k] = vf_blend(leaves, cut[k], edge->to[k]);
        horizon->from[k] = vf_blend(leaves, cut[k], horizon->from[k]);
        horizon->to[k] = vf_blend(enters, cut[k], horizon->to[k]);
    }
    horizon->exists = vm_or(horizon->exists, vm_or(leaves, enters));
}

/* A cut is in the plane of its edge only as well as rounding can tell. Its two edges get normals from
 * it, or an axis next to it would be at different azimuths; short edges keep theirs. */
BURNISH_INLINE void polygon_cut_normal(polygon_edge *edge, const vf cross[3]) {
    const vm is_long = vf_greater(shade_dot(cross, cross), vf_set(0x1p-20f));
    for (int k = 0; k < 3; ++k) {
        edge->normal[k] = vf_blend(is_long, cross[k], edge->normal[k]);
    }
}

/* All edges, or their diffuse light, which needs room for one; where the horizon cuts, one more edge
 * along the horizon. Returns the number of edges. */
BURNISH_INLINE int polygon_edges(int count, const polygon_point *at, polygon_sums *sums,
                                 polygon_edge *edges) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf *a = at->vertex[count - 1]; /* count > 2 */
    vf height_a = at->has_horizon ? shade_dot(at->normal, a) : one;
    vm up_a = vm_and(at->faces, vf_greater(height_a, zero));
    vf cross[3];
    polygon_edge horizon;
    int made = 0;
    horizon.exists = vf_greater(zero, zero);
    for (int k = 0; k < 3; ++k) {
        horizon.from[k] = horizon.to[k] = horizon.normal[k] = at->normal[k];
    }
    for (int v = 0; v < count; ++v) {
        const vf *b = at->vertex[v];
        const vf height_b = at->has_horizon ? shade_dot(at->normal, b) : one;
        const vm up_b = vm_and(at->faces, vf_greater(height_b, zero));
        const vm exists = vm_or(up_a, up_b);
        if (vm_any(exists)) {
            polygon_edge *edge = &edges[made];
            edge->exists = exists;
            const vm leaves = vm_and_not(up_a, up_b), enters = vm_and_not(up_b, up_a);
            for (int k = 0; k < 3; ++k) {
                edge->from[k] = a[k];
                edge->to[k] = b[k];
            }
            if (!at->is_diffuse) {
                polygon_cross(a, b, edge->normal);
            }
            if (vm_any(vm_or(leaves, enters))) {
                polygon_cut(edge, leaves, enters, height_a, height_b, &horizon);
                if (!at->is_diffuse) {
                    polygon_cross(edge->from, edge->to, cross);
                    polygon_cut_normal(edge, cross);
                }
            }
            if (at->is_diffuse) {
                polygon_add_diffuse(edge, at, sums);
            } else {
                ++made;
            }
        }
        a = b;
        height_a = height_b;
        up_a = up_b;
    }
    if (vm_any(horizon.exists)) {
        if (at->is_diffuse) {
            polygon_add_diffuse(&horizon, at, sums);
        } else {
            polygon_cross(horizon.from, horizon.to, cross);
            polygon_cut_normal(&horizon, cross);
            edges[made++] = horizon;
        }
    }
    return made;
}

#endif
