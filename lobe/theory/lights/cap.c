/* The light of a sphere reflected by a lobe, as an integral along the circle around it. */
#include "theory/lights/arc.h"
#include "theory/lights/region.h"
#include "theory/lights/vectors.h"

enum { SUPPORT = 0 }; /* the index of the cap in which the lobe is positive */

/* The integral of T(u) (p - k c) / (1 + c) along an arc, p and k being the cosines of the circle's
 * distance from the axis and of its radius. The numerator is 0 at both centres: without
 * cancellation. */
static double along_arc(const burnish_arc_rule *rule, const burnish_region_circle *circle,
                        double start, double length) {
    double away = circle->away, radius = circle->cap.angle;
    double near = sin(0.5 * (away - radius)), sines = sin(away) * sin(radius), sum = 0;
    for (int i = 0; i < rule->gauss.count; ++i) {
        double s = sin(0.5 * (start + 0.5 * length * (1 + rule->gauss.nodes[i])));
        double lambda = 2 * (near * near + sines * s * s);
        double turn = 2 * cos(radius) * sines * s * s - sin(radius) * sin(away - radius);
        sum += rule->gauss.weights[i] * burnish_arc_tail(rule, 1 - rule->zeta * lambda) * turn /
               (2 - lambda);
    }
    return 0.5 * length * sum / (rule->degree + 1);
}

/* The contour integral around a region within the lobe. */
static double around(const burnish_region *region, const void *context) {
    const burnish_arc_rule *rule = context;
    double sum = 0;
    for (int i = 0; i < region->arcs; ++i) {
        const burnish_region_circle *circle = &region->circle[region->arc[i].circle];
        double length = region->arc[i].length;
        if (circle->index == SUPPORT) { /* u = 0, and the azimuth is t */
            sum += length * rule->tails[0] / (rule->zeta * (rule->degree + 1));
            continue;
        }
        int pieces = (int)ceil(length / (0.5 * BURNISH_PI));
        for (int k = 0; k < pieces; ++k) {
            sum += along_arc(rule, circle, region->arc[i].start + k * length / pieces,
                             length / pieces);
        }
    }
    return sum;
}

double burnish_theory_cap(const burnish_theory_powers *lobe, const double axis[3],
                          const double *normal, const double centre[3], double angle) {
    burnish_region_cap caps[BURNISH_REGION_CAPS];
    burnish_lobe_around placed = {.powers = lobe};
    int count = 0;
    if (!burnish_lights_are_valid(lobe, axis, normal, centre) ||
        !(angle >= 0 && angle <= BURNISH_PI)) {
        return NAN;
    }
    vector_normalize(axis, placed.axis);
    count += burnish_region_support(lobe->zeta, placed.axis, caps);
    vector_normalize(centre, caps[count].centre);
    caps[count++].angle = angle;
    if (normal) {
        vector_normalize(normal, caps[count].centre);
        caps[count++].angle = 0.5 * BURNISH_PI;
    }
    /* A small cap is a small difference of its contour's halves: its relative error would grow. */
    if (lobe->zeta < 1 || angle * angle * lobe->zeta < 0.01) {
        return burnish_region_sum(caps, count, placed.axis, burnish_lobe_within, &placed);
    }
    burnish_arc_rule rule;
    burnish_arc_prepare(&rule, lobe, 24 + lobe->degree / 2);
    return burnish_region_sum(caps, count, placed.axis, around, &rule);
}
