/* burnish-lobe: its commands and what they share. */
#ifndef BURNISH_PROGRAM_LOBE_H
#define BURNISH_PROGRAM_LOBE_H

#include "base/cli/options.h"
#include "base/cli/output.h"
#include "base/cli/values.h"
#include "burnish/theory.h"

extern const cli_command lobe_table_command;
extern const cli_command lobe_claims_command;
extern const cli_command lobe_boundary_command;
extern const cli_command lobe_choose_command;

#define CLI_RIGHT_ANGLE (CLI_PI / 2)

/* Flags of most subcommands; `type` has members format and output. */
#define CLI_FORMAT_FLAG(type, list, start)                                                         \
    {                                                                                              \
        .group = "Output", .name = "format", .value = "NAME", .help = "output format",             \
        .default_text = start, .words = list,                                                      \
        .manual = "Output format. Text is rounded for reading; CSV and JSON have all digits. A "   \
                  "missing number is an empty field in CSV and null in JSON.",                     \
        .handler = cli_flag_word, .offset = offsetof(type, format)                                 \
    }
#define CLI_OUTPUT_FLAG(type, heading)                                                             \
    {                                                                                              \
        .group = heading, .name = "output", .letter = 'o', .value = "FILE",                        \
        .help = "output file; - is standard output", .default_text = "-",                          \
        .manual = "File to write, whole or not at all; *-* is standard output.",                   \
        .handler = cli_flag_text, .offset = offsetof(type, output), .file = CLI_REPORTS            \
    }

/* ---- Lists of exponents, lobes and metrics, as flags contain them ---- */

enum {
    LOBE_EXPONENTS_MAX = 65536, /* in one list */
    LOBE_LOBES_MAX = 64,        /* in one list */
    LOBE_METRICS_MAX = 64,      /* in one list */
    LOBE_NAME = 32
};

/* A list of exponents; release with free(items). */
typedef struct lobe_exponents {
    double *items;
    size_t count;
} lobe_exponents;

typedef struct lobe_names {
    char items[LOBE_LOBES_MAX][LOBE_NAME];
    size_t count;
} lobe_names;

/* A metric with its argument. */
typedef struct lobe_metric {
    const burnish_theory_metric *metric;
    double argument;
} lobe_metric;

typedef struct lobe_metrics {
    lobe_metric items[LOBE_METRICS_MAX];
    size_t count;
} lobe_metrics;

/* Numbers and ranges between commas: 10, 1-1023, 10-100:10 (steps), 2-1024x2 (factors), each from 1
 * to 65536. Errors: ARGUMENT, MEMORY. */
burnish_status lobe_read_exponents(const char *flag, const char *text, lobe_exponents *list,
                                   burnish_error *error);

/* Words of burnish_theory_model_parse between commas. An order that is too high for
 * some exponents is not an error here. */
burnish_status lobe_read_lobes(const char *flag, const char *text, lobe_names *list,
                               burnish_error *error);

/* Names, NAME:ARGUMENT, groups, and all (every group but sums) between commas. */
burnish_status lobe_read_metrics(const char *flag, const char *text, lobe_metrics *list,
                                 burnish_error *error);

/* All metrics for the man page. */
void lobe_each_metric(cli_take_term *take);

/* The column of a metric. */
void lobe_metric_column(const lobe_metric *choice, cli_column *column);

/* "3 mul 1 add 1 max", without operations that are not used. */
void lobe_cost_text(const burnish_theory_cost *cost, char *text, size_t size);

/* ---- Sums of lobes for a rough surface ---- */

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
