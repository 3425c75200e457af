/* Values of flags: numbers, vectors, words. */
#include "base/cli/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/cli/platform.h"
#include "burnish/core.h"

static size_t digits(const char *text, size_t length, size_t at) {
    size_t start = at;
    while (at < length && text[at] >= '0' && text[at] <= '9') {
        ++at;
    }
    return at - start;
}

/* Decimal floating point without the hexadecimal, infinite and padded forms of strtod. */
static int is_decimal(const char *text, size_t length) {
    size_t at = length > 0 && (text[0] == '+' || text[0] == '-');
    size_t whole = digits(text, length, at), fraction = 0;
    at += whole;
    if (at < length && text[at] == '.') {
        ++at;
        fraction = digits(text, length, at);
        at += fraction;
    }
    if (whole + fraction == 0) {
        return 0;
    }
    if (at < length && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        at += at < length && (text[at] == '+' || text[at] == '-');
        size_t exponent = digits(text, length, at);
        if (exponent == 0) {
            return 0;
        }
        at += exponent;
    }
    return at == length;
}

int cli_read_real(const char *text, size_t length, double *value) {
    char copy[64]; /* enough for any reasonable double */
    if (length >= sizeof copy || !is_decimal(text, length)) {
        return 0;
    }
    memcpy(copy, text, length);
    copy[length] = 0;
    *value = cli_strtod(copy);
    return isfinite(*value);
}

const char *cli_shortest(double value, char text[CLI_REAL_SIZE]) {
    for (int digits = 15; digits <= 17; ++digits) { /* %g leaves out zeros at the end */
        snprintf(text, CLI_REAL_SIZE, "%.*g", digits, value);
        char *point = text + strspn(text, "+-0123456789infa");
        if (*point != 'e') { /* the locale's */
            *point = *point ? '.' : 0;
        }
        if (cli_strtod(text) == value) {
            break;
        }
    }
    return text;
}

size_t cli_next_item(const char **text, char separator, const char **item) {
    *item = *text;
    const char *end = strchr(*text, separator);
    *text = end ? end + 1 : NULL;
    return end ? (size_t)(end - *item) : strlen(*item);
}

int cli_read_reals(const char *text, size_t length, double *values, size_t count) {
    const char *end = text + length;
    for (size_t i = 0; i < count; ++i) {
        const char *comma = memchr(text, ',', (size_t)(end - text));
        const char *item_end = comma ? comma : end;
        if ((comma != NULL) != (i + 1 < count) ||
            !cli_read_real(text, (size_t)(item_end - text), &values[i])) {
            return 0;
        }
        text = comma ? comma + 1 : end;
    }
    return 1;
}

/* Squares of larger coordinates overflow. */
#define LARGEST_COORDINATE 1e100

static burnish_status fail_number(const cli_flag *flag, const char *text, const char *what,
                                  burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.60s\" is not %s from %.10g to %.10g",
                    flag->name, text, what, flag->low, flag->high);
}

/* A whole number of at most 18 digits, which fits into 64 bits. */
static int read_count(const char *text, size_t length, uint64_t *value) {
    if (length == 0 || length > 18 || digits(text, length, 0) != length) {
        return 0;
    }
    *value = 0;
    for (size_t i = 0; i < length; ++i) {
        *value = *value * 10 + (uint64_t)(text[i] - '0');
    }
    return 1;
}

static int in_range(const cli_flag *flag, uint64_t value) {
    return value >= (uint64_t)flag->low && value <= (uint64_t)flag->high;
}

burnish_status cli_flag_switch(const cli_flag *flag, const char *text, void *target,
                               burnish_error *error) {
    (void)flag, (void)text, (void)error;
    *(int *)target = 1;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_text(const cli_flag *flag, const char *text, void *target,
                             burnish_error *error) {
    if (!*text) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: the value is empty: --%s=%s",
                        flag->name, flag->name, flag->value);
    }
    *(const char **)target = text;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_file(const cli_flag *flag, const char *text, void *target,
                             burnish_error *error) {
    return cli_flag_text(flag, text ? text : "-", target, error);
}

burnish_status cli_flag_integer(const cli_flag *flag, const char *text, void *target,
                                burnish_error *error) {
    uint64_t value;
    if (!read_count(text, strlen(text), &value) || !in_range(flag, value)) {
        return fail_number(flag, text, "a whole number", error);
    }
    *(int *)target = (int)value;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_count(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    uint64_t value;
    if (!read_count(text, strlen(text), &value) || !in_range(flag, value)) {
        return fail_number(flag, text, "a whole number", error);
    }
    *(uint64_t *)target = value;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_size(const cli_flag *flag, const char *text, void *target,
                             burnish_error *error) {
    const size_t length = strcspn(text, ",xX");
    const char *height = text[length] ? text + length + 1 : text;
    int values[2];
    char width[16];
    burnish_error ignored;
    snprintf(width, sizeof width, "%.*s", (int)(length < 15 ? length : 15), text);
    if (cli_flag_integer(flag, width, &values[0], &ignored) != BURNISH_STATUS_OK ||
        cli_flag_integer(flag, height, &values[1], &ignored) != BURNISH_STATUS_OK) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not a width and a height from %g to %g, such as "
                        "1024x768, or one number for both",
                        flag->name, text, flag->low, flag->high);
    }
    memcpy(target, values, sizeof values);
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_bytes(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    static const char units[] = "KMG";
    size_t length = strlen(text);
    const char *unit = length > 0 ? strchr(units, text[length - 1]) : NULL;
    int shift = unit ? 10 * (int)(unit - units + 1) : 0;
    uint64_t value;
    if (!read_count(text, length - (unit != NULL), &value) || value > UINT64_MAX >> shift ||
        !in_range(flag, value << shift)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not a number of bytes, such as 500M or 2G (K, M, G: "
                        "powers of 1024)",
                        flag->name, text);
    }
    *(uint64_t *)target = value << shift;
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_real(const cli_flag *flag, const char *text, void *target,
                             burnish_error *error) {
    cli_real *real = target;
    double value;
    if (!cli_read_real(text, strlen(text), &value) ||
        !(value >= flag->low && value <= flag->high)) {
        return fail_number(flag, text, "a number", error);
    }
    *real = (cli_real){1, value};
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_angle(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    cli_real *real = target;
    double value;
    if (!cli_read_real(text, strlen(text), &value) || !(value > flag->low && value < flag->high)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not a number between %g and %g", flag->name, text,
                        flag->low, flag->high);
    }
    *real = (cli_real){1, value};
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_vector(const cli_flag *flag, const char *text, void *target,
                               burnish_error *error) {
    cli_vector *vector = target;
    double values[3];
    if (!cli_read_reals(text, strlen(text), values, 3)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not three numbers, such as 1,0.5,-2", flag->name, text);
    }
    for (int k = 0; k < 3; ++k) {
        if (!(fabs(values[k]) <= LARGEST_COORDINATE)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: \"%.60s\" has a number beyond 1e100; give a smaller one",
                            flag->name, text);
        }
    }
    vector->given = 1;
    memcpy(vector->values, values, sizeof values);
    return BURNISH_STATUS_OK;
}

burnish_status cli_flag_nonzero(const cli_flag *flag, const char *text, void *target,
                                burnish_error *error) {
    const cli_vector *vector = target;
    static const char axes[] = "XxYyZz";
    const char *axis = text + (*text == '-' || *text == '+');
    if (*axis && !axis[1] && strchr(axes, *axis)) { /* +Z, -x */
        *(cli_vector *)target = (cli_vector){1, {0, 0, 0}};
        ((cli_vector *)target)->values[(strchr(axes, *axis) - axes) / 2] = *text == '-' ? -1 : 1;
        return BURNISH_STATUS_OK;
    }
    burnish_status status = cli_flag_vector(flag, text, target, error);
    if (status == BURNISH_STATUS_OK && vector->values[0] == 0 && vector->values[1] == 0 &&
        vector->values[2] == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: 0,0,0 has no direction; give a vector that is not zero", flag->name);
    }
    return status;
}

void cli_word_list(const cli_word *words, char *text, size_t size) {
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; words[i].name && used < size; ++i) {
        used +=
            (size_t)snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "", words[i].name);
    }
}

burnish_status cli_flag_word(const cli_flag *flag, const char *text, void *target,
                             burnish_error *error) {
    for (const cli_word *word = flag->words; word->name; ++word) {
        const char *name = word->name + (word->name[0] == '+' && text[0] != '+'); /* z: +Z */
        if (strcasecmp(name, text) == 0) {
            *(int *)target = word->value;
            return BURNISH_STATUS_OK;
        }
    }
    char list[200];
    cli_word_list(flag->words, list, sizeof list);
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.60s\" is not one of %s", flag->name,
                    text, list);
}

cli_type cli_type_of(const cli_flag *flag) {
    static const struct {
        cli_handler *handler;
        cli_type type;
    } types[] = {
        {cli_flag_integer, CLI_TYPE_INTEGER}, {cli_flag_count, CLI_TYPE_INTEGER},
        {cli_flag_bytes, CLI_TYPE_BYTES},     {cli_flag_size, CLI_TYPE_SIZE},
        {cli_flag_real, CLI_TYPE_NUMBER},     {cli_flag_angle, CLI_TYPE_NUMBER},
        {cli_flag_vector, CLI_TYPE_VECTOR},   {cli_flag_nonzero, CLI_TYPE_VECTOR},
    };
    if (flag->value_type != CLI_TYPE_AUTO || !flag->value) {
        return flag->value ? flag->value_type : CLI_TYPE_SWITCH;
    }
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        if (types[i].handler == flag->handler) {
            return types[i].type;
        }
    }
    return flag->words ? CLI_TYPE_WORD : CLI_TYPE_TEXT;
}

const char *cli_type_word(cli_type type) {
#define WORD(constant, word) word,
    static const char *const words[] = {CLI_TYPE_LIST(WORD)};
#undef WORD
    return words[type];
}
