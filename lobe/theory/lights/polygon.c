/* The light of a polygon reflected by the lobe, as an integral along its edges. */
#include <string.h>

#include "theory/lights/arc.h"
#include "theory/lights/vectors.h"

/* The sums over the edges, which arrive one after the other. Here a polygon is positive if it turns
 * counter-clockwise as seen from outside the sphere. */
typedef struct contour {
    burnish_arc_rule rule;
    double axis[3];
    double inside;      /* of G d(azimuth) inside the lobe */
    double swept[2];    /* azimuth outside, inside the lobe */
    double high, low;   /* extreme cosines of the path to the axis */
    double windings[2]; /* around the axis, around its opposite */
    int count;          /* of the vertices so far */
    double first[3], at[3];
    int first_turns[2]; /* side of the axis and its opposite from the plane of first and at */
} contour;

/* The azimuth at t. The second term is the one of the closed form: at the opposite of the axis both
 * are rounding errors, and cancel. */
static double azimuth(const burnish_arc_circle *circle, double t) {
    double s = sin(0.5 * t), c = cos(0.5 * t), tangent = circle->d / (1 + circle->k);
    return copysign(atan2(s, fabs(tangent) * c), tangent * s) + atan2(tangent * s, c);
}

/* Adds the arc from t0 to t0 + length < t0 + pi, split where it enters or leaves the lobe. */
static void add_arc(contour *sums, const burnish_arc_circle *circle, double t0, double length) {
    double end = t0 + length, full = 2 * BURNISH_PI;
    double splits[3] = {-circle->limit, circle->limit, full - circle->limit};
    for (int i = 0; t0 < end; ++i) {
        double next = i < 3 ? fmin(fmax(splits[i], t0), end) : end;
        double middle = 0.5 * (t0 + next), turns = middle > BURNISH_PI ? full : 0;
        if (fabs(middle - turns) < circle->limit) {
            double from = t0 - turns, to = next - turns;
            sums->inside += burnish_arc_inside(&sums->rule, circle, from, to);
            sums->swept[1] += azimuth(circle, to) - azimuth(circle, from);
        } else {
            sums->swept[0] += azimuth(circle, next) - azimuth(circle, t0);
        }
        t0 = next;
    }
}

static void add_edge(contour *sums, const double a[3], const double b[3]) {
    double chord[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, normal[3], along[3];
    const double *axis = sums->axis;
    vector_cross(a, chord, normal);
    double sine = sqrt(vector_dot(normal, normal));
    if (sine == 0) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        normal[i] /= sine;
    }
    burnish_arc_circle circle = burnish_arc_circle_around(sums->rule.zeta, axis, normal, along);
    double ca = vector_dot(axis, a), cb = vector_dot(axis, b),
           length = atan2(sine, vector_dot(a, b));
    double start = atan2(vector_dot(along, a), ca), end = start + length;
    int near = start < 0 && end > 0, far = end > BURNISH_PI;
    sums->high = fmax(sums->high, near ? circle.k : fmax(ca, cb));
    sums->low = fmin(sums->low, far ? -circle.k : fmin(ca, cb));
    add_arc(sums, &circle, start, length);
}

/* Adds a corner: the edge that leads to it, and the triangle that it forms with the first corner,
 * for how often the polygon goes around the axis and its opposite. */
static void add_corner(contour *sums, const double corner[3]) {
    double side[3], plane[3];
    int turns[2] = {0, 0};
    if (sums->count == 0) {
        memcpy(sums->first, corner, sizeof sums->first);
    } else {
        add_edge(sums, sums->at, corner);
        vector_cross(sums->first, corner, plane);
        vector_cross(sums->at, corner, side);
        double orientation = vector_dot(sums->first, side), across = vector_dot(side, sums->axis);
        double seen = vector_dot(plane, sums->axis);
        for (int back = 0; back < 2; ++back) {
            int left = (back ? -across : across) > 0;
            turns[back] = (back ? -seen : seen) >= 0;
            if (sums->count > 1 && left == sums->first_turns[back] && left != turns[back] &&
                left == (orientation > 0)) {
                sums->windings[back] += left ? 1 : -1;
            }
        }
    }
    memcpy(sums->at, corner, sizeof sums->at);
    memcpy(sums->first_turns, turns, sizeof turns);
    ++sums->count;
}

/* Adds the corners of the part above the horizon of `normal`. */
static void add_clipped(contour *sums, const double normal[3], const double (*vertices)[3],
                        int count) {
    double before[3], corner[3], meets[3];
    vector_normalize(vertices[count - 1], before);
    double height_before = vector_dot(normal, before);
    for (int i = 0; i < count; ++i) {
        vector_normalize(vertices[i], corner);
        double height = vector_dot(normal, corner);
        if ((height > 0) != (height_before > 0)) {
            for (int j = 0; j < 3; ++j) {
                meets[j] = before[j] * height - corner[j] * height_before;
                meets[j] = height > 0 ? meets[j] : -meets[j];
            }
            vector_normalize(meets, meets);
            add_corner(sums, meets);
        }
        if (height > 0) {
            add_corner(sums, corner);
        }
        memcpy(before, corner, sizeof before);
        height_before = height;
    }
}

double burnish_theory_polygon_polynomial(const burnish_theory_powers *lobe, const double axis[3],
                                         const double *normal, const double (*vertices)[3],
                                         int count) {
    contour sums = {.high = -1, .low = 1};
    if (!burnish_lights_are_valid(lobe, axis, normal, axis)) {
        return NAN;
    }
    for (int i = 0; i < count; ++i) {
        if (!vector_is_direction(vertices[i])) {
            return NAN;
        }
    }
    /* The closed form cancels for larger slopes (docs/theory.md). */
    burnish_arc_prepare(&sums.rule, lobe, lobe->zeta > 1 ? 24 + lobe->degree : 0);
    vector_normalize(axis, sums.axis);
    for (int i = 0; i < count && !normal; ++i) {
        double corner[3];
        vector_normalize(vertices[i], corner);
        add_corner(&sums, corner);
    }
    if (normal && count > 0) {
        double unit[3];
        vector_normalize(normal, unit);
        add_clipped(&sums, unit, vertices, count);
    }
    if (sums.count < 3) {
        return 0;
    }
    add_edge(&sums, sums.at, sums.first);
    /* The azimuth jumps where the path passes the axis or its opposite. G is 0 at the axis; G minus
     * `outside` is 0 at its opposite: take the form that vanishes at the nearer one. */
    double outside = burnish_polynomial_integral(lobe), sum;
    if (sums.high > -sums.low) {
        sum = sums.inside + outside * (sums.swept[0] + 2 * BURNISH_PI * sums.windings[1]);
    } else {
        sum = sums.inside - outside * (sums.swept[1] - 2 * BURNISH_PI * sums.windings[0]);
    }
    return -sum;
}

double burnish_theory_polygon(int order, double zeta, const double axis[3], const double *normal,
                              const double (*vertices)[3], int count) {
    burnish_theory_powers lobe = burnish_theory_powers_of_order(order, zeta);
    return order < 1 || order > BURNISH_THEORY_POLYGON_ORDER_MAX
               ? NAN
               : burnish_theory_polygon_polynomial(&lobe, axis, normal, vertices, count);
}
