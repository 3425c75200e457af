/* Zonal harmonic coefficients of the family. */
#include <math.h>

#include "theory/internal.h"

double burnish_theory_zonal(int order, double zeta, int degree) {
    burnish_theory_nodes rule;
    int terms = (order + degree) / 2 + 1; /* exact for lobe times polynomial */
    if (!(zeta > 0) || order < 1 || degree < 0 || terms > BURNISH_THEORY_NODES_MAX) {
        return NAN;
    }
    burnish_theory_gauss(terms, &rule);
    double half = fmin(1, 0.5 / zeta),
           sum = 0; /* of the range of c in which the lobe is positive */
    for (int i = 0; i < rule.count; ++i) {
        /* Legendre's recurrence for the steps between degrees, in lambda: 1 - lambda would round. */
        double lambda = half * (1 - rule.nodes[i]), legendre = 1, step = 0;
        for (int j = 0; j < degree; ++j) {
            step = (j * step - (2 * j + 1) * lambda * legendre) / (j + 1);
            legendre += step;
        }
        sum += rule.weights[i] * half * pow(1 - zeta * lambda, order) * legendre;
    }
    return 2 * BURNISH_PI * sum;
}
