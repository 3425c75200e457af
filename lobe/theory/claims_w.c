/* The paper's claims of W and of Schlick's lobe: shape, core, blooming, curvature. */
#include <math.h>

#include "theory/claims.h"

enum { SWEEP = 5000 };

static void peak(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 100, 65536};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_claim_add(claim, 1, burnish_theory_value_at_angle(&w, 0), "W n=%g", n[i]);
        burnish_claim_add(claim, 1, burnish_theory_value_at_angle(&power, 0), "power n=%g", n[i]);
    }
}

/* How many angles have no positive value of the square that W is made of: SWEEP angles below 90
 * degrees, and W's zero if it is one of them. */
static int not_positive_square(const burnish_theory_model *w) {
    int count = w->zeta > 1;
    for (int k = 0; k < SWEEP; ++k) {
        double u = 1 - w->zeta * burnish_theory_lambda_of_angle(0.5 * BURNISH_PI * k / SWEEP);
        count += !(u * u > 0);
    }
    return count;
}

static int not_positive(const burnish_theory_model *model) {
    int count = 0;
    for (int k = 0; k < SWEEP; ++k) {
        count += !(burnish_theory_value_at_angle(model, 0.5 * BURNISH_PI * k / SWEEP) > 0);
    }
    return count;
}

static void positive(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 50};
    for (int i = 0; i < 3; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_claim_add(claim, 1, not_positive(&power), "power n=%g", n[i]);
        burnish_claim_add(claim, 1, not_positive_square(&w), "the square n=%g", n[i]);
        burnish_claim_add(claim, 0, (1 - w.zeta) * (1 - w.zeta), "square at 90 degrees n=%g", n[i]);
    }
}

/* (1 - S) / angle^2 near the peak, over n/2. */
static void taylor_terms(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 100, 65536};
    for (int i = 0; i < 4; ++i) {
        const burnish_theory_model models[] = {burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]),
                                               burnish_claim_other(BURNISH_LOBE_POWER, n[i])};
        const double angle = 1e-3 / sqrt(n[i]);
        for (int k = 0; k < 2; ++k) {
            double lost = 1 - burnish_theory_value_at_angle(&models[k], angle);
            burnish_claim_add(claim, 1, lost / (angle * angle) / (0.5 * n[i]), "%s n=%g",
                              k ? "power" : "W", n[i]);
        }
    }
}

static void zero(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000};
    for (int i = 0; i < 5; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        double angle = burnish_theory_zero_angle(&w), cosine = (n[i] - 2) / n[i];
        burnish_claim_add(claim, 1, fabs(cos(angle) - cosine), "place n=%g", n[i]);
        burnish_claim_add(claim, 1, burnish_theory_value(&w, cosine), "value n=%g", n[i]);
    }
}

static void monotone(burnish_theory_claim *claim) {
    static const double n[] = {2, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        double end = burnish_theory_zero_angle(&w), before = 1, rise = 0;
        for (int k = 1; k <= SWEEP; ++k) {
            double value = burnish_theory_value_at_angle(&w, end * k / SWEEP);
            rise = value - before > rise ? value - before : rise;
            before = value;
        }
        burnish_claim_add(claim, 1, rise, "n=%g", n[i]);
    }
}

static void core_w(burnish_theory_claim *claim) {
    static const double n[] = {3, 5, 10, 100, 120, 140, 200, 1000, 65536};
    for (int i = 0; i < 9; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_claim_add(claim, 1, burnish_claim_core_relative(&w), "n=%g", n[i]);
    }
}

static void core_schlick(burnish_theory_claim *claim) {
    static const double n[] = {3, 5, 10, 100, 1000, 65536};
    for (int i = 0; i < 6; ++i) {
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_claim_add(claim, 1, burnish_claim_core_relative(&schlick), "n=%g", n[i]);
    }
}

/* W's largest relative error over Schlick's. */
static void core_ratio(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 5, 10, 100, 1000, 65536};
    for (int i = 0; i < 7; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_claim_add(claim, 1,
                          burnish_claim_core_relative(&w) / burnish_claim_core_relative(&schlick),
                          "n=%g", n[i]);
    }
}

static void ordering(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000, 65536};
    for (int i = 0; i < 6; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        double above = -1, below = -1;
        for (int k = 0; k <= SWEEP; ++k) {
            double s = (double)k / SWEEP, lambda = s * s;
            double p = burnish_theory_value_at_lambda(&power, lambda);
            above = fmax(above, burnish_theory_value_at_lambda(&w, lambda) - p);
            below = fmax(below, p - burnish_theory_value_at_lambda(&schlick, lambda));
        }
        burnish_claim_add(claim, 1, above, "W - power n=%g", n[i]);
        burnish_claim_add(claim, 1, below, "power - Schlick n=%g", n[i]);
    }
}

/* ---- Blooming: the angle at which a lobe falls to 2^-q ---- */

/* The least ratio of the angles over 1 to 16 bits. */
static double least_ratio(const burnish_theory_model *wide, const burnish_theory_model *narrow) {
    double least = INFINITY;
    for (int bits = 1; bits <= 16; ++bits) {
        double level = ldexp(1, -bits);
        least = fmin(least,
                     burnish_theory_angle_at(wide, level) / burnish_theory_angle_at(narrow, level));
    }
    return least;
}

static void blooming_order(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000, 65536};
    for (int i = 0; i < 6; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_claim_add(claim, 1, least_ratio(&power, &w), "power / W n=%g", n[i]);
        burnish_claim_add(claim, 1, least_ratio(&schlick, &power), "Schlick / power n=%g", n[i]);
    }
}

static void blooming_schlick(burnish_theory_claim *claim) {
    static const double n[] = {2, 3, 10, 100, 1000};
    static const double bits[] = {4, 8, 12};
    for (int i = 0; i < 15; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i / 3]);
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i / 3]);
        double level = exp2(-bits[i % 3]);
        burnish_claim_add(
            claim, 1, burnish_theory_angle_at(&w, level) / burnish_theory_angle_at(&schlick, level),
            "n=%g q=%g", n[i / 3], bits[i % 3]);
    }
}

/* ---- Curvature ---- */

static void radius(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_claim_add(claim, 1, burnish_theory_zero_curvature_radius(&w) * (2 * n[i] - 2),
                          "n=%g", n[i]);
    }
}

/* The sharpest bend of cos^n beyond its inflection. */
static double sharpest_radius(const burnish_theory_model *power) {
    double start = burnish_theory_inflection_angle(power->exponent), least = INFINITY;
    for (int i = 1; i < SWEEP; ++i) {
        double angle = start + (0.5 * BURNISH_PI - start) * i / SWEEP;
        least = fmin(least, burnish_theory_curvature_radius(power, angle));
    }
    return least;
}

static void radius_classic(burnish_theory_claim *claim) {
    static const double n[] = {10, 100, 1000};
    double before[4] = {0};
    for (int i = 0; i < 3; ++i) {
        burnish_theory_model w = burnish_claim_lobe(BURNISH_FIT_TAYLOR, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        const double now[4] = {
            burnish_theory_zero_curvature_radius(&w), burnish_theory_curvature_radius(&power, 0),
            sharpest_radius(&power),
            burnish_theory_curvature_radius(&power, burnish_theory_zero_angle(&w))};
        static const char *const what[] = {"W at its zero", "power at peak", "power at its foot",
                                           "power where W ends"};
        for (int k = 0; k < 4 && i > 0; ++k) {
            burnish_claim_add(claim, 1, now[k] / before[k], "%s n=%g", what[k], n[i]);
        }
        for (int k = 0; k < 4; ++k) {
            before[k] = now[k];
        }
    }
}

const burnish_claim_source burnish_claims_w[] = {
    {"peak", "W and the power are both 1 at angle 0", "value at angle 0", "",
     BURNISH_CLAIM_SHOW("peak"), BURNISH_THEORY_ABOUT, 1, 0, peak, 0, NULL},
    {"positive", "W and the power are positive from 0 to 90 degrees",
     "angles below 90 degrees, of 5000 and the zero, without a positive value",
     "W's square is 0 at one angle, where the cosine is (n - 2)/n, and positive at all others; the "
     "lobe is cut off there because the square rises again",
     BURNISH_CLAIM_SHOW("positive"), BURNISH_THEORY_AT_MOST, 0, 0, positive, 0, NULL},
    {"taylor-terms", "the Taylor series of W and of the power both begin 1 - n/2 angle^2",
     "(1 - value)/angle^2 next to the peak, over n/2", "", BURNISH_CLAIM_SHOW("taylor-terms"),
     BURNISH_THEORY_ABOUT, 1, 1e-5, taylor_terms, 0, NULL},
    {"zero", "W is zero where the cosine is (n - 2)/n", "distance of the cosines; value there", "",
     BURNISH_CLAIM_SHOW("zero"), BURNISH_THEORY_AT_MOST, 0, 0, zero, 0, NULL},
    {"monotone", "W falls all the way to its zero",
     "largest rise between neighbours of 5000 angles", "", BURNISH_CLAIM_SHOW("monotone"),
     BURNISH_THEORY_AT_MOST, 0, 0, monotone, 0, NULL},
    {"core-w", "down to the inflection of the power, W is off by 7.2 % of it at most",
     "largest relative error, per cent",
     "true up to n = 131, and rounded to one decimal up to n = 820; the limit for large n, 7.26 %, "
     "rounds to 7.3",
     BURNISH_CLAIM_SHOW("core-w"), BURNISH_THEORY_AT_MOST, 7.2, 0.1, core_w, 0, NULL},
    {"core-schlick", "in the same range Schlick's lobe is off by almost 10 %",
     "largest relative error, per cent", "", BURNISH_CLAIM_SHOW("core-schlick"),
     BURNISH_THEORY_AT_MOST, 10, 1, core_schlick, 0, NULL},
    {"core-better", "there W is more accurate than Schlick's lobe",
     "largest relative error of W, over that of Schlick's lobe", "",
     BURNISH_CLAIM_SHOW("core-better"), BURNISH_THEORY_AT_MOST, 1, 0, core_ratio, 0, NULL},
    {"order", "Schlick's lobe lies above the power, W below it",
     "largest violation over 5000 angles", "", BURNISH_CLAIM_SHOW("order"), BURNISH_THEORY_AT_MOST,
     0, 0, ordering, 0, NULL},
    {"blooming-order", "at every threshold W blooms least, then the power, then Schlick's lobe",
     "least ratio of the angles where two of them fall to 2^-q, q = 1 to 16", "",
     BURNISH_CLAIM_SHOW("blooming-order"), BURNISH_THEORY_AT_LEAST, 1, 0, blooming_order, 0, NULL},
    {"blooming-schlick", "W's blooming range is considerably smaller than Schlick's",
     "angle where W falls to 2^-q, over Schlick's",
     "considerably: to 0.8 of it or less; true from n = 3 on, down to a twentieth at n = 1000 and "
     "12 "
     "bits",
     BURNISH_CLAIM_SHOW("blooming-schlick"), BURNISH_THEORY_AT_MOST, 0.8, 0, blooming_schlick, 0,
     NULL},
    {"radius", "W meets zero with the curvature radius 1/(2n - 2)", "radius times (2n - 2)", "",
     BURNISH_CLAIM_SHOW("radius"), BURNISH_THEORY_ABOUT, 1, 0, radius, 0, NULL},
    {"radius-classic", "the radius decreases as n grows, as for the classic lobe, the power",
     "radius over the radius at a tenth of that n",
     "true of some radii: W's radius and the power's at its peak fall as 1/n, that of the power's "
     "foot more "
     "slowly, but where W ends the power gets flatter",
     BURNISH_CLAIM_SHOW("radius-classic"), BURNISH_THEORY_AT_MOST, 1, 0, radius_classic, 0, NULL},
    {0},
};
