/* burnish/theory.h: the fits against independent evaluations in long double, the properties that
 * define them, the values to compare lobes with, and the errors. */
#include <float.h>
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

static const double exponents[] = {1,  1.5, 2,  2.999, 3,   4,    5,    8,    10,    16,
                                   18, 32,  50, 99.5,  100, 1000, 1024, 4096, 65535, 65536};
enum { EXPONENT_COUNT = sizeof exponents / sizeof exponents[0] };

/* The closed formulas of the fits, written independently. */
enum { FORMULAS = BURNISH_FIT_PROJECTED + 1 };
static long double zeta_by_the_book(burnish_lobe_fit fit, int order, long double n,
                                    long double level) {
    long double m = order;
    switch (fit) {
    case BURNISH_FIT_TAYLOR:
        return n / m;
    case BURNISH_FIT_ENERGY:
        return (n + 1) / (m + 1);
    case BURNISH_FIT_LEVEL:
        return expm1l(logl(level) / m) / expm1l(logl(level) / n);
    case BURNISH_FIT_SHIFT7:
        return 7 * n / 16;
    case BURNISH_FIT_SHIFT3:
        return 3 * n / 8;
    case BURNISH_FIT_PROJECTED:
        return ((m + 2) * (n + 2) +
                sqrtl((m + 2) * (m + 2) * (n + 2) * (n + 2) - 4 * (m + 1) * (m + 2) * (n + 2))) /
               (2 * (m + 1) * (m + 2));
    default:
        break;
    }
    return NAN;
}

static int allowed(burnish_lobe_fit fit, int order, double n) {
    if (fit == BURNISH_FIT_SHIFT7 || fit == BURNISH_FIT_SHIFT3) {
        return order == 2;
    }
    return n >= order || (order == 2 && fit != BURNISH_FIT_PROJECTED);
}

static void check_formulas(void) {
    static const double levels[] = {1e-300, 1e-6, 0.1, 0.45, 0.5, 0.9, 0.999999, 1 - 1e-9};
    double worst[FORMULAS] = {0}, scale;
    for (int fit = 0; fit < FORMULAS; ++fit) {
        for (int i = 0; i < EXPONENT_COUNT * 5 * 8; ++i) {
            double n = exponents[i / 40], level = levels[i % 8], zeta = -1;
            int order = 2 << i / 8 % 5;
            burnish_lobe_status status = burnish_lobe_solve(
                &(burnish_lobe_spec){
                    .fit = (burnish_lobe_fit)fit, .order = order, .parameter = level},
                n, &zeta, &scale);
            if (!allowed((burnish_lobe_fit)fit, order, n)) {
                CHECK(status != BURNISH_LOBE_OK && zeta == 0, "fit %d order %d n=%g", fit, order,
                      n);
                continue;
            }
            long double expected = zeta_by_the_book((burnish_lobe_fit)fit, order, n, level);
            double error = (double)fabsl(zeta / expected - 1);
            CHECK(status == BURNISH_LOBE_OK && scale == 1 && error < 2e-15,
                  "fit %d order %d n=%g Q=%g: %.17g", fit, order, n, level, zeta);
            worst[fit] = fmax(worst[fit], error);
        }
        printf("fit %d: largest relative error of zeta %.2g\n", fit, worst[fit]);
    }
}

static double zeta_of(burnish_lobe_fit fit, int order, double n, double level) {
    double zeta, scale;
    CHECK(burnish_lobe_solve(&(burnish_lobe_spec){.fit = fit, .order = order, .parameter = level},
                             n, &zeta, &scale) == BURNISH_LOBE_OK,
          "%d:%d %g", (int)fit, order, n);
    return zeta;
}

static void check_refused(burnish_lobe_fit fit, int order, double n, double level,
                          burnish_lobe_status expected) {
    double zeta = 7, scale = 7;
    burnish_lobe_status status = burnish_lobe_solve(
        &(burnish_lobe_spec){.fit = fit, .order = order, .parameter = level}, n, &zeta, &scale);
    CHECK(status == expected && zeta == 0 && scale == 0, "fit %d order %d n=%g Q=%g: %s", (int)fit,
          order, n, level, burnish_lobe_status_text(status));
}

static void check_errors(void) {
    static const double bad_levels[] = {0, 1, -0.5, 1.5, NAN, HUGE_VAL, -HUGE_VAL};
    static const double bad_exponents[] = {0, 1 - 1e-15, 65536.00000001, NAN, HUGE_VAL, -10};
    static const int bad_orders[] = {0, 1, 3, 12, 33, 64, -2, 2147483647};
    for (int i = 0; i < 7; ++i) {
        check_refused(BURNISH_FIT_LEVEL, 2, 10, bad_levels[i], BURNISH_LOBE_ERROR_LEVEL);
        CHECK1(zeta_of(BURNISH_FIT_ENERGY, 2, 8, bad_levels[i]) == 3); /* not read */
    }
    for (int fit = 0; fit < BURNISH_FIT_COUNT; ++fit) {
        for (int i = 0; i < 6; ++i) {
            check_refused((burnish_lobe_fit)fit, 2, bad_exponents[i], 0.5,
                          BURNISH_LOBE_ERROR_EXPONENT);
        }
        for (int i = 0; i < 8; ++i) {
            check_refused((burnish_lobe_fit)fit, bad_orders[i], 10, 0.5, BURNISH_LOBE_ERROR_ORDER);
        }
        int shift = fit == BURNISH_FIT_SHIFT7 || fit == BURNISH_FIT_SHIFT3;
        if (fit == BURNISH_FIT_GIVEN) { /* whatever the exponent */
            continue;
        }
        check_refused((burnish_lobe_fit)fit, 16, 15.999, 0.5,
                      shift ? BURNISH_LOBE_ERROR_ORDER : BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT);
    }
    check_refused(BURNISH_FIT_PROJECTED, 2, 1.999, 0.5, BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT);
    check_refused(BURNISH_FIT_PROJECTED, 3, 1.999, 0.5, BURNISH_LOBE_ERROR_ORDER);
    check_refused(BURNISH_FIT_AFFINE, 2, 1.999, 0.5, BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT);
    static const double bad_zetas[] = {0, -1, 65536.01, NAN, HUGE_VAL};
    for (int i = 0; i < 5; ++i) {
        check_refused(BURNISH_FIT_GIVEN, 2, 10, bad_zetas[i], BURNISH_LOBE_ERROR_ZETA);
    }
    CHECK1(zeta_of(BURNISH_FIT_GIVEN, 16, 3, 6.645) == 6.645);
    check_refused(BURNISH_FIT_COUNT, 2, 10, 0.5, BURNISH_LOBE_ERROR_FIT);
    check_refused((burnish_lobe_fit)-1, 2, 10, 0.5, BURNISH_LOBE_ERROR_FIT);
    check_refused((burnish_lobe_fit)1000, 3, NAN, 0.5, BURNISH_LOBE_ERROR_FIT);
}

static void check_values(void) {
    CHECK1(burnish_theory_family(4, 2, 0.875) == 0.25 &&
           burnish_theory_family(4, 4, 0.875) == 0.0625);
    CHECK1(burnish_theory_family(4, 2, 0.75) == 0 && burnish_theory_family(4, 3, 1) == 0);
    CHECK1(burnish_theory_family(0.25, 2, -1) == 0.25);
    CHECK1(burnish_theory_power(0.5, 3) == 0.125 && burnish_theory_power(0, 3) == 0);
    CHECK1(burnish_theory_power(0.25, 0) == 1 && burnish_theory_power(0, 0) == 0);
    CHECK1(burnish_theory_power(-0.5, 2) == 0);
    CHECK1(fabs(burnish_theory_schlick(0.5, 3) - 0.25) < 1e-16);
    for (double c = 0.001; c < 1; c += 0.001) {
        double n = 20, book = c / (n - n * c + c);
        CHECK(fabs(burnish_theory_schlick(c, n) - book) < 1e-14, "schlick at %g", c);
        double s = 0.9 + 0.2 * c;
        CHECK1(fabs(burnish_theory_lyon_normalize_factor(s) * sqrt(s) - 1) < 0.0004);
    }
}

/* Every value is finite and in [0, 1], NaN gives 0. */
static void check_special_values(void) {
    static const double special[] = {NAN,     HUGE_VAL, -HUGE_VAL, 0,      -0.0,           1, -1, 2,
                                     DBL_MAX, -DBL_MAX, 0.5,       1e-320, 1 + DBL_EPSILON};
    for (size_t i = 0; i < sizeof special / sizeof special[0]; ++i) {
        double c = special[i];
        double values[] = {burnish_theory_family(5, 2, c), burnish_theory_power(c, 10),
                           burnish_theory_schlick(c, 10)};
        double bad_parameter[] = {burnish_theory_family(NAN, 2, c), burnish_theory_power(c, NAN),
                                  burnish_theory_schlick(c, NAN)};
        for (int k = 0; k < 3; ++k) {
            CHECK(values[k] >= 0 && values[k] <= 1, "lobe %d at %g: %g", k, c, values[k]);
            CHECK(!isnan(c) || values[k] == 0, "lobe %d at NaN: %g", k, values[k]);
            CHECK(c < 1 || isnan(c) || values[k] == 1, "lobe %d at %g: %g", k, c, values[k]);
            CHECK(bad_parameter[k] == 0, "lobe %d at %g: %g", k, c, bad_parameter[k]);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_formulas());
    RUN(check_errors());
    RUN(check_values());
    RUN(check_special_values());
    return test_end("theory");
}
