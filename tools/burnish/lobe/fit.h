/* The fit of lobes to measured samples, apart from reading and printing. */
#ifndef BURNISH_TOOL_LOBE_FIT_H
#define BURNISH_TOOL_LOBE_FIT_H

#include "burnish/theory.h"
#include "lobe/samples.h"

/* One lobe fitted to all samples: intensity = scale * lobe + offset. */
typedef struct burnish_cli_fitted {
    burnish_theory_model model; /* family: fit GIVEN with the slope found */
    double scale, offset;
    double rms, maximum; /* of the residuals, in the samples' unit */
    size_t worst;        /* index of the sample with the largest residual */
    int at_limit;        /* 1: the search ended at an end of its range */
} burnish_cli_fitted;

enum { BURNISH_CLI_FITTED_MAX = 9 }; /* five orders, power, schlick, gaussian, gx */

/* Fits every kind of lobe by least squares, the best first: scale and offset in closed form for
 * every slope or exponent, which NLopt finds.
 *   with_offset  0: offset is 0
 *   path         for messages
 * Errors: FORMAT for samples that no lobe fits, MEMORY. */
burnish_status burnish_cli_fit_samples(const burnish_cli_samples *samples, int with_offset,
                                       const char *path,
                                       burnish_cli_fitted fitted[BURNISH_CLI_FITTED_MAX],
                                       size_t *count, burnish_error *error);

/* Measured minus fitted. */
double burnish_cli_residual(const burnish_cli_fitted *fitted, const burnish_cli_sample *sample);

/* The share of the samples' variation that the lobe explains, at most 1. */
double burnish_cli_explained(const burnish_cli_samples *samples, const burnish_cli_fitted *fitted);

/* The exponent for which a fit of that order has this slope; NaN where there is none. */
double burnish_cli_exponent_of_slope(burnish_lobe_fit fit, int order, double zeta);

#endif
