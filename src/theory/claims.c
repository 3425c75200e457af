/* The paper's claims: every number is computed, every verdict follows from the numbers. */
#include "theory/claims.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

const char *burnish_theory_verdict_text(burnish_theory_verdict verdict) {
    switch (verdict) {
    case BURNISH_THEORY_HOLDS:
        return "holds";
    case BURNISH_THEORY_HOLDS_TO_DIGITS:
        return "holds to the digits given";
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

/* ---- What the files of claims share ---- */

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

/* ---- The list ---- */

/* The claim of that index, NULL past the last; counts them where `count` is not NULL. */
static const burnish_claim_source *find(size_t index, size_t *count) {
    const burnish_claim_source *const lists[] = {burnish_claims_w, burnish_claims_fits,
                                                 burnish_claims_vectors};
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

/* How far the value is beyond the bound. */
static double excess(const burnish_theory_claim *claim, double value) {
    switch (claim->relation) {
    case BURNISH_THEORY_AT_MOST:
        return value - claim->bound;
    case BURNISH_THEORY_AT_LEAST:
        return claim->bound - value;
    case BURNISH_THEORY_ABOUT:
        return fabs(value - claim->bound) - 0.5 * claim->unit;
    case BURNISH_THEORY_NONE:
        break;
    }
    return 0;
}

static burnish_theory_verdict judge(const burnish_theory_claim *claim) {
    double worst = 0, rounding = 1e-12 * (1 + fabs(claim->bound));
    for (int i = 0; i < claim->count; ++i) {
        double miss = claim->values[i].judged ? excess(claim, claim->values[i].value) : 0;
        worst = miss <= worst ? worst : miss; /* keeps NaN, which never holds */
    }
    if (worst <= rounding) {
        return BURNISH_THEORY_HOLDS;
    }
    double allowed = claim->relation == BURNISH_THEORY_ABOUT ? 0.5 * claim->unit : claim->unit;
    return worst < allowed ? BURNISH_THEORY_HOLDS_TO_DIGITS : BURNISH_THEORY_DOES_NOT_HOLD;
}

burnish_status burnish_theory_claim_compute(size_t index, burnish_theory_claim *claim) {
    const burnish_claim_source *source = find(index, NULL);
    if (!source || !claim) {
        return BURNISH_STATUS_ARGUMENT;
    }
    *claim = (burnish_theory_claim){.id = source->id,
                                    .claim = source->claim,
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
