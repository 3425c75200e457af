/* The help screens, which are made from tables of flags. */
#ifndef BASE_CLI_HELP_H
#define BASE_CLI_HELP_H

#include "base/cli/options.h"

/* Text of a flag's default, "" for none. */
const char *cli_default_label(const cli_flag *flag);

/* Topic number `index` of --help=TOPIC, NULL past the last. */
const char *cli_topic_at(const cli_command *command, size_t index);

/* The text of an exit code, NULL for an unused one. Codes are below CLI_EXIT_END. `own`: those of
 * the program that are not from a burnish_status; the last has a NULL name. */
const char *cli_exit_text(const cli_word *own, int code);
enum { CLI_EXIT_END = 16 };

/* Prints "  COMMAND  what" rows: examples, commands. */
void cli_print_examples(const cli_example *examples);
void cli_print_commands(const cli_command *const *commands);

/* Prints the screen: the common flags, or the flags of a topic, or all flags for "all". Errors:
 * ARGUMENT. */
burnish_status cli_print_help(const cli_command *command, const char *topic, burnish_error *error);

#endif
