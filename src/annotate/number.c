/* Lengths as text, and round numbers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "annotate/annotate.h"

/* Powers of ten up to 10^22 are exact in double precision. */
static double power_of_ten(int exponent) {
    double power = 1;
    for (int i = 0; i < exponent; ++i) {
        power *= 10;
    }
    return power;
}

static burnish_round_number make_round_number(int digit, int exponent) {
    const double power = power_of_ten(exponent < 0 ? -exponent : exponent);
    return (burnish_round_number){digit, exponent, exponent < 0 ? digit / power : digit * power};
}

burnish_round_number burnish_round_number_below(double limit) {
    static const int digits[] = {5, 2, 1};
    int exponent = 0;
    while (make_round_number(1, exponent).value > limit) {
        --exponent;
    }
    while (make_round_number(1, exponent + 1).value <= limit) {
        ++exponent;
    }
    for (int i = 0; i < 2; ++i) {
        const burnish_round_number number = make_round_number(digits[i], exponent);
        if (number.value <= limit) {
            return number;
        }
    }
    return make_round_number(1, exponent);
}

burnish_round_number burnish_round_number_above(double limit) {
    const burnish_round_number below = burnish_round_number_below(limit);
    if (below.value >= limit) {
        return below;
    }
    return below.digit == 5 ? make_round_number(1, below.exponent + 1)
                            : make_round_number(below.digit == 1 ? 2 : 5, below.exponent);
}

/* Digits and sign only: the decimal separator depends on the locale. */
static int decimal_digits(double value, int count, char *digits) {
    char text[64];
    const char *exponent;
    int kept = 0;
    snprintf(text, sizeof text, "%.*e", count - 1, value);
    exponent = strchr(text, 'e');
    for (const char *c = text; c < exponent; ++c) {
        if (*c >= '0' && *c <= '9' && kept < count) {
            digits[kept++] = *c;
        }
    }
    digits[kept] = 0;
    return (int)strtol(exponent + 1, NULL, 10);
}

/* digits * 10^(exponent + 1 - count), without trailing zeros after the point. */
static void write_fixed(const char *digits, int count, int exponent, char *text) {
    while (count > 1 && count > exponent + 1 && digits[count - 1] == '0') {
        --count;
    }
    if (exponent < 0) {
        *text++ = '0';
        *text++ = '.';
        for (int i = -1; i > exponent; --i) {
            *text++ = '0';
        }
    }
    for (int i = 0; i < count; ++i) {
        *text++ = digits[i];
        if (i == exponent && i + 1 < count) {
            *text++ = '.';
        }
    }
    *text = 0;
}

void burnish_number_text(double value, char text[BURNISH_LABEL_SIZE]) {
    char digits[16];
    if (!(value > 0)) {
        memcpy(text, "0", 2);
        return;
    }
    int count = 4;
    const int exponent = decimal_digits(value, count, digits);
    if (exponent >= 4 && exponent < 8) {
        snprintf(text, BURNISH_LABEL_SIZE, "%ld", (long)(value + 0.5));
        return;
    }
    if (exponent >= -4 && exponent < 4) {
        write_fixed(digits, count, exponent, text);
        return;
    }
    while (count > 1 && digits[count - 1] == '0') {
        digits[--count] = 0;
    }
    snprintf(text, BURNISH_LABEL_SIZE, "%c%s%se%+03d", digits[0], count > 1 ? "." : "", digits + 1,
             exponent);
}
