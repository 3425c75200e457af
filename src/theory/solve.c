/* Fits that need a search: minimax, least squares, two parameters, and the best Moebius lobe. */
#include <math.h>

#include "theory/internal.h"

enum { HALVINGS = 100 };

burnish_theory_shape burnish_theory_family_shape(double zeta, double scale, int order,
                                                 double exponent) {
    burnish_theory_shape shape = {.log_slope = log(scale * order * zeta),
                                  .e = order - 1,
                                  .s = -zeta,
                                  .p = exponent - 1,
                                  .end = zeta > 1 ? 1 / zeta : 1};
    return shape;
}

burnish_theory_shape burnish_theory_moebius_shape(double a, double b, double exponent) {
    burnish_theory_shape shape = {
        .log_slope = log(a + b), .e = -2, .s = b, .p = exponent - 1, .end = a > 1 ? 1 / a : 1};
    return shape;
}

static double slope_ratio(const burnish_theory_shape *shape, double v) {
    return shape->log_slope + shape->e * log1p(shape->s * v) - shape->k * v - log(shape->p + 1) -
           shape->p * log1p(-v);
}

/* A zero of the slope ratio in [low, high], on which it is monotone; 0 when there is none. */
static int find_zero(const burnish_theory_shape *shape, double low, double high, double *v) {
    int sign = slope_ratio(shape, low) > 0;
    if (!(low < high) || sign == (slope_ratio(shape, high) > 0)) {
        return 0;
    }
    for (int i = 0; i < HALVINGS; ++i) {
        double middle = 0.5 * (low + high);
        if ((slope_ratio(shape, middle) > 0) == sign) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *v = high;
    return 1;
}

int burnish_theory_stationary(const burnish_theory_shape *shape, double end, double v[2]) {
    double limit = shape->end < end ? shape->end : end;
    double e = shape->e, s = shape->s, p = shape->p, turn = limit;
    int count = 0;
    limit *= 1 - 1e-15; /* both slopes may vanish at the very end */
    /* g' = e s / (1 + s v) - k + p / (1 - v); either e or k is 0 */
    double candidate = shape->k > 0 ? 1 - p / shape->k : (e * s + p) / (s * (e - p));
    if (candidate > 0 && candidate < limit) {
        turn = candidate;
    }
    count += find_zero(shape, 0, turn < limit ? turn : limit, v);
    count += find_zero(shape, turn, limit, v + count);
    return count;
}

/* The largest errors of scale u^m: above the power, and below it without the peak itself. */
static void family_errors(double zeta, double scale, int order, double n, double *above,
                          double *below) {
    burnish_theory_shape shape = burnish_theory_family_shape(zeta, scale, order, n);
    double v[4];
    int count = burnish_theory_stationary(&shape, 1, v);
    v[count++] = shape.end;
    v[count++] = 1;
    *above = *below = 0;
    for (int i = 0; i < count; ++i) {
        double difference = scale * burnish_theory_family(zeta, order, 1 - v[i]) -
                            burnish_theory_power_at_lambda(v[i], n);
        *above = difference > *above ? difference : *above;
        *below = -difference > *below ? -difference : *below;
    }
}

/* The zeta at which both errors are equal, for a given peak. */
static double balance(double scale, int order, double n, double *error) {
    double low = 0.1 * n / order, high = 4 * n / order, above, below;
    for (int i = 0; i < HALVINGS && high - low > 1e-15 * high; ++i) {
        double middle = 0.5 * (low + high);
        family_errors(middle, scale, order, n, &above, &below);
        if (above > below) {
            low = middle;
        } else {
            high = middle;
        }
    }
    family_errors(high, scale, order, n, &above, &below);
    *error = above > below ? above : below;
    return high;
}

/* Lowers the peak until its error equals the other two. */
static void solve_affine(int order, double n, double *zeta, double *scale) {
    double low = 0, high = 0.5, error; /* 1 - scale */
    for (int i = 0; i < HALVINGS && high - low > 1e-15; ++i) {
        double middle = 0.5 * (low + high);
        (void)balance(1 - middle, order, n, &error);
        if (middle < error) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *scale = 1 - low;
    *zeta = balance(*scale, order, n, &error);
}

typedef struct {
    double zeta, exponent;
    int order;
} least_context;

/* Half the derivative of the squared error in -zeta: (lobe - power) m u^(m-1) lambda. */
static double least_integrand(double s, const void *context) {
    const least_context *fit = context;
    double lambda = s * s, u = 1 - fit->zeta * lambda, m = fit->order;
    if (!(u > 0)) {
        return 0;
    }
    double difference = pow(u, m) - burnish_theory_power_at_lambda(lambda, fit->exponent);
    return difference * m * pow(u, m - 1) * lambda * 2 * s * fit->exponent * fit->exponent;
}

static double solve_least_squares(int order, double n) {
    double low = 0.1 * n / order, high = 4 * n / order;
    for (int i = 0; i < HALVINGS && high - low > 1e-13 * high; ++i) {
        double middle = 0.5 * (low + high);
        least_context fit = {middle, n, order};
        burnish_theory_model model = {.kind = BURNISH_THEORY_FAMILY, .zeta = middle, .exponent = n};
        double end = middle > 1 ? 1 / sqrt(middle) : 1;
        if (burnish_theory_quadrature(least_integrand, &fit, &model, 0, end, 1e-14) > 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

burnish_lobe_status burnish_theory_solve(burnish_theory_fit fit, int order, double exponent,
                                         double level, double *zeta, double *scale) {
    double error;
    *zeta = *scale = 0;
    if ((unsigned)fit >= BURNISH_THEORY_FIT_COUNT) {
        return BURNISH_LOBE_ERROR_FIT;
    }
    burnish_lobe_status status = burnish_lobe_check(order, exponent);
    if ((unsigned)fit < BURNISH_FIT_COUNT) {
        status = burnish_theory_zeta((burnish_lobe_fit)fit, order, exponent, level, zeta);
    } else if (status == BURNISH_LOBE_OK && fit == BURNISH_THEORY_GIVEN) {
        status = level > 0 && level <= (double)BURNISH_LOBE_ZETA_MAX ? BURNISH_LOBE_OK
                                                                     : BURNISH_LOBE_ERROR_ZETA;
        *zeta = status == BURNISH_LOBE_OK ? level : 0;
    } else if (status == BURNISH_LOBE_OK && fit == BURNISH_THEORY_AFFINE && exponent < order) {
        status = BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT;
    }
    *scale = status == BURNISH_LOBE_OK ? 1 : 0;
    if (status != BURNISH_LOBE_OK) {
        return status;
    }
    if (fit == BURNISH_THEORY_MINIMAX) {
        *zeta = balance(1, order, exponent, &error);
    } else if (fit == BURNISH_THEORY_LEAST_SQUARES) {
        *zeta = solve_least_squares(order, exponent);
    } else if (fit == BURNISH_THEORY_AFFINE) {
        solve_affine(order, exponent, zeta, scale);
    }
    return BURNISH_LOBE_OK;
}

/* The largest errors of the Moebius lobe before its zero. */
static void moebius_errors(double a, double b, double n, double *above, double *below) {
    burnish_theory_shape shape = burnish_theory_moebius_shape(a, b, n);
    double v[2];
    int count = burnish_theory_stationary(&shape, 1, v);
    *above = *below = 0;
    for (int i = 0; i < count; ++i) {
        double difference =
            (1 - a * v[i]) / (1 + b * v[i]) - burnish_theory_power_at_lambda(v[i], n);
        *above = difference > *above ? difference : *above;
        *below = -difference > *below ? -difference : *below;
    }
}

/* The b at which the two errors before the zero are equal. */
static double balance_moebius(double a, double n, double *error) {
    double low = 0, high = 4 * n, above, below;
    for (int i = 0; i < HALVINGS && high - low > 1e-15 * high; ++i) {
        double middle = 0.5 * (low + high);
        moebius_errors(a, middle, n, &above, &below);
        if (above > below) {
            low = middle;
        } else {
            high = middle;
        }
    }
    moebius_errors(a, high, n, &above, &below);
    *error = above > below ? above : below;
    return high;
}

/* What the power still is at the zero depends on a alone and grows with it. */
void burnish_theory_solve_moebius(double exponent, double *a, double *b) {
    double low = 1, high = exponent, error;
    for (int i = 0; i < HALVINGS && high - low > 1e-15 * high; ++i) {
        double middle = 0.5 * (low + high);
        (void)balance_moebius(middle, exponent, &error);
        if (burnish_theory_power_at_lambda(1 / middle, exponent) < error) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *a = low;
    *b = balance_moebius(low, exponent, &error);
}
