/* Lobes that are polynomials in u with coefficients >= 0: composites, and the family. */
#include <math.h>

#include "theory/internal.h"

burnish_lobe_status burnish_theory_composite_create(burnish_theory_model *model, double exponent,
                                                    double zeta, const double *b, int steps) {
    burnish_theory_model made = {.lobe = {.kind = BURNISH_LOBE_COMPOSITE, .order = steps + 2},
                                 .exponent = exponent,
                                 .zeta = zeta,
                                 .scale = 1,
                                 .steps = steps};
    burnish_lobe_status status =
        burnish_composite_check(BURNISH_COMPOSITE_MINIMAX, steps + 2, exponent);
    if (status == BURNISH_LOBE_OK && !(zeta > 0 && zeta <= (double)BURNISH_LOBE_ZETA_MAX)) {
        status = BURNISH_LOBE_ERROR_ZETA;
    }
    for (int i = 0; i < steps && status == BURNISH_LOBE_OK; ++i) {
        made.k[i] = b[i];
        status = b[i] >= 0 && b[i] < HUGE_VAL ? status : BURNISH_LOBE_ERROR_COMPOSITE;
    }
    if (status == BURNISH_LOBE_OK) {
        *model = made;
    }
    return status;
}

int burnish_theory_polynomial(const burnish_theory_model *model,
                              double coefficients[BURNISH_THEORY_DEGREE_MAX + 1]) {
    double *c = coefficients, square[BURNISH_THEORY_DEGREE_MAX + 1];
    int degree = 2;
    for (int j = 0; j <= BURNISH_THEORY_DEGREE_MAX; ++j) {
        c[j] = 0;
    }
    if (model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON) {
        c[model->lobe.order] = model->scale;
        return model->lobe.order;
    }
    if (model->lobe.kind != BURNISH_LOBE_COMPOSITE) {
        return 0;
    }
    c[2] = 1;
    for (int i = 0; i < model->steps; ++i, degree *= 2) {
        const double share = model->k[i] / (1 + model->k[i]);
        for (int j = 0; j <= 2 * degree; ++j) {
            double sum = 0;
            for (int k = j > degree ? j - degree : 0; k <= j && k <= degree; ++k) {
                sum += c[k] * c[j - k];
            }
            square[j] = sum;
        }
        for (int j = 0; j <= 2 * degree; ++j) {
            c[j] = share * c[j] + (1 - share) * square[j];
        }
    }
    return degree;
}

/* Integral of u^m dc (times c) for lambda in [0, end]; u = 1 - zeta lambda, c = 1 - (1 - u)/zeta.
 */
static double power_integral(double m, double zeta, int weighted, double end) {
    double low = 1 - zeta * end, logarithm = low > 0 ? log1p(-zeta * end) : -HUGE_VAL;
    double first = -expm1((m + 1) * logarithm) / (m + 1);
    double second = -expm1((m + 2) * logarithm) / (m + 2);
    return (first - (weighted ? (first - second) / zeta : 0)) / zeta;
}

double burnish_theory_polynomial_integral(const burnish_theory_model *model, int weighted,
                                          double end) {
    double c[BURNISH_THEORY_DEGREE_MAX + 1], sum = 0;
    for (int j = burnish_theory_polynomial(model, c); j > 0; --j) {
        sum += c[j] > 0 ? c[j] * power_integral(j, model->zeta, weighted, end) : 0;
    }
    return sum;
}

/* lambda of u^m drawn over solid angle, u from its value at c = 0 up to 1. */
static double power_solid(double m, double zeta, double xi) {
    double low = zeta < 1 ? pow(1 - zeta, m + 1) : 0;
    return (1 - pow(low + (1 - low) * xi, 1 / (m + 1))) / zeta;
}

/* lambda of u^m c = u^m (1 - 1/zeta) + u^(m+1) / zeta, zeta >= 1: xi selects one of the two power
 * densities and, rescaled, a point in it. */
static double power_weighted(double m, double zeta, double xi) {
    double first = (1 - 1 / zeta) / (m + 1), second = 1 / (zeta * (m + 2));
    double share = first / (first + second), u;
    if (xi < share) {
        u = pow(xi / share, 1 / (m + 1));
    } else {
        u = pow((xi - share) / (1 - share), 1 / (m + 2));
    }
    return (1 - u) / zeta;
}

/* xi selects a power of u by its share of the integral and, rescaled, a point in its density. */
double burnish_theory_polynomial_sample(const burnish_theory_model *model, int weighted,
                                        double xi) {
    double c[BURNISH_THEORY_DEGREE_MAX + 1], zeta = model->zeta;
    const double total = burnish_theory_polynomial_integral(model, weighted, 1);
    int m = burnish_theory_polynomial(model, c), last = m;
    double share = 0;
    for (; m > 0; --m) {
        if (c[m] > 0) {
            last = m;
            share = c[m] * power_integral(m, zeta, weighted, 1) / total;
            if (xi < share) {
                break;
            }
            xi -= share;
        }
    }
    xi = m > 0 ? xi / share : 1; /* past all shares only by rounding, and at xi = 1 */
    return (weighted ? power_weighted : power_solid)(last, zeta, xi);
}

double burnish_theory_model_zonal(const burnish_theory_model *model, int degree) {
    double c[BURNISH_THEORY_DEGREE_MAX + 1], sum = 0;
    int m = burnish_theory_polynomial(model, c);
    if (m == 0) {
        return NAN;
    }
    for (; m > 0; --m) {
        sum += c[m] > 0 ? c[m] * burnish_theory_zonal(m, model->zeta, degree) : 0;
    }
    return sum;
}
