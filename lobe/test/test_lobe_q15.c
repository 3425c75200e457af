/* The integer lobes: the proofs of q15_proof.h over a part of the exponents, the steps over all
 * their inputs, how lobes are made, the boundary memory of theory.h. */
#include "support.h"

#include "burnish/theory.h"
#include "q15_proof.h"

/* Every exponent up to 20 and every 31st; `make prove-q15` checks all. */
static void test_proofs(void) {
    for (int i = 0; i < Q15_CASES; ++i) {
        q15_result cosines = {0}, lambdas = {0};
        for (uint32_t n = 1; n <= 1023; n += n < 20 ? 1 : 31) {
            q15_prove_cosines(&q15_cases[i], n, &cosines);
            q15_prove_lambdas(&q15_cases[i], n, 509, &lambdas);
        }
        CHECK(q15_report("cosine", &q15_cases[i], &cosines), "see the line above");
        CHECK(q15_report("lambda", &q15_cases[i], &lambdas), "see the line above");
    }
    for (int i = 0; i < 4; ++i) {
        q15_result any = {0};
        q15_prove_steps(q15_cases[i].order, &any);
        CHECK(q15_report("any", &q15_cases[i], &any), "see the line above");
    }
}

/* Every exponent up to 20 and every 31st. */
static void test_composites(void) {
    q15_composites found = {0};
    for (uint32_t n = 1; n <= 1023; n += n < 20 ? 1 : 31) {
        q15_prove_composite(n, 509, &found);
    }
    CHECK(q15_report_composites(&found), "see the line above");
    static const uint16_t wrong[] = {0, 1024, 0xFFFF};
    for (int i = 0; i < 3; ++i) {
        burnish_composite_q15 lobe = {9, 9, {9, 9, 9}, 9, 9};
        int bright = burnish_composite_q15_create(&lobe, wrong[i]) != BURNISH_Q15_ERROR_EXPONENT;
        for (uint32_t at = 0; at <= 0xFFFF; ++at) {
            bright += burnish_composite_q15_at_cosine(&lobe, (uint16_t)at) != 0;
            bright += burnish_composite_q15_at_lambda(&lobe, at) != 0;
        }
        CHECK(bright == 0, "exponent %d shines", wrong[i]);
    }
}

static void test_steps(void) {
    int wrong = 0;
    for (uint32_t x = 0; x <= 0xFFFF; ++x) {
        const uint64_t square = (uint64_t)x * x, y = x >> 7;
        wrong += burnish_q15_square(x) != square >> 16;
        wrong += burnish_q15_square_rounded((uint16_t)x) != (square + 0x8000) >> 16;
        wrong += burnish_q15_square_middle((uint16_t)x) != (square + x + 0x8000) >> 16;
        wrong += burnish_q15_square8(x) != (y * (y + 1) + 511) >> 10;
        wrong += burnish_q15_lambda((uint16_t)x) != (x > 0x8000 ? 0 : 0x8000 - x);
    }
    CHECK(wrong == 0, "%d steps of 16 bits are wrong", wrong);
    uint64_t state = test_seed(1);
    for (uint32_t i = 0; i < 4000000; ++i) {
        const uint32_t at = i < 1000   ? i
                            : i < 2000 ? 0xFFFFFFFFu - (i - 1000)
                                       : test_random32(&state);
        const uint64_t square = (uint64_t)at * at;
        wrong += burnish_q15_square_wide(at) != square >> 32;
        wrong += burnish_q15_round(at) != (at >= 0xFFFF8000u ? 0xFFFF : (at + 0x8000u) >> 16);
        wrong += burnish_q15_round8(at) != (at >= 0xFF800000u ? 0xFF : (at + 0x800000u) >> 24);
    }
    CHECK(wrong == 0, "%d steps of 32 bits are wrong", wrong);
}

static int is_dark(const burnish_lobe_q15 *lobe) {
    int bright = 0;
    for (uint32_t cosine = 0; cosine <= 0xFFFF; ++cosine) {
        bright += burnish_lobe_q15_fast(lobe, (uint16_t)cosine) != 0;
        bright += burnish_lobe_q15_near(lobe, (uint16_t)cosine) != 0;
        bright += burnish_lobe_q15_fast8(lobe, (uint16_t)cosine) != 0;
        bright += burnish_lobe_q15_wide(lobe, (uint16_t)cosine) != 0;
        bright += burnish_lobe_q15_fast_lambda(lobe, cosine) != 0;
        bright += burnish_lobe_q15_wide_lambda(lobe, cosine << 9) != 0;
    }
    return bright == 0;
}

/* An error leaves a lobe that is dark at every cosine and lambda. */
static void test_errors(void) {
    static const struct {
        int fit;
        uint16_t order, exponent;
        burnish_q15_status status;
    } wrong[] = {
        {BURNISH_Q15_TAYLOR, 3, 10, BURNISH_Q15_ERROR_ORDER},
        {BURNISH_Q15_TAYLOR, 32, 100, BURNISH_Q15_ERROR_ORDER},
        {BURNISH_Q15_SHIFT7, 4, 10, BURNISH_Q15_ERROR_ORDER},
        {BURNISH_Q15_SHIFT3, 4, 10, BURNISH_Q15_ERROR_ORDER},
        {BURNISH_Q15_TAYLOR, 2, 0, BURNISH_Q15_ERROR_EXPONENT},
        {BURNISH_Q15_ENERGY, 2, 1024, BURNISH_Q15_ERROR_EXPONENT},
        {BURNISH_Q15_ENERGY, 8, 7, BURNISH_Q15_ERROR_ORDER_FOR_EXPONENT},
        {99, 2, 10, BURNISH_Q15_ERROR_FIT},
    };
    burnish_lobe_q15 lobe;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        const burnish_q15_status status = burnish_lobe_q15_create(
            &lobe, (burnish_q15_fit)wrong[i].fit, wrong[i].order, wrong[i].exponent);
        CHECK(status == wrong[i].status, "case %zu: status %d", i, (int)status);
        CHECK(is_dark(&lobe), "case %zu shines", i);
    }
    CHECK(burnish_lobe_q15_from_zeta(&lobe, 0, 2) == BURNISH_Q15_ERROR_ZETA, "zeta 0");
    CHECK(burnish_lobe_q15_from_zeta(&lobe, 0x7FFF0001u, 2) == BURNISH_Q15_ERROR_ZETA, "zeta");
    CHECK(burnish_lobe_q15_from_zeta(&lobe, 65536, 5) == BURNISH_Q15_ERROR_ORDER, "order 5");
    CHECK(burnish_lobe_q15_from_slope(&lobe, 0, 3, 2) == BURNISH_Q15_ERROR_ZETA, "slope 0");
    CHECK(burnish_lobe_q15_from_slope(&lobe, 9, 16, 2) == BURNISH_Q15_ERROR_ZETA, "shift 16");
    CHECK(is_dark(&lobe), "the last one shines");
}

/* zeta keeps 16 significant bits, or 2^-16 below 1/2; slopes in UQ8.8 move it by at most 2^-10. */
static void test_zeta(void) {
    for (uint32_t zeta = 1; zeta <= BURNISH_Q15_ZETA_MAX; zeta += 1 + zeta / 29) {
        burnish_lobe_q15 lobe;
        const double wanted = zeta / 65536.0;
        CHECK(burnish_lobe_q15_from_zeta(&lobe, zeta, 2) == BURNISH_Q15_OK, "zeta %u", zeta);
        const double got = lobe.slope / (double)(2u << lobe.shift);
        const double off = got > wanted ? got - wanted : wanted - got;
        CHECK(off <= wanted / 65536 || off == 0, "zeta %g became %g", wanted, got);
        if (burnish_lobe_q15_align(&lobe) == BURNISH_Q15_OK) {
            const double aligned = lobe.slope / 512.0;
            CHECK(lobe.shift == 8 && aligned - got <= 1 / 1024.0 && got - aligned <= 1 / 1024.0,
                  "zeta %g was aligned to %g", got, aligned);
        } else {
            CHECK(wanted < .001 || wanted > 127.99, "zeta %g was not aligned", wanted);
        }
    }
}

/* The memory of `burnish-lobe boundary` in place of the lobe's own cutoff: with bits = 0 no result
 * changes; with 8, only results below 2^-8, and those beyond become 0. */
static void test_boundary(void) {
    burnish_theory_memory memory = {.format = {0, 0, 15}, .rounding = BURNISH_THEORY_DOWN};
    CHECK(burnish_lobe_spec_parse("energy:2", &memory.lobe, NULL) == BURNISH_STATUS_OK, "lobe");
    for (int n = 1; n <= 1023; n += n < 20 ? 1 : 13) {
        const double exponent = n;
        int64_t cutoff, threshold;
        burnish_lobe_q15 own, stored, cut;
        int changed = 0, bright = 0;
        memory.bits = 0;
        CHECK(burnish_theory_memory_fill(&memory, &exponent, 1, &cutoff, NULL) == BURNISH_STATUS_OK,
              "0");
        memory.bits = 8;
        CHECK(burnish_theory_memory_fill(&memory, &exponent, 1, &threshold, NULL) ==
                  BURNISH_STATUS_OK,
              "8");
        burnish_lobe_q15_create(&own, BURNISH_Q15_ENERGY, 2, (uint16_t)n);
        stored = cut = own;
        burnish_lobe_q15_set_boundary(&stored, (uint16_t)cutoff);
        burnish_lobe_q15_set_boundary(&cut, (uint16_t)threshold);
        CHECK(own.reach - stored.reach <= 1, "n = %d: reach %d, stored %d", n, own.reach,
              stored.reach);
        for (uint32_t cosine = 0; cosine <= 0x8001; ++cosine) {
            const uint16_t lobe = burnish_lobe_q15_fast(&own, (uint16_t)cosine);
            const uint16_t dimmed = burnish_lobe_q15_fast(&cut, (uint16_t)cosine);
            changed += burnish_lobe_q15_fast(&stored, (uint16_t)cosine) != lobe;
            bright += dimmed != lobe && (dimmed != 0 || lobe > 256);
        }
        CHECK(changed == 0, "n = %d: the cutoff changes %d results", n, changed);
        CHECK(bright == 0, "n = %d: the threshold changes %d bright results", n, bright);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_proofs());
    RUN(test_composites());
    RUN(test_steps());
    RUN(test_errors());
    RUN(test_zeta());
    RUN(test_boundary());
    return test_end("lobe_q15");
}
