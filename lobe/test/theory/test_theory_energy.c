/* burnish/theory.h: integrals against GSL's adaptive quadrature, sampling by
 * chi-square. */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdint.h>

#include "burnish/theory.h"
#include "support.h"

static const double PI = 3.14159265358979323846;
static const double exponents[] = {1, 1.5, 2, 3, 10, 64, 1000, 65536};
enum { EXPONENT_COUNT = sizeof exponents / sizeof exponents[0] };

/* ---- Integrals ---- */

typedef struct {
    const burnish_theory_model *model;
    int weight; /* 0 solid angle, 1 cosine, 2 Blinn */
} integrand;

static double evaluate(double lambda, void *context) {
    const integrand *f = context;
    double c = 1 - lambda;
    return burnish_theory_value_at_lambda(f->model, lambda) * (f->weight == 0 ? 1
                                                               : f->weight == 1
                                                                   ? c
                                                                   : 4 * c * (2 * c * c - 1));
}

/* 2 pi times the integral over lambda, in pieces that end where the lobe has a corner. */
static double by_gsl(const burnish_theory_model *model, int weight, double end) {
    static gsl_integration_workspace *workspace;
    gsl_function f = {evaluate, &(integrand){model, weight}};
    double sum = 0, at = 0, corners[3] = {burnish_theory_zero_angle(model), 0, 0};
    workspace = workspace ? workspace : gsl_integration_workspace_alloc(2000);
    corners[0] = isnan(corners[0]) ? 9 : 1 - burnish_theory_cutoff_cosine(model);
    if (model->lobe.kind == BURNISH_LOBE_KUIJK_BLAKE) {
        corners[1] = 1 - cos(model->k[0]);
    }
    for (int k = 0; at < end; ++k) {
        double next = ldexp(1 / model->exponent, k), value, error;
        next = next > at ? next : end;
        next = next < end ? next : end;
        for (int i = 0; i < 2; ++i) {
            if (corners[i] > at && corners[i] < next) {
                next = corners[i];
                --k;
            }
        }
        gsl_integration_qag(&f, at, next, 1e-14 / model->exponent, 1e-11, 2000, GSL_INTEG_GAUSS31,
                            workspace, &value, &error);
        sum += value;
        at = next;
    }
    return 2 * PI * sum;
}

/* Tables have a corner or step per cell: their own sum over cells. */
static double by_cells(const burnish_theory_model *model, int weight) {
    long double sum = 0;
    int parts = 2 * (model->lobe.entries - 1);
    for (int i = 0; i < parts; ++i) { /* half cells; two-point Gauss is exact for cubics */
        for (int sign = -1; sign <= 1; sign += 2) {
            double c = (i + 0.5 + sign * 0.28867513459481287) / parts;
            sum += burnish_theory_value(model, c) * (weight ? c : 1);
        }
    }
    return (double)(2 * PI * sum / (2 * parts));
}

static void check_integrals(const burnish_theory_model *model, const char *name) {
    for (int weight = 0; weight < 2; ++weight) {
        burnish_theory_measure measure = (burnish_theory_measure)weight;
        int table = model->lobe.kind == BURNISH_LOBE_TABLE;
        double expected = table ? by_cells(model, weight) : by_gsl(model, weight, 1);
        double value = burnish_theory_integral(model, measure);
        CHECK(fabs(value / expected - 1) < 1e-10, "%s, measure %d: %.15g, not %.15g", name, weight,
              value, expected);
        if (table) {
            continue;
        }
        for (int i = 1; i <= 3; ++i) {
            double from = 1 - i * 0.7 / model->exponent;
            if (from > 0) {
                expected = by_gsl(model, weight, 1 - from);
                value = burnish_theory_partial_integral(model, measure, from);
                CHECK(fabs(value / expected - 1) < 1e-10, "%s, measure %d from %g: %.15g, %.15g",
                      name, weight, from, value, expected);
            }
        }
    }
    CHECK1(burnish_theory_partial_integral(model, BURNISH_THEORY_SOLID_ANGLE, 1) == 0);
    if (model->lobe.kind != BURNISH_LOBE_TABLE) {
        double expected = 1 / by_gsl(model, 2, 1 - sqrt(0.5));
        double factor = burnish_theory_blinn_factor(model);
        CHECK(fabs(factor / expected - 1) < 1e-10, "%s, Blinn: %.15g, %.15g", name, factor,
              expected);
    }
    CHECK1(fabs(burnish_theory_phong_factor(model) * burnish_theory_integral(model, 1) - 1) <
           1e-15);
    CHECK1(burnish_theory_normal_factor(model) == burnish_theory_phong_factor(model));
}

/* ---- Sampling ---- */

static uint64_t random_state;

enum { BINS = 40, FEW = 4000, MANY = 80000 };

/* Chi-square over bins of equal probability; the bins come from the integral that GSL confirmed. */
static double chi_square(const burnish_theory_model *model, burnish_theory_measure measure,
                         int count) {
    double total = burnish_theory_integral(model, measure), sum = 0;
    int bins[BINS] = {0};
    for (int i = 0; i < count; ++i) {
        double c = burnish_theory_sample_cosine(model, measure, test_uniform(&random_state, 0, 1));
        int bin = (int)(BINS * burnish_theory_partial_integral(model, measure, c) / total);
        ++bins[bin < BINS ? bin : BINS - 1];
    }
    for (int i = 0; i < BINS; ++i) {
        double difference = bins[i] - (double)count / BINS;
        sum += difference * difference / ((double)count / BINS);
    }
    return sum;
}

static double limit(void) {
    return gsl_cdf_chisq_Qinv(1e-7, BINS - 1);
}

static void check_sampling(const burnish_theory_model *model, const char *name) {
    int table = model->lobe.kind == BURNISH_LOBE_TABLE;
    int quick =
        (model->lobe.order > 0 && model->zeta >= 1 && model->lobe.kind != BURNISH_LOBE_COMPOSITE) ||
        model->lobe.kind == BURNISH_LOBE_POWER;
    for (int measure = 0; measure < 2; ++measure) {
        double x = chi_square(model, (burnish_theory_measure)measure,
                              quick   ? MANY
                              : table ? FEW / 4
                                      : FEW);
        CHECK(x < limit(), "%s, measure %d: chi-square %g", name, measure, x);
    }
}

static double pdf_value(double c, void *context) {
    const integrand *f = context;
    return 2 * PI * burnish_theory_pdf(f->model, (burnish_theory_measure)f->weight, c);
}

/* Densities integrate to 1; directions are unit vectors with uniform azimuths. */
static void check_densities(void) {
    gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(2000);
    static const char *const words[] = {"energy:2", "power", "schlick", "gaussian", "affine:4"};
    for (int i = 0; i < 10; ++i) {
        burnish_theory_model model;
        CHECK1(!burnish_theory_model_parse(words[i / 2], 20, &model, NULL));
        gsl_function f = {pdf_value, &(integrand){&model, i % 2}};
        double value, error;
        gsl_integration_qag(&f, 0, 1, 0, 1e-9, 2000, GSL_INTEG_GAUSS31, workspace, &value, &error);
        CHECK(fabs(value - 1) < 1e-8, "%s: %.12g", words[i / 2], value);
        CHECK1(burnish_theory_pdf(&model, BURNISH_THEORY_SOLID_ANGLE, -0.1) == 0);
        int azimuths[16] = {0};
        double sum = 0;
        for (int k = 0; k < FEW; ++k) {
            double xi[2] = {test_uniform(&random_state, 0, 1), test_uniform(&random_state, 0, 1)},
                   d[3];
            burnish_theory_sample_direction(&model, (burnish_theory_measure)(i % 2), xi, d);
            CHECK1(fabs(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] - 1) < 1e-14 && d[2] >= 0);
            ++azimuths[(int)(8 * (1 + atan2(d[1], d[0]) / PI)) & 15];
        }
        for (int k = 0; k < 16; ++k) {
            sum += (azimuths[k] - FEW / 16.0) * (azimuths[k] - FEW / 16.0) / (FEW / 16.0);
        }
        CHECK(sum < gsl_cdf_chisq_Qinv(1e-7, 15), "%s: azimuths %g", words[i / 2], sum);
    }
    gsl_integration_workspace_free(workspace);
    CHECK1(fabs(burnish_theory_blinn_factor_common(100) - 108 / (8 * PI)) < 1e-14);
}

static void check_models(void) {
    int models = 0;
    random_state = test_seed(0);
    for (size_t w = 0; burnish_lobe_spec_example(w); ++w) {
        for (int i = 0; i < EXPONENT_COUNT; ++i) {
            const char *word = burnish_lobe_spec_example(w);
            char name[64];
            burnish_theory_model model;
            if (burnish_theory_model_parse(word, exponents[i], &model, NULL)) {
                continue;
            }
            snprintf(name, sizeof name, "%s n=%g", word, exponents[i]);
            check_integrals(&model, name);
            if (i % 3 == 1) {
                check_sampling(&model, name);
            }
            ++models;
        }
    }
    CHECK(models > 120, "only %d models", models);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    gsl_set_error_handler_off();
    RUN(check_models());
    RUN(check_densities());
    return test_end("theory_energy");
}
