/* The elementary functions against libm's long double ones over dense sweeps, in units of the last
 * place of the exact result. The bounds asserted are those that elementary.h states. */
#include <float.h>
#include <math.h>
#include <stdint.h>

#include "base/elementary.h"
#include "burnish/core.h"
#include "support.h"

/* The largest error of one function, and where. */
typedef struct {
    double ulp, x, y;
} worst;

/* The error of `got` in units of the last place of `exact`. */
static double ulp_error(double got, long double exact) {
    int exponent;
    if (isnan(got) || isinf(got)) {
        return HUGE_VAL;
    }
    frexpl(exact, &exponent);
    exponent = exponent < -1021 ? -1021 : exponent;
    return (double)fabsl(ldexpl((long double)got - exact, DBL_MANT_DIG - exponent));
}

static void note(worst *w, double got, long double exact, double x, double y) {
    double error = ulp_error(got, exact);
    if (error > w->ulp) {
        w->ulp = error, w->x = x, w->y = y;
    }
}

static void report(const char *name, worst w, double bound) {
    printf("%-8s largest error %.3f ulp at %.17g, %.17g (bound %.2f)\n", name, w.ulp, w.x, w.y,
           bound);
    CHECK(w.ulp > 0 && w.ulp <= bound, "%s", name);
}

/* Of either sign, abs between 2^low and 2^high, uniform in the exponent. */
static double spread(uint64_t *state, int low, int high) {
    uint64_t bits = test_random64(state);
    double mantissa = test_uniform(state, 1, 2);
    double x = ldexp(mantissa, low + (int)((bits >> 1) % (uint64_t)(high - low)));
    return bits & 1 ? x : -x;
}

enum { SAMPLES = 400000 };

static void check_square_root(void) {
    uint64_t state = test_seed(1);
    for (int i = 0; i < SAMPLES; ++i) {
        double x = fabs(spread(&state, -1040, 1023));
        CHECK(burnish_sqrt(x) == sqrt(x), "%a", x);
        CHECK(burnish_sqrtf((float)i) == sqrtf((float)i), "%d", i);
    }
    CHECK1(isnan(burnish_sqrt(-1)) && isnan(burnish_sqrtf(-1)));
}

static void check_sincos(void) {
    uint64_t state = test_seed(2);
    worst sine = {0}, cosine = {0};
    for (int i = 0; i < 3 * SAMPLES; ++i) {
        double x = i < SAMPLES       ? test_uniform(&state, -10, 10)
                   : i < 2 * SAMPLES ? test_uniform(&state, -1e6, 1e6)
                                     : (double)(i - 5 * SAMPLES / 2) * 1.57079632679489661923;
        double s, c;
        burnish_sincos(x, &s, &c);
        note(&sine, s, sinl(x), x, 0);
        note(&cosine, c, cosl(x), x, 0);
    }
    for (int i = 0; i < SAMPLES; ++i) {
        double s, c, x = spread(&state, -1040, 0);
        burnish_sincos(x, &s, &c);
        note(&sine, s, sinl(x), x, 0);
        note(&cosine, c, cosl(x), x, 0);
    }
    report("sine", sine, 1);
    report("cosine", cosine, 1);

    static const double outside[] = {1000001, -1000001, HUGE_VAL, -HUGE_VAL, NAN};
    for (int i = 0; i < 5; ++i) {
        double s, c;
        burnish_sincos(outside[i], &s, &c);
        CHECK(isnan(s) && isnan(c), "%g", outside[i]);
    }
    double s, c;
    burnish_sincos(-0.0, &s, &c);
    CHECK1(s == 0 && signbit(s) && c == 1);
    burnish_sincos(1e6, &s, &c);
    CHECK1(!isnan(s) && !isnan(c));
}

static void check_atan2(void) {
    uint64_t state = test_seed(3);
    worst w = {0};
    for (int i = 0; i < 2 * SAMPLES; ++i) {
        double y = i < SAMPLES ? test_uniform(&state, -1, 1) : spread(&state, -1030, 1023);
        double x = i < SAMPLES ? test_uniform(&state, -1, 1) : spread(&state, -1030, 1023);
        note(&w, burnish_atan2(y, x), atan2l(y, x), y, x);
    }
    for (int i = 0; i <= SAMPLES; ++i) { /* where the nearest atan(k/8) changes */
        double y = (double)i / SAMPLES;
        note(&w, burnish_atan2(y, 1), atan2l(y, 1), y, 1);
        note(&w, burnish_atan2(1, -y), atan2l(1, -y), 1, -y);
    }
    report("atan2", w, 1.5);

    const double pi = 3.14159265358979323846;
    CHECK1(burnish_atan2(0, 0) == 0 && burnish_atan2(-0.0, -0.0) == 0);
    CHECK1(burnish_atan2(0, -1) == pi && burnish_atan2(-0.0, -1) == pi);
    CHECK1(burnish_atan2(1, 0) == pi / 2 && burnish_atan2(-1, 0) == -pi / 2);
    CHECK1(burnish_atan2(0, 1) == 0);
    CHECK1(burnish_atan2(HUGE_VAL, HUGE_VAL) == pi / 4);
    CHECK1(burnish_atan2(-HUGE_VAL, -HUGE_VAL) == -3 * pi / 4);
    CHECK1(burnish_atan2(1, HUGE_VAL) == 0 && burnish_atan2(HUGE_VAL, 1) == pi / 2);
    CHECK1(isnan(burnish_atan2(NAN, 1)) && isnan(burnish_atan2(1, NAN)));
}

static void check_acos(void) {
    uint64_t state = test_seed(4);
    worst w = {0};
    for (int i = 0; i < SAMPLES; ++i) {
        double x = test_uniform(&state, -1, 1);
        double near_one = 1 - fabs(spread(&state, -53, -1));
        note(&w, burnish_acos(x), acosl(x), x, 0);
        note(&w, burnish_acos(near_one), acosl(near_one), near_one, 0);
        note(&w, burnish_acos(-near_one), acosl(-near_one), -near_one, 0);
    }
    report("acos", w, 2.5);
    CHECK1(burnish_acos(1) == 0 && burnish_acos(2) == 0 && burnish_acos(HUGE_VAL) == 0);
    CHECK1(burnish_acos(-1) == acos(-1) && burnish_acos(-2) == acos(-1));
    CHECK1(burnish_acos(0) == acos(0));
    CHECK1(isnan(burnish_acos(NAN)));
}

static void check_log(void) {
    uint64_t state = test_seed(5);
    worst w = {0};
    for (int i = 0; i < SAMPLES; ++i) {
        double x = test_uniform(&state, 0, 4);
        double near_one = 1 + spread(&state, -52, -1);
        double any = fabs(spread(&state, -1070, 1023));
        note(&w, burnish_log(x), logl(x), x, 0);
        note(&w, burnish_log(near_one), logl(near_one), near_one, 0);
        note(&w, burnish_log(any), logl(any), any, 0);
    }
    report("log", w, 1);
    CHECK1(burnish_log(1) == 0);
    CHECK1(burnish_log(0) == -HUGE_VAL && burnish_log(-0.0) == -HUGE_VAL);
    CHECK1(burnish_log(HUGE_VAL) == HUGE_VAL);
    CHECK1(isnan(burnish_log(-1)) && isnan(burnish_log(-HUGE_VAL)) && isnan(burnish_log(NAN)));
}

static void check_expm1(void) {
    uint64_t state = test_seed(6);
    worst w = {0};
    for (int i = 0; i < SAMPLES; ++i) {
        double x = test_uniform(&state, -3, 3);
        double wide = test_uniform(&state, -60, 709.7);
        double tiny = spread(&state, -1040, 1);
        note(&w, burnish_expm1(x), expm1l(x), x, 0);
        note(&w, burnish_expm1(wide), expm1l(wide), wide, 0);
        note(&w, burnish_expm1(tiny), expm1l(tiny), tiny, 0);
    }
    report("expm1", w, 1.5);
    CHECK1(burnish_expm1(0) == 0 && signbit(burnish_expm1(-0.0)));
    CHECK1(burnish_expm1(-745) == -1 && burnish_expm1(-HUGE_VAL) == -1);
    CHECK1(isfinite(burnish_expm1(709)));
    CHECK1(burnish_expm1(709.79) == HUGE_VAL && burnish_expm1(711) == HUGE_VAL);
    CHECK1(burnish_expm1(HUGE_VAL) == HUGE_VAL && isnan(burnish_expm1(NAN)));
}

/* The bits themselves: one number over many results, the same for every compiler and machine. */
static void check_bits(void) {
    uint64_t state = 7, hash = 0;
    for (int i = 0; i < 20000; ++i) {
        double results[7], x = test_uniform(&state, -20, 20);
        burnish_sincos(x * 1000, &results[0], &results[1]);
        results[2] = burnish_atan2(x, test_uniform(&state, -20, 20));
        results[3] = burnish_acos(x * 0.05);
        results[4] = burnish_log(x * x);
        results[5] = burnish_expm1(x);
        results[6] = burnish_sqrt(x * x + 1);
        for (int k = 0; k < 7; ++k) {
            uint64_t bits;
            memcpy(&bits, &results[k], sizeof bits);
            hash = (hash ^ bits) * 0x100000001b3u;
            hash ^= hash >> 29;
        }
    }
    printf("hash of the results: %016llx\n", (unsigned long long)hash);
    CHECK(hash == 0xcfab5e56986bed8eu, "the bits changed");
}

/* Three doubles to float and back. */
__attribute__((noinline)) static void through_float(double x, double y, double length,
                                                    double out[3]) {
    float v[3];
    v[0] = (float)(x / length);
    v[1] = (float)(y / length);
    v[2] = (float)(0.3 / length);
    for (int k = 0; k < 3; ++k) {
        out[k] = (double)v[k];
    }
}

/* The compiler keeps a rounding that stands in the source: GCC 12's SLP vectoriser does not. */
static void check_compiler(void) {
    double out[3];
    through_float(0.7, 0.9, 1.37, out);
    CHECK(out[0] == 0x1.059b18p-1 && out[1] == 0x1.5059b2p-1 && out[2] == 0x1.c07798p-3, "%a %a %a",
          out[0], out[1], out[2]);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_compiler());
    RUN(check_square_root());
    RUN(check_sincos());
    RUN(check_atan2());
    RUN(check_acos());
    RUN(check_log());
    RUN(check_expm1());
    RUN(check_bits());
    return test_end("elementary");
}
