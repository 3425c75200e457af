/* A locale with a decimal comma, made on the spot: systems without further locales have none. */
#ifndef BURNISH_TEST_DECIMAL_COMMA_H
#define BURNISH_TEST_DECIMAL_COMMA_H

#include <locale.h>

#include "support.h"

/* Sets the locale; 0 where the system has no localedef (musl knows no decimal comma at all). */
static inline int test_decimal_comma_begin(void) {
    static const char *const make =
        "command -v localedef >/dev/null || exit 0\n"
        "cd '" TEST_BINARY_DIR "' || exit 1\n"
        "printf 'LC_NUMERIC\\ndecimal_point \",\"\\nthousands_sep \"\"\\ngrouping -1\\n"
        "END LC_NUMERIC\\n' >comma.$$\n"
        /* Debian's smallest systems have no character maps */
        "printf '<code_set_name> ASCII\\n<escape_char> /\\nCHARMAP\\n<U0000>..<U007F> /x00 ASCII\\n"
        "END CHARMAP\\n' >ascii.$$\n"
        "localedef -c -i comma.$$ -f ./ascii.$$ ./made.$$ >/dev/null 2>&1\n"
        /* another test that runs at the same time may have been first */
        "mv -T made.$$ xx_XX 2>/dev/null || rm -rf made.$$\n"
        "rm -f comma.$$ ascii.$$\n";
    if (!CHECK1(system(make) == 0) || setenv("LOCPATH", TEST_BINARY_DIR, 1) ||
        !setlocale(LC_NUMERIC, "xx_XX")) {
        printf("SKIPPED: a locale with a decimal comma, localedef makes none here\n");
        return 0;
    }
    char text[8];
    snprintf(text, sizeof text, "%.1f", 1.5);
    CHECK_TEXT(text, "1,5");
    return 1;
}

static inline void test_decimal_comma_end(void) {
    CHECK1(setlocale(LC_NUMERIC, "C") != NULL);
}

#endif
