/* The paper's claims: every number is computed, every verdict follows from the numbers. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "theory/internal.h"

static const double END = 0.5 * BURNISH_PI;
enum { SWEEP = 5000 };

const char *burnish_theory_verdict_text(burnish_theory_verdict verdict) {
    switch (verdict) {
    case BURNISH_THEORY_HOLDS:
        return "holds";
    case BURNISH_THEORY_HOLDS_TO_DIGITS:
        return "holds to the digits given";
    case BURNISH_THEORY_DOES_NOT_HOLD:
        return "does not hold";
    case BURNISH_THEORY_BENCHMARK:
        return "measured by benchmark";
    case BURNISH_THEORY_VERDICT_COUNT:
        break;
    }
    return "unknown verdict";
}

/* ---- Writing values ---- */

__attribute__((format(printf, 4, 5))) static void add(burnish_theory_claim *claim, int judged,
                                                      double value, const char *format, ...) {
    va_list arguments;
    if (claim->count == BURNISH_THEORY_CLAIM_VALUES) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(claim->values[claim->count].label, sizeof claim->values[0].label, format, arguments);
    va_end(arguments);
    claim->values[claim->count].value = value;
    claim->values[claim->count++].judged = judged;
}

/* The lobes of the paper. Their exponents are constants below, so creation cannot fail. */
static burnish_theory_model make(burnish_lobe_fit fit, double n) {
    burnish_theory_model model;
    (void)burnish_theory_model_create(
        &model, &(burnish_lobe_spec){.fit = fit, .order = 2, .parameter = 0.5}, n);
    return model;
}

static burnish_theory_model make_other(burnish_lobe_kind kind, double n) {
    burnish_theory_model model;
    (void)burnish_theory_model_create(&model, &(burnish_lobe_spec){.kind = kind, .order = 2}, n);
    return model;
}

static double angle_of_level(double n, double level) {
    burnish_theory_model power = make_other(BURNISH_LOBE_POWER, n);
    return burnish_theory_angle_at(&power, level);
}

/* ---- What each claim computes ---- */

static void peak(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 100, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = make_other(BURNISH_LOBE_POWER, n[i]);
        add(claim, 1, burnish_theory_value_at_angle(&w, 0), "W n=%g", n[i]);
        add(claim, 1, burnish_theory_value_at_angle(&power, 0), "power n=%g", n[i]);
    }
}

static void zero(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000};
    for (int i = 0; i < 5; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        double angle = burnish_theory_zero_angle(&w), cosine = (n[i] - 2) / n[i];
        add(claim, 1, fabs(cos(angle) - cosine), "place n=%g", n[i]);
        add(claim, 1, burnish_theory_value(&w, cosine), "value n=%g", n[i]);
    }
}

static void monotone(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        double end = burnish_theory_zero_angle(&w), before = 1, rise = 0;
        for (int k = 1; k <= SWEEP; ++k) {
            double value = burnish_theory_value_at_angle(&w, end * k / SWEEP);
            rise = value - before > rise ? value - before : rise;
            before = value;
        }
        add(claim, 1, rise, "n=%g", n[i]);
    }
}

static double core_relative(const burnish_theory_model *model) {
    burnish_theory_difference difference;
    burnish_theory_compare(model, burnish_theory_inflection_angle(model->exponent), &difference);
    return 100 * difference.relative;
}

static void core_w(burnish_theory_claim *claim) {
    static const double n[] = {3, 5, 10, 100, 120, 140, 200, 1000, 65536};
    for (int i = 0; i < 9; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        add(claim, 1, core_relative(&w), "n=%g", n[i]);
    }
}

static void core_schlick(burnish_theory_claim *claim) {
    static const double n[] = {3, 5, 10, 100, 1000, 65536};
    for (int i = 0; i < 6; ++i) {
        burnish_theory_model schlick = make_other(BURNISH_LOBE_SCHLICK, n[i]);
        add(claim, 1, core_relative(&schlick), "n=%g", n[i]);
    }
}

static void ordering(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000, 65536};
    for (int i = 0; i < 6; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = make_other(BURNISH_LOBE_POWER, n[i]);
        burnish_theory_model schlick = make_other(BURNISH_LOBE_SCHLICK, n[i]);
        double above = -1, below = -1;
        for (int k = 0; k <= SWEEP; ++k) {
            double s = (double)k / SWEEP, lambda = s * s;
            double p = burnish_theory_value_at_lambda(&power, lambda);
            above = fmax(above, burnish_theory_value_at_lambda(&w, lambda) - p);
            below = fmax(below, p - burnish_theory_value_at_lambda(&schlick, lambda));
        }
        add(claim, 1, above, "W - power n=%g", n[i]);
        add(claim, 1, below, "power - Schlick n=%g", n[i]);
    }
}

static void radius(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        add(claim, 1, burnish_theory_zero_curvature_radius(&w) * (2 * n[i] - 2), "n=%g", n[i]);
    }
}

static void energy_absolute(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 5, 10, 21, 100, 1000, 65536};
    for (int i = 0; i < 8; ++i) {
        burnish_theory_model w1 = make(BURNISH_FIT_ENERGY, n[i]);
        add(claim, 1, burnish_theory_maximum_error(&w1, END), "n=%g", n[i]);
    }
}

static void energy_extreme(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w1 = make(BURNISH_FIT_ENERGY, n[i]);
        double angle = burnish_theory_extreme_angle_searched(&w1);
        add(claim, 1, tan(angle) * n[i] / sqrt(2 * n[i] + 1), "n=%g", n[i]);
    }
}

static void half_tail(burnish_theory_claim *claim, const double *n, int count) {
    for (int i = 0; i < count; ++i) {
        burnish_theory_model half = make(BURNISH_FIT_SHIFT7, n[i]);
        burnish_theory_model exact = make(BURNISH_FIT_LEVEL, n[i]);
        double end = angle_of_level(n[i], 0.45);
        double core = burnish_theory_inflection_angle(n[i]);
        add(claim, 1, burnish_theory_maximum_error(&half, end), "7n/16 n=%g", n[i]);
        add(claim, 0, burnish_theory_maximum_error(&exact, end), "level(.5) n=%g", n[i]);
        add(claim, 0, burnish_theory_maximum_error(&half, core), "to inflection n=%g", n[i]);
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
        burnish_theory_model schlick = make_other(BURNISH_LOBE_SCHLICK, n[i]);
        add(claim, 1, core_absolute(&schlick), "n=%g", n[i]);
    }
}

static void schlick_ratio(burnish_theory_claim *claim) {
    static const double n[] = {21, 100, 1000, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model schlick = make_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_theory_model half = make(BURNISH_FIT_SHIFT7, n[i]);
        add(claim, 1, core_absolute(&schlick) / core_absolute(&half), "n=%g", n[i]);
    }
}

static void half_extreme(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = make(BURNISH_FIT_SHIFT7, n[i]);
        double tangent = tan(burnish_theory_extreme_angle_searched(&half));
        add(claim, 1, tangent * (7 * n[i] - 16) / (2 * sqrt(7 * n[i] - 15)), "n=%g", n[i]);
    }
}

static void half_radius(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = make(BURNISH_FIT_SHIFT7, n[i]);
        add(claim, 1, burnish_theory_zero_curvature_radius(&half) * (7 * n[i] - 8) / 4, "n=%g",
            n[i]);
    }
}

static void half_radius_larger(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model half = make(BURNISH_FIT_SHIFT7, n[i]);
        burnish_theory_model w = make(BURNISH_FIT_TAYLOR, n[i]);
        add(claim, 1,
            burnish_theory_zero_curvature_radius(&half) / burnish_theory_zero_curvature_radius(&w),
            "n=%g", n[i]);
    }
}

/* ---- Operations, counted while computing in integers ----
 *
 * The claim is that these operations suffice; the proof is a routine that uses no others and whose
 * values are the lobe's. */

enum { FRACTION = 20 }; /* cosines as multiples of 2^-20 */

typedef struct {
    int multiplications, additions, unit_steps, shift_places;
} counter;

static int64_t multiply(counter *count, int64_t a, int64_t b) {
    ++count->multiplications;
    return a * b;
}

static int64_t shift_right(counter *count, int64_t a, int places) {
    count->shift_places += places;
    return a >> places;
}

static int64_t shift_left(counter *count, int64_t a, int places) {
    count->shift_places += places;
    return a << places;
}

/* x + 1 or x - 1, with 1 as the cosine's unit. */
static int64_t step(counter *count, int64_t x, int direction) {
    ++count->unit_steps;
    return x + direction * ((int64_t)1 << FRACTION);
}

static int64_t subtract(counter *count, int64_t a, int64_t b) {
    ++count->additions;
    return a - b;
}

/* zeta in integers, then (1 + zeta (c - 1))^2; the cutoff is left to the boundary memory. */
static double integer_lobe(counter *count, int half, int64_t n, int64_t cosine) {
    int64_t zeta = half ? shift_right(count, subtract(count, shift_left(count, n, 3), n), 4)
                        : shift_right(count, n, 1);
    int64_t u = step(count, multiply(count, zeta, step(count, cosine, -1)), 1);
    return ldexp((double)multiply(count, u, u), -2 * FRACTION);
}

static void operations(burnish_theory_claim *claim, int half, int places) {
    const int64_t one = (int64_t)1 << FRACTION;
    counter count = {0, 0, 0, 0};
    int apart = 0;
    double worst = 0;
    for (int64_t n = 16; n <= 65536; n *= 2) { /* zeta is whole */
        burnish_theory_model model =
            make(half ? BURNISH_FIT_SHIFT7 : BURNISH_FIT_TAYLOR, (double)n);
        for (int64_t step_down = 0; step_down <= 64; ++step_down) { /* from 1 to the zero */
            const int64_t cosine = one - step_down * one / (32 * n);
            count = (counter){0, 0, 0, 0};
            const double value = integer_lobe(&count, half, n, cosine);
            const double exact = burnish_theory_value(&model, ldexp((double)cosine, -FRACTION));
            worst = fmax(worst, fabs(value - exact));
            apart += abs(count.multiplications - 2) + abs(count.unit_steps - 2) +
                     abs(count.additions - (half ? 1 : 0)) + abs(count.shift_places - places);
        }
    }
    add(claim, 1, apart, "counts that differ");
    add(claim, 1, worst, "error of the integer lobe");
    add(claim, 0, count.multiplications, "multiplications");
    add(claim, 0, count.unit_steps, "increments and decrements");
    add(claim, 0, count.additions, "subtractions");
    add(claim, 0, count.shift_places, "shift places");
}

static void operations_w(burnish_theory_claim *claim) {
    operations(claim, 0, 1);
}

static void operations_half(burnish_theory_claim *claim) {
    operations(claim, 1, 7);
}

/* ---- The list ---- */

typedef struct {
    const char *id, *claim, *quantity, *note, *command;
    burnish_theory_relation relation;
    double bound, unit;
    void (*compute)(burnish_theory_claim *claim);
} entry;

#define SHOW(id) "burnish lobe claims " id

static const entry ENTRIES[] = {
    {"peak", "W and the power are both 1 at angle 0", "value at angle 0", "", SHOW("peak"),
     BURNISH_THEORY_ABOUT, 1, 0, peak},
    {"zero", "W is zero where the cosine is (n - 2)/n", "distance of the cosines; value there", "",
     SHOW("zero"), BURNISH_THEORY_AT_MOST, 0, 0, zero},
    {"monotone", "W falls all the way to its zero",
     "largest rise between neighbours of 5000 angles", "", SHOW("monotone"), BURNISH_THEORY_AT_MOST,
     0, 0, monotone},
    {"core-w", "down to the inflection of the power, W is off by 7.2 % of it at most",
     "largest relative error, per cent",
     "grows with n and passes the bound between two of the exponents listed", SHOW("core-w"),
     BURNISH_THEORY_AT_MOST, 7.2, 0.1, core_w},
    {"core-schlick", "in the same range Schlick's lobe is off by almost 10 %",
     "largest relative error, per cent", "", SHOW("core-schlick"), BURNISH_THEORY_AT_MOST, 10, 1,
     core_schlick},
    {"order", "Schlick's lobe lies above the power, W below it",
     "largest violation over 5000 angles", "", SHOW("order"), BURNISH_THEORY_AT_MOST, 0, 0,
     ordering},
    {"radius", "W meets zero with the curvature radius 1/(2n - 2)", "radius times (2n - 2)", "",
     SHOW("radius"), BURNISH_THEORY_ABOUT, 1, 0, radius},
    {"w1-absolute", "W1 differs from the power by at most 0.1", "largest absolute error", "",
     SHOW("w1-absolute"), BURNISH_THEORY_AT_MOST, 0.1, 0.1, energy_absolute},
    {"w1-extreme", "W1's relative error is extreme at arctan(sqrt(2n + 1)/n)",
     "tangent of the angle found by search, over the formula's", "", SHOW("w1-extreme"),
     BURNISH_THEORY_ABOUT, 1, 1e-5, energy_extreme},
    {"w05-large", "down to level .45, W_0.5 is off by at most .015 for n > 20",
     "largest absolute error", "down to the inflection it is about that, probably what was meant",
     SHOW("w05-large"), BURNISH_THEORY_AT_MOST, 0.015, 0.001, half_tail_large},
    {"w05-small", "down to level .45, W_0.5 is off by less than .02 for other n",
     "largest absolute error", "exceeded for the smallest exponents", SHOW("w05-small"),
     BURNISH_THEORY_AT_MOST, 0.02, 0.01, half_tail_small},
    {"schlick-absolute", "down to the inflection, Schlick's lobe is off by .06",
     "largest absolute error", "", SHOW("schlick-absolute"), BURNISH_THEORY_ABOUT, 0.06, 0.01,
     schlick_core},
    {"schlick-ratio", "that is four times the error of W_0.5", "ratio of the two errors", "",
     SHOW("schlick-ratio"), BURNISH_THEORY_ABOUT, 4, 1, schlick_ratio},
    {"w05-extreme", "W_0.5's relative error is extreme at arctan(2 sqrt(7n - 15)/(7n - 16))",
     "tangent of the angle found by search, over the formula's", "", SHOW("w05-extreme"),
     BURNISH_THEORY_ABOUT, 1, 1e-5, half_extreme},
    {"w05-radius", "W_0.5 meets zero with the curvature radius 4/(7n - 8)",
     "radius times (7n - 8)/4", "", SHOW("w05-radius"), BURNISH_THEORY_ABOUT, 1, 0, half_radius},
    {"w05-radius-larger", "that radius is larger than W's", "ratio of the radii", "",
     SHOW("w05-radius-larger"), BURNISH_THEORY_AT_LEAST, 1, 0, half_radius_larger},
    {"speed-w", "W is 2.3 times as fast as Schlick's lobe (Pentium M)", "",
     "measured on a Pentium M: run the benchmark on your machine", "make bench",
     BURNISH_THEORY_NONE, 2.3, 0.1, NULL},
    {"speed-w05", "W_0.5 is 1.69 times as fast as Schlick's lobe (Pentium M)", "",
     "measured on a Pentium M: run the benchmark on your machine", "make bench",
     BURNISH_THEORY_NONE, 1.69, 0.01, NULL},
    {"operations-w", "W takes 2 multiplications, a shift, an increment and a decrement",
     "counted while computing W in integers", "the cutoff is looked up in the boundary memory",
     SHOW("operations-w"), BURNISH_THEORY_AT_MOST, 0, 0, operations_w},
    {"operations-w05",
     "W_0.5 takes 2 multiplications, a decrement, an increment, a subtraction and 7 shift places",
     "counted while computing W_0.5 in integers", "the cutoff is looked up in the boundary memory",
     SHOW("operations-w05"), BURNISH_THEORY_AT_MOST, 0, 0, operations_half},
};

enum { ENTRY_COUNT = sizeof ENTRIES / sizeof ENTRIES[0] };

size_t burnish_theory_claim_count(void) {
    return ENTRY_COUNT;
}

/* How far the value is beyond the bound. */
static double excess(const burnish_theory_claim *claim, double value) {
    switch (claim->relation) {
    case BURNISH_THEORY_AT_MOST:
        return value - claim->bound;
    case BURNISH_THEORY_AT_LEAST:
        return claim->bound - value;
    case BURNISH_THEORY_ABOUT:
        return fabs(value - claim->bound) - 0.5 * claim->unit;
    case BURNISH_THEORY_NONE:
        break;
    }
    return 0;
}

static burnish_theory_verdict judge(const burnish_theory_claim *claim) {
    double worst = 0, rounding = 1e-12 * (1 + fabs(claim->bound));
    for (int i = 0; i < claim->count; ++i) {
        double miss = claim->values[i].judged ? excess(claim, claim->values[i].value) : 0;
        worst = miss <= worst ? worst : miss; /* keeps NaN, which never holds */
    }
    if (claim->relation == BURNISH_THEORY_NONE) {
        return BURNISH_THEORY_BENCHMARK;
    }
    if (worst <= rounding) {
        return BURNISH_THEORY_HOLDS;
    }
    double allowed = claim->relation == BURNISH_THEORY_ABOUT ? 0.5 * claim->unit : claim->unit;
    return worst < allowed ? BURNISH_THEORY_HOLDS_TO_DIGITS : BURNISH_THEORY_DOES_NOT_HOLD;
}

burnish_status burnish_theory_claim_compute(size_t index, burnish_theory_claim *claim) {
    if (index >= ENTRY_COUNT || !claim) {
        return BURNISH_STATUS_ARGUMENT;
    }
    const entry *source = &ENTRIES[index];
    *claim = (burnish_theory_claim){.id = source->id,
                                    .claim = source->claim,
                                    .quantity = source->quantity,
                                    .note = source->note,
                                    .command = source->command,
                                    .relation = source->relation,
                                    .bound = source->bound,
                                    .unit = source->unit};
    if (source->compute) {
        source->compute(claim);
    }
    claim->verdict = judge(claim);
    return BURNISH_STATUS_OK;
}
