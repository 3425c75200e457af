/* The memory of boundary cosines, and its fixed-point formats. */
#include <math.h>
#include <stdio.h>

#include "theory/internal.h"

enum { MAX_WIDTH = 32 };

/* Reads up to two digits and moves *text past them; -1 without a digit. */
static int read_bits(const char **text) {
    int bits = -1;
    for (int i = 0; i < 2 && **text >= '0' && **text <= '9'; ++i, ++*text) {
        bits = (bits < 0 ? 0 : bits) * 10 + (**text - '0');
    }
    return bits;
}

burnish_status burnish_theory_format_parse(const char *text, burnish_theory_format *format,
                                           burnish_error *error) {
    const char *rest = text ? text : "";
    burnish_theory_format read = {1, 0, 0};
    if (*rest == 'U') {
        read.is_signed = 0;
        ++rest;
    }
    int malformed = *rest != 'Q' || !format;
    if (!malformed) {
        ++rest;
        read.fraction_bits = read_bits(&rest);
        malformed = read.fraction_bits < 0;
        if (!malformed && *rest == '.') {
            ++rest;
            read.integer_bits = read.fraction_bits;
            read.fraction_bits = read_bits(&rest);
            malformed = read.fraction_bits < 0;
        }
    }
    if (malformed || *rest || read.integer_bits + read.fraction_bits == 0 ||
        burnish_theory_format_width(&read) > MAX_WIDTH) {
        return burnish_theory_fail(
            error,
            "\"%.20s\" is not a fixed-point format; use UQ0.15 (unsigned, 0 "
            "integer and 15 fraction bits), Q0.15 (and a sign bit) or Q15, at most "
            "%d bits",
            text ? text : "", MAX_WIDTH);
    }
    *format = read;
    return BURNISH_STATUS_OK;
}

void burnish_theory_format_name(const burnish_theory_format *format, char *text, size_t size) {
    snprintf(text, size, "%sQ%d.%d", format->is_signed ? "" : "U", format->integer_bits,
             format->fraction_bits);
}

int burnish_theory_format_width(const burnish_theory_format *format) {
    return (format->is_signed ? 1 : 0) + format->integer_bits + format->fraction_bits;
}

int64_t burnish_theory_format_encode(const burnish_theory_format *format,
                                     burnish_theory_rounding rounding, double x) {
    double high = ldexp(1, format->integer_bits + format->fraction_bits);
    double low = format->is_signed ? -high : 0;
    double scaled = ldexp(x, format->fraction_bits);
    double whole = floor(scaled);
    if (isnan(x)) {
        return 0;
    }
    /* from the fraction, since scaled + 1/2 may round up itself */
    whole += rounding == BURNISH_THEORY_UP        ? (scaled > whole ? 1 : 0)
             : rounding == BURNISH_THEORY_NEAREST ? (scaled - whole >= 0.5 ? 1 : 0)
                                                  : 0;
    whole = whole < high - 1 ? whole : high - 1;
    return (int64_t)(whole > low ? whole : low);
}

double burnish_theory_format_decode(const burnish_theory_format *format, int64_t word) {
    return ldexp((double)word, -format->fraction_bits);
}

/* The lobe for one exponent, of a lower order if the exponent requires it. */
static burnish_lobe_status model_for(const burnish_lobe_spec *lobe, double exponent,
                                     burnish_theory_model *model) {
    burnish_lobe_spec lower = *lobe;
    burnish_lobe_status status = burnish_theory_model_create(model, &lower, exponent);
    while (status == BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT && lower.order > 2) {
        lower.order /= 2;
        status = burnish_theory_model_create(model, &lower, exponent);
    }
    return status;
}

burnish_status burnish_theory_memory_fill(const burnish_theory_memory *memory,
                                          const double *exponents, size_t count, int64_t *words,
                                          burnish_error *error) {
    int width = burnish_theory_format_width(&memory->format);
    if (!(memory->bits == 0 || (memory->bits >= 1 && memory->bits <= 1024))) {
        return burnish_theory_fail(
            error, "boundary: %g threshold bits; use 1 to 1024, or 0 for the lobe's zero",
            memory->bits);
    }
    if (memory->format.integer_bits < 0 || memory->format.fraction_bits < 0 || width < 1 ||
        width > MAX_WIDTH || (unsigned)memory->rounding > BURNISH_THEORY_UP) {
        return burnish_theory_fail(error,
                                   "boundary: the format has %d bits or an unknown rounding; see "
                                   "burnish_theory_format_parse",
                                   width);
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_theory_model model;
        burnish_lobe_status status = model_for(&memory->lobe, exponents[i], &model);
        if (status != BURNISH_LOBE_OK) {
            return burnish_theory_fail(error, "boundary: exponent %g: %s", exponents[i],
                                       burnish_lobe_status_text(status));
        }
        double x = memory->lambda ? burnish_theory_boundary_lambda(&model, memory->bits)
                                  : burnish_theory_boundary_cosine(&model, memory->bits);
        words[i] = burnish_theory_format_encode(&memory->format, memory->rounding, x);
    }
    return BURNISH_STATUS_OK;
}
