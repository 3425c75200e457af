/* Text to tokens and numbers: a cursor over text in memory. Nothing is copied, and no byte after
 * the last is read. Lines are not counted; messages derive the line from the byte.
 *
 * Numbers are decimal, correctly rounded, whatever locale the program runs in. Common forms are
 * read eight characters at a time by functions that return 0 for other forms. Their values equal
 * those of burnish_parse_double(). */
#ifndef BURNISH_MESH_READ_IO_LEXER_H
#define BURNISH_MESH_READ_IO_LEXER_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/* Some bytes of the text, without blanks around them. */
typedef struct burnish_token {
    const uint8_t *bytes;
    size_t size;
} burnish_token;

typedef struct burnish_lexer {
    const uint8_t *next;
    const uint8_t *end;
    int obj_rules; /* 1: '#' begins a comment, and '\\' before a line end joins lines (OBJ, MTL) */
} burnish_lexer;

static inline int burnish_is_blank(uint8_t c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
static inline int burnish_is_line_end(uint8_t c) {
    return c == '\n' || c == '\r';
}

/* A byte order mark at the start is skipped. */
burnish_lexer burnish_lexer_open(const uint8_t *bytes, size_t size, int obj_rules);

/* The next token of this line; 0 at its end. */
int burnish_lexer_token(burnish_lexer *lexer, burnish_token *token);

/* The next token of this line or a later one; 0 at the end of the text. */
int burnish_lexer_word(burnish_lexer *lexer, burnish_token *token);

/* The rest of this line, including comments, without blanks around it; possibly empty. */
burnish_token burnish_lexer_rest(burnish_lexer *lexer);

/* Moves to the start of the next line ("\n", "\r\n" or "\r" end one); 0 at the end of the text. */
int burnish_lexer_next_line(burnish_lexer *lexer);

/* Moves over blanks and line ends. */
static inline void burnish_lexer_skip_blank_lines(burnish_lexer *lexer) {
    while (lexer->next < lexer->end &&
           (burnish_is_blank(*lexer->next) || burnish_is_line_end(*lexer->next))) {
        ++lexer->next;
    }
}

int burnish_token_is(burnish_token token, const char *word);
int burnish_token_is_caseless(burnish_token token, const char *word); /* word in small letters */
int burnish_bytes_are_caseless(const uint8_t *bytes, const uint8_t *small, size_t size);

/* A token for a message: at most 40 characters, "..." if it was cut, '?' for anything outside
 * printable ASCII. */
typedef struct burnish_quote {
    char text[44];
} burnish_quote;
burnish_quote burnish_token_quote(burnish_token token);

/* Line ends in [first, end): "\n", "\r\n" or "\r". */
size_t burnish_count_lines(const uint8_t *first, const uint8_t *end);

/* ---- Numbers ---- */

typedef enum burnish_number_status {
    BURNISH_NUMBER_OK,
    BURNISH_NUMBER_GARBAGE,    /* empty, hexadecimal, or not a decimal number */
    BURNISH_NUMBER_NOT_FINITE, /* nan or inf in one of the spellings that C libraries print */
    BURNISH_NUMBER_ODD,        /* a lexer's only: a decimal comma, or D for e; the value is set */
    BURNISH_NUMBER_RANGE       /* rounds to infinity, or an integer beyond 18 digits */
} burnish_number_status;

/* [sign] digits [. digits] [e [sign] digits], at least one digit before the exponent; to the
 * nearest double, ties to even. The text may have any length. *value is set only on OK. */
burnish_number_status burnish_parse_double(burnish_token token, double *value);

/* The double above rounded to float; RANGE when that is infinite. */
burnish_number_status burnish_parse_float(burnish_token token, float *value);

/* [sign] digits, at most 18 of them after leading zeros. */
burnish_number_status burnish_parse_integer(burnish_token token, int64_t *value);

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

/* The next token of this line and its number; *value is set only if *status is OK. Returns 0 at the
 * end of the line. */
int burnish_lexer_double(burnish_lexer *lexer, burnish_token *token, double *value,
                         burnish_number_status *status);
int burnish_lexer_float(burnish_lexer *lexer, burnish_token *token, float *value,
                        burnish_number_status *status);

/* The same of this line or a later one; 0 at the end of the text. */
int burnish_lexer_word_double(burnish_lexer *lexer, burnish_token *token, double *value,
                              burnish_number_status *status);

/* The next token of this line, if it consists of fewer than 19 digits and is not at the very end of
 * the text; otherwise returns 0 and moves nothing. */
int burnish_lexer_count(burnish_lexer *lexer, uint64_t *value);

/* ---- Common decimals ---- */

/* Bytes that must follow the start of a decimal or of a face's corner. These functions then need
 * not test for the end of the text: it is the longest form that they accept, plus the eight bytes
 * that they read beyond it. */
enum { BURNISH_DECIMAL_ROOM = 96 };

/* Any number of so many digits fits 64 bits. */
enum { BURNISH_DECIMAL_DIGITS = 19 };

/* Eight characters, the first in the lowest byte. */
static inline uint64_t burnish_load_characters(const uint8_t *text) {
    uint64_t word;
    memcpy(&word, text, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    return word;
}

/* The value of eight digits, each a byte of 0 to 9. */
static inline uint64_t burnish_join_digits(uint64_t word) {
    /* pairs, then fours, then the whole */
    word = (word * 10 + (word >> 8)) & UINT64_C(0x00FF00FF00FF00FF);
    word = (word * 100 + (word >> 16)) & UINT64_C(0x0000FFFF0000FFFF);
    return (word * 10000 + (word >> 32)) & UINT64_C(0xFFFFFFFF);
}

/* Bits in the bytes that are not digits, for eight characters minus '0'. They are reliable for the
 * first such byte, since carries go upwards. */
static inline uint64_t burnish_find_other(uint64_t word) {
    return ((word + UINT64_C(0x7676767676767676)) | word) & UINT64_C(0x8080808080808080);
}

/* Digits at the start of eight characters, 0 to 8, and their value. */
static inline unsigned burnish_scan_eight(const uint8_t *text, uint64_t *value) {
    uint64_t word = burnish_load_characters(text) ^ UINT64_C(0x3030303030303030);
    const uint64_t other = burnish_find_other(word);
    unsigned digits = other ? (unsigned)__builtin_ctzll(other) / 8 : 8;
    if (digits == 0) {
        *value = 0;
        return 0;
    }
    /* with zeros in front it is always eight digits */
    *value = burnish_join_digits(word << 8 * (8 - digits));
    return digits;
}

/* Reads digits from *text on, moves it past them and appends them to *value. Returns their count.
 * Above 24 digits the value is invalid. */
static inline unsigned burnish_scan_digits(const uint8_t **text, uint64_t *value) {
    static const uint32_t power[9] = {1,      10,      100,      1000,     10000,
                                      100000, 1000000, 10000000, 100000000};
    unsigned count = 0, more;
    do {
        uint64_t next;
        more = burnish_scan_eight(*text, &next);
        *value = *value * power[more] + next;
        *text += more;
        count += more;
    } while (more == 8 && count < 24);
    return count;
}

/* Moves past the next word of this line or a later one if it is `word`, in any case: up to eight
 * small letters, known to the compiler. Returns 0, and moves nothing, for any other one and near
 * the end of the text. */
static inline __attribute__((always_inline)) int burnish_lexer_skip_word(burnish_lexer *lexer,
                                                                         const char *word) {
    const size_t size = strlen(word);
    uint8_t letters[8] = {0};
    burnish_lexer after = *lexer;
    burnish_lexer_skip_blank_lines(&after);
    if (after.end - after.next <= 8) {
        return 0;
    }
    memcpy(letters, word, size);
    /* No other characters become small letters with this bit. */
    const uint64_t text = burnish_load_characters(after.next) | UINT64_C(0x2020202020202020);
    const uint64_t other = text ^ burnish_load_characters(letters);
    const uint8_t behind = after.next[size];
    if (other << (64 - 8 * size) != 0 ||
        !(burnish_is_blank(behind) || burnish_is_line_end(behind))) {
        return 0;
    }
    lexer->next = after.next + size;
    return 1;
}

#ifdef __SIZEOF_INT128__
/* 5^0 to 5^27, which fits a word. */
static const uint64_t burnish_power_of_five[28] = {1,
                                                   5,
                                                   25,
                                                   125,
                                                   625,
                                                   3125,
                                                   15625,
                                                   78125,
                                                   390625,
                                                   1953125,
                                                   9765625,
                                                   48828125,
                                                   244140625,
                                                   1220703125,
                                                   6103515625,
                                                   30517578125,
                                                   152587890625,
                                                   762939453125,
                                                   3814697265625,
                                                   19073486328125,
                                                   95367431640625,
                                                   476837158203125,
                                                   2384185791015625,
                                                   11920928955078125,
                                                   59604644775390625,
                                                   298023223876953125,
                                                   1490116119384765625,
                                                   7450580596923828125};

/* mantissa * 10^exponent, to the nearest, for exponents of -27 to -1. With both top bits set the
 * quotient has 63 or 64 bits; its lowest bit, below those that rounding looks at, says whether the
 * division left a remainder. */
static inline double burnish_divide_decimal(uint64_t mantissa, int64_t exponent) {
    __extension__ typedef unsigned __int128 wide;
    uint64_t divisor = burnish_power_of_five[-exponent];
    int mantissa_zeros = __builtin_clzll(mantissa), divisor_zeros = __builtin_clzll(divisor);
    wide dividend = (wide)(mantissa << mantissa_zeros) << 63;
    divisor <<= divisor_zeros;
    uint64_t quotient = (uint64_t)(dividend / divisor);
    quotient |= (wide)quotient * divisor != dividend;
    /* quotient = mantissa / 5^k 2^shift; the result is normal, since 1 / 10^27 is. */
    int shift = mantissa_zeros - divisor_zeros + 63;
    uint64_t bits = (uint64_t)(1023 + exponent - shift) << 52;
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return (double)quotient * scale;
}
#endif

/* mantissa * 10^exponent to the nearest double, ties to even; 0 if that needs more than the
 * bits of two words. mantissa > 0. */
static inline int burnish_scale_decimal(uint64_t mantissa, int64_t exponent, double *value) {
    /* A mantissa of at most 2^53 and a power of ten of at most 10^22 are both exact doubles, so one
     * multiplication or division rounds once and correctly (W. D. Clinger, "How to read floating
     * point numbers accurately", PLDI 1990). */
    static const double power_of_ten[23] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (mantissa <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22) {
        double whole = (double)mantissa;
        *value = exponent < 0 ? whole / power_of_ten[-exponent] : whole * power_of_ten[exponent];
        return 1;
    }
#ifdef __SIZEOF_INT128__
    if (exponent < 0 && exponent >= -27) {
        *value = burnish_divide_decimal(mantissa, exponent);
        return 1;
    }
#endif
    return 0;
}

/* Applies a sign without a branch, because the signs of coordinates are unpredictable. */
static inline double burnish_set_sign(double absolute, int negative) {
    uint64_t bits;
    memcpy(&bits, &absolute, sizeof bits);
    bits |= (uint64_t)negative << 63;
    memcpy(&absolute, &bits, sizeof bits);
    return absolute;
}

/* "-1.234567e+00", with two or three digits of exponent: what C's "%e" prints. All fields have
 * fixed positions, so the next number need not wait until the digits of this one are counted. As
 * burnish_scan_decimal. */
static inline size_t burnish_scan_scientific(const uint8_t *text, double *value) {
    enum { DECIMALS = 6 };
    const int negative = *text == '-';
    const uint8_t *p = text + negative;
    const uint64_t word = burnish_load_characters(p) ^ UINT64_C(0x3030303030302E30);
    const int small = p[9] == '-';
    const unsigned digits[3] = {p[10] - 48U, p[11] - 48U, p[12] - 48U};
    if ((p[8] | 0x20) != 'e' || (burnish_find_other(word) | (word & 0xFF00)) != 0 ||
        !(small | (p[9] == '+')) || digits[0] > 9 || digits[1] > 9) {
        return 0;
    }
    int exponent = (int)(10 * digits[0] + digits[1]);
    size_t size = 12;
    if (digits[2] <= 9) {
        exponent = 10 * exponent + (int)digits[2];
        ++size;
    }
    exponent = (exponent ^ -small) + small - DECIMALS;
    /* the first digit over the point's place */
    const uint64_t mantissa = burnish_join_digits((word & ~UINT64_C(0xFFFF)) | (word & 0xFF) << 8);
    double absolute;
    if (exponent < -22 || exponent > 22) {
        return 0;
    }
    burnish_scale_decimal(mantissa, exponent, &absolute);
    *value = burnish_set_sign(absolute, negative);
    return size + (size_t)negative;
}

/* [sign] digits [. digits] [e [sign] digits] at the start of a text with BURNISH_DECIMAL_ROOM
 * characters: how many of them, 0 when it is not taken. */
static inline size_t burnish_scan_decimal(const uint8_t *text, double *value) {
    const uint8_t *p = text;
    int negative = *p == '-';
    uint64_t mantissa = 0;
    const size_t common = burnish_scan_scientific(text, value);
    if (common > 0) {
        return common;
    }
    p += negative;
    unsigned digits = burnish_scan_digits(&p, &mantissa), fraction = 0;
    if (*p == '.') {
        ++p;
        fraction = burnish_scan_digits(&p, &mantissa);
    }
    if (digits + fraction == 0 || digits + fraction > BURNISH_DECIMAL_DIGITS) {
        return 0;
    }
    int64_t exponent = -(int64_t)fraction;
    if ((*p | 0x20) == 'e') {
        int small = p[1] == '-';
        p += 1 + (small || p[1] == '+');
        uint64_t written;
        unsigned length = burnish_scan_eight(p, &written);
        if (length == 0 || length == 8) {
            return 0;
        }
        p += length;
        exponent += small ? -(int64_t)written : (int64_t)written;
    }
    double absolute = 0;
    if (mantissa != 0 && !burnish_scale_decimal(mantissa, exponent, &absolute)) {
        return 0;
    }
    *value = burnish_set_sign(absolute, negative);
    return (size_t)(p - text);
}

/* The value of 1 to 8 digits that end here, after as many characters as eight lack. */
static inline uint64_t burnish_join_before(const uint8_t *end, size_t count) {
    const uint64_t word = burnish_load_characters(end - 8) ^ UINT64_C(0x3030303030303030);
    return burnish_join_digits(word & (UINT64_MAX << (64 - 8 * count)));
}

#ifdef __SSE2__
/* Bits of those of 32 characters that are not digits. */
static inline uint32_t burnish_find_others(const uint8_t *text) {
    const __m128i zero = _mm_set1_epi8('0'), nine = _mm_set1_epi8(9);
    const __m128i *words = (const __m128i *)(const void *)text;
    const __m128i first = _mm_sub_epi8(_mm_loadu_si128(words), zero);
    const __m128i second = _mm_sub_epi8(_mm_loadu_si128(words + 1), zero);
    const int low = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(first, nine), first));
    const int high = _mm_movemask_epi8(_mm_cmpeq_epi8(_mm_min_epu8(second, nine), second));
    return ~((uint32_t)low | (uint32_t)high << 16);
}

/* "-1.25": 1 to 8 digits, a point and 1 to 8 digits. As burnish_scan_decimal, but needs 8
 * characters in front. The point and the end are found at once, so the next number need not wait
 * until the digits are read. */
static inline size_t burnish_scan_short_decimal(const uint8_t *text, double *value) {
    static const uint32_t power[9] = {1,      10,      100,      1000,     10000,
                                      100000, 1000000, 10000000, 100000000};
    const size_t negative = *text == '-';
    uint32_t others = burnish_find_others(text) & ~(uint32_t)negative;
    const size_t point = others ? (size_t)__builtin_ctz(others) : 0;
    others &= others - 1;
    const size_t end = others ? (size_t)__builtin_ctz(others) : 0;
    const size_t digits = point - negative, decimals = end - point - 1;
    if (digits - 1 > 7 || decimals - 1 > 7 || text[point] != '.' || (text[end] | 0x20) == 'e') {
        return 0;
    }
    const uint64_t mantissa = burnish_join_before(text + point, digits) * power[decimals] +
                              burnish_join_before(text + end, decimals);
    double absolute = 0;
    if (mantissa != 0 && !burnish_scale_decimal(mantissa, -(int64_t)decimals, &absolute)) {
        return 0;
    }
    *value = burnish_set_sign(absolute, (int)negative);
    return end;
}
#else
static inline size_t burnish_scan_short_decimal(const uint8_t *text, double *value) {
    (void)text, (void)value;
    return 0;
}
#endif

#endif
