/* The help screen of a command, made from its table of flags. */
#ifndef TOOL_CLI_HELP_H
#define TOOL_CLI_HELP_H

#include "cli/options.h"

/* The name without the command that it is part of. */
const char *cli_short_name(const cli_command *command);

/* Text of a flag's default, "" for none. */
const char *cli_default_label(const cli_flag *flag);

/* Prints "  COMMAND  what" rows: examples, subcommands. */
void cli_print_examples(const cli_example *examples);
void cli_print_parts(const cli_command *const *parts);

/* Prints the screen: without a topic the common flags, with one those of its group, with "all"
 * every flag. Errors: ARGUMENT. */
burnish_status cli_print_help(const cli_command *command, const char *topic, burnish_error *error);

#endif
