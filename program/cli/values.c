/* Values of flags: numbers, vectors, colours, words. */
#include "cli/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/core.h"
#include "cli/platform.h"

const char cli_color_forms[] = "a colour: #rgb, #rrggbb, r,g,b from 0 to 1, or a name";

typedef struct named_color {
    const char *name;
    uint8_t rgb[3];
} named_color;

/* CSS values, except for strong primaries, which are toned down to look like paint. */
static const named_color color_names[] = {
    {"white", {255, 255, 255}}, {"silver", {192, 192, 192}}, {"grey", {128, 128, 128}},
    {"gray", {128, 128, 128}},  {"black", {0, 0, 0}},        {"red", {204, 44, 40}},
    {"orange", {236, 128, 36}}, {"yellow", {240, 200, 48}},  {"green", {56, 148, 72}},
    {"teal", {28, 132, 136}},   {"blue", {44, 96, 192}},     {"navy", {24, 40, 92}},
    {"purple", {116, 64, 152}}, {"brown", {124, 80, 48}},    {"gold", {216, 164, 64}},
    {"copper", {200, 112, 76}}, {"ivory", {244, 236, 216}},
};

const char *cli_color_name(size_t index) {
    return index < sizeof color_names / sizeof *color_names ? color_names[index].name : NULL;
}

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
    int *size = target;
    int values[2];
    const char *rest = text + strcspn(text, ",x");
    size_t length = (size_t)(rest - text);
    char width[16];
    burnish_error ignored;
    if (*rest && length < sizeof width) {
        memcpy(width, text, length);
        width[length] = 0;
        if (cli_flag_integer(flag, width, &values[0], &ignored) == BURNISH_STATUS_OK &&
            cli_flag_integer(flag, rest + 1, &values[1], &ignored) == BURNISH_STATUS_OK) {
            memcpy(size, values, sizeof values);
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.60s\" is not a width and a height from %g to %g, such as 1024,768",
                    flag->name, text, flag->low, flag->high);
}

burnish_status cli_flag_square(const cli_flag *flag, const char *text, void *target,
                               burnish_error *error) {
    int *size = target;
    if (strpbrk(text, ",x")) {
        return cli_flag_size(flag, text, target, error);
    }
    burnish_status status = cli_flag_integer(flag, text, &size[0], error);
    if (status == BURNISH_STATUS_OK) {
        size[1] = size[0];
    }
    return status;
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
        if (strcmp(word->name, text) == 0) {
            *(int *)target = word->value;
            return BURNISH_STATUS_OK;
        }
    }
    char list[200];
    cli_word_list(flag->words, list, sizeof list);
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.60s\" is not one of %s", flag->name,
                    text, list);
}

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    c = (char)(c | 32);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* #rgb and #rrggbb. */
static int read_hex_color(const char *text, size_t length, float srgb[3]) {
    size_t each = length == 4 ? 1 : 2;
    if (length != 4 && length != 7) {
        return 0;
    }
    for (size_t i = 0; i < 3; ++i) {
        int high = hex_digit(text[1 + each * i]);
        int low = hex_digit(text[each * (i + 1)]);
        if (high < 0 || low < 0) {
            return 0;
        }
        srgb[i] = (float)(16 * high + low) / 255.0F;
    }
    return 1;
}

int cli_read_color(const char *text, size_t length, float srgb[3]) {
    double values[3];
    if (length > 0 && text[0] == '#') {
        return read_hex_color(text, length, srgb);
    }
    for (size_t i = 0; i < sizeof color_names / sizeof *color_names; ++i) {
        const named_color *color = &color_names[i];
        if (strlen(color->name) == length && memcmp(color->name, text, length) == 0) {
            for (size_t k = 0; k < 3; ++k) {
                srgb[k] = (float)color->rgb[k] / 255.0F;
            }
            return 1;
        }
    }
    if (!cli_read_reals(text, length, values, 3)) {
        return 0;
    }
    for (size_t k = 0; k < 3; ++k) {
        if (!(values[k] >= 0 && values[k] <= 1)) {
            return 0;
        }
        srgb[k] = (float)values[k];
    }
    return 1;
}

burnish_status cli_flag_color(const cli_flag *flag, const char *text, void *target,
                              burnish_error *error) {
    cli_color *color = target;
    float srgb[3];
    if (!cli_read_color(text, strlen(text), srgb)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.60s\" is not %s", flag->name,
                        text, cli_color_forms);
    }
    color->given = 1;
    memcpy(color->srgb, srgb, sizeof srgb);
    return BURNISH_STATUS_OK;
}

uint8_t cli_color_code(float srgb) {
    return (uint8_t)(srgb * 255.0F + 0.5F);
}

burnish_status cli_choose_isa(const char *name, burnish_isa *isa, burnish_error *error) {
    burnish_error reason;
    burnish_status status = burnish_isa_choose(name, isa, &reason);
    if (status == BURNISH_STATUS_OK) {
        return status;
    }
    int is_variable = strncmp(reason.text, BURNISH_ISA_VARIABLE, strlen(BURNISH_ISA_VARIABLE)) == 0;
    return cli_fail(error, status, "%s%s", is_variable ? "" : "--isa: ", reason.text);
}
