/* Reads measured samples and fits lobes to them. */
#ifndef TOOL_LOBE_FIT_H
#define TOOL_LOBE_FIT_H

#include "burnish/theory.h"

typedef enum lobe_unit { LOBE_UNIT_DEGREES, LOBE_UNIT_RADIANS, LOBE_UNIT_COSINE } lobe_unit;

typedef struct lobe_sample {
    double x;         /* as in the file */
    double lambda;    /* 1 - cosine */
    double intensity; /* as in the file */
} lobe_sample;

typedef struct lobe_samples {
    lobe_sample *items; /* release with free */
    size_t count, capacity;
} lobe_samples;

/* Reads angle and intensity from a file, "-" for standard input: two fields per line, separated by
 * commas, semicolons, tabs or blanks. Empty lines, lines that begin with # and one header row are
 * ignored. Errors: READ, FORMAT, LIMIT, MEMORY; messages contain the line number. */
burnish_status lobe_read_samples(const char *path, lobe_unit unit, lobe_samples *samples,
                                 burnish_error *error);

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
