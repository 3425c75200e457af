/* Widths: zeros, levels, curvature, boundary cosines. */
#include <math.h>

#include "theory/internal.h"

static double zero_lambda(const burnish_theory_model *model) {
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
    case BURNISH_LOBE_NV2X:
    case BURNISH_LOBE_COMPOSITE:
        return 1 / model->zeta;
    case BURNISH_LOBE_KUIJK_BLAKE:
        return burnish_theory_lambda_of_angle(model->k[1]);
    case BURNISH_LOBE_TABLE:
        return model->lobe.linear ? 1 : 1 - 0.5 / (model->lobe.entries - 1);
    case BURNISH_LOBE_POWER:
    case BURNISH_LOBE_SCHLICK:
    case BURNISH_LOBE_GX:
        return 1;
    case BURNISH_LOBE_GAUSSIAN:
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return NAN;
}

double burnish_theory_cutoff_cosine(const burnish_theory_model *model) {
    return 1 - zero_lambda(model);
}

/* The last entry that is at most level: the inverse of cos^n, corrected by one if needed. */
static double table_lambda_at(const burnish_theory_model *model, double level) {
    double last = model->lobe.entries - 1;
    long i = (long)(pow(level, 1 / model->exponent) * last);
    i = i < model->lobe.entries - 2 ? i : model->lobe.entries - 2;
    while (i > 0 && burnish_theory_table_entry(model, i) > level) {
        --i;
    }
    while (i < model->lobe.entries - 2 && burnish_theory_table_entry(model, i + 1) <= level) {
        ++i;
    }
    if (!model->lobe.linear) {
        return (last - (double)i - 0.5) / last;
    }
    double low = burnish_theory_table_entry(model, i);
    double high = burnish_theory_table_entry(model, i + 1);
    return (last - (double)i - (level - low) / (high - low)) / last;
}

static double kuijk_blake_lambda_at(const burnish_theory_model *model, double level) {
    double a = model->k[0], b = model->k[1];
    double x = level >= (b - a) / b ? sqrt((1 - level) * a * b) : b - sqrt(level * b * (b - a));
    return burnish_theory_lambda_of_angle(x);
}

/* Undoes the steps, from the last; keeps 1 - level, too, for its digits near the peak. */
static double composite_lambda_at(const burnish_theory_model *model, double level) {
    double rest = 1 - level;
    for (int i = model->steps; i-- > 0;) {
        const double b = model->k[i], root = sqrt(b * b + 4 * (1 + b) * level);
        level = 2 * (1 + b) * level / (b + root);
        rest = 2 * (1 + b) * rest / (2 + b + root);
    }
    return rest / (1 + sqrt(level)) / model->zeta;
}

static double lambda_at_positive(const burnish_theory_model *model, double level) {
    double n = model->exponent, h = 0.5 * n;
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
        return -expm1(log(level / model->scale) / model->lobe.order) / model->zeta;
    case BURNISH_LOBE_COMPOSITE:
        return composite_lambda_at(model, level);
    case BURNISH_LOBE_POWER:
        return -expm1(log(level) / n);
    case BURNISH_LOBE_SCHLICK:
        return (1 - level) / (1 + (n - 1) * level);
    case BURNISH_LOBE_GAUSSIAN:
        return -log(level) / (n + 0.775);
    case BURNISH_LOBE_GX: {
        double squared_sine = (1 - level) / (1 - level + level * h);
        return squared_sine / (1 + sqrt(1 - squared_sine));
    }
    case BURNISH_LOBE_NV2X:
        return (1 - level) / (model->zeta * (1 - level * model->k[1]));
    case BURNISH_LOBE_KUIJK_BLAKE:
        return kuijk_blake_lambda_at(model, level);
    case BURNISH_LOBE_TABLE:
        return table_lambda_at(model, level);
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return NAN;
}

double burnish_theory_lambda_at(const burnish_theory_model *model, double level) {
    if (!(level >= 0 && level < 1)) {
        return NAN;
    }
    if (level >= model->scale) {
        return 0;
    }
    double lambda = level > 0 ? lambda_at_positive(model, level) : zero_lambda(model);
    return lambda <= 2 ? lambda : NAN;
}

double burnish_theory_angle_at(const burnish_theory_model *model, double level) {
    return burnish_theory_angle_of_lambda(burnish_theory_lambda_at(model, level));
}

double burnish_theory_zero_angle(const burnish_theory_model *model) {
    return burnish_theory_angle_at(model, 0);
}

/* Slope and second derivative in the angle at the zero, both in closed form: a rounding error would
 * put a computed zero on one side of the corner. */
static void slopes_at_zero(const burnish_theory_model *model, double slope[2]) {
    double n = model->exponent, a = model->zeta;
    slope[0] = slope[1] = 0;
    if (model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON) {
        slope[1] = model->lobe.order == 2 ? model->scale * (4 * a - 2) : 0;
    } else if (model->lobe.kind == BURNISH_LOBE_COMPOSITE) {
        slope[1] = 4 * a - 2;
        for (int i = 0; i < model->steps; ++i) {
            slope[1] *= model->k[i] / (1 + model->k[i]);
        }
    } else if (model->lobe.kind == BURNISH_LOBE_NV2X) {
        double b = -model->k[1] * a, d = 1 + b / a, first = -(a + b) / (d * d);
        double cosine = 1 - 1 / a, squared_sine = (2 - 1 / a) / a;
        slope[0] = first * sqrt(squared_sine);
        slope[1] = 2 * b * (a + b) / (d * d * d) * squared_sine + first * cosine;
    } else if (model->lobe.kind == BURNISH_LOBE_KUIJK_BLAKE) {
        slope[1] = 2 / (model->k[1] * (model->k[1] - model->k[0]));
    } else if (model->lobe.kind == BURNISH_LOBE_POWER) {
        slope[0] = n == 1 ? -1 : 0;
        slope[1] = n > 2 || n == 1 ? 0 : n == 2 ? 2 : HUGE_VAL;
    } else if (model->lobe.kind == BURNISH_LOBE_SCHLICK) {
        slope[0] = -1 / n;
        slope[1] = 2 * (n - 1) / (n * n);
    } else if (model->lobe.kind == BURNISH_LOBE_GX) {
        slope[1] = 4 / n;
    }
}

double burnish_theory_zero_curvature_radius(const burnish_theory_model *model) {
    double slope[2];
    if (isnan(burnish_theory_zero_angle(model))) {
        return NAN;
    }
    slopes_at_zero(model, slope);
    return pow(1 + slope[0] * slope[0], 1.5) / fabs(slope[1]);
}

double burnish_theory_inflection_angle(double exponent) {
    return exponent >= 1 ? asin(1 / sqrt(exponent)) : NAN; /* cos^2 = (n - 1) / n */
}

double burnish_theory_width_ratio(const burnish_theory_model *model, double bits) {
    double level = exp2(-bits);
    if (!(bits > 0)) {
        return NAN;
    }
    double power = burnish_theory_angle_of_lambda(-expm1(-bits * log(2) / model->exponent));
    return power / burnish_theory_angle_at(model, level);
}

double burnish_theory_boundary_lambda(const burnish_theory_model *model, double bits) {
    if (!(bits >= 0 && bits <= 1024)) {
        return NAN;
    }
    double lambda = burnish_theory_lambda_at(model, bits > 0 ? exp2(-bits) : 0);
    return lambda < 1 ? lambda : 1; /* false also for NaN: the lobe stays above the level */
}

double burnish_theory_boundary_cosine(const burnish_theory_model *model, double bits) {
    return 1 - burnish_theory_boundary_lambda(model, bits);
}
