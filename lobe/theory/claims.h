/* Shared by the files of the paper's claims: claims.c decides the verdicts, the others compute. */
#ifndef BURNISH_THEORY_CLAIMS_H
#define BURNISH_THEORY_CLAIMS_H

#include "theory/internal.h"

/* One claim of the paper, and the function that computes its values. */
typedef struct burnish_claim_source {
    const char *id, *claim, *quantity, *note, *command;
    burnish_theory_relation relation;
    double bound, unit;
    void (*compute)(burnish_theory_claim *claim); /* NULL with the relation NONE */
    burnish_theory_verdict elsewhere;             /* with the relation NONE */
    const char *source;                           /* NULL: the paper */
} burnish_claim_source;

/* The command of a claim that `burnish-lobe claims` shows best. */
#define BURNISH_CLAIM_SHOW(id) "burnish-lobe claims " id

/* The claims in the order of the paper; a NULL id ends each list. */
extern const burnish_claim_source burnish_claims_w[];       /* W: shape, blooming, curvature */
extern const burnish_claim_source burnish_claims_fits[];    /* W1, W_Q, W_0.5 */
extern const burnish_claim_source burnish_claims_others[];  /* Schlick and the other methods */
extern const burnish_claim_source burnish_claims_vectors[]; /* Lyon's vectors, operations */

/* Appends a value; judged 0: for information, marked with an asterisk. */
__attribute__((format(printf, 4, 5))) void
burnish_claim_add(burnish_theory_claim *claim, int judged, double value, const char *format, ...);

/* A lobe of order 2; LEVEL means level 1/2. The exponent is a constant of a claim: no errors. */
burnish_theory_model burnish_claim_lobe(burnish_lobe_fit fit, double n);

/* cos^n, Schlick's lobe and others without a fit. */
burnish_theory_model burnish_claim_other(burnish_lobe_kind kind, double n);

/* The largest error relative to cos^n, in per cent, down to its inflection. */
double burnish_claim_core_relative(const burnish_theory_model *model);

#endif
