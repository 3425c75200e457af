/* The help screens: a row per flag, in groups. Commands with many flags have topics. */
#include <stdio.h>
#include <string.h>

#include "base/cli/help.h"
#include "base/cli/output.h"
#include "base/cli/values.h"

enum { ROW_MAX = 240, NAME_WIDTH = 16 };

const char *cli_default_label(const cli_flag *flag) {
    return flag->default_label ? flag->default_label : flag->default_text ? flag->default_text : "";
}

static const cli_flag help_row = {.letter = 'h', .name = "help", .help = "this screen"};

/* "-o, --output=FILE", "--json[=FILE]" */
static int flag_names(const cli_flag *flag, char row[ROW_MAX]) {
    char letter[8] = "    ";
    if (flag->letter) {
        snprintf(letter, sizeof letter, "-%c, ", flag->letter);
    }
    return snprintf(row, ROW_MAX, "%s--%s%s%s%s", letter, flag->name,
                    flag->optional ? "[="
                    : flag->value  ? "="
                                   : "",
                    flag->value ? flag->value : "", flag->optional ? "]" : "");
}

/* "seen from: front, right, top [front]" */
static void flag_text(const cli_flag *flag, char row[ROW_MAX]) {
    char words[ROW_MAX] = "";
    const char *label = cli_default_label(flag);
    if (flag->words) {
        cli_word_list(flag->words, words, sizeof words);
    }
    snprintf(row, ROW_MAX, "%s%s%s%s%s%s", flag->help, *words ? ": " : "", words,
             *label ? " [" : "", label, *label ? "]" : "");
}

static void print_flag(const cli_flag *flag, int width) {
    char names[ROW_MAX], text[ROW_MAX];
    flag_names(flag, names);
    flag_text(flag, text);
    printf("  %-*s  ", width, names);
    cli_print_wrapped(stdout, text, width + 4, CLI_TEXT_WIDTH);
}

static int has_topics(const cli_command *command) {
    return command->flag_count > 0 && command->flags[0].topic;
}

/* A screen shows all flags, the flags of a topic, or the common ones. */
typedef struct screen {
    const cli_command *command;
    const char *topic; /* NULL: the common ones */
    int all;
} screen;

static int shows(const screen *s, const cli_flag *flag, int is_own, const char *topic) {
    return s->all || (s->topic ? topic && strcmp(s->topic, topic) == 0 : flag->common && is_own);
}

/* Prints the groups or, if print is 0, only measures the names. */
static int print_groups(const screen *s, int width, int print) {
    const char *group = "";
    char names[ROW_MAX];
    int widest = flag_names(&help_row, names);
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(s->command, i)) != NULL; ++i) {
        const cli_flag *head = cli_group_of(s->command, flag);
        if (!shows(s, flag, i < s->command->flag_count, head->topic)) {
            continue;
        }
        int length = flag_names(flag, names);
        widest = length > widest ? length : widest;
        if (print && strcmp(group, head->group) != 0) {
            printf("\n%s\n", head->group);
        }
        group = head->group;
        if (print) {
            print_flag(flag, width);
        }
    }
    return widest;
}

void cli_print_examples(const cli_example *examples) {
    int width = 0;
    if (!examples) {
        return;
    }
    for (const cli_example *example = examples; example->command; ++example) {
        int length = (int)strlen(example->command);
        width = length > width ? length : width;
    }
    printf("\nExamples\n");
    for (const cli_example *example = examples; example->command; ++example) {
        printf("  %-*s  %s\n", width, example->command, example->what);
    }
}

void cli_print_commands(const cli_command *const *commands) {
    printf("\nCommands\n");
    for (size_t i = 0; commands[i]; ++i) {
        char usage[ROW_MAX];
        snprintf(usage, sizeof usage, "%s %s", commands[i]->name, commands[i]->operand);
        printf("  %-*s  %s\n", NAME_WIDTH, usage, commands[i]->summary);
    }
}

const char *cli_topic_at(const cli_command *command, size_t index) {
    if (!has_topics(command)) {
        return NULL;
    }
    const char *last = "";
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        const char *topic = cli_group_of(command, flag)->topic;
        if (strcmp(topic, last) != 0 && index-- == 0) {
            return topic;
        }
        last = topic;
    }
    return index == 0 ? "all" : NULL;
}

/* "--help=camera, --help=light, --help=all" */
static void topic_list(const cli_command *command, const char *before, char row[ROW_MAX]) {
    const char *topic;
    size_t used = 0;
    for (size_t i = 0; (topic = cli_topic_at(command, i)) != NULL && used < ROW_MAX; ++i) {
        used += (size_t)snprintf(row + used, ROW_MAX - used, "%s%s%s", i > 0 ? ", " : "", before,
                                 topic);
    }
}

static burnish_status check_topic(const cli_command *command, const char *topic,
                                  burnish_error *error) {
    char list[ROW_MAX] = "all";
    const char *known = "all";
    for (size_t i = 0; known && strcmp(known, topic) != 0; ++i) {
        known = cli_topic_at(command, i);
    }
    if (known) {
        return BURNISH_STATUS_OK;
    }
    topic_list(command, "", list);
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--help: \"%.60s\" is not one of %s", topic,
                    list);
}

const char *cli_exit_text(const cli_word *own, int code) {
    if (code == burnish_status_exit_code(BURNISH_STATUS_CANCELLED)) {
        return NULL; /* the program cancels no call */
    }
    if (code == burnish_status_exit_code(BURNISH_STATUS_ARGUMENT)) {
        return "wrong usage";
    }
    for (int status = 0; status < BURNISH_STATUS_COUNT; ++status) {
        if (burnish_status_exit_code((burnish_status)status) == code) {
            return burnish_status_text((burnish_status)status);
        }
    }
    while (own->name && own->value != code) {
        ++own;
    }
    return own->name;
}

static void print_head(const cli_command *command) {
    printf("Usage: %s %s%s[options]   %s\n", cli_full_name(command).text, command->operand,
           *command->operand ? " " : "", command->summary);
    if (command->operand_help) {
        const int indent = printf("  %s%s", command->operand, *command->operand ? "  " : "");
        cli_print_wrapped(stdout, command->operand_help, indent, CLI_TEXT_WIDTH);
    }
}

burnish_status cli_print_help(const cli_command *command, const char *topic, burnish_error *error) {
    screen s = {.command = command, .topic = topic};
    burnish_status status = topic ? check_topic(command, topic, error) : BURNISH_STATUS_OK;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    s.all = !has_topics(command) || (topic && strcmp(topic, "all") == 0);
    int width = print_groups(&s, 0, 0);
    print_head(command);
    print_groups(&s, width, 1);
    if (!topic) {
        if (command->flag_count > 0) {
            print_flag(&help_row, width);
        }
        if (has_topics(command)) {
            char list[ROW_MAX];
            topic_list(command, "--help=", list);
            printf("\nAll flags: ");
            cli_print_wrapped(stdout, list, sizeof "All flags:", CLI_TEXT_WIDTH);
        }
        cli_print_examples(command->examples);
    }
    return BURNISH_STATUS_OK;
}
