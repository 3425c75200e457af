/* What every test program shares: checks, cases, random numbers.
 *
 *     int main(int count, char **arguments) {
 *         test_begin(count, arguments, NULL);
 *         RUN(test_spheres());
 *         return test_end("builtin");
 *     }
 *
 * The program then takes --only TEXT, which runs the cases whose call holds TEXT, and --list. */
#ifndef BURNISH_TEST_SUPPORT_H
#define BURNISH_TEST_SUPPORT_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int test_checks, test_failures, test_cases;
static int test_lists;         /* --list */
static const char *test_only;  /* --only TEXT, or NULL */
static const char *test_extra; /* the value of the program's own option, or NULL */

/* Counts one check; on failure prints file, line and message. Evaluates to the condition. */
#define CHECK(condition, ...)                                                                      \
    (++test_checks, (condition)                                                                    \
                        ? 1                                                                        \
                        : (++test_failures, printf("%s:%d: %s: ", __FILE__, __LINE__, #condition), \
                           printf(__VA_ARGS__), printf("\n"), 0))

/* The expression says everything. */
#define CHECK1(condition)                                                                          \
    (++test_checks,                                                                                \
     (condition) ? 1                                                                               \
                 : (++test_failures, printf("%s:%d: %s\n", __FILE__, __LINE__, #condition), 0))

/* A call that succeeds; on failure prints its error. */
#define CHECK_OK(call, error) CHECK((call) == BURNISH_STATUS_OK, "%s", (error).text)

#define CHECK_TEXT(actual, expected)                                                               \
    CHECK(strcmp((actual), (expected)) == 0, "got \"%s\", expected \"%s\"", (actual), (expected))

/* ---- Cases ---- */

/* Reads the command line. option: one more that the program knows ("--scenes"), or NULL. */
static inline void test_begin(int count, char **arguments, const char *option) {
    for (int i = 1; i < count; ++i) {
        const char *value = i + 1 < count ? arguments[i + 1] : NULL;
        if (strcmp(arguments[i], "--list") == 0) {
            test_lists = 1;
        } else if (strcmp(arguments[i], "--only") == 0 && value) {
            test_only = arguments[++i];
        } else if (option && strcmp(arguments[i], option) == 0) {
            test_extra = value ? arguments[++i] : "";
        } else {
            fprintf(stderr, "%s: unknown \"%s\"; use --only TEXT, --list%s%s%s\n", arguments[0],
                    arguments[i], option ? ", " : "", option ? option : "", option ? " VALUE" : "");
            exit(2);
        }
    }
    const char *only = getenv("BURNISH_TEST_ONLY");
    test_only = test_only ? test_only : only && *only ? only : NULL;
}

/* The value of the program's own option, "" without one, NULL where the option is missing. */
static inline const char *test_option(void) {
    return test_extra;
}

/* Whether a case is to run, by the text of its call. */
static inline int test_wants(const char *call) {
    if (test_lists) {
        printf("%s\n", call);
    }
    int wanted = !test_lists && (!test_only || strstr(call, test_only));
    test_cases += wanted;
    return wanted;
}

#define RUN(call) (test_wants(#call) ? (void)(call) : (void)0)

/* The end of main: a test that checked nothing fails. */
static inline int test_end(const char *name) {
    if (test_lists) {
        return EXIT_SUCCESS;
    }
    if (test_only && test_cases == 0) {
        printf("%s: no case holds \"%s\"; --list shows them\n", name, test_only);
        return EXIT_FAILURE;
    }
    printf("%s: %d checks, %d failed\n", name, test_checks, test_failures);
    return test_checks > 0 && test_failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* ---- Bits and files ---- */

/* FNV-1a of bytes after others; the hash of none is 0 or any other number. */
static inline uint64_t test_add_hash(uint64_t hash, const void *data, size_t size) {
    const uint8_t *bytes = data;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001B3);
    }
    return hash;
}

/* FNV-1a of numbers of 1, 2 or 4 bytes, the same for both byte orders; items may be NULL. */
static inline uint64_t test_add_words(uint64_t hash, const void *items, size_t bytes,
                                      size_t width) {
    for (size_t at = 0; items && at < bytes; at += width) {
        const uint8_t *p = (const uint8_t *)items + at;
        uint32_t word = *p;
        uint16_t half;
        if (width == 4) {
            memcpy(&word, p, 4);
        } else if (width == 2) {
            memcpy(&half, p, 2);
            word = half;
        }
        hash = (hash ^ word) * UINT64_C(0x100000001B3);
    }
    return hash;
}

static inline float test_float_of_bits(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void test_write_file(const char *name, const char *text) {
    FILE *file = fopen(name, "wb");
    if (CHECK(file, "can't make %s", name)) {
        CHECK1(fputs(text, file) >= 0);
        CHECK1(fclose(file) == 0);
    }
}

/* ---- Random numbers ---- */

/* The start of a sequence. The same number gives the same sequence until BURNISH_TEST_SEED says
 * otherwise; the seed is printed, so that a failure can be repeated. */
static inline uint64_t test_seed(uint64_t number) {
    static int printed;
    const char *text = getenv("BURNISH_TEST_SEED");
    uint64_t seed = text ? strtoull(text, NULL, 0) : 0;
    if (!printed) {
        printf("random numbers: BURNISH_TEST_SEED=%llu\n", (unsigned long long)seed);
        printed = 1;
    }
    return number + seed * UINT64_C(0xD1342543DE82EF95);
}

/* splitmix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014. */
static inline uint64_t test_random64(uint64_t *state) {
    uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static inline uint32_t test_random32(uint64_t *state) {
    return (uint32_t)(test_random64(state) >> 32);
}

/* Uniform in [low, high). */
static inline double test_uniform(uint64_t *state, double low, double high) {
    return low + (high - low) * ((double)(test_random64(state) >> 11) * 0x1p-53);
}

static inline float test_uniform_float(uint64_t *state, float low, float high) {
    return low + (high - low) * ((float)(test_random64(state) >> 40) * 0x1p-24f);
}

#endif
