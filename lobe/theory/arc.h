/* One arc of a great circle in the contour integral of a polygon (docs/theory.md). r is the axis of
 * the lobe. On the circle, with t measured from the point nearest to r,
 *     c = w.r = k cos t,     d(azimuth around r) = d dt / (1 - c^2),     d^2 + k^2 = 1. */
#ifndef BURNISH_THEORY_ARC_H
#define BURNISH_THEORY_ARC_H

#include "burnish/theory.h"

enum { BURNISH_ARC_NODES = 64 };

/* What all arcs of a polygon have in common. */
typedef struct burnish_arc_rule {
    int order;
    double zeta;
    double cutoff; /* the lobe is 0 where c <= cutoff */
    burnish_theory_polygon_method method;
    int terms;
    double nodes[BURNISH_ARC_NODES], weights[BURNISH_ARC_NODES]; /* GAUSS: on [-1, 1] */
} burnish_arc_rule;

/* A great circle; d > 0 if r is on its left. */
typedef struct burnish_arc_circle {
    double d, k;
    double base;  /* 1 + zeta (k - 1): u at t = 0 */
    double limit; /* the lobe is positive for abs(t) < limit: [0, pi] */
} burnish_arc_circle;

/* Fills the nodes, if the method has any. */
void burnish_arc_prepare(burnish_arc_rule *rule);

/* The integral from t0 to t1, both in [-limit, limit], of
 * (1 + u + ... + u^m) / (m + 1) d / (1 + c) dt, where u = 1 + zeta (c - 1). */
double burnish_arc_inside(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                          double t1);

#endif
