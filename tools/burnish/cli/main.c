/* burnish: the command line. Finds the subcommand and hands over. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/help.h"
#include "cli/values.h"

typedef struct help_settings {
    int man, help;
} help_settings;

static int help_main(int argc, char **argv);

static const cli_flag help_flags[] = {
    {.group = "Options",
     .name = "man",
     .help = "the manual page in roff, covering every command",
     .manual = "Prints this page: *burnish help --man | man -l -*",
     .handler = cli_flag_switch,
     .offset = offsetof(help_settings, man)},
    {.name = "help",
     .letter = 'h',
     .help = "this screen",
     .manual = "Prints the flags on one screen.",
     .handler = cli_flag_switch,
     .offset = offsetof(help_settings, help)},
};

const cli_command cli_help_command = {
    .name = "help",
    .operand = "[COMMAND]",
    .summary = "a command's flags; --man prints the manual page (roff)",
    .operand_help = "a command, such as render or lobe table; without it the commands are listed",
    .manual = "Prints the help screen of a command, or the list of commands.",
    .operands_max = 2,
    .flags = help_flags,
    .flag_count = sizeof help_flags / sizeof *help_flags,
    .run = help_main,
};

/* The closest command of a list, or NULL when none is close. */
static const char *closest_command(const cli_command *const *commands, const char *name) {
    const char *closest = NULL;
    size_t best = CLI_NAME_MAX;
    for (size_t i = 0; commands[i]; ++i) {
        const char *candidate = cli_short_name(commands[i]);
        if (cli_closer(name, candidate, &best)) {
            closest = candidate;
        }
    }
    return closest && cli_close_enough(name, best) ? closest : NULL;
}

/* A file's name in place of a command means that `render` was left out. */
static int is_input(const char *name) {
    const char *dot = strrchr(name, '.');
    return name[0] == ':' || (dot && strlen(dot) <= 5) || strchr(name, '/');
}

int cli_fail_command(const cli_command *whole, const char *name) {
    burnish_error error;
    const char *prefix = whole ? whole->name : "", *space = whole ? " " : "";
    const char *closest = closest_command(whole ? whole->parts : cli_commands, name);
    if (!whole && is_input(name)) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "\"%.60s\": unknown command; did you mean burnish render %.60s?", name, name);
    } else if (closest) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "\"%s%s%.60s\": unknown command; did you mean %s%s%s?", prefix, space, name,
                 prefix, space, closest);
    } else {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "\"%s%s%.60s\": unknown command; \"burnish %s%s--help\" lists the commands",
                 prefix, space, name, prefix, space);
    }
    return cli_report_error(&error);
}

int cli_run_part(const cli_command *whole, int argc, char **argv) {
    burnish_error error;
    char names[160] = "";
    for (size_t i = 0; whole->parts[i]; ++i) {
        size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%s",
                 i == 0                ? ""
                 : whole->parts[i + 1] ? ", "
                                       : " or ",
                 cli_short_name(whole->parts[i]));
    }
    if (argc == 0) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "%s: what comes next is one of %s; \"burnish %s --help\" explains them",
                 whole->name, names, whole->name);
        return cli_report_error(&error);
    }
    const char *name = argv[0];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        return cli_print_command_help(whole);
    }
    if (name[0] == '-' && name[1]) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT, "%s %.60s: one of %s comes first", whole->name,
                 name, names);
        return cli_report_error(&error);
    }
    const cli_command *part = cli_find_command(whole->parts, name);
    return part ? part->run(argc - 1, argv + 1) : cli_fail_command(whole, name);
}

/* `burnish help render`, `burnish help lobe table`. */
static int help_about(const cli_operands *operands) {
    const cli_command *command = cli_find_command(cli_commands, operands->items[0]);
    if (!command) {
        return cli_fail_command(NULL, operands->items[0]);
    }
    if (operands->count == 1) {
        return cli_print_command_help(command);
    }
    if (!command->parts) {
        burnish_error error;
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "help: \"%.60s\": %s has no commands of its own; burnish help %s",
                 operands->items[1], command->name, command->name);
        return cli_report_error(&error);
    }
    const cli_command *part = cli_find_command(command->parts, operands->items[1]);
    return part ? cli_print_command_help(part) : cli_fail_command(command, operands->items[1]);
}

static int help_main(int argc, char **argv) {
    help_settings settings = {0};
    cli_operands operands;
    burnish_error error;
    if (cli_parse(&cli_help_command, argc, argv, &settings, &operands, &error) !=
        BURNISH_STATUS_OK) {
        return cli_report_error(&error);
    }
    if (operands.help) {
        return cli_print_command_help(&cli_help_command);
    }
    if (settings.man) {
        return cli_print_man();
    }
    if (operands.count == 0) {
        return cli_print_help();
    }
    return help_about(&operands);
}

int main(int argc, char **argv) {
    burnish_error error;
    /* A reader that closes its pipe early must give a message and an exit code, not a signal. */
    signal(SIGPIPE, SIG_IGN);
    if (argc < 2) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "no command; try \"burnish render :teapot\" or \"burnish --help\"");
        return cli_report_error(&error);
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) {
        return cli_print_help();
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        printf("burnish %s\n", burnish_version());
        return cli_finish_output();
    }
    if (name[0] == '-' && name[1]) {
        cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                 "%.60s: a command comes first, as in \"burnish render INPUT %.60s\"; "
                 "burnish --help lists the commands",
                 name, name);
        return cli_report_error(&error);
    }
    const cli_command *command = cli_find_command(cli_commands, name);
    return command ? command->run(argc - 2, argv + 2) : cli_fail_command(NULL, name);
}
