/* The fewest lobes close enough to a rough surface. */
#ifndef TOOL_LOBE_CHOOSE_SUM_H
#define TOOL_LOBE_CHOOSE_SUM_H

#include "base/cli/output.h"
#include "burnish/theory.h"

extern const cli_word lobe_distribution_words[];

typedef struct lobe_sum_wish {
    burnish_theory_distribution distribution;
    double roughness, epsilon; /* most energy in the wrong direction */
    cli_format format;
    const char *output;
} lobe_sum_wish;

/* Prints the sum, C code and all candidates. Errors: ARGUMENT (no sum is close enough), IO. */
burnish_status lobe_choose_sum(const lobe_sum_wish *wish, burnish_error *error);

#endif
