/* `burnish lobe`: its subcommands and what they share. */
#ifndef TOOL_LOBE_LOBE_H
#define TOOL_LOBE_LOBE_H

#include "burnish/theory.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/values.h"

extern const cli_command lobe_command;
extern const cli_command lobe_table_command;
extern const cli_command lobe_claims_command;
extern const cli_command lobe_boundary_command;
extern const cli_command lobe_choose_command;
extern const cli_command lobe_sample_command;
extern const cli_command lobe_fit_command;
extern const cli_command lobe_plot_command;

enum {
    LOBE_EXPONENTS_MAX = 65536, /* in one list */
    LOBE_LOBES_MAX = 64,        /* in one list */
    LOBE_NAME = 32
};

#define CLI_RIGHT_ANGLE (CLI_PI / 2)

/* A list of exponents; release with free(items). */
typedef struct lobe_exponents {
    double *items;
    size_t count;
} lobe_exponents;

typedef struct lobe_names {
    char items[LOBE_LOBES_MAX][LOBE_NAME];
    size_t count;
} lobe_names;

/* Numbers and ranges between commas: 10, 1-1023, 10-100:10 (steps), 2-1024x2 (factors), each from 1
 * to 65536. Errors: ARGUMENT, MEMORY. */
burnish_status lobe_read_exponents(const char *flag, const char *text, lobe_exponents *list,
                                   burnish_error *error);

/* Words of burnish_theory_model_parse between commas. An order that is too high for
 * some exponents is not an error here. */
burnish_status lobe_read_lobes(const char *flag, const char *text, lobe_names *list,
                               burnish_error *error);

/* "3 mul 1 add 1 max", without operations that are not used. */
void lobe_cost_text(const burnish_theory_cost *cost, char *text, size_t size);

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
        .handler = cli_flag_text, .offset = offsetof(type, output), .takes_file = 1                \
    }

#endif
