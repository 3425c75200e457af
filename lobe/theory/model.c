/* Models: a lobe with its exponent. */
#include <stdarg.h>
#include <stdio.h>

#include "theory/internal.h"

burnish_status burnish_theory_fail(burnish_error *error, const char *format, ...) {
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
        error->status = BURNISH_STATUS_ARGUMENT;
    }
    return BURNISH_STATUS_ARGUMENT;
}

static const burnish_theory_model NOTHING = {
    .lobe = {.kind = BURNISH_LOBE_POWER}, .exponent = 1, .scale = 1};

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

burnish_lobe_status burnish_theory_model_create(burnish_theory_model *model,
                                                const burnish_lobe_spec *lobe, double exponent) {
    burnish_theory_model made = {.lobe = *lobe, .exponent = exponent, .scale = 1};
    if (lobe->kind == BURNISH_LOBE_EXACT) {
        const burnish_lobe_spec exact = burnish_lobe_exact((float)exponent);
        made.lobe = exact;
        if (exact.kind == BURNISH_LOBE_INTEGER_POWER) {
            made.lobe = (burnish_lobe_spec){.kind = BURNISH_LOBE_POWER};
            made.is_product = 1;
            made.steps = exact.order;
        }
        lobe = &made.lobe;
    }
    burnish_lobe_status status = burnish_lobe_check(2, exponent);
    switch (lobe->kind) {
    case BURNISH_LOBE_FAMILY:
    case BURNISH_LOBE_LYON:
        status = burnish_lobe_solve(lobe, exponent, &made.zeta, &made.scale);
        break;
    case BURNISH_LOBE_COMPOSITE:
        status = burnish_composite_check(lobe->aim, lobe->order, exponent);
        made.steps =
            burnish_composite_constants(lobe->aim, lobe->order, exponent, &made.zeta, made.k) - 2;
        break;
    case BURNISH_LOBE_NV2X:
    case BURNISH_LOBE_KUIJK_BLAKE:
        if (status == BURNISH_LOBE_OK) {
            (lobe->kind == BURNISH_LOBE_NV2X ? set_nv2x : set_kuijk_blake)(&made);
        }
        break;
    case BURNISH_LOBE_TABLE:
        if (lobe->entries < 2 || lobe->entries > BURNISH_LOBE_ENTRIES_MAX) {
            status = BURNISH_LOBE_ERROR_ORDER;
        }
        break;
    case BURNISH_LOBE_POWER:
    case BURNISH_LOBE_SCHLICK:
    case BURNISH_LOBE_GAUSSIAN:
    case BURNISH_LOBE_GX:
        break;
    case BURNISH_LOBE_INTEGER_POWER:
    case BURNISH_LOBE_EXACT:
    case BURNISH_LOBE_KIND_COUNT:
    default:
        status = BURNISH_LOBE_ERROR_FIT;
        break;
    }
    *model = status == BURNISH_LOBE_OK ? made : NOTHING;
    return status;
}

burnish_status burnish_theory_model_parse(const char *text, double exponent,
                                          burnish_theory_model *model, burnish_error *error) {
    burnish_lobe_spec lobe;
    burnish_theory_model made;
    if (!model) {
        return burnish_theory_fail(error, "lobe: NULL; pass a text and a model");
    }
    burnish_status parsed = burnish_lobe_spec_parse_any(text, &lobe, error);
    if (parsed != BURNISH_STATUS_OK) {
        return parsed;
    }
    burnish_lobe_status status = burnish_theory_model_create(&made, &lobe, exponent);
    if (status != BURNISH_LOBE_OK) {
        return burnish_theory_fail(error, "lobe \"%.40s\" at exponent %g: %s", text, exponent,
                                   burnish_lobe_status_text(status));
    }
    *model = made;
    return BURNISH_STATUS_OK;
}
