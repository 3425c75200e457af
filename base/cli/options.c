/* The parser of the command line, which reads a command's table of flags. */
#include "base/cli/options.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/show_text.h"

int (*cli_is_input_name)(const char *name);

const char *cli_open_reason(const char *path, int code) {
    return code != ENOENT        ? strerror(code)
           : strstr(path, "://") ? "it is an address; download the file first"
           : strpbrk(path, "*?") ? "No such file; shells replace patterns only outside quotes"
                                 : strerror(code);
}

void cli_clean(char *text) {
    burnish_clean_text(text);
}

burnish_status cli_fail(burnish_error *error, burnish_status status, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    cli_clean(error->text);
    error->status = status;
    return status;
}

const char *cli_program_name = "burnish";

cli_command_name cli_full_name(const cli_command *command) {
    cli_command_name name;
    snprintf(name.text, sizeof name.text, "%s %s", cli_program_name, command->name);
    return name;
}

void cli_warn(const char *text) {
    fprintf(stderr, "burnish: warning: %s\n", text);
}

/* Edit distance with swaps of neighbours (optimal string alignment). */
static size_t edit_distance(const char *a, const char *b) {
    size_t rows[3][CLI_NAME_MAX + 1];
    size_t a_length = strlen(a), b_length = strlen(b);
    if (a_length > CLI_NAME_MAX || b_length > CLI_NAME_MAX) {
        return CLI_NAME_MAX;
    }
    for (size_t j = 0; j <= b_length; ++j) {
        rows[0][j] = j;
    }
    for (size_t i = 1; i <= a_length; ++i) {
        size_t *row = rows[i % 3];
        const size_t *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; ++j) {
            size_t best = above[j - 1] + (a[i - 1] != b[j - 1]);
            best = above[j] + 1 < best ? above[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                two_above[j - 2] + 1 < best) {
                best = two_above[j - 2] + 1;
            }
            row[j] = best;
        }
    }
    return rows[a_length % 3][b_length];
}

/* 1 when both have the same letters, each as often: "zise", "size". */
static int same_letters(const char *a, const char *b) {
    int counts[256] = {0};
    for (; *a && *b; ++a, ++b) {
        ++counts[(unsigned char)*a];
        --counts[(unsigned char)*b];
    }
    for (int i = 0; i < 256; ++i) {
        if (counts[i] != 0) {
            return 0;
        }
    }
    return *a == *b;
}

const char *cli_nearest(const char *typed, cli_name_at *name_at, const void *list) {
    size_t length = strlen(typed), allowed = length < 4 ? 1 : length / 3;
    size_t best = allowed < 4 ? allowed + 1 : 5;
    const char *nearest = NULL, *name;
    for (size_t i = 0; (name = name_at(list, i)) != NULL; ++i) {
        size_t edits = edit_distance(typed, name);
        if (edits > 1 && ((length >= 4 && strstr(name, typed)) || same_letters(typed, name))) {
            edits = 1;
        }
        if (edits < best) {
            best = edits;
            nearest = name;
        }
    }
    return nearest;
}

burnish_status cli_fail_unknown(burnish_error *error, const char *where, const char *kind,
                                const char *typed, cli_name_at *name_at, const void *list,
                                const char *lister) {
    const char *nearest = cli_nearest(typed, name_at, list);
    if (nearest) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: \"%.60s\": unknown %s; did you mean %s?", where, typed, kind, nearest);
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "%s: \"%.60s\": unknown %s; \"%s\" lists them",
                    where, typed, kind, lister);
}

int cli_in_list(const char *list, const char *name, size_t length) {
    while (list) { /* called often: a session sets flags for every picture */
        if (strncmp(list, name, length) == 0 && (list[length] == ',' || list[length] == 0)) {
            return 1;
        }
        const char *comma = strchr(list, ',');
        list = comma ? comma + 1 : NULL;
    }
    return 0;
}

/* The flag of this table with this name; NULL: none. */
static const cli_flag *find_own(const cli_command *command, const char *name) {
    for (size_t i = 0; i < command->flag_count; ++i) {
        if (strcmp(command->flags[i].name, name) == 0) {
            return &command->flags[i];
        }
    }
    return NULL;
}

const cli_flag *cli_flag_at(const cli_command *command, size_t index) {
    const cli_command *base = command->base;
    if (index < command->flag_count) {
        return &command->flags[index];
    }
    index -= command->flag_count;
    for (size_t i = 0; base && i < base->flag_count; ++i) {
        const cli_flag *flag = &base->flags[i];
        const int is_inherited =
            flag->phases & command->base_phases && !(flag->not_for & command->heir);
        if (is_inherited && !find_own(command, flag->name) && index-- == 0) {
            return flag;
        }
    }
    return NULL;
}

/* Whether the flag is in the command's own table, which can be missing. */
static int is_own(const cli_command *command, const cli_flag *flag) {
    return command->flag_count > 0 && flag >= command->flags &&
           flag < command->flags + command->flag_count;
}

const cli_flag *cli_group_of(const cli_command *command, const cli_flag *flag) {
    const cli_flag *table = is_own(command, flag) ? command->flags : command->base->flags;
    while (flag > table && !flag->group) {
        --flag;
    }
    return flag;
}

const cli_flag *cli_find_flag(const cli_command *command, const char *name, size_t length) {
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        if ((*flag->name == *name && strlen(flag->name) == length &&
             memcmp(flag->name, name, length) == 0) ||
            cli_in_list(flag->also, name, length)) {
            return flag;
        }
    }
    return NULL;
}

static const cli_flag *find_letter(const cli_command *command, char letter) {
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        if (flag->letter == letter) {
            return flag;
        }
    }
    return NULL;
}

/* The flag that a whole argument names: `--output --json` and `--turntable -o` lack a value. */
static const cli_flag *flag_of_argument(const cli_command *command, const char *argument) {
    if (argument[0] == '-' && argument[1] && !argument[2]) {
        return find_letter(command, argument[1]);
    }
    if (strncmp(argument, "--", 2) != 0 || !argument[2]) {
        return NULL;
    }
    return cli_find_flag(command, argument + 2, strcspn(argument + 2, "="));
}

static const char *flag_name_at(const void *list, size_t index) {
    const cli_command *command = list;
    const cli_flag *flag = cli_flag_at(command, index);
    const int ended = !flag && (index == 0 || cli_flag_at(command, index - 1));
    return flag ? flag->name : ended ? "help" : NULL;
}

/* The flag with this name in another program, or NULL. */
static const char *flag_of_alias(const cli_command *command, const char *name, size_t length) {
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        if (cli_in_list(flag->aliases, name, length)) {
            return flag->name;
        }
    }
    return NULL;
}

static burnish_status fail_unknown(const cli_command *command, const char *argument,
                                   burnish_error *error) {
    char name[CLI_NAME_MAX + 1];
    const char *given = argument[1] == '-' ? argument + 2 : argument + 1;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(given, "="), given);
    const char *hint = flag_of_alias(command, name, strlen(name));
    hint = hint ? hint : cli_nearest(name, flag_name_at, command);
    int length = (int)(given - argument) + (int)strlen(name);
    if (hint) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "%.*s: unknown flag; did you mean --%s?",
                        length, argument, hint);
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "%.*s: unknown flag; \"%s --help\" lists the flags", length, argument,
                    cli_full_name(command).text);
}

/* The flag's bit in the settings of its command. */
static uint64_t *given_bit(const cli_command *command, const cli_flag *flag, const void *settings,
                           uint64_t *mask) {
    while (command && !is_own(command, flag)) {
        command = command->base;
    }
    if (!command || !command->given) {
        return NULL;
    }
    const size_t index = (size_t)(flag - command->flags);
    cli_given *given = (cli_given *)((char *)(uintptr_t)settings + command->given);
    *mask = (uint64_t)1 << index % 64;
    return &given->bits[index / 64];
}

static int is_given(const cli_command *command, const void *settings, const char *name,
                    size_t length) {
    const cli_flag *flag = cli_find_flag(command, name, length);
    uint64_t mask = 0;
    const uint64_t *bits = flag ? given_bit(command, flag, settings, &mask) : NULL;
    return bits && (*bits & mask) != 0;
}

int cli_is_given(const cli_command *command, const void *settings, const char *name) {
    return is_given(command, settings, name, strlen(name));
}

int cli_next_useless(const cli_command *command, const void *settings, const cli_need *needs,
                     size_t count, size_t *at, burnish_error *line) {
    size_t index = 0;
    for (const cli_need *need = needs; need < needs + count; ++need) {
        for (const char *item, *rest = need->flags; rest; ++index) {
            item = rest;
            rest = strchr(rest, ',');
            if (index >= *at && !need->is_met &&
                is_given(command, settings, item, strcspn(item, ",="))) {
                *at = index + 1;
                cli_fail(line, BURNISH_STATUS_ARGUMENT, "--%.*s: no effect: %s",
                         (int)strcspn(item, ","), item, need->why);
                return 1;
            }
            rest = rest ? rest + 1 : NULL;
        }
    }
    return 0;
}

burnish_status cli_check_needs(const cli_command *command, const void *settings,
                               const cli_need *needs, size_t count, int strict, int quiet,
                               burnish_error *error) {
    burnish_error line;
    for (size_t at = 0; cli_next_useless(command, settings, needs, count, &at, &line);) {
        if (strict) {
            *error = line;
            return line.status;
        }
        if (!quiet) {
            cli_warn(line.text);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status apply(const cli_flag *flag, const char *text, void *settings,
                            burnish_error *error) {
    return flag->handler(flag, text, (char *)settings + flag->offset, error);
}

/* Applies a flag of the command line, and notes that it was given. */
static burnish_status set_flag(const cli_command *command, const cli_flag *flag, const char *text,
                               void *settings, burnish_error *error) {
    uint64_t mask = 0, *bits = given_bit(command, flag, settings, &mask);
    if (bits) {
        *bits |= mask;
    }
    return apply(flag, text, settings, error);
}

burnish_status cli_defaults(const cli_command *command, void *settings, burnish_error *error) {
    burnish_status begun =
        command->base ? cli_defaults(command->base, settings, error) : BURNISH_STATUS_OK;
    if (begun != BURNISH_STATUS_OK) {
        return begun;
    }
    for (size_t i = 0; i < command->flag_count; ++i) {
        const cli_flag *flag = &command->flags[i];
        if (flag->default_text) {
            burnish_status status = apply(flag, flag->default_text, settings, error);
            if (status != BURNISH_STATUS_OK) {
                return status;
            }
        }
    }
    return BURNISH_STATUS_OK;
}

/* A position in the arguments. */
typedef struct cursor {
    int argc, next;
    char **argv;
    const char *cluster; /* the last letter of a group that is not at its end: "-qs 64"; or NULL */
} cursor;

static burnish_status fail_needless_value(const cli_flag *flag, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: takes no value; write --%s alone",
                    flag->name, flag->name);
}

static burnish_status fail_missing_value(const cli_flag *flag, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: a value is missing: --%s=%s", flag->name,
                    flag->name, flag->value);
}

/* The value in the argument after the flag. */
static burnish_status next_value(const cli_command *command, const cli_flag *flag, cursor *at,
                                 const char **text, burnish_error *error) {
    if (at->next >= at->argc) {
        return fail_missing_value(flag, error);
    }
    *text = at->argv[at->next];
    if (flag_of_argument(command, *text) || strcmp(*text, "--help") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: a value is missing before %s: --%s=%s", flag->name, *text,
                        flag->name, flag->value);
    }
    ++at->next;
    return BURNISH_STATUS_OK;
}

static burnish_status parse_long(const cli_command *command, const char *argument, cursor *at,
                                 const cli_flag **found, const char **text, burnish_error *error) {
    const cli_flag *flag = flag_of_argument(command, argument);
    if (!flag) {
        return fail_unknown(command, argument, error);
    }
    *found = flag;
    const char *equals = strchr(argument, '=');
    if (!flag->value) {
        if (equals) {
            return fail_needless_value(flag, error);
        }
        *text = NULL;
        return BURNISH_STATUS_OK;
    }
    if (equals) {
        *text = equals + 1;
        return BURNISH_STATUS_OK;
    }
    if (flag->optional) {
        *text = NULL;
        return BURNISH_STATUS_OK;
    }
    return next_value(command, flag, at, text, error);
}

static burnish_status parse_short(const cli_command *command, const char *argument, cursor *at,
                                  const cli_flag **found, const char **text, burnish_error *error) {
    const cli_flag *flag = find_letter(command, argument[1]);
    const char letter[] = {'-', argument[1], 0}, *word = at->argv[at->next - 1];
    const size_t length = strcspn(word + 1, "=");
    const int is_word = length > 1 && (flag_of_alias(command, word + 1, length) ||
                                       cli_find_flag(command, word + 1, length));
    if (!flag || is_word) {
        return fail_unknown(command, is_word || argument == word ? word : letter, error);
    }
    *found = flag;
    *text = NULL;
    if (!flag->value) {
        at->cluster = argument[2] ? argument + 1 : NULL;
        return BURNISH_STATUS_OK;
    }
    if (argument[2] == '=') {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "-%c: write -%c %s or --%s=%s, not -%c=%s",
                        flag->letter, flag->letter, flag->value, flag->name, flag->value,
                        flag->letter, flag->value);
    }
    if (argument[2] && cli_is_input_name &&
        cli_is_input_name(argument)) { /* a shell's * can list such a file */
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: a mesh, or a value of -%c? Write ./%.200s, or --%s=%.200s",
                        argument, flag->letter, argument, flag->name, argument + 2);
    }
    if (argument[2]) {
        *text = argument + 2;
        return BURNISH_STATUS_OK;
    }
    return next_value(command, flag, at, text, error);
}

static burnish_status take_operand(const cli_command *command, const char *argument, cli_call *call,
                                   burnish_error *error) {
    if (call->operand_count == command->operands_max && command->operands_max == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: \"%s\" is not a flag; \"%s --help\" lists the flags", command->name,
                        argument, cli_full_name(command).text);
    }
    if (call->operand_count == command->operands_max) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: \"%s\" is an extra operand; usage: %s %s [options]", command->name,
                        argument, cli_full_name(command).text, command->operand);
    }
    if (call->operand_count < sizeof call->operands / sizeof *call->operands) {
        call->operands[call->operand_count] = argument;
    }
    ++call->operand_count;
    return BURNISH_STATUS_OK;
}

/* -h, --help, --help=TOPIC */
static int asks_for_help(const char *argument, cli_call *call) {
    if (strcmp(argument, "-h") == 0 || strcmp(argument, "--help") == 0) {
        call->help = 1;
    } else if (strncmp(argument, "--help=", 7) == 0) {
        call->help = 1;
        call->topic = argument + 7;
    }
    return call->help;
}

burnish_status cli_parse(const cli_command *command, int argc, char **argv, void *settings,
                         cli_call *call, burnish_error *error) {
    cursor at = {argc, 0, argv, NULL};
    int flags_ended = 0;
    *call = (cli_call){.arguments = call->arguments};
    while (at.cluster || at.next < argc) {
        const char *argument = at.cluster ? at.cluster : argv[at.next++];
        const int is_letter = at.cluster != NULL;
        const cli_flag *flag = NULL;
        const char *text = NULL;
        burnish_status status;
        at.cluster = NULL;
        if (!is_letter && (flags_ended || argument[0] != '-' || !argument[1])) {
            status = take_operand(command, argument, call, error);
        } else if (asks_for_help(argument, call)) {
            return BURNISH_STATUS_OK;
        } else if (is_letter || argument[1] != '-') {
            status = parse_short(command, argument, &at, &flag, &text, error);
        } else if (argument[2]) {
            status = parse_long(command, argument, &at, &flag, &text, error);
        } else {
            flags_ended = 1;
            continue;
        }
        if (status == BURNISH_STATUS_OK && flag) {
            status = set_flag(command, flag, text, settings, error);
        }
        if (call->arguments) {
            call->arguments[call->argument_count++] = (cli_argument){flag, flag ? text : argument};
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status cli_set(const cli_command *command, const char *name, const char *text,
                       void *settings, burnish_error *error) {
    const cli_flag *flag = cli_find_flag(command, name, strlen(name));
    if (!flag) {
        char argument[CLI_NAME_MAX + 3];
        snprintf(argument, sizeof argument, "--%s", name);
        return fail_unknown(command, argument, error);
    }
    if (text && !flag->value) {
        return fail_needless_value(flag, error);
    }
    return text || !flag->value || flag->optional ? set_flag(command, flag, text, settings, error)
                                                  : fail_missing_value(flag, error);
}
