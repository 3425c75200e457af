/* Decimals of plain form, read eight characters at a time: for the loops of the readers.
 *
 * Everything here answers 0 for what it does not take; number.c then judges the text one character
 * at a time. What it takes has the value that number.c would give. */
#ifndef ORACLE_MESH_READ_DECIMAL_H
#define ORACLE_MESH_READ_DECIMAL_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Characters that must lie behind the start of a decimal or of a face's corner for these functions
 * to look at it, so that none of them tests for the end of the text: the longest form that they
 * take, and the eight that they look at beyond. */
enum { ORACLE_DECIMAL_ROOM = 96 };

/* Digits that 64 bits hold whatever they are. */
enum { ORACLE_DECIMAL_DIGITS = 19 };

/* Eight characters, the first in the lowest byte. */
static inline uint64_t oracle_load_characters(const uint8_t *text) {
    uint64_t word;
    memcpy(&word, text, sizeof word);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    word = __builtin_bswap64(word);
#endif
    return word;
}

/* Digits at the start of eight characters, 0 to 8, and their value. */
static inline unsigned oracle_scan_eight(const uint8_t *text, uint64_t *value) {
    uint64_t word = oracle_load_characters(text) ^ UINT64_C(0x3030303030303030);
    /* The lowest high bit stands in the first byte that is no digit: carries go upwards. */
    uint64_t other = ((word + UINT64_C(0x7676767676767676)) | word) & UINT64_C(0x8080808080808080);
    unsigned digits = other ? (unsigned)__builtin_ctzll(other) / 8 : 8;
    if (digits == 0) {
        *value = 0;
        return 0;
    }
    /* With zeros in front it is always eight digits: pairs, then fours, then the whole. */
    word <<= 8 * (8 - digits);
    word = (word * 10 + (word >> 8)) & UINT64_C(0x00FF00FF00FF00FF);
    word = (word * 100 + (word >> 16)) & UINT64_C(0x0000FFFF0000FFFF);
    *value = (word * 10000 + (word >> 32)) & UINT64_C(0xFFFFFFFF);
    return digits;
}

/* Digits from *text on, which is moved behind them; *value takes them in. The count may be more
 * than 24: the value is of no use then. */
static inline unsigned oracle_scan_digits(const uint8_t **text, uint64_t *value) {
    static const uint32_t power[9] = {1,      10,      100,      1000,     10000,
                                      100000, 1000000, 10000000, 100000000};
    unsigned count = 0, more;
    do {
        uint64_t next;
        more = oracle_scan_eight(*text, &next);
        *value = *value * power[more] + next;
        *text += more;
        count += more;
    } while (more == 8 && count < 24);
    return count;
}

/* mantissa * 10^exponent to the nearest double, ties to even; 0 where that needs more than the
 * bits of two words. mantissa > 0. */
static inline int oracle_scale_decimal(uint64_t mantissa, int64_t exponent, double *value) {
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
    /* 10^27 = 5^27 2^27, and 5^27 fits a word. With both top bits set the quotient has 63 or 64
     * bits; whether anything is left of the division stands in the lowest, below those that
     * rounding looks at. */
    if (exponent < 0 && exponent >= -27) {
        static const uint64_t power_of_five[28] = {1,
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
                                                   UINT64_C(6103515625),
                                                   UINT64_C(30517578125),
                                                   UINT64_C(152587890625),
                                                   UINT64_C(762939453125),
                                                   UINT64_C(3814697265625),
                                                   UINT64_C(19073486328125),
                                                   UINT64_C(95367431640625),
                                                   UINT64_C(476837158203125),
                                                   UINT64_C(2384185791015625),
                                                   UINT64_C(11920928955078125),
                                                   UINT64_C(59604644775390625),
                                                   UINT64_C(298023223876953125),
                                                   UINT64_C(1490116119384765625),
                                                   UINT64_C(7450580596923828125)};
        __extension__ typedef unsigned __int128 wide;
        uint64_t divisor = power_of_five[-exponent];
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
        *value = (double)quotient * scale;
        return 1;
    }
#endif
    return 0;
}

/* [sign] digits [. digits] [e [sign] digits] at the start of a text with ORACLE_DECIMAL_ROOM
 * characters: how many of them, 0 when it is not taken. */
static inline size_t oracle_scan_decimal(const uint8_t *text, double *value) {
    const uint8_t *p = text;
    int negative = *p == '-';
    uint64_t mantissa = 0;
    p += negative;
    unsigned digits = oracle_scan_digits(&p, &mantissa), behind = 0;
    if (*p == '.') {
        ++p;
        behind = oracle_scan_digits(&p, &mantissa);
    }
    if (digits + behind == 0 || digits + behind > ORACLE_DECIMAL_DIGITS) {
        return 0;
    }
    int64_t exponent = -(int64_t)behind;
    if ((*p | 0x20) == 'e') {
        int small = p[1] == '-';
        p += 1 + (small || p[1] == '+');
        uint64_t written;
        unsigned length = oracle_scan_eight(p, &written);
        if (length == 0 || length == 8) {
            return 0;
        }
        p += length;
        exponent += small ? -(int64_t)written : (int64_t)written;
    }
    double absolute = 0;
    if (mantissa != 0 && !oracle_scale_decimal(mantissa, exponent, &absolute)) {
        return 0;
    }
    /* Signs of coordinates are as good as random: no branch on them. */
    uint64_t bits;
    memcpy(&bits, &absolute, sizeof bits);
    bits |= (uint64_t)negative << 63;
    memcpy(value, &bits, sizeof bits);
    return (size_t)(p - text);
}

#endif
