/* Runs a command. */
#ifndef BASE_CLI_RUN_H
#define BASE_CLI_RUN_H

#include "base/cli/options.h"

/* Runs a command: defaults, parsing, --help, the work, the message of an error. argv[0] is the
 * first argument after the command.
 *   work  NULL: the one in the command's table
 * Returns the exit code. */
int cli_run(const cli_command *command, cli_work *work, int argc, char **argv);

/* The command of that name in a list that ends with NULL. The error for an unknown name suggests the
 * most similar one. NULL after an error. */
const cli_command *cli_find_command(const cli_command *const *commands, const char *name,
                                    burnish_error *error);

/* Errors: ARGUMENT if an output would replace a mesh behind a link, or if text would get the name
 * of a mesh (cli_is_input_name). */
burnish_status cli_check_output(const char *flag, const char *path, int is_text,
                                burnish_error *error);

/* A closed pipe and a file that is too large become errors instead of signals; a signal that ends
 * the program removes temporary files. */
void cli_handle_signals(void);

/* Flushes standard output. Errors: WRITE. */
burnish_status cli_finish_output(burnish_error *error);

/* The exit code of a status; prints the message if it is not OK. */
int cli_exit_code(burnish_status status, const burnish_error *error);

#endif
