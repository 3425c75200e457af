/* The paper's claims: every number is computed, every verdict follows from the numbers. */
#include "theory/claims.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

const char *burnish_theory_verdict_text(burnish_theory_verdict verdict) {
    switch (verdict) {
    case BURNISH_THEORY_HOLDS:
        return "holds";
    case BURNISH_THEORY_HOLDS_IN_PART:
        return "holds in part";
    case BURNISH_THEORY_DOES_NOT_HOLD:
        return "does not hold";
    case BURNISH_THEORY_BENCHMARK:
        return "measured by benchmark";
    case BURNISH_THEORY_COUNTED:
        return "counted in machine code";
    case BURNISH_THEORY_VERDICT_COUNT:
        break;
    }
    return "unknown verdict";
}

/* ---- Shared by the files of claims ---- */

void burnish_claim_add(burnish_theory_claim *claim, int judged, double value, const char *format,
                       ...) {
    va_list arguments;
    if (claim->count == BURNISH_THEORY_CLAIM_VALUES) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(claim->values[claim->count].label, sizeof claim->values[0].label, format, arguments);
    va_end(arguments);
    claim->values[claim->count].value = value;
    claim->values[claim->count++].judged = judged;
}

burnish_theory_model burnish_claim_lobe(burnish_lobe_fit fit, double n) {
    burnish_theory_model model;
    (void)burnish_theory_model_create(
        &model, &(burnish_lobe_spec){.fit = fit, .order = 2, .parameter = 0.5}, n);
    return model;
}

burnish_theory_model burnish_claim_other(burnish_lobe_kind kind, double n) {
    burnish_theory_model model;
    (void)burnish_theory_model_create(&model, &(burnish_lobe_spec){.kind = kind, .order = 2}, n);
    return model;
}

double burnish_claim_core_relative(const burnish_theory_model *model) {
    burnish_theory_difference difference;
    burnish_theory_compare(model, burnish_theory_inflection_angle(model->exponent), &difference);
    return 100 * difference.relative;
}

/* ---- The list ---- */

/* The claim of that index, NULL after the last; counts them if `count` is not NULL. */
static const burnish_claim_source *find(size_t index, size_t *count) {
    const burnish_claim_source *const lists[] = {burnish_claims_w, burnish_claims_fits,
                                                 burnish_claims_others, burnish_claims_vectors};
    const burnish_claim_source *found = NULL;
    size_t seen = 0;
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; ++i) {
        for (const burnish_claim_source *source = lists[i]; source->id; ++source, ++seen) {
            found = seen == index ? source : found;
        }
    }
    if (count) {
        *count = seen;
    }
    return found;
}

size_t burnish_theory_claim_count(void) {
    size_t count;
    (void)find(0, &count);
    return count;
}

/* ---- Verdicts ---- */

/* Whether one value agrees with the statement, up to rounding; NaN does not. */
static int agrees(const burnish_theory_claim *claim, double value) {
    const double rounding = 1e-12 * (1 + fabs(claim->bound));
    switch (claim->relation) {
    case BURNISH_THEORY_AT_MOST:
        return value - claim->bound <= rounding;
    case BURNISH_THEORY_AT_LEAST:
        return claim->bound - value <= rounding;
    case BURNISH_THEORY_ABOUT:
        return fabs(value - claim->bound) - 0.5 * claim->unit <= rounding;
    case BURNISH_THEORY_NONE:
        break;
    }
    return 0;
}

static burnish_theory_verdict judge(const burnish_theory_claim *claim) {
    int judged = 0, agreeing = 0;
    for (int i = 0; i < claim->count; ++i) {
        judged += claim->values[i].judged;
        agreeing += claim->values[i].judged && agrees(claim, claim->values[i].value);
    }
    return agreeing == 0        ? BURNISH_THEORY_DOES_NOT_HOLD
           : agreeing == judged ? BURNISH_THEORY_HOLDS
                                : BURNISH_THEORY_HOLDS_IN_PART;
}

burnish_status burnish_theory_claim_compute(size_t index, burnish_theory_claim *claim) {
    const burnish_claim_source *source = find(index, NULL);
    if (!source || !claim) {
        return BURNISH_STATUS_ARGUMENT;
    }
    *claim = (burnish_theory_claim){.id = source->id,
                                    .claim = source->claim,
                                    .source = source->source ? source->source : "the paper",
                                    .quantity = source->quantity,
                                    .note = source->note,
                                    .command = source->command,
                                    .relation = source->relation,
                                    .bound = source->bound,
                                    .unit = source->unit,
                                    .verdict = source->elsewhere};
    if (source->compute) {
        source->compute(claim);
        claim->verdict = judge(claim);
    }
    return BURNISH_STATUS_OK;
}
