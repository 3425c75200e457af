/* The columns of `burnish lobe table`: all properties of a lobe in burnish/theory.h. */
#include "lobe/metrics.h"
#include "base/cli/values.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Metrics that need more than one call of theory.h ---- */

/* cos^n with the model's exponent, which is in range. */
static burnish_theory_model power_of(const burnish_theory_model *model) {
    burnish_theory_model power;
    (void)burnish_theory_model_create(&power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER},
                                      model->exponent);
    return power;
}

static double zeta(const burnish_theory_model *model) {
    int has_slope =
        model->lobe.kind == BURNISH_LOBE_FAMILY || model->lobe.kind == BURNISH_LOBE_LYON;
    return has_slope ? model->zeta : NAN;
}

static double peak(const burnish_theory_model *model) {
    return burnish_theory_value_at_lambda(model, 0);
}

static double value_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_value_at_angle(model, degrees * CLI_DEGREE);
}

static double derivative(const burnish_theory_model *model, double degrees, int order) {
    double derivatives[3];
    burnish_theory_derivatives(model, degrees * CLI_DEGREE, derivatives);
    return derivatives[order];
}

static double slope_at(const burnish_theory_model *model, double degrees) {
    return derivative(model, degrees, 1);
}

static double second_at(const burnish_theory_model *model, double degrees) {
    return derivative(model, degrees, 2);
}

static double radius_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_curvature_radius(model, degrees * CLI_DEGREE);
}

static double toksvig(const burnish_theory_model *model, double length) {
    return burnish_theory_toksvig_exponent(model->exponent, length);
}

static double angle_of(const burnish_theory_model *model, double bits) {
    return burnish_theory_angle_at(model, exp2(-bits));
}

static double integral(const burnish_theory_model *model) {
    return burnish_theory_integral(model, BURNISH_THEORY_SOLID_ANGLE);
}

static double cosine_integral(const burnish_theory_model *model) {
    return burnish_theory_integral(model, BURNISH_THEORY_COSINE_WEIGHTED);
}

static double energy(const burnish_theory_model *model) {
    const burnish_theory_model power = power_of(model);
    return integral(model) / integral(&power);
}

static double cosine_energy(const burnish_theory_model *model) {
    const burnish_theory_model power = power_of(model);
    return cosine_integral(model) / cosine_integral(&power);
}

static double phong_albedo(const burnish_theory_model *model) {
    return (model->exponent + 2) / (2 * CLI_PI) / burnish_theory_phong_factor(model);
}

static double blinn_albedo(const burnish_theory_model *model) {
    return burnish_theory_blinn_factor_common(model->exponent) / burnish_theory_blinn_factor(model);
}

static double relative_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_relative_error(model, degrees * CLI_DEGREE);
}

static double extreme_relative(const burnish_theory_model *model) {
    double angle = burnish_theory_extreme_angle(model);
    return isnan(angle) ? NAN : burnish_theory_relative_error(model, angle);
}

static double memory(const burnish_theory_model *model) {
    return (double)burnish_theory_model_cost(model).memory;
}

/* A sum of `lobes` lobes for the roughness of the model's exponent against a rough surface. */
static burnish_theory_lobe_sum_error sum_error(burnish_theory_distribution distribution,
                                               const burnish_theory_model *model, double lobes) {
    const double alpha = burnish_theory_alpha_from_exponent(model->exponent);
    burnish_theory_lobe_sum sum;
    burnish_theory_lobe_sum_error errors = {NAN, NAN, NAN};
    if (burnish_theory_lobe_sum_fit(distribution, fmin(alpha, 1), (int)lobes, &sum, NULL) ==
        BURNISH_STATUS_OK) {
        burnish_theory_lobe_sum_compare(distribution, fmin(alpha, 1), &sum, &errors);
    }
    return errors;
}

static double ggx_moved(const burnish_theory_model *model, double lobes) {
    return sum_error(BURNISH_THEORY_GGX, model, lobes).moved;
}

static double ggx_cap(const burnish_theory_model *model, double lobes) {
    return sum_error(BURNISH_THEORY_GGX, model, lobes).cap;
}

static double beckmann_moved(const burnish_theory_model *model, double lobes) {
    return sum_error(BURNISH_THEORY_BECKMANN, model, lobes).moved;
}

static double beckmann_cap(const burnish_theory_model *model, double lobes) {
    return sum_error(BURNISH_THEORY_BECKMANN, model, lobes).cap;
}

/* ---- The metrics ---- */

#define DIFFERENCE(member) .difference_at = offsetof(lobe_facts, difference.member)
#define COST(member) .count_at = offsetof(lobe_facts, cost.member)

/* Each group ends at the start of the next; `all` has every metric. */
static const lobe_metric metrics[] = {
    {"zeta", "zeta", "zeta", "", 4, 0, "slope of the base, of the family and lyon",
     .of_model = zeta},
    {"peak", "peak", "peak", "", 4, 0, "value at angle 0", .of_model = peak},
    {"value", "value", "value", "", 5, 'a', "value at an angle", .at = value_at},
    {"slope", "slope_per_rad", "slope", "1/rad", 4, 'a', "first derivative there", .at = slope_at},
    {"second", "second_per_rad2", "second", "1/rad^2", 3, 'a', "second derivative there",
     .at = second_at},
    {"radius", "radius_rad", "bend", "rad", 5, 'a', "radius of curvature of the curve there",
     .at = radius_at},
    {"alpha", "alpha", "alpha", "", 4, 0, "Beckmann or GGX alpha of the exponent",
     .of_exponent = burnish_theory_alpha_from_exponent},
    {"roughness", "roughness", "rough", "", 4, 0, "the root of alpha",
     .of_exponent = burnish_theory_roughness_from_exponent},
    {"phong-exponent", "phong_exponent", "Phong n", "", 2, 0,
     "exponent for Phong whose highlight is as wide as n for Blinn",
     .of_exponent = burnish_theory_phong_from_blinn},
    {"blinn-exponent", "blinn_exponent", "Blinn n", "", 1, 0,
     "exponent for Blinn whose highlight is as wide as n for Phong",
     .of_exponent = burnish_theory_blinn_from_phong},
    {"toksvig", "toksvig_exponent", "Toksvig", "", 3, 'l',
     "exponent for averaged normals of that mean length", .at = toksvig},

    {"zero-angle", "zero_angle_deg", "zero", "deg", 3, 0, "angle at which the lobe becomes 0",
     .of_model = burnish_theory_zero_angle},
    {"cutoff-cosine", "cutoff_cosine", "cutoff", "cosine", 5, 0, "its cosine",
     .of_model = burnish_theory_cutoff_cosine},
    {"curvature-radius", "curvature_radius_rad", "radius", "rad", 5, 0,
     "radius of curvature of the curve where the lobe becomes 0",
     .of_model = burnish_theory_zero_curvature_radius},
    {"inflection", "inflection_deg", "inflect.", "deg", 3, 0, "angle of cos^n's inflection",
     .of_exponent = burnish_theory_inflection_angle},
    {"angle", "angle_deg", "angle", "deg", 3, 'q', "angle at which 2^-_BITS_ is reached",
     .at = angle_of},
    {"ratio", "ratio", "R", "", 4, 'q',
     "R, ratio of cos^n's angle at 2^-_BITS_ to the lobe's; above 1 the lobe is narrower",
     .at = burnish_theory_width_ratio},
    {"boundary", "boundary_cosine", "boundary", "cosine", 5, 'q',
     "cosine at which 2^-_BITS_ is reached", .at = burnish_theory_boundary_cosine},

    {"integral", "integral_sr", "integral", "sr", -5, 0, "integral over solid angle",
     .of_model = integral},
    {"cosine-integral", "cosine_integral_sr", "cos int.", "sr", -5, 0,
     "integral over projected solid angle", .of_model = cosine_integral},
    {"energy", "energy", "energy", "of power", 4, 0, "integral relative to cos^n",
     .of_model = energy},
    {"cosine-energy", "cosine_energy", "cos en.", "of power", 4, 0,
     "cosine-weighted integral relative to cos^n", .of_model = cosine_energy},
    {"phong-factor", "phong_factor_per_sr", "Phong f.", "1/sr", -5, 0,
     "factor of a reflection lobe by Phong", .of_model = burnish_theory_phong_factor},
    {"blinn-factor", "blinn_factor_per_sr", "Blinn f.", "1/sr", -5, 0,
     "factor of a reflection lobe by Blinn", .of_model = burnish_theory_blinn_factor},
    {"blinn-factor-common", "blinn_factor_common_per_sr", "(n+8)/8pi", "1/sr", -5, 0,
     "the usual approximation for cos^n", .of_exponent = burnish_theory_blinn_factor_common},
    {"phong-albedo", "phong_albedo", "Phong alb.", "", 5, 0,
     "light reflected at normal incidence, by Phong with the factor (n + 2)/2pi",
     .of_model = phong_albedo},
    {"blinn-albedo", "blinn_albedo", "Blinn alb.", "", 5, 0,
     "the same by Blinn with the factor (n + 8)/8pi", .of_model = blinn_albedo},
    {"normal-factor", "normal_factor_per_sr", "normal f.", "1/sr", -5, 0,
     "factor of a distribution of normals", .of_model = burnish_theory_normal_factor},

    {"max-error", "max_error", "max err", "", 5, 0, "largest absolute error", DIFFERENCE(absolute)},
    {"max-error-angle", "max_error_angle_deg", "at", "deg", 3, 0, "where",
     DIFFERENCE(absolute_angle)},
    {"above", "above", "above", "", 5, 0, "largest excess over cos^n", DIFFERENCE(above)},
    {"below", "below", "below", "", 5, 0, "largest shortfall", DIFFERENCE(below)},
    {"max-relative", "max_relative_percent", "max rel", "%", 3, 0,
     "largest relative error in per cent", DIFFERENCE(relative)},
    {"max-relative-angle", "max_relative_angle_deg", "at", "deg", 3, 0, "where",
     DIFFERENCE(relative_angle)},
    {"error-integral", "error_integral_sr", "int. err", "sr", -4, 0,
     "integral of the absolute error over solid angle", DIFFERENCE(integral)},
    {"rms", "rms", "rms", "", 5, 0, "root of the mean squared error over solid angle",
     DIFFERENCE(rms)},
    {"relative", "relative_percent", "rel", "%", 3, 'a', "relative error at an angle in per cent",
     .at = relative_at},
    {"extreme-angle", "extreme_angle_deg", "extreme", "deg", 4, 0,
     "where the relative error is extreme, by formula", .of_model = burnish_theory_extreme_angle},
    {"extreme-searched", "extreme_searched_deg", "searched", "deg", 4, 0, "the same by search",
     .of_model = burnish_theory_extreme_angle_searched},
    {"extreme-relative", "extreme_relative_percent", "rel there", "%", 3, 0,
     "relative error there in per cent", .of_model = extreme_relative},

    {"multiplications", "multiplications", "mul", "", 0, 0,
     "multiplications of one evaluation from a cosine", COST(multiplications)},
    {"additions", "additions", "add", "", 0, 0, "additions and subtractions", COST(additions)},
    {"comparisons", "comparisons", "max", "", 0, 0, "comparisons: max and selections",
     COST(comparisons)},
    {"divisions", "divisions", "div", "", 0, 0, "divisions", COST(divisions)},
    {"functions", "functions", "fn", "", 0, 0, "calls of pow, exp or acos", COST(transcendentals)},
    {"lookups", "lookups", "look", "", 0, 0, "reads of a table", COST(lookups)},
    {"memory", "memory_entries", "memory", "entries", 0, 0, "its size", .of_model = memory},

    {"ggx-moved", "ggx_moved_percent", "GGX moved", "%", 2, 'c',
     "energy in the wrong direction of a sum of so many lobes for GGX of this roughness, whatever "
     "the lobe",
     .at = ggx_moved},
    {"ggx-cap", "ggx_cap_percent", "GGX cap", "%", 2, 'c',
     "its largest error of the light from a round light", .at = ggx_cap},
    {"beckmann-moved", "beckmann_moved_percent", "Beck. moved", "%", 2, 'c',
     "the same for Beckmann", .at = beckmann_moved},
    {"beckmann-cap", "beckmann_cap_percent", "Beck. cap", "%", 2, 'c', "the same for Beckmann",
     .at = beckmann_cap},
};

enum { METRIC_COUNT = sizeof metrics / sizeof *metrics };

double lobe_metric_value(const lobe_metric_choice *choice, const lobe_facts *facts) {
    const lobe_metric *m = choice->metric;
    const char *base = (const char *)facts;
    double value = m->of_model        ? m->of_model(&facts->model)
                   : m->of_exponent   ? m->of_exponent(facts->model.exponent)
                   : m->at            ? m->at(&facts->model, choice->argument)
                   : m->difference_at ? *(const double *)(const void *)(base + m->difference_at)
                                      : *(const int *)(const void *)(base + m->count_at);
    return strcmp(m->unit, "deg") == 0 ? value / CLI_DEGREE
           : strcmp(m->unit, "%") == 0 ? 100 * value
                                       : value;
}

/* A group: the metrics from the named one up to the next group's; NULL: to the end. */
static const struct {
    const char *name, *first, *end;
} groups[] = {
    {"all", "zeta", "ggx-moved"},
    {"shape", "zeta", "zero-angle"},
    {"widths", "zero-angle", "integral"},
    {"energies", "integral", "max-error"},
    {"errors", "max-error", "multiplications"},
    {"cost", "multiplications", "ggx-moved"},
    {"sums", "ggx-moved", NULL},
};

void lobe_each_metric(cli_take_term *take) {
    for (size_t i = 0; i < METRIC_COUNT; ++i) {
        const char takes = metrics[i].takes;
        char tag[64];
        snprintf(tag, sizeof tag, "*%s*%s", metrics[i].name,
                 takes == 'q'   ? "[:_BITS_]"
                 : takes == 'a' ? "[:_DEG_]"
                 : takes == 'l' ? "[:_LENGTH_]"
                 : takes == 'c' ? "[:_LOBES_]"
                                : "");
        take(tag, metrics[i].what);
    }
}

/* Finds the end of the name and the start of the argument. */
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

/* Default arguments: 8 bits, 10 degrees, a mean length of 0.9, 3 lobes. */
static double default_argument(char takes) {
    return takes == 'q' ? 8 : takes == 'a' ? 10 : takes == 'c' ? 3 : 0.9;
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
        const char takes = metric->takes;
        const double high = takes == 'q' ? 1024 : takes == 'a' ? 90 : takes == 'c' ? 3 : 1;
        const double low = takes == 'q' ? 1e-300 : takes == 'c' ? 1 : 0;
        if (!matches(metric->name, item, name)) {
            continue;
        }
        if (name < length &&
            (!takes || !cli_read_real(item + name + 1, length - name - 1, &argument) ||
             !(argument >= low && argument <= high &&
               (takes != 'c' || argument == floor(argument))))) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.*s\": %s %s", flag,
                            length < 60 ? (int)length : 60, item, metric->name,
                            takes == 'q'   ? "takes bits above 0 and up to 1024, as in angle:8"
                            : takes == 'a' ? "takes degrees from 0 to 90, as in value:10"
                            : takes == 'l' ? "takes a length from 0 to 1, as in toksvig:0.9"
                            : takes == 'c' ? "takes 1, 2 or 3 lobes, as in ggx-moved:2"
                                           : "takes no number; remove the text after the colon");
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
