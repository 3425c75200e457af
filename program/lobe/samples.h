/* Reads measured samples. */
#ifndef TOOL_LOBE_SAMPLES_H
#define TOOL_LOBE_SAMPLES_H

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

#endif
