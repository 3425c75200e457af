/* Fits lobes to samples. */
#ifndef TOOL_LOBE_FIT_SOLVE_H
#define TOOL_LOBE_FIT_SOLVE_H

#include "lobe/samples.h"

/* One lobe fitted to all samples: intensity = scale * lobe + offset. */
typedef struct lobe_fitted {
    burnish_theory_model model; /* family: fit GIVEN with the slope found */
    double scale, offset;
    double rms, maximum; /* of the residuals, in the samples' unit */
    size_t worst;        /* index of the sample with the largest residual */
    int at_limit;        /* 1: the search ended at an end of its range */
} lobe_fitted;

enum { LOBE_FITTED_MAX = 9 }; /* five orders, power, schlick, gaussian, gx */

/* Fits every kind of lobe by least squares and sorts them, best first. A search finds slope or
 * exponent; scale and offset have a closed form.
 *   with_offset  0: offset is 0
 *   path         for messages
 * Errors: FORMAT (no lobe fits the samples), MEMORY. */
burnish_status lobe_fit_samples(const lobe_samples *samples, int with_offset, const char *path,
                                lobe_fitted fitted[LOBE_FITTED_MAX], size_t *count,
                                burnish_error *error);

/* Measured minus fitted. */
double lobe_residual(const lobe_fitted *fitted, const lobe_sample *sample);

/* The share of the samples' variation that the lobe explains, at most 1. */
double lobe_explained(const lobe_samples *samples, const lobe_fitted *fitted);

/* The exponent for which a fit of that order has this slope; NaN if there is none. */
double lobe_exponent_of_slope(burnish_lobe_fit fit, int order, double zeta);

#endif
