/* Regions of directions that caps have in common, and their boundaries as arcs of circles. */
#ifndef BURNISH_THEORY_REGION_H
#define BURNISH_THEORY_REGION_H

#include "burnish/theory.h"

enum { BURNISH_REGION_CAPS = 3, BURNISH_REGION_ARCS = 3 * BURNISH_REGION_CAPS };

/* The unit vectors within an angle of a unit vector. */
typedef struct burnish_region_cap {
    double centre[3], angle;
} burnish_region_cap;

/* The circle of a cap is
 *     cos(angle) centre + sin(angle) (cos(t) x + sin(t) y),
 * counter-clockwise around the centre, x pointing to the axis that burnish_region_create got. */
typedef struct burnish_region_circle {
    burnish_region_cap cap;
    double x[3], y[3];
    double away; /* angle from the axis to the centre */
    int index;   /* of the cap */
} burnish_region_circle;

typedef struct burnish_region {
    int circles; /* of caps that hold no other cap */
    burnish_region_circle circle[BURNISH_REGION_CAPS];
    int arcs; /* 0: the region is empty */
    struct burnish_region_arc {
        int circle;
        double start, length; /* (0, 2 pi] */
    } arc[BURNISH_REGION_ARCS];
} burnish_region;

/* The sum over the common part of 0 to 3 caps of any width, the first of which is never dropped if
 * it is at most a hemisphere. Wide caps are replaced by their complements, so `integral` gets
 * regions of caps that are not wider than a hemisphere. The axis is a unit vector. */
typedef double (*burnish_region_integral)(const burnish_region *region, const void *context);
double burnish_region_sum(const burnish_region_cap *caps, int count, const double axis[3],
                          burnish_region_integral integral, const void *context);

/* Where a lobe is positive; returns 0 if that is everywhere. */
int burnish_region_support(double zeta, const double axis[3], burnish_region_cap *cap);

/* The point of a circle, minus the centre, and its derivative in t. */
void burnish_region_point(const burnish_region_circle *circle, double t, double offset[3],
                          double slope[3]);

typedef struct burnish_lobe_around {
    const burnish_theory_powers *powers;
    double axis[3];
} burnish_lobe_around;

/* The integral of the polynomial, u being any number. context: burnish_lobe_around. */
double burnish_lobe_within(const burnish_region *region, const void *context);

#endif
