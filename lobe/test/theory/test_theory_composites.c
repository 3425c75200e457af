/* burnish/theory.h: composite lobes against their definition in long double, and the constants of
 * the limit n -> infinity: equal ripple, and no better ones near them. test_theory_energy,
 * _errors and _values have composites among all lobes. */
#include <math.h>
#include <stdlib.h>

#include "burnish/theory.h"
#include "support.h"

typedef long double real;

static const double HALF_PI = 1.57079632679489661923;
static uint64_t random_state;

/* The definition. */
static real composite(real zeta, const double *b, int steps, real lambda) {
    real u = fmaxl(0, 1 - zeta * lambda), w = u * u;
    for (int i = 0; i < steps; ++i) {
        w = w * (w + b[i]) / (1 + (real)b[i]);
    }
    return w;
}

static burnish_theory_model random_model(double least_zeta) {
    burnish_theory_model model;
    double b[4];
    int steps = (int)test_uniform(&random_state, 0, 4.999);
    for (int i = 0; i < steps; ++i) { /* a fifth each: 0, and so large that the step does little */
        double kind = test_uniform(&random_state, 0, 1);
        b[i] = kind < 0.2 ? 0 : exp(test_uniform(&random_state, -6, kind < 0.4 ? 12 : 3));
    }
    double zeta = least_zeta * exp(test_uniform(&random_state, 0, 8));
    double n = zeta * exp(test_uniform(&random_state, 0, 2.5)) + 1;
    CHECK1(burnish_theory_composite_create(&model, fmin(n, 65536), zeta, b, steps) ==
           BURNISH_LOBE_OK);
    return model;
}

static real own_value(const burnish_theory_model *model, real lambda) {
    return composite(model->zeta, model->k, model->steps, lambda);
}

static void check_values(const burnish_theory_model *model) {
    double c[BURNISH_THEORY_DEGREE_MAX + 1], peak = 0;
    int degree = burnish_theory_polynomial(model, c);
    CHECK1(degree == 2 << model->steps);
    for (int j = 0; j <= BURNISH_THEORY_DEGREE_MAX; ++j) {
        peak += c[j];
        CHECK1(c[j] >= 0 && (j <= degree || c[j] == 0));
    }
    CHECK1(fabs(peak - 1) < 1e-14);
    for (int i = 0; i <= 20; ++i) {
        double lambda = i / (19 * model->zeta);
        real expected = own_value(model, lambda), u = 1 - model->zeta * (real)lambda, sum = 0;
        CHECK1(fabsl(burnish_theory_value_at_lambda(model, lambda) - expected) < 1e-14L);
        for (int j = degree; j >= 0 && u > 0; --j) {
            sum = sum * u + c[j];
        }
        CHECK1(fabsl(sum - expected) < 1e-13L);
    }
}

/* The radius at the zero, and harmonics as sums of those of powers. */
static void check_radius(const burnish_theory_model *model) {
    double foot = 1, radius = burnish_theory_zero_curvature_radius(model), sum = 0;
    double c[BURNISH_THEORY_DEGREE_MAX + 1];
    for (int i = 0; i < model->steps; ++i) {
        foot *= model->k[i] / (1 + model->k[i]);
    }
    CHECK1(model->zeta < 1 ||
           (foot == 0 ? isinf(radius) : fabs(radius * foot * (4 * model->zeta - 2) - 1) < 1e-12));
    for (int j = burnish_theory_polynomial(model, c); j > 0; --j) {
        sum += c[j] * burnish_theory_zonal(j, model->zeta, 3);
    }
    CHECK1(fabs(burnish_theory_model_zonal(model, 3) - sum) <
           1e-12 * burnish_theory_model_zonal(model, 0));
}

static void check_bad_input(void) {
    static const double bad[][2] = {{-1, 1}, {NAN, 1}, {HUGE_VAL, 1}, {1, 0}, {1, NAN}, {1, 7e4}};
    burnish_theory_model model = {.steps = 7};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK1(burnish_theory_composite_create(&model, 10, bad[i][1], bad[i], 1) !=
               BURNISH_LOBE_OK);
    }
    CHECK1(burnish_theory_composite_create(&model, 10, 2, NULL, 0) == BURNISH_LOBE_OK);
    CHECK1(burnish_theory_composite_create(&model, 0.5, 2, NULL, 0) == BURNISH_LOBE_ERROR_EXPONENT);
    CHECK1(burnish_theory_composite_create(&model, 10, 2, NULL, 5) ==
               BURNISH_LOBE_ERROR_COMPOSITE &&
           model.steps == 0);
    CHECK1(!burnish_theory_model_parse("schlick", 10, &model, NULL));
    CHECK1(isnan(burnish_theory_model_zonal(&model, 3)));
}

/* ---- The limit n -> infinity ---- */

/* zeta/n and b of the least error against e^-x, by Newton's method, as in docs/theory.md. */
static const struct limit {
    int steps, extremes;
    double zeta, b[4], error;
} LIMITS[] = {
    {0, 2, 0.355859264140901, {0}, 0.0699443102296388},
    {1, 2, 0.240635655155523, {0.26877327518418}, 0.0293732302470203},
    {2, 2, 0.167233070010354, {0.354818158514469, 0.492170304995857}, 0.00517263794780708},
    {3,
     4,
     0.108093534048636,
     {0.413317305974773, 1.54784362846574, 0.060389895450679},
     0.000135170648759215},
    {4,
     6,
     0.0699998759304894,
     {0.974004058158566, 2.89367778491539, 0.124471545365681, 0.00339013332163065},
     9.9979368449544e-7},
};

/* The largest error against e^-x; counts local extremes of nearly that size. */
static real limit_error(const struct limit *l, const double *b, real zeta, int *extremes) {
    enum { POINTS = 4000 };
    static real e[POINTS + 1];
    real most = 0;
    for (int i = 0; i <= POINTS; ++i) {
        real x = 20 * powl((real)i / POINTS, 2);
        e[i] = fabsl(composite(zeta, b, l->steps, x) - expl(-x));
        most = fmaxl(most, e[i]);
    }
    for (int i = 1; i < POINTS && extremes; ++i) {
        *extremes += e[i] >= e[i - 1] && e[i] > e[i + 1] && e[i] > 0.999L * most;
    }
    return most;
}

static void check_limits(void) {
    for (size_t k = 0; k < sizeof LIMITS / sizeof *LIMITS; ++k) {
        const struct limit *l = &LIMITS[k];
        int extremes = 0;
        real error = limit_error(l, l->b, l->zeta, &extremes);
        CHECK(fabsl(error / l->error - 1) < 3e-5L && extremes == l->extremes, "%d: %.9Lg, %d",
              l->steps + 2, error, extremes);
        for (int i = 0; i < 600; ++i) { /* none near them is better */
            double b[4] = {0}, size = pow(10, test_uniform(&random_state, -5, -1));
            for (int j = 0; j < l->steps; ++j) {
                b[j] = l->b[j] * (1 + size * test_uniform(&random_state, -1, 1));
            }
            real zeta = l->zeta * (1 + 0.1L * size * test_uniform(&random_state, -1, 1));
            CHECK1(limit_error(l, b, zeta, NULL) > l->error * (1 - 3e-5L));
        }
        if (k > 0) { /* faster than geometrically */
            CHECK1(k < 2 || l->error / l[-1].error < 0.5 * l[-1].error / l[-2].error);
        }
        burnish_theory_model model;
        CHECK1(!burnish_theory_composite_create(&model, 65536, 65536 * l->zeta, l->b, l->steps));
        CHECK1(fabs(burnish_theory_maximum_error(&model, HALF_PI) - l->error) < 5e-6);
    }
}

static void check_models(void) {
    for (int i = 0; i < 60; ++i) {
        burnish_theory_model model = random_model(i % 4 ? 1 : 0.3);
        check_values(&model);
        check_radius(&model);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    random_state = test_seed(0);
    RUN(check_models());
    RUN(check_bad_input());
    RUN(check_limits());
    return test_end("theory_composites");
}
