/* burnish: the command line. Finds the subcommand and hands over. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "help.h"
#include "values.h"

typedef struct help_settings {
    int man, help;
} help_settings;

static int help_main(int argc, char **argv);

static const burnish_cli_flag help_flags[] = {
    {.group = "Options",
     .name = "man",
     .help = "the manual page in roff, covering every command",
     .manual = "Prints this page: *burnish help --man | man -l -*",
     .handler = burnish_cli_flag_switch,
     .offset = offsetof(help_settings, man)},
    {.name = "help",
     .letter = 'h',
     .help = "this screen",
     .manual = "Prints the flags on one screen.",
     .handler = burnish_cli_flag_switch,
     .offset = offsetof(help_settings, help)},
};

const burnish_cli_command burnish_cli_help_command = {
    .name = "help",
    .operand = "[COMMAND]",
    .summary = "a command's flags; --man prints the manual page (roff)",
    .operand_help = "a command; without it the commands are listed",
    .manual = "Prints the help screen of a command, or the list of commands.",
    .operands_max = 1,
    .flags = help_flags,
    .flag_count = sizeof help_flags / sizeof *help_flags,
    .run = help_main,
};

/* Answers an unknown command with the closest one; a file's name means that `render` was left out.
 */
static int fail_command(const char *name) {
    burnish_error error;
    const char *closest = NULL;
    size_t best = BURNISH_CLI_NAME_MAX;
    for (size_t i = 0; burnish_cli_commands[i]; ++i) {
        if (burnish_cli_closer(name, burnish_cli_commands[i]->name, &best)) {
            closest = burnish_cli_commands[i]->name;
        }
    }
    const char *dot = strrchr(name, '.');
    int is_input = name[0] == ':' || (dot && strlen(dot) <= 5) || strchr(name, '/');
    if (is_input) {
        burnish_cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                         "\"%.60s\": unknown command; did you mean burnish render %.60s?", name,
                         name);
    } else if (closest && burnish_cli_close_enough(name, best)) {
        burnish_cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                         "\"%.60s\": unknown command; did you mean %s?", name, closest);
    } else {
        burnish_cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                         "\"%.60s\": unknown command; \"burnish --help\" lists the commands", name);
    }
    return burnish_cli_report_error(&error);
}

static int help_main(int argc, char **argv) {
    help_settings settings = {0};
    burnish_cli_operands operands;
    burnish_error error;
    if (burnish_cli_parse(&burnish_cli_help_command, argc, argv, &settings, &operands, &error) !=
        BURNISH_STATUS_OK) {
        return burnish_cli_report_error(&error);
    }
    if (operands.help) {
        return burnish_cli_print_command_help(&burnish_cli_help_command);
    }
    if (settings.man) {
        return burnish_cli_print_man();
    }
    if (operands.count == 0) {
        return burnish_cli_print_help();
    }
    const burnish_cli_command *command = burnish_cli_find_command(operands.items[0]);
    return command ? burnish_cli_print_command_help(command) : fail_command(operands.items[0]);
}

int main(int argc, char **argv) {
    burnish_error error;
    /* A reader that closes its pipe early must give a message and an exit code, not a signal. */
    signal(SIGPIPE, SIG_IGN);
    if (argc < 2) {
        burnish_cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                         "no command; try \"burnish render :teapot\" or \"burnish --help\"");
        return burnish_cli_report_error(&error);
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        return burnish_cli_print_help();
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        printf("burnish %s\n", burnish_version());
        return burnish_cli_finish_output();
    }
    if (name[0] == '-' && name[1]) {
        burnish_cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                         "%.60s: a command comes first, as in \"burnish render INPUT %.60s\"; "
                         "burnish --help lists the commands",
                         name, name);
        return burnish_cli_report_error(&error);
    }
    const burnish_cli_command *command = burnish_cli_find_command(name);
    return command ? command->run(argc - 2, argv + 2) : fail_command(name);
}
