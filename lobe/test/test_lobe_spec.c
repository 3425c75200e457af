/* burnish/lobe_spec.h: lobe words there and back, and the searched fits against an independent
 * evaluation in long double. */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

/* ---- Words ---- */

static void check_words(void) {
    static const char *const GOOD[] = {"taylor:2",
                                       "energy:32",
                                       "level0.5:4",
                                       "level0.25:2",
                                       "shift7:2",
                                       "shift3:2",
                                       "projected:8",
                                       "minimax:16",
                                       "affine:4",
                                       "leastsquares:32",
                                       "zeta4:2",
                                       "zeta6.645:2",
                                       "power",
                                       "schlick",
                                       "lyon:4",
                                       "gaussian",
                                       "gx",
                                       "composite:2",
                                       "composite:6",
                                       "exact",
                                       "auto",
                                       "display:5",
                                       "display:6",
                                       "zeta65536:2",
                                       "level0.9999999999:2",
                                       "level0.000000000001:2",
                                       "level0.00000000000000000001:32",
                                       "zeta0.1:2",
                                       "zeta65535.1234567891:32"};
    static const char *const BAD[] = {
        "",           "phong",     "energy:3",    "energy:",     "energy:64",
        "shift7:4",   "level:2",   "level1:2",    "level0:2",    "power:2",
        "gxx",        "levelx:2",  "taylor :2",   "zeta0:2",     "zeta:2",
        "nv2x",       "table256",  "affine:3",    "zeta65537:2", "kuijk-blake",
        "minimax:",   "zeta-1:2",  "zeta1e3:2",   "composite:1", "composite:7",
        "composite:", "display:4", "composite:05"};
    char name[BURNISH_LOBE_NAME_SIZE];
    burnish_lobe_spec lobe;
    for (size_t i = 0; i < sizeof GOOD / sizeof GOOD[0]; ++i) {
        CHECK(burnish_lobe_spec_parse(GOOD[i], &lobe, NULL) == BURNISH_STATUS_OK, "%s", GOOD[i]);
        burnish_lobe_spec_name(&lobe, name, sizeof name);
        CHECK_TEXT(name, GOOD[i]);
    }
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; ++i) {
        burnish_error error = {BURNISH_STATUS_OK, ""};
        CHECK(burnish_lobe_spec_parse(BAD[i], &lobe, &error) == BURNISH_STATUS_ARGUMENT &&
                  error.text[0],
              "\"%s\" is no lobe to draw", BAD[i]);
    }
    burnish_error error;
    burnish_lobe_spec_parse("energy:3", &lobe, &error);
    CHECK_TEXT(error.text, "\"energy:3\": the order, \"3\", is not 2, 4, 8, 16 or 32");
    burnish_lobe_spec_parse("composite:8", &lobe, &error);
    CHECK_TEXT(error.text,
               "\"composite:8\": the multiplications, \"8\", are not 2 to 6, or 5 or 6 for "
               "display");
    burnish_lobe_spec_parse("display:4", &lobe, &error);
    CHECK_TEXT(error.text, "lobe: 4 multiplications; composite has 2 to 6, display has 5 or 6");
    CHECK1(burnish_lobe_spec_parse("composite", &lobe, NULL) == BURNISH_STATUS_OK &&
           lobe.order == 5);
    double zeta, scale;
    CHECK1(burnish_lobe_solve(&lobe, 10, &zeta, &scale) == BURNISH_LOBE_ERROR_FIT && zeta == 0);
    CHECK1(burnish_lobe_spec_parse("shift7", &lobe, NULL) == BURNISH_STATUS_OK && lobe.order == 2);
    CHECK1(burnish_lobe_spec_check(&(burnish_lobe_spec){0}, NULL) == BURNISH_STATUS_ARGUMENT);
    burnish_lobe_spec_name(&(burnish_lobe_spec){.kind = BURNISH_LOBE_KIND_COUNT}, name,
                           sizeof name);
    CHECK_TEXT(name, "unknown");
}

/* A parameter's words parse to the same number, within the digits of words. */
static void check_parameters(void) {
    uint64_t state = test_seed(12);
    char name[BURNISH_LOBE_NAME_SIZE];
    for (int i = 0; i < 200000; ++i) {
        const int is_level = i & 1;
        double scale = pow(10, (double)(test_random32(&state) % 21));
        double limit = is_level ? scale : 65536 * scale;
        limit = limit < 1e15 ? limit : 1e15;
        double digits = 1 + floor(test_uniform(&state, 0, 1) * (limit - 1.5));
        burnish_lobe_spec read, lobe = {.fit = is_level ? BURNISH_FIT_LEVEL : BURNISH_FIT_GIVEN,
                                        .order = 32,
                                        .parameter = digits / scale};
        if (is_level && !(lobe.parameter > 0 && lobe.parameter < 1)) {
            continue;
        }
        burnish_lobe_spec_name(&lobe, name, sizeof name);
        int ok = burnish_lobe_spec_parse(name, &read, NULL) == BURNISH_STATUS_OK &&
                 read.fit == lobe.fit && read.order == 32 && read.parameter == lobe.parameter;
        if (!CHECK(ok, "%.17g is written %s", lobe.parameter, name)) {
            return;
        }
    }
    /* more digits than words have: truncated, still a valid level */
    burnish_lobe_spec read, near = {.fit = BURNISH_FIT_LEVEL, .order = 2, .parameter = 1 - 0x1p-53};
    burnish_lobe_spec_name(&near, name, sizeof name);
    CHECK_TEXT(name, "level0.99999999999999:2");
    CHECK1(burnish_lobe_spec_parse(name, &read, NULL) == BURNISH_STATUS_OK);
    near.parameter = 0.1 + 0.2;
    burnish_lobe_spec_name(&near, name, sizeof name);
    CHECK_TEXT(name, "level0.3:2");
}

static double code_of(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055);
}

/* Products where they cost at most 5 multiplications. The rest has the 8-bit sRGB codes of cos^n
 * over nine tenths of the range, and no code that differs by more than 1. */
static void check_exact(void) {
    static const float products[] = {1, 2, 3, 4, 7, 8, 11, 14, 16, 24, 32};
    double worst = 0;
    for (size_t i = 0; i < sizeof products / sizeof products[0]; ++i) {
        CHECK(burnish_lobe_exact(products[i]).kind == BURNISH_LOBE_INTEGER_POWER, "%g",
              (double)products[i]);
    }
    CHECK1(burnish_lobe_exact(7.5f).kind == BURNISH_LOBE_POWER);
    CHECK1(burnish_lobe_exact(NAN).kind == BURNISH_LOBE_POWER);
    CHECK1(burnish_lobe_exact(15).kind == BURNISH_LOBE_COMPOSITE);
    CHECK1(burnish_lobe_exact(33).kind == BURNISH_LOBE_COMPOSITE);
    for (double n = 1.25; n < 65536; n *= 1.0173) {
        burnish_theory_model model;
        const double end = 1 - pow(0.5 / 255 / 12.92, 1 / n); /* the last code that is not 0 */
        int different = 0;
        CHECK1(!burnish_theory_model_create(&model,
                                            &(burnish_lobe_spec){.kind = BURNISH_LOBE_EXACT}, n));
        for (int i = 0; i < 4000; ++i) {
            const double lambda = end * i / 4000;
            const double off = round(code_of(burnish_theory_value_at_lambda(&model, lambda))) -
                               round(code_of(pow(1 - lambda, n)));
            CHECK(fabs(off) < 1.5, "n = %g: %g codes off", n, off);
            different += off != 0;
        }
        worst = fmax(worst, different / 4000.0);
    }
    printf("exact: another code over %.3f of the range at most\n", worst);
    CHECK1(worst > 0 && worst < 0.1);
}

/* ---- Fits ---- */

/* scale u^m - c^n at lambda. */
static long double difference(long double zeta, long double scale, int order, long double n,
                              long double lambda) {
    long double u = 1 - zeta * lambda;
    return scale * (u > 0 ? powl(u, order) : 0) - (lambda < 1 ? expl(n * log1pl(-lambda)) : 0);
}

/* The largest and the least difference, without the peak: a walk along sqrt(lambda), then a golden
 * section around each extreme. */
static void extremes(long double zeta, long double scale, int order, long double n,
                     long double range[2]) {
    const int steps = 2000;
    const long double golden = 0.6180339887498948482L;
    const long double reach = 60 / n < 1 ? sqrtl(60 / n) : 1;
    long double best[2] = {0, 0};
    range[0] = range[1] = 0;
    for (int i = 1; i <= steps; ++i) {
        long double s = reach * i / steps, d = difference(zeta, scale, order, n, s * s);
        for (int which = 0; which < 2; ++which) {
            if (which ? d > range[1] : d < range[0]) {
                range[which] = d, best[which] = s;
            }
        }
    }
    for (int which = 0; which < 2; ++which) {
        long double sign = which ? 1 : -1, low = best[which] - reach / steps,
                    high = best[which] + reach / steps;
        low = low > 0 ? low : 0;
        high = high < 1 ? high : 1;
        for (int i = 0; i < 60; ++i) {
            long double a = high - golden * (high - low), b = low + golden * (high - low);
            if (sign * difference(zeta, scale, order, n, a * a) >
                sign * difference(zeta, scale, order, n, b * b)) {
                high = b;
            } else {
                low = a;
            }
        }
        long double d = difference(zeta, scale, order, n, low * low);
        range[which] = sign * d > sign * range[which] ? d : range[which];
    }
}

/* Above minus below: 0 at the best zeta. */
static long double imbalance(long double zeta, long double scale, int order, long double n) {
    long double range[2];
    extremes(zeta, scale, order, n, range);
    return range[1] + range[0];
}

/* The derivative of the integral of (lobe - power)^2 over lambda in -zeta, by Gauss-Legendre panels
 * along sqrt(lambda): 0 at the best zeta. */
static long double squares_slope(long double zeta, int order, long double n) {
    static const long double node[2] = {0.33998104358485626480L, 0.86113631159405257522L};
    static const long double weight[2] = {0.65214515486254614263L, 0.34785484513745385737L};
    const long double end = zeta > 1 ? 1 / sqrtl(zeta) : 1;
    const int panels = zeta < 1 ? 4000 : 200; /* (1 - lambda)^n is no polynomial at 1 */
    long double sum = 0, half = end / (2 * panels);
    for (int i = 0; i < panels * 4; ++i) {
        long double x = node[i / 2 % 2] * (i % 2 ? 1 : -1);
        long double s = half * (2 * (i / 4) + 1 + x), lambda = s * s, u = 1 - zeta * lambda;
        sum += weight[i / 2 % 2] * half * 2 * s * lambda * powl(u > 0 ? u : 0, order - 1) *
               difference(zeta, 1, order, n, lambda);
    }
    return sum;
}

/* How far zeta is from the zero of a function of it, relative, by one step of Newton's. */
static double distance(long double at, long double below, long double above, long double step) {
    return (double)fabsl(at * 2 * step / (above - below));
}

static void check_searched_fits(void) {
    static const double exponents[] = {1,    1.25, 1.9, 2.1, 3,   4.5,   8.1,  10,
                                       16.5, 18,   33,  64,  100, 999.5, 4096, 65536};
    double worst[3] = {0, 0, 0}, peak = 0;
    for (size_t i = 0; i < 5 * sizeof exponents / sizeof exponents[0]; ++i) {
        const int order = 2 << i % 5;
        const double n = exponents[i / 5], step = 1e-5;
        double zeta, scale;
        if (n <= order && order > 2) {
            continue;
        }
        burnish_lobe_spec lobe = {.fit = BURNISH_FIT_MINIMAX, .order = order};
        CHECK1(burnish_lobe_solve(&lobe, n, &zeta, &scale) == BURNISH_LOBE_OK && scale == 1);
        double off =
            distance(imbalance(zeta, 1, order, n), imbalance(zeta * (1 - step), 1, order, n),
                     imbalance(zeta * (1 + step), 1, order, n), step);
        CHECK(off < 1e-9, "minimax:%d n=%g: zeta %.15g off by %.2g", order, n, zeta, off);
        worst[0] = fmax(worst[0], off);

        lobe.fit = BURNISH_FIT_LEAST_SQUARES;
        CHECK1(burnish_lobe_solve(&lobe, n, &zeta, &scale) == BURNISH_LOBE_OK && scale == 1);
        off = distance(squares_slope(zeta, order, n), squares_slope(zeta * (1 - step), order, n),
                       squares_slope(zeta * (1 + step), order, n), step);
        CHECK(off < 1e-9, "leastsquares:%d n=%g: zeta %.15g off by %.2g", order, n, zeta, off);
        worst[1] = fmax(worst[1], off);

        lobe.fit = BURNISH_FIT_AFFINE;
        if (n > order) {
            long double range[2];
            CHECK1(burnish_lobe_solve(&lobe, n, &zeta, &scale) == BURNISH_LOBE_OK && scale < 1);
            extremes(zeta, scale, order, n, range);
            off = distance(imbalance(zeta, scale, order, n),
                           imbalance(zeta * (1 - step), scale, order, n),
                           imbalance(zeta * (1 + step), scale, order, n), step);
            CHECK(off < 1e-9, "affine:%d n=%g: zeta %.15g off by %.2g", order, n, zeta, off);
            worst[2] = fmax(worst[2], off);
            off = fabs((double)(range[1] - (1 - (long double)scale)));
            CHECK(off < 1e-9, "affine:%d n=%g: peak %.15g off by %.2g", order, n, scale, off);
            peak = fmax(peak, off);
        }
    }
    printf("zeta off by at most: minimax %.2g, leastsquares %.2g, affine %.2g (its peak %.2g)\n",
           worst[0], worst[1], worst[2], peak);
}

/* The power is a member of the family where exponent and order agree. */
static void check_exact_fits(void) {
    for (int order = 2; order <= 32; order *= 2) {
        for (int fit = BURNISH_FIT_MINIMAX; fit <= BURNISH_FIT_AFFINE; ++fit) {
            double zeta, scale;
            burnish_lobe_spec lobe = {.fit = (burnish_lobe_fit)fit, .order = order};
            CHECK(burnish_lobe_solve(&lobe, order, &zeta, &scale) == BURNISH_LOBE_OK && zeta == 1 &&
                      scale == 1,
                  "fit %d order %d", fit, order);
        }
    }
}

/* The bits of slopes and peaks: the same on every machine, since no libm takes part. */
#define FITS_HASH 0x280b76c6c2386c7cu

static uint64_t add_double(uint64_t hash, double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    for (int i = 0; i < 64; i += 8) {
        hash = (hash ^ (bits >> i & 255)) * 0x100000001b3u;
    }
    return hash;
}

static void check_bits(void) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (int fit = 0; fit < BURNISH_FIT_COUNT; ++fit) {
        double n = 1;
        for (int i = 0; i < 300; ++i, n *= 1.0375) {
            burnish_lobe_spec lobe = {
                .fit = (burnish_lobe_fit)fit, .order = 2 << i % 5, .parameter = 0.37};
            double zeta, scale;
            (void)burnish_lobe_solve(&lobe, n, &zeta, &scale);
            hash = add_double(add_double(hash, zeta), scale);
        }
    }
    CHECK(hash == FITS_HASH, "hash %#llx", (unsigned long long)hash);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_words());
    RUN(check_parameters());
    RUN(check_exact());
    RUN(check_searched_fits());
    RUN(check_exact_fits());
    RUN(check_bits());
    return test_end("lobe_spec");
}
