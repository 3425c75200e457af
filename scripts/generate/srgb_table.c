/* Writes src/core/srgb_table.h: the sRGB transfer function (IEC 61966-2-1) as exact tables.
 *
 *   cc -o srgb_table scripts/generate/srgb_table.c -lm && ./srgb_table > src/core/srgb_table.h
 *
 * Every entry is computed in long double and refused unless all values within 2^-60 of it round to
 * the same float, so the output does not depend on the last bits of powl. The test "srgb" runs this
 * file again and compares its output with the committed header. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Static_assert(LDBL_MANT_DIG >= 64, "the tables need a long double with at least 64 bits");

enum {
    FIRST_EXPONENT = -13, /* the lowest threshold lies in [2^-13, 2^-12) */
    BUCKET_SHIFT = 16,    /* 128 buckets an octave: the least number with one threshold in each */
    BUCKETS = -FIRST_EXPONENT << (23 - BUCKET_SHIFT)
};

static uint32_t float_bits(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float bits_float(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The exact linear light of an sRGB value in [0, 1]. */
static long double srgb_decode(long double value) {
    return value <= 0.04045L ? value / 12.92L : powl((value + 0.055L) / 1.055L, 2.4L);
}

static void refuse(const char *what, int code) {
    fprintf(stderr, "srgb_table: %s %d: too close to a boundary for long double\n", what, code);
    exit(EXIT_FAILURE);
}

static float nearest_float(long double value, int code) {
    float below = (float)(value - value * 0x1p-60L);
    float above = (float)(value + value * 0x1p-60L);
    if (below != above) {
        refuse("linear value of code", code);
    }
    return below;
}

/* The smallest float that is not below value. */
static float round_up(long double value, int code) {
    float nearest = (float)value;
    if (fabsl((long double)nearest - value) <= value * 0x1p-60L) {
        refuse("lower threshold of code", code);
    }
    return (long double)nearest < value ? bits_float(float_bits(nearest) + 1) : nearest;
}

static int code_of(float linear, const float next[256]) {
    int code = 0;
    while (linear >= next[code]) {
        ++code;
    }
    return code;
}

static void write_floats(FILE *file, const char *comment, const char *name, const float *values) {
    fprintf(file, "\n/* %s */\n#define %s \\\n", comment, name);
    for (int i = 0; i < 256; ++i) {
        fprintf(file, "%s%aF%s", i % 4 == 0 ? "    " : " ", (double)values[i],
                i == 255 ? "\n" : (i % 4 == 3 ? ", \\\n" : ","));
    }
}

static void write_buckets(FILE *file, const float next[256]) {
    fprintf(
        file,
        "\n/* Code of the lowest float of each bucket: float patterns from 2^%d to 1 in steps of\n"
        " * 2^%d. No bucket holds more than one threshold. */\n"
        "#define SRGB_FIRST_BITS 0x%08xU /* of 2^%d */\n"
        "#define SRGB_LAST_BITS 0x%08xU  /* of the float below 1 */\n"
        "#define SRGB_BUCKET_SHIFT %d\n"
        "#define SRGB_BUCKETS %d\n"
        "#define SRGB_BUCKET_CODE \\\n",
        FIRST_EXPONENT, BUCKET_SHIFT, (unsigned)float_bits(ldexpf(1, FIRST_EXPONENT)),
        FIRST_EXPONENT, (unsigned)float_bits(1) - 1, BUCKET_SHIFT, BUCKETS);
    uint32_t first = float_bits(ldexpf(1, FIRST_EXPONENT));
    for (uint32_t i = 0; i < BUCKETS; ++i) {
        int low = code_of(bits_float(first + (i << BUCKET_SHIFT)), next);
        int high = code_of(bits_float(first + ((i + 1) << BUCKET_SHIFT) - 1), next);
        if (high > low + 1) {
            refuse("two thresholds in one bucket after code", low);
        }
        fprintf(file, "%s%d%s", i % 16 == 0 ? "    " : " ", low,
                i == BUCKETS - 1 ? "\n" : (i % 16 == 15 ? ", \\\n" : ","));
    }
}

static void write_srgb_table(FILE *file) {
    float linear[256], next[256];
    linear[0] = 0;
    for (int k = 1; k < 256; ++k) {
        linear[k] = nearest_float(srgb_decode(k / 255.0L), k);
        next[k - 1] = round_up(srgb_decode((k - 0.5L) / 255.0L), k);
    }
    next[255] = 2; /* above every value that is looked up */
    fprintf(file, "/* Tables of the sRGB transfer function (IEC 61966-2-1). Written by\n"
                  " * scripts/generate/srgb_table.c; do not edit. */\n"
                  "#ifndef BURNISH_CORE_SRGB_TABLE_H\n#define BURNISH_CORE_SRGB_TABLE_H\n"
                  "\n/* clang-format off */\n");
    write_floats(file, "Linear light of code k, correctly rounded.", "SRGB_LINEAR", linear);
    write_floats(
        file,
        "The smallest float whose exact code is above k: the linear value of (k + 1/2) / 255,"
        "\n * rounded up. The last entry is out of reach.",
        "SRGB_NEXT_THRESHOLD", next);
    write_buckets(file, next);
    fprintf(file, "\n/* clang-format on */\n\n#endif\n");
}

#ifndef SRGB_TABLE_WITHOUT_MAIN
int main(void) {
    write_srgb_table(stdout);
    return fflush(stdout) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
#endif
