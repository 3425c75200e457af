/* The cost of lobes, and the cheapest one within an error. */
#include <math.h>

#include "theory/internal.h"

burnish_theory_cost burnish_theory_model_cost(const burnish_theory_model *model) {
    burnish_theory_cost cost = {0, 0, 1, 0, 0, 0, 0};
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON: /* A c + B, max, squarings */
        cost.multiplications = cost.additions = 1;
        for (int power = 1; power < model->lobe.order; power *= 2) {
            ++cost.multiplications;
        }
        break;
    case BURNISH_LOBE_COMPOSITE: /* top - slope lambda, max, a square, v (v + offset) */
        cost.multiplications = model->steps + 2;
        cost.additions = model->steps + 1;
        break;
    case BURNISH_LOBE_POWER:
        cost.multiplications = model->steps;
        cost.transcendentals = !model->is_product;
        break;
    case BURNISH_LOBE_SCHLICK: /* c / (n - (n - 1) c) */
        cost.multiplications = cost.additions = cost.divisions = 1;
        break;
    case BURNISH_LOBE_GAUSSIAN: /* exp(k c - k), positive everywhere */
        cost.multiplications = cost.additions = cost.transcendentals = 1;
        cost.comparisons = 0;
        break;
    case BURNISH_LOBE_GX: /* t = c c, t / (A + B t) */
        cost.multiplications = 2;
        cost.additions = cost.divisions = 1;
        break;
    case BURNISH_LOBE_NV2X:
        cost.multiplications = cost.divisions = 1;
        cost.additions = 2;
        break;
    case BURNISH_LOBE_KUIJK_BLAKE: /* the piece, then its square, its factor and an offset */
        cost.multiplications = cost.comparisons = cost.additions = 2;
        cost.transcendentals = 1;
        break;
    case BURNISH_LOBE_TABLE: /* index, rounding; linear: fraction, difference, sum */
        cost.multiplications = model->lobe.linear ? 2 : 1;
        cost.additions = model->lobe.linear ? 3 : 1;
        cost.lookups = model->lobe.linear ? 2 : 1;
        cost.memory = model->lobe.entries;
        break;
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT: /* a model has the lobe itself */
    case BURNISH_LOBE_KIND_COUNT:
        break;
    }
    return cost;
}

static int order_of(long a, long b) {
    return (a > b) - (a < b);
}

int burnish_theory_cost_order(const burnish_theory_cost *a, const burnish_theory_cost *b) {
    int order = order_of(a->transcendentals, b->transcendentals);
    order = order ? order : order_of(a->divisions, b->divisions);
    order = order ? order : order_of(a->lookups, b->lookups);
    return order ? order
                 : order_of(a->multiplications + a->additions + a->comparisons,
                            b->multiplications + b->additions + b->comparisons);
}

/* Lobes outside the family that can be drawn; cos^n is the initial choice. */
static const burnish_lobe_kind OTHERS[] = {BURNISH_LOBE_SCHLICK, BURNISH_LOBE_GAUSSIAN,
                                           BURNISH_LOBE_GX};

/* The best lobe so far. */
typedef struct {
    double epsilon, maximum;
    burnish_theory_model model;
    burnish_theory_cost cost;
} choice;

static void try_model(choice *best, const burnish_theory_model *model) {
    burnish_theory_cost cost = burnish_theory_model_cost(model);
    int order = burnish_theory_cost_order(&cost, &best->cost);
    if (order > 0) {
        return; /* more expensive: its error does not matter */
    }
    double maximum = burnish_theory_maximum_error(model, 0.5 * BURNISH_PI);
    if (maximum <= best->epsilon && (order < 0 || maximum < best->maximum)) {
        best->maximum = maximum;
        best->model = *model;
        best->cost = cost;
    }
}

burnish_status burnish_theory_choose(double exponent, double epsilon, int affine,
                                     burnish_theory_model *model, burnish_theory_cost *cost,
                                     double *maximum, burnish_error *error) {
    choice best = {epsilon, 0, {.exponent = 0}, {0}};
    if (!model || !(epsilon > 0 && epsilon < 1)) {
        return burnish_theory_fail(error, "choose: the error allowed, %g, must be between 0 and 1",
                                   epsilon);
    }
    burnish_lobe_status status = burnish_theory_model_create(
        &best.model, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER}, exponent);
    if (status != BURNISH_LOBE_OK) {
        return burnish_theory_fail(error, "choose: exponent %g: %s", exponent,
                                   burnish_lobe_status_text(status));
    }
    best.cost = burnish_theory_model_cost(&best.model);
    for (int i = 0; i < 10; ++i) { /* lower orders first: more expensive ones stop early */
        burnish_theory_model candidate;
        burnish_lobe_fit fit = i % 2 ? BURNISH_FIT_AFFINE : BURNISH_FIT_MINIMAX;
        if ((i % 2 == 0 || affine) &&
            burnish_theory_model_create(&candidate,
                                        &(burnish_lobe_spec){.fit = fit, .order = 2 << i / 2},
                                        exponent) == BURNISH_LOBE_OK) {
            try_model(&best, &candidate);
        }
    }
    for (int order = 3; order <= 6; ++order) {
        burnish_theory_model candidate;
        (void)burnish_theory_model_create(
            &candidate, &(burnish_lobe_spec){.kind = BURNISH_LOBE_COMPOSITE, .order = order},
            exponent);
        try_model(&best, &candidate);
    }
    for (size_t i = 0; i < sizeof OTHERS / sizeof OTHERS[0]; ++i) {
        burnish_theory_model candidate;
        if (burnish_theory_model_create(&candidate, &(burnish_lobe_spec){.kind = OTHERS[i]},
                                        exponent) == BURNISH_LOBE_OK) {
            try_model(&best, &candidate);
        }
    }
    *model = best.model;
    if (cost) {
        *cost = best.cost;
    }
    if (maximum) {
        *maximum = best.maximum;
    }
    return BURNISH_STATUS_OK;
}
