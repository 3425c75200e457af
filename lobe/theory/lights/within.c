/* A lobe by quadrature over a region. */
#include <string.h>

#include "theory/lights/arc.h"
#include "theory/lights/region.h"
#include "theory/lights/vectors.h"

/* A direction inside the region: of the integral of w over a large one, which is half of that of
 * w x dw along its boundary, and of the integral of w along the boundary of a small one. */
static void middle_of(const burnish_region *region, double middle[3]) {
    double area[3] = {0, 0, 0}, line[3] = {0, 0, 0};
    if (region->circles == 1) {
        memcpy(middle, region->circle[0].cap.centre, sizeof area);
        return;
    }
    for (int i = 0; i < region->arcs; ++i) {
        const burnish_region_circle *circle = &region->circle[region->arc[i].circle];
        double half = 0.5 * region->arc[i].length, t = region->arc[i].start + half;
        double sine = sin(circle->cap.angle), cosine = cos(circle->cap.angle);
        for (int j = 0; j < 3; ++j) {
            double centre = half * circle->cap.centre[j];
            double point = sin(half) * (cos(t) * circle->x[j] + sin(t) * circle->y[j]);
            area[j] += sine * (sine * centre - cosine * point);
            line[j] += sine * (cosine * centre + sine * point);
        }
    }
    vector_normalize(vector_largest(area) > 0.01 ? area : line, middle);
}

static double value(const burnish_lobe_around *lobe, const double direction[3]) {
    double chord = 0;
    for (int j = 0; j < 3; ++j) {
        double apart = direction[j] - lobe->axis[j];
        chord += apart * apart;
    }
    return burnish_polynomial_value(lobe->powers, 1 - 0.5 * lobe->powers->zeta * chord);
}

/* The integral over the triangle from the middle to the points near t. The directions of
 * y = middle + s (w - middle) have d omega = s det(middle, w, dw/dt) / |y|^3 ds dt. */
static double ray(const burnish_lobe_around *lobe, const burnish_theory_nodes *rule,
                  const burnish_region_circle *circle, const double middle[3], double t) {
    double slope[3], out[3], side[3], sum = 0; /* out = w - middle, exact for small caps */
    burnish_region_point(circle, t, out, slope);
    for (int j = 0; j < 3; ++j) {
        out[j] += circle->cap.centre[j] - middle[j];
    }
    vector_cross(middle, out, side);
    for (int i = 0; i < rule->count; ++i) {
        double s = 0.5 * (1 + rule->nodes[i]), y[3];
        for (int j = 0; j < 3; ++j) {
            y[j] = middle[j] + s * out[j];
        }
        double square = vector_dot(y, y);
        vector_normalize(y, y);
        sum += rule->weights[i] * s / (square * sqrt(square)) * value(lobe, y);
    }
    return 0.5 * sum * vector_dot(side, slope);
}

double burnish_lobe_within(const burnish_region *region, const void *context) {
    const burnish_lobe_around *lobe = context;
    double middle[3], sum = 0;
    burnish_theory_nodes rule;
    burnish_theory_gauss(24 + lobe->powers->degree / 2, &rule);
    middle_of(region, middle);
    for (int i = 0; i < region->arcs; ++i) {
        int pieces = (int)ceil(region->arc[i].length / (0.5 * BURNISH_PI));
        double piece = region->arc[i].length / pieces;
        for (int k = 0; k < pieces * rule.count; ++k) {
            double t = region->arc[i].start +
                       piece * (k / rule.count + 0.5 * (1 + rule.nodes[k % rule.count]));
            sum += 0.5 * piece * rule.weights[k % rule.count] *
                   ray(lobe, &rule, &region->circle[region->arc[i].circle], middle, t);
        }
    }
    return sum;
}
