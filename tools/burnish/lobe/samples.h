/* Measured samples of a lobe, read from CSV. */
#ifndef TOOL_LOBE_SAMPLES_H
#define TOOL_LOBE_SAMPLES_H

#include <stddef.h>

#include "burnish/core.h"

typedef enum lobe_unit { LOBE_UNIT_DEGREES, LOBE_UNIT_RADIANS, LOBE_UNIT_COSINE } lobe_unit;

enum { LOBE_SAMPLES_MAX = 1000000, CLI_SAMPLES_BYTES_MAX = 1 << 28 };

typedef struct lobe_sample {
    double x;         /* as in the file */
    double lambda;    /* 1 - cosine */
    double intensity; /* as in the file */
} lobe_sample;

typedef struct lobe_samples {
    lobe_sample *items; /* release with free */
    size_t count, capacity;
} lobe_samples;

/* Reads angle and intensity from a file, "-" for standard input: two fields a line between commas,
 * semicolons, tabs or blanks; empty lines, lines that begin with # and one heading are passed over.
 * Errors: READ, FORMAT, LIMIT, MEMORY; with the line's number. */
burnish_status lobe_read_samples(const char *path, lobe_unit unit, lobe_samples *samples,
                                 burnish_error *error);

#endif
