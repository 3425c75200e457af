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
extern const cli_command lobe_rough_command;
extern const cli_command lobe_plot_command;

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

#endif
