/* The commands and flags of a program as JSON, for bindings and other generators. */
#include <stdio.h>
#include <string.h>

#include "base/cli/output.h"
#include "base/cli/program.h"
#include "base/cli/values.h"

static cJSON *text_or_null(const char *text) {
    return cli_json_text(text && *text ? text : NULL);
}

/* The items of a list with commas; NULL: none. */
static cJSON *items(const char *list, int *failed) {
    cJSON *array = cJSON_CreateArray();
    while (list) {
        char text[CLI_NAME_MAX + 1];
        const char *item;
        const size_t length = cli_next_item(&list, ',', &item);
        snprintf(text, sizeof text, "%.*s", (int)length, item);
        cli_json_add(array, NULL, cli_json_text(text), failed);
    }
    return array;
}

static cJSON *word_array(const cli_word *words, int *failed) {
    cJSON *array = words ? cJSON_CreateArray() : cJSON_CreateNull();
    for (; words && words->name; ++words) {
        cli_json_add(array, NULL, cli_json_text(words->name), failed);
    }
    return array;
}

static cJSON *phase_array(unsigned phases, int *failed) {
    static const char *const names[] = {"load", "draw", "file", "process"};
    cJSON *array = cJSON_CreateArray();
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        if (phases >> i & 1) {
            cli_json_add(array, NULL, cli_json_text(names[i]), failed);
        }
    }
    return array;
}

static cJSON *describe_flag(const cli_flag *flag, const char *topic, int *failed) {
    static const char *const files[] = {NULL, "folder", "reads", "writes", "reports"};
    static const char *const drawings[] = {"drawn", "same", "refused"};
    const int has_range = flag->low < flag->high;
    const char letter[2] = {flag->letter, 0};
    cJSON *row = cJSON_CreateObject();
    cli_json_add(row, "name", cli_json_text(flag->name), failed);
    cli_json_add(row, "letter", text_or_null(letter), failed);
    cli_json_add(row, "also", items(flag->also, failed), failed);
    cli_json_add(row, "type", cli_json_text(cli_type_word(cli_type_of(flag))), failed);
    cli_json_add(row, "value", cli_json_text(flag->value), failed);
    cli_json_add(row, "optional", cJSON_CreateBool(flag->optional), failed);
    cli_json_add(row, "repeats", cJSON_CreateBool(flag->repeats), failed);
    cli_json_add(row, "off", cli_json_text(flag->off), failed);
    cli_json_add(row, "words", word_array(flag->words, failed), failed);
    cli_json_add(row, "low", has_range ? cli_json_real(flag->low) : cJSON_CreateNull(), failed);
    cli_json_add(row, "high", has_range ? cli_json_real(flag->high) : cJSON_CreateNull(), failed);
    cli_json_add(row, "default", cli_json_text(flag->default_text), failed);
    cli_json_add(row, "default_label", cli_json_text(flag->default_label), failed);
    cli_json_add(row, "help", cli_json_text(flag->help), failed);
    cli_json_add(row, "topic", cli_json_text(topic), failed);
    cli_json_add(row, "phases", phase_array(flag->phases, failed), failed);
    cli_json_add(row, "svg", cli_json_text(drawings[flag->svg]), failed);
    cli_json_add(row, "file", cli_json_text(files[flag->file]), failed);
    return row;
}

static cJSON *describe_flags(const cli_command *command, int *failed) {
    cJSON *array = cJSON_CreateArray();
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        cli_json_add(array, NULL, describe_flag(flag, cli_group_of(command, flag)->topic, failed),
                     failed);
    }
    return array;
}

char *cli_describe_flags(const cli_command *command) {
    int failed = 0;
    cJSON *array = describe_flags(command, &failed);
    return cli_json_string(array, failed, 0);
}

static void add_commands(cJSON *array, const cli_command *const *commands, int *failed) {
    for (size_t i = 0; commands[i]; ++i) {
        const cli_command *command = commands[i];
        cJSON *object = cJSON_CreateObject();
        cli_json_add(object, "name", cli_json_text(command->name), failed);
        cli_json_add(object, "program", text_or_null(command->program), failed);
        cli_json_add(object, "operand", text_or_null(command->operand), failed);
        cli_json_add(object, "summary", cli_json_text(command->summary), failed);
        cli_json_add(object, "flags", describe_flags(command, failed), failed);
        cli_json_add(array, NULL, object, failed);
    }
}

burnish_status cli_print_json(const cli_program *program, burnish_error *error) {
    int failed = 0;
    cJSON *object = cJSON_CreateObject(), *array = cJSON_CreateArray();
    add_commands(array, program->commands, &failed);
    cli_json_add(object, "burnish", cli_json_text(burnish_version()), &failed);
    cli_json_add(object, "commands", array, &failed);
    if (program->options) {
        cli_json_add(object, "options", describe_flags(program->options, &failed), &failed);
    }
    return cli_json_print(stdout, object, failed, error);
}
