/* All commands: a subcommand is one file and one row here. */
#ifndef TOOL_CLI_MAIN_H
#define TOOL_CLI_MAIN_H

#include "base/cli/options.h"

/* X(table) of every command, in the order of the help screen. */
#define CLI_COMMAND_LIST(X)                                                                        \
    X(render_command)                                                                              \
    X(view_command)                                                                                \
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

#endif
