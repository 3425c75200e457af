/* burnish/theory.h: certified maxima of errors against dense sweeps, choice, boundary memories,
 * roughness. */
#include <math.h>
#include <string.h>

#include "burnish/theory.h"
#include "support.h"

static const double HALF_PI = 1.57079632679489661923;

static burnish_theory_model model_of(const char *words, double n) {
    burnish_theory_model model = {0};
    burnish_error error = {0};
    CHECK_OK(burnish_theory_model_parse(words, n, &model, &error), error);
    return model;
}

/* The certified maxima against 20,000 angles, and their angles against the values there. */
static void check_maxima(void) {
    enum { PLACES = 20000 };
    static const double ns[] = {1, 2.5, 18, 300, 65536};
    for (size_t w = 0; burnish_lobe_spec_example(w); ++w) {
        for (int i = 0; i < 10; ++i) {
            burnish_theory_model model;
            double n = ns[i / 2], core = burnish_theory_inflection_angle(n);
            double end = i % 2 ? core : HALF_PI, largest = 0, relative = 0;
            if (burnish_theory_model_parse(burnish_lobe_spec_example(w), n, &model, NULL)) {
                continue;
            }
            burnish_theory_difference d;
            burnish_theory_compare(&model, end, &d);
            for (int k = 0; k < PLACES; ++k) {
                double x = end * k / PLACES;
                double value = burnish_theory_value_at_angle(&model, x);
                double difference = fabs(value - pow(cos(x), n));
                largest = difference > largest ? difference : largest;
                difference = fabs(burnish_theory_relative_error(&model, x));
                relative = difference > relative ? difference : relative;
            }
            const char *word = burnish_lobe_spec_example(w);
            double noise = 1e-9 + 4e-16 * n; /* of pow(cos(x), n) */
            CHECK(largest <= d.absolute + noise, "%s n=%g: %.12g above the maximum %.12g", word, n,
                  largest, d.absolute);
            CHECK(largest > d.absolute * 0.97 - noise || model.lobe.entries, "%s n=%g: %g, %g",
                  word, n, largest, d.absolute);
            CHECK(relative <= d.relative * (1 + 1e-8) + noise, "%s n=%g: %g above %g", word, n,
                  relative, d.relative);
            CHECK(d.absolute == fmax(d.above, d.below) && d.end == end, "%s n=%g", word, n);
            double there = burnish_theory_value_at_angle(&model, d.absolute_angle) -
                           pow(cos(d.absolute_angle), n);
            CHECK(fabs(fabs(there) - d.absolute) < noise || model.lobe.entries, "%s n=%g: angle %g",
                  word, n, d.absolute_angle);
            CHECK(d.integral <= 2 * 3.1416 * d.absolute * (1 - cos(end)) * 1.0001 + 1e-14 &&
                      d.rms <= d.absolute + 1e-14,
                  "%s n=%g: integral %g rms %g", word, n, d.integral, d.rms);
        }
    }
    burnish_theory_model model = model_of("energy:2", 10);
    burnish_theory_difference d;
    burnish_theory_compare(&model, 2, &d);
    CHECK1(isnan(d.absolute) && isnan(burnish_theory_maximum_error(&model, 0)));
}

/* Integral and mean of the error in closed form: (1 - l/2)^2 .. against c^3, n = 3, all of c. */
static void check_error_integrals(void) {
    /* zeta 1.5: (1 - 1.5 l)^2 <= (1 - l)^3 everywhere: the integral is the difference of both */
    burnish_theory_model taylor = model_of("taylor:2", 3), power = model_of("power", 3);
    burnish_theory_difference d;
    burnish_theory_compare(&taylor, HALF_PI, &d);
    double expected = burnish_theory_integral(&power, 0) - burnish_theory_integral(&taylor, 0);
    CHECK(fabs(d.integral / expected - 1) < 1e-8, "%.12g, %.12g", d.integral, expected);
    /* over l in [0, 2/3] the difference is l^2 (.75 - l), beyond it (1 - l)^3 */
    double t = 2.0 / 3;
    double square =
        0.5625 * pow(t, 5) / 5 - 1.5 * pow(t, 6) / 6 + pow(t, 7) / 7 + pow(1 - t, 7) / 7;
    CHECK(fabs(d.rms / sqrt(square) - 1) < 1e-8, "%.12g, %.12g", d.rms, sqrt(square));
}

static void check_extremes(void) {
    for (double n = 3; n < 65536; n *= 1.7) {
        static const char *const words[] = {"energy:2", "shift7:2", "minimax:2", "level0.5:2"};
        for (int i = 0; i < 4; ++i) {
            burnish_theory_model model = model_of(words[i], n);
            double angle = burnish_theory_extreme_angle(&model);
            double found = burnish_theory_extreme_angle_searched(&model);
            CHECK(fabs(angle / found - 1) < 1e-5, "%s n=%g: %g, %g", words[i], n, angle, found);
            double formula = i == 0 ? sqrt(2 * n + 1) / n : 2 * sqrt(7 * n - 15) / (7 * n - 16);
            CHECK(i > 1 || fabs(tan(angle) / formula - 1) < 1e-9, "%s n=%g", words[i], n);
        }
    }
    burnish_theory_model schlick = model_of("schlick", 10);
    CHECK1(isnan(burnish_theory_extreme_angle(&schlick)));
}

static void check_choice(void) {
    static const struct {
        double n, epsilon;
        int affine;
        const char *words;
    } rows[] = {
        {100, .08, 0, "minimax:2"},    {100, .06, 0, "minimax:4"},  {100, .06, 1, "affine:2"},
        {100, .02, 0, "minimax:8"},    {100, .01, 0, "minimax:16"}, {2, .001, 0, "minimax:2"},
        {3, .01, 0, "composite:3"},    {3, .001, 0, "power"},       {100, 1e-4, 0, "composite:5"},
        {100, 1e-5, 0, "composite:6"}, {100, 1e-7, 0, "power"},     {1, .01, 0, "schlick"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        burnish_theory_model model;
        burnish_theory_cost cost;
        char name[32];
        double maximum;
        CHECK1(!burnish_theory_choose(rows[i].n, rows[i].epsilon, rows[i].affine, &model, &cost,
                                      &maximum, NULL));
        burnish_lobe_spec_name(&model.lobe, name, sizeof name);
        CHECK_TEXT(name, rows[i].words);
        CHECK1(maximum <= rows[i].epsilon &&
               fabs(maximum - burnish_theory_maximum_error(&model, HALF_PI)) < 1e-12);
        for (size_t w = 0; burnish_lobe_spec_example(w); ++w) { /* nothing cheaper is as good */
            burnish_theory_model other;
            if (burnish_theory_model_parse(burnish_lobe_spec_example(w), rows[i].n, &other, NULL) ||
                other.lobe.entries || (other.scale < 1 && !rows[i].affine)) {
                continue;
            }
            burnish_theory_cost its = burnish_theory_model_cost(&other);
            CHECK(burnish_theory_cost_order(&its, &cost) >= 0 ||
                      burnish_theory_maximum_error(&other, HALF_PI) > rows[i].epsilon,
                  "%s instead of %s", burnish_lobe_spec_example(w), name);
        }
    }
    burnish_theory_model model;
    CHECK1(burnish_theory_choose(10, 0, 0, &model, NULL, NULL, NULL) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_theory_choose(0, 0.1, 0, &model, NULL, NULL, NULL) == BURNISH_STATUS_ARGUMENT);
    burnish_theory_model w = model_of("taylor:16", 100);
    burnish_theory_cost cost = burnish_theory_model_cost(&w);
    CHECK1(cost.multiplications == 5 && cost.additions == 1 && cost.comparisons == 1);
    w = model_of("exact", 7); /* c c^2 c^4 */
    cost = burnish_theory_model_cost(&w);
    CHECK1(cost.multiplications == 4 && cost.transcendentals == 0 && cost.comparisons == 1);
    w = model_of("exact", 5.5);
    cost = burnish_theory_model_cost(&w);
    CHECK1(cost.multiplications == 0 && cost.transcendentals == 1);
}

static void check_formats(void) {
    static const char *const bad[] = {"",    "Q",      "15",     "UQ",  "Q.",    "Q1.",   "UQ0.0",
                                      "Q32", "UQ1.32", "Q0.15x", "q15", "Q-1.3", "Q100.1"};
    burnish_theory_format format = {1, 7, 7};
    char name[16];
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK(burnish_theory_format_parse(bad[i], &format, NULL) == BURNISH_STATUS_ARGUMENT,
              "\"%s\"", bad[i]);
    }
    CHECK1(format.integer_bits == 7);
    CHECK1(!burnish_theory_format_parse("Q15", &format, NULL));
    burnish_theory_format_name(&format, name, sizeof name);
    CHECK_TEXT(name, "Q0.15");
    CHECK1(burnish_theory_format_width(&format) == 16);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, 1) == 32767);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, -1) == -32768);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_DOWN, 0.5 + 0.9 / 32768) == 16384);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_UP, 0.5 + 0.1 / 32768) == 16385);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, 2.5 / 32768) == 3);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, NAN) == 0);
    CHECK1(burnish_theory_format_decode(&format, 16384) == 0.5);
    CHECK1(!burnish_theory_format_parse("UQ0.15", &format, NULL) && !format.is_signed);
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, -0.1) == 0);
    CHECK1(!burnish_theory_format_parse("UQ1.31", &format, NULL));
    CHECK1(burnish_theory_format_encode(&format, BURNISH_THEORY_NEAREST, 1) == 1ll << 31);
}

static void check_memories(void) {
    static const double n[] = {1, 2, 3, 10, 100, 65536};
    int64_t words[6];
    burnish_theory_memory memory = {.lobe = model_of("taylor:2", 10).lobe,
                                    .format = {0, 0, 15},
                                    .rounding = BURNISH_THEORY_DOWN};
    CHECK1(!burnish_theory_memory_fill(&memory, n, 6, words, NULL));
    for (int i = 0; i < 6; ++i) { /* 1 - 2/n, in whole words, downward */
        double cosine = n[i] > 2 ? (n[i] - 2) / n[i] : 0;
        CHECK(words[i] == (int64_t)floor(cosine * 32768 + 1e-9), "n=%g: %d", n[i], (int)words[i]);
    }
    memory.bits = 8;
    memory.lambda = 1;
    memory.rounding = BURNISH_THEORY_UP;
    memory.lobe = model_of("power", 10).lobe;
    CHECK1(!burnish_theory_memory_fill(&memory, n, 6, words, NULL));
    for (int i = 0; i < 6; ++i) {
        double stored = burnish_theory_format_decode(&memory.format, words[i]);
        CHECK1(words[i] == 32767 || pow(1 - stored, n[i]) <= 1.0 / 256 + 1e-15);
        CHECK1(pow(1 - stored + 1.0 / 32768, n[i]) >= 1.0 / 256);
    }
    memory.lobe = model_of("energy:32", 100).lobe; /* lower orders for the low exponents */
    CHECK1(!burnish_theory_memory_fill(&memory, n, 6, words, NULL));
    memory.lobe = model_of("projected:2", 100).lobe;
    CHECK1(burnish_theory_memory_fill(&memory, n, 6, words, NULL) == BURNISH_STATUS_ARGUMENT);
    memory.bits = 0.5;
    CHECK1(burnish_theory_memory_fill(&memory, n + 1, 1, words, NULL) == BURNISH_STATUS_ARGUMENT);
    memory.bits = 4;
    memory.format.fraction_bits = 40;
    CHECK1(burnish_theory_memory_fill(&memory, n + 1, 1, words, NULL) == BURNISH_STATUS_ARGUMENT);
}

static void check_roughness(void) {
    CHECK1(fabs(burnish_theory_exponent_from_alpha(0.1) - 198) < 1e-12);
    CHECK1(burnish_theory_exponent_from_alpha(1) == 0);
    CHECK1(fabs(burnish_theory_exponent_from_roughness(0.5) - 30) < 1e-12);
    for (double n = 1; n < 65536; n *= 3) {
        double alpha = burnish_theory_alpha_from_exponent(n);
        CHECK1(fabs(burnish_theory_exponent_from_alpha(alpha) / n - 1) < 1e-11);
        double roughness = burnish_theory_roughness_from_exponent(n);
        CHECK1(fabs(burnish_theory_exponent_from_roughness(roughness) / n - 1) < 1e-11);
        CHECK1(burnish_theory_phong_from_blinn(burnish_theory_blinn_from_phong(n)) == n);
    }
    CHECK1(burnish_theory_blinn_from_phong(10) == 40);
    CHECK1(burnish_theory_toksvig_exponent(100, 1) == 100);
    CHECK1(burnish_theory_toksvig_exponent(100, 0) == 0);
    CHECK1(fabs(burnish_theory_toksvig_exponent(100, 0.5) - 50 / 50.5) < 1e-14);
    /* Toksvig's exponent is n times Schlick's lobe of the length */
    burnish_theory_model schlick = model_of("schlick", 100);
    CHECK1(fabs(burnish_theory_toksvig_exponent(100, 0.9) -
                100 * burnish_theory_value(&schlick, 0.9)) < 1e-11);
}

static double metric(const char *name, const burnish_theory_model *model, double argument) {
    burnish_theory_difference difference;
    const burnish_theory_metric *m;
    burnish_theory_compare(model, HALF_PI, &difference);
    for (size_t i = 0; (m = burnish_theory_metric_at(i)) != NULL; ++i) {
        if (strcmp(m->name, name) == 0) {
            return burnish_theory_metric_value(m, model, argument, &difference);
        }
    }
    return NAN;
}

/* cli_lobe.sh compares their values with closed forms. */
static void check_metrics(void) {
    const burnish_theory_model w = model_of("taylor:2", 100), w1 = model_of("energy:2", 100);
    CHECK1(fabs(metric("cosine-energy", &w1, 0) -
                102.0 * (4 * 101 / 3.0 - 1) / 12 / (101 / 3.0) / (101 / 3.0)) < 1e-9);
    CHECK1(metric("ggx-moved", &w, 3) < metric("ggx-moved", &w, 1));
    CHECK1(isnan(burnish_theory_metric_value(
        burnish_theory_metric_at(0),
        &(burnish_theory_model){.lobe = {.kind = BURNISH_LOBE_POWER}, .exponent = 100, .scale = 1},
        0, NULL)));
    const burnish_theory_metric *m, *other;
    for (size_t i = 0; (m = burnish_theory_metric_at(i)) != NULL; ++i) {
        CHECK(m->usual >= m->low && m->usual <= m->high, "%s", m->name);
        CHECK(!isnan(metric(m->name, &w, m->usual)), "%s", m->name);
        for (size_t k = 0; k < i && (other = burnish_theory_metric_at(k)) != NULL; ++k) {
            CHECK(strcmp(m->name, other->name) != 0 && strcmp(m->key, other->key) != 0, "%s",
                  m->name);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_maxima());
    RUN(check_error_integrals());
    RUN(check_extremes());
    RUN(check_choice());
    RUN(check_formats());
    RUN(check_memories());
    RUN(check_roughness());
    RUN(check_metrics());
    return test_end("theory_errors");
}
