/* Decimal text to floating point: correctly rounded, whatever locale the program runs in. */
#ifndef ORACLE_MESH_READ_NUMBER_H
#define ORACLE_MESH_READ_NUMBER_H

#include <locale.h>
#include <stddef.h>
#include <stdint.h>

typedef enum oracle_number_status {
    ORACLE_NUMBER_OK,
    ORACLE_NUMBER_GARBAGE,    /* empty, hexadecimal, or with anything that is no decimal number */
    ORACLE_NUMBER_NOT_FINITE, /* nan or inf in one of the spellings that C libraries print */
    ORACLE_NUMBER_RANGE,      /* rounds to infinity, or an integer beyond 18 digits */
    ORACLE_NUMBER_MEMORY      /* the C locale could not be made */
} oracle_number_status;

/* What parsing keeps between numbers. Start from all zero; end with oracle_number_reader_close().
 */
typedef struct oracle_number_reader {
    locale_t c_locale; /* made when the first number needs it */
} oracle_number_reader;

void oracle_number_reader_close(oracle_number_reader *reader);

/* [sign] digits [. digits] [e [sign] digits], at least one digit before the exponent; to the
 * nearest double, ties to even. The text may have any length. *value is set only on OK. */
oracle_number_status oracle_parse_double(oracle_number_reader *reader, const uint8_t *text,
                                         size_t size, double *value);

/* The double above rounded to float; RANGE when that is infinite. */
oracle_number_status oracle_parse_float(oracle_number_reader *reader, const uint8_t *text,
                                        size_t size, float *value);

/* [sign] digits, at most 18 of them after leading zeros. */
oracle_number_status oracle_parse_integer(const uint8_t *text, size_t size, int64_t *value);

/* Rounds to float; returns 0 when value is NaN or would become infinite, and leaves *rounded alone.
 */
static inline int oracle_double_to_float(double value, float *rounded) {
    /* Halfway between the largest float and 2^128: from here on rounding gives infinity. */
    const double limit = 0x1.ffffffp127;
    if (!(value > -limit && value < limit)) {
        return 0;
    }
    *rounded = (float)value;
    return 1;
}

#endif
