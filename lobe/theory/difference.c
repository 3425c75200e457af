/* Errors against cos^n: certified maxima with their angles, integrals. */
#include <math.h>

#include "theory/internal.h"

static void consider_relative(burnish_theory_difference *result, double lambda, double relative) {
    if (fabs(relative) > result->relative) {
        result->relative = fabs(relative);
        result->relative_angle = burnish_theory_angle_of_lambda(lambda);
    }
}

static void consider_absolute(burnish_theory_difference *result, double lambda, double difference) {
    if (fabs(difference) > result->absolute) {
        result->absolute = fabs(difference);
        result->absolute_angle = burnish_theory_angle_of_lambda(lambda);
    }
    result->above = difference > result->above ? difference : result->above;
    result->below = -difference > result->below ? -difference : result->below;
}

static double relative_of(double lobe, double power) {
    return power > 0 ? lobe / power - 1 : lobe > 0 ? HUGE_VAL : -1;
}

/* Updates the maxima at one lambda, from the values of both curves. */
static void consider(burnish_theory_difference *result, double lambda, double lobe, double power) {
    consider_absolute(result, lambda, lobe - power);
    consider_relative(result, lambda, relative_of(lobe, power));
}

static void consider_lambda(burnish_theory_difference *result, const burnish_theory_model *model,
                            double lambda) {
    consider(result, lambda, burnish_theory_value_at_lambda(model, lambda),
             burnish_theory_power_at_lambda(lambda, model->exponent));
}

/* ---- Lobes whose slope equals that of cos^n at most twice ---- */

static burnish_theory_shape smooth_shape(const burnish_theory_model *model) {
    double n = model->exponent;
    if (model->lobe.kind == BURNISH_LOBE_SCHLICK) {
        return burnish_theory_moebius_shape(1, n - 1, n);
    }
    if (model->lobe.kind == BURNISH_LOBE_GX) { /* Schlick's of c^2 and n/2 */
        return burnish_theory_moebius_shape(1, 0.5 * n - 1, 0.5 * n);
    }
    if (model->lobe.kind == BURNISH_LOBE_NV2X) {
        return burnish_theory_moebius_shape(model->zeta, -model->k[1] * model->zeta, n);
    }
    if (model->lobe.kind == BURNISH_LOBE_GAUSSIAN) {
        burnish_theory_shape shape = {
            .log_slope = log(n + 0.775), .k = n + 0.775, .p = n - 1, .end = 1};
        return shape;
    }
    return burnish_theory_family_shape(model->zeta, model->scale, model->lobe.order, n);
}

/* The zeros of the slope of lobe / cos^n; returns the number of candidates. */
static int ratio_stationary(const burnish_theory_model *model, double lambda[2]) {
    double n = model->exponent, a = model->zeta, m = model->lobe.order;
    if (model->lobe.kind == BURNISH_LOBE_GAUSSIAN) {
        lambda[0] = 0.775 / (n + 0.775);
        return 1;
    }
    if (model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON) {
        lambda[0] = (n - m * a) / (a * (n - m));
        return 1;
    }
    if (model->lobe.kind != BURNISH_LOBE_NV2X) {
        return 0; /* Schlick / cos^n only grows with the angle */
    }
    /* n (1 - a x)(1 + b x) = (a + b)(1 - x) */
    double b = -model->k[1] * a, quadratic = n * a * b, linear = n * (b - a) + a + b;
    double root = sqrt(linear * linear + 4 * quadratic * (n - a - b));
    lambda[0] = (linear + root) / (2 * quadratic);
    lambda[1] = (linear - root) / (2 * quadratic);
    return 2;
}

static void scan_smooth(burnish_theory_difference *result, const burnish_theory_model *model,
                        double end) {
    burnish_theory_shape shape = smooth_shape(model);
    int is_gx = model->lobe.kind == BURNISH_LOBE_GX;
    double v[2], lambda[2];
    int count = burnish_theory_stationary(&shape, is_gx ? end * (2 - end) : end, v);
    for (int i = 0; i < count; ++i) {
        consider_lambda(result, model, is_gx ? v[i] / (1 + sqrt(1 - v[i])) : v[i]);
    }
    count = ratio_stationary(model, lambda);
    for (int i = 0; i < count; ++i) {
        if (lambda[i] > 0 && lambda[i] < end) {
            consider_lambda(result, model, lambda[i]);
        }
    }
    if (shape.end < end) {
        consider_lambda(result, model, shape.end);
    }
}

/* ---- Tables, cell by cell ---- */

static void scan_cell(burnish_theory_difference *result, const burnish_theory_model *model,
                      double bottom, double top, double low, double high) {
    double n = model->exponent, slope = (high - low) / (top - bottom);
    double least = 1 - result->end; /* a cosine here */
    double from = bottom > least ? bottom : least;
    double places[4] = {from, top, pow(slope / n, 1 / (n - 1)),
                        -n * (low - slope * bottom) / (slope * (n - 1))};
    for (int i = 0; i < 4; ++i) {
        if (places[i] >= from && places[i] <= top) {
            consider(result, 1 - places[i], low + slope * (places[i] - bottom),
                     burnish_theory_power_at_lambda(1 - places[i], n));
        }
    }
}

static void scan_table(burnish_theory_difference *result, const burnish_theory_model *model,
                       double end) {
    double last = model->lobe.entries - 1, offset = model->lobe.linear ? 0 : 0.5;
    double high = 1;
    result->end = end; /* scan_cell reads it */
    for (long i = model->lobe.entries - 1; i >= 0; --i) {
        double bottom = ((double)i - offset) / last;
        double top = bottom + 1 / last < 1 ? bottom + 1 / last : 1;
        double entry = burnish_theory_table_entry(model, i);
        if (top <= 1 - end) {
            break;
        }
        bottom = bottom > 0 ? bottom : 0;
        if (!model->lobe.linear) {
            scan_cell(result, model, bottom, top, entry, entry);
        } else if (bottom < 1) {
            scan_cell(result, model, bottom, top, entry, high);
        }
        high = entry;
    }
}

/* ---- Kuijk and Blake, composites: branch and bound ---- */

typedef struct {
    const burnish_theory_model *model;
    burnish_theory_difference *result;
    int relative;
} bound_search;

typedef struct {
    double s, lobe, power, lobe_bend, power_bend; /* bends: second derivatives in lambda */
} curve_point;

static curve_point point_at(const bound_search *search, double s) {
    double n = search->model->exponent, slope[2] = {0, 0}, lambda = s * s;
    curve_point point = {.s = s,
                         .lobe = burnish_theory_value_at_lambda(search->model, lambda),
                         .power = burnish_theory_power_at_lambda(lambda, n)};
    if (search->model->lobe.kind == BURNISH_LOBE_COMPOSITE) {
        burnish_theory_lambda_slopes(search->model, lambda, slope);
        point.lobe_bend = slope[1];
        point.power_bend = n > 1 ? n * (n - 1) * pow(1 - lambda, n - 2) : 0;
    }
    consider(search->result, lambda, point.lobe, point.power);
    return point;
}

/* A bound on the error between two points of a composite. Polynomials in u with coefficients >= 0
 * and cos^n have monotone second derivatives, so their values at the ends bound that of the
 * difference, and with it the distance of the difference from its chord. */
static double bound_by_bends(const bound_search *search, curve_point a, curve_point b) {
    double low = fmin(a.power_bend, b.power_bend), high = fmax(a.power_bend, b.power_bend);
    double bend = fmax(fabs(a.lobe_bend - low), fabs(b.lobe_bend - high));
    double width = (b.s - a.s) * (b.s + a.s);
    double bound = fmax(fabs(a.lobe - a.power), fabs(b.lobe - b.power)) + bend * width * width / 8;
    return search->relative ? (b.power > 0 ? bound / b.power : HUGE_VAL) : bound;
}

/* Both curves fall, so their values at the ends bound the error in between. */
static void split(const bound_search *search, curve_point a, curve_point b, int depth) {
    double bound, known, tolerance = 1e-9;
    if (search->relative) {
        double above = relative_of(a.lobe, b.power);
        double below = a.power > 0 ? 1 - b.lobe / a.power : 1;
        bound = above > below ? above : below;
        known = search->result->relative;
    } else {
        bound = a.lobe - b.power > a.power - b.lobe ? a.lobe - b.power : a.power - b.lobe;
        known = search->result->absolute;
    }
    if (search->model->lobe.kind == BURNISH_LOBE_COMPOSITE) {
        bound = fmin(bound, bound_by_bends(search, a, b));
        tolerance = 1e-14; /* their errors can be below 1e-6 */
    }
    if (bound <= known + tolerance + 1e-9 * known || depth == 0) {
        return;
    }
    curve_point middle = point_at(search, 0.5 * (a.s + b.s));
    split(search, a, middle, depth - 1);
    split(search, middle, b, depth - 1);
}

static void scan_bounded(burnish_theory_difference *result, const burnish_theory_model *model,
                         double end) {
    enum { SEEDS = 512, DEPTH = 50 };
    int has_zero = model->lobe.kind == BURNISH_LOBE_COMPOSITE && end * model->zeta > 1;
    double reach = has_zero ? sqrt(1 / model->zeta) : sqrt(end); /* then only cos^n falls */
    for (int relative = 0; relative < 2; ++relative) {
        bound_search search = {model, result, relative};
        curve_point before = point_at(&search, 0);
        for (int i = 1; i <= SEEDS; ++i) { /* a good maximum first: fewer intervals are split */
            (void)point_at(&search, reach * i / SEEDS);
        }
        for (int i = 1; i <= SEEDS; ++i) {
            curve_point next = point_at(&search, reach * i / SEEDS);
            split(&search, before, next, DEPTH);
            before = next;
        }
    }
}

/* ---- All of them ---- */

/* The limit of lobe / cos^n - 1 at c = 0, where both are 0. */
static double equator_limit(const burnish_theory_model *model) {
    double n = model->exponent, k[BURNISH_THEORY_DEGREE_MAX + 1];
    int least = 1;
    switch (model->lobe.kind) {
    case BURNISH_LOBE_SCHLICK:
        return n > 1 ? HUGE_VAL : 0;
    case BURNISH_LOBE_GX:
        return n > 2 ? HUGE_VAL : n < 2 ? -1 : 0;
    case BURNISH_LOBE_TABLE:
        return !model->lobe.linear ? -1 : n > 1 ? HUGE_VAL : 0;
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
    case BURNISH_LOBE_COMPOSITE: /* zero at c = 0 only if zeta is 1: u = c */
        if (model->zeta != 1) {
            return model->zeta < 1 ? HUGE_VAL : -1;
        }
        (void)burnish_theory_polynomial(model, k);
        while (!(k[least] > 0)) {
            ++least;
        }
        return n > least ? HUGE_VAL : n < least ? -1 : k[least] - 1;
    case BURNISH_LOBE_NV2X:
        return model->zeta > 1 ? -1 : 0;
    case BURNISH_LOBE_GAUSSIAN:
        return HUGE_VAL;
    case BURNISH_LOBE_KUIJK_BLAKE:
        return burnish_theory_value_at_lambda(model, 1) > 0 ? HUGE_VAL : -1;
    case BURNISH_LOBE_POWER:
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return 0;
}

static void scan(burnish_theory_difference *result, const burnish_theory_model *model, double end) {
    consider_lambda(result, model, 0);
    if (model->lobe.kind == BURNISH_LOBE_POWER) {
        return;
    }
    if (model->lobe.kind == BURNISH_LOBE_TABLE) {
        scan_table(result, model, end);
    } else if (model->lobe.kind == BURNISH_LOBE_KUIJK_BLAKE ||
               model->lobe.kind == BURNISH_LOBE_COMPOSITE) {
        scan_bounded(result, model, end);
    } else {
        scan_smooth(result, model, end);
    }
    if (end < 1) {
        consider_lambda(result, model, end);
        return;
    }
    consider_absolute(result, 1, burnish_theory_value_at_lambda(model, 1));
    consider_relative(result, 1, equator_limit(model));
}

/* The range in lambda; pi/2 is 1 exactly. NaN for an invalid range. */
static double range_end(double end) {
    double lambda = burnish_theory_lambda_of_angle(end);
    if (!(end > 0 && end <= 0.5 * BURNISH_PI + 1e-12)) {
        return NAN;
    }
    return lambda < 1 - 1e-14 ? lambda : 1;
}

static double difference_at(const burnish_theory_model *model, double s) {
    return burnish_theory_value_at_lambda(model, s * s) -
           burnish_theory_power_at_lambda(s * s, model->exponent);
}

static double absolute_integrand(double s, const void *context) {
    return fabs(difference_at(context, s)) * 2 * s;
}

static double squared_integrand(double s, const void *context) {
    double difference = difference_at(context, s);
    return difference * difference * 2 * s;
}

void burnish_theory_compare(const burnish_theory_model *model, double end,
                            burnish_theory_difference *result) {
    double lambda = range_end(end);
    burnish_theory_difference measured = {.end = end};
    if (isnan(lambda)) {
        *result = (burnish_theory_difference){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
        return;
    }
    scan(&measured, model, lambda);
    measured.end = end;
    if (model->lobe.kind != BURNISH_LOBE_POWER) {
        double share = 1 / (model->exponent + 1), absolute = measured.absolute;
        double tolerance = (1e-11 * absolute + 1e-15) * share; /* 1e-15: rounding errors */
        measured.integral =
            2 * BURNISH_PI *
            burnish_theory_quadrature(absolute_integrand, model, model, 0, sqrt(lambda), tolerance);
        measured.rms =
            sqrt(burnish_theory_quadrature(squared_integrand, model, model, 0, sqrt(lambda),
                                           tolerance * (absolute + 1e-15)) /
                 lambda);
    }
    *result = measured;
}

double burnish_theory_maximum_error(const burnish_theory_model *model, double end) {
    double lambda = range_end(end);
    burnish_theory_difference measured = {.end = end};
    if (isnan(lambda)) {
        return NAN;
    }
    scan(&measured, model, lambda);
    return measured.absolute;
}

double burnish_theory_relative_error(const burnish_theory_model *model, double angle) {
    double lambda = burnish_theory_lambda_of_angle(angle);
    double lobe = burnish_theory_value_at_lambda(model, lambda);
    if (model->lobe.kind == BURNISH_LOBE_POWER) {
        return 0;
    }
    double power = burnish_theory_power_at_lambda(lambda, model->exponent);
    return relative_of(lobe, power);
}

static double extreme_lambda(const burnish_theory_model *model) {
    double n = model->exponent, m = model->lobe.order, zeta = model->zeta;
    if (m == 0 || model->lobe.kind == BURNISH_LOBE_COMPOSITE ||
        !(zeta > 1 && n > m && n >= m * zeta)) {
        return NAN;
    }
    return (n - m * zeta) / (zeta * (n - m));
}

double burnish_theory_extreme_angle(const burnish_theory_model *model) {
    return burnish_theory_angle_of_lambda(extreme_lambda(model));
}

/* Golden section; the logarithm of lobe / cos^n has one maximum before the zero. */
double burnish_theory_extreme_angle_searched(const burnish_theory_model *model) {
    const double golden = 0.6180339887498949;
    double n = model->exponent, m = model->lobe.order, zeta = model->zeta;
    double low = 0, high = 1 / zeta;
    if (isnan(extreme_lambda(model))) {
        return NAN;
    }
    for (int i = 0; i < 80; ++i) {
        double x = high - golden * (high - low), y = low + golden * (high - low);
        double at_x = m * log1p(-zeta * x) - n * log1p(-x);
        double at_y = m * log1p(-zeta * y) - n * log1p(-y);
        if (at_x < at_y) {
            low = x;
        } else {
            high = y;
        }
    }
    return burnish_theory_angle_of_lambda(low);
}
