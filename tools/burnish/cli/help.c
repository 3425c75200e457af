/* The help screens: a command's flags in groups, related flags sharing a row. */
#include "cli/help.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/lobe.h"
#include "render/settings.h"

const cli_command *const cli_commands[] = {
    &render_command, &lobe_command, &cli_bench_command, &cli_help_command, NULL,
};

const cli_example cli_examples[] = {
    {"burnish render :teapot", "teapot.png"},
    {"burnish render part.stl -o part.png --size=256", "a thumbnail"},
    {"burnish render part.stl --views=front,right,top,iso -o sheet.png", "a sheet of views"},
    {"burnish render :teapot --lobe=power,schlick,energy:2,taylor:2", "lobes side by side"},
    {"burnish render part.obj --json --fail-on-blank", "for programs"},
    {"burnish render - --input-format=ply -o - <in.ply >out.png", "in a pipe"},
    {"burnish lobe table --exponents=10,100", "lobes in numbers"},
    {"burnish lobe choose --exponent=100 --epsilon=0.02", "the cheapest lobe that will do"},
    {NULL, NULL},
};

const char *cli_short_name(const cli_command *command) {
    const char *space = strrchr(command->name, ' ');
    return space ? space + 1 : command->name;
}

const cli_command *cli_find_command(const cli_command *const *commands, const char *name) {
    for (size_t i = 0; commands[i]; ++i) {
        if (strcmp(cli_short_name(commands[i]), name) == 0) {
            return commands[i];
        }
    }
    return NULL;
}

const char *cli_flag_default(const cli_flag *flag) {
    return flag->shown ? flag->shown : flag->initial ? flag->initial : "";
}

int cli_finish_output(void) {
    if (fflush(stdout) != 0 || ferror(stdout)) {
        burnish_error error;
        cli_fail(&error, BURNISH_STATUS_WRITE, "standard output: %s", strerror(errno));
        return cli_report_error(&error);
    }
    return EXIT_SUCCESS;
}

/* Flags from `first` on that share one row of the screen. */
static size_t row_length(const cli_command *command, size_t first) {
    size_t length = 1;
    while (first + length < command->flag_count && !command->flags[first + length].help) {
        ++length;
    }
    return length;
}

enum { ROW_MAX = 160 };

static void append(char row[ROW_MAX], const char *separator, const char *text) {
    size_t used = strlen(row);
    int wanted = snprintf(row + used, ROW_MAX - used, "%s%s", used > 0 ? separator : "", text);
    if (wanted < 0) {
        row[used] = 0;
    }
}

/* "-o, --output=FILE", "--json, --timing" */
static void row_flags(const cli_flag *flags, size_t length, char row[ROW_MAX]) {
    row[0] = 0;
    for (size_t i = 0; i < length; ++i) {
        char text[ROW_MAX];
        if (flags[i].letter) {
            snprintf(text, sizeof text, "-%c", flags[i].letter);
            append(row, ", ", text);
        }
        snprintf(text, sizeof text, "--%s%s%s", flags[i].name, flags[i].value ? "=" : "",
                 flags[i].value ? flags[i].value : "");
        append(row, ", ", text);
    }
}

/* The row's text, the words of a flag where the text asks for them by ending in a colon or being
 * empty, and the defaults of all its flags. */
static void row_text(const cli_flag *flags, size_t length, char row[ROW_MAX]) {
    char defaults[ROW_MAX] = "";
    size_t help_length = strlen(flags[0].help);
    int wants_words = help_length == 0 || flags[0].help[help_length - 1] == ':';
    snprintf(row, ROW_MAX, "%s", flags[0].help);
    for (size_t i = 0; i < length; ++i) {
        const char *shown = cli_flag_default(&flags[i]);
        if (wants_words && flags[i].words) {
            char words[ROW_MAX];
            cli_word_list(flags[i].words, words, sizeof words);
            append(row, " ", words);
        }
        if (*shown) {
            append(defaults, "; ", shown);
        }
    }
    if (*defaults) {
        append(row, " ", "[");
        append(row, "", defaults);
        append(row, "", "]");
    }
}

static size_t widest_row(const cli_command *command) {
    size_t widest = 0;
    for (size_t i = 0; i < command->flag_count; i += row_length(command, i)) {
        char row[ROW_MAX];
        row_flags(&command->flags[i], row_length(command, i), row);
        widest = strlen(row) > widest ? strlen(row) : widest;
    }
    return widest;
}

static void print_examples(const cli_example *examples, int width) {
    printf("\nExamples\n");
    for (const cli_example *example = examples; example->command; ++example) {
        printf("  %-*s  %s\n", width, example->command, example->what);
    }
}

static int longest_example(const cli_example *examples) {
    size_t longest = 0;
    for (const cli_example *example = examples; example->command; ++example) {
        longest = strlen(example->command) > longest ? strlen(example->command) : longest;
    }
    return (int)longest;
}

static void print_commands(const cli_command *const *commands, int width) {
    for (size_t i = 0; commands[i]; ++i) {
        char usage[ROW_MAX];
        snprintf(usage, sizeof usage, "%s %s", cli_short_name(commands[i]), commands[i]->operand);
        printf("  %-*s  %s\n", width, usage, commands[i]->summary);
    }
}

static void print_exit_codes(int with_blank) {
    printf("\nExit codes: 0 done, 2 usage, 3 read, 4 format, 5 limit, 6 memory, 7 write");
    if (with_blank) {
        printf(", %d blank", CLI_EXIT_BLANK);
    }
    printf("\n");
}

static int print_parts_help(const cli_command *command) {
    printf("Usage: burnish %s %s [options]   %s\n\nCommands\n", command->name, command->operand,
           command->summary);
    print_commands(command->parts, 16);
    print_examples(command->examples, longest_example(command->examples));
    printf("\n%s\n", command->operand_help);
    return cli_finish_output();
}

int cli_print_command_help(const cli_command *command) {
    int width = (int)widest_row(command);
    if (command->parts) {
        return print_parts_help(command);
    }
    printf("Usage: burnish %s %s%s[options]   %s\n", command->name, command->operand,
           *command->operand ? " " : "", command->summary);
    if (*command->operand) {
        printf("  %s  %s\n", command->operand, command->operand_help);
    } else if (command->operand_help && *command->operand_help) {
        printf("  %s\n", command->operand_help);
    }
    for (size_t i = 0; i < command->flag_count; i += row_length(command, i)) {
        const cli_flag *flags = &command->flags[i];
        size_t length = row_length(command, i);
        char left[ROW_MAX], right[ROW_MAX];
        row_flags(flags, length, left);
        row_text(flags, length, right);
        if (flags->group) {
            printf("\n%s\n", flags->group);
        }
        printf("  %-*s  %s\n", width, left, right);
    }
    if (command->examples) {
        print_examples(command->examples, longest_example(command->examples));
    }
    print_exit_codes(command == &render_command);
    return cli_finish_output();
}

int cli_print_help(void) {
    printf("burnish %s: pictures of meshes without a GPU, the same bits on every machine\n\n"
           "Usage: burnish COMMAND [options]\n\nCommands\n",
           burnish_version());
    print_commands(cli_commands, 16);
    printf("  %-16s  %s\n  %-16s  %s\n", "--help, -h", "this screen", "--version, -V",
           "the version");
    print_examples(cli_examples, 65);
    printf("\nExit codes\n");
#define PRINT_CODE(code, text) printf("  %d  %s\n", code, text);
#define PRINT_STATUS(name, code, text) PRINT_CODE(code, text)
    BURNISH_STATUS_LIST(PRINT_STATUS)
    CLI_EXIT_LIST(PRINT_CODE)
#undef PRINT_STATUS
#undef PRINT_CODE
    printf(
        "\nburnish COMMAND --help lists the flags; burnish help --man | man -l - explains them.\n");
    return cli_finish_output();
}
