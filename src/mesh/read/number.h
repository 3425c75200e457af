/* Decimal text to floating point: correctly rounded, whatever locale the program runs in. */
#ifndef BURNISH_MESH_READ_NUMBER_H
#define BURNISH_MESH_READ_NUMBER_H

#include <stddef.h>
#include <stdint.h>

#include "core/arithmetic.h"

typedef enum burnish_number_status {
    BURNISH_NUMBER_OK,
    BURNISH_NUMBER_GARBAGE,    /* empty, hexadecimal, or with anything that is no decimal number */
    BURNISH_NUMBER_NOT_FINITE, /* nan or inf in one of the spellings that C libraries print */
    BURNISH_NUMBER_RANGE,      /* rounds to infinity, or an integer beyond 18 digits */
    BURNISH_NUMBER_MEMORY      /* the C locale could not be made */
} burnish_number_status;

/* What parsing keeps between numbers. Start from all zero; end with burnish_number_reader_close().
 */
typedef struct burnish_number_reader {
    int unused;
} burnish_number_reader;

void burnish_number_reader_close(burnish_number_reader *reader);

/* [sign] digits [. digits] [e [sign] digits], at least one digit before the exponent; to the
 * nearest double, ties to even. The text may have any length. *value is set only on OK. */
burnish_number_status burnish_parse_double(burnish_number_reader *reader, const uint8_t *text,
                                           size_t size, double *value);

/* The double above rounded to float; RANGE when that is infinite. */
burnish_number_status burnish_parse_float(burnish_number_reader *reader, const uint8_t *text,
                                          size_t size, float *value);

/* [sign] digits, at most 18 of them after leading zeros. */
burnish_number_status burnish_parse_integer(const uint8_t *text, size_t size, int64_t *value);

/* Rounds to float; returns 0 when value is NaN or would become infinite, and leaves *rounded alone.
 */
static inline int burnish_double_to_float(double value, float *rounded) {
    /* Halfway between the largest float and 2^128: from here on rounding gives infinity. */
    const double limit = 0x1.ffffffp127;
    if (!(value > -limit && value < limit)) {
        return 0;
    }
    *rounded = (float)value;
    return 1;
}

#endif
