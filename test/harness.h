/* The test harness: CHECK and friends, and a closing count. One program a subject, run by ctest. */
#ifndef BURNISH_TEST_HARNESS_H
#define BURNISH_TEST_HARNESS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int test_checks, test_failures;

/* Counts one check; on failure prints place and message. Evaluates to the condition. */
#define CHECK(condition, ...)                                                                      \
    (++test_checks, (condition)                                                                    \
                        ? 1                                                                        \
                        : (++test_failures, printf("%s:%d: %s: ", __FILE__, __LINE__, #condition), \
                           printf(__VA_ARGS__), printf("\n"), 0))

#define CHECK_TEXT(actual, expected)                                                               \
    CHECK(strcmp((actual), (expected)) == 0, "got \"%s\", expected \"%s\"", (actual), (expected))

/* The end of main: a test that checked nothing fails. */
static inline int test_end(const char *name) {
    printf("%s: %d checks, %d failed\n", name, test_checks, test_failures);
    return test_checks > 0 && test_failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
