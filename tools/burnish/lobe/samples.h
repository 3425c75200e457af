/* Measured samples of a lobe, read from CSV. */
#ifndef BURNISH_TOOL_LOBE_SAMPLES_H
#define BURNISH_TOOL_LOBE_SAMPLES_H

#include <stddef.h>

#include "burnish/core.h"

typedef enum burnish_cli_unit {
    BURNISH_CLI_UNIT_DEGREES,
    BURNISH_CLI_UNIT_RADIANS,
    BURNISH_CLI_UNIT_COSINE
} burnish_cli_unit;

enum { BURNISH_CLI_SAMPLES_MAX = 1000000, BURNISH_CLI_SAMPLES_BYTES_MAX = 1 << 28 };

typedef struct burnish_cli_sample {
    double x;         /* as in the file */
    double lambda;    /* 1 - cosine */
    double intensity; /* as in the file */
} burnish_cli_sample;

typedef struct burnish_cli_samples {
    burnish_cli_sample *items; /* release with free */
    size_t count, capacity;
} burnish_cli_samples;

/* Reads angle and intensity from a file, "-" for standard input: two fields a line between commas,
 * semicolons, tabs or blanks; empty lines, lines that begin with # and one heading are passed over.
 * Errors: READ, FORMAT, LIMIT, MEMORY; with the line's number. */
burnish_status burnish_cli_read_samples(const char *path, burnish_cli_unit unit,
                                        burnish_cli_samples *samples, burnish_error *error);

#endif
