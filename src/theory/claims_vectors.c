/* The paper's claims of Lyon's vectors, of speed and of operations. */
#include <math.h>

#include "theory/claims.h"

/* ---- Lyon ---- */

/* The error of the chord as the angle, and of half its square as 1 - cos. */
static void chord(burnish_theory_claim *claim) {
    static const double degrees[] = {10, 30, 45, 60, 90};
    for (int i = 0; i < 5; ++i) {
        const double angle = degrees[i] * BURNISH_PI / 180;
        const double x = sin(angle), y = cos(angle) - 1, square = x * x + y * y;
        const double lambda = burnish_theory_lambda_of_angle(angle);
        burnish_claim_add(claim, degrees[i] > 10, 100 * (1 - sqrt(square) / angle),
                          "angle %g degrees", degrees[i]);
        burnish_claim_add(claim, degrees[i] > 10, 100 * fabs(0.5 * square / lambda - 1),
                          "1 - cos %g degrees", degrees[i]);
    }
}

static void lyon_accuracy(burnish_theory_claim *claim) {
    static const double n[] = {16, 100, 1000};
    for (int i = 0; i < 12; ++i) {
        const int order = 2 << i % 4;
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i / 4]), lyon;
        (void)burnish_theory_model_create(
            &lyon, &(burnish_lobe_spec){.kind = BURNISH_LOBE_LYON, .order = order}, n[i / 4]);
        burnish_claim_add(claim, order > 2,
                          burnish_theory_maximum_error(&lyon, 0.5 * BURNISH_PI) /
                              burnish_theory_maximum_error(&w, 0.5 * BURNISH_PI),
                          "order %d n=%g", order, n[i / 4]);
    }
}

/* The angles between the normals of two vertices; midway, their mean is cos(angle / 2) long. */
static const double APART[] = {20, 30, 60, 90};
enum { APART_COUNT = 4 };

static double mean_length(double degrees) {
    return cos(degrees * BURNISH_PI / 360);
}

/* The loss of W's peak, in per cent, at that lambda of two parallel vectors. */
static double peak_loss(double n, double lambda) {
    burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n);
    return 100 * (1 - burnish_theory_value_at_lambda(&w, lambda));
}

/* Half the squared chord of two parallel vectors, one of unit length. */
static double chord_lambda(double length) {
    return 0.5 * (1 - length) * (1 - length);
}

static void lyon_series(burnish_theory_claim *claim) {
    static const double n[] = {10, 100, 1000};
    for (int i = 0; i < 3 * APART_COUNT; ++i) {
        const double degrees = APART[i % APART_COUNT], length = mean_length(degrees);
        const double after = length * burnish_theory_lyon_normalize_factor(length * length);
        burnish_claim_add(claim, 1, peak_loss(n[i / APART_COUNT], chord_lambda(after)),
                          "%g degrees n=%g", degrees, n[i / APART_COUNT]);
    }
}

static void lyon_lengths(burnish_theory_claim *claim) {
    for (int i = 0; i < APART_COUNT; ++i) {
        const double length = mean_length(APART[i]), lambda = chord_lambda(length);
        burnish_claim_add(claim, 1, peak_loss(10, lambda), "chord %g degrees n=10", APART[i]);
        burnish_claim_add(claim, 1, peak_loss(100, lambda), "chord %g degrees n=100", APART[i]);
        burnish_claim_add(claim, 0, peak_loss(100, 1 - length), "cosine %g degrees n=100",
                          APART[i]);
    }
}

/* ---- The slope in integers ---- */

/* The largest difference of two lobes max(0, 1 - zeta lambda)^2, lambda in [0, 1]. */
static double largest_difference(double zeta, double other) {
    enum { STEPS = 65536 };
    double largest = 0;
    for (int i = 0; i <= STEPS; ++i) {
        double cosine = 1 - (double)i / STEPS;
        largest = fmax(largest, fabs(burnish_theory_family(zeta, 2, cosine) -
                                     burnish_theory_family(other, 2, cosine)));
    }
    return largest;
}

static void integer_zeta(burnish_theory_claim *claim) {
    static const int n[] = {3, 5, 16, 21, 101, 1001};
    for (int i = 0; i < 6; ++i) {
        const int w = n[i] >> 1, half = ((n[i] << 3) - n[i]) >> 4;
        burnish_claim_add(claim, 1, largest_difference(w, 0.5 * n[i]), "W n=%d", n[i]);
        burnish_claim_add(claim, 1, largest_difference(half, 0.4375 * n[i]), "W_0.5 n=%d", n[i]);
    }
}

/* ---- The list ---- */

/* Half a step of 8 bits, in per cent. */
#define INVISIBLE 0.196

const burnish_claim_source burnish_claims_vectors[] = {
    {"chord", "the chord in place of the angle changes little, but only at low angles",
     "per cent by which chord and angle differ, and half its square and 1 - cos",
     "true of the chord as an angle; but the lobe is made of half its square, which is 1 - cos at "
     "every angle (10 degrees: *)",
     BURNISH_CLAIM_SHOW("chord"), BURNISH_THEORY_AT_LEAST, 1, 0, chord, 0, NULL},
    {"lyon-accuracy", "Lyon's approximation is not accurate enough",
     "its largest absolute error over W's, vectors of unit length",
     "of order 2 it is W (*); every further squaring halves its error",
     BURNISH_CLAIM_SHOW("lyon-accuracy"), BURNISH_THEORY_AT_LEAST, 1, 0, lyon_accuracy, 0, NULL},
    {"lyon-series", "Lyon's three terms of 1/sqrt(N.N) do not normalize the normals",
     "per cent of W's peak lost midway between normals that far apart",
     "visible from 0.196 on, half a step of 8 bits: true of normals 60 degrees apart or more, and "
     "of high exponents; up to 30 degrees apart nothing is lost",
     BURNISH_CLAIM_SHOW("lyon-series"), BURNISH_THEORY_AT_LEAST, INVISIBLE, 0, lyon_series, 0,
     NULL},
    {"lyon-lengths", "Lyon's chord takes vectors that are not of unit length",
     "per cent of W's peak lost there without normalization",
     "only nearly: the chord is off by half the square of what the length lacks, the cosine (*) by "
     "all of it",
     BURNISH_CLAIM_SHOW("lyon-lengths"), BURNISH_THEORY_AT_MOST, INVISIBLE, 0, lyon_lengths, 0,
     "Lyon 1993"},
    {"speed-w", "W is 2.3 times as fast as Schlick's lobe (Pentium M)", "",
     "docs/performance.md has both forms, latency and throughput: section The paper's factors",
     "make bench", BURNISH_THEORY_NONE, 2.3, 0.1, NULL, BURNISH_THEORY_BENCHMARK, NULL},
    {"speed-w05", "W_0.5 is 1.69 times as fast as Schlick's lobe (Pentium M)", "",
     "docs/performance.md has both forms, latency and throughput: section The paper's factors",
     "make bench", BURNISH_THEORY_NONE, 1.69, 0.01, NULL, BURNISH_THEORY_BENCHMARK, NULL},
    {"operations-w", "W takes 2 multiplications, a shift, an increment and a decrement", "",
     "instructions of three processors and cells of the circuit: the table of operations in "
     "docs/theory.md",
     "make operations", BURNISH_THEORY_NONE, 2, 1, NULL, BURNISH_THEORY_COUNTED, NULL},
    {"operations-w05",
     "W_0.5 takes 2 multiplications, a decrement, an increment, a subtraction and 7 shift places",
     "", "the same table", "make operations", BURNISH_THEORY_NONE, 2, 1, NULL,
     BURNISH_THEORY_COUNTED, NULL},
    {"operations-schlick", "Schlick's lobe takes a multiplication, a division and a decrement", "",
     "the same table; c / (n - (n - 1) c) also takes the subtraction from n", "make operations",
     BURNISH_THEORY_NONE, 3, 1, NULL, BURNISH_THEORY_COUNTED, NULL},
    {"integer-zeta", "in integers zeta is n >> 1 for W and (8n - n) >> 4 for W_0.5",
     "largest difference of the lobe from that of the exact zeta",
     "exact for multiples of 2 and of 16; burnish keeps n and 7n whole and shifts the product",
     BURNISH_CLAIM_SHOW("integer-zeta"), BURNISH_THEORY_AT_MOST, 0, 0, integer_zeta, 0, NULL},
    {0},
};
