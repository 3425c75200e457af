/* The metrics of burnish/theory.h: names and units, and the calls that give the values. */
#include <math.h>
#include <string.h>

#include "internal.h"

/* ---- Metrics that need more than one call of theory.h ---- */

/* cos^n with the model's exponent, which is in range. */
static burnish_theory_model power_of(const burnish_theory_model *model) {
    burnish_theory_model power;
    (void)burnish_theory_model_create(&power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER},
                                      model->exponent);
    return power;
}

static double zeta(const burnish_theory_model *model) {
    int has_slope = model->lobe.kind == BURNISH_LOBE_FAMILY ||
                    model->lobe.kind == BURNISH_LOBE_LYON ||
                    model->lobe.kind == BURNISH_LOBE_COMPOSITE;
    return has_slope ? model->zeta : NAN;
}

static double peak(const burnish_theory_model *model) {
    return burnish_theory_value_at_lambda(model, 0);
}

static double value_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_value_at_angle(model, degrees * BURNISH_DEGREE);
}

static double derivative(const burnish_theory_model *model, double degrees, int order) {
    double derivatives[3];
    burnish_theory_derivatives(model, degrees * BURNISH_DEGREE, derivatives);
    return derivatives[order];
}

static double slope_at(const burnish_theory_model *model, double degrees) {
    return derivative(model, degrees, 1);
}

static double second_at(const burnish_theory_model *model, double degrees) {
    return derivative(model, degrees, 2);
}

static double radius_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_curvature_radius(model, degrees * BURNISH_DEGREE);
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
    return (model->exponent + 2) / (2 * BURNISH_PI) / burnish_theory_phong_factor(model);
}

static double blinn_albedo(const burnish_theory_model *model) {
    return burnish_theory_blinn_factor_common(model->exponent) / burnish_theory_blinn_factor(model);
}

static double relative_at(const burnish_theory_model *model, double degrees) {
    return burnish_theory_relative_error(model, degrees * BURNISH_DEGREE);
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

/* A metric and the source of its value, one of these. */
typedef struct entry {
    burnish_theory_metric metric;
    double (*of_model)(const burnish_theory_model *model);
    double (*of_exponent)(double exponent);
    double (*at)(const burnish_theory_model *model, double argument);
    size_t difference_at; /* offset in burnish_theory_difference of a double */
    size_t count_at;      /* offset in burnish_theory_cost of an int */
} entry;

#define BITS .takes = "BITS", .low = 1e-300, .high = 1024, .usual = 8
#define DEG .takes = "DEG", .high = 90, .usual = 10
#define LENGTH .takes = "LENGTH", .high = 1, .usual = 0.9
#define LOBES .takes = "LOBES", .low = 1, .high = 3, .usual = 3
#define DIFFERENCE(member) .difference_at = offsetof(burnish_theory_difference, member)
#define COST(member) .count_at = offsetof(burnish_theory_cost, member)

static const entry entries[] = {
    {{"shape", "zeta", "zeta", "zeta", "", "slope of the base, of the family and lyon",
      .decimals = 4},
     .of_model = zeta},
    {{"shape", "peak", "peak", "peak", "", "value at angle 0", .decimals = 4}, .of_model = peak},
    {{"shape", "value", "value", "value", "", "value at an angle", .decimals = 5, DEG},
     .at = value_at},
    {{"shape", "slope", "slope_per_rad", "slope", "1/rad", "first derivative there", .decimals = 4,
      DEG},
     .at = slope_at},
    {{"shape", "second", "second_per_rad2", "second", "1/rad^2", "second derivative there",
      .decimals = 3, DEG},
     .at = second_at},
    {{"shape", "radius", "radius_rad", "bend", "rad", "radius of curvature of the curve there",
      .decimals = 5, DEG},
     .at = radius_at},
    {{"shape", "alpha", "alpha", "alpha", "", "Beckmann or GGX alpha of the exponent",
      .decimals = 4},
     .of_exponent = burnish_theory_alpha_from_exponent},
    {{"shape", "roughness", "roughness", "rough", "", "the root of alpha", .decimals = 4},
     .of_exponent = burnish_theory_roughness_from_exponent},
    {{"shape", "phong-exponent", "phong_exponent", "Phong n", "",
      "exponent for Phong whose highlight is as wide as n for Blinn", .decimals = 2},
     .of_exponent = burnish_theory_phong_from_blinn},
    {{"shape", "blinn-exponent", "blinn_exponent", "Blinn n", "",
      "exponent for Blinn whose highlight is as wide as n for Phong", .decimals = 1},
     .of_exponent = burnish_theory_blinn_from_phong},
    {{"shape", "toksvig", "toksvig_exponent", "Toksvig", "",
      "exponent for averaged normals of that mean length", .decimals = 3, LENGTH},
     .at = toksvig},

    {{"widths", "zero-angle", "zero_angle_deg", "zero", "deg", "angle at which the lobe becomes 0",
      .decimals = 3},
     .of_model = burnish_theory_zero_angle},
    {{"widths", "cutoff-cosine", "cutoff_cosine", "cutoff", "cosine", "its cosine", .decimals = 5},
     .of_model = burnish_theory_cutoff_cosine},
    {{"widths", "curvature-radius", "curvature_radius_rad", "radius", "rad",
      "radius of curvature of the curve where the lobe becomes 0", .decimals = 5},
     .of_model = burnish_theory_zero_curvature_radius},
    {{"widths", "inflection", "inflection_deg", "inflect.", "deg", "angle of cos^n's inflection",
      .decimals = 3},
     .of_exponent = burnish_theory_inflection_angle},
    {{"widths", "angle", "angle_deg", "angle", "deg", "angle at which 2^-_BITS_ is reached",
      .decimals = 3, BITS},
     .at = angle_of},
    {{"widths", "ratio", "ratio", "R", "",
      "R, ratio of cos^n's angle at 2^-_BITS_ to the lobe's; above 1 the lobe is narrower",
      .decimals = 4, BITS},
     .at = burnish_theory_width_ratio},
    {{"widths", "boundary", "boundary_cosine", "boundary", "cosine",
      "cosine at which 2^-_BITS_ is reached", .decimals = 5, BITS},
     .at = burnish_theory_boundary_cosine},

    {{"energies", "integral", "integral_sr", "integral", "sr", "integral over solid angle",
      .decimals = -5},
     .of_model = integral},
    {{"energies", "cosine-integral", "cosine_integral_sr", "cos int.", "sr",
      "integral over projected solid angle", .decimals = -5},
     .of_model = cosine_integral},
    {{"energies", "energy", "energy", "energy", "of power", "integral relative to cos^n",
      .decimals = 4},
     .of_model = energy},
    {{"energies", "cosine-energy", "cosine_energy", "cos en.", "of power",
      "cosine-weighted integral relative to cos^n", .decimals = 4},
     .of_model = cosine_energy},
    {{"energies", "phong-factor", "phong_factor_per_sr", "Phong f.", "1/sr",
      "factor of a reflection lobe by Phong", .decimals = -5},
     .of_model = burnish_theory_phong_factor},
    {{"energies", "blinn-factor", "blinn_factor_per_sr", "Blinn f.", "1/sr",
      "factor of a reflection lobe by Blinn", .decimals = -5},
     .of_model = burnish_theory_blinn_factor},
    {{"energies", "blinn-factor-common", "blinn_factor_common_per_sr", "(n+8)/8pi", "1/sr",
      "the usual approximation for cos^n", .decimals = -5},
     .of_exponent = burnish_theory_blinn_factor_common},
    {{"energies", "phong-albedo", "phong_albedo", "Phong alb.", "",
      "light reflected at normal incidence, by Phong with the factor (n + 2)/2pi", .decimals = 5},
     .of_model = phong_albedo},
    {{"energies", "blinn-albedo", "blinn_albedo", "Blinn alb.", "",
      "the same by Blinn with the factor (n + 8)/8pi", .decimals = 5},
     .of_model = blinn_albedo},
    {{"energies", "normal-factor", "normal_factor_per_sr", "normal f.", "1/sr",
      "factor of a distribution of normals", .decimals = -5},
     .of_model = burnish_theory_normal_factor},

    {{"errors", "max-error", "max_error", "max err", "", "largest absolute error", .decimals = 5,
      .needs_difference = 1},
     DIFFERENCE(absolute)},
    {{"errors", "max-error-angle", "max_error_angle_deg", "at", "deg", "where", .decimals = 3,
      .needs_difference = 1},
     DIFFERENCE(absolute_angle)},
    {{"errors", "above", "above", "above", "", "largest excess over cos^n", .decimals = 5,
      .needs_difference = 1},
     DIFFERENCE(above)},
    {{"errors", "below", "below", "below", "", "largest shortfall", .decimals = 5,
      .needs_difference = 1},
     DIFFERENCE(below)},
    {{"errors", "max-relative", "max_relative_percent", "max rel", "%",
      "largest relative error in per cent", .decimals = 3, .needs_difference = 1},
     DIFFERENCE(relative)},
    {{"errors", "max-relative-angle", "max_relative_angle_deg", "at", "deg", "where", .decimals = 3,
      .needs_difference = 1},
     DIFFERENCE(relative_angle)},
    {{"errors", "error-integral", "error_integral_sr", "int. err", "sr",
      "integral of the absolute error over solid angle", .decimals = -4, .needs_difference = 1},
     DIFFERENCE(integral)},
    {{"errors", "rms", "rms", "rms", "", "root of the mean squared error over solid angle",
      .decimals = 5, .needs_difference = 1},
     DIFFERENCE(rms)},
    {{"errors", "relative", "relative_percent", "rel", "%",
      "relative error at an angle in per cent", .decimals = 3, DEG},
     .at = relative_at},
    {{"errors", "extreme-angle", "extreme_angle_deg", "extreme", "deg",
      "where the relative error is extreme, by formula", .decimals = 4},
     .of_model = burnish_theory_extreme_angle},
    {{"errors", "extreme-searched", "extreme_searched_deg", "searched", "deg", "the same by search",
      .decimals = 4},
     .of_model = burnish_theory_extreme_angle_searched},
    {{"errors", "extreme-relative", "extreme_relative_percent", "rel there", "%",
      "relative error there in per cent", .decimals = 3},
     .of_model = extreme_relative},

    {{"cost", "multiplications", "multiplications", "mul", "",
      "multiplications of one evaluation from a cosine", .decimals = 0},
     COST(multiplications)},
    {{"cost", "additions", "additions", "add", "", "additions and subtractions", .decimals = 0},
     COST(additions)},
    {{"cost", "comparisons", "comparisons", "max", "", "comparisons: max and selections",
      .decimals = 0},
     COST(comparisons)},
    {{"cost", "divisions", "divisions", "div", "", "divisions", .decimals = 0}, COST(divisions)},
    {{"cost", "functions", "functions", "fn", "", "calls of pow, exp or acos", .decimals = 0},
     COST(transcendentals)},
    {{"cost", "lookups", "lookups", "look", "", "reads of a table", .decimals = 0}, COST(lookups)},
    {{"cost", "memory", "memory_entries", "memory", "entries", "its size", .decimals = 0},
     .of_model = memory},

    {{"sums", "ggx-moved", "ggx_moved_percent", "GGX moved", "%",
      "energy in the wrong direction of a sum of so many lobes for GGX of this roughness, whatever "
      "the lobe",
      .decimals = 2, LOBES},
     .at = ggx_moved},
    {{"sums", "ggx-cap", "ggx_cap_percent", "GGX cap", "%",
      "its largest error of the light from a round light", .decimals = 2, LOBES},
     .at = ggx_cap},
    {{"sums", "beckmann-moved", "beckmann_moved_percent", "Beck. moved", "%",
      "the same for Beckmann", .decimals = 2, LOBES},
     .at = beckmann_moved},
    {{"sums", "beckmann-cap", "beckmann_cap_percent", "Beck. cap", "%", "the same for Beckmann",
      .decimals = 2, LOBES},
     .at = beckmann_cap},
};

const burnish_theory_metric *burnish_theory_metric_at(size_t index) {
    return index < sizeof entries / sizeof *entries ? &entries[index].metric : NULL;
}

double burnish_theory_metric_value(const burnish_theory_metric *metric,
                                   const burnish_theory_model *model, double argument,
                                   const burnish_theory_difference *difference) {
    const entry *e = (const entry *)metric;
    const burnish_theory_cost cost = burnish_theory_model_cost(model);
    double value;
    if (metric->needs_difference) {
        const char *base = (const char *)difference;
        value = difference ? *(const double *)(const void *)(base + e->difference_at) : NAN;
    } else {
        value = e->of_model      ? e->of_model(model)
                : e->of_exponent ? e->of_exponent(model->exponent)
                : e->at          ? e->at(model, argument)
                                 : *(const int *)(const void *)((const char *)&cost + e->count_at);
    }
    return strcmp(metric->unit, "deg") == 0 ? value / BURNISH_DEGREE
           : strcmp(metric->unit, "%") == 0 ? 100 * value
                                            : value;
}
