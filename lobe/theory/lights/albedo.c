/* The cosine-weighted light of a lobe cut off at the horizon. */
#include "theory/lights/arc.h"
#include "theory/lights/vectors.h"

/* With N = p R + k e, the integral of S N.w has two parts. That of S c p is a cap's. Along the
 * azimuth, (e.w) integrates to the cosine to the third axis, so the other part is the integral of
 * S sin(t) d(cos t) k^2 along the horizon. */
double burnish_theory_albedo(const burnish_theory_powers *lobe, double cosine) {
    if (!burnish_polynomial_is_valid(lobe) || lobe->degree >= BURNISH_THEORY_POWERS_MAX ||
        !(cosine >= 0 && cosine <= 1)) {
        return NAN;
    }
    double square = (1 - cosine) * (1 + cosine), sum = 0, along[3];
    double axis[3] = {sqrt(square), 0, cosine}, normal[3] = {0, 0, 1};
    burnish_theory_powers weighted = {.zeta = lobe->zeta, .degree = lobe->degree + 1};
    for (int i = 0; i <= lobe->degree; ++i) { /* S c, c = 1 - (1 - u) / zeta */
        weighted.coefficients[i] += lobe->coefficients[i] * (1 - 1 / lobe->zeta);
        weighted.coefficients[i + 1] += lobe->coefficients[i] / lobe->zeta;
    }
    burnish_arc_circle circle = burnish_arc_circle_around(lobe->zeta, axis, normal, along);
    burnish_theory_nodes rule;
    burnish_theory_gauss(24 + lobe->degree, &rule);
    for (int i = 0; i < rule.count; ++i) {
        double t = 0.5 * circle.limit * (1 + rule.nodes[i]), s = sin(0.5 * t);
        double u = circle.base - 2 * lobe->zeta * circle.k * s * s;
        sum += rule.weights[i] * burnish_polynomial_value(lobe, u) * sin(t) * sin(t);
    }
    return cosine * burnish_theory_cap(&weighted, axis, NULL, normal, 0.5 * BURNISH_PI) +
           square * circle.limit * sum;
}
