/* The paper's claims of Schlick's lobe and of the other methods. */
#include <math.h>

#include "theory/claims.h"

/* The largest absolute error at 5000 angles beyond the inflection of cos^n. */
static double error_beyond(const burnish_theory_model *model) {
    enum { SWEEP = 5000 };
    burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, model->exponent);
    double start = burnish_theory_inflection_angle(model->exponent), largest = 0;
    for (int k = 0; k <= SWEEP; ++k) {
        double s = (double)k / SWEEP, angle = start + (0.5 * BURNISH_PI - start) * s * s;
        largest = fmax(largest, fabs(burnish_theory_value_at_angle(model, angle) -
                                     burnish_theory_value_at_angle(&power, angle)));
    }
    return largest;
}

static void schlick_beyond(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000, 65536};
    for (int i = 0; i < 5; ++i) {
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        double core = burnish_theory_maximum_error(&schlick, burnish_theory_inflection_angle(n[i]));
        double beyond = error_beyond(&schlick);
        burnish_claim_add(claim, 1, beyond / core, "n=%g", n[i]);
        burnish_claim_add(claim, 0, core, "to inflection n=%g", n[i]);
        burnish_claim_add(claim, 0, beyond, "beyond n=%g", n[i]);
    }
}

static void schlick_fades(burnish_theory_claim *claim) {
    static const double n[] = {3, 10, 100, 1000};
    for (int i = 0; i < 4; ++i) {
        burnish_theory_model schlick = burnish_claim_other(BURNISH_LOBE_SCHLICK, n[i]);
        burnish_theory_model power = burnish_claim_other(BURNISH_LOBE_POWER, n[i]);
        burnish_claim_add(claim, 1,
                          burnish_theory_boundary_lambda(&schlick, 8) /
                              burnish_theory_boundary_lambda(&power, 8),
                          "solid angle n=%g", n[i]);
        burnish_claim_add(claim, 1,
                          burnish_theory_integral(&schlick, BURNISH_THEORY_SOLID_ANGLE) /
                              burnish_theory_integral(&power, BURNISH_THEORY_SOLID_ANGLE),
                          "energy n=%g", n[i]);
    }
}

/* The lobes of other authors in burnish, without tables; the last is younger than the paper. */
static const struct {
    burnish_lobe_kind kind;
    const char *name;
} RIVALS[] = {{BURNISH_LOBE_SCHLICK, "Schlick"},
              {BURNISH_LOBE_GX, "GameCube"},
              {BURNISH_LOBE_NV2X, "NV2x"},
              {BURNISH_LOBE_KUIJK_BLAKE, "Kuijk-Blake"},
              {BURNISH_LOBE_GAUSSIAN, "Gaussian"}};
enum { RIVAL_COUNT = sizeof RIVALS / sizeof RIVALS[0], OLDER_COUNT = RIVAL_COUNT - 1 };

static void relative_rivals(burnish_theory_claim *claim) {
    static const struct {
        burnish_lobe_fit fit;
        const char *name;
    } OURS[] = {
        {BURNISH_FIT_TAYLOR, "W"}, {BURNISH_FIT_ENERGY, "W1"}, {BURNISH_FIT_SHIFT7, "W_0.5"}};
    const double n = 100;
    double errors[RIVAL_COUNT];
    for (int i = 0; i < RIVAL_COUNT; ++i) {
        burnish_theory_model rival = burnish_claim_other(RIVALS[i].kind, n);
        errors[i] = burnish_claim_core_relative(&rival);
        burnish_claim_add(claim, 0, errors[i], "error of %s", RIVALS[i].name);
    }
    for (int k = 0; k < 3; ++k) {
        burnish_theory_model model = burnish_claim_lobe(OURS[k].fit, n);
        const double error = burnish_claim_core_relative(&model);
        int worse = 0;
        for (int i = 0; i < OLDER_COUNT; ++i) {
            worse += errors[i] > error;
        }
        burnish_claim_add(claim, 0, error, "error of %s", OURS[k].name);
        burnish_claim_add(claim, 1, (double)worse / OLDER_COUNT, "share worse than %s",
                          OURS[k].name);
    }
}

/* The parts of a circuit other than multipliers and adders. */
static double costly(const burnish_theory_model *model) {
    burnish_theory_cost cost = burnish_theory_model_cost(model);
    return cost.divisions + cost.transcendentals + cost.lookups;
}

static void hardware_others(burnish_theory_claim *claim) {
    const double n = 64;
    for (int i = 0; i < RIVAL_COUNT; ++i) {
        burnish_theory_model rival = burnish_claim_other(RIVALS[i].kind, n);
        burnish_claim_add(claim, 1, costly(&rival), "%s", RIVALS[i].name);
    }
    for (int order = 2; order <= 8; order *= 2) {
        burnish_theory_model lyon;
        (void)burnish_theory_model_create(
            &lyon, &(burnish_lobe_spec){.kind = BURNISH_LOBE_LYON, .order = order}, n);
        burnish_claim_add(claim, 1, costly(&lyon), "Lyon, order %d", order);
        burnish_claim_add(claim, 0, burnish_theory_model_cost(&lyon).multiplications,
                          "multiplications, order %d", order);
    }
}

const burnish_claim_source burnish_claims_others[] = {
    {"hardware-others", "the other methods have in common that they are complex in hardware",
     "divisions, transcendental functions and table look-ups of one value",
     "not true of Lyon's, which needs multiplications only: of order 2 as many as W (*)",
     BURNISH_CLAIM_SHOW("hardware-others"), BURNISH_THEORY_AT_LEAST, 1, 0, hardware_others, 0,
     NULL},
    {"relative-error",
     "abstract: the functions have less relative error than most widespread approximations",
     "share of the four older lobes whose error down to the inflection is larger, n = 100",
     "true of W and W_0.5, not of W1, if most are half or more; errors in per cent of the power "
     "(*); "
     "the Gaussian is of 2012, and burnish chose the constants of NV2x",
     BURNISH_CLAIM_SHOW("relative-error"), BURNISH_THEORY_AT_LEAST, 0.5, 0, relative_rivals, 0,
     NULL},
    {"schlick-beyond",
     "Schlick's lobe is satisfactory only within the epicentre; beyond it, it deviates",
     "largest absolute error beyond the inflection, over the largest down to it", "",
     BURNISH_CLAIM_SHOW("schlick-beyond"), BURNISH_THEORY_AT_LEAST, 1, 0, schlick_beyond, 0, NULL},
    {"schlick-fades", "Schlick's lobe fades slowly: unnatural light and superfluous computing",
     "solid angle above 2^-8, and energy, over the power's", "",
     BURNISH_CLAIM_SHOW("schlick-fades"), BURNISH_THEORY_AT_LEAST, 1, 0, schlick_fades, 0, NULL},
    {0},
};
