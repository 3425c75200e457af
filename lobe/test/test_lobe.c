/* burnish/lobe.h: reference values, arguments, special floats, and the sweeps of sweep.h in
 * strides. */
#include <float.h>
#include <math.h>

#include "burnish/lobe.h"
#include "burnish/theory.h"
#include "falloff.h"
#include "support.h"
#include "sweep.h"

/* ---- Reference values: lobe/test/data/lobes.csv ------------------------------------------------------
 *
 * 400 of 4,000 random rows. Of each lobe, order and fit 16 or 20: those with the least and the
 * largest exponent, cosine and value, a zero, the largest absolute and relative error in float, and
 * others at even ranks by exponent and cosine. */

/* One line: lobe,order,fit,exponent,cosine,zeta,value; columns that a lobe lacks are empty. */
typedef struct {
    char lobe[16], fit[16];
    int order;
    float cosine;
    double exponent, zeta, value;
} reference;

/* Splits a line at its commas, in place. */
static int parse(char *line, reference *row) {
    char *fields[7] = {line};
    line[strcspn(line, "\r\n")] = '\0';
    for (int i = 1; i < 7; ++i) {
        fields[i] = strchr(fields[i - 1], ',');
        if (fields[i] == NULL) {
            return 0;
        }
        *fields[i]++ = '\0';
    }
    if (strlen(fields[0]) > 15 || strlen(fields[2]) > 15) {
        return 0;
    }
    strcpy(row->lobe, fields[0]);
    strcpy(row->fit, fields[2]);
    row->order = atoi(fields[1]);
    row->exponent = strtod(fields[3], NULL);
    row->cosine = strtof(fields[4], NULL);
    row->zeta = strtod(fields[5], NULL);
    row->value = strtod(fields[6], NULL);
    return 1;
}

static burnish_lobe_fit fit_of(const char *name) {
    static const char *const names[] = {"taylor", "energy", "level0.5",
                                        "shift7", "shift3", "projected"};
    int fit = 0;
    while (fit <= BURNISH_FIT_PROJECTED && strcmp(name, names[fit]) != 0) {
        ++fit;
    }
    return (burnish_lobe_fit)fit;
}

static int close_to(double got, double expected, double relative) {
    return fabs(got - expected) <= relative * fabs(expected) + 1e-300;
}

/* A family row through every way to make its lobe; the value goes to the table. */
static float family_value(const reference *row) {
    burnish_lobe_fit fit = fit_of(row->fit);
    burnish_lobe lobe, made;
    double zeta, scale;
    CHECK(burnish_lobe_from_zeta(&lobe, (float)row->zeta, row->order) == BURNISH_LOBE_OK, "%g",
          row->zeta);
    double theory = burnish_theory_family(row->zeta, row->order, (double)row->cosine);
    CHECK(fabs(theory - row->value) < 1e-14 &&
              (row->value < 1e-6 || close_to(theory, row->value, 1e-12)),
          "%s:%d n=%g: %.17g", row->fit, row->order, row->exponent, theory);

    burnish_lobe_status status =
        burnish_lobe_solve(&(burnish_lobe_spec){.fit = fit, .order = row->order, .parameter = 0.5},
                           row->exponent, &zeta, &scale);
    if (row->order > 2 && row->exponent < row->order) {
        CHECK(status == BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT, "%s:%d n=%g", row->fit, row->order,
              row->exponent);
        return burnish_lobe_at_cosine(lobe, row->cosine);
    }
    CHECK(status == BURNISH_LOBE_OK && close_to(zeta, row->zeta, 2e-15) &&
              (float)zeta == lobe.zeta && lobe.order == row->order,
          "%s:%d n=%g zeta %.17g", row->fit, row->order, row->exponent, zeta);
    status = burnish_lobe_create(&made, fit, row->order, (float)row->exponent);
    if (fit == BURNISH_FIT_LEVEL || fit == BURNISH_FIT_PROJECTED) {
        CHECK(status == BURNISH_LOBE_ERROR_FIT_NEEDS_SOLVE, "%s", row->fit);
    } else {
        CHECK(status == BURNISH_LOBE_OK && made.zeta == lobe.zeta && made.order == lobe.order,
              "%s:%d n=%g", row->fit, row->order, row->exponent);
    }
    return burnish_lobe_at_cosine(lobe, row->cosine);
}

/* The theory's model of the row's words. */
static void check_model(const reference *row) {
    burnish_theory_model model;
    char words[32];
    snprintf(words, sizeof words, "%s", row->lobe);
    if (*row->fit) {
        snprintf(words, sizeof words, "%s:%d", row->fit, row->order);
    }
    if (row->order > 2 && row->exponent < row->order) {
        return; /* the float header's range is wider: it takes any zeta */
    }
    if (CHECK(burnish_theory_model_parse(words, row->exponent, &model, NULL) == BURNISH_STATUS_OK,
              "%s n=%g", words, row->exponent)) {
        double error = fabs(burnish_theory_value(&model, (double)row->cosine) - row->value);
        CHECK(error < 1e-13, "%s n=%g at %a: off by %g", words, row->exponent, (double)row->cosine,
              error);
    }
}

static void check_row(const reference *row, sweep_result *results) {
    double c = (double)row->cosine;
    sweep_kind kind = SWEEP_FAMILY;
    float value;
    check_model(row);
    if (strcmp(row->lobe, "power") == 0) {
        CHECK(close_to(burnish_theory_power(c, row->exponent), row->value, 1e-12), "power %g at %a",
              row->exponent, c);
        return;
    }
    if (strcmp(row->lobe, "schlick") == 0) {
        CHECK(close_to(burnish_theory_schlick(c, row->exponent), row->value, 1e-14),
              "schlick %g at %a", row->exponent, c);
        value = burnish_schlick_at_cosine(row->cosine, (float)row->exponent);
        kind = SWEEP_SCHLICK;
    } else {
        value = family_value(row);
    }
    const sweep_bound *bound = sweep_find_bound(kind, row->order);
    if (CHECK(bound != NULL, "no bound for %s:%d", row->lobe, row->order)) {
        sweep_compare(&results[bound - sweep_bounds], value, row->value);
    }
}

static void check_reference(void) {
    static sweep_result results[SWEEP_BOUND_COUNT];
    char line[256];
    int rows = 0;
    FILE *file = fopen(TEST_DATA_DIR "/lobes.csv", "r");
    if (!CHECK(file != NULL, "can't open %s", TEST_DATA_DIR "/lobes.csv")) {
        return;
    }
    CHECK(fgets(line, sizeof line, file) && !strncmp(line, "lobe,order,fit,", 15), "header");
    while (fgets(line, sizeof line, file)) {
        reference row;
        if (CHECK(parse(line, &row), "line %d", rows + 2)) {
            check_row(&row, results);
        }
        ++rows;
    }
    fclose(file);
    CHECK(rows == 400, "%d rows", rows);

    printf("%d reference values; largest error: absolute in 2^-24, relative in ulp\n", rows);
    for (int i = 0; i < SWEEP_BOUND_COUNT; ++i) {
        if (results[i].compared > 0) {
            CHECK(sweep_keeps(&sweep_bounds[i], &results[i]), "bound %d", i);
            printf("\n");
        }
    }
}

/* ---- Accuracy for any exponent ---- */

/* The bounds of lobe.h at random exponents, fits and cosines where the lobe is not 0. */
static void check_accuracy(void) {
    static const burnish_lobe_fit fits[] = {BURNISH_FIT_TAYLOR, BURNISH_FIT_ENERGY,
                                            BURNISH_FIT_SHIFT7, BURNISH_FIT_SHIFT3};
    uint64_t state = test_seed(1);
    for (int i = 0; i < SWEEP_BOUND_COUNT; ++i) {
        const sweep_bound *bound = &sweep_bounds[i];
        sweep_result result = {0};
        double lowest = bound->kind == SWEEP_FAMILY && bound->order > 2 ? bound->order : 1;
        for (int k = 0; k < 2000; ++k) {
            sweep_case c = {"", bound->kind, fits[k % (bound->order == 2 ? 4 : 2)], bound->order,
                            (float)(lowest * pow(65536 / lowest, test_uniform(&state, 0, 1)))};
            sweep_lobe lobe;
            double width;
            if (c.kind == SWEEP_COMPOSITE && (c.order < 5 || k % 2)) {
                c.fit = NO_FIT;
            }
            CHECK(sweep_make(&c, &lobe, &width), "%g", (double)c.exponent);
            for (int j = 0; j < 300; ++j) {
                double lambda =
                    j & 1 ? test_uniform(&state, 0, 1) : pow(test_uniform(&state, 0, 1), 6);
                float x = (float)(1 - width * lambda);
                sweep_compare(&result, sweep_value(&c, &lobe, x),
                              sweep_exact(&c, &lobe, (double)x));
            }
        }
        printf("%s, order %d, any exponent:",
               bound->kind == SWEEP_FAMILY      ? "family"
               : bound->kind == SWEEP_COMPOSITE ? "composite"
               : bound->kind == SWEEP_SCHLICK   ? "schlick"
                                                : "gx",
               bound->order);
        CHECK(sweep_keeps(bound, &result), "bound %d", i);
        printf("\n");
    }
}

/* ---- Making lobes ---- */

static int is_dark(burnish_lobe lobe) {
    return lobe.zeta == 0 && lobe.order == 0 && burnish_lobe_at_cosine(lobe, 1) == 0 &&
           burnish_lobe_at_cosine(lobe, 2) == 0 && burnish_lobe_at_cosine(lobe, INFINITY) == 0 &&
           burnish_lobe_at_lambda(lobe, 0) == 0 && burnish_lobe_at_lambda(lobe, -INFINITY) == 0 &&
           burnish_lobe_at_cosine(lobe, NAN) == 0 && burnish_lobe_cutoff_cosine(lobe) == 1;
}

/* burnish_lobe_create refuses with a dark lobe, as test_theory.c shows of burnish_lobe_solve. */
static void check_refused(burnish_lobe_fit fit, int order, float exponent,
                          burnish_lobe_status expected) {
    burnish_lobe lobe = {7, 7};
    burnish_lobe_status status = burnish_lobe_create(&lobe, fit, order, exponent);
    CHECK(status == expected && is_dark(lobe), "fit %d order %d exponent %g: %s", (int)fit, order,
          (double)exponent, burnish_lobe_status_text(status));
}

static void check_errors(void) {
    static const float bad_exponents[] = {0,           -0.0f,     -1,       0.999999940f,
                                          65536.0078f, FLT_MAX,   -FLT_MAX, FLT_MIN,
                                          INFINITY,    -INFINITY, NAN,      -NAN};
    static const int bad_orders[] = {0, 1, 3, 5, 6, 7, 12, 24, 31, 33, 64, -2, -32, 2147483647};
    static const burnish_lobe_fit plain[] = {BURNISH_FIT_TAYLOR, BURNISH_FIT_ENERGY};
    static const burnish_lobe_fit shifts[] = {BURNISH_FIT_SHIFT7, BURNISH_FIT_SHIFT3};
    for (int f = 0; f < 2; ++f) {
        for (size_t i = 0; i < sizeof bad_exponents / sizeof bad_exponents[0]; ++i) {
            for (int order = 2; order <= 32; order *= 2) {
                check_refused(plain[f], order, bad_exponents[i], BURNISH_LOBE_ERROR_EXPONENT);
            }
            check_refused(shifts[f], 2, bad_exponents[i], BURNISH_LOBE_ERROR_EXPONENT);
        }
        for (size_t i = 0; i < sizeof bad_orders / sizeof bad_orders[0]; ++i) {
            check_refused(plain[f], bad_orders[i], 100, BURNISH_LOBE_ERROR_ORDER);
            check_refused(shifts[f], bad_orders[i], 100, BURNISH_LOBE_ERROR_ORDER);
        }
        for (int order = 4; order <= 32; order *= 2) {
            check_refused(shifts[f], order, 100, BURNISH_LOBE_ERROR_ORDER);
            check_refused(plain[f], order, nextafterf((float)order, 0),
                          BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT);
            burnish_lobe lobe;
            CHECK1(burnish_lobe_create(&lobe, plain[f], order, (float)order) == BURNISH_LOBE_OK);
            CHECK1(lobe.zeta == 1 && lobe.order == order);
        }
    }
    check_refused(BURNISH_FIT_COUNT, 2, 10, BURNISH_LOBE_ERROR_FIT);
    check_refused((burnish_lobe_fit)99, 2, 10, BURNISH_LOBE_ERROR_FIT);
    check_refused((burnish_lobe_fit)-1, 2, 10, BURNISH_LOBE_ERROR_FIT);

    burnish_lobe lobe = {7, 7};
    CHECK1(burnish_lobe_create(&lobe, BURNISH_FIT_LEVEL, 2, 10) ==
           BURNISH_LOBE_ERROR_FIT_NEEDS_SOLVE);
    CHECK1(is_dark(lobe));
    lobe.order = 7;
    CHECK1(burnish_lobe_create(&lobe, BURNISH_FIT_PROJECTED, 2, 10) ==
           BURNISH_LOBE_ERROR_FIT_NEEDS_SOLVE);
    CHECK1(is_dark(lobe));
}

static void check_from_zeta(void) {
    static const float bad[] = {0,        -0.0f,     -1,  65536.0078f, FLT_MAX,
                                INFINITY, -INFINITY, NAN, -NAN,        -FLT_MIN};
    burnish_lobe lobe;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        lobe.zeta = 7, lobe.order = 7;
        CHECK(burnish_lobe_from_zeta(&lobe, bad[i], 2) == BURNISH_LOBE_ERROR_ZETA && is_dark(lobe),
              "%g", (double)bad[i]);
    }
    lobe.zeta = 7, lobe.order = 7;
    CHECK1(burnish_lobe_from_zeta(&lobe, 4, 3) == BURNISH_LOBE_ERROR_ORDER && is_dark(lobe));
    CHECK1(burnish_lobe_from_zeta(&lobe, 65536, 32) == BURNISH_LOBE_OK);
    CHECK1(burnish_lobe_from_zeta(&lobe, 0x1p-149f, 2) == BURNISH_LOBE_OK);
    CHECK1(burnish_lobe_at_cosine(lobe, -1) == 1);
}

static void check_orders(void) {
    CHECK1(burnish_lobe_highest_order(32, 100) == 32);
    CHECK1(burnish_lobe_highest_order(32, 32) == 32);
    CHECK1(burnish_lobe_highest_order(32, 31.5f) == 16);
    CHECK1(burnish_lobe_highest_order(32, 5) == 4);
    CHECK1(burnish_lobe_highest_order(8, 1) == 2);
    CHECK1(burnish_lobe_highest_order(2, 100) == 2);
    CHECK1(burnish_lobe_highest_order(4, 0.5f) == 0);
    CHECK1(burnish_lobe_highest_order(4, NAN) == 0);
    CHECK1(burnish_lobe_highest_order(4, 65537) == 0);
    CHECK1(burnish_lobe_highest_order(6, 100) == 0);
    CHECK1(burnish_lobe_highest_order(0, 100) == 0);
}

static void check_status_texts(void) {
    CHECK_TEXT(burnish_lobe_status_text((burnish_lobe_status)0), "success");
    for (int i = 0; i < BURNISH_LOBE_STATUS_COUNT; ++i) {
        const char *text = burnish_lobe_status_text((burnish_lobe_status)i);
        CHECK(strlen(text) > 0 && strcmp(text, "unknown status") != 0, "status %d", i);
        for (int k = 0; k < i; ++k) {
            CHECK(strcmp(text, burnish_lobe_status_text((burnish_lobe_status)k)) != 0, "%s", text);
        }
    }
    CHECK_TEXT(burnish_lobe_status_text(BURNISH_LOBE_STATUS_COUNT), "unknown status");
    CHECK_TEXT(burnish_lobe_status_text((burnish_lobe_status)1000), "unknown status");
}

/* ---- Evaluating lobes ---- */

static burnish_lobe make(burnish_lobe_fit fit, int order, float exponent) {
    burnish_lobe lobe;
    CHECK(burnish_lobe_create(&lobe, fit, order, exponent) == BURNISH_LOBE_OK, "%d:%d %g", (int)fit,
          order, (double)exponent);
    return lobe;
}

static void check_special_floats(void) {
    static const burnish_lobe_fit fits[] = {BURNISH_FIT_TAYLOR, BURNISH_FIT_ENERGY};
    for (int order = 2; order <= 32; order *= 2) {
        for (int i = 0; i < 2; ++i) {
            burnish_lobe lobe = make(fits[i], order, 40);
            CHECK1(burnish_lobe_at_cosine(lobe, NAN) == 0 &&
                   burnish_lobe_at_lambda(lobe, NAN) == 0);
            CHECK1(burnish_lobe_at_cosine(lobe, -NAN) == 0);
            CHECK1(burnish_lobe_at_cosine(lobe, INFINITY) == 1);
            CHECK1(burnish_lobe_at_cosine(lobe, -INFINITY) == 0);
            CHECK1(burnish_lobe_at_lambda(lobe, INFINITY) == 0);
            CHECK1(burnish_lobe_at_lambda(lobe, -INFINITY) == 1);
            CHECK1(burnish_lobe_at_lambda(lobe, -1) == 1 &&
                   burnish_lobe_at_lambda(lobe, -0.0f) == 1);
            CHECK1(burnish_lobe_at_lambda(lobe, 0x1p-149f) == 1);
            CHECK1(burnish_lobe_at_cosine(lobe, FLT_MAX) == 1);
            CHECK1(burnish_lobe_at_cosine(lobe, -FLT_MAX) == 0);
            CHECK1(burnish_lobe_at_cosine(lobe, 0x1p-149f) == burnish_lobe_at_cosine(lobe, 0));
            CHECK1(burnish_lobe_at_cosine(lobe, -0.0f) == burnish_lobe_at_cosine(lobe, 0));
            CHECK1(burnish_lobe_at_cosine(lobe, 1) == 1);
            CHECK1(burnish_lobe_at_cosine(lobe, nextafterf(1, 2)) == 1);
        }
    }
    for (int i = 0; i < 2; ++i) {
        float (*lobe)(float, float) = i ? burnish_schlick_at_cosine : burnish_gx_at_cosine;
        CHECK1(lobe(NAN, 10) == 0 && lobe(0.5f, NAN) == 0 && lobe(NAN, NAN) == 0);
        CHECK1(lobe(1, 10) == 1 && lobe(INFINITY, 10) == 1 && lobe(1.5f, 10) == 1);
        CHECK1(lobe(0, 10) == 0 && lobe(-0.0f, 10) == 0 && lobe(-1, 10) == 0);
        CHECK1(lobe(-INFINITY, 10) == 0);
        CHECK1(lobe(0.9f, INFINITY) == lobe(0.9f, 65536) && lobe(0.9f, 0) == lobe(0.9f, 1));
        CHECK1(lobe(0.9f, 65537) == lobe(0.9f, 65536) && lobe(0.9f, 65535) > lobe(0.9f, 65536));
        CHECK1(lobe(0.9f, 0.99f) == lobe(0.9f, 1) && lobe(0.9f, 1.01f) < lobe(0.9f, 1));
        CHECK1(lobe(0.9f, -INFINITY) == lobe(0.9f, 1) && lobe(1, INFINITY) == 1);
    }
}

/* The lobe ends at the cutoff cosine, give or take a rounding. */
static void check_cutoff(void) {
    for (int order = 2; order <= 32; order *= 2) {
        for (float n = (float)order; n <= 65536; n *= 1.37f) {
            burnish_lobe lobe = make(BURNISH_FIT_ENERGY, order, n);
            float cutoff = burnish_lobe_cutoff_cosine(lobe);
            double exact = 1 - 1 / (double)lobe.zeta;
            CHECK(fabs((double)cutoff - exact) <= 0x1p-24, "%d %g", order, (double)n);
            CHECK(burnish_lobe_at_lambda(lobe, (float)(1 / (double)lobe.zeta) * 1.0000003f) == 0,
                  "%d %g", order, (double)n);
            CHECK(burnish_lobe_at_cosine(lobe, cutoff - 0x1p-23f) == 0, "%d %g", order, (double)n);
            CHECK(burnish_lobe_at_cosine(lobe, 0.5f + 0.5f * cutoff) > 0, "%d %g", order,
                  (double)n);
        }
    }
    burnish_lobe wide;
    CHECK1(burnish_lobe_from_zeta(&wide, 0.25f, 2) == BURNISH_LOBE_OK);
    CHECK1(burnish_lobe_cutoff_cosine(wide) == -3 && burnish_lobe_at_cosine(wide, -1) == 0.25f);
}

/* ---- Composite lobes ---- */

static int is_dark_composite(burnish_composite lobe) {
    return lobe.multiplications == 0 && burnish_composite_at_cosine(lobe, 1) == 0 &&
           burnish_composite_at_lambda(lobe, -INFINITY) == 0 &&
           burnish_composite_at_lambda(lobe, INFINITY) == 0 &&
           burnish_composite_at_cosine(lobe, NAN) == 0 &&
           burnish_composite_cutoff_cosine(lobe) == 1;
}

static void check_composite_errors(void) {
    static const struct {
        int aim, multiplications;
        float exponent;
        burnish_lobe_status status;
    } bad[] = {
        {-1, 5, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {2, 5, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {0, 1, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {0, 7, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {1, 4, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {1, 7, 10, BURNISH_LOBE_ERROR_COMPOSITE},
        {0, 5, NAN, BURNISH_LOBE_ERROR_EXPONENT},
        {0, 5, 0.9999f, BURNISH_LOBE_ERROR_EXPONENT},
        {1, 5, 65536.008f, BURNISH_LOBE_ERROR_EXPONENT},
        {1, 6, INFINITY, BURNISH_LOBE_ERROR_EXPONENT},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        burnish_composite lobe = {7, 7, {7, 7, 7, 7}, 7};
        double zeta = 7, b[4] = {7, 7, 7, 7};
        burnish_composite_aim aim = (burnish_composite_aim)bad[i].aim;
        burnish_lobe_status status =
            burnish_composite_create(&lobe, aim, bad[i].multiplications, bad[i].exponent);
        CHECK(status == bad[i].status && is_dark_composite(lobe), "row %d", (int)i);
        CHECK(burnish_composite_constants(aim, bad[i].multiplications, (double)bad[i].exponent,
                                          &zeta, b) == 0 &&
                  zeta == 0 && b[0] == 0 && b[3] == 0,
              "row %d", (int)i);
    }
}

/* The peak is 1 where rounding makes that hard: with one step, whose b is tiny. */
static void check_composite_peaks(void) {
    burnish_composite lobe;
    int missed = 0;
    for (float n = 4.01f; n < 4.02f; n = nextafterf(n, 5)) {
        (void)burnish_composite_create(&lobe, BURNISH_COMPOSITE_MINIMAX, 4, n);
        missed += burnish_composite_at_lambda(lobe, 0) != 1;
    }
    CHECK(missed == 0, "%d peaks are not 1", missed);
}

/* Whole powers of two are exact, with the multiplications of their product. */
static void check_composite_products(void) {
    for (int m = 2; m <= 6; ++m) {
        for (int n = 2, least = 2; least <= m; n *= 2, ++least) {
            burnish_composite lobe;
            CHECK1(burnish_composite_create(&lobe, BURNISH_COMPOSITE_MINIMAX, m, (float)n) ==
                   BURNISH_LOBE_OK);
            CHECK(lobe.multiplications == least && lobe.top == 1 && lobe.slope == 1 &&
                      lobe.offset[0] == 0,
                  "%d %d", m, n);
            CHECK1(burnish_composite_at_cosine(lobe, 0.5f) == 1 / powf(2, (float)n));
        }
    }
}

static double composite_value(double zeta, const double b[4], int multiplications, double lambda) {
    const double u = fmax(0, 1 - zeta * lambda);
    double w = u * u;
    for (int k = 0; k < multiplications - 2; ++k) {
        w *= (w + b[k]) / (1 + b[k]);
    }
    return w;
}

/* The float lobe is the formula with the constants that burnish_composite_constants states, and
 * ends where they say. */
static void check_composite_constants(void) {
    double worst = 0;
    for (int m = 2; m <= 6; ++m) {
        for (float n = 1; n <= 65536; n *= 1.37f) {
            burnish_composite lobe;
            double zeta, b[4];
            const burnish_composite_aim aim = BURNISH_COMPOSITE_MINIMAX;
            CHECK1(burnish_composite_create(&lobe, aim, m, n) == BURNISH_LOBE_OK);
            const int used = burnish_composite_constants(aim, m, (double)n, &zeta, b);
            CHECK(used == lobe.multiplications && used <= m && zeta >= 1, "%d %g", m, (double)n);
            for (int i = 0; i <= 100; ++i) {
                const float lambda = (float)(i / zeta / 100);
                const double w = composite_value(zeta, b, used, (double)lambda);
                worst = fmax(worst, fabs(w - (double)burnish_composite_at_lambda(lobe, lambda)));
            }
            const float cutoff = burnish_composite_cutoff_cosine(lobe);
            CHECK(fabs((double)cutoff - (1 - 1 / zeta)) <= 0x1p-23 &&
                      burnish_composite_at_cosine(lobe, cutoff - 0x1p-22f) == 0 &&
                      burnish_composite_at_cosine(lobe, 0.5f + 0.5f * cutoff) > 0,
                  "%d %g", m, (double)n);
        }
    }
    printf("composites: from the formula at most %.2g\n", worst);
    CHECK1(worst > 0 && worst < 1.5e-6);
}

/* How far composites are from cos^n at exponents between those of their table. */
static void check_composite_accuracy(void) {
    static const double ends[] = {2, 4, 8, 19.5, 56, 65536};
    static const double bounds[][5] = {{0.038, 0.0558, 0.0648, 0.0686, 0.0706},
                                       {0.0057, 0.0137, 0.0236, 0.0274, 0.0301},
                                       {0.0057, 8.6e-4, 6.4e-4, 0.0032, 0.0053},
                                       {0.0057, 8.6e-4, 3.4e-5, 7.1e-5, 1.47e-4},
                                       {0.0057, 8.6e-4, 3.4e-5, 1.8e-6, 2.1e-6}};
    for (int i = 0; i < 25; ++i) {
        const int m = 2 + i / 5;
        double worst = 0;
        for (double f = 1e-9; f < 1; f += 0.00625 - 1e-11) {
            const double n = 1 / (f / ends[i % 5] + (1 - f) / ends[i % 5 + 1]);
            double zeta, b[4];
            const int used = burnish_composite_constants(BURNISH_COMPOSITE_MINIMAX, m, n, &zeta, b);
            for (double x = 0; x < 22 && x <= n; x += 0.005) {
                worst = fmax(worst, fabs(composite_value(zeta, b, used, x / n) -
                                         exp(n * log1p(-fmin(x / n, 1 - 1e-15)))));
            }
        }
        printf("composite:%d from %g to %g: %.3g\n", m, ends[i % 5], ends[i % 5 + 1], worst);
        CHECK(worst <= bounds[m - 2][i % 5] && worst > 0.9 * bounds[m - 2][i % 5], "%d %d %g", m,
              i % 5, worst);
    }
}

/* An animated exponent: no visible jumps but at 4 and 8. */
static void check_composite_jumps(void) {
    const double most[3] = {0.0034, 8.7e-4, 3.3e-4};
    double worst[3] = {0, 0, 0};
    for (int i = 0; i < 2 * 5 * 130; ++i) { /* multiples of 1/2 up to 65, and 180 */
        const float n = i % 130 == 129 ? 180 : 2 + 0.5f * (float)(i % 130);
        burnish_composite lobes[3];
        int status = 0;
        for (int k = 0; k < 3; ++k) {
            status += (int)burnish_composite_create(
                &lobes[k], (burnish_composite_aim)(i / 650), 2 + i / 130 % 5,
                k == 1 ? n : nextafterf(n, k == 0 ? 0.0f : 1e9f));
        }
        double *jump = &worst[n > 8 ? 2 : n == 8 ? 1 : 0];
        for (double c = 0; c < 1 && status == 0; c += 1 / 1024.0) {
            const double at = (double)burnish_composite_at_cosine(lobes[1], (float)c);
            for (int k = 0; k < 3; k += 2) {
                *jump =
                    fmax(*jump, fabs(at - (double)burnish_composite_at_cosine(lobes[k], (float)c)));
            }
        }
    }
    for (int i = 0; i < 3; ++i) {
        CHECK(worst[i] < most[i] && worst[i] > 0.6 * most[i], "%d %g", i, worst[i]);
    }
}

static void check_chord(void) {
    static const float x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, opposite[3] = {-1, 0, 0};
    static const float not_number[3] = {NAN, 0, 0}, endless[3] = {INFINITY, 0, 0};
    CHECK1(burnish_lobe_chord(x, x) == 0 && burnish_lobe_chord(x, y) == 1);
    CHECK1(burnish_lobe_chord(x, opposite) == 2);
    CHECK1(isnan(burnish_lobe_chord(x, not_number)));
    CHECK1(burnish_lobe_chord(x, endless) == INFINITY);

    /* The chord keeps what the cosine loses: two directions 2^-14 apart, exponent 65536. */
    const float a[3] = {0, 0x1p-14f, 1}, b[3] = {0, 0, 1};
    burnish_lobe lobe = make(BURNISH_FIT_TAYLOR, 2, 65536);
    CHECK1(burnish_lobe_chord(a, b) == 0x1p-29f);
    CHECK1(burnish_lobe_at_lambda(lobe, burnish_lobe_chord(a, b)) ==
           (1 - 0x1p-14f) * (1 - 0x1p-14f));
    CHECK1(burnish_lobe_at_cosine(lobe, a[1] * b[1] + a[2] * b[2]) == 1);
}

static void check_lyon_factor(void) {
    double near = 0, far = 0;
    for (int i = 0; i <= 100000; ++i) {
        double s = 0.5 + i * 1e-5;
        double error = fabs((double)burnish_lyon_normalize_factor((float)s) * sqrt(s) - 1);
        far = fmax(far, error);
        near = s >= 0.9 && s <= 1.1 ? fmax(near, error) : near;
    }
    printf("lyon's normalisation: relative error %.5f for s in [.9, 1.1], %.4f in [.5, 1.5]\n",
           near, far);
    CHECK1(near > 0 && near < 0.0004 && far < 0.05);
    CHECK1(burnish_lyon_normalize_factor(1) == 1);
    CHECK1(burnish_lyon_normalize_factor(0) == 1.875f);
    for (float s = 0; s < 8; s += 0x1p-10f) {
        CHECK(burnish_lyon_normalize_factor(s) >= 5 / 6.0f - 0x1p-22f, "%g", (double)s);
    }
}

/* A unit vector at an angle from +Z, in a random plane, then made a little too long or short. */
static void tilt(uint64_t *state, double angle, double scale, float out[3]) {
    double around = 6.283185307179586 * test_uniform(state, 0, 1);
    out[0] = (float)(scale * sin(angle) * cos(around));
    out[1] = (float)(scale * sin(angle) * sin(around));
    out[2] = (float)(scale * cos(angle));
}

/* Lyon's lobe is the taylor fit: the same bits from the chord, nearly the same from vectors whose
 * squared lengths are off by up to 10 %. */
static void check_lyon(void) {
    uint64_t state = test_seed(5);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        int order = 2 << i % 5;
        float n = (float)(order + 200 * test_uniform(&state, 0, 1));
        float a[3], b[3], zenith[3] = {0, 0, 1};
        double angle = 0.3 * test_uniform(&state, 0, 1);
        tilt(&state, angle, 1, a);
        burnish_lobe lobe = make(BURNISH_FIT_TAYLOR, order, n);
        CHECK(burnish_lyon_at_chord(a, zenith, n, order) ==
                  burnish_lobe_at_lambda(lobe, burnish_lobe_chord(a, zenith)),
              "%d %g", order, (double)n);
        CHECK(burnish_lyon_at_vectors(a, a, n, order) == 1, "%d %g", order, (double)n);
        tilt(&state, angle, 0.95 + 0.098 * test_uniform(&state, 0, 1), a);
        tilt(&state, 0, 0.95 + 0.098 * test_uniform(&state, 0, 1), b);
        double exact = burnish_theory_family((double)lobe.zeta, order, cos(angle));
        worst = fmax(worst, fabs((double)burnish_lyon_at_vectors(a, b, n, order) - exact));
    }
    printf("lyon from vectors 5 %% off unit length: largest error %.2g\n", worst);
    CHECK1(worst > 0 && worst < 5e-4);

    static const float x[3] = {1, 0, 0}, bad[3] = {NAN, INFINITY, -INFINITY};
    CHECK1(burnish_lyon_at_vectors(x, x, 10, 3) == 0 && burnish_lyon_at_chord(x, x, 10, 0) == 0);
    CHECK1(burnish_lyon_at_vectors(x, x, NAN, 2) == 0 && burnish_lyon_at_chord(x, x, NAN, 2) == 0);
    CHECK1(burnish_lyon_at_vectors(x, x, 3, 4) == 0);
    CHECK1(burnish_lyon_at_vectors(x, x, 0, 2) == 1 &&
           burnish_lyon_at_vectors(x, x, 1e9f, 32) == 1);
    for (int i = 0; i < 3; ++i) {
        float v[3] = {0, 0, 1};
        v[i] = bad[i];
        CHECK1(burnish_lyon_at_vectors(v, x, 10, 2) == 0 &&
               burnish_lyon_at_chord(x, v, 10, 2) == 0);
    }
}

static void check_sweeps(void) {
    for (int i = 0; i < SWEEP_CASE_COUNT; ++i) {
        sweep_result result = {0};
        sweep_run(&sweep_cases[i], 4099, &result);
        CHECK(sweep_report(&sweep_cases[i], &result), "%s", sweep_cases[i].name);
    }
}

static void check_exp_falloffs(void) {
    for (int i = 0; i < FALLOFF_CASE_COUNT; ++i) {
        const falloff_case *at = &falloff_cases[i];
        CHECK(falloff_keeps(at, 997), "%d", i);
        CHECK1(at->of(0) == 1 && at->of(-0.0f) == 1 && at->of(-1) == 1 && at->of(-INFINITY) == 1);
        CHECK1(at->of(nextafterf(at->end, 0)) > 0 && at->of(at->end) == 0);
        CHECK1(at->of(INFINITY) == 0 && at->of(FLT_MAX) == 0);
        CHECK1(at->of(NAN) == 0 && at->of(-NAN) == 0);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_reference());
    RUN(check_accuracy());
    RUN(check_errors());
    RUN(check_from_zeta());
    RUN(check_orders());
    RUN(check_status_texts());
    RUN(check_special_floats());
    RUN(check_cutoff());
    RUN(check_composite_errors());
    RUN(check_composite_products());
    RUN(check_composite_peaks());
    RUN(check_composite_constants());
    RUN(check_composite_accuracy());
    RUN(check_composite_jumps());
    RUN(check_chord());
    RUN(check_lyon_factor());
    RUN(check_lyon());
    RUN(check_sweeps());
    RUN(check_exp_falloffs());
    return test_end("lobe");
}
