/* The help screens and the man page, made from the tables of flags. */
#ifndef TOOL_CLI_HELP_H
#define TOOL_CLI_HELP_H

#include <stdio.h>

#include "cli/options.h"

/* Exit code of a blank picture under --fail-on-blank; the others are those of burnish_status. */
#define CLI_EXIT_BLANK 8

/* All subcommands, in the order of the help screen; NULL ends the list. */
extern const cli_command *const cli_commands[];

/* The command of that name in a list that NULL ends, or NULL. Names are compared without the
 * command that they are part of: "table" finds "lobe table". */
const cli_command *cli_find_command(const cli_command *const *commands, const char *name);

/* The name without the command that it is part of. */
const char *cli_short_name(const cli_command *command);

/* Examples of both screens and the man page; the last has a NULL command. */
extern const cli_example cli_examples[];

/* X(code, text) of every exit code that is no burnish_status. */
#define CLI_EXIT_LIST(X) X(CLI_EXIT_BLANK, "the picture is blank (--fail-on-blank)")

/* Text of a flag's default, "" for none. */
const char *cli_flag_default(const cli_flag *flag);

/* Answers an unknown name with the closest command of a list. `whole` is the command that the list
 * is part of, NULL for the list of all. Returns the exit code. */
int cli_fail_command(const cli_command *whole, const char *name);

/* Print on standard output; the exit code: 0, or that of WRITE. */
int cli_print_help(void);
int cli_print_command_help(const cli_command *command);
int cli_print_man(void);

/* Flushes standard output; the exit code, after a message where it failed. */
int cli_finish_output(void);

/* Commands that consist of subcommands: finds and runs one. */
int cli_run_part(const cli_command *whole, int argc, char **argv);

/* The subcommands `help` and `bench`. */
extern const cli_command cli_help_command;
extern const cli_command cli_bench_command;

#endif
