/* burnish/theory.h: harmonics, and sums of lobes for rough surfaces, against formulas and
 * quadrature. */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

static const double PI = 3.14159265358979323846;
static const int orders[] = {1, 2, 4, 8, 16, 32};
enum { ORDERS = sizeof orders / sizeof *orders };

/* The sum over k <= l of (-1)^k C(l, k) C(l + k, k) 2^-k B(k + 1, m + 1) / zeta^(k + 1). */
static double zonal_by_sum(int order, double zeta, int degree) {
    long double sum = 0, term = 1.0L / ((order + 1) * (long double)zeta);
    for (int k = 0; k <= degree; ++k) {
        sum += term;
        term *= -(long double)(degree - k) * (degree + k + 1) /
                (2 * (long double)zeta * (k + 1) * (k + order + 2));
    }
    return (double)(2 * (long double)PI * sum);
}

/* The sum cancels for small slopes, so high degrees are compared for narrow lobes only. */
static void check_zonal(void) {
    static const double zetas[] = {0.5, 0.7, 1, 3, 10, 1000, 23486.466564489732, 65536};
    for (int i = 0; i < ORDERS * 8; ++i) {
        double zeta = zetas[i / ORDERS], whole = 2 * PI / (zeta * (orders[i % ORDERS] + 1));
        int highest = zeta < 10 ? 8 : zeta < 1000 ? 20 : 127 - orders[i % ORDERS];
        for (int degree = 0; degree <= highest; ++degree) {
            double value = burnish_theory_zonal(orders[i % ORDERS], zeta, degree);
            double expected = zonal_by_sum(orders[i % ORDERS], zeta, degree);
            CHECK(fabs(value - expected) < 2e-14 * whole,
                  "order %d, zeta %g, degree %d: %g, not %g", orders[i % ORDERS], zeta, degree,
                  value, expected);
        }
    }
    /* (1 + c) / 2 is P_0 / 2 + P_1 / 2 */
    CHECK1(fabs(burnish_theory_zonal(1, 0.5, 1) - 2 * PI / 3) < 1e-14);
    CHECK1(fabs(burnish_theory_zonal(1, 0.5, 2)) < 1e-14);
    CHECK1(fabs(burnish_theory_zonal(1, 0.25, 0) - 3 * PI) < 1e-14); /* the whole sphere */
    CHECK1(isnan(burnish_theory_zonal(2, 0, 1)) && isnan(burnish_theory_zonal(0, 1, 1)));
    CHECK1(isnan(burnish_theory_zonal(2, 1, -1)) && isnan(burnish_theory_zonal(64, 1, 64)));
    CHECK1(!isnan(burnish_theory_zonal(32, 1, 95)));
}

/* ---- Sums of lobes ---- */

/* The integral of GGX's lobe without its factor is 2 pi (b - log(1 + b)) / b^2. */
static void check_rough_lobes(void) {
    for (int i = 1; i < 20; ++i) {
        double alpha = 0.05 * i, b = (1 / (alpha * alpha) - 1) / 2, lambda = 0.3, h2 = 0.85;
        double value = burnish_theory_rough_value(BURNISH_THEORY_GGX, alpha, 0);
        double peak = b * b / (2 * PI * (b - log1p(b)));
        CHECK(fabs(value / peak - 1) < 1e-8, "alpha %g: %g, not %g", alpha, value, peak);
        double squared = alpha * alpha;
        double ggx = pow(squared / (h2 * (squared - 1) + 1), 2) * (1 - lambda);
        value = burnish_theory_rough_value(BURNISH_THEORY_GGX, alpha, lambda);
        CHECK(fabs(value / (peak * ggx) - 1) < 1e-8, "alpha %g: %g, not %g", alpha, value, ggx);
        double beckmann = exp(-(1 / h2 - 1) / squared) / (h2 * h2) * (1 - lambda);
        value = burnish_theory_rough_value(BURNISH_THEORY_BECKMANN, alpha, lambda) /
                burnish_theory_rough_value(BURNISH_THEORY_BECKMANN, alpha, 0);
        CHECK(fabs(value - beckmann) < 1e-12, "alpha %g: %g, not %g", alpha, value, beckmann);
    }
    CHECK1(burnish_theory_rough_value(BURNISH_THEORY_GGX, 0.5, 1) == 0);
    CHECK1(fabs(burnish_theory_rough_value(BURNISH_THEORY_GGX, 1, 0.25) - 0.75 / PI) < 1e-8);
    CHECK1(isnan(burnish_theory_rough_value(BURNISH_THEORY_GGX, 0, 0)));
    CHECK1(isnan(burnish_theory_rough_value(BURNISH_THEORY_BECKMANN, 1.5, 0)));
}

/* The largest errors of lobe/docs/theory.md, for roughness from 0.05 to 1 and below. */
static void check_sums(void) {
    static const struct {
        double small, large; /* moved, for roughness up to 0.5 and above */
    } bounds[2][3] = {{{0.26, 0.165}, {0.116, 0.045}, {0.063, 0.017}},
                      {{0.073, 0.38}, {0.016, 0.05}, {0.016, 0.05}}};
    for (int i = 0; i < 2 * 3 * 42; ++i) {
        int d = i / 126, count = i / 42 % 3 + 1;
        double roughness = 0.02 + 0.98 * (i % 42) / 41, alpha = roughness * roughness;
        burnish_theory_distribution kind = (burnish_theory_distribution)d;
        burnish_theory_lobe_sum sum;
        burnish_theory_lobe_sum_error error;
        CHECK1(!burnish_theory_lobe_sum_fit(kind, alpha, count, &sum, NULL));
        burnish_theory_lobe_sum_compare(kind, alpha, &sum, &error);
        double bound = roughness <= 0.5 ? bounds[d][count - 1].small : bounds[d][count - 1].large;
        CHECK(error.moved < bound && error.cap <= 2 * error.moved,
              "%d, %d lobes, roughness %g: moved %g, cap %g", d, count, roughness, error.moved,
              error.cap);
        double peak =
            burnish_theory_lobe_sum_value(&sum, 0) / burnish_theory_rough_value(kind, alpha, 0);
        CHECK(fabs(error.peak - peak) < 1e-4, "peak %g, not %g", error.peak, peak);
        double weights = 0, moved = 0;
        for (int j = 0; j < count; ++j) {
            weights += sum.weight[j];
            CHECK(sum.zeta[j] >= 1 && sum.weight[j] >= 0, "zeta %g", sum.zeta[j]);
        }
        CHECK(fabs(weights - 1) < 1e-15, "weights %g", weights);
        for (int k = 0; k < 500 && i % 4 == 0; ++k) { /* the same in steps of lambda^(1/6) */
            double root = (k + 0.5) / 500, lambda = pow(root, 6);
            moved += fabs(burnish_theory_lobe_sum_value(&sum, lambda) -
                          burnish_theory_rough_value(kind, alpha, lambda)) *
                     PI * 6 * pow(root, 5) / 500;
        }
        CHECK(i % 4 || fabs(moved - error.moved) < 2e-3, "moved %g, not %g", error.moved, moved);
    }
    burnish_theory_lobe_sum sum;
    burnish_error error;
    CHECK1(burnish_theory_lobe_sum_fit(BURNISH_THEORY_GGX, 0, 3, &sum, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "alpha 0 is not in (0, 1]");
    CHECK1(burnish_theory_lobe_sum_fit(BURNISH_THEORY_GGX, 0.5, 4, &sum, &error) ==
           BURNISH_STATUS_ARGUMENT);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_zonal());
    RUN(check_rough_lobes());
    RUN(check_sums());
    return test_end("theory_surfaces");
}
