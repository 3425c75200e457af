/* Drawing directions in proportion to a lobe. */
#include <math.h>

#include "theory/internal.h"

enum { HALVINGS = 52 };

/* Inverts the integral by halving in s = sqrt(lambda), summing only the parts passed. */
static double inverted(const burnish_theory_model *model, burnish_theory_measure measure,
                       double xi) {
    double left = (1 - xi) * burnish_theory_integral_between(model, measure, 0, 1);
    double low = 0, high = 1;
    for (int i = 0; i < HALVINGS; ++i) {
        double middle = 0.5 * (low + high);
        double part = burnish_theory_integral_between(model, measure, low * low, middle * middle);
        if (part < left) {
            left -= part;
            low = middle;
        } else {
            high = middle;
        }
    }
    return low * low;
}

static double sample_lambda(const burnish_theory_model *model, burnish_theory_measure measure,
                            double xi) {
    int weighted = measure == BURNISH_THEORY_COSINE_WEIGHTED;
    if (model->lobe.kind == BURNISH_LOBE_POWER) {
        return xi > 0 ? -expm1(log(xi) / (model->exponent + (weighted ? 2 : 1))) : 1;
    }
    double c[BURNISH_THEORY_DEGREE_MAX + 1];
    if (burnish_theory_polynomial(model, c) > 0 && (!weighted || model->zeta >= 1)) {
        return burnish_theory_polynomial_sample(model, weighted, xi);
    }
    if (model->lobe.kind == BURNISH_LOBE_GAUSSIAN && !weighted) {
        double k = model->exponent + 0.775;
        return -log1p((1 - xi) * expm1(-k)) / k;
    }
    return inverted(model, measure, xi);
}

double burnish_theory_sample_cosine(const burnish_theory_model *model,
                                    burnish_theory_measure measure, double xi) {
    return 1 - saturate(sample_lambda(model, measure, saturate(xi)));
}

void burnish_theory_sample_direction(const burnish_theory_model *model,
                                     burnish_theory_measure measure, const double xi[2],
                                     double direction[3]) {
    double lambda = saturate(sample_lambda(model, measure, saturate(xi[0])));
    double sine = sqrt(lambda * (2 - lambda)), azimuth = 2 * BURNISH_PI * xi[1];
    direction[0] = sine * cos(azimuth);
    direction[1] = sine * sin(azimuth);
    direction[2] = 1 - lambda;
}
