/* Text to tokens and numbers.
 *
 * Up to 19 digits and small powers of ten are rounded by burnish_scale_decimal(), correctly; the C
 * library's strtod() does the rest. */
#include "mesh/read/io/lexer.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic.h"

/* ---- Numbers ---- */

enum {
    /* No double and no midpoint between two doubles has more than 767 significant digits; of the
     * digits beyond, only whether any is not zero matters, which one more digit represents. */
    SIGNIFICANT_DIGITS = 770,
    EXPONENT_LIMIT = 99999 /* with 771 digits far beyond the range of double on both sides */
};

/* The result of a scan: value = (-1)^negative mantissa 10^exponent, unless digits were dropped. */
typedef struct decimal {
    uint64_t mantissa;
    int64_t exponent;     /* includes the digits after the point */
    int64_t written;      /* the exponent as written after the e */
    const uint8_t *first; /* the digits, with or without a point between them */
    const uint8_t *last;
    int negative;
    int truncated; /* more digits than mantissa holds */
} decimal;

static int is_digit(uint8_t c) {
    return c >= '0' && c <= '9';
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

static int scan_decimal(const uint8_t *p, const uint8_t *end, decimal *d) {
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

static burnish_number_status parse_slowly(const decimal *d, double *value) {
    char copy[SIGNIFICANT_DIGITS + 16];
    write_bounded(d, copy, sizeof copy);
    /* Digits and an exponent without a decimal point read the same in every locale. */
    double result = strtod(copy, NULL);
    if (__builtin_isinf(result)) {
        return BURNISH_NUMBER_RANGE;
    }
    *value = result;
    return BURNISH_NUMBER_OK;
}

burnish_number_status burnish_parse_double(burnish_token token, double *value) {
    decimal d;
    if (!scan_decimal(token.bytes, token.bytes + token.size, &d)) {
        return spells_not_finite(token.bytes, token.size) ? BURNISH_NUMBER_NOT_FINITE
                                                          : BURNISH_NUMBER_GARBAGE;
    }
    if (d.mantissa == 0) {
        *value = d.negative ? -0.0 : 0.0;
        return BURNISH_NUMBER_OK;
    }
    double result;
    if (d.truncated || !burnish_scale_decimal(d.mantissa, d.exponent, &result)) {
        return parse_slowly(&d, value);
    }
    *value = d.negative ? -result : result;
    return BURNISH_NUMBER_OK;
}

burnish_number_status burnish_parse_float(burnish_token token, float *value) {
    double wide;
    burnish_number_status status = burnish_parse_double(token, &wide);
    if (status != BURNISH_NUMBER_OK) {
        return status;
    }
    return burnish_double_to_float(wide, value) ? BURNISH_NUMBER_OK : BURNISH_NUMBER_RANGE;
}

burnish_number_status burnish_parse_integer(burnish_token token, int64_t *value) {
    const uint8_t *p = token.bytes, *end = token.bytes + token.size;
    int negative = 0;
    if (p < end && (*p == '-' || *p == '+')) {
        negative = *p == '-';
        ++p;
    }
    if (p == end) {
        return BURNISH_NUMBER_GARBAGE;
    }
    int64_t result = 0;
    int beyond = 0;
    for (; p < end; ++p) {
        if (!is_digit(*p)) {
            return BURNISH_NUMBER_GARBAGE;
        }
        if (result >= INT64_C(100000000000000000)) {
            beyond = 1;
        } else {
            result = result * 10 + (*p - '0');
        }
    }
    if (beyond) {
        return BURNISH_NUMBER_RANGE;
    }
    *value = negative ? -result : result;
    return BURNISH_NUMBER_OK;
}

/* ---- Tokens ---- */

/* The first byte from p on that is below `limit`, end when there is none; eight at a time. */
static inline const uint8_t *find_below(const uint8_t *p, const uint8_t *end, uint8_t limit) {
    const uint64_t each = UINT64_C(0x0101010101010101);
    while (end - p >= 8) {
        uint64_t word = burnish_load_characters(p);
        uint64_t below = (word - each * limit) & ~word & (each << 7);
        if (below) { /* the lowest is right: borrows go upwards */
            return p + __builtin_ctzll(below) / 8;
        }
        p += 8;
    }
    while (p < end && *p >= limit) {
        ++p;
    }
    return p;
}

static inline const uint8_t *find_line_end(const uint8_t *p, const uint8_t *end) {
    while ((p = find_below(p, end, '\r' + 1)) < end && !burnish_is_line_end(*p)) {
        ++p;
    }
    return p;
}

/* The blank or line end that ends a token. */
static inline const uint8_t *find_token_end(const uint8_t *p, const uint8_t *end) {
    while ((p = find_below(p, end, ' ' + 1)) < end && !burnish_is_blank(*p) &&
           !burnish_is_line_end(*p)) {
        ++p;
    }
    return p;
}

/* Bytes of the line end at p, 0 when there is none. */
static size_t line_end_size(const uint8_t *p, const uint8_t *end) {
    if (p == end || !burnish_is_line_end(*p)) {
        return 0;
    }
    return *p == '\r' && end - p > 1 && p[1] == '\n' ? 2 : 1;
}

burnish_lexer burnish_lexer_open(const uint8_t *bytes, size_t size, int obj_rules) {
    static const uint8_t mark[3] = {0xEF, 0xBB, 0xBF};
    size_t skip = size >= sizeof mark && memcmp(bytes, mark, sizeof mark) == 0 ? sizeof mark : 0;
    if (size == 0) {
        return (burnish_lexer){NULL, NULL, obj_rules};
    }
    return (burnish_lexer){bytes + skip, bytes + size, obj_rules};
}

/* The first byte after blanks and joined line ends. */
static inline const uint8_t *skip_blanks(burnish_lexer *lexer) {
    const uint8_t *p = lexer->next, *end = lexer->end;
    for (;;) {
        while (p < end && burnish_is_blank(*p)) {
            ++p;
        }
        size_t joined = p < end && *p == '\\' && lexer->obj_rules ? line_end_size(p + 1, end) : 0;
        if (joined == 0) {
            lexer->next = p;
            return p;
        }
        p += 1 + joined;
    }
}

int burnish_lexer_token(burnish_lexer *lexer, burnish_token *token) {
    const uint8_t *first = skip_blanks(lexer), *end = lexer->end;
    if (first == end || burnish_is_line_end(*first) || (lexer->obj_rules && *first == '#')) {
        return 0;
    }
    const uint8_t *p = find_token_end(first, end);
    /* A '\' that joins lines is not part of a token, and was not skipped as the first byte. */
    p -= lexer->obj_rules && p < end && burnish_is_line_end(*p) && p[-1] == '\\';
    *token = (burnish_token){first, (size_t)(p - first)};
    lexer->next = p;
    return 1;
}

/* "1,5" in a line without points after it, and "1.5D+00". A comma that might separate thousands or
 * values is no decimal comma. */
static __attribute__((noinline)) burnish_number_status
parse_odd(const burnish_lexer *lexer, burnish_token token, double *value) {
    uint8_t copy[64];
    size_t commas = 0;
    int has_point = 0;
    for (size_t i = 0; i < token.size && i < sizeof copy; ++i) {
        const uint8_t c = token.bytes[i];
        const int is_between = i > 0 && i + 1 < token.size && is_digit(token.bytes[i - 1]) &&
                               is_digit(token.bytes[i + 1]);
        commas += c == ',' ? is_between ? 1 : 2 : 0;
        has_point |= c == '.';
        copy[i] = c == ',' ? '.' : (c | 0x20) == 'd' ? 'e' : c;
    }
    if (commas == 1) {
        enum { AHEAD = 1 << 10 }; /* values of a whole file may be on one line */
        const uint8_t *most = lexer->end - lexer->next > AHEAD ? lexer->next + AHEAD : lexer->end;
        const uint8_t *end = find_line_end(lexer->next, most);
        has_point |= memchr(lexer->next, '.', (size_t)(end - lexer->next)) != NULL;
    }
    if (token.size > sizeof copy || commas > 1 || (commas == 1 && has_point)) {
        return BURNISH_NUMBER_GARBAGE;
    }
    const burnish_number_status status =
        burnish_parse_double((burnish_token){copy, token.size}, value);
    return status == BURNISH_NUMBER_OK ? BURNISH_NUMBER_ODD : status;
}

static inline int read_double(burnish_lexer *lexer, burnish_token *token, double *value,
                              burnish_number_status *status) {
    const uint8_t *first = skip_blanks(lexer);
    if (lexer->end - first > BURNISH_DECIMAL_ROOM) {
        double scanned;
        const size_t size = burnish_scan_decimal(first, &scanned);
        if (size > 0 && (burnish_is_blank(first[size]) || burnish_is_line_end(first[size]))) {
            *token = (burnish_token){first, size};
            *value = scanned;
            *status = BURNISH_NUMBER_OK;
            lexer->next = first + size;
            return 1;
        }
    }
    if (!burnish_lexer_token(lexer, token)) {
        return 0;
    }
    *status = burnish_parse_double(*token, value);
    if (*status == BURNISH_NUMBER_GARBAGE) {
        *status = parse_odd(lexer, *token, value);
    }
    return 1;
}

int burnish_lexer_double(burnish_lexer *lexer, burnish_token *token, double *value,
                         burnish_number_status *status) {
    return read_double(lexer, token, value, status);
}

int burnish_lexer_float(burnish_lexer *lexer, burnish_token *token, float *value,
                        burnish_number_status *status) {
    double wide;
    if (!read_double(lexer, token, &wide, status)) {
        return 0;
    }
    if ((*status == BURNISH_NUMBER_OK || *status == BURNISH_NUMBER_ODD) &&
        !burnish_double_to_float(wide, value)) {
        *status = BURNISH_NUMBER_RANGE;
    }
    return 1;
}

int burnish_lexer_count(burnish_lexer *lexer, uint64_t *value) {
    const uint8_t *p = lexer->next;
    uint64_t found = 0;
    while (p < lexer->end && *p == ' ') {
        ++p;
    }
    if (lexer->end - p <= BURNISH_DECIMAL_ROOM) {
        return 0;
    }
    unsigned digits = burnish_scan_digits(&p, &found);
    if (digits == 0 || digits > 18 || !(burnish_is_blank(*p) || burnish_is_line_end(*p))) {
        return 0;
    }
    *value = found;
    lexer->next = p;
    return 1;
}

int burnish_lexer_word(burnish_lexer *lexer, burnish_token *token) {
    while (!burnish_lexer_token(lexer, token)) {
        if (!burnish_lexer_next_line(lexer)) {
            return 0;
        }
    }
    return 1;
}

int burnish_lexer_word_double(burnish_lexer *lexer, burnish_token *token, double *value,
                              burnish_number_status *status) {
    while (!read_double(lexer, token, value, status)) {
        if (!burnish_lexer_next_line(lexer)) {
            return 0;
        }
    }
    return 1;
}

burnish_token burnish_lexer_rest(burnish_lexer *lexer) {
    const uint8_t *first = lexer->next;
    while (first < lexer->end && burnish_is_blank(*first)) {
        ++first;
    }
    const uint8_t *p = find_line_end(first, lexer->end);
    lexer->next = p;
    while (p > first && burnish_is_blank(p[-1])) {
        --p;
    }
    return (burnish_token){first, (size_t)(p - first)};
}

int burnish_lexer_next_line(burnish_lexer *lexer) {
    const uint8_t *p = find_line_end(lexer->next, lexer->end);
    size_t size = line_end_size(p, lexer->end);
    lexer->next = size > 0 ? p + size : p;
    if (lexer->next == lexer->end) {
        return 0;
    }
    return 1;
}

int burnish_token_is(burnish_token token, const char *word) {
    size_t length = strlen(word);
    return token.size == length && memcmp(token.bytes, word, length) == 0;
}

int burnish_bytes_are_caseless(const uint8_t *bytes, const uint8_t *small, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        uint8_t c = bytes[i];
        if ((c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c) != small[i]) {
            return 0;
        }
    }
    return 1;
}

int burnish_token_is_caseless(burnish_token token, const char *word) {
    return token.size == strlen(word) &&
           burnish_bytes_are_caseless(token.bytes, (const uint8_t *)word, token.size);
}

/* Adds up to 255 comparisons per byte, so the compiler can compare a vector of bytes at a time. */
size_t burnish_count_lines(const uint8_t *first, const uint8_t *end) {
    size_t count = 0;
    while (first < end) {
        const ptrdiff_t left = end - first - 1, size = left < 240 ? left : 240;
        uint8_t found = 0;
        for (ptrdiff_t i = 0; i < size; ++i) {
            found = (uint8_t)(found +
                              ((first[i] == '\n') | ((first[i] == '\r') & (first[i + 1] != '\n'))));
        }
        count += found;
        first += size;
        if (left <= 240) { /* the last byte: nothing is read after it */
            count += (size_t)burnish_is_line_end(*first++);
        }
    }
    return count;
}

burnish_quote burnish_token_quote(burnish_token token) {
    enum { SHOWN = 40 };
    burnish_quote quote;
    size_t length = token.size <= SHOWN ? token.size : SHOWN - 3;
    for (size_t i = 0; i < length; ++i) {
        uint8_t c = token.bytes[i];
        quote.text[i] = (char)(c >= 32 && c < 127 ? c : '?');
    }
    strcpy(quote.text + length, token.size <= SHOWN ? "" : "...");
    return quote;
}
