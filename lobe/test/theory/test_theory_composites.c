/* burnish/theory.h: composite lobes against their definition in long double.
 * test_theory_energy, _errors and _values have composites among all lobes. */
#include <math.h>
#include <stdlib.h>

#include "burnish/theory.h"
#include "support.h"

typedef long double real;

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
    return test_end("theory_composites");
}
