/* Products of lobes, by quadrature over the common part of their caps. */
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

static double value(const burnish_product *product, const double direction[3]) {
    double result = 1;
    for (int i = 0; i < product->count; ++i) {
        double chord = 0;
        for (int j = 0; j < 3; ++j) {
            double apart = direction[j] - product->axis[i][j];
            chord += apart * apart;
        }
        result *=
            burnish_polynomial_value(product->lobe[i], 1 - 0.5 * product->lobe[i]->zeta * chord);
    }
    return result;
}

/* The integral over the triangle from the middle to the points near t. The directions of
 * y = middle + s (w - middle) have d omega = s det(middle, w, dw/dt) / |y|^3 ds dt. */
static double ray(const burnish_product *product, const burnish_theory_nodes *rule,
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
        sum += rule->weights[i] * s / (square * sqrt(square)) * value(product, y);
    }
    return 0.5 * sum * vector_dot(side, slope);
}

double burnish_product_within(const burnish_region *region, const void *context) {
    const burnish_product *product = context;
    double middle[3], sum = 0;
    burnish_theory_nodes rule;
    int degree = product->lobe[0]->degree + (product->count > 1 ? product->lobe[1]->degree : 0);
    burnish_theory_gauss(24 + degree / 2, &rule);
    middle_of(region, middle);
    for (int i = 0; i < region->arcs; ++i) {
        int pieces = (int)ceil(region->arc[i].length / (0.5 * BURNISH_PI));
        double piece = region->arc[i].length / pieces;
        for (int k = 0; k < pieces * rule.count; ++k) {
            double t = region->arc[i].start +
                       piece * (k / rule.count + 0.5 * (1 + rule.nodes[k % rule.count]));
            sum += 0.5 * piece * rule.weights[k % rule.count] *
                   ray(product, &rule, &region->circle[region->arc[i].circle], middle, t);
        }
    }
    return sum;
}

double burnish_theory_product(const burnish_theory_powers *a, const double axis_a[3],
                              const burnish_theory_powers *b, const double axis_b[3],
                              const double *normal) {
    burnish_region_cap caps[BURNISH_REGION_CAPS];
    burnish_product product = {.count = 2, .lobe = {a, b}};
    int count = 0;
    if (!burnish_lights_are_valid(a, axis_a, normal, axis_b) || !burnish_polynomial_is_valid(b)) {
        return NAN;
    }
    vector_normalize(axis_a, product.axis[0]);
    vector_normalize(axis_b, product.axis[1]);
    for (int i = 0; i < 2; ++i) {
        count += burnish_region_support(product.lobe[i]->zeta, product.axis[i], &caps[count]);
    }
    if (normal) {
        vector_normalize(normal, caps[count].centre);
        caps[count++].angle = 0.5 * BURNISH_PI;
    }
    return burnish_region_sum(caps, count, product.axis[0], burnish_product_within, &product);
}
