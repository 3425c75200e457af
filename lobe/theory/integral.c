/* Energy: integrals over the hemisphere, normalisation, densities. */
#include <math.h>

#include "theory/internal.h"

static double gaussian_integral(double k, int weighted, double end) {
    double plain = -expm1(-k * end) / k;
    return weighted ? plain - (plain - end * exp(-k * end)) / k : plain;
}

/* Cells of the table from lambda0 to lambda1, each integrated exactly by Simpson's rule. */
static double table_integral(const burnish_theory_model *model, int weighted, double lambda0,
                             double lambda1) {
    double last = model->lobe.entries - 1, offset = model->lobe.linear ? 0 : 0.5, sum = 0;
    double c = 1 - lambda1, top = 1 - lambda0;
    long i =
        (long)floor(c * last + offset); /* linear: the cell's lower entry; nearest: the entry */
    double value = burnish_theory_table_entry(model, i);
    while (c < top) {
        double bottom = ((double)i - offset) / last;
        double next_value = burnish_theory_table_entry(model, i + 1);
        double end = bottom + 1 / last < top ? bottom + 1 / last : top;
        double slope = model->lobe.linear ? (next_value - value) * last : 0;
        double low = value + slope * (c - bottom), high = value + slope * (end - bottom);
        double middle = 0.5 * (low + high);
        if (weighted) {
            low *= c;
            middle *= 0.5 * (c + end);
            high *= end;
        }
        sum += (end - c) * (low + 4 * middle + high) / 6;
        c = end;
        value = next_value;
        if (++i >= model->lobe.entries + 1) {
            break;
        }
    }
    return sum;
}

typedef struct {
    const burnish_theory_model *model;
    int weighted;
} lobe_context;

static double lobe_integrand(double s, const void *context) {
    const lobe_context *lobe = context;
    double lambda = s * s;
    return burnish_theory_value_at_lambda(lobe->model, lambda) * (lobe->weighted ? 1 - lambda : 1) *
           2 * s;
}

/* From lambda = 0 on, in closed form; NaN without one. */
static double closed_integral(const burnish_theory_model *model, int weighted, double end) {
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
    case BURNISH_LOBE_COMPOSITE:
        return burnish_theory_polynomial_integral(model, weighted, end);
    case BURNISH_LOBE_POWER: {
        double power = model->exponent + (weighted ? 2 : 1);
        return -expm1(power * (end < 1 ? log1p(-end) : -HUGE_VAL)) / power;
    }
    case BURNISH_LOBE_GAUSSIAN:
        return gaussian_integral(model->exponent + 0.775, weighted, end);
    case BURNISH_LOBE_SCHLICK:
    case BURNISH_LOBE_GX:
    case BURNISH_LOBE_NV2X:
    case BURNISH_LOBE_KUIJK_BLAKE:
    case BURNISH_LOBE_TABLE:
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return NAN;
}

double burnish_theory_integral_between(const burnish_theory_model *model,
                                       burnish_theory_measure measure, double lambda0,
                                       double lambda1) {
    int weighted = measure == BURNISH_THEORY_COSINE_WEIGHTED;
    if (model->lobe.kind == BURNISH_LOBE_TABLE) {
        return table_integral(model, weighted, lambda0, lambda1);
    }
    double closed = closed_integral(model, weighted, lambda1);
    if (!isnan(closed)) {
        return closed - (lambda0 > 0 ? closed_integral(model, weighted, lambda0) : 0);
    }
    lobe_context context = {model, weighted};
    return burnish_theory_quadrature(lobe_integrand, &context, model, sqrt(lambda0), sqrt(lambda1),
                                     1e-14 / (model->exponent + 1));
}

double burnish_theory_partial_integral(const burnish_theory_model *model,
                                       burnish_theory_measure measure, double from) {
    double end = from > 0 ? 1 - from : 1;
    return end > 0 ? 2 * BURNISH_PI * burnish_theory_integral_between(model, measure, 0, end) : 0;
}

double burnish_theory_integral(const burnish_theory_model *model, burnish_theory_measure measure) {
    return burnish_theory_partial_integral(model, measure, 0);
}

double burnish_theory_phong_factor(const burnish_theory_model *model) {
    return 1 / burnish_theory_integral(model, BURNISH_THEORY_COSINE_WEIGHTED);
}

double burnish_theory_normal_factor(const burnish_theory_model *model) {
    return 1 / burnish_theory_integral(model, BURNISH_THEORY_COSINE_WEIGHTED);
}

/* With the light at twice the half vector's angle: cos = 2 h^2 - 1, d omega = 8 pi h dh. */
static double blinn_integrand(double s, const void *context) {
    double lambda = s * s, h = 1 - lambda;
    return burnish_theory_value_at_lambda(context, lambda) * (2 * h * h - 1) * h * 2 * s;
}

double burnish_theory_blinn_factor(const burnish_theory_model *model) {
    double n = model->exponent;
    if (model->lobe.kind == BURNISH_LOBE_POWER) {
        return (n + 2) * (n + 4) / (8 * BURNISH_PI * (exp2(-0.5 * n) + n));
    }
    double end = sqrt(1 - sqrt(0.5));
    return 1 / (8 * BURNISH_PI *
                burnish_theory_quadrature(blinn_integrand, model, model, 0, end, 1e-14 / (n + 1)));
}

double burnish_theory_blinn_factor_common(double exponent) {
    return (exponent + 8) / (8 * BURNISH_PI);
}

double burnish_theory_pdf(const burnish_theory_model *model, burnish_theory_measure measure,
                          double cosine) {
    if (!(cosine >= 0 && cosine <= 1)) {
        return 0;
    }
    double weight = measure == BURNISH_THEORY_COSINE_WEIGHTED ? cosine : 1;
    return burnish_theory_value(model, cosine) * weight / burnish_theory_integral(model, measure);
}
