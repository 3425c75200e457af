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

/* The angles between the normals of two vertices; midway, their mean is cos(angle / 2) long. */
static const double APART[] = {20, 30, 60, 90};
enum { APART_COUNT = 4 };

static double mean_length(double degrees) {
    return cos(degrees * BURNISH_PI / 360);
}

static double length_after_series(double degrees) {
    const double length = mean_length(degrees);
    return length * burnish_theory_lyon_normalize_factor(length * length);
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
        const double degrees = APART[i % APART_COUNT];
        const double lambda = chord_lambda(length_after_series(degrees));
        burnish_claim_add(claim, 1, peak_loss(n[i / APART_COUNT], lambda), "%g degrees n=%g",
                          degrees, n[i / APART_COUNT]);
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

/* The largest error of Lyon's lobe, over all angles, where a normal of that length after Lyon's
 * series meets a unit vector. */
static double lyon_error(double n, int order, double length) {
    enum { SWEEP = 5000 };
    burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n);
    double largest = 0;
    for (int k = 0; k <= SWEEP; ++k) {
        const double s = (double)k / SWEEP, lambda = s * s;
        const double square = (1 - length) * (1 - length) + 2 * length * lambda;
        largest = fmax(largest, fabs(burnish_theory_family(n / order, order, 1 - 0.5 * square) -
                                     burnish_theory_value_at_lambda(&power, lambda)));
    }
    return largest;
}

static void lyon_accuracy(burnish_theory_claim *claim) {
    static const double n[] = {16, 100, 1000};
    static const double apart[] = {0, 90};
    for (int i = 0; i < 18; ++i) {
        const int order = 2 << i % 3;
        const double degrees = apart[i / 3 % 2], exponent = n[i / 6];
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, exponent);
        burnish_claim_add(claim, order > 2,
                          lyon_error(exponent, order, length_after_series(degrees)) /
                              burnish_theory_maximum_error(&w, 0.5 * BURNISH_PI),
                          "order %d %g degrees n=%g", order, degrees, exponent);
    }
}

/* The square's coefficient in Lyon's polynomial of lambda, over that of cos^n. */
static void lyon_taylor(burnish_theory_claim *claim) {
    static const double n[] = {16, 100, 1000};
    for (int i = 0; i < 9; ++i) {
        const double m = 2 << i % 3, exponent = n[i / 3];
        burnish_claim_add(claim, 1, (1 - 1 / m) / (1 - 1 / exponent), "order %g n=%g", m, exponent);
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
    static const int n[] = {3, 16, 21, 101, 1001, 1008};
    for (int i = 0; i < 6; ++i) {
        const int w = n[i] >> 1, half = ((n[i] << 3) - n[i]) >> 4;
        burnish_claim_add(claim, 1, largest_difference(half, 0.4375 * n[i]), "W_0.5 n=%d", n[i]);
        burnish_claim_add(claim, 0, largest_difference(w, 0.5 * n[i]), "W by n >> 1 n=%d", n[i]);
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
    {"lyon-taylor", "Lyon expands cos^n into a Taylor series",
     "coefficient of (1 - cos)^2 in Lyon's polynomial, over that of cos^n",
     "Lyon's lobe is (1 - n (1 - cos)/m)^m, whose limit for large m is an exponential; a Taylor "
     "polynomial of the same degree has the coefficients of cos^n",
     BURNISH_CLAIM_SHOW("lyon-taylor"), BURNISH_THEORY_ABOUT, 1, 1e-6, lyon_taylor, 0, NULL},
    {"lyon-accuracy", "so Lyon's approximation is not accurate enough",
     "its largest absolute error over W's, midway between normals that far apart",
     "not true of unit vectors, of which order 2 is W (*) and every further squaring halves the "
     "error; true of high exponents where normals are far apart",
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
     "instructions of three processors and cells of the circuit: firmware/operations.csv; the "
     "paper's conclusion counts multiplication, subtraction and decrement only",
     "make operations", BURNISH_THEORY_NONE, 2, 1, NULL, BURNISH_THEORY_COUNTED, NULL},
    {"operations-w05",
     "W_0.5 takes 2 multiplications, a decrement, an increment, a subtraction and 7 shift places",
     "", "the same table", "make operations", BURNISH_THEORY_NONE, 2, 1, NULL,
     BURNISH_THEORY_COUNTED, NULL},
    {"operations-schlick", "Schlick's lobe takes a multiplication, a division and a decrement", "",
     "the same table; c / (n - (n - 1) c) also takes the subtraction from n", "make operations",
     BURNISH_THEORY_NONE, 3, 1, NULL, BURNISH_THEORY_COUNTED, NULL},
    {"integer-zeta", "in integers 7n/16 is (8n - n) >> 4",
     "largest difference of the lobe from that of the exact zeta, without fraction bits",
     "exact for multiples of 16; the paper does not say that it drops the fraction, and for W "
     "counts "
     "a shift only (*); burnish keeps 7n whole and shifts the product",
     BURNISH_CLAIM_SHOW("integer-zeta"), BURNISH_THEORY_AT_MOST, 0, 0, integer_zeta, 0, NULL},
    {0},
};
