/* One arc of a great circle in the contour integral of a polygon (docs/theory.md). r is the axis of
 * the lobe. On the circle, with t measured from the point nearest to r,
 *     c = w.r = k cos t,     d(azimuth around r) = d dt / (1 - c^2),     d^2 + k^2 = 1. */
#ifndef BURNISH_THEORY_ARC_H
#define BURNISH_THEORY_ARC_H

#include "theory/internal.h"

/* What all arcs of a polygon have in common. */
typedef struct burnish_arc_rule {
    int degree;
    double zeta;
    double cutoff; /* the lobe is 0 where c <= cutoff */
    /* Those of T(u) (degree + 1), T being the integral of S from u to 1 divided by 1 - u. A power
     * has ones. */
    double tails[BURNISH_THEORY_POWERS_MAX + 1];
    burnish_theory_nodes gauss; /* none: the closed form */
} burnish_arc_rule;

/* A great circle; d > 0 if r is on its left. */
typedef struct burnish_arc_circle {
    double d, k;
    double base;  /* 1 + zeta (k - 1): u at t = 0 */
    double limit; /* the lobe is positive for abs(t) < limit: [0, pi] */
} burnish_arc_circle;

/* Whether slope, degree and coefficients are in range. */
int burnish_polynomial_is_valid(const burnish_theory_powers *lobe);

/* The same for what lights have in common; the normal can be NULL. */
int burnish_lights_are_valid(const burnish_theory_powers *lobe, const double axis[3],
                             const double *normal, const double light[3]);

/* The polynomial, u being any number. */
double burnish_polynomial_value(const burnish_theory_powers *lobe, double u);

/* The integral of S over c in [-1, 1]. */
double burnish_polynomial_integral(const burnish_theory_powers *lobe);

/* Fills the tails and so many nodes; 0 for the closed form. */
void burnish_arc_prepare(burnish_arc_rule *rule, const burnish_theory_powers *lobe, int nodes);

/* (degree + 1) T(u). */
double burnish_arc_tail(const burnish_arc_rule *rule, double u);

/* The circle around a unit vector; `along` receives the direction of growing t at the point nearest
 * to the axis, of length k. */
burnish_arc_circle burnish_arc_circle_around(double zeta, const double axis[3],
                                             const double normal[3], double along[3]);

/* The integral from t0 to t1, both in [-limit, limit], of T(u) d / (1 + c) dt, where
 * u = 1 + zeta (c - 1). */
double burnish_arc_inside(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                          double t1);

#endif
