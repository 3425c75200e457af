/* burnish/theory.h: composite lobes against their definition in long double and Gauss's rule,
 * and the constants of the limit n -> infinity: equal ripple, and no better ones near them. */
#include <math.h>
#include <stdlib.h>

#include "burnish/theory.h"
#include "support.h"

typedef long double real;

static const double HALF_PI = 1.57079632679489661923;
static uint64_t random_state;

/* The definition. */
static real composite(real zeta, const double *b, int steps, real lambda) {
    real u = fmaxl(0, 1 - zeta * lambda), w = u * u;
    for (int i = 0; i < steps; ++i) {
        w = w * (w + b[i]) / (1 + (real)b[i]);
    }
    return w;
}

static burnish_theory_model random_model(double least_zeta) {
    burnish_theory_model model;
    double b[4];
    int steps = (int)test_uniform(&random_state, 0, 4.999);
    for (int i = 0; i < steps; ++i) { /* a fifth each: 0, and so large that the step does little */
        double kind = test_uniform(&random_state, 0, 1);
        b[i] = kind < 0.2 ? 0 : exp(test_uniform(&random_state, -6, kind < 0.4 ? 12 : 3));
    }
    double zeta = least_zeta * exp(test_uniform(&random_state, 0, 8));
    double n = zeta * exp(test_uniform(&random_state, 0, 2.5)) + 1;
    CHECK1(burnish_theory_composite_create(&model, fmin(n, 65536), zeta, b, steps) ==
           BURNISH_LOBE_OK);
    return model;
}

static real own_value(const burnish_theory_model *model, real lambda) {
    return composite(model->zeta, model->k, model->steps, lambda);
}

/* ---- Values, widths ---- */

static void check_values(const burnish_theory_model *model) {
    double c[BURNISH_THEORY_DEGREE_MAX + 1], peak = 0;
    int degree = burnish_theory_polynomial(model, c);
    CHECK1(degree == 2 << model->steps);
    for (int j = 0; j <= BURNISH_THEORY_DEGREE_MAX; ++j) {
        peak += c[j];
        CHECK1(c[j] >= 0 && (j <= degree || c[j] == 0));
    }
    CHECK1(fabs(peak - 1) < 1e-14);
    for (int i = 0; i <= 20; ++i) {
        double lambda = i / (19 * model->zeta), d[3], h = 1e-5 / model->zeta;
        real expected = own_value(model, lambda), u = 1 - model->zeta * (real)lambda, sum = 0;
        CHECK1(fabsl(burnish_theory_value_at_lambda(model, lambda) - expected) < 1e-14L);
        for (int j = degree; j >= 0 && u > 0; --j) {
            sum = sum * u + c[j];
        }
        CHECK1(fabsl(sum - expected) < 1e-13L);
        double angle = 2 * asin(sqrt(fmin(lambda / 2, 1)));
        if (i < 1 || i > 18 || lambda > 1.9) {
            continue;
        }
        burnish_theory_derivatives(model, angle, d);
        real before = own_value(model, lambda - (real)h),
             after = own_value(model, lambda + (real)h);
        real first = (after - before) / (2 * h), second = (after - 2 * expected + before) / (h * h);
        real sine = sinl(angle);
        CHECK1(fabsl(d[1] - first * sine) < 1e-6L * model->zeta * sine);
        CHECK1(fabsl(d[2] - second * sine * sine - first * cosl(angle)) <
               1e-5L * (model->zeta * model->zeta * sine * sine + model->zeta));
    }
}

static void check_widths(const burnish_theory_model *model) {
    static const double levels[] = {1e-9, 1e-4, 1.0 / 256, 0.3, 0.5, 0.9, 1 - 1e-9};
    for (size_t i = 0; i < sizeof levels / sizeof *levels && model->zeta >= 1; ++i) {
        double angle = burnish_theory_angle_at(model, levels[i]), s = sin(angle / 2);
        real level = own_value(model, 2 * (real)s * s), rest = 1 - (real)levels[i];
        CHECK(fabsl(level - levels[i]) < 1e-10L * fminl(levels[i], rest) + 2e-18L,
              "level %g: off by %Lg", levels[i], level - levels[i]);
    }
    if (model->zeta >= 1) {
        double foot = 1;
        for (int i = 0; i < model->steps; ++i) {
            foot *= model->k[i] / (1 + model->k[i]);
        }
        double radius = burnish_theory_zero_curvature_radius(model);
        CHECK1(foot == 0 ? isinf(radius) : fabs(radius * foot * (4 * model->zeta - 2) - 1) < 1e-12);
        CHECK1(fabs(burnish_theory_cutoff_cosine(model) - (1 - 1 / model->zeta)) < 1e-15);
    }
}

/* ---- Energy, samples, harmonics ---- */

typedef real weight_function(real c, int degree);

static real no_weight(real c, int degree) {
    (void)c;
    (void)degree;
    return 1;
}

static real power_weight(real c, int degree) {
    return powl(c, degree);
}

static real legendre(real c, int degree) {
    real before = 1, now = c;
    for (int j = 1; j < degree; ++j) {
        real next = ((2 * j + 1) * c * now - j * before) / (j + 1);
        before = now;
        now = next;
    }
    return degree > 0 ? now : 1;
}

/* 2 pi times the integral of lobe and weight over lambda from 0 to the zero or `end`. */
static real gauss(const burnish_theory_model *model, weight_function *weight, int degree,
                  real end) {
    enum { PANELS = 1024 };
    real reach = 2 * asinl(sqrtl(fminl(1 / (real)model->zeta, end) / 2)), sum = 0;
    for (int i = 0; i < 3 * PANELS; ++i) { /* over the angle */
        int k = i % 3 - 1;
        real half = reach / PANELS * (i / 3 + 0.5L + k * sqrtl(0.15L)) / 2;
        real lambda = 2 * sinl(half) * sinl(half);
        sum += (k ? 5 : 8) * own_value(model, lambda) * weight(1 - lambda, degree) * sinl(2 * half);
    }
    return sum * reach / (18 * PANELS) * 4 * HALF_PI;
}

static void check_energy(const burnish_theory_model *model) {
    real solid = gauss(model, no_weight, 0, 1), weighted = gauss(model, power_weight, 1, 1);
    CHECK1(fabsl(burnish_theory_integral(model, 0) / solid - 1) < 1e-12L);
    CHECK1(fabsl(burnish_theory_integral(model, 1) / weighted - 1) < 1e-12L);
    CHECK1(fabsl(burnish_theory_phong_factor(model) * weighted - 1) < 1e-12L);
    for (int degree = 0; degree < 64; degree = 2 * degree + 1) {
        real expected = gauss(model, legendre, degree, 2), whole = gauss(model, no_weight, 0, 2);
        double zonal = burnish_theory_model_zonal(model, degree);
        CHECK(fabsl(zonal - expected) < 1e-11L * whole, "zeta %g, degree %d: %g, not %Lg",
              model->zeta, degree, zonal, expected);
    }
    for (int measure = 0; measure < 2; ++measure) { /* moments of 1 - c in units of the width */
        enum { SAMPLES = 2000 };
        real mean[2] = {0, 0}, expected[2] = {0, 0}, total = measure ? weighted : solid;
        real width = fminl(1 / (real)model->zeta, 1);
        for (int i = 0; i < SAMPLES; ++i) {
            real x =
                (1 - burnish_theory_sample_cosine(model, measure, (i + 0.5) / SAMPLES)) / width;
            mean[0] += x / SAMPLES;
            mean[1] += x * x / SAMPLES;
        }
        /* from the moments of c */
        real m1 = gauss(model, power_weight, measure + 1, 1) / total;
        real m2 = gauss(model, power_weight, measure + 2, 1) / total;
        expected[0] = (1 - m1) / width;
        expected[1] = (1 - 2 * m1 + m2) / (width * width);
        for (int i = 0; i < 2; ++i) { /* c cancels in narrow lobes */
            CHECK(fabsl(mean[i] - expected[i]) < 3e-3L + 1e-15L / powl(width, i + 1),
                  "zeta %g, measure %d, moment %d: %Lg, not %Lg", model->zeta, measure, i + 1,
                  mean[i], expected[i]);
        }
    }
}

/* ---- Errors ---- */

static real own_power(real lambda, real n) {
    return lambda < 1 ? expl(n * log1pl(-lambda)) : 0;
}

/* The certified maxima are at least what a sweep finds, and not much more. */
static void check_errors(const burnish_theory_model *model) {
    burnish_theory_difference difference, core;
    double inflection = burnish_theory_inflection_angle(model->exponent);
    real end = 2 * powl(sinl(inflection / 2), 2), reach = fminl(1, 1 / (real)model->zeta);
    real absolute = 0, relative = 0;
    burnish_theory_compare(model, HALF_PI, &difference);
    burnish_theory_compare(model, inflection, &core);
    for (int i = 0; i <= 20000; ++i) {
        real at = reach * i / 20000, near = end * i / 20000,
             power = own_power(near, model->exponent);
        absolute = fmaxl(absolute, fabsl(own_value(model, at) - own_power(at, model->exponent)));
        relative = fmaxl(relative, power > 0 ? fabsl(own_value(model, near) / power - 1) : 0);
    }
    CHECK(difference.absolute > absolute * (1 - 2e-9L) - 1e-13L &&
              difference.absolute < absolute * (1 + 1e-4L) + 1e-13L,
          "n %g zeta %g: %.12g, not %.12Lg", model->exponent, model->zeta, difference.absolute,
          absolute);
    CHECK(core.relative > relative * (1 - 2e-9L) - 1e-9L &&
              core.relative < relative * (1 + 1e-4L) + 1e-9L,
          "n %g zeta %g: relative %.12g, not %.12Lg", model->exponent, model->zeta, core.relative,
          relative);
    CHECK1(burnish_theory_maximum_error(model, HALF_PI) == difference.absolute);
}

static void check_bad_input(void) {
    static const double bad[][2] = {{-1, 1}, {NAN, 1}, {HUGE_VAL, 1}, {1, 0}, {1, NAN}, {1, 7e4}};
    burnish_theory_model model = {.steps = 7};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK1(burnish_theory_composite_create(&model, 10, bad[i][1], bad[i], 1) !=
               BURNISH_LOBE_OK);
    }
    CHECK1(burnish_theory_composite_create(&model, 10, 2, NULL, 0) == BURNISH_LOBE_OK);
    CHECK1(burnish_theory_composite_create(&model, 0.5, 2, NULL, 0) == BURNISH_LOBE_ERROR_EXPONENT);
    CHECK1(burnish_theory_composite_create(&model, 10, 2, NULL, 5) ==
               BURNISH_LOBE_ERROR_COMPOSITE &&
           model.steps == 0);
    CHECK1(!burnish_theory_model_parse("schlick", 10, &model, NULL));
    CHECK1(isnan(burnish_theory_model_zonal(&model, 3)));
}

/* ---- The limit n -> infinity ---- */

/* zeta/n and b of the least error against e^-x, by Newton's method, as in docs/theory.md. */
static const struct limit {
    int steps, extremes;
    double zeta, b[4], error;
} LIMITS[] = {
    {0, 2, 0.355859264140901, {0}, 0.0699443102296388},
    {1, 2, 0.240635655155523, {0.26877327518418}, 0.0293732302470203},
    {2, 2, 0.167233070010354, {0.354818158514469, 0.492170304995857}, 0.00517263794780708},
    {3,
     4,
     0.108093534048636,
     {0.413317305974773, 1.54784362846574, 0.060389895450679},
     0.000135170648759215},
    {4,
     6,
     0.0699998759304894,
     {0.974004058158566, 2.89367778491539, 0.124471545365681, 0.00339013332163065},
     9.9979368449544e-7},
};

/* The largest error against e^-x; counts local extremes of nearly that size. */
static real limit_error(const struct limit *l, const double *b, real zeta, int *extremes) {
    enum { POINTS = 4000 };
    static real e[POINTS + 1];
    real most = 0;
    for (int i = 0; i <= POINTS; ++i) {
        real x = 20 * powl((real)i / POINTS, 2);
        e[i] = fabsl(composite(zeta, b, l->steps, x) - expl(-x));
        most = fmaxl(most, e[i]);
    }
    for (int i = 1; i < POINTS && extremes; ++i) {
        *extremes += e[i] >= e[i - 1] && e[i] > e[i + 1] && e[i] > 0.999L * most;
    }
    return most;
}

static void check_limits(void) {
    for (size_t k = 0; k < sizeof LIMITS / sizeof *LIMITS; ++k) {
        const struct limit *l = &LIMITS[k];
        int extremes = 0;
        real error = limit_error(l, l->b, l->zeta, &extremes);
        CHECK(fabsl(error / l->error - 1) < 3e-5L && extremes == l->extremes, "%d: %.9Lg, %d",
              l->steps + 2, error, extremes);
        for (int i = 0; i < 600; ++i) { /* none near them is better */
            double b[4] = {0}, size = pow(10, test_uniform(&random_state, -5, -1));
            for (int j = 0; j < l->steps; ++j) {
                b[j] = l->b[j] * (1 + size * test_uniform(&random_state, -1, 1));
            }
            real zeta = l->zeta * (1 + 0.1L * size * test_uniform(&random_state, -1, 1));
            CHECK1(limit_error(l, b, zeta, NULL) > l->error * (1 - 3e-5L));
        }
        if (k > 0) { /* faster than geometrically */
            CHECK1(k < 2 || l->error / l[-1].error < 0.5 * l[-1].error / l[-2].error);
        }
        burnish_theory_model model;
        CHECK1(!burnish_theory_composite_create(&model, 65536, 65536 * l->zeta, l->b, l->steps));
        CHECK1(fabs(burnish_theory_maximum_error(&model, HALF_PI) - l->error) < 5e-6);
    }
}

/* The formulas of lobe.h against the least errors that a search finds. */
static void check_formulas(void) {
    static const struct {
        int n, multiplications;
        double least, factor;
    } rows[] = {{10, 3, .0165453280284538, 1.02},    {10, 4, 8.51278160041861e-5, 1.6},
                {10, 5, 6.06720412078718e-6, 2.3},   {24, 4, .00102566793019903, 1.2},
                {24, 5, 1.9262609965018e-5, 1.1},    {64, 3, .0274101638801832, 1.02},
                {64, 4, .00328997035828222, 1.05},   {64, 5, 1.73718294165111e-5, 1.2},
                {256, 4, .0046953503653519, 1.05},   {256, 5, 9.17590384254199e-5, 1.15},
                {1024, 4, .00505308350630583, 1.05}, {1024, 5, .000123889637536452, 1.1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        const burnish_lobe_spec lobe = {.kind = BURNISH_LOBE_COMPOSITE,
                                        .order = rows[i].multiplications};
        burnish_theory_model model;
        CHECK1(!burnish_theory_model_create(&model, &lobe, rows[i].n));
        double ratio = burnish_theory_maximum_error(&model, HALF_PI) / rows[i].least;
        CHECK(ratio > 1 - 1e-8 && ratio < rows[i].factor, "n %d, composite:%d: %g of the least",
              rows[i].n, rows[i].multiplications, ratio);
    }
}

/* Lambert's W: y with y e^y = x, -1/e <= x < 0; branch 0 or -1. */
static real lambert(real x, int branch) {
    real y = branch == 0 ? 0 : logl(-x) - 1;
    for (int i = 0; i < 200; ++i) {
        real f = y * expl(y) - x;
        y -= f / (expl(y) * (y + 1) - (y + 2) * f / (2 * y + 2));
    }
    return y;
}

/* Both places of equal slope of (1 - z x)^m and e^-x, and the errors there. */
static void check_lambert(void) {
    for (int m = 2; m <= 32; m *= 2) {
        burnish_theory_model model;
        CHECK1(!burnish_theory_model_create(
            &model, &(burnish_lobe_spec){.fit = BURNISH_FIT_MINIMAX, .order = m}, 65536));
        real z = model.zeta / 65536, q = 1.0L / (m - 1), error[2];
        for (int branch = 0; branch < 2; ++branch) {
            real w = lambert(-q / z * powl(m * z, -q) * expl(-q / z), -branch);
            real x = 1 / z + (m - 1) * w;
            error[branch] = powl(1 - z * x, m) - expl(-x);
        }
        CHECK(fabsl(error[0] + error[1]) < 1e-5L, "order %d: %Lg, %Lg", m, error[0], error[1]);
        CHECK1(fabsl(fabsl(error[0]) - burnish_theory_maximum_error(&model, HALF_PI)) < 1e-5L);
    }
}

static void check_models(void) {
    for (int i = 0; i < 60; ++i) {
        burnish_theory_model model = random_model(i % 4 ? 1 : 0.3);
        check_values(&model);
        check_widths(&model);
        check_energy(&model);
        check_errors(&model);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    random_state = test_seed(0);
    RUN(check_models());
    RUN(check_bad_input());
    RUN(check_limits());
    RUN(check_formulas());
    RUN(check_lambert());
    return test_end("theory_composites");
}
