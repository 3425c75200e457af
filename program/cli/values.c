/* Values of flags: numbers, vectors, colours, words. */
#include "cli/values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "burnish/core.h"
#include "cli/platform.h"

const char cli_color_forms[] = "a colour: #rgb, #rrggbb, r,g,b from 0 to 1, or a name";

typedef struct named_color {
    const char *name;
    int32_t rgb;
} named_color;

/* CSS values, except for strong primaries, which are toned down to look like paint. */
static const named_color own_colors[] = {
    {"white", 0xffffff},  {"silver", 0xc0c0c0}, {"grey", 0x808080},   {"gray", 0x808080},
    {"black", 0x000000},  {"red", 0xcc2c28},    {"orange", 0xec8024}, {"yellow", 0xf0c830},
    {"green", 0x389448},  {"teal", 0x1c8488},   {"blue", 0x2c60c0},   {"navy", 0x18285c},
    {"purple", 0x744098}, {"brown", 0x7c5030},  {"gold", 0xd8a440},   {"copper", 0xc8704c},
    {"ivory", 0xf4ecd8},
};

/* The other names of CSS Color Module Level 4, section 6.1. */
static const named_color css_colors[] = {{"aliceblue", 0xf0f8ff},
                                         {"antiquewhite", 0xfaebd7},
                                         {"aqua", 0x00ffff},
                                         {"aquamarine", 0x7fffd4},
                                         {"azure", 0xf0ffff},
                                         {"beige", 0xf5f5dc},
                                         {"bisque", 0xffe4c4},
                                         {"blanchedalmond", 0xffebcd},
                                         {"blueviolet", 0x8a2be2},
                                         {"burlywood", 0xdeb887},
                                         {"cadetblue", 0x5f9ea0},
                                         {"chartreuse", 0x7fff00},
                                         {"chocolate", 0xd2691e},
                                         {"coral", 0xff7f50},
                                         {"cornflowerblue", 0x6495ed},
                                         {"cornsilk", 0xfff8dc},
                                         {"crimson", 0xdc143c},
                                         {"cyan", 0x00ffff},
                                         {"darkblue", 0x00008b},
                                         {"darkcyan", 0x008b8b},
                                         {"darkgoldenrod", 0xb8860b},
                                         {"darkgray", 0xa9a9a9},
                                         {"darkgreen", 0x006400},
                                         {"darkgrey", 0xa9a9a9},
                                         {"darkkhaki", 0xbdb76b},
                                         {"darkmagenta", 0x8b008b},
                                         {"darkolivegreen", 0x556b2f},
                                         {"darkorange", 0xff8c00},
                                         {"darkorchid", 0x9932cc},
                                         {"darkred", 0x8b0000},
                                         {"darksalmon", 0xe9967a},
                                         {"darkseagreen", 0x8fbc8f},
                                         {"darkslateblue", 0x483d8b},
                                         {"darkslategray", 0x2f4f4f},
                                         {"darkslategrey", 0x2f4f4f},
                                         {"darkturquoise", 0x00ced1},
                                         {"darkviolet", 0x9400d3},
                                         {"deeppink", 0xff1493},
                                         {"deepskyblue", 0x00bfff},
                                         {"dimgray", 0x696969},
                                         {"dimgrey", 0x696969},
                                         {"dodgerblue", 0x1e90ff},
                                         {"firebrick", 0xb22222},
                                         {"floralwhite", 0xfffaf0},
                                         {"forestgreen", 0x228b22},
                                         {"fuchsia", 0xff00ff},
                                         {"gainsboro", 0xdcdcdc},
                                         {"ghostwhite", 0xf8f8ff},
                                         {"goldenrod", 0xdaa520},
                                         {"greenyellow", 0xadff2f},
                                         {"honeydew", 0xf0fff0},
                                         {"hotpink", 0xff69b4},
                                         {"indianred", 0xcd5c5c},
                                         {"indigo", 0x4b0082},
                                         {"khaki", 0xf0e68c},
                                         {"lavender", 0xe6e6fa},
                                         {"lavenderblush", 0xfff0f5},
                                         {"lawngreen", 0x7cfc00},
                                         {"lemonchiffon", 0xfffacd},
                                         {"lightblue", 0xadd8e6},
                                         {"lightcoral", 0xf08080},
                                         {"lightcyan", 0xe0ffff},
                                         {"lightgoldenrodyellow", 0xfafad2},
                                         {"lightgray", 0xd3d3d3},
                                         {"lightgreen", 0x90ee90},
                                         {"lightgrey", 0xd3d3d3},
                                         {"lightpink", 0xffb6c1},
                                         {"lightsalmon", 0xffa07a},
                                         {"lightseagreen", 0x20b2aa},
                                         {"lightskyblue", 0x87cefa},
                                         {"lightslategray", 0x778899},
                                         {"lightslategrey", 0x778899},
                                         {"lightsteelblue", 0xb0c4de},
                                         {"lightyellow", 0xffffe0},
                                         {"lime", 0x00ff00},
                                         {"limegreen", 0x32cd32},
                                         {"linen", 0xfaf0e6},
                                         {"magenta", 0xff00ff},
                                         {"maroon", 0x800000},
                                         {"mediumaquamarine", 0x66cdaa},
                                         {"mediumblue", 0x0000cd},
                                         {"mediumorchid", 0xba55d3},
                                         {"mediumpurple", 0x9370db},
                                         {"mediumseagreen", 0x3cb371},
                                         {"mediumslateblue", 0x7b68ee},
                                         {"mediumspringgreen", 0x00fa9a},
                                         {"mediumturquoise", 0x48d1cc},
                                         {"mediumvioletred", 0xc71585},
                                         {"midnightblue", 0x191970},
                                         {"mintcream", 0xf5fffa},
                                         {"mistyrose", 0xffe4e1},
                                         {"moccasin", 0xffe4b5},
                                         {"navajowhite", 0xffdead},
                                         {"oldlace", 0xfdf5e6},
                                         {"olive", 0x808000},
                                         {"olivedrab", 0x6b8e23},
                                         {"orangered", 0xff4500},
                                         {"orchid", 0xda70d6},
                                         {"palegoldenrod", 0xeee8aa},
                                         {"palegreen", 0x98fb98},
                                         {"paleturquoise", 0xafeeee},
                                         {"palevioletred", 0xdb7093},
                                         {"papayawhip", 0xffefd5},
                                         {"peachpuff", 0xffdab9},
                                         {"peru", 0xcd853f},
                                         {"pink", 0xffc0cb},
                                         {"plum", 0xdda0dd},
                                         {"powderblue", 0xb0e0e6},
                                         {"rebeccapurple", 0x663399},
                                         {"rosybrown", 0xbc8f8f},
                                         {"royalblue", 0x4169e1},
                                         {"saddlebrown", 0x8b4513},
                                         {"salmon", 0xfa8072},
                                         {"sandybrown", 0xf4a460},
                                         {"seagreen", 0x2e8b57},
                                         {"seashell", 0xfff5ee},
                                         {"sienna", 0xa0522d},
                                         {"skyblue", 0x87ceeb},
                                         {"slateblue", 0x6a5acd},
                                         {"slategray", 0x708090},
                                         {"slategrey", 0x708090},
                                         {"snow", 0xfffafa},
                                         {"springgreen", 0x00ff7f},
                                         {"steelblue", 0x4682b4},
                                         {"tan", 0xd2b48c},
                                         {"thistle", 0xd8bfd8},
                                         {"tomato", 0xff6347},
                                         {"turquoise", 0x40e0d0},
                                         {"violet", 0xee82ee},
                                         {"wheat", 0xf5deb3},
                                         {"whitesmoke", 0xf5f5f5},
                                         {"yellowgreen", 0x9acd32}};

static int32_t find_name(const named_color *colors, size_t count, const char *name, size_t length) {
    for (size_t i = 0; i < count; ++i) {
        if (strlen(colors[i].name) == length && strncasecmp(colors[i].name, name, length) == 0) {
            return colors[i].rgb;
        }
    }
    return -1;
}

/* The colour of a name as 0xrrggbb; -1: unknown. Upper and lower case are the same. */
static int32_t find_color(const char *name, size_t length) {
    const int32_t own = find_name(own_colors, sizeof own_colors / sizeof *own_colors, name, length);
    return own >= 0 ? own
                    : find_name(css_colors, sizeof css_colors / sizeof *css_colors, name, length);
}

const char *cli_color_name(size_t index) {
    return index < sizeof own_colors / sizeof *own_colors ? own_colors[index].name : NULL;
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
    const int32_t named = find_color(text, length);
    if (named >= 0) {
        for (int k = 0; k < 3; ++k) {
            srgb[k] = (float)(named >> (16 - 8 * k) & 255) / 255.0F;
        }
        return 1;
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
