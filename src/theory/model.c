/* Making models: which lobe, for which exponent. */
#include <math.h>

#include "theory/internal.h"

static const burnish_theory_model NOTHING = {
    .kind = BURNISH_THEORY_POWER, .exponent = 1, .scale = 1};

burnish_lobe_status burnish_theory_model_family(burnish_theory_model *model, burnish_theory_fit fit,
                                                int order, double exponent, double level) {
    burnish_theory_model made = {.kind = BURNISH_THEORY_FAMILY,
                                 .fit = fit,
                                 .order = order,
                                 .exponent = exponent,
                                 .level = fit == BURNISH_THEORY_LEVEL ? level : 0};
    burnish_lobe_status status =
        burnish_theory_solve(fit, order, exponent, level, &made.zeta, &made.scale);
    *model = status == BURNISH_LOBE_OK ? made : NOTHING;
    return status;
}

static void set_nv2x(burnish_theory_model *model) {
    double a, b;
    burnish_theory_solve_moebius(model->exponent, &a, &b);
    model->zeta = a;
    model->k[0] = 1 / a - 1;
    model->k[1] = -b / a;
    model->k[2] = (1 + b) / a;
}

static void set_kuijk_blake(burnish_theory_model *model) {
    double n = model->exponent;
    model->k[0] = (n + 5.6) / (n * (0.09 * n + 5.2));
    model->k[1] = (n + 65) / (5 * n + 31.7);
}

burnish_lobe_status burnish_theory_model_other(burnish_theory_model *model,
                                               burnish_theory_kind kind, int order,
                                               double exponent) {
    burnish_lobe_status status =
        burnish_lobe_check(kind == BURNISH_THEORY_LYON ? order : 2, exponent);
    *model = NOTHING;
    if (kind == BURNISH_THEORY_FAMILY || kind == BURNISH_THEORY_TABLE ||
        (unsigned)kind >= BURNISH_THEORY_KIND_COUNT) {
        return BURNISH_LOBE_ERROR_FIT;
    }
    if (status != BURNISH_LOBE_OK) {
        return status;
    }
    model->kind = kind;
    model->exponent = exponent;
    if (kind == BURNISH_THEORY_LYON) {
        model->order = order;
        model->zeta = exponent / order;
    } else if (kind == BURNISH_THEORY_NV2X) {
        set_nv2x(model);
    } else if (kind == BURNISH_THEORY_KUIJK_BLAKE) {
        set_kuijk_blake(model);
    }
    return BURNISH_LOBE_OK;
}

burnish_lobe_status burnish_theory_model_table(burnish_theory_model *model, int entries, int linear,
                                               double exponent) {
    burnish_lobe_status status = burnish_lobe_check(2, exponent);
    *model = NOTHING;
    if (entries < 2 || entries > BURNISH_THEORY_ENTRIES_MAX) {
        return BURNISH_LOBE_ERROR_ORDER;
    }
    if (status == BURNISH_LOBE_OK) {
        model->kind = BURNISH_THEORY_TABLE;
        model->entries = entries;
        model->linear = linear != 0;
        model->exponent = exponent;
    }
    return status;
}

burnish_lobe_status burnish_theory_model_at(const burnish_theory_model *model, double exponent,
                                            burnish_theory_model *result) {
    if (model->kind == BURNISH_THEORY_FAMILY) {
        double level = model->fit == BURNISH_THEORY_GIVEN ? model->zeta : model->level;
        return burnish_theory_model_family(result, model->fit, model->order, exponent, level);
    }
    if (model->kind == BURNISH_THEORY_TABLE) {
        return burnish_theory_model_table(result, model->entries, model->linear, exponent);
    }
    return burnish_theory_model_other(result, model->kind, model->order, exponent);
}
