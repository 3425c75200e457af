/* Decimal text to floating point.
 *
 * Up to 19 digits and small powers of ten are rounded by oracle_scale_decimal(), correctly;
 * everything else goes to the C library in the C locale. */
#include "oracle/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/decimal.h"

enum {
    /* No double and no midpoint between two doubles has more than 767 significant digits; digits
     * beyond decide only by being zero or not, which one further digit tells. */
    SIGNIFICANT_DIGITS = 770,
    EXPONENT_LIMIT = 99999 /* with 771 digits far beyond the range of double on both sides */
};

/* What a scan finds: value = (-1)^negative mantissa 10^exponent, unless digits were left out. */
typedef struct decimal {
    uint64_t mantissa;
    int64_t exponent;     /* includes the digits behind the point */
    int64_t written;      /* the exponent as written behind the e */
    const uint8_t *first; /* the digits, with or without a point between them */
    const uint8_t *last;
    int negative;
    int truncated; /* more digits than mantissa holds */
} decimal;

static int is_digit(uint8_t c) {
    return c >= '0' && c <= '9';
}

void oracle_number_reader_close(oracle_number_reader *reader) {
    if (reader->c_locale) {
        freelocale(reader->c_locale);
        reader->c_locale = (locale_t)0;
    }
}

/* "nan", "-nan(ind)", "inf", "Infinity", and the "1.#QNAN", "-1.#IND", "1.#INF" of older C
 * libraries. */
static int spells_not_finite(const uint8_t *text, size_t size) {
    if (size > 0 && (*text == '-' || *text == '+')) {
        ++text;
        --size;
    }
    if (size < 3) {
        return 0;
    }
    char start[3];
    for (int i = 0; i < 3; ++i) {
        start[i] = (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] + ('a' - 'A') : text[i]);
    }
    return memcmp(start, "nan", 3) == 0 || memcmp(start, "inf", 3) == 0 ||
           memcmp(start, "1.#", 3) == 0;
}

static int scan_exponent(const uint8_t *p, const uint8_t *end, int64_t *exponent) {
    int negative = 0;
    if (p < end && (*p == '-' || *p == '+')) {
        negative = *p == '-';
        ++p;
    }
    if (p == end) {
        return 0;
    }
    int64_t value = 0;
    for (; p < end && is_digit(*p); ++p) {
        if (value < INT64_C(1000000000000000)) {
            value = value * 10 + (*p - '0');
        }
    }
    *exponent = negative ? -value : value;
    return p == end;
}

static int scan(const uint8_t *p, const uint8_t *end, decimal *d) {
    const uint64_t full = UINT64_C(1000000000000000000);
    *d = (decimal){0};
    if (p < end && (*p == '-' || *p == '+')) {
        d->negative = *p == '-';
        ++p;
    }
    d->first = p;
    int64_t digits = 0, point = 0;
    for (; p < end && is_digit(*p); ++p, ++digits) {
        if (d->mantissa < full) {
            d->mantissa = d->mantissa * 10 + (uint64_t)(*p - '0');
        } else {
            d->truncated = 1;
        }
    }
    if (p < end && *p == '.') {
        for (++p; p < end && is_digit(*p); ++p, ++point) {
            if (d->mantissa < full) {
                d->mantissa = d->mantissa * 10 + (uint64_t)(*p - '0');
            } else {
                d->truncated = 1;
            }
        }
    }
    d->last = p;
    if (digits + point == 0) {
        return 0;
    }
    if (p < end && (*p == 'e' || *p == 'E')) {
        if (!scan_exponent(p + 1, end, &d->written)) {
            return 0;
        }
        p = end;
    }
    d->exponent = d->written - point;
    return p == end;
}

/* Writes the number again with a bounded count of digits that rounds the same. */
static void write_bounded(const decimal *d, char *out, size_t out_size) {
    size_t length = 0;
    int64_t exponent = d->exponent;
    int sticky = 0;
    out[length++] = d->negative ? '-' : '+';
    for (const uint8_t *p = d->first; p < d->last; ++p) {
        if (*p == '.' || (length == 1 && *p == '0')) {
            continue;
        }
        if (length <= SIGNIFICANT_DIGITS) {
            out[length++] = (char)*p;
        } else {
            sticky |= *p != '0';
            ++exponent;
        }
    }
    if (sticky) {
        out[length++] = '1';
        --exponent;
    }
    if (exponent > EXPONENT_LIMIT) {
        exponent = EXPONENT_LIMIT;
    } else if (exponent < -EXPONENT_LIMIT) {
        exponent = -EXPONENT_LIMIT;
    }
    snprintf(out + length, out_size - length, "e%d", (int)exponent);
}

static oracle_number_status parse_slowly(oracle_number_reader *reader, const decimal *d,
                                         double *value) {
    char copy[SIGNIFICANT_DIGITS + 16];
    write_bounded(d, copy, sizeof copy);
    if (!reader->c_locale) {
        reader->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
        if (!reader->c_locale) {
            return ORACLE_NUMBER_MEMORY;
        }
    }
    double result = strtod_l(copy, NULL, reader->c_locale);
    if (__builtin_isinf(result)) {
        return ORACLE_NUMBER_RANGE;
    }
    *value = result;
    return ORACLE_NUMBER_OK;
}

oracle_number_status oracle_parse_double(oracle_number_reader *reader, const uint8_t *text,
                                         size_t size, double *value) {
    decimal d;
    if (!scan(text, text + size, &d)) {
        return spells_not_finite(text, size) ? ORACLE_NUMBER_NOT_FINITE : ORACLE_NUMBER_GARBAGE;
    }
    if (d.mantissa == 0) {
        *value = d.negative ? -0.0 : 0.0;
        return ORACLE_NUMBER_OK;
    }
    double result;
    if (d.truncated || !oracle_scale_decimal(d.mantissa, d.exponent, &result)) {
        return parse_slowly(reader, &d, value);
    }
    *value = d.negative ? -result : result;
    return ORACLE_NUMBER_OK;
}

oracle_number_status oracle_parse_float(oracle_number_reader *reader, const uint8_t *text,
                                        size_t size, float *value) {
    double wide;
    oracle_number_status status = oracle_parse_double(reader, text, size, &wide);
    if (status != ORACLE_NUMBER_OK) {
        return status;
    }
    return oracle_double_to_float(wide, value) ? ORACLE_NUMBER_OK : ORACLE_NUMBER_RANGE;
}

oracle_number_status oracle_parse_integer(const uint8_t *text, size_t size, int64_t *value) {
    const uint8_t *p = text, *end = text + size;
    int negative = 0;
    if (p < end && (*p == '-' || *p == '+')) {
        negative = *p == '-';
        ++p;
    }
    if (p == end) {
        return ORACLE_NUMBER_GARBAGE;
    }
    int64_t result = 0;
    int beyond = 0;
    for (; p < end; ++p) {
        if (!is_digit(*p)) {
            return ORACLE_NUMBER_GARBAGE;
        }
        if (result >= INT64_C(100000000000000000)) {
            beyond = 1;
        } else {
            result = result * 10 + (*p - '0');
        }
    }
    if (beyond) {
        return ORACLE_NUMBER_RANGE;
    }
    *value = negative ? -result : result;
    return ORACLE_NUMBER_OK;
}
