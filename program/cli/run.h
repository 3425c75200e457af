/* The one way in which a command runs, and the help screens, made from its table of flags. */
#ifndef TOOL_CLI_RUN_H
#define TOOL_CLI_RUN_H

#include "cli/options.h"

/* Settings, defaults, parsing, --help, the work, the message of an error; of a command that
 * consists of others the one that argv[0] names. argv[0] is the first argument after the command.
 * Returns the exit code. */
int cli_run(const cli_command *command, int argc, char **argv);

/* The command of that name in a list that NULL ends. Names are compared without the command that
 * they are part of: "table" finds "lobe table". An unknown name is answered with the nearest one;
 * `whole` is the command that the list is part of, NULL for the list of all. NULL after an error.
 */
const cli_command *cli_find_command(const cli_command *const *commands, const cli_command *whole,
                                    const char *name, burnish_error *error);

/* A closed pipe and a file that grows too large give a message and an exit code, not a signal; a
 * signal that ends the program leaves no temporary. */
void cli_handle_signals(void);

/* Flushes standard output. Errors: WRITE. */
burnish_status cli_finish_output(burnish_error *error);

/* The exit code of a status, after the message of one that is not OK. */
int cli_exit_code(burnish_status status, const burnish_error *error);

/* For commands that draw: makes memory cheap to get, before the first large allocation and with one
 * thread. */
void cli_prepare_memory(void);

/* The name without the command that it is part of. */
const char *cli_short_name(const cli_command *command);

/* Text of a flag's default, "" for none. */
const char *cli_default_label(const cli_flag *flag);

/* Topic number `index` of --help=TOPIC, NULL past the last; none where the flags have no topics. */
const char *cli_topic_at(const cli_command *command, size_t index);

/* What an exit code says, NULL for a code that the program does not have. They are below
 * CLI_EXIT_END. */
const char *cli_exit_text(int code);
enum { CLI_EXIT_END = 16 };

/* Prints "  COMMAND  what" rows: examples, subcommands. */
void cli_print_examples(const cli_example *examples);
void cli_print_parts(const cli_command *const *parts);

/* Prints the screen: without a topic the common flags, with one those of its group, with "all"
 * every flag. Errors: ARGUMENT. */
burnish_status cli_print_help(const cli_command *command, const char *topic, burnish_error *error);

#endif
