/* Numbers of text files: the nearest double, for any digits, grammar and locale. */
#include <float.h>
#include <math.h>

#include "decimal_comma.h"
#include "mesh/read/io/parallel_text.h"
#include "reader_input.h"

/* A decimal of one of the shapes that files hold, and of some that they should not. */
static void random_decimal(uint64_t *state, char *out, size_t size) {
    uint64_t shape = test_random64(state) % 6;
    double value;
    uint64_t bits = test_random64(state);
    switch (shape) {
    case 0:
        snprintf(out, size, "%.*f", (int)(bits % 9), (double)(int64_t)bits / 1e16);
        break;
    case 1:
        snprintf(out, size, "%.*e", (int)(bits % 20), (double)(bits >> 11) * 1e-9);
        break;
    case 2: /* any double at all */
        memcpy(&value, &bits, sizeof value);
        snprintf(out, size, "%.17g", isfinite(value) ? value : 0.1);
        break;
    case 3:
        snprintf(out, size, "%s%llu.%llue%d", bits & 1 ? "-" : "+", (unsigned long long)bits % 1000,
                 (unsigned long long)test_random64(state), (int)(bits % 660) - 330);
        break;
    case 4:
        snprintf(out, size, "%lld.%0*d%llu", (long long)(int64_t)bits >> 40, (int)(bits % 60), 0,
                 (unsigned long long)test_random64(state));
        break;
    default: /* halfway between two doubles: 2^53 + 1 + 2k, exactly and with a tail */
        snprintf(out, size, "%llu%s",
                 (unsigned long long)(UINT64_C(9007199254740993) + (bits & 1022)),
                 bits & 1024 ? ".0000000000000000000000000000001" : "");
    }
}

static burnish_token token_of(const char *text) {
    return (burnish_token){(const uint8_t *)text, strlen(text)};
}

static void check_number(const char *text) {
    double value = 0, expected = strtod(text, NULL);
    burnish_number_status status = burnish_parse_double(token_of(text), &value);
    if (isinf(expected)) {
        CHECK(status == BURNISH_NUMBER_RANGE, "%s", text);
    } else {
        CHECK(status == BURNISH_NUMBER_OK && memcmp(&value, &expected, sizeof value) == 0,
              "%s: %a, strtod %a", text, value, expected);
    }
}

static void test_random_numbers(void) {
    enum { COUNT = 200000 };
    uint64_t state = test_seed(20240607);
    char text[256];
    for (int i = 0; i < COUNT; ++i) {
        random_decimal(&state, text, sizeof text);
        check_number(text);
    }
}

/* Thousands of digits: the copy that is parsed is bounded, the result is as if it were not. */
static void test_long_numbers(void) {
    static char text[5000];
    /* 1 + 2^-53 is halfway between 1 and its neighbour: the tail decides, however far away. */
    const char *half = "1.00000000000000011102230246251565404236316680908203125";
    for (size_t tail = 0; tail < 4000; tail += 97) {
        size_t length = strlen(half);
        memcpy(text, half, length);
        memset(text + length, '0', tail);
        strcpy(text + length + tail, "1");
        check_number(text);
        text[length + tail] = 0;
        check_number(text);
    }
    memset(text, '0', 4000);
    strcpy(text + 4000, "12.5e-1");
    check_number(text);
    memset(text, '9', 4000);
    strcpy(text + 4000, "e-3995");
    check_number(text);
    text[0] = '.';
    strcpy(text + 4000, "e7");
    check_number(text);
    check_number("1e-99999999999999999999");
    check_number("0e99999999999999999999");
    check_number("1e99999999999999999999");
}

static void test_number_grammar(void) {
    static const struct {
        const char *text;
        burnish_number_status status;
        double value;
    } cases[] = {
        {".5", BURNISH_NUMBER_OK, 0.5},
        {"5.", BURNISH_NUMBER_OK, 5},
        {"+1e2", BURNISH_NUMBER_OK, 100},
        {"-1.25E-1", BURNISH_NUMBER_OK, -0.125},
        {"007", BURNISH_NUMBER_OK, 7},
        {"", BURNISH_NUMBER_GARBAGE, 0},
        {"-", BURNISH_NUMBER_GARBAGE, 0},
        {".", BURNISH_NUMBER_GARBAGE, 0},
        {"1e", BURNISH_NUMBER_GARBAGE, 0},
        {"1e+", BURNISH_NUMBER_GARBAGE, 0},
        {"0x10", BURNISH_NUMBER_GARBAGE, 0},
        {"1,5", BURNISH_NUMBER_GARBAGE, 0},
        {"1.5f", BURNISH_NUMBER_GARBAGE, 0},
        {"--1", BURNISH_NUMBER_GARBAGE, 0},
        {"e5", BURNISH_NUMBER_GARBAGE, 0},
        {"1.2.3", BURNISH_NUMBER_GARBAGE, 0},
        {"nan", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-NaN(ind)", BURNISH_NUMBER_NOT_FINITE, 0},
        {"Infinity", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-inf", BURNISH_NUMBER_NOT_FINITE, 0},
        {"-1.#IND", BURNISH_NUMBER_NOT_FINITE, 0},
        {"3.5e38", BURNISH_NUMBER_RANGE, 0},
        {"-1e999", BURNISH_NUMBER_RANGE, 0},
        {"1e-60", BURNISH_NUMBER_OK, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        float value = 0;
        burnish_number_status status = burnish_parse_float(token_of(cases[i].text), &value);
        CHECK(status == cases[i].status && (double)value == cases[i].value, "\"%s\": %d, %g",
              cases[i].text, (int)status, (double)value);
    }
    float largest = 0;
    CHECK1(burnish_parse_float(token_of("3.4028235677973366e38"), &largest) ==
           BURNISH_NUMBER_RANGE);
    CHECK1(burnish_parse_float(token_of("3.4028235677973362e38"), &largest) == BURNISH_NUMBER_OK &&
           largest == FLT_MAX);
}

/* The program that loads a mesh may have set a locale with a decimal comma. */
static void test_decimal_comma(void) {
    static const char obj[] =
        "v 1.5 0 0\nv 2.25e0 1 0\nv 0.1 1.00000000000000000000001 3\nf 1 2 3\n";
    if (!test_decimal_comma_begin()) {
        return;
    }
    CHECK_OK(read_text(BURNISH_FORMAT_OBJ, obj), fault);
    CHECK1(got.streams[BURNISH_POSITION].count == 3 && burnish_positions(&got)[0] == 1.5f &&
           burnish_positions(&got)[3] == 2.25f && burnish_positions(&got)[6] == 0.1f &&
           burnish_positions(&got)[7] == 1);
    test_decimal_comma_end();
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_random_numbers());
    RUN(test_long_numbers());
    RUN(test_number_grammar());
    RUN(test_decimal_comma());
    return test_end("numbers");
}
