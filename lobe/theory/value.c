/* Values and derivatives of every lobe, in lambda = 1 - c: narrow lobes stay exact. */
#include <math.h>

#include "theory/internal.h"

double burnish_theory_lambda_of_angle(double angle) {
    double s = sin(0.5 * angle);
    return 2 * s * s;
}

double burnish_theory_angle_of_lambda(double lambda) {
    return 2 * asin(sqrt(0.5 * lambda));
}

double burnish_theory_power_at_lambda(double lambda, double exponent) {
    if (!(lambda < 1)) {
        return 0;
    }
    return lambda > 0 ? exp(exponent * log1p(-lambda)) : 1;
}

/* max(0, u)^order by squarings. */
static double base_power(double u, int order) {
    u = u > 0 ? u : 0;
    for (int power = 1; power < order; power *= 2) {
        u *= u;
    }
    return u;
}

double burnish_theory_table_entry(const burnish_theory_model *model, long i) {
    double last = model->lobe.entries - 1;
    return i <= 0 ? 0 : burnish_theory_power_at_lambda((last - (double)i) / last, model->exponent);
}

static double table_value(const burnish_theory_model *model, double c) {
    if (!(c > 0)) {
        return 0;
    }
    double position = c * (model->lobe.entries - 1);
    if (!model->lobe.linear) {
        return burnish_theory_table_entry(model, (long)floor(position + 0.5));
    }
    long i = (long)position;
    i = i > model->lobe.entries - 2 ? model->lobe.entries - 2 : i;
    double low = burnish_theory_table_entry(model, i);
    double high = burnish_theory_table_entry(model, i + 1);
    return low + (high - low) * (position - (double)i);
}

static double kuijk_blake_value(const burnish_theory_model *model, double lambda) {
    double a = model->k[0], b = model->k[1];
    double x = burnish_theory_angle_of_lambda(lambda);
    if (x <= a) {
        return 1 - x * x / (a * b);
    }
    return x < b ? (b - x) * (b - x) / (b * (b - a)) : 0;
}

static double composite_value(const burnish_theory_model *model, double lambda) {
    double w = base_power(1 - model->zeta * lambda, 2);
    for (int i = 0; i < model->steps; ++i) {
        w *= (w + model->k[i]) / (1 + model->k[i]);
    }
    return w;
}

double burnish_theory_value_at_lambda(const burnish_theory_model *model, double lambda) {
    double n = model->exponent;
    if (!(lambda <= HUGE_VAL)) {
        return 0;
    }
    lambda = lambda > 0 ? lambda : 0;
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
        return model->scale * base_power(1 - model->zeta * lambda, model->lobe.order);
    case BURNISH_LOBE_COMPOSITE:
        return composite_value(model, lambda);
    case BURNISH_LOBE_POWER:
        return burnish_theory_power_at_lambda(lambda, n);
    case BURNISH_LOBE_SCHLICK:
        return lambda < 1 ? (1 - lambda) / ((1 - lambda) + n * lambda) : 0;
    case BURNISH_LOBE_GAUSSIAN:
        return exp(-(n + 0.775) * lambda);
    case BURNISH_LOBE_GX: {
        double c = 1 - lambda, squared = c * c;
        return c > 0 ? squared / (squared + 0.5 * n * lambda * (1 + c)) : 0;
    }
    case BURNISH_LOBE_NV2X: {
        double u = 1 - model->zeta * lambda;
        return u > 0 ? u / (1 - model->k[1] * model->zeta * lambda) : 0;
    }
    case BURNISH_LOBE_KUIJK_BLAKE:
        return kuijk_blake_value(model, lambda < 2 ? lambda : 2);
    case BURNISH_LOBE_TABLE:
        return table_value(model, 1 - lambda);
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return 0;
}

double burnish_theory_value(const burnish_theory_model *model, double cosine) {
    return burnish_theory_value_at_lambda(model, 1 - cosine);
}

double burnish_theory_value_at_angle(const burnish_theory_model *model, double angle) {
    return burnish_theory_value_at_lambda(model, burnish_theory_lambda_of_angle(angle));
}

void burnish_theory_lambda_slopes(const burnish_theory_model *model, double lambda,
                                  double slope[2]) {
    double n = model->exponent, c = 1 - lambda, m = model->lobe.order, a = model->zeta;
    double u = 1 - a * lambda;
    slope[0] = slope[1] = 0;
    if (model->lobe.kind == BURNISH_LOBE_COMPOSITE && u >= -1e-14) {
        u = u > 0 ? u : 0;
        double w = u * u;
        slope[0] = -2 * a * u;
        slope[1] = 2 * a * a;
        for (int i = 0; i < model->steps; ++i) { /* the chain rule */
            const double b = model->k[i], first = (2 * w + b) / (1 + b), second = 2 / (1 + b);
            slope[1] = second * slope[0] * slope[0] + first * slope[1];
            slope[0] *= first;
            w *= (w + b) / (1 + b);
        }
    } else if (model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON) {
        if (u >= -1e-14) { /* the zero itself belongs to the peak's side; 1e-14 for rounding */
            u = u > 0 ? u : 0;
            slope[0] = -model->scale * m * a * pow(u, m - 1);
            slope[1] = model->scale * m * (m - 1) * a * a * pow(u, m - 2);
        }
    } else if (model->lobe.kind == BURNISH_LOBE_GAUSSIAN) {
        double k = n + 0.775;
        slope[0] = -k * exp(-k * lambda);
        slope[1] = k * k * exp(-k * lambda);
    } else if (model->lobe.kind == BURNISH_LOBE_NV2X && u >= -1e-14) {
        double b = -model->k[1] * a, d = 1 + b * lambda;
        slope[0] = -(a + b) / (d * d);
        slope[1] = 2 * b * (a + b) / (d * d * d);
    } else if (model->lobe.kind == BURNISH_LOBE_POWER && c >= 0) {
        slope[0] = -n * pow(c, n - 1);
        slope[1] = n > 1 ? n * (n - 1) * pow(c, n - 2) : 0;
    } else if (model->lobe.kind == BURNISH_LOBE_SCHLICK && c >= 0) {
        double d = c + n * lambda;
        slope[0] = -n / (d * d);
        slope[1] = 2 * n * (n - 1) / (d * d * d);
    } else if (model->lobe.kind == BURNISH_LOBE_GX && c >= 0) {
        double h = 0.5 * n, d = c * c + h * lambda * (1 + c);
        slope[0] = -2 * h * c / (d * d);
        slope[1] = 2 * h * (h - 3 * (1 - h) * c * c) / (d * d * d);
    } else if (model->lobe.kind == BURNISH_LOBE_TABLE && model->lobe.linear && c >= 0) {
        long last = model->lobe.entries - 1, i = (long)(c * (double)last);
        i = i > last - 1 ? last - 1 : i;
        slope[0] = (double)last * (burnish_theory_table_entry(model, i) -
                                   burnish_theory_table_entry(model, i + 1));
    }
}

void burnish_theory_derivatives(const burnish_theory_model *model, double angle,
                                double derivatives[3]) {
    derivatives[0] = burnish_theory_value_at_angle(model, angle);
    if (model->lobe.kind == BURNISH_LOBE_KUIJK_BLAKE) {
        double a = model->k[0], b = model->k[1];
        derivatives[1] = angle <= a   ? -2 * angle / (a * b)
                         : angle <= b ? 2 * (angle - b) / (b * (b - a))
                                      : 0;
        derivatives[2] = angle <= a ? -2 / (a * b) : angle <= b ? 2 / (b * (b - a)) : 0;
        return;
    }
    double slope[2], sine = sin(angle);
    burnish_theory_lambda_slopes(model, burnish_theory_lambda_of_angle(angle), slope);
    derivatives[1] = slope[0] * sine;
    derivatives[2] = slope[1] * sine * sine + slope[0] * cos(angle);
}

double burnish_theory_curvature_radius(const burnish_theory_model *model, double angle) {
    double d[3];
    burnish_theory_derivatives(model, angle, d);
    return pow(1 + d[1] * d[1], 1.5) / fabs(d[2]);
}

double burnish_theory_lyon_normalize_factor(double s) {
    double e = 1 - s;
    return 1 + e * (0.5 + 0.375 * e);
}
