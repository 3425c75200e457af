/* burnish/theory.h: models, their words, derivatives against finite differences, monotonicity and order by sweeps, widths. */
#include <float.h>
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

static const double PI = 3.14159265358979323846;
static const double exponents[] = {1, 1.5, 2, 3, 10, 64, 99.5, 1000, 65536};
enum { EXPONENT_COUNT = sizeof exponents / sizeof exponents[0] };

/* Calls check(model) for every valid pair of word and exponent; returns their number. */
static void for_each_model(void (*check)(const burnish_theory_model *, const char *)) {
    int count = 0;
    for (size_t w = 0; burnish_lobe_spec_example(w); ++w) {
        for (int i = 0; i < EXPONENT_COUNT; ++i) {
            burnish_theory_model model;
            char name[64];
            if (burnish_theory_model_parse(burnish_lobe_spec_example(w), exponents[i], &model,
                                           NULL) == BURNISH_STATUS_OK) {
                snprintf(name, sizeof name, "%s n=%g", burnish_lobe_spec_example(w), exponents[i]);
                check(&model, name);
                ++count;
            }
        }
    }
    CHECK(count > 150, "only %d models", count);
}

static void check_derivatives(const burnish_theory_model *model, const char *name) {
    double n = model->exponent, width = 1 / sqrt(n);
    double h = 1e-4 * width;
    if (model->lobe.kind == BURNISH_LOBE_TABLE) {
        return; /* corners and steps everywhere: check_table_slopes */
    }
    if (model->zeta > n) { /* zeta6.645 is narrower than its exponent says */
        h = 1e-4 / sqrt(model->zeta);
    }
    double corners[3] = {burnish_theory_zero_angle(model), model->k[0], 0.5 * PI};
    for (int i = 1; i < 60; ++i) {
        double x = 6 * width * i / 60 + 0.001 * width, d[3];
        int skip = x > 0.5 * PI - 0.05; /* c^1.5 has no third derivative at c = 0 */
        for (int k = 0; k < 3; ++k) {
            skip |= fabs(x - corners[k]) < 3 * h;
        }
        if (skip) {
            continue;
        }
        burnish_theory_derivatives(model, x, d);
        double low = burnish_theory_value_at_angle(model, x - h);
        double high = burnish_theory_value_at_angle(model, x + h);
        CHECK1(d[0] == burnish_theory_value_at_angle(model, x));
        CHECK(fabs((high - low) / (2 * h) - d[1]) < 1e-6 / width, "%s: first at %g", name, x);
        CHECK(fabs((high - 2 * d[0] + low) / (h * h) - d[2]) < 2e-6 * (n + model->zeta),
              "%s: second at %g: %g", name, x, d[2]);
    }
}

/* m = 2 in closed form, and the piecewise constant slope of a table. */
static void check_slopes(void) {
    burnish_theory_model model;
    double d[3], x = 0.2;
    CHECK1(burnish_theory_model_parse("zeta4:2", 10, &model, NULL) == BURNISH_STATUS_OK);
    burnish_theory_derivatives(&model, x, d);
    double u = 1 + 4 * (cos(x) - 1);
    CHECK1(fabs(d[1] + 8 * sin(x) * u) < 1e-14);
    CHECK1(fabs(d[2] - (32 * sin(x) * sin(x) - 8 * cos(x) * u)) < 1e-13);
    CHECK1(burnish_theory_model_parse("table11:linear", 2, &model, NULL) == BURNISH_STATUS_OK);
    burnish_theory_derivatives(&model, acos(0.75), d); /* from .49 at .7 to .64 at .8 */
    CHECK1(fabs(d[0] - 0.565) < 1e-14 && fabs(d[1] + 1.5 * sin(acos(0.75))) < 1e-12);
    CHECK1(burnish_theory_model_parse("table11", 2, &model, NULL) == BURNISH_STATUS_OK);
    CHECK1(fabs(burnish_theory_value(&model, 0.7499) - 0.49) < 1e-14);
    CHECK1(fabs(burnish_theory_value(&model, 0.7501) - 0.64) < 1e-14);
    burnish_theory_derivatives(&model, acos(0.76), d);
    CHECK1(d[1] == 0 && d[2] == 0);
}

static void check_monotone(const burnish_theory_model *model, const char *name) {
    double before = burnish_theory_value_at_lambda(model, 0);
    CHECK(before == model->scale, "%s: peak %g", name, before);
    for (int i = 1; i <= 2000; ++i) {
        double s = i / 2000.0, value = burnish_theory_value_at_lambda(model, 2 * s * s * s * s);
        CHECK(value <= before + 4 * DBL_EPSILON && value >= 0, "%s: rises at lambda %g", name,
              2 * s * s * s * s);
        before = value;
    }
    CHECK1(burnish_theory_value(model, NAN) == 0 && burnish_theory_value(model, 2) == model->scale);
    CHECK1(burnish_theory_value_at_lambda(model, HUGE_VAL) == 0);
}

static void check_widths(const burnish_theory_model *model, const char *name) {
    double zero = burnish_theory_zero_angle(model);
    for (double bits = 1; bits <= 16; bits *= 2) {
        double level = exp2(-bits), angle = burnish_theory_angle_at(model, level);
        if (isnan(angle)) {
            CHECK(burnish_theory_value_at_angle(model, PI) > level, "%s: 2^-%g", name, bits);
            continue;
        }
        if (model->lobe.kind == BURNISH_LOBE_TABLE && !model->lobe.linear) {
            CHECK(burnish_theory_value_at_angle(model, angle * (1 + 1e-9)) <= level &&
                      burnish_theory_value_at_angle(model, angle * (1 - 1e-9)) > level,
                  "%s: 2^-%g", name, bits);
        } else {
            double value = burnish_theory_value_at_angle(model, angle);
            CHECK(fabs(value - level) < 1e-9 * model->exponent, "%s: 2^-%g: %g", name, bits, value);
        }
        CHECK(fabs(burnish_theory_boundary_cosine(model, bits) - fmax(0, cos(angle))) < 1e-14,
              "%s: boundary 2^-%g", name, bits);
        burnish_theory_model power;
        CHECK1(!burnish_theory_model_create(
            &power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER}, model->exponent));
        double ratio = burnish_theory_angle_at(&power, level) / angle;
        CHECK(fabs(burnish_theory_width_ratio(model, bits) / ratio - 1) < 1e-12, "%s: R", name);
    }
    if (!isnan(zero)) {
        CHECK(burnish_theory_value_at_angle(model, zero) < 1e-14 &&
                  (burnish_theory_value_at_angle(model, zero * 0.99) > 0 || model->exponent > 100),
              "%s: zero %g", name, zero);
        CHECK(fabs(burnish_theory_cutoff_cosine(model) - cos(zero)) < 1e-14, "%s: cutoff", name);
    }
}

/* Radii from derivatives just inside the zero. */
static void check_radii(void) {
    static const char *const words[] = {"taylor:2", "energy:2", "shift7:2",   "gx",
                                        "schlick",  "nv2x",     "kuijk-blake"};
    for (int w = 0; w < 7; ++w) {
        for (int i = 3; i < 6; ++i) {
            burnish_theory_model model;
            double d[3], n = exponents[i];
            CHECK1(!burnish_theory_model_parse(words[w], n, &model, NULL));
            burnish_theory_derivatives(&model, burnish_theory_zero_angle(&model) * (1 - 1e-9), d);
            double radius = pow(1 + d[1] * d[1], 1.5) / fabs(d[2]);
            double r = burnish_theory_zero_curvature_radius(&model);
            CHECK(fabs(r / radius - 1) < 1e-5, "%s n=%g: %g, %g", words[w], n, r, radius);
            double known = w == 0 ? 1 / (2 * n - 2) : w == 1 ? 3 / (4 * n - 2) : 4 / (7 * n - 8);
            CHECK(w > 2 || fabs(r / known - 1) < 1e-12, "%s n=%g: %g", words[w], n, r);
        }
    }
    CHECK1(fabs(burnish_theory_inflection_angle(100) - acos(sqrt(0.99))) < 1e-14);
}

/* radii.csv: (1 + f'^2)^(3/2) / |f''| of the lobes' formulas, derivatives found
 * numerically (mpmath 1.3, 40 digits, mpmath.diff), at angles inside the lobe. */
static void check_curvature(void) {
    FILE *file = fopen(TEST_DATA_DIR "/radii.csv", "r");
    char line[128], words[32], angle_text[32];
    double n, expected;
    int compared = 0;
    if (!CHECK(file != NULL, "radii.csv")) {
        return;
    }
    (void)!fgets(line, sizeof line, file);
    while (fgets(line, sizeof line, file)) {
        burnish_theory_model model;
        if (!CHECK(sscanf(line, "%31[^,],%lf,%31[^,],%lf", words, &n, angle_text, &expected) == 4 &&
                       !burnish_theory_model_parse(words, n, &model, NULL),
                   "%s", line)) {
            break;
        }
        double radius = burnish_theory_curvature_radius(&model, strtod(angle_text, NULL));
        CHECK(fabs(radius / expected - 1) < 1e-9, "%s: %.17g", line, radius);
        ++compared;
    }
    fclose(file);
    CHECK(compared == 68, "%d lines", compared);
    burnish_theory_model w;
    CHECK1(!burnish_theory_model_parse("taylor:2", 100, &w, NULL));
    double zero = burnish_theory_zero_angle(&w);
    CHECK1(fabs(burnish_theory_curvature_radius(&w, zero) * 198 - 1) < 1e-9);
    CHECK1(isinf(burnish_theory_curvature_radius(&w, zero * 1.001)));
    CHECK1(fabs(burnish_theory_curvature_radius(&w, 0) - 0.01) < 1e-15);
}

static void check_words(void) {
    static const char *const bad[] = {
        "",           "nonsense",   "energy:3",    "energy:64", "level",   "level0:2",
        "level1:2",   "level1.5",   "shift7:4",    "schlick:2", "table",   "table1",
        "table65537", "table2.5",   "table256:no", "zeta:2",    "zeta0:2", "zeta65537:2",
        "energy:2x",  "projected:", "gx ",         "nv2x:2",    "affine:0"};
    char long_text[2000], name[32];
    burnish_theory_model model = {.exponent = 7};
    burnish_error error;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK(burnish_theory_model_parse(bad[i], 10, &model, &error) == BURNISH_STATUS_ARGUMENT,
              "\"%s\"", bad[i]);
        CHECK(strlen(error.text) > 20 && !strchr(error.text, '\n'), "%s", error.text);
    }
    memset(long_text, 'z', sizeof long_text);
    long_text[sizeof long_text - 1] = 0;
    CHECK1(burnish_theory_model_parse(long_text, 10, &model, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_theory_model_parse("energy:2", 0.5, &model, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_theory_model_parse("power", NAN, &model, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_theory_model_parse("minimax:32", 31, &model, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_theory_model_parse(NULL, 10, &model, NULL) == BURNISH_STATUS_ARGUMENT);
    CHECK1(model.exponent == 7); /* untouched by every error */
    for (size_t w = 0; burnish_lobe_spec_example(w); ++w) {
        CHECK1(!burnish_theory_model_parse(burnish_lobe_spec_example(w), 64, &model, NULL));
        burnish_lobe_spec_name(&model.lobe, name, sizeof name);
        CHECK_TEXT(name, burnish_lobe_spec_example(w));
        burnish_theory_model other, again;
        CHECK1(!burnish_theory_model_create(&other, &model.lobe, 200));
        CHECK1(!burnish_theory_model_parse(name, 200, &again, NULL));
        CHECK1(other.lobe.kind == again.lobe.kind && other.zeta == again.zeta &&
               other.exponent == 200);
    }
    CHECK1(!burnish_theory_model_parse("energy", 10, &model, NULL) && model.lobe.order == 2);
    CHECK1(!burnish_theory_model_parse("table16:nearest", 10, &model, NULL) && !model.lobe.linear);
    CHECK1(!burnish_theory_model_parse("zeta6.645:2", 10, &model, NULL) && model.zeta == 6.645);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(for_each_model(check_derivatives));
    RUN(for_each_model(check_monotone));
    RUN(for_each_model(check_widths));
    RUN(check_slopes());
    RUN(check_radii());
    RUN(check_curvature());
    RUN(check_words());
    return test_end("theory_values");
}
