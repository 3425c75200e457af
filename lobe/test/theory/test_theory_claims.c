/* The paper's claims: verdicts, and values against formulas evaluated elsewhere (mpmath, or sums in
 * plain double precision that know the two lobes only). */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

static double claimed(const burnish_theory_claim *claim, const char *label) {
    for (int i = 0; i < claim->count; ++i) {
        if (strcmp(claim->values[i].label, label) == 0) {
            return claim->values[i].value;
        }
    }
    printf("claim %s has no value \"%s\"\n", claim->id, label);
    return NAN; /* fails every comparison */
}

/* Independently computed values of the claims. */
static const struct {
    const char *id, *label;
    double value, tolerance;
} figures[] = {
    {"core-w", "n=65536", 7.26, .005},
    {"core-schlick", "n=65536", 9.91, .006},
    {"w1-absolute", "n=65536", .0916, .00005},
    {"w05-large", "7n/16 n=65536", .027, .0005},
    {"w05-large", "level(.5) n=65536", .022, .0005},
    {"w05-large", "to inflection n=100", .0147, .00005},
    /* largest |W_0.5 - c^n| over 20,000 cosines */
    {"w05-large", "to level .5 n=65536", .01454, .000005},
    {"w05-small", "7n/16 n=3", .032, .0005},
    {"schlick-absolute", "n=100", .0600, .00005},
    {"schlick-ratio", "as stated n=100", 2.41, .005},
    {"schlick-ratio", "to inflection n=100", 4.1, .05},
    {"schlick-ratio", "to level .45 n=100", 4.23, .005},
    {"core-better", "n=2", 0, 1e-12},
    {"core-better", "n=65536", 7.2593 / 9.9148, 1e-5},
    /* acos(1 - (1 - 2^(-q/2)) 2/n) over acos(n / (2^q + n - 1)) */
    /* (1 - 2/3)^2 where the cosine itself is 0 */
    {"w1-absolute", "n=1", 1. / 9, 1e-9},
    {"w1-extreme", "W1 there n=10", 4. / 9, 1e-7},
    /* 4/(7n - 8) over 3/(4n - 2) and over 1/(2n - 2) */
    {"w05-radius-larger", "over W1's n=100", 4. / 692 / (3. / 398), 1e-12},
    {"w05-radius-larger", "over W's n=100", 4. / 692 * 198, 1e-12},
    /* the power's least (1 + f'^2)^(3/2) / |f''| beyond its inflection, and at W's end */
    {"radius-classic", "power at its foot n=1000", .26671613882071, 1e-5},
    {"radius-classic", "power where W ends n=1000", 2.71204429455999, 1e-12},
    {"radius-classic", "power at peak n=100", .1, 1e-14},
    {"radius-classic", "W at its zero n=100", 18. / 198, 1e-14},
    {"blooming-schlick", "n=10 q=8", .40596710680, 1e-10},
    /* largest and least of max(0, 1 - (n+1)/3 (1-c))^2 - c^n over 200,001 cosines */
    {"w1-even", "W1 n=100", 1.57851297, 1e-7},
    {"w1-even", "minimax n=100", 1, 1e-12},
    /* 2 zeta sin sqrt(Q), zeta = (1 + sqrt Q)/(1 - Q^(1/n)), cos = Q^(1/n) */
    {"level-second-root", "Q=0.5 n=100", 41.0089662765, 1e-9},
    /* least of max |W_Q - c^n| and of the mean squares, over 2,500 to 20,000 angles */
    {"level-best", "cosine rms to 90 degrees n=10", .24130, 2e-4},
    {"level-best", "cosine rms to inflection n=10", .68398, 4e-4},
    {"level-best", "max to 90 degrees n=100", .23453, 2e-4},
    {"level-best", "max to level .45 n=100", .53532, 2e-4},
    {"level-best", "cosine rms to level .45 n=100", .56779, 4e-4},
    {"level-best", "max to inflection n=100", .66845, 2e-4},
    {"level-best", "angle rms to 90 degrees n=10", .28674, 2e-5},
    {"level-best", "angle rms to level .45 n=10", .59010, 2e-5},
    {"level-best", "angle rms to inflection n=100", .70882, 2e-5},
    /* the slope (1 - sqrt .5)/(1 - .5^(1/n)), and where (1 - 7n/16 x)^2 crosses (1 - x)^n */
    {"w05-slope", "slopes n=100", 1.03178669, 1e-8},
    {"w05-slope", "slope/n of Q=0.5 n=65536", .4225578, 1e-7},
    {"w05-slope", "Q of 7n/16 n=65536", .57892489, 1e-8},
    {"w05-slope", "7n/16 at level .5 n=100", .4869202002, 1e-9},
    {"w05-slope", "core % 7n/16 n=100", 1.92518, 1e-4},
    {"w05-slope", "core % Q=0.5 n=100", 2.98156, 1e-4},
    {"w05-large", "best Q n=100", .01783, 2e-5},
    /* 2 sin(x/2) instead of x */
    {"chord", "angle 10 degrees", .1268756, 1e-7},
    {"chord", "angle 90 degrees", 9.9683684, 1e-7},
    {"chord", "1 - cos 45 degrees", 0, 1e-12},
    /* one zero at the cosine 1 - 2/n, below 90 degrees for n > 2; (n/2 - 1)^2 */
    {"positive", "power n=50", 0, 0},
    {"positive", "the square n=2", 0, 0},
    {"positive", "the square n=50", 1, 0},
    {"positive", "square at 90 degrees n=50", 576, 1e-9},
    {"taylor-terms", "power n=100", 1, 1e-6},
    {"integrals", "W1 / power n=100", 1, 1e-12},
    /* c/(n - nc + c) - c^n over 3,000 cosines; its integral by quadrature over c */
    {"schlick-beyond", "n=100", 3.352216, 1e-5},
    {"schlick-beyond", "beyond n=100", .2010798, 1e-6},
    {"schlick-fades", "solid angle n=100", 13.31625, 1e-5},
    {"schlick-fades", "energy n=100", 3.7254585, 1e-6},
    /* largest |lobe / c^n - 1| over 2,000 lambda to the inflection; NV2x by a root of its three
     * equal errors */
    {"relative-error", "error of GameCube", 9.8219615, 1e-6},
    {"relative-error", "error of NV2x", 3.4459, 1e-4},
    {"relative-error", "error of Kuijk-Blake", 1.08890, 1e-5},
    {"relative-error", "error of Gaussian", .26207926, 1e-6},
    {"relative-error", "error of W1", 14.20813, 1e-5},
    {"relative-error", "share worse than W", .5, 1e-12},
    {"relative-error", "share worse than W_0.5", .75, 1e-12},
    {"hardware-others", "Schlick", 1, 0},
    {"hardware-others", "Lyon, order 2", 0, 0},
    /* 1 - (1 - n/2 x)^2, x = (1 - l (1 + e/2 + 3e^2/8))^2 / 2, e = 1 - l^2 */
    {"lyon-series", "30 degrees n=1000", .00046459105, 1e-10},
    {"lyon-series", "60 degrees n=100", .14704209330, 1e-10},
    {"lyon-series", "90 degrees n=1000", 85.60853855390, 1e-10},
    /* the same with x = (1 - l)^2 / 2, and x = 1 - l */
    {"lyon-lengths", "chord 30 degrees n=100", 5.72099435106, 1e-10},
    {"lyon-lengths", "chord 60 degrees n=10", 8.77323777248, 1e-10},
    {"lyon-lengths", "cosine 20 degrees n=100", 94.22137774340, 1e-10},
    {"lyon-accuracy", "order 2 0 degrees n=100", 1, 1e-5},
    {"lyon-accuracy", "order 4 0 degrees n=100", .4463531941, 1e-6},
    /* at n = 1000 the peak loses most: (1 - (1 - l)^2 / 2 n/m)^m with l after the series */
    {"lyon-accuracy", "order 8 90 degrees n=1000", 4.5808, 1e-4},
    {"lyon-taylor", "order 2 n=100", 100. / 198, 1e-12},
    /* of max(0, 1 - a x)^2 - max(0, 1 - b x)^2 the largest is (b - a) / (b + a) */
    {"integer-zeta", "W_0.5 n=21", .1875 / 18.1875, 1e-8},
    {"integer-zeta", "W by n >> 1 n=101", .5 / 100.5, 1e-8}};
/* The claims of each verdict. */
enum { VERDICT_MAX = 18 };
static const char *const verdicts[][VERDICT_MAX] = {
    [BURNISH_THEORY_HOLDS] = {"peak", "taylor-terms", "zero", "monotone", "core-schlick",
                              "core-better", "order", "blooming-order", "radius", "integrals",
                              "w1-extreme", "level-second-root", "w05-zero", "schlick-absolute",
                              "w05-extreme", "w05-radius", "schlick-beyond", "schlick-fades"},
    [BURNISH_THEORY_HOLDS_IN_PART] = {"positive", "core-w", "blooming-schlick", "radius-classic",
                                      "w1-absolute", "w1-even", "level-best", "w05-slope",
                                      "w05-small", "schlick-ratio", "w05-radius-larger",
                                      "hardware-others", "relative-error", "chord", "lyon-accuracy",
                                      "lyon-series", "lyon-lengths", "integer-zeta"},
    [BURNISH_THEORY_DOES_NOT_HOLD] = {"w05-large", "lyon-taylor"},
    [BURNISH_THEORY_BENCHMARK] = {"speed-w", "speed-w05"},
    [BURNISH_THEORY_COUNTED] = {"operations-w", "operations-w05", "operations-schlick"}};

static int has_verdict(const burnish_theory_claim *claim) {
    int found = 0;
    for (int i = 0; i < VERDICT_MAX && verdicts[claim->verdict][i]; ++i) {
        found += strcmp(verdicts[claim->verdict][i], claim->id) == 0;
    }
    return found;
}

static void check_claims(void) {
    size_t count = burnish_theory_claim_count(), compared = 0;
    CHECK1(count == 43);
    for (size_t i = 0; i < count; ++i) {
        burnish_theory_claim claim;
        CHECK1(burnish_theory_claim_compute(i, &claim) == BURNISH_STATUS_OK);
        CHECK(has_verdict(&claim), "%s: %s", claim.id, burnish_theory_verdict_text(claim.verdict));
        CHECK_TEXT(claim.source, strcmp(claim.id, "lyon-lengths") == 0 ? "Lyon 1993" : "the paper");
        CHECK1((claim.verdict != BURNISH_THEORY_HOLDS_IN_PART) || claim.note[0]);
        CHECK1(claim.command[0] && claim.claim[0] &&
               (claim.count > 0) == (claim.relation != BURNISH_THEORY_NONE));
        for (size_t k = 0; k < sizeof figures / sizeof figures[0]; ++k) {
            if (strcmp(figures[k].id, claim.id) == 0) {
                double value = claimed(&claim, figures[k].label);
                CHECK(fabs(value - figures[k].value) <= figures[k].tolerance, "%s %s: %g", claim.id,
                      figures[k].label, value);
                ++compared;
            }
        }
    }
    CHECK1(compared == sizeof figures / sizeof figures[0]);
    burnish_theory_claim claim;
    CHECK1(burnish_theory_claim_compute(count, &claim) == BURNISH_STATUS_ARGUMENT);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_claims());
    return test_end("theory_claims");
}
