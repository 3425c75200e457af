/* Proofs about burnish/lobe_q15.h, over all inputs: errors against the exact real lobe with the
 * fit's exact zeta, monotony, bits outside the lobe. test_lobe_q15 takes every few exponents,
 * prove_q15 all (`make prove-q15`).
 *
 * The reference is a double: 1 - zeta (1 - c) is a quotient of two whole numbers below 2^36,
 * rounded once, then squared up to four times, so that its error is below 2^-32 of a step of 2^-16.
 */
#ifndef BURNISH_TEST_Q15_PROOF_H
#define BURNISH_TEST_Q15_PROOF_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "burnish/lobe_q15.h"

enum { Q15_FAST, Q15_NEAR, Q15_EXACT, Q15_FAST8, Q15_EXACT8, Q15_FORMS, Q15_CASES = 10 };

#define Q15_REFERENCE_ERROR 3e-10 /* 2^-32, and a little */

/* One fit and order, and the largest error that each form may have, in steps of its result. */
typedef struct {
    const char *name;
    burnish_q15_fit fit;
    uint16_t order;
    double bound[Q15_FORMS];
} q15_case;

static const char *const q15_form_names[Q15_FORMS] = {"fast", "near", "exact", "fast8", "exact8"};

/* The table of lobe_q15.h. */
static const q15_case q15_cases[Q15_CASES] = {
    {"taylor", BURNISH_Q15_TAYLOR, 2, {3, 1.5, .5, 1, .5}},
    {"taylor", BURNISH_Q15_TAYLOR, 4, {7, 3.4, .5003, 1, .50001}},
    {"taylor", BURNISH_Q15_TAYLOR, 8, {15, 6.9, .5003, 1, .50001}},
    {"taylor", BURNISH_Q15_TAYLOR, 16, {29, 13.3, .5003, 1.04, .50001}},
    {"energy", BURNISH_Q15_ENERGY, 2, {3, 1.6, .86, 1, .502}},
    {"energy", BURNISH_Q15_ENERGY, 4, {7, 3.5, .86, 1, .502}},
    {"energy", BURNISH_Q15_ENERGY, 8, {15, 6.9, .86, 1, .502}},
    {"energy", BURNISH_Q15_ENERGY, 16, {29, 13.3, .86, 1.04, .502}},
    {"shift7", BURNISH_Q15_SHIFT7, 2, {3, 1.5, .5, 1, .5}},
    {"shift3", BURNISH_Q15_SHIFT3, 2, {3, 1.5, .5, 1, .5}},
};

/* What a proof found. */
typedef struct {
    double error[Q15_FORMS];       /* largest, in steps */
    uint64_t values, wrong;        /* results seen, and results that break a promise */
    uint32_t wrong_n, wrong_input; /* one of those */
} q15_result;

/* zeta of a case as a fraction of whole numbers. */
static void q15_zeta(const q15_case *c, uint32_t n, double *numerator, double *denominator) {
    const int is_energy = c->fit == BURNISH_Q15_ENERGY;
    *numerator = is_energy                      ? n + 1.0
                 : c->fit == BURNISH_Q15_SHIFT7 ? 7.0 * n
                 : c->fit == BURNISH_Q15_SHIFT3 ? 3.0 * n
                                                : n;
    *denominator = is_energy                      ? c->order + 1.0
                   : c->fit == BURNISH_Q15_SHIFT7 ? 16
                   : c->fit == BURNISH_Q15_SHIFT3 ? 8
                                                  : c->order;
}

/* t^order of t in [0, 1]. */
static double q15_power(double t, uint16_t order) {
    for (; order > 1; order /= 2) {
        t *= t;
    }
    return t;
}

/* The lobe at 1 - cosine = lambda / one; whole numbers throughout until the one division. */
static double q15_real(const q15_case *c, uint32_t n, double lambda, double one) {
    double numerator, denominator;
    q15_zeta(c, n, &numerator, &denominator);
    const double rest = denominator * one - numerator * lambda;
    return rest > 0 ? q15_power(rest / (denominator * one), c->order) : 0;
}

/* Counts one result of every form against the real lobe, and against the result one step nearer to
 * the peak, which must not be smaller. */
static void q15_compare(q15_result *result, double real, const uint16_t now[Q15_FORMS],
                        uint16_t before[Q15_FORMS], uint32_t n, uint32_t input) {
    for (int form = 0; form < Q15_FORMS; ++form) {
        const double one = form >= Q15_FAST8 ? 256 : 65536;
        const double exact = real * one > one - 1 ? one - 1 : real * one;
        const double error = exact > now[form] ? exact - now[form] : now[form] - exact;
        if (error > result->error[form]) {
            result->error[form] = error;
        }
        if (now[form] > before[form]) {
            ++result->wrong;
            result->wrong_n = n;
            result->wrong_input = input;
        }
        before[form] = now[form];
    }
    result->values += Q15_FORMS;
}

static void q15_wrong(q15_result *result, int is_wrong, uint32_t n, uint32_t input) {
    if (is_wrong) {
        ++result->wrong;
        result->wrong_n = n;
        result->wrong_input = input;
    }
}

/* The lobes that need no set-up give the bits of the prepared ones. */
static void q15_prove_direct(const q15_case *c, const burnish_lobe_q15 *lobe, uint32_t n,
                             uint16_t cosine, q15_result *result) {
    const uint16_t fast = burnish_lobe_q15_fast(lobe, cosine);
    uint16_t direct = fast;
    if (c->order == 2 && c->fit == BURNISH_Q15_TAYLOR) {
        direct = burnish_taylor_q15((uint16_t)n, cosine);
        q15_wrong(result,
                  n < 256 && burnish_taylor8_q15((uint8_t)n, cosine) !=
                                 burnish_lobe_q15_fast8(lobe, cosine),
                  n, cosine);
    } else if (c->fit == BURNISH_Q15_SHIFT7) {
        direct = burnish_shift7_q15((uint16_t)n, cosine);
    } else if (c->fit == BURNISH_Q15_SHIFT3) {
        direct = burnish_shift3_q15((uint16_t)n, cosine);
    }
    q15_wrong(result, direct != fast, n, cosine);
}

/* Every cosine of one exponent, those above 1 included. */
static void q15_prove_cosines(const q15_case *c, uint32_t n, q15_result *result) {
    burnish_lobe_q15 lobe;
    uint16_t before[Q15_FORMS] = {0xFFFF, 0xFFFF, 0xFFFF, 0xFF, 0xFF};
    if (burnish_lobe_q15_create(&lobe, c->fit, c->order, (uint16_t)n) != BURNISH_Q15_OK) {
        q15_wrong(result, n >= c->order || c->order == 2, n, 0);
        return;
    }
    for (int32_t cosine = 0xFFFF; cosine >= 0; --cosine) {
        const uint16_t at = (uint16_t)cosine;
        const int32_t lambda = cosine > 0x8000 ? 0 : 0x8000 - cosine;
        const uint16_t now[Q15_FORMS] = {
            burnish_lobe_q15_fast(&lobe, at), burnish_lobe_q15_near(&lobe, at),
            burnish_lobe_q15_exact(&lobe, at), burnish_lobe_q15_fast8(&lobe, at),
            burnish_lobe_q15_exact8(&lobe, at)};
        q15_compare(result, q15_real(c, n, lambda, 32768), now, before, n, (uint32_t)cosine);
        q15_prove_direct(c, &lobe, n, at, result);
    }
}

/* Every stride-th lambda of one exponent from the peak to past the cutoff. For a cosine's lambdas
 * the results are those of the cosine. */
static void q15_prove_lambdas(const q15_case *c, uint32_t n, uint32_t stride, q15_result *result) {
    burnish_lobe_q15 lobe;
    uint16_t before[Q15_FORMS] = {0xFFFF, 0xFFFF, 0xFFFF, 0xFF, 0xFF};
    double numerator, denominator;
    if (burnish_lobe_q15_create(&lobe, c->fit, c->order, (uint16_t)n) != BURNISH_Q15_OK) {
        return;
    }
    q15_zeta(c, n, &numerator, &denominator);
    const double cutoff = 16777216 * denominator / numerator;
    const uint32_t end = cutoff < 16777215 ? (uint32_t)cutoff + 2 * stride : 16777215;
    for (uint32_t lambda = 0; lambda <= end; lambda += stride) {
        const uint16_t now[Q15_FORMS] = {burnish_lobe_q15_fast_lambda(&lobe, lambda),
                                         burnish_lobe_q15_near_lambda(&lobe, lambda),
                                         burnish_lobe_q15_exact_lambda(&lobe, lambda),
                                         burnish_lobe_q15_fast8_lambda(&lobe, lambda),
                                         burnish_lobe_q15_exact8_lambda(&lobe, lambda)};
        const uint32_t limited = lambda > 0xFFFFFF ? 0xFFFFFF : lambda;
        q15_compare(result, q15_real(c, n, limited, 16777216), now, before, n, lambda);
        q15_wrong(result,
                  burnish_q15_product_lambda(lobe.slope, limited) !=
                      (uint32_t)(((uint64_t)lobe.slope * limited) >> 9),
                  n, lambda);
        if (lambda % 512 == 0) {
            const uint16_t cosine = (uint16_t)(0x8000 - (lambda >> 9));
            q15_wrong(result,
                      now[Q15_FAST] != burnish_lobe_q15_fast(&lobe, cosine) ||
                          now[Q15_EXACT] != burnish_lobe_q15_exact(&lobe, cosine),
                      n, lambda);
        }
    }
}

/* fast, near and fast8 depend on a = floor(zeta (1 - c) 2^16) alone, so that 65,536 values of it
 * are every lobe of an exact slope, at every cosine and every lambda that there is: the real lobe
 * lies between those at both ends of a. */
static void q15_prove_steps(uint16_t order, q15_result *result) {
    const uint8_t squarings = burnish_q15_squarings(order);
    uint16_t before[2][Q15_FORMS] = {{0xFFFF, 0xFFFF, 0xFFFF, 0xFF, 0xFF},
                                     {0xFFFF, 0xFFFF, 0xFFFF, 0xFF, 0xFF}};
    for (uint32_t a = 0; a <= 0xFFFF; ++a) {
        for (uint32_t end = 0; end < 2; ++end) {
            const double real = q15_power((65536.0 - a - end) / 65536, order);
            const uint16_t now[Q15_FORMS] = {
                burnish_q15_fast_at((uint_fast16_t)a, squarings),
                burnish_q15_near_at((uint_fast16_t)a, squarings),
                burnish_q15_round(burnish_q15_wide_of(a << 16, squarings)),
                burnish_q15_fast8_at((uint_fast16_t)a, squarings),
                burnish_q15_round8(burnish_q15_wide_of(a << 16, squarings))};
            q15_compare(result, real, now, before[end], order, a);
        }
    }
    result->error[Q15_EXACT] = result->error[Q15_EXACT8] = 0; /* they see more than a */
}

/* Prints a row of the table. Returns 1 when every bound and promise holds. */
static int q15_report(const char *what, const q15_case *c, const q15_result *result) {
    int good = result->wrong == 0 && result->values > 0;
    printf("%-8s %-7s %2d ", what, c->name, c->order);
    for (int form = 0; form < Q15_FORMS; ++form) {
        printf(" %8.5f", result->error[form]);
    }
    printf("  %llu\n", (unsigned long long)result->values);
    for (int form = 0; form < Q15_FORMS; ++form) {
        if (result->error[form] > c->bound[form] + Q15_REFERENCE_ERROR) {
            printf("FAIL: the error of %s is above its bound, %g\n", q15_form_names[form],
                   c->bound[form]);
            good = 0;
        }
    }
    if (result->wrong) {
        printf("FAIL: %llu results are out of order or unequal, one at n = %u, input %u\n",
               (unsigned long long)result->wrong, result->wrong_n, result->wrong_input);
    }
    return good;
}

/* ---- Composites ----------------------------------------------------------------------------- */

/* The largest error against cos^n in steps of 2^-16: powers, from a cosine or 1 - cosine; n = 15;
 * above. */
enum { Q15_POWERS, Q15_FIFTEEN, Q15_ABOVE, Q15_RANGES };
static const double q15_composite_bounds[Q15_RANGES] = {37, 70, 32};

typedef struct {
    double error[Q15_RANGES];
    q15_result all;
} q15_composites;

/* c^n by squarings; error below n 2^-53. */
static double q15_whole_power(double c, uint32_t n) {
    double power = 1;
    for (; n; n /= 2, c *= c) {
        power *= n % 2 ? c : 1;
    }
    return power * 65536;
}

/* A result that stands for all real 1 - cosines from near to far. */
static void q15_bound(q15_composites *found, uint32_t n, double near, double far, uint16_t now,
                      uint16_t *before) {
    const int range = n < 15 ? Q15_POWERS : n == 15 ? Q15_FIFTEEN : Q15_ABOVE;
    const double high = near < 1 ? q15_whole_power(1 - near, n) : 0,
                 low = far < 1 ? q15_whole_power(1 - far, n) : 0;
    const double below = (high > 65535 ? 65535 : high) - now,
                 above = now - (low > 65535 ? 65535 : low);
    const double error = below > above ? below : above;
    if (error > found->error[range]) {
        found->error[range] = error;
    }
    q15_wrong(&found->all, now > *before, n, now);
    *before = now;
    ++found->all.values;
}

/* v = top - floor(128 slope lambda) for any real lambda, so that all v are all cosines and all
 * lambdas. */
static void q15_prove_composite_steps(uint32_t n, const burnish_composite_q15 *lobe,
                                      q15_composites *found) {
    const double step = 1 / (128.0 * lobe->slope);
    uint16_t before = 0xFFFF, v = lobe->top;
    for (uint32_t a = 0; a <= lobe->top; ++a) {
        q15_bound(found, n, a * step, (a + 1) * step,
                  burnish_composite_q15_of(lobe, (uint16_t)(lobe->top - a)), &before);
    }
    q15_bound(found, n, (lobe->top + 1) * step, 1, 0, &before);
    for (int i = 0; i < 3; ++i) { /* no sum wraps */
        const uint32_t square = (uint32_t)v * v >> 16;
        v = (uint16_t)(i == 0 ? square : v);
        q15_wrong(&found->all, (uint32_t)v + lobe->offset[i] > 0xFFFF, n, 0);
        v = burnish_q15_multiply_high(v, (uint16_t)(v + lobe->offset[i]));
    }
    q15_wrong(&found->all,
              burnish_composite_q15_of(lobe, lobe->top) != 0xFFFF ||
                  burnish_composite_q15_of(lobe, 0) != 0,
              n, 0);
}

static uint16_t q15_below(const burnish_composite_q15 *lobe, uint64_t a) {
    return a > lobe->top ? 0 : burnish_composite_q15_of(lobe, (uint16_t)(lobe->top - a));
}

/* Every cosine, and every stride-th lambda to past the cutoff, of one exponent. */
static void q15_prove_composite(uint32_t n, uint32_t stride, q15_composites *found) {
    burnish_composite_q15 lobe;
    uint16_t before = 0xFFFF;
    q15_wrong(&found->all, burnish_composite_q15_create(&lobe, (uint16_t)n) != BURNISH_Q15_OK, n,
              0);
    if (n >= 15) {
        q15_prove_composite_steps(n, &lobe, found);
    }
    for (uint32_t cosine = 0x10000; cosine-- > 0;) {
        const uint32_t lambda = cosine > 0x8000 ? 0 : 0x8000 - cosine, a = lobe.slope * lambda >> 8;
        const uint16_t now = burnish_composite_q15_at_cosine(&lobe, (uint16_t)cosine);
        if (n < 15) {
            q15_bound(found, n, lambda / 32768.0, lambda / 32768.0, now, &before);
        } else {
            q15_wrong(&found->all, now != q15_below(&lobe, a), n, cosine);
        }
    }
    before = 0xFFFF;
    for (uint32_t lambda = 0; lambda < 0x1000000 && lambda < 0xA000000 / n; lambda += stride) {
        const uint64_t a = (uint64_t)lobe.slope * lambda >> 17;
        const uint16_t now = burnish_composite_q15_at_lambda(&lobe, lambda);
        if (n < 15) {
            q15_bound(found, n, lambda / 16777216.0, lambda / 16777216.0, now, &before);
        } else {
            q15_wrong(&found->all, now != q15_below(&lobe, a), n, lambda);
        }
    }
}

static int q15_report_composites(const q15_composites *found) {
    int good = found->all.wrong == 0 && found->all.values > 0;
    printf("composite against cos^n: n < 15 %.3f, n = 15 %.3f, above %.3f  %llu\n", found->error[0],
           found->error[1], found->error[2], (unsigned long long)found->all.values);
    for (int range = 0; range < Q15_RANGES; ++range) {
        good = good && found->error[range] <= q15_composite_bounds[range];
    }
    if (found->all.wrong) {
        printf("FAIL: %llu results are out of order or unequal, one at n = %u, input %u\n",
               (unsigned long long)found->all.wrong, found->all.wrong_n, found->all.wrong_input);
    }
    return good;
}

#endif
