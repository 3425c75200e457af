/* Drawing directions in proportion to a lobe. */
#include <math.h>

#include "theory/internal.h"

enum { HALVINGS = 52 };

static double saturate(double x) {
    x = x > 0 ? x : 0;
    return x < 1 ? x : 1;
}

/* lambda of u^m drawn over solid angle, u from its value at c = 0 up to 1. */
static double family_solid(double m, double zeta, double xi) {
    double low = zeta < 1 ? pow(1 - zeta, m + 1) : 0;
    return (1 - pow(low + (1 - low) * xi, 1 / (m + 1))) / zeta;
}

/* lambda of u^m c = u^m (1 - 1/zeta) + u^(m+1) / zeta, zeta >= 1: xi selects one of the two power
 * densities and, rescaled, a point in it. */
static double family_weighted(double m, double zeta, double xi) {
    double first = (1 - 1 / zeta) / (m + 1), second = 1 / (zeta * (m + 2));
    double share = first / (first + second), u;
    if (xi < share) {
        u = pow(xi / share, 1 / (m + 1));
    } else {
        u = pow((xi - share) / (1 - share), 1 / (m + 2));
    }
    return (1 - u) / zeta;
}

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
    if (model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON) {
        if (!weighted) {
            return family_solid(model->lobe.order, model->zeta, xi);
        }
        if (model->zeta >= 1) {
            return family_weighted(model->lobe.order, model->zeta, xi);
        }
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
