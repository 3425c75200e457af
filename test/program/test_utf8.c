/* UTF-8 against the table of well-formed byte sequences of the Unicode standard (table 3-7). */
#include "font/font.h"
#include "support.h"

static int in(unsigned byte, unsigned low, unsigned high) {
    return byte >= low && byte <= high;
}

/* Length of the well-formed sequence that begins the bytes, 0 for none: the table's rows. */
static size_t table_length(const unsigned char *b, size_t n) {
    static const unsigned char rows[8][4] = {{0xC2, 0xDF, 0x80, 0xBF}, {0xE0, 0xE0, 0xA0, 0xBF},
                                             {0xE1, 0xEC, 0x80, 0xBF}, {0xED, 0xED, 0x80, 0x9F},
                                             {0xEE, 0xEF, 0x80, 0xBF}, {0xF0, 0xF0, 0x90, 0xBF},
                                             {0xF1, 0xF3, 0x80, 0xBF}, {0xF4, 0xF4, 0x80, 0x8F}};
    static const size_t lengths[8] = {2, 3, 3, 3, 3, 4, 4, 4};
    if (n > 0 && b[0] < 0x80) {
        return 1;
    }
    for (int i = 0; n > 0 && i < 8; ++i) {
        if (in(b[0], rows[i][0], rows[i][1]) && n >= lengths[i] &&
            in(b[1], rows[i][2], rows[i][3])) {
            int good = 1;
            for (size_t k = 2; k < lengths[i]; ++k) {
                good &= in(b[k], 0x80, 0xBF);
            }
            return good ? lengths[i] : 0;
        }
    }
    return 0;
}

static void check(const unsigned char *bytes, size_t count) {
    uint32_t code;
    const size_t got = utf8_decode((const char *)bytes, count, &code);
    CHECK(got == table_length(bytes, count), "%zu bytes %02x %02x %02x %02x: %zu", count, bytes[0],
          bytes[1], bytes[2], bytes[3], got);
}

/* All sequences of one and two bytes, all of three with a suitable first byte, and of four bytes
 * all first two with the boundaries of the last two. */
static void test_sequences(void) {
    static const unsigned char bounds[] = {0, 0x41, 0x7F, 0x80, 0x8F, 0xBF, 0xC0, 0xFF};
    unsigned char b[4] = {0};
    check(b, 0);
    for (int first = 0; first < 256; ++first) {
        b[0] = (unsigned char)first;
        check(b, 1);
        for (int second = 0; second < 256; ++second) {
            b[1] = (unsigned char)second;
            check(b, 2);
            for (int i = 0; i < 8 && first >= 0xC0; ++i) {
                b[2] = bounds[i];
                check(b, 3);
                for (int k = 0; k < 8; ++k) {
                    b[3] = bounds[k];
                    check(b, 4);
                }
            }
        }
    }
    for (int i = 0; i < 16 * 65536; i += 7) {
        const unsigned char three[4] = {(unsigned char)(0xE0 + (i >> 16)), (unsigned char)(i >> 8),
                                        (unsigned char)i, 0};
        check(three, 3);
    }
}

/* All code points are decoded; surrogates are errors. */
static void test_code_points(void) {
    uint32_t wrong = UINT32_MAX;
    for (uint32_t code = 0; code <= 0x10FFFF; ++code) {
        unsigned char b[4];
        size_t count = 1;
        if (code < 0x80) {
            b[0] = (unsigned char)code;
        } else if (code < 0x800) {
            count = 2;
            b[0] = (unsigned char)(0xC0 + code / 64);
        } else if (code < 0x10000) {
            count = 3;
            b[0] = (unsigned char)(0xE0 + code / 4096);
        } else {
            count = 4;
            b[0] = (unsigned char)(0xF0 + code / 262144);
        }
        uint32_t rest = code, got = 0;
        for (size_t i = count - 1; i > 0; --i, rest /= 64) {
            b[i] = (unsigned char)(0x80 + rest % 64);
        }
        const int is_surrogate = code >= 0xD800 && code < 0xE000;
        const size_t length = utf8_decode((const char *)b, count, &got);
        if (is_surrogate ? length != 0 : length != count || got != code) {
            wrong = code;
        }
    }
    CHECK(wrong == UINT32_MAX, "U+%04X", (unsigned)wrong);
}

static void test_lengths(void) {
    CHECK1(utf8_valid_length("", 0) == 0);
    CHECK1(utf8_valid_length("abc", 3) == 3);
    CHECK1(utf8_valid_length("a\xC3\xA9z", 4) == 4);
    CHECK1(utf8_valid_length("a\xC3", 2) == 1);
    CHECK1(utf8_valid_length("a\xC3\xA9\xFFz", 5) == 3);
    CHECK1(utf8_cut("abc", 5) == 3 && utf8_cut("abc", 2) == 2);
    CHECK1(utf8_cut("a\xC3\xA9z", 2) == 1 && utf8_cut("a\xC3\xA9z", 3) == 3);
    CHECK1(utf8_cut("\xF0\x9F\x98\x80", 3) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_sequences());
    RUN(test_code_points());
    RUN(test_lengths());
    return test_end("utf8");
}
