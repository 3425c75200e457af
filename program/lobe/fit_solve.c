/* The fit of lobes to measured samples: variable projection (Golub and Pereyra 1973). For a given
 * slope or exponent, the best scale and offset have a closed form, which leaves a function of one
 * variable. NLopt, if present, minimises it: DIRECT over the whole range, since measured lobes can
 * have several minima, then a simplex. */
#include <math.h>
#if BURNISH_HAS_NLOPT
#include <nlopt.h>
#endif
#include <stdlib.h>
#include <string.h>

#include "base/cli/options.h"
#include "lobe/fit_solve.h"
#include "lobe/samples.h"

enum {
    COARSE_SAMPLES = 2000, /* most samples for the global search */
    COARSE_EVALUATIONS = 300,
    FINE_EVALUATIONS = 120
};

/* One search. */
typedef struct problem {
    const lobe_samples *samples;
    size_t stride; /* only every stride-th sample counts */
    int with_offset;
    double unit; /* largest intensity; keeps squares from overflow and underflow */
    burnish_lobe_kind kind;
    int order; /* FAMILY */
} problem;

/* The lobe for the logarithm of its slope or exponent. */
static burnish_theory_model model_at(const problem *p, double logarithm) {
    burnish_theory_model model;
    double value = exp(logarithm);
    value = value > 65536 ? 65536 : value;
    if (p->kind == BURNISH_LOBE_FAMILY) {
        (void)burnish_theory_model_create(
            &model,
            &(burnish_lobe_spec){.fit = BURNISH_FIT_GIVEN, .order = p->order, .parameter = value},
            65536);
    } else {
        (void)burnish_theory_model_create(&model, &(burnish_lobe_spec){.kind = p->kind, .order = 2},
                                          value < 1 ? 1 : value);
    }
    return model;
}

/* Least squares of intensity = scale * lobe + offset in units of p->unit; returns the mean
 * squared residual. Negative scales are clamped to 0. */
static double project(const problem *p, const burnish_theory_model *model, double *scale,
                      double *offset) {
    double n = 0, s = 0, ss = 0, y = 0, sy = 0;
    for (size_t i = 0; i < p->samples->count; i += p->stride) {
        double value = burnish_theory_value_at_lambda(model, p->samples->items[i].lambda);
        double intensity = p->samples->items[i].intensity / p->unit;
        n += 1;
        s += value;
        ss += value * value;
        y += intensity;
        sy += value * intensity;
    }
    double determinant = p->with_offset ? ss - s * s / n : ss;
    double slope = p->with_offset ? sy - s * y / n : sy;
    *scale = determinant > 1e-14 * n && slope > 0 ? slope / determinant : 0;
    *offset = p->with_offset ? (y - *scale * s) / n : 0;
    /* summed again: a difference of large sums would lose digits for good fits */
    double rest = 0;
    for (size_t i = 0; i < p->samples->count; i += p->stride) {
        double value = burnish_theory_value_at_lambda(model, p->samples->items[i].lambda);
        double residual = p->samples->items[i].intensity / p->unit - *scale * value - *offset;
        rest += residual * residual;
    }
    return rest / n;
}

typedef enum search_kind { SEARCH_EVERYWHERE, SEARCH_NEARBY } search_kind;

#if BURNISH_HAS_NLOPT
static double objective(unsigned dimensions, const double *x, double *gradient, void *context) {
    double scale, offset;
    burnish_theory_model model = model_at(context, x[0]);
    (void)dimensions, (void)gradient;
    return project(context, &model, &scale, &offset);
}

/* Runs one algorithm from *x within [low, high]; the result replaces *x. 0: out of memory.
 */
static int search(problem *p, search_kind kind, int evaluations, double low, double high,
                  double *x) {
    const nlopt_algorithm algorithm =
        kind == SEARCH_EVERYWHERE ? NLOPT_GN_DIRECT_L : NLOPT_LN_NELDERMEAD;
    double best = *x, value, step = 0.1 * (high - low);
    nlopt_opt opt = nlopt_create(algorithm, 1);
    if (!opt) {
        return 0;
    }
    nlopt_set_min_objective(opt, objective, p);
    nlopt_set_lower_bounds1(opt, low);
    nlopt_set_upper_bounds1(opt, high);
    nlopt_set_initial_step(opt, &step);
    nlopt_set_xtol_abs1(opt, 1e-12);
    nlopt_set_maxeval(opt, evaluations);
    /* a negative result can mean that rounding stopped the search; the best point is still valid
     */
    nlopt_result result = nlopt_optimize(opt, &best, &value);
    nlopt_destroy(opt);
    if (result == NLOPT_OUT_OF_MEMORY) {
        return 0;
    }
    *x = best >= low && best <= high ? best : *x;
    return 1;
}
#else
static double rest_at(problem *p, double x) {
    double scale, offset;
    burnish_theory_model model = model_at(p, x);
    return project(p, &model, &scale, &offset);
}

/* Without NLopt: steps over the whole range, then a golden-section search. */
static int search(problem *p, search_kind kind, int evaluations, double low, double high,
                  double *x) {
    const double golden = 0.6180339887498949;
    if (kind == SEARCH_EVERYWHERE) {
        double least = INFINITY;
        for (int i = 0; i < evaluations; ++i) {
            const double at = low + (high - low) * i / (evaluations - 1);
            const double rest = rest_at(p, at);
            if (rest < least) {
                least = rest;
                *x = at;
            }
        }
        return 1;
    }
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double rest_left = rest_at(p, left), rest_right = rest_at(p, right);
    for (int i = 2; i < evaluations && high - low > 1e-12; ++i) {
        if (rest_left <= rest_right) {
            high = right;
            right = left;
            rest_right = rest_left;
            left = high - golden * (high - low);
            rest_left = rest_at(p, left);
        } else {
            low = left;
            left = right;
            rest_left = rest_right;
            right = low + golden * (high - low);
            rest_right = rest_at(p, right);
        }
    }
    *x = rest_left <= rest_right ? left : right;
    return 1;
}
#endif

static int fit_kind(problem *p, lobe_fitted *fitted) {
    double low = p->kind == BURNISH_LOBE_FAMILY ? log(0.25) : 0, high = log(65536);
    double x = 0.5 * (low + high);
    size_t count = p->samples->count;
    p->stride = count > COARSE_SAMPLES ? (count + COARSE_SAMPLES - 1) / COARSE_SAMPLES : 1;
    if (!search(p, SEARCH_EVERYWHERE, COARSE_EVALUATIONS, low, high, &x)) {
        return 0;
    }
    p->stride = 1;
    double from = x - 0.1 > low ? x - 0.1 : low, to = x + 0.1 < high ? x + 0.1 : high;
    if (!search(p, SEARCH_NEARBY, FINE_EVALUATIONS, from, to, &x)) {
        return 0;
    }
    fitted->model = model_at(p, x);
    fitted->at_limit = x - low < 1e-6 || high - x < 1e-6;
    fitted->rms = p->unit * sqrt(project(p, &fitted->model, &fitted->scale, &fitted->offset));
    fitted->scale *= p->unit;
    fitted->offset *= p->unit;
    fitted->maximum = 0;
    for (size_t i = 0; i < count; ++i) {
        double residual = fabs(lobe_residual(fitted, &p->samples->items[i]));
        if (residual > fitted->maximum) {
            fitted->maximum = residual;
            fitted->worst = i;
        }
    }
    return 1;
}

/* Better lobes first; of lobes that fit equally well up to rounding, the cheaper one first. */
static int compare_fitted(const void *a, const void *b) {
    const lobe_fitted *x = a, *y = b;
    double tiny = 1e-9 * (fabs(x->scale) + fabs(y->scale));
    if (fabs(x->rms - y->rms) <= tiny && x->rms + y->rms <= 4 * tiny) {
        burnish_theory_cost cost_x = burnish_theory_model_cost(&x->model);
        burnish_theory_cost cost_y = burnish_theory_model_cost(&y->model);
        int order = burnish_theory_cost_order(&cost_x, &cost_y);
        if (order) {
            return order;
        }
    }
    return (x->rms > y->rms) - (x->rms < y->rms);
}

static burnish_status fail_samples(const char *path, const char *what, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_FORMAT, "%.200s: %s", path, what);
}

/* Rejects samples that no lobe can fit. */
static burnish_status check_samples(const lobe_samples *samples, int with_offset, const char *path,
                                    double *unit, burnish_error *error) {
    size_t needed = with_offset ? 4 : 3;
    double first = samples->count > 0 ? samples->items[0].lambda : 0;
    int angles_differ = 0;
    *unit = 0;
    for (size_t i = 0; i < samples->count; ++i) {
        *unit = fmax(*unit, fabs(samples->items[i].intensity));
        angles_differ = angles_differ || samples->items[i].lambda != first;
    }
    if (samples->count < needed) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: %zu sample%s; a fit%s needs %zu at least", path, samples->count,
                        samples->count == 1 ? "" : "s", with_offset ? " with --offset" : "",
                        needed);
    }
    if (!angles_differ) {
        return fail_samples(path, "all samples are at one angle; a fit needs several", error);
    }
    if (!(*unit >= 1e-300)) {
        return fail_samples(path, "every intensity is 0; a fit needs positive ones", error);
    }
    return BURNISH_STATUS_OK;
}

burnish_status lobe_fit_samples(const lobe_samples *samples, int with_offset, const char *path,
                                lobe_fitted fitted[LOBE_FITTED_MAX], size_t *count,
                                burnish_error *error) {
    static const burnish_lobe_kind others[] = {BURNISH_LOBE_POWER, BURNISH_LOBE_SCHLICK,
                                               BURNISH_LOBE_GAUSSIAN, BURNISH_LOBE_GX};
    problem p = {.samples = samples, .with_offset = with_offset};
    burnish_status status = check_samples(samples, with_offset, path, &p.unit, error);
    *count = 0;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (int i = 0; i < LOBE_FITTED_MAX; ++i) {
        p.kind = i < 5 ? BURNISH_LOBE_FAMILY : others[i - 5];
        p.order = i < 5 ? 2 << i : 0;
        if (!fit_kind(&p, &fitted[*count])) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the fit");
        }
        *count += fitted[*count].scale > 0;
    }
    qsort(fitted, *count, sizeof *fitted, compare_fitted);
    if (*count == 0 || lobe_explained(samples, &fitted[0]) < 0.5) {
        return fail_samples(path,
                            "no lobe explains half of the variation; check that the intensity "
                            "falls with the angle, check --unit, or try --offset",
                            error);
    }
    return BURNISH_STATUS_OK;
}

double lobe_residual(const lobe_fitted *fitted, const lobe_sample *sample) {
    return sample->intensity - fitted->offset -
           fitted->scale * burnish_theory_value_at_lambda(&fitted->model, sample->lambda);
}

double lobe_explained(const lobe_samples *samples, const lobe_fitted *fitted) {
    double unit = 0, mean = 0, variation = 0, rest = 0;
    for (size_t i = 0; i < samples->count; ++i) {
        unit = fmax(unit, fabs(samples->items[i].intensity));
    }
    for (size_t i = 0; i < samples->count; ++i) {
        mean += samples->items[i].intensity / unit / (double)samples->count;
    }
    for (size_t i = 0; i < samples->count; ++i) {
        double deviation = samples->items[i].intensity / unit - mean;
        double residual = lobe_residual(fitted, &samples->items[i]) / unit;
        variation += deviation * deviation;
        rest += residual * residual;
    }
    return variation > 1e-24 * (double)samples->count ? 1 - rest / variation : 0;
}

double lobe_exponent_of_slope(burnish_lobe_fit fit, int order, double zeta) {
    double low = order > 2 ? order : 1, high = 65536, scale, at_low, at_high, at_middle;
    if (fit == BURNISH_FIT_MINIMAX || fit == BURNISH_FIT_PROJECTED) {
        low = order; /* n >= m there, also for order 2 */
    }
    if (burnish_lobe_solve(&(burnish_lobe_spec){.fit = fit, .order = order, .parameter = 0.5}, low,
                           &at_low, &scale) != BURNISH_LOBE_OK ||
        burnish_lobe_solve(&(burnish_lobe_spec){.fit = fit, .order = order, .parameter = 0.5}, high,
                           &at_high, &scale) != BURNISH_LOBE_OK ||
        zeta < at_low * (1 - 1e-9) || zeta > at_high * (1 + 1e-9)) {
        return NAN;
    }
    for (int i = 0; i < 60; ++i) { /* slopes rise with the exponent */
        double middle = 0.5 * (low + high);
        if (burnish_lobe_solve(&(burnish_lobe_spec){.fit = fit, .order = order, .parameter = 0.5},
                               middle, &at_middle, &scale) != BURNISH_LOBE_OK) {
            return NAN;
        }
        *(at_middle < zeta ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}
