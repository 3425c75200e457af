/* The columns of `burnish lobe table`: everything that burnish/theory.h knows about one lobe. */
#include "lobe/metrics.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef lobe_facts facts;

static double degrees(double radians) {
    return radians / CLI_DEGREE;
}

static double level_of_bits(const facts *f) {
    return exp2(-f->argument);
}

/* The power with the model's exponent, which is in range. */
static burnish_theory_model power_of(const facts *f) {
    burnish_theory_model power;
    (void)burnish_theory_model_create(&power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER},
                                      f->model.exponent);
    return power;
}

static double or_nan(double value, int exists) {
    return exists ? value : NAN;
}

static double integral_ratio(const facts *f, burnish_theory_measure measure) {
    burnish_theory_model power = power_of(f);
    return burnish_theory_integral(&f->model, measure) / burnish_theory_integral(&power, measure);
}

static double derivative(const facts *f, int order) {
    double derivatives[3];
    burnish_theory_derivatives(&f->model, f->argument * CLI_DEGREE, derivatives);
    return derivatives[order];
}

static double m_zeta(const facts *f) {
    int has_slope =
        f->model.lobe.kind == BURNISH_LOBE_FAMILY || f->model.lobe.kind == BURNISH_LOBE_LYON;
    return or_nan(f->model.zeta, has_slope);
}
static double m_peak(const facts *f) {
    return burnish_theory_value_at_lambda(&f->model, 0);
}
static double m_value(const facts *f) {
    return burnish_theory_value_at_angle(&f->model, f->argument * CLI_DEGREE);
}
static double m_slope(const facts *f) {
    return derivative(f, 1);
}
static double m_second(const facts *f) {
    return derivative(f, 2);
}
static double m_zero(const facts *f) {
    return degrees(burnish_theory_zero_angle(&f->model));
}
static double m_cutoff(const facts *f) {
    return burnish_theory_cutoff_cosine(&f->model);
}
static double m_radius(const facts *f) {
    return burnish_theory_zero_curvature_radius(&f->model);
}
static double m_inflection(const facts *f) {
    return degrees(burnish_theory_inflection_angle(f->model.exponent));
}
static double m_angle(const facts *f) {
    return degrees(burnish_theory_angle_at(&f->model, level_of_bits(f)));
}
static double m_ratio(const facts *f) {
    return burnish_theory_width_ratio(&f->model, f->argument);
}
static double m_boundary(const facts *f) {
    return burnish_theory_boundary_cosine(&f->model, f->argument);
}
static double m_integral(const facts *f) {
    return burnish_theory_integral(&f->model, BURNISH_THEORY_SOLID_ANGLE);
}
static double m_cosine_integral(const facts *f) {
    return burnish_theory_integral(&f->model, BURNISH_THEORY_COSINE_WEIGHTED);
}
static double m_energy(const facts *f) {
    return integral_ratio(f, BURNISH_THEORY_SOLID_ANGLE);
}
static double m_cosine_energy(const facts *f) {
    return integral_ratio(f, BURNISH_THEORY_COSINE_WEIGHTED);
}
static double m_phong(const facts *f) {
    return burnish_theory_phong_factor(&f->model);
}
static double m_blinn(const facts *f) {
    return burnish_theory_blinn_factor(&f->model);
}
static double m_blinn_common(const facts *f) {
    return burnish_theory_blinn_factor_common(f->model.exponent);
}
static double m_normal(const facts *f) {
    return burnish_theory_normal_factor(&f->model);
}
static double m_error(const facts *f) {
    return f->difference.absolute;
}
static double m_error_angle(const facts *f) {
    return degrees(f->difference.absolute_angle);
}
static double m_above(const facts *f) {
    return f->difference.above;
}
static double m_below(const facts *f) {
    return f->difference.below;
}
static double m_relative(const facts *f) {
    return 100 * f->difference.relative;
}
static double m_relative_angle(const facts *f) {
    return degrees(f->difference.relative_angle);
}
static double m_error_integral(const facts *f) {
    return f->difference.integral;
}
static double m_rms(const facts *f) {
    return f->difference.rms;
}
static double m_extreme(const facts *f) {
    return degrees(burnish_theory_extreme_angle(&f->model));
}
static double m_extreme_searched(const facts *f) {
    return degrees(burnish_theory_extreme_angle_searched(&f->model));
}
static double m_extreme_value(const facts *f) {
    double angle = burnish_theory_extreme_angle(&f->model);
    return isnan(angle) ? NAN : 100 * burnish_theory_relative_error(&f->model, angle);
}
static double m_relative_at(const facts *f) {
    return 100 * burnish_theory_relative_error(&f->model, f->argument * CLI_DEGREE);
}
static double m_alpha(const facts *f) {
    return burnish_theory_alpha_from_exponent(f->model.exponent);
}
static double m_roughness(const facts *f) {
    return burnish_theory_roughness_from_exponent(f->model.exponent);
}
static double m_phong_exponent(const facts *f) {
    return burnish_theory_phong_from_blinn(f->model.exponent);
}
static double m_blinn_exponent(const facts *f) {
    return burnish_theory_blinn_from_phong(f->model.exponent);
}
static double m_toksvig(const facts *f) {
    return burnish_theory_toksvig_exponent(f->model.exponent, f->argument);
}
static double m_multiplications(const facts *f) {
    return burnish_theory_model_cost(&f->model).multiplications;
}
static double m_additions(const facts *f) {
    return burnish_theory_model_cost(&f->model).additions;
}
static double m_comparisons(const facts *f) {
    return burnish_theory_model_cost(&f->model).comparisons;
}
static double m_divisions(const facts *f) {
    return burnish_theory_model_cost(&f->model).divisions;
}
static double m_functions(const facts *f) {
    return burnish_theory_model_cost(&f->model).transcendentals;
}
static double m_lookups(const facts *f) {
    return burnish_theory_model_cost(&f->model).lookups;
}
static double m_memory(const facts *f) {
    return (double)burnish_theory_model_cost(&f->model).memory;
}

/* A group ends where the next begins; `all` is everything. */
static const lobe_metric metrics[] = {
    {"zeta", "zeta", "zeta", "", 4, 0, 0, m_zeta, "slope of the base, of the family and lyon"},
    {"peak", "peak", "peak", "", 4, 0, 0, m_peak, "value at angle 0"},
    {"value", "value", "value", "", 5, 0, 'a', m_value, "value at an angle"},
    {"slope", "slope_per_rad", "slope", "1/rad", 4, 0, 'a', m_slope, "first derivative there"},
    {"second", "second_per_rad2", "second", "1/rad^2", 3, 0, 'a', m_second,
     "second derivative there"},
    {"alpha", "alpha", "alpha", "", 4, 0, 0, m_alpha, "Beckmann or GGX alpha of the exponent"},
    {"roughness", "roughness", "rough", "", 4, 0, 0, m_roughness, "the root of alpha"},
    {"phong-exponent", "phong_exponent", "Phong n", "", 2, 0, 0, m_phong_exponent,
     "exponent for Phong whose highlight is as wide as n for Blinn"},
    {"blinn-exponent", "blinn_exponent", "Blinn n", "", 1, 0, 0, m_blinn_exponent,
     "exponent for Blinn whose highlight is as wide as n for Phong"},
    {"toksvig", "toksvig_exponent", "Toksvig", "", 3, 0, 'l', m_toksvig,
     "exponent for averaged normals of that mean length"},

    {"zero-angle", "zero_angle_deg", "zero", "deg", 3, 0, 0, m_zero,
     "angle from which on the lobe is 0"},
    {"cutoff-cosine", "cutoff_cosine", "cutoff", "cosine", 5, 0, 0, m_cutoff, "its cosine"},
    {"curvature-radius", "curvature_radius_rad", "radius", "rad", 5, 0, 0, m_radius,
     "radius of curvature of the curve there"},
    {"inflection", "inflection_deg", "inflect.", "deg", 3, 0, 0, m_inflection,
     "where the power has its inflection"},
    {"angle", "angle_deg", "angle", "deg", 3, 0, 'q', m_angle,
     "angle at which 2^-_BITS_ is reached"},
    {"ratio", "ratio", "R", "", 4, 0, 'q', m_ratio,
     "R, the power's angle at 2^-_BITS_ by the lobe's; above 1 the lobe ends sooner"},
    {"boundary", "boundary_cosine", "boundary", "cosine", 5, 0, 'q', m_boundary,
     "cosine at which 2^-_BITS_ is reached"},

    {"integral", "integral_sr", "integral", "sr", -5, 0, 0, m_integral,
     "integral over solid angle"},
    {"cosine-integral", "cosine_integral_sr", "cos int.", "sr", -5, 0, 0, m_cosine_integral,
     "integral over projected solid angle"},
    {"energy", "energy", "energy", "of power", 4, 0, 0, m_energy, "integral by the power's"},
    {"cosine-energy", "cosine_energy", "cos en.", "of power", 4, 0, 0, m_cosine_energy,
     "cosine-weighted integral by the power's"},
    {"phong-factor", "phong_factor_per_sr", "Phong f.", "1/sr", -5, 0, 0, m_phong,
     "factor of a reflection lobe by Phong"},
    {"blinn-factor", "blinn_factor_per_sr", "Blinn f.", "1/sr", -5, 0, 0, m_blinn,
     "factor of a reflection lobe by Blinn"},
    {"blinn-factor-common", "blinn_factor_common_per_sr", "(n+8)/8pi", "1/sr", -5, 0, 0,
     m_blinn_common, "the usual approximation to that for the power"},
    {"normal-factor", "normal_factor_per_sr", "normal f.", "1/sr", -5, 0, 0, m_normal,
     "factor of a distribution of normals"},

    {"max-error", "max_error", "max err", "", 5, 1, 0, m_error, "largest absolute error"},
    {"max-error-angle", "max_error_angle_deg", "at", "deg", 3, 1, 0, m_error_angle, "where"},
    {"above", "above", "above", "", 5, 1, 0, m_above, "largest excess over the power"},
    {"below", "below", "below", "", 5, 1, 0, m_below, "largest shortfall"},
    {"max-relative", "max_relative_percent", "max rel", "%", 3, 1, 0, m_relative,
     "largest relative error in per cent"},
    {"max-relative-angle", "max_relative_angle_deg", "at", "deg", 3, 1, 0, m_relative_angle,
     "where"},
    {"error-integral", "error_integral_sr", "int. err", "sr", -4, 1, 0, m_error_integral,
     "integral of the absolute error over solid angle"},
    {"rms", "rms", "rms", "", 5, 1, 0, m_rms, "root of the mean squared error over solid angle"},
    {"relative", "relative_percent", "rel", "%", 3, 0, 'a', m_relative_at,
     "relative error at an angle in per cent"},
    {"extreme-angle", "extreme_angle_deg", "extreme", "deg", 4, 0, 0, m_extreme,
     "where the relative error is extreme, by formula"},
    {"extreme-searched", "extreme_searched_deg", "searched", "deg", 4, 0, 0, m_extreme_searched,
     "the same by search"},
    {"extreme-relative", "extreme_relative_percent", "rel there", "%", 3, 0, 0, m_extreme_value,
     "relative error there in per cent"},

    {"multiplications", "multiplications", "mul", "", 0, 0, 0, m_multiplications,
     "multiplications of one evaluation from a cosine"},
    {"additions", "additions", "add", "", 0, 0, 0, m_additions, "additions and subtractions"},
    {"comparisons", "comparisons", "max", "", 0, 0, 0, m_comparisons,
     "comparisons: max and selections"},
    {"divisions", "divisions", "div", "", 0, 0, 0, m_divisions, "divisions"},
    {"functions", "functions", "fn", "", 0, 0, 0, m_functions, "calls of pow, exp or acos"},
    {"lookups", "lookups", "look", "", 0, 0, 0, m_lookups, "reads of a table"},
    {"memory", "memory_entries", "memory", "entries", 0, 0, 0, m_memory, "its size"},
};

enum { METRIC_COUNT = sizeof metrics / sizeof *metrics };

/* A group: the metrics from the named one up to the next group's; NULL: to the end. */
static const struct {
    const char *name, *first, *end;
} groups[] = {
    {"all", "zeta", NULL},
    {"shape", "zeta", "zero-angle"},
    {"widths", "zero-angle", "integral"},
    {"energies", "integral", "max-error"},
    {"errors", "max-error", "multiplications"},
    {"cost", "multiplications", NULL},
};

void lobe_each_metric(cli_take_term *take) {
    for (size_t i = 0; i < METRIC_COUNT; ++i) {
        const char takes = metrics[i].takes;
        char tag[64];
        snprintf(tag, sizeof tag, "*%s*%s", metrics[i].name,
                 takes == 'q'   ? "[:_BITS_]"
                 : takes == 'a' ? "[:_DEG_]"
                 : takes == 'l' ? "[:_LENGTH_]"
                                : "");
        take(tag, metrics[i].what);
    }
}

/* Where the name ends and the argument begins. */
static size_t name_length(const char *item, size_t length) {
    const char *colon = memchr(item, ':', length);
    return colon ? (size_t)(colon - item) : length;
}

static int matches(const char *name, const char *item, size_t length) {
    return strlen(name) == length && memcmp(name, item, length) == 0;
}

static burnish_status add(const char *flag, lobe_metric_list *list, const lobe_metric *metric,
                          double argument, burnish_error *error) {
    if (list->count == LOBE_METRICS_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d metrics", flag,
                        LOBE_METRICS_MAX);
    }
    list->items[list->count++] = (lobe_metric_choice){metric, argument};
    return BURNISH_STATUS_OK;
}

/* Arguments where none is given: 8 bits, 10 degrees, a mean length of .9. */
static double default_argument(char takes) {
    return takes == 'q' ? 8 : takes == 'a' ? 10 : 0.9;
}

static burnish_status add_group(const char *flag, lobe_metric_list *list, const char *first,
                                const char *end, burnish_error *error) {
    size_t i = 0;
    burnish_status status = BURNISH_STATUS_OK;
    while (strcmp(metrics[i].name, first) != 0) {
        ++i;
    }
    for (; i < METRIC_COUNT && status == BURNISH_STATUS_OK &&
           !(end && strcmp(metrics[i].name, end) == 0);
         ++i) {
        status = add(flag, list, &metrics[i], default_argument(metrics[i].takes), error);
    }
    return status;
}

static const char *metric_name_at(const void *list, size_t index) {
    (void)list;
    return index < METRIC_COUNT ? metrics[index].name : NULL;
}

static burnish_status add_item(const char *flag, const char *item, size_t length,
                               lobe_metric_list *list, burnish_error *error) {
    size_t name = name_length(item, length);
    for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i) {
        if (matches(groups[i].name, item, length)) {
            return add_group(flag, list, groups[i].first, groups[i].end, error);
        }
    }
    for (size_t i = 0; i < METRIC_COUNT; ++i) {
        const lobe_metric *metric = &metrics[i];
        double argument = default_argument(metric->takes);
        double high = metric->takes == 'q' ? 1024 : metric->takes == 'a' ? 90 : 1;
        if (!matches(metric->name, item, name)) {
            continue;
        }
        if (name < length &&
            (!metric->takes || !cli_read_real(item + name + 1, length - name - 1, &argument) ||
             !(argument >= 0 && argument <= high && (metric->takes != 'q' || argument > 0)))) {
            return cli_fail(
                error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.*s\": %s %s", flag,
                length < 60 ? (int)length : 60, item, metric->name,
                metric->takes == 'q'   ? "takes bits above 0 and up to 1024, as in angle:8"
                : metric->takes == 'a' ? "takes degrees from 0 to 90, as in value:10"
                : metric->takes == 'l' ? "takes a length from 0 to 1, as in toksvig:0.9"
                                       : "takes no number; leave out what follows the colon");
        }
        return add(flag, list, metric, argument, error);
    }
    char where[CLI_NAME_MAX + 1], typed[CLI_NAME_MAX + 1];
    snprintf(where, sizeof where, "--%s", flag);
    snprintf(typed, sizeof typed, "%.*s", name < CLI_NAME_MAX ? (int)name : CLI_NAME_MAX, item);
    return cli_fail_unknown(error, where, "metric", typed, metric_name_at, NULL,
                            "burnish help --man");
}

burnish_status lobe_read_metrics(const char *flag, const char *text, lobe_metric_list *list,
                                 burnish_error *error) {
    const char *rest = text, *item;
    burnish_status status = BURNISH_STATUS_OK;
    list->count = 0;
    while (rest && status == BURNISH_STATUS_OK) {
        size_t length = cli_next_item(&rest, ',', &item);
        status = add_item(flag, item, length, list, error);
    }
    return status;
}

void lobe_metric_column(const lobe_metric_choice *choice, cli_column *column) {
    const lobe_metric *metric = choice->metric;
    char suffix[16] = "";
    if (metric->takes) {
        snprintf(suffix, sizeof suffix, "%.6g", choice->argument);
    }
    *column = (cli_column){.decimals = metric->decimals};
    snprintf(column->key, sizeof column->key, "%s%s%s", metric->key, *suffix ? "_" : "", suffix);
    snprintf(column->heading, sizeof column->heading, "%s%s%s", metric->heading, *suffix ? ":" : "",
             suffix);
    snprintf(column->unit, sizeof column->unit, "%s", metric->unit);
}
