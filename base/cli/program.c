/* What every program has: the first screen, --version, and the command help. */
#include "base/cli/program.h"

#include <stdio.h>
#include <string.h>

#include "base/cli/help.h"
#include "base/cli/run.h"
#include "base/cli/values.h"

static const cli_program *running;

enum { SHELL_NONE, SHELL_BASH, SHELL_ZSH, SHELL_FISH };

typedef struct help_settings {
    int man, shell, json;
} help_settings;

static cli_work help_work;

static const cli_word shell_words[] = {
    {"bash", SHELL_BASH}, {"zsh", SHELL_ZSH}, {"fish", SHELL_FISH}, {NULL, 0}};

static const cli_flag help_flags[] = {
    {.group = "Options",
     .name = "man",
     .help = "print the manual page of all commands in roff",
     .manual = "Prints this page: *help --man | man -l -*",
     .handler = cli_flag_switch,
     .offset = offsetof(help_settings, man)},
    {.name = "completion",
     .value = "SHELL",
     .help = "print completions to source",
     .words = shell_words,
     .manual = "Prints the completions of commands, flags and their values for a shell. They are "
               "installed with the program. To load them manually: *source <(burnish help "
               "--completion=bash)*.",
     .handler = cli_flag_word,
     .offset = offsetof(help_settings, shell)},
    {.name = "json",
     .help = "print all commands and flags as JSON",
     .manual = "Prints the tables of all commands and flags, for generators of bindings, forms and "
               "other completions; see *FLAGS IN JSON*.",
     .handler = cli_flag_switch,
     .offset = offsetof(help_settings, json)},
};

static const cli_term json_terms[] = {
    {"*burnish*", "the version"},
    {"*commands*", "an array with *name* (*render*, *table*), *operand*, *summary* and *flags*, "
                   "which has the inherited ones, too"},
    {"*program*", "another program that runs the command and has *help --json*, too; or null"},
    {"*options*", "an array of the flags that are options in Python, JavaScript and MCP"},
    {"*name, letter, also*", "of a flag, without dashes; *also* is an array of other names"},
    {"*type*",
     "*switch*, *integer*, *number*, *bytes* (an integer that can end in K, M or G), *size* "
     "(one or two integers), *vector* (numbers between commas), *color*, "
     "*number or color*, *word*, *words* (between commas), *text*, or *name* (a text or "
     "a number)"},
    {"*value, help*", "the placeholder of the value and the row of the help screen"},
    {"*optional*", "true: the flag can be given without its value"},
    {"*repeats*", "true: repeated values add up; otherwise the last one counts"},
    {"*off*", "the value that switches the flag off, or null"},
    {"*words, low, high*", "the valid values; null if any value is valid"},
    {"*default, default_label*", "the value without the flag, and a description of it; or null"},
    {"*topic*", "of *--help=*_TOPIC_, or null"},
    {"*phases*", "in which the flag acts, an array: *load*, *draw*, *file*; *process*: it does not "
                 "change the result, but limits, drives or reports the work. Empty if the flag is "
                 "not about pictures"},
    {"*svg*", "what an SVG or PDF does with the flag: *drawn*, *same* (nothing), or *refused*"},
    {"*file*",
     "what the value names: *folder*, *reads*, *writes*, *reports* (a file of text), or null"},
    {NULL, NULL},
};

static const cli_section help_sections[] = {
    {.heading = "FLAGS IN JSON",
     .text = "The output of *help --json* is one object. Keys are added, but never renamed "
             "or removed within a major version.",
     .terms = json_terms},
    {.heading = NULL},
};

const cli_command cli_help_command = {
    .name = "help",
    .operand = "[COMMAND]",
    .summary = "a command's flags; --man prints the manual page (roff)",
    .operand_help = "the name of a command; default: a list of all commands",
    .manual = "Prints the help screen of a command, or the list of commands.",
    .operands_max = 2,
    .flags = help_flags,
    .flag_count = sizeof help_flags / sizeof *help_flags,
    .sections = help_sections,
    .settings_size = sizeof(help_settings),
    .work = help_work,
};

static void print_first_screen(void) {
    printf("%s %s: %s\n\nUsage: %s\n", running->name, burnish_version(), running->summary,
           running->usage);
    cli_print_commands(running->commands);
    printf("  %-16s  %s\n", "-h, -V", "--help: this screen; --version: the version");
    cli_print_examples(running->examples);
    printf("\nExit codes\n");
    for (int code = 0; code < CLI_EXIT_END; ++code) {
        const char *text = cli_exit_text(running->exits, code);
        if (text) {
            printf("  %d  %s\n", code, text);
        }
    }
    printf("\n%s COMMAND --help lists the flags; %s help --man | man -l - explains them.\n",
           running->name, running->name);
}

/* `burnish help render`, `burnish help lobe table`. */
static burnish_status help_about(cli_call *call, burnish_error *error) {
    if (strcmp(call->operands[0], "version") == 0) {
        printf("Usage: %s version, --version or -V   prints %s %s\n", running->name, running->name,
               burnish_version());
        return BURNISH_STATUS_OK;
    }
    const cli_command *command = cli_find_command(running->commands, call->operands[0], error);
    if (!command) {
        return error->status;
    }
    if (command->program) {
        char help[] = "--help", name[2 * CLI_NAME_MAX];
        char *arguments[] = {name, help, NULL};
        snprintf(name, sizeof name, "%s", call->operand_count == 2 ? call->operands[1] : "");
        call->exit_code = call->operand_count == 2 ? running->start(command, 2, arguments)
                                                   : running->start(command, 1, arguments + 1);
        return BURNISH_STATUS_OK;
    }
    if (call->operand_count == 2) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "help: \"%.60s\": %s has no subcommands; try %s help %s", call->operands[1],
                        command->name, running->name, command->name);
    }
    return cli_print_help(command, NULL, error);
}

static burnish_status help_work(void *from, cli_call *call, burnish_error *error) {
    const help_settings *settings = from;
    if (call->operand_count > 0) {
        return help_about(call, error);
    }
    if (settings->json) {
        return cli_print_json(running, error);
    }
    if (settings->man) {
        cli_print_man(running);
    } else if (settings->shell != SHELL_NONE) {
        cli_print_completion(running, shell_words[settings->shell - SHELL_BASH].name);
    } else {
        print_first_screen();
    }
    return BURNISH_STATUS_OK;
}

/* ---- The program ---- */

static int is_command(const char *name) {
    for (size_t i = 0; running->commands[i]; ++i) {
        if (strcmp(name, running->commands[i]->name) == 0) {
            return 1;
        }
    }
    return 0;
}

int cli_run_program(const cli_program *program, int argc, char **argv) {
    const char *first = argc > 1 ? argv[1] : "";
    burnish_error error;
    running = program;
    cli_program_name = program->name;
    cli_handle_signals();
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0) {
        print_first_screen();
        return cli_exit_code(cli_finish_output(&error), &error);
    }
    if (argc == 2 && strncmp(first, "--help=", 7) == 0 && is_command(first + 7)) {
        char *name = argv[1] + 7;
        return cli_run(&cli_help_command, NULL, 1, &name);
    }
    if (strcmp(first, "--version") == 0 || strcmp(first, "-V") == 0 ||
        (argc == 2 && strcmp(first, "version") == 0)) {
        printf("%s %s\n", program->name, burnish_version());
        return cli_exit_code(cli_finish_output(&error), &error);
    }
    if (argc < 2) {
        return cli_exit_code(
            cli_fail(&error, BURNISH_STATUS_ARGUMENT, "no command; try %s", program->advice),
            &error);
    }
    if (program->implied && !is_command(first) && program->implies(first)) {
        return cli_run(program->implied, program->implied_work, argc - 1, argv + 1);
    }
    const cli_command *command = cli_find_command(program->commands, first, &error);
    if (!command) {
        return cli_exit_code(error.status, &error);
    }
    if (command->program) {
        return program->start(command, argc - 2, argv + 2);
    }
    return cli_run(command, command == program->implied ? program->implied_work : NULL, argc - 2,
                   argv + 2);
}
