/* All commands: a subcommand is one file and one row here. */
#ifndef TOOL_CLI_MAIN_H
#define TOOL_CLI_MAIN_H

#include "base/cli/options.h"

/* X(name, code, text) of every exit code that is not from a burnish_status. */
#define CLI_EXIT_LIST(X)                                                                           \
    X(CRASHED, 1, "ended by a crash or the sandbox")                                               \
    X(BLANK, 8, "a blank picture")                                                                 \
    X(DIFFERENT, 10, "pictures differ")                                                            \
    X(SOME_FAILED, 11, "some inputs failed")                                                       \
    X(NO_PROGRAM, 12, "a command's program is not installed")
#define CLI_EXIT_ENUM(name, code, text) CLI_EXIT_##name = code,
enum { CLI_EXIT_LIST(CLI_EXIT_ENUM) };
#undef CLI_EXIT_ENUM

/* X(table) of every command, in the order of the help screen. */
#define CLI_COMMAND_LIST(X)                                                                        \
    X(render_command)                                                                              \
    X(batch_command)                                                                               \
    X(serve_command)                                                                               \
    X(compare_command)                                                                             \
    X(info_command)

#define CLI_DECLARE_COMMAND(table) extern const cli_command table;
CLI_COMMAND_LIST(CLI_DECLARE_COMMAND)
#undef CLI_DECLARE_COMMAND

/* Not a command: the flags of render that are options of the bindings (session/session.h). */
extern const cli_command render_options_command;

/* The work of render_command, whose table is also linked without it, into the bindings. */
cli_work render_work;

/* Whether a program's path has the name f3d. */
int f3d_is_name(const char *program);

/* Translates f3d's options in a command line whose words from number `first` on are for render. Under
 * f3d's name its letters, too; under another, options that burnish has keep their meaning. Returns
 * the words and *argc; or NULL, with the exit code in *argc. See docs/pictures.md. */
char **f3d_translate(int *argc, char **argv, int first);

/* Says that there is no window, which `name` would open. Returns the exit code. */
int f3d_refuse_window(const char *name);

#endif
