/* Sums of lobes: their polynomials, and their errors on a grid that is fixed for one target. */
#ifndef BURNISH_THEORY_LOBE_SUM_H
#define BURNISH_THEORY_LOBE_SUM_H

#include "burnish/theory.h"

enum { BURNISH_LOBE_SUM_TERMS = 5, BURNISH_LOBE_SUM_POINTS = 1500 };

/* Coefficients in alpha: zeta alpha^2 of each lobe, then the weights of all but the first. */
typedef struct burnish_lobe_sum_row {
    int order[BURNISH_THEORY_LOBE_SUM_MAX];
    double terms[2 * BURNISH_THEORY_LOBE_SUM_MAX - 1][BURNISH_LOBE_SUM_TERMS];
} burnish_lobe_sum_row;

/* Where 1 - c is sampled, its steps, and the target's values there and at 0. */
typedef struct burnish_lobe_sum_grid {
    int count; /* [1, BURNISH_LOBE_SUM_POINTS] */
    double lambda[BURNISH_LOBE_SUM_POINTS], step[BURNISH_LOBE_SUM_POINTS];
    double value[BURNISH_LOBE_SUM_POINTS], peak;
} burnish_lobe_sum_grid;

/* The sum of a row at an alpha: slopes and weights within their limits. */
void burnish_lobe_sum_evaluate(const burnish_lobe_sum_row *row, int count, double alpha,
                               burnish_theory_lobe_sum *sum);

/* Fills a grid whose count is set. */
void burnish_lobe_sum_prepare(burnish_theory_distribution distribution, double alpha,
                              burnish_lobe_sum_grid *grid);

void burnish_lobe_sum_measure(const burnish_lobe_sum_grid *grid, const burnish_theory_lobe_sum *sum,
                              burnish_theory_lobe_sum_error *error);

#endif
