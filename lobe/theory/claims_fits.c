/* The paper's claims of W1 (equal energy) and of W_Q and W_0.5 (equal level). */
#include <math.h>

#include "theory/claims.h"

static const double END = 0.5 * BURNISH_PI;

static double angle_of_level(double n, double level) {
    burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n);
    return burnish_theory_angle_at(&power, level);
}

/* The integrand over s = sqrt(lambda), for burnish_theory_quadrature. */
static double integrand(double s, const void *context) {
    return burnish_theory_value_at_lambda(context, s * s) * 2 * s;
}

static double integral(const burnish_theory_model *model) {
    return burnish_theory_quadrature(integrand, model, model, 0, 1, 1e-16);
}

/* ---- W1 ---- */

static void integrals(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model w1 = burnish_claim_lobe(BURNISH_FIT_ENERGY, n[i]);
        burnish_claim_add(claim, 1, integral(&power) * (n[i] + 1), "power n=%g", n[i]);
        burnish_claim_add(claim, 1, integral(&w) * 3 * (0.5 * n[i]), "W n=%g", n[i]);
        burnish_claim_add(claim, 1, integral(&w1) / integral(&power), "W1 / power n=%g", n[i]);
    }
}

static void energy_absolute(burnish_theory_claim *claim) {
    static const double n[] = {1, 2, 3, 5, 10, 21, 100, 1000, 65536};
    for (int i = 0; i < 9; ++i) {
        burnish_theory_model w1 = burnish_claim_lobe(BURNISH_FIT_ENERGY, n[i]);
        burnish_claim_add(claim, 1, burnish_theory_maximum_error(&w1, END), "n=%g", n[i]);
    }
}

/* Equal errors above and below cos^n. */
static void energy_even(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w1 = burnish_claim_lobe(BURNISH_FIT_ENERGY, n[i]);
        burnish_theory_model best = burnish_claim_lobe(BURNISH_FIT_MINIMAX, n[i]);
        burnish_theory_difference of_w1, of_best;
        burnish_theory_compare(&w1, END, &of_w1);
        burnish_theory_compare(&best, END, &of_best);
        burnish_claim_add(claim, 1, of_w1.above / of_w1.below, "W1 n=%g", n[i]);
        burnish_claim_add(claim, 0, of_best.above / of_best.below, "minimax n=%g", n[i]);
    }
}

static void energy_extreme(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w1 = burnish_claim_lobe(BURNISH_FIT_ENERGY, n[i]);
        double angle = burnish_theory_extreme_angle_searched(&w1);
        burnish_claim_add(claim, 1, tan(angle) * n[i] / sqrt(2 * n[i] + 1), "n=%g", n[i]);
        burnish_claim_add(claim, 0, burnish_theory_value_at_angle(&w1, angle), "W1 there n=%g",
                          n[i]);
    }
}

/* ---- W_Q ---- */

/* The other root of (1 - zeta lambda)^2 = Q, beyond the zero, where the parabola rises again. */
static void second_root(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    static const double level[] = {0.1, 0.5, 0.9};
    for (int i = 0; i < 12; ++i) {
        double lambda = -expm1(log(level[i % 3]) / n[i / 3]);
        double zeta = (1 + sqrt(level[i % 3])) / lambda;
        double sine = sqrt(lambda * (2 - lambda));
        burnish_claim_add(claim, 1, -2 * zeta * sine * (1 - zeta * lambda), "Q=%g n=%g",
                          level[i % 3], n[i / 3]);
    }
}

typedef enum { LARGEST, COSINE_RMS, ANGLE_RMS, NORM_COUNT } level_norm;

typedef struct {
    double exponent, end;
    level_norm norm; /* the largest error, or the root of its mean square over cosine or angle */
} level_search;

static burnish_theory_model level_model(double exponent, double level) {
    burnish_theory_model model;
    (void)burnish_theory_model_create(
        &model, &(burnish_lobe_spec){.fit = BURNISH_FIT_LEVEL, .order = 2, .parameter = level},
        exponent);
    return model;
}

/* The mean square over the angle by the midpoint rule, whose error is below 1e-6 of it. */
static double angle_mean(const burnish_theory_model *model, double end) {
    enum { STEPS = 1000 };
    burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, model->exponent);
    double sum = 0;
    for (int i = 0; i < STEPS; ++i) {
        double lambda = burnish_theory_lambda_of_angle(end * (i + 0.5) / STEPS);
        double error = burnish_theory_value_at_lambda(model, lambda) -
                       burnish_theory_value_at_lambda(&power, lambda);
        sum += error * error;
    }
    return sum / STEPS;
}

static double level_error(const level_search *search, double level) {
    burnish_theory_model model = level_model(search->exponent, level);
    if (search->norm == LARGEST) {
        return burnish_theory_maximum_error(&model, search->end);
    }
    if (search->norm == ANGLE_RMS) {
        return sqrt(angle_mean(&model, search->end));
    }
    burnish_theory_difference difference;
    burnish_theory_compare(&model, search->end, &difference);
    return difference.rms;
}

/* The Q of least error: the best of 49, then golden section between its neighbours. */
static double best_level(const level_search *search) {
    const double golden = 0.6180339887498949, step = 0.02;
    double best = step;
    for (int i = 2; i < 50; ++i) {
        best = level_error(search, i * step) < level_error(search, best) ? i * step : best;
    }
    double low = best - 0.99 * step, high = best + 0.99 * step;
    while (high - low > 1e-5) {
        double a = high - golden * (high - low), b = low + golden * (high - low);
        if (level_error(search, a) < level_error(search, b)) {
            high = b;
        } else {
            low = a;
        }
    }
    return 0.5 * (low + high);
}

static void level_best(burnish_theory_claim *claim) {
    static const char *const norms[NORM_COUNT] = {"max", "cosine rms", "angle rms"};
    static const double n[] = {10, 100};
    for (int i = 0; i < 2; ++i) {
        const double ends[] = {END, angle_of_level(n[i], 0.45),
                               burnish_theory_inflection_angle(n[i])};
        static const char *const ranges[] = {"90 degrees", "level .45", "inflection"};
        for (int k = 0; k < 3 * NORM_COUNT; ++k) {
            const level_norm norm = (level_norm)(k % NORM_COUNT);
            const level_search search = {n[i], ends[k / NORM_COUNT], norm};
            burnish_claim_add(claim, 1, best_level(&search), "%s to %s n=%g", norms[norm],
                              ranges[k / NORM_COUNT], n[i]);
        }
    }
}

/* The Q whose slope is that slope, between 1 and n/2: the slope of W_Q grows with Q. */
static double level_of_slope(double exponent, double zeta) {
    double low = 1e-6, high = 1 - 1e-6;
    while (high - low > 1e-12) {
        double middle = 0.5 * (low + high);
        if (level_model(exponent, middle).zeta < zeta) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

static void half_slope(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model shifted = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        burnish_theory_model exact = burnish_claim_lobe(BURNISH_FIT_LEVEL, n[i]);
        burnish_claim_add(claim, 1, shifted.zeta / exact.zeta, "slopes n=%g", n[i]);
        burnish_claim_add(claim, 0, exact.zeta / n[i], "slope/n of Q=0.5 n=%g", n[i]);
        burnish_claim_add(claim, 0, level_of_slope(n[i], shifted.zeta), "Q of 7n/16 n=%g", n[i]);
        burnish_claim_add(claim, 0,
                          burnish_theory_value_at_angle(&shifted, angle_of_level(n[i], 0.5)),
                          "7n/16 at level .5 n=%g", n[i]);
    }
    burnish_theory_model shifted = burnish_claim_lobe(BURNISH_FIT_SHIFT7, 100);
    burnish_theory_model exact = burnish_claim_lobe(BURNISH_FIT_LEVEL, 100);
    burnish_claim_add(claim, 0, burnish_claim_core_relative(&shifted), "core %% 7n/16 n=100");
    burnish_claim_add(claim, 0, burnish_claim_core_relative(&exact), "core %% Q=0.5 n=100");
}

static void half_zero(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        double cosine = 1 - 16 / (7 * n[i]);
        burnish_claim_add(claim, 1, fabs(cos(burnish_theory_zero_angle(&half)) - cosine),
                          "cosine n=%g", n[i]);
        burnish_claim_add(claim, 1, burnish_theory_value(&half, cosine), "value n=%g", n[i]);
    }
}

static void half_tail(burnish_theory_claim *claim, const double *n, int count) {
    for (int i = 0; i < count; ++i) {
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        burnish_theory_model exact = burnish_claim_lobe(BURNISH_FIT_LEVEL, n[i]);
        double end = angle_of_level(n[i], 0.45);
        double core = burnish_theory_inflection_angle(n[i]);
        burnish_claim_add(claim, 1, burnish_theory_maximum_error(&half, end), "7n/16 n=%g", n[i]);
        burnish_claim_add(claim, 0, burnish_theory_maximum_error(&exact, end), "level(.5) n=%g",
                          n[i]);
        burnish_claim_add(claim, 0, burnish_theory_maximum_error(&half, angle_of_level(n[i], 0.5)),
                          "to level .5 n=%g", n[i]);
        burnish_claim_add(claim, 0, burnish_theory_maximum_error(&half, core), "to inflection n=%g",
                          n[i]);
        const level_search search = {n[i], end, LARGEST};
        burnish_claim_add(claim, 0, level_error(&search, best_level(&search)), "best Q n=%g", n[i]);
    }
}

static void half_tail_large(burnish_theory_claim *claim) {
    static const double n[] = {21, 100, 65536};
    half_tail(claim, n, 3);
}

static void half_tail_small(burnish_theory_claim *claim) {
    static const double n[] = {3, 5, 20};
    half_tail(claim, n, 3);
}

static double core_absolute(const burnish_theory_model *model) {
    return burnish_theory_maximum_error(model, burnish_theory_inflection_angle(model->exponent));
}

static void schlick_core(burnish_theory_claim *claim) {
    static const double n[] = {21, 100, 1000, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_claim_add(claim, 1, core_absolute(&schlick), "n=%g", n[i]);
    }
}

static void schlick_ratio(burnish_theory_claim *claim) {
    static const double n[] = {21, 100, 1000, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        const double end = angle_of_level(n[i], 0.45);
        const double tail = burnish_theory_maximum_error(&half, end);
        burnish_claim_add(claim, 1, core_absolute(&schlick) / tail, "as stated n=%g", n[i]);
        burnish_claim_add(claim, 1, core_absolute(&schlick) / core_absolute(&half),
                          "to inflection n=%g", n[i]);
        burnish_claim_add(claim, 1, burnish_theory_maximum_error(&schlick, end) / tail,
                          "to level .45 n=%g", n[i]);
    }
}

static void half_extreme(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        double tangent = tan(burnish_theory_extreme_angle_searched(&half));
        burnish_claim_add(claim, 1, tangent * (7 * n[i] - 16) / (2 * sqrt(7 * n[i] - 15)), "n=%g",
                          n[i]);
    }
}

static void half_radius(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i]);
        burnish_claim_add(claim, 1,
                          burnish_theory_zero_curvature_radius(&half) * (7 * n[i] - 8) / 4, "n=%g",
                          n[i]);
    }
}

static void half_radius_larger(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    static const burnish_lobe_fit fits[] = {BURNISH_FIT_ENERGY, BURNISH_FIT_TAYLOR};
    for (int i = 0; i < 8; ++i) {
        burnish_theory_model half = burnish_claim_lobe(BURNISH_FIT_SHIFT7, n[i / 2]);
        burnish_theory_model other = burnish_claim_lobe(fits[i % 2], n[i / 2]);
        burnish_claim_add(claim, 1,
                          burnish_theory_zero_curvature_radius(&half) /
                              burnish_theory_zero_curvature_radius(&other),
                          "over %s n=%g", i % 2 ? "W's" : "W1's", n[i / 2]);
    }
}

/* ---- The list ---- */

const burnish_claim_source burnish_claims_fits[] = {
    {"integrals",
     "over the cosine W's integral is 1/(3 zeta), the power's 1/(n + 1): equal for (n + 1)/3",
     "integral by quadrature over the formula; W1's over the power's", "",
     BURNISH_CLAIM_SHOW("integrals"), BURNISH_THEORY_ABOUT, 1, 1e-9, integrals, 0, NULL},
    {"w1-absolute", "W1 differs from the power by at most 0.1", "largest absolute error",
     "true from n = 1.052 on", BURNISH_CLAIM_SHOW("w1-absolute"), BURNISH_THEORY_AT_MOST, 0.1, 0.1,
     energy_absolute, 0, NULL},
    {"w1-even", "W1's absolute error is distributed evenly over the whole interval",
     "largest excess over the power, by the largest shortfall",
     "nearly at n = 3; always more evenly than W's, which is all shortfall; even is minimax (*)",
     BURNISH_CLAIM_SHOW("w1-even"), BURNISH_THEORY_ABOUT, 1, 0.1, energy_even, 0, NULL},
    {"w1-extreme", "W1's relative error is extreme at arctan(sqrt(2n + 1)/n)",
     "tangent of the angle found by search, over the formula's",
     "W1 is 4/9 there for every n (*), so the error is (4/9)(1 + 1/n)^n - 1, 20.81 % for large n; "
     "beyond that angle it falls to -100 %",
     BURNISH_CLAIM_SHOW("w1-extreme"), BURNISH_THEORY_ABOUT, 1, 1e-5, energy_extreme, 0, NULL},
    {"level-second-root",
     "the level's second root, zeta = (1 + sqrt Q)/(1 - Q^(1/n)), is of no use: W_Q rises there",
     "slope of the parabola where it meets the level, per radian",
     "it meets the level beyond its zero, on the way up", BURNISH_CLAIM_SHOW("level-second-root"),
     BURNISH_THEORY_AT_LEAST, 0, 0, second_root, 0, NULL},
    {"level-best", "W_Q is most accurate for Q = 0.5", "Q of the least error, by range and norm",
     "near for the largest error down to level .45 only", BURNISH_CLAIM_SHOW("level-best"),
     BURNISH_THEORY_ABOUT, 0.5, 0.1, level_best, 0, NULL},
    {"w05-slope", "for Q = 0.5 the slope of W_Q is about 7n/16", "7n/16 over the slope of Q = 0.5",
     "true to 4 % from n = 5 on, closest near n = 10; 7n/16 is the slope of the Q listed, so it is "
     "closer to the power down to the inflection, and further off down to level .45 (*; w05-large)",
     BURNISH_CLAIM_SHOW("w05-slope"), BURNISH_THEORY_ABOUT, 1, 0.08, half_slope, 0, NULL},
    {"w05-zero", "W_0.5 is zero where the cosine is 1 - 16/(7n)",
     "distance of the cosines; value there", "", BURNISH_CLAIM_SHOW("w05-zero"),
     BURNISH_THEORY_AT_MOST, 0, 0, half_zero, 0, NULL},
    {"w05-large", "down to level .45, W_0.5 is off by at most .015 for n > 20",
     "largest absolute error",
     "no Q comes that close (*); down to level .5, the Q of the construction, 7n/16 does from n = "
     "43 "
     "on, and to 5 % for all n > 20: probably what was meant",
     BURNISH_CLAIM_SHOW("w05-large"), BURNISH_THEORY_AT_MOST, 0.015, 0.001, half_tail_large, 0,
     NULL},
    {"w05-small", "down to level .45, W_0.5 is off by less than .02 for other n",
     "largest absolute error", "true from n = 6 on", BURNISH_CLAIM_SHOW("w05-small"),
     BURNISH_THEORY_AT_MOST, 0.02, 0.01, half_tail_small, 0, NULL},
    {"schlick-absolute", "down to the inflection, Schlick's lobe is off by .06",
     "largest absolute error", "", BURNISH_CLAIM_SHOW("schlick-absolute"), BURNISH_THEORY_ABOUT,
     0.06, 0.01, schlick_core, 0, NULL},
    {"schlick-ratio", "that is four times the error of W_0.5",
     "ratio of the errors: as stated, Schlick's to the inflection; or both to one end",
     "not true of the ranges for which the paper states the two errors; true of large n if both "
     "errors are taken down to the same end",
     BURNISH_CLAIM_SHOW("schlick-ratio"), BURNISH_THEORY_ABOUT, 4, 1, schlick_ratio, 0, NULL},
    {"w05-extreme", "W_0.5's relative error is extreme at arctan(2 sqrt(7n - 15)/(7n - 16))",
     "tangent of the angle found by search, over the formula's", "",
     BURNISH_CLAIM_SHOW("w05-extreme"), BURNISH_THEORY_ABOUT, 1, 1e-5, half_extreme, 0, NULL},
    {"w05-radius", "W_0.5 meets zero with the curvature radius 4/(7n - 8)",
     "radius times (7n - 8)/4", "", BURNISH_CLAIM_SHOW("w05-radius"), BURNISH_THEORY_ABOUT, 1, 0,
     half_radius, 0, NULL},
    {"w05-radius-larger", "that radius is larger than W1's (W's, by another reading)",
     "ratio of the radii",
     "true of W; of W1, which the text more likely names, up to n = 3 only (n < 16/5): the ratio "
     "tends to 16/21",
     BURNISH_CLAIM_SHOW("w05-radius-larger"), BURNISH_THEORY_AT_LEAST, 1, 0, half_radius_larger, 0,
     NULL},
    {0},
};
