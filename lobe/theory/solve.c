/* Solves for the angles at which a lobe and cos^n have equal slopes, and for the best Moebius lobe. */
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

/* A zero of the slope ratio in [low, high], on which it is monotone; 0 if it has no zero. */
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
    limit *= 1 - 1e-15; /* both slopes may vanish at the end itself */
    /* g' = e s / (1 + s v) - k + p / (1 - v); either e or k is 0 */
    double candidate = shape->k > 0 ? 1 - p / shape->k : (e * s + p) / (s * (e - p));
    if (candidate > 0 && candidate < limit) {
        turn = candidate;
    }
    count += find_zero(shape, 0, turn < limit ? turn : limit, v);
    count += find_zero(shape, turn, limit, v + count);
    return count;
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

/* The value of cos^n at the zero depends only on a and grows with it. */
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
