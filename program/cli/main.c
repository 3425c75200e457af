/* burnish: the program. The table of commands, and `burnish help`. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/help.h"
#include "base/cli/program.h"
#include "base/cli/run.h"
#include "base/cli/values.h"
#include "cli/colors.h"
#include "cli/input.h"
#include "cli/main.h"

static const cli_command help_command;

#define ROW(table) &table,
static const cli_command *const commands[] = {CLI_COMMAND_LIST(ROW) & help_command, NULL};
#undef ROW

static const cli_example examples[] = {
    {"burnish part.stl", "writes part.png"},
    {"burnish part.stl part.png --size=256", "a thumbnail"},
    {"burnish render part.stl --views=front,right,top,iso -o sheet.png", "a sheet of views"},
    {"burnish render :teapot --lobe=power,schlick,energy:2,taylor:2", "lobes side by side"},
    {"burnish render part.obj --json --fail-on-blank", "a report for programs"},
    {"burnish batch parts --recursive -d thumbs --index", "many files, and an index page"},
    {"burnish compare before.stl after.stl -o changes.png", "the differences"},
    {"burnish render - --input-format=ply -o - <in.ply >out.png", "in a pipe"},
    {"burnish lobe choose --exponent=100 --epsilon=0.02", "the cheapest suitable lobe"},
    {NULL, NULL},
};

static const cli_section environment = {
    .heading = "ENVIRONMENT",
    .terms =
        (const cli_term[]){
            {"*BURNISH_IMPORTERS*",
             "the folder of the programs *burnish-import-assimp* and *burnish-import-occt*, "
             "which read other formats (FBX, COLLADA, STEP ...), instead of the folder in "
             "which they are installed."},
            {"*BURNISH_FIGURES*",
             "the gnuplot script of *burnish lobe plot*, instead of the installed figures.gp."},
            {"*BURNISH_ISA*", "the instruction set if *--isa* is *auto*; the same values."},
            {"*PATH*",
             "the folders of gnuplot, for *burnish lobe plot*, and of ffmpeg, for videos."},
            {NULL, NULL},
        },
    .closing = "The locale is ignored: the decimal separator is always a point.",
};

static const cli_program burnish = {
    .name = "burnish",
    .summary = "renders 3-D models without a GPU, with the same pixels everywhere",
    .man_date = "2026-11-28",
    .description =
        "*burnish* renders 3-D models (meshes) to images without a GPU, display or toolkit. Its "
        "highlights use a family of specular lobes without pow and division.\nThe same input and "
        "flags give the same pixels on every processor, with every compiler and any number of "
        "threads, and the hash in *--json* can be compared between machines.\nEvery command has "
        "*-h* and *--help*, which list its flags on one screen. Commands with many flags list the "
        "common ones; *--help=*_TOPIC_ lists others, and *--help=all* all of them.",
    .commands = commands,
    .implied = &render_command,
    .options = &render_options_command,
    .examples = examples,
    .values = &cli_color_section,
    .environment = &environment,
};

/* ---- help ---- */

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
     .manual = "Prints this page: *burnish help --man | man -l -*",
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
    {"*commands*",
     "an array with *name* (*render*, *lobe table*), *operand*, *summary* and *flags*, "
     "which has the inherited ones, too"},
    {"*options*", "an array of the flags that are options in Python, JavaScript and MCP"},
    {"*name, letter, also*", "of a flag, without dashes; *also* is an array of other names"},
    {"*type*",
     "*switch*, *integer*, *number*, *bytes* (an integer that can end in K, M or G), *size* "
     "(two integers), *square* (one or two), *vector* (numbers between commas), *color*, "
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
     .text = "The output of *burnish help --json* is one object. Keys are added, but never renamed "
             "or removed within a major version.",
     .terms = json_terms},
    {.heading = NULL},
};

static const cli_command help_command = {
    .name = "help",
    .operand = "[COMMAND]",
    .summary = "a command's flags; --man prints the manual page (roff)",
    .operand_help = "a command, such as render or lobe table; default: a list of all commands",
    .manual = "Prints the help screen of a command, or the list of commands.",
    .operands_max = 2,
    .flags = help_flags,
    .flag_count = sizeof help_flags / sizeof *help_flags,
    .sections = help_sections,
    .settings_size = sizeof(help_settings),
    .work = help_work,
};

static void print_first_screen(void) {
    printf("burnish %s: %s\n\n"
           "Usage: burnish INPUT [OUTPUT] [options], or burnish COMMAND [options]\n",
           burnish_version(), burnish.summary);
    cli_print_parts(commands);
    printf("  %-16s  %s\n", "-h, -V", "--help: this screen; --version: the version");
    cli_print_examples(examples);
    printf("\nExit codes\n");
    for (int code = 0; code < CLI_EXIT_END; ++code) {
        if (cli_exit_text(code)) {
            printf("  %d  %s\n", code, cli_exit_text(code));
        }
    }
    printf(
        "\nburnish COMMAND --help lists the flags; burnish help --man | man -l - explains them.\n");
}

/* `burnish help render`, `burnish help lobe table`. */
static burnish_status help_about(const cli_call *call, burnish_error *error) {
    const cli_command *command = cli_find_command(commands, NULL, call->operands[0], error);
    if (command && call->operand_count == 2) {
        if (!command->parts) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "help: \"%.60s\": %s has no subcommands; try burnish help %s",
                            call->operands[1], command->name, command->name);
        }
        command = cli_find_command(command->parts, command, call->operands[1], error);
    }
    return command ? cli_print_help(command, NULL, error) : error->status;
}

static burnish_status help_work(void *from, cli_call *call, burnish_error *error) {
    const help_settings *settings = from;
    if (call->operand_count > 0) {
        return help_about(call, error);
    }
    if (settings->json) {
        return cli_print_json(&burnish, error);
    }
    if (settings->man) {
        cli_print_man(&burnish);
    } else if (settings->shell != SHELL_NONE) {
        cli_print_completion(&burnish, shell_words[settings->shell - SHELL_BASH].name);
    } else {
        print_first_screen();
    }
    return BURNISH_STATUS_OK;
}

/* ---- The program ---- */

static int is_command(const char *name) {
    for (size_t i = 0; commands[i]; ++i) {
        if (strcmp(name, commands[i]->name) == 0) {
            return 1;
        }
    }
    return 0;
}

/* Whether the first argument is a mesh or a flag instead of a command: `render` is implied. */
static int implies_render(const char *argument) {
    const char *dot = strrchr(argument, '.');
    if (is_command(argument)) {
        return 0;
    }
    return argument[0] == ':' || argument[0] == '-' || strchr(argument, '/') ||
           (dot && strlen(dot) <= 5) || access(argument, F_OK) == 0;
}

int main(int argc, char **argv) {
    burnish_error error;
    cli_handle_signals();
    cli_is_input_name = cli_is_mesh_name;
    if (argc > 1 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
        print_first_screen();
        return cli_exit_code(cli_finish_output(&error), &error);
    }
    if (argc == 2 && strncmp(argv[1], "--help=", 7) == 0 && is_command(argv[1] + 7)) {
        char *name = argv[1] + 7;
        return cli_run(&help_command, NULL, 1, &name);
    }
    if (argc > 1 && (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0)) {
        printf("burnish %s\n", burnish_version());
        return cli_exit_code(cli_finish_output(&error), &error);
    }
    if (argc < 2) {
        return cli_exit_code(
            cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                     "no command; try \"burnish render :teapot\" or \"burnish --help\""),
            &error);
    }
    if (implies_render(argv[1])) {
        return cli_run(&render_command, render_work, argc - 1, argv + 1);
    }
    const cli_command *command = cli_find_command(commands, NULL, argv[1], &error);
    cli_work *work = command == &render_command ? render_work : NULL;
    return command ? cli_run(command, work, argc - 2, argv + 2)
                   : cli_exit_code(error.status, &error);
}
