/* The parser of the command line, driven by a command's table of flags. */
#include "cli/options.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void cli_clean(char *text) {
    for (char *c = text; *c; ++c) {
        if ((unsigned char)*c < 32 || *c == 127) {
            *c = '?';
        }
    }
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

int cli_report_error(const burnish_error *error) {
    fprintf(stderr, "burnish: %s\n", error->text);
    return burnish_status_exit_code(error->status);
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

int cli_closer(const char *name, const char *candidate, size_t *best) {
    size_t edits = edit_distance(name, candidate);
    if (strlen(name) >= 4 && strstr(candidate, name) && edits > 1) {
        edits = 1;
    }
    if (edits >= *best) {
        return 0;
    }
    *best = edits;
    return 1;
}

int cli_close_enough(const char *name, size_t edits) {
    size_t length = strlen(name);
    size_t allowed = length < 4 ? 1 : length / 3;
    return edits <= (allowed > 4 ? 4 : allowed);
}

static const cli_flag *find_flag(const cli_command *command, const char *name, size_t length) {
    for (size_t i = 0; i < command->flag_count; ++i) {
        const char *known = command->flags[i].name;
        if (strlen(known) == length && memcmp(known, name, length) == 0) {
            return &command->flags[i];
        }
    }
    return NULL;
}

static const cli_flag *find_letter(const cli_command *command, char letter) {
    for (size_t i = 0; i < command->flag_count; ++i) {
        if (command->flags[i].letter == letter) {
            return &command->flags[i];
        }
    }
    return NULL;
}

/* The flag that a whole argument names, so that `--output --json` is not a file called --json. */
static const cli_flag *flag_of_argument(const cli_command *command, const char *argument) {
    if (strncmp(argument, "--", 2) != 0 || !argument[2]) {
        return NULL;
    }
    return find_flag(command, argument + 2, strcspn(argument + 2, "="));
}

static burnish_status fail_unknown(const cli_command *command, const char *argument,
                                   burnish_error *error) {
    char name[CLI_NAME_MAX + 1];
    const char *given = argument[1] == '-' ? argument + 2 : argument + 1;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(given, "="), given);
    const char *closest = NULL;
    size_t best = CLI_NAME_MAX;
    for (size_t i = 0; i < command->flag_count; ++i) {
        if (cli_closer(name, command->flags[i].name, &best)) {
            closest = command->flags[i].name;
        }
    }
    int length = (int)(given - argument) + (int)strlen(name);
    if (closest && cli_close_enough(name, best)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "%.*s: unknown flag; did you mean --%s?",
                        length, argument, closest);
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "%.*s: unknown flag; \"burnish %s --help\" lists the flags", length, argument,
                    command->name);
}

static burnish_status apply(const cli_flag *flag, const char *text, void *settings,
                            burnish_error *error) {
    return flag->handler(flag, text, (char *)settings + flag->offset, error);
}

burnish_status cli_defaults(const cli_command *command, void *settings, burnish_error *error) {
    for (size_t i = 0; i < command->flag_count; ++i) {
        const cli_flag *flag = &command->flags[i];
        if (flag->initial) {
            burnish_status status = apply(flag, flag->initial, settings, error);
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
} cursor;

/* The value in the argument after the flag. */
static burnish_status next_value(const cli_command *command, const cli_flag *flag, cursor *at,
                                 const char **text, burnish_error *error) {
    if (at->next >= at->argc) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: a value is missing: --%s=%s",
                        flag->name, flag->name, flag->value);
    }
    *text = at->argv[at->next];
    if (flag_of_argument(command, *text)) {
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
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: takes no value; write --%s alone", flag->name, flag->name);
        }
        *text = NULL;
        return BURNISH_STATUS_OK;
    }
    if (equals) {
        *text = equals + 1;
        return BURNISH_STATUS_OK;
    }
    return next_value(command, flag, at, text, error);
}

static burnish_status parse_short(const cli_command *command, const char *argument, cursor *at,
                                  const cli_flag **found, const char **text, burnish_error *error) {
    const cli_flag *flag = find_letter(command, argument[1]);
    if (!flag || (!flag->value && argument[2])) {
        return fail_unknown(command, argument, error);
    }
    *found = flag;
    *text = NULL;
    if (!flag->value) {
        return BURNISH_STATUS_OK;
    }
    if (argument[2] == '=') {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "-%c: write -%c %s or --%s=%s, not -%c=%s",
                        flag->letter, flag->letter, flag->value, flag->name, flag->value,
                        flag->letter, flag->value);
    }
    if (argument[2]) {
        *text = argument + 2;
        return BURNISH_STATUS_OK;
    }
    return next_value(command, flag, at, text, error);
}

static burnish_status take_operand(const cli_command *command, const char *argument,
                                   cli_operands *operands, burnish_error *error) {
    if (operands->count == command->operands_max && command->operands_max == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: \"%s\" is no flag; \"burnish %s --help\" lists the flags",
                        command->name, argument, command->name);
    }
    if (operands->count == command->operands_max) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: \"%s\" is one operand too many; usage: burnish %s %s [options]",
                        command->name, argument, command->name, command->operand);
    }
    operands->items[operands->count++] = argument;
    return BURNISH_STATUS_OK;
}

burnish_status cli_parse(const cli_command *command, int argc, char **argv, void *settings,
                         cli_operands *operands, burnish_error *error) {
    cursor at = {argc, 0, argv};
    int flags_ended = 0;
    *operands = (cli_operands){0};
    while (at.next < argc) {
        const char *argument = argv[at.next++];
        const cli_flag *flag = NULL;
        const char *text = NULL;
        burnish_status status;
        if (flags_ended || argument[0] != '-' || !argument[1]) {
            status = take_operand(command, argument, operands, error);
        } else if (argument[1] != '-') {
            status = parse_short(command, argument, &at, &flag, &text, error);
        } else if (argument[2]) {
            status = parse_long(command, argument, &at, &flag, &text, error);
        } else {
            flags_ended = 1;
            continue;
        }
        if (status == BURNISH_STATUS_OK && flag) {
            if (strcmp(flag->name, "help") == 0) {
                operands->help = 1;
                return BURNISH_STATUS_OK;
            }
            status = apply(flag, text, settings, error);
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}
